// SPDX-License-Identifier: Apache-2.0
#include "TaskObstacle.h"

#include "qSlicerTissueMapperModuleWidget.h"

#include <qMRMLNodeComboBox.h>
#include <qSlicerApplication.h>
#include <qSlicerIOManager.h>

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
    return { qSlicerTissueMapperModuleWidget::tr("There is no image of a head."),
             qSlicerTissueMapperModuleWidget::tr("Add data..."),
             [] { qSlicerApplication::application()->ioManager()->openAddDataDialog(); } };
  const QPointer<qMRMLNodeComboBox> where(selector);
  return { qSlicerTissueMapperModuleWidget::tr("Choose an image of a head."),
           qSlicerTissueMapperModuleWidget::tr("Choose %1").arg(first->GetName()),
           [where]
           {
             if (where) where->setCurrentNodeIndex(0);
           } };
}

} // namespace

PanelObstacle taskObstacle(const TaskCheck& check, qMRMLNodeComboBox* imageSelector)
{
  const QString name = QString::fromStdString(check.name);
  switch (check.problem)
  {
  case TaskCheck::NoModule:
    return { qSlicerTissueMapperModuleWidget::tr("The command-line module %1 isn't loaded; see the application's log.")
               .arg(name),
             {},
             {} };
  case TaskCheck::NoImage: return nothingChosen(imageSelector);
  case TaskCheck::NoVoxels:
    return { qSlicerTissueMapperModuleWidget::tr("The image %1 has no voxels; choose another one.").arg(name), {}, {} };
  case TaskCheck::UnderWarp:
    return { qSlicerTissueMapperModuleWidget::tr(
               "The image %1 is under a transform that isn't linear; harden or remove it.")
               .arg(name),
             qSlicerTissueMapperModuleWidget::tr("Transforms"), [] { openModule("Transforms"); } };
  case TaskCheck::Refused:
    return { qSlicerTissueMapperModuleWidget::tr("The input can't be used: %1.").arg(name), {}, {} };
  default: return {};
  }
}

} // namespace surgicalmesher
