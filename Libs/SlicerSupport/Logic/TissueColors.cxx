// SPDX-License-Identifier: Apache-2.0
#include "TissueColors.h"

#include "HostDifferences.h"
#include "MeshIO.h"

#include <vtkMRMLColorTableNode.h>
#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLModelDisplayNode.h>
#include <vtkMRMLModelNode.h>
#include <vtkMRMLScene.h>

#include <vtkAssignAttribute.h>
#include <vtkLookupTable.h>
#include <vtkMath.h>
#include <vtkPointSet.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace surgicalmesher
{
namespace
{

constexpr const char* kColorsRole = "tissueColors"; // role on the model; its display may use other colours meanwhile
constexpr const char* kColorOwner =
  "SurgicalMesher.ColorsOf"; // attribute of a table: id of the label map it belongs to

vtkMRMLColorTableNode* colorsOf(vtkMRMLModelNode* model)
{
  auto* colors = vtkMRMLColorTableNode::SafeDownCast(model->GetNodeReference(kColorsRole));
  if (colors) return colors;
  colors = vtkMRMLColorTableNode::SafeDownCast(model->GetScene()->AddNewNodeByClass(
    "vtkMRMLColorTableNode", model->GetScene()->GenerateUniqueName(std::string(model->GetName()) + " tissues")));
  model->SetNodeReferenceID(kColorsRole, colors->GetID());
  return colors;
}

vtkMRMLColorTableNode* colorsOf(vtkMRMLLabelMapVolumeNode* labelMap)
{
  vtkMRMLScene* scene = labelMap->GetScene();
  labelMap->CreateDefaultDisplayNodes();
  auto* colors = vtkMRMLColorTableNode::SafeDownCast(labelMap->GetDisplayNode()->GetColorNode());
  const char* owner = colors ? colors->GetAttribute(kColorOwner) : nullptr;
  if (owner && std::string(owner) == labelMap->GetID()) return colors;
  const std::string name = scene->GenerateUniqueName(std::string(labelMap->GetName()) + " tissues");
  colors = vtkMRMLColorTableNode::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLColorTableNode", name));
  colors->SetAttribute(kColorOwner, labelMap->GetID());
  return colors;
}

} // namespace

TissueTable withDistinctColors(TissueTable tissues)
{
  const bool isPlain =
    tissues.size() > 1 && std::all_of(tissues.begin(), tissues.end(),
                                      [](const auto& tissue) { return tissue.second.color == Tissue().color; });
  for (auto& [label, tissue] : tissues)
  {
    if (!isPlain) break;
    const double golden = 0.618033988749895; // golden ratio: steps around the hue circle stay far from earlier ones
    const double hue = label * golden - std::floor(label * golden);
    vtkMath::HSVToRGB(hue, label % 3 == 0 ? 0.35 : 0.6, label % 2 == 0 ? 0.95 : 0.8, &tissue.color[0], &tissue.color[1],
                      &tissue.color[2]);
  }
  return tissues;
}

void fillColorTable(const TissueTable& tissues, vtkMRMLColorTableNode* colors)
{
  const int wasModifying = colors->StartModify();
  const int highest = tissues.empty() ? 0 : tissues.rbegin()->first;
  colors->SetTypeToUser();
  colors->SetAttribute("Category", "User Generated");
  colors->SetNumberOfColors(1); // discards the previous entries
  colors->SetNumberOfColors(highest + 1);
  host::keepColorNames(colors);
  colors->SetColor(0, "background", 0, 0, 0, 0);
  for (const auto& [label, tissue] : tissues)
  {
    const std::string name = tissue.name.empty() ? std::to_string(label) : tissue.name;
    if (label != 0) colors->SetColor(label, name.c_str(), tissue.color[0], tissue.color[1], tissue.color[2]);
  }
  colors->GetLookupTable()->SetTableRange(0, std::max(highest, 1));
  colors->EndModify(wasModifying);
}

vtkMRMLColorTableNode* showTissueColors(vtkMRMLModelNode* model, const char* array)
{
  model->CreateDefaultDisplayNodes();
  vtkMRMLColorTableNode* colors = colorsOf(model);
  fillColorTable(withDistinctColors(tissuesOf(model->GetMesh()->GetFieldData())), colors);
  vtkMRMLModelDisplayNode* display = model->GetModelDisplayNode();
  const int wasModifying = display->StartModify();
  display->SetActiveScalar(array, vtkAssignAttribute::CELL_DATA);
  display->SetAndObserveColorNodeID(colors->GetID());
  display->SetScalarRangeFlag(vtkMRMLDisplayNode::UseColorNodeScalarRange);
  display->ScalarVisibilityOn();
  display->EndModify(wasModifying);
  return colors;
}

void showTissueColors(vtkMRMLLabelMapVolumeNode* labelMap, const TissueTable& tissues)
{
  vtkMRMLColorTableNode* colors = colorsOf(labelMap);
  fillColorTable(tissues, colors);
  labelMap->GetDisplayNode()->SetAndObserveColorNodeID(colors->GetID());
}

} // namespace surgicalmesher
