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

/// The classes of the points that are placed, in the order of first appearance; points without a label are of the class
/// "". Case doesn't count. None for null.
VTK_SLICER_TISSUEMAPPER_MODULE_LOGIC_EXPORT std::vector<TrainedClass> countTrainingPoints(vtkMRMLMarkupsNode* training);

/// The classes that a head is usually made of, and whose compartments are known by their names.
VTK_SLICER_TISSUEMAPPER_MODULE_LOGIC_EXPORT std::vector<std::string> usualClasses();

} // namespace surgicalmesher
