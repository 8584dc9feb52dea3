// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Training points as control points of a markups node, each labelled with the name of its class.

#include "vtkSlicerTissueMapperModuleLogicExport.h"

#include <string>
#include <vector>

class vtkMRMLMarkupsNode;

namespace surgicalmesher
{

struct TrainedClass
{
  std::string name;
  int pointCount;
};

/// Counts the placed points by class, in the order of first appearance, ignoring case; points without a label have the
/// class "". Returns an empty vector for a null node.
VTK_SLICER_TISSUEMAPPER_MODULE_LOGIC_EXPORT std::vector<TrainedClass> countTrainingPoints(vtkMRMLMarkupsNode* training);

/// The usual classes of a head, whose compartments are known by their names.
VTK_SLICER_TISSUEMAPPER_MODULE_LOGIC_EXPORT std::vector<std::string> usualClasses();

} // namespace surgicalmesher
