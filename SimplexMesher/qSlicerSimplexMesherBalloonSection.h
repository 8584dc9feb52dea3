// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The balloon section of the panel: the seed points, the tissues that stop the balloons, their growth during a run,
/// and the outputs. Map and edge lengths are those of the panel.

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
  void setParameterNode(vtkMRMLSimplexMesherNode* node); ///< null: shows nothing
  void setTissues(const std::vector<surgicalmesher::TissueRow>& tissues);
  /// Sets the problem with the map or the edge lengths, or that another run is busy; without a sentence, there is none.
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
