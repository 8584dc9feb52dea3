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
  return { "CSF", "grey matter", "white matter", "fat", "muscle", "skin", "skull", "connective tissue" };
}

/// The host labels new points by a format, in which "%" has a meaning; one that is being placed has its label already.
void placePointsOf(const std::string& className, vtkMRMLMarkupsNode* training)
{
  std::string format = text::legible(text::trimmed(className));
  format.erase(std::remove(format.begin(), format.end(), '%'), format.end());
  training->SetControlPointLabelFormat(format);
  for (int n = 0; n < training->GetNumberOfControlPoints(); ++n)
  {
    if (training->GetNthControlPointPositionStatus(n) == vtkMRMLMarkupsNode::PositionPreview)
      training->SetNthControlPointLabel(n, format);
  }
}

} // namespace surgicalmesher
