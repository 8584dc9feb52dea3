// SPDX-License-Identifier: Apache-2.0
#include "PanelObstacle.h"

#include "qSurgicalMesherRunWidget.h"

#include <qMRMLNodeComboBox.h>
#include <qSlicerAbstractCoreModule.h>
#include <qSlicerAbstractModuleWidget.h>
#include <qSlicerApplication.h>
#include <qSlicerIOManager.h>
#include <qSlicerLayoutManager.h>
#include <qSlicerModuleManager.h>

#include <vtkMRMLNode.h>

#include <QPointer>

namespace surgicalmesher
{

namespace
{

PanelObstacle nothingChosen(qMRMLNodeComboBox* selector)
{
  vtkMRMLNode* first = selector->nodeCount() > 0 ? selector->nodeFromIndex(0) : nullptr;
  if (!first)
  {
    return { qSurgicalMesherRunWidget::tr("There is no segmentation or label map to mesh."),
             qSurgicalMesherRunWidget::tr("Add data..."),
             [] { qSlicerApplication::application()->ioManager()->openAddDataDialog(); } };
  }
  const QPointer<qMRMLNodeComboBox> where(selector);
  return { qSurgicalMesherRunWidget::tr("Choose a segmentation or a label map."),
           qSurgicalMesherRunWidget::tr("Choose %1").arg(first->GetName()),
           [where]
           {
             if (where) where->setCurrentNodeIndex(0);
           } };
}

} // namespace

PanelObstacle tissueMapObstacle(TissueMapProblem problem, vtkMRMLNode* map, qMRMLNodeComboBox* selector)
{
  const PanelObstacle edit{ QString(), qSurgicalMesherRunWidget::tr("Edit segments"),
                            [] { openModule("SegmentEditor"); } };
  switch (problem)
  {
  case TissueMapProblem::None: return {};
  case TissueMapProblem::NothingChosen:
  case TissueMapProblem::NotATissueMap: return nothingChosen(selector);
  case TissueMapProblem::NoSegment:
    return { qSurgicalMesherRunWidget::tr("The segmentation has no segments."), edit.fixText, edit.fix };
  case TissueMapProblem::NoVoxels:
    return { qSurgicalMesherRunWidget::tr("The label map has no voxels; choose another one."), {}, {} };
  case TissueMapProblem::OnlyBackground:
    if (map && map->IsA("vtkMRMLSegmentationNode"))
      return { qSurgicalMesherRunWidget::tr("All segments are empty."), edit.fixText, edit.fix };
    return { qSurgicalMesherRunWidget::tr("No voxel of the label map belongs to a tissue; choose another one."),
             {},
             {} };
  case TissueMapProblem::NoReferenceGeometry:
    return { qSurgicalMesherRunWidget::tr(
               "The segmentation's voxel size isn't known: set its source geometry in Segment Editor."),
             edit.fixText, edit.fix };
  case TissueMapProblem::ShearingTransform:
    return { qSurgicalMesherRunWidget::tr(
               "The transform of the tissues turns their voxels into rhomboids; choose another one."),
             qSurgicalMesherRunWidget::tr("Transforms"), [] { openModule("Transforms"); } };
  case TissueMapProblem::NegativeLabels:
    return { qSurgicalMesherRunWidget::tr("Some voxels of the label map are no whole numbers from 0 to 65535."),
             {},
             {} };
  case TissueMapProblem::NotExported: break;
  }
  return { qSurgicalMesherRunWidget::tr(
             "The segmentation can't be turned into a label map; see the application's log."),
           {},
           {} };
}

void openModule(const QString& name, vtkMRMLNode* input)
{
  qSlicerApplication* application = qSlicerApplication::application();
  qSlicerAbstractCoreModule* module = application->moduleManager()->module(name);
  if (!module) return;
  auto* panel = input ? dynamic_cast<qSlicerAbstractModuleWidget*>(module->widgetRepresentation()) : nullptr;
  if (panel) panel->setEditedNode(input);
  if (application->layoutManager()) application->layoutManager()->setCurrentModule(name);
}

} // namespace surgicalmesher
