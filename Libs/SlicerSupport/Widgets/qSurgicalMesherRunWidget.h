// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The bottom part of every panel of the project: a line with the current problem and a button that fixes it, or with
/// the error of the last run; Apply and Cancel; Slicer's progress bar and the elapsed time while a run is busy.

#include "qSurgicalMesherSupportWidgetsExport.h"

#include <ctkVTKObject.h>

#include <QScopedPointer>
#include <QWidget>

#include <functional>

class qSurgicalMesherRunWidgetPrivate;
class vtkSurgicalMesherRun;

class Q_SURGICALMESHER_SUPPORT_WIDGETS_EXPORT qSurgicalMesherRunWidget : public QWidget
{
  Q_OBJECT
  QVTK_OBJECT

public:
  explicit qSurgicalMesherRunWidget(QWidget* parent = nullptr);
  ~qSurgicalMesherRunWidget() override;

  /// Shows `sentence` and disables Apply. If `fixText` is given, a button with that text calls `fix`.
  void setProblem(const QString& sentence, const QString& fixText = QString(), std::function<void()> fix = {});
  /// Enables Apply, unless a run is busy.
  void clearProblem();
  /// Returns the sentence of the current problem; empty if there is none.
  QString problem() const;

  /// Sets the run to observe and cancel; null for none. Clears the error of the previous run.
  void setRun(vtkSurgicalMesherRun* run);
  vtkSurgicalMesherRun* run() const;

  /// Sets a sentence on the result of the last run, shown until the next one starts.
  void setResult(const QString& sentence);

public slots:
  /// Same as the buttons; apply() is ignored while Apply is disabled.
  void apply();
  void cancel();

signals:
  void applyRequested();
  /// Cancel was pressed; the run has already been notified.
  void cancelRequested();
  /// The run ended, in whatever way (vtkSurgicalMesherRun::CompletedEvent).
  void runEnded();

private slots:
  void onRunStatusChanged();

private:
  Q_DECLARE_PRIVATE(qSurgicalMesherRunWidget)
  Q_DISABLE_COPY(qSurgicalMesherRunWidget)
  QScopedPointer<qSurgicalMesherRunWidgetPrivate> d_ptr;
};
