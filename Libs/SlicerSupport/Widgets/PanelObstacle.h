// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What keeps a panel from being run, in the user's language, and what a click can do about it.

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
  QString sentence;          ///< empty: nothing is in the way
  QString fixText;           ///< of a button; empty: none
  std::function<void()> fix; ///< what the button does
};

/// `map` is the tissue map with the problem, `selector` where the user chooses it; both outlive the obstacle.
Q_SURGICALMESHER_SUPPORT_WIDGETS_EXPORT PanelObstacle tissueMapObstacle(TissueMapProblem problem, vtkMRMLNode* map,
                                                                        qMRMLNodeComboBox* selector);

/// Goes to another module of the host, if it is there; `input`, if there is one, is what it shows then.
Q_SURGICALMESHER_SUPPORT_WIDGETS_EXPORT void openModule(const QString& name, vtkMRMLNode* input = nullptr);

} // namespace surgicalmesher
