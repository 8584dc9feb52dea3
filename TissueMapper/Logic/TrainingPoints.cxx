// SPDX-License-Identifier: Apache-2.0
#include "TrainingPoints.h"

#include "MarkupsInput.h"
#include "Text.h"

#include <vtkMRMLMarkupsNode.h>

#include <algorithm>

namespace surgicalmesher
{

std::vector<TrainedClass> countTrainingPoints(vtkMRMLMarkupsNode* training)
{
  std::vector<TrainedClass> classes;
  for (const std::string& label : labelledPoints(training).labels)
  {
    const std::string name = text::legible(text::trimmed(label));
    const auto found =
      std::find_if(classes.begin(), classes.end(),
                   [&](const TrainedClass& each) { return text::lowerCase(each.name) == text::lowerCase(name); });
    if (found == classes.end()) classes.push_back({ name, 1 });
    else ++found->pointCount;
  }
  return classes;
}

std::vector<std::string> usualClasses()
{
  return { "CSF",  "grey matter", "white matter",      "fat", "muscle",
           "skin", "skull",       "connective tissue", "eye", "optic nerve" };
}

} // namespace surgicalmesher
