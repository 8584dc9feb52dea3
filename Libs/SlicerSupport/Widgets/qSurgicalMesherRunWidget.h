// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The foot of every panel of the project: a line that says what is missing, with a button that mends it, or why the
/// last run failed; Apply and Cancel; the host's progress bar and the elapsed time while a run is busy.

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

  /// Says `sentence` and disables Apply. With `fixText` a button of that text calls `fix`.
  void setProblem(const QString& sentence, const QString& fixText = QString(), std::function<void()> fix = {});
  /// Enables Apply, unless a run is busy.
  void clearProblem();
  /// The problem's sentence; empty if there is none.
  QString problem() const;

  /// The run to follow and to cancel; null for none. Forgets the last one's error.
  void setRun(vtkSurgicalMesherRun* run);
  vtkSurgicalMesherRun* run() const;

  /// A sentence on the last run, shown until the next one starts: what came out of it.
  void setResult(const QString& sentence);

public slots:
  /// As the buttons do; apply() is ignored while Apply is disabled.
  void apply();
  void cancel();

signals:
  void applyRequested();
  /// Cancel was pressed; the run has been told already.
  void cancelRequested();
  /// The run ended, well or not (vtkSurgicalMesherRun::CompletedEvent).
  void runEnded();

private slots:
  void onRunStatusChanged();

private:
  Q_DECLARE_PRIVATE(qSurgicalMesherRunWidget)
  Q_DISABLE_COPY(qSurgicalMesherRunWidget)
  QScopedPointer<qSurgicalMesherRunWidgetPrivate> d_ptr;
};
