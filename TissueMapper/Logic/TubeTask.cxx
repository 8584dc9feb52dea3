// SPDX-License-Identifier: Apache-2.0
#include "TubeTask.h"

#include "ClassificationTask.h"
#include "Errors.h"
#include "HostDifferences.h"
#include "MarkupsInput.h"
#include "Text.h"
#include "TextFile.h"
#include "TissueColors.h"
#include "TissueMapInput.h"
#include "vtkMRMLTissueMapperNode.h"
#include "vtkSurgicalMesherRun.h"

#include <vtkMRMLColorTableNode.h>
#include <vtkMRMLLabelMapVolumeNode.h>
#include <vtkMRMLMarkupsCurveNode.h>
#include <vtkMRMLMarkupsDisplayNode.h>
#include <vtkMRMLScene.h>

#include <rapidjson/document.h>

namespace surgicalmesher
{

using Node = vtkMRMLTissueMapperNode;

namespace
{

std::string tubeName(Node* parameters)
{
  const std::string name = text::legible(text::trimmed(parameters->GetTubeName()));
  return name.empty() ? "tube" : name;
}

FoundTube readReport(const std::string& file)
{
  rapidjson::Document report;
  report.Parse(text::readTextFile(file).c_str());
  FoundTube found;
  found.isBright = report["polarity"] == "bright";
  found.length = report["length"].GetDouble();
  found.smallestRadius = report["radius"]["minimum"].GetDouble();
  found.largestRadius = report["radius"]["maximum"].GetDouble();
  for (const auto& warning : report["warnings"].GetArray()) found.warnings.push_back(warning.GetString());
  return found;
}

/// Returns the map with a table of the tissues that have voxels: names without voxels, of which a colour table may have
/// hundreds, take no label from a tube.
TissueMap presentTissues(vtkMRMLLabelMapVolumeNode* labelMap)
{
  TissueMap map = readTissueMap(labelMap);
  TissueTable present;
  for (const Label label : presentLabels(map)) present[label] = map.table[label];
  map.table = present;
  return map;
}

/// Returns the label of the tissue of this name, or else a free one.
Label labelOfTube(const TissueMap& map, const std::string& name, const char* labelMap)
{
  for (const auto& [label, tissue] : map.table)
  {
    if (text::lowerCase(tissue.name) == text::lowerCase(name)) return label;
  }
  const std::vector<Label> free = freeLabels(map, 1);
  if (free.empty()) throw InputError(std::string(labelMap) + ": all labels to 65535 are taken, expected a free one");
  return free.front();
}

/// Adds a curve that is displayed as a line, with inconspicuous points.
vtkMRMLMarkupsCurveNode* addCurve(vtkMRMLScene* scene, const std::string& name)
{
  auto* curve = vtkMRMLMarkupsCurveNode::SafeDownCast(
    scene->AddNewNodeByClass("vtkMRMLMarkupsCurveNode", scene->GenerateUniqueName(name)));
  curve->CreateDefaultDisplayNodes();
  auto* display = vtkMRMLMarkupsDisplayNode::SafeDownCast(curve->GetDisplayNode());
  display->SetPointLabelsVisibility(false);
  display->SetUseGlyphScale(false);
  display->SetGlyphSize(0.3); // mm
  display->SetSelectedColor(0.85, 0.2, 0.2);
  curve->SetLocked(true);
  return curve;
}

} // namespace

TaskCheck TubeTask::findProblem(vtkMRMLTissueMapperNode* parameters)
{
  const TaskCheck image = checkImage(parameters->GetTubeImage());
  if (image.problem != TaskCheck::None) return image;
  if (markupsPoints(parameters->GetMarkupsNode(Node::TubePointsRole())).size() < 2) return { TaskCheck::FewPoints, {} };
  const double smallest = parameters->GetMinimumRadius(), largest = parameters->GetMaximumRadius();
  if (smallest > largest || (smallest == 0) != (largest == 0)) return { TaskCheck::RadiiOdd, {} };
  const bool hasTissues = checkTissueMap(parameters->GetLabelMapNode(Node::LabelMapRole())) == TissueMapProblem::None;
  if (m_Wanted == PathAndTissue && !hasTissues) return { TaskCheck::NoTissues, {} };
  return {};
}

void TubeTask::prepare(vtkMRMLTissueMapperNode* parameters)
{
  vtkSurgicalMesherRun* run = this->run();
  const auto image = copyForRun(parameters->GetTubeImage());
  run->AddTemporaryNode(image);
  run->SetParameterNode("image", image);
  const std::string points = run->NewTemporaryFile(".mrk.json");
  writeMarkups({ markupsPoints(parameters->GetMarkupsNode(Node::TubePointsRole())) }, points);
  run->SetParameter("points", points);
  run->SetParameter("radius", text::rounded(parameters->GetMinimumRadius(), 12) + "," +
                                text::rounded(parameters->GetMaximumRadius(), 12));
  run->SetParameter("polarity", parameters->GetPolarity());
  run->SetParameter("potential", parameters->GetTubePotential());
  run->SetParameter("snap", parameters->GetTubeSnap());
  run->SetParameter("margin", parameters->GetTubeMargin());
  m_Name = tubeName(parameters);
  run->SetParameter("name", m_Name);
  m_PathFile = run->NewTemporaryFile(".mrk.json");
  run->SetParameter("path", m_PathFile);
  m_ReportFile = run->NewTemporaryFile(".json");
  run->SetParameter("report", m_ReportFile);
  if (m_Wanted == PathAndTissue) this->prepareTissues(parameters);
}

void TubeTask::prepareTissues(vtkMRMLTissueMapperNode* parameters)
{
  vtkMRMLLabelMapVolumeNode* tissues = parameters->GetLabelMapNode(Node::LabelMapRole());
  const TissueMap map = presentTissues(tissues);
  m_Tissues = map.table;
  m_Label = labelOfTube(map, m_Name, tissues->GetName());
  const TissueMapNodes nodes = makeTissueMapNodes(tissues);
  if (!nodes.labelMap) throw InputError(std::string(tissues->GetName()) + ": can't be turned into a label map");
  this->run()->AddTemporaryNode(nodes.labelMap);
  if (nodes.colors) this->run()->AddTemporaryNode(nodes.colors);
  this->run()->SetParameterNode("addTo", nodes.labelMap);
  this->run()->SetParameter("label", int(m_Label));
  m_LabelMap.request(this->run(), "labelMap", vtkSmartPointer<vtkMRMLLabelMapVolumeNode>::New());
}

void TubeTask::deliver(vtkMRMLTissueMapperNode* parameters)
{
  m_Found = readReport(m_ReportFile);
  this->deliverPath(parameters);
  if (m_LabelMap.isRead()) this->deliverTissues(parameters);
}

void TubeTask::deliverPath(vtkMRMLTissueMapperNode* parameters)
{
  const std::vector<Vec3> points = readMarkups(m_PathFile).front();
  auto* curve = vtkMRMLMarkupsCurveNode::SafeDownCast(parameters->GetMarkupsNode(Node::TubePathRole()));
  if (!curve) curve = addCurve(parameters->GetScene(), m_Name);
  const int wasModifying = curve->StartModify();
  curve->SetAndObserveTransformNodeID(nullptr);
  curve->SetCurveTypeToLinear(); // the points are dense
  curve->RemoveAllControlPoints();
  for (const Vec3& p : points) curve->AddControlPoint(-p.x, -p.y, p.z);
  curve->EndModify(wasModifying);
  parameters->SetNode(Node::TubePathRole(), curve);
}

void TubeTask::deliverTissues(vtkMRMLTissueMapperNode* parameters)
{
  auto* tissues = vtkMRMLLabelMapVolumeNode::SafeDownCast(
    m_LabelMap.deliver(parameters->GetLabelMapNode(Node::LabelMapRole()), parameters->GetScene(),
                       vtkMRMLTr("vtkSlicerTissueMapperLogic", "tissues")));
  parameters->SetNode(Node::LabelMapRole(), tissues);
  if (m_Tissues.count(m_Label) == 0)
  {
    m_Tissues[m_Label].name = m_Name;
    m_Tissues[m_Label].color =
      m_Found.isBright ? std::array<double, 3>{ 0.85, 0.2, 0.2 } : std::array<double, 3>{ 0.95, 0.85, 0.3 };
  }
  showTissueColors(tissues, m_Tissues);
}

void TubeTask::forgetResults() { m_LabelMap.forget(); }

} // namespace surgicalmesher
