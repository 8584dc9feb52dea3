// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Messages for the reasons why a task of the panel cannot be started, in the user's language.

#include "PanelObstacle.h"
#include "PanelTask.h"

class qMRMLNodeComboBox;

namespace surgicalmesher
{

/// Returns the message for the reasons that all tasks share. `imageSelector` is the widget in which the user chooses
/// the image; it must outlive the obstacle.
PanelObstacle taskObstacle(const TaskCheck& check, qMRMLNodeComboBox* imageSelector);

} // namespace surgicalmesher
