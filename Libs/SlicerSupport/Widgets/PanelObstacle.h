// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The reason why a panel cannot be run, in the user's language, and an action that fixes it.

#include "TissueMapInput.h"
#include "qSurgicalMesherSupportWidgetsExport.h"

#include <QString>

#include <functional>

class qMRMLNodeComboBox;
class vtkMRMLNode;

namespace surgicalmesher
{

struct PanelObstacle
{
  QString sentence;          ///< empty: no obstacle
  QString fixText;           ///< text of the button; empty: no button
  std::function<void()> fix; ///< action of the button
};

/// Returns the obstacle for a problem of the tissue map `map`; `selector` is where the user chooses it.
Q_SURGICALMESHER_SUPPORT_WIDGETS_EXPORT PanelObstacle tissueMapObstacle(TissueMapProblem problem, vtkMRMLNode* map,
                                                                        qMRMLNodeComboBox* selector);

/// Switches to another module of Slicer, if it is loaded, and shows `input` in it, if given.
Q_SURGICALMESHER_SUPPORT_WIDGETS_EXPORT void openModule(const QString& name, vtkMRMLNode* input = nullptr);

} // namespace surgicalmesher
