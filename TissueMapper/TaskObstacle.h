// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What keeps a task of the panel from being run, in the user's language.

#include "PanelObstacle.h"
#include "PanelTask.h"

class qMRMLNodeComboBox;

namespace surgicalmesher
{

/// The obstacles that all tasks have in common; `imageSelector` is where the user chooses the image, and outlives the
/// obstacle.
PanelObstacle taskObstacle(const TaskCheck& check, qMRMLNodeComboBox* imageSelector);

} // namespace surgicalmesher
