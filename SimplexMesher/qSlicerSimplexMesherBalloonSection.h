// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Balloons in the panel: the points they grow from, the tissues that stop them, their growth while a run is busy, and
/// where the results go. Map and edge lengths are those chosen above.

#include "PanelObstacle.h"
#include "TissueRows.h"
#include "qSlicerSimplexMesherModuleExport.h"

#include <ctkVTKObject.h>

#include <QScopedPointer>
#include <QWidget>

#include <vector>

class qSlicerSimplexMesherBalloonSectionPrivate;
class vtkMRMLScene;
class vtkMRMLSimplexMesherNode;
class vtkSlicerSimplexMesherLogic;

class Q_SLICER_QTMODULES_SIMPLEXMESHER_EXPORT qSlicerSimplexMesherBalloonSection : public QWidget
{
  Q_OBJECT
  QVTK_OBJECT

public:
  explicit qSlicerSimplexMesherBalloonSection(QWidget* parent = nullptr);
  ~qSlicerSimplexMesherBalloonSection() override;

  void setLogic(vtkSlicerSimplexMesherLogic* logic);
  void setParameterNode(vtkMRMLSimplexMesherNode* node); ///< null shows nothing
  void setTissues(const std::vector<surgicalmesher::TissueRow>& tissues);
  /// What is wrong with map or edge lengths, or that another run is busy; without a sentence, nothing.
  void setInputObstacle(const surgicalmesher::PanelObstacle& obstacle);

public slots:
  void setMRMLScene(vtkMRMLScene* scene);

signals:
  void runStarted();
  void runEnded();

private slots:
  void updateFromNode();
  void onSeedsChanged();
  void onStopsChanged();
  void apply();
  void showGrowth();
  void onRunEnded();

private:
  Q_DECLARE_PRIVATE(qSlicerSimplexMesherBalloonSection)
  Q_DISABLE_COPY(qSlicerSimplexMesherBalloonSection)
  QScopedPointer<qSlicerSimplexMesherBalloonSectionPrivate> d_ptr;
};
