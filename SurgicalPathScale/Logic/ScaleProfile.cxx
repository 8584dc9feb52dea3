// SPDX-License-Identifier: Apache-2.0
#include "ScaleProfile.h"

#include "HostDifferences.h"
#include "SurgicalScale.h"
#include "vtkMRMLSurgicalPathScaleNode.h"

#include <vtkMRMLPlotChartNode.h>
#include <vtkMRMLPlotSeriesNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLTableNode.h>

#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkTable.h>

#include <algorithm>
#include <string>
#include <vector>

namespace surgicalmesher
{

using Node = vtkMRMLSurgicalPathScaleNode;

namespace
{

// Columns are looked up by these names elsewhere, so that they are not translated.
constexpr const char* distanceColumn = "Distance (mm)";
constexpr const char* targetColumn = "Around targets (mm)";
constexpr const char* pathColumn = "Around paths (mm)";

struct Profile
{
  LengthRange range;
  Falloff targets;
  Falloff paths;
  bool areSame() const { return targets.childRadius == paths.childRadius && targets.decayLength == paths.decayLength; }
  /// Distance at which less than a fiftieth of the rise to the maximum remains.
  double reach() const
  {
    return std::max(targets.childRadius + 4 * targets.decayLength, paths.childRadius + 4 * paths.decayLength);
  }
};

Profile profileOf(vtkMRMLSurgicalPathScaleNode* parameters)
{
  Profile profile;
  profile.range = { parameters->GetMinimumEdgeLength(), parameters->GetMaximumEdgeLength() };
  profile.targets = { parameters->GetChildRadius(), parameters->GetDecayLength() };
  profile.paths = profile.targets;
  if (parameters->GetPathChildRadius() > 0) profile.paths.childRadius = parameters->GetPathChildRadius();
  if (parameters->GetPathDecayLength() > 0) profile.paths.decayLength = parameters->GetPathDecayLength();
  return profile;
}

vtkSmartPointer<vtkTable> makeTable(const Profile& profile)
{
  constexpr int count = 201;
  auto table = vtkSmartPointer<vtkTable>::New();
  vtkNew<vtkDoubleArray> columns[3];
  const char* const names[] = { distanceColumn, targetColumn, pathColumn };
  for (int c = 0; c < 3; ++c)
  {
    columns[c]->SetName(names[c]);
    columns[c]->SetNumberOfValues(count);
    table->AddColumn(columns[c]);
  }
  for (int n = 0; n < count; ++n)
  {
    const double distance = profile.reach() * n / (count - 1);
    columns[0]->SetValue(n, distance);
    columns[1]->SetValue(n, edgeLength(distance, profile.range, profile.targets));
    columns[2]->SetValue(n, edgeLength(distance, profile.range, profile.paths));
  }
  return table;
}

vtkMRMLPlotSeriesNode* addSeries(vtkMRMLScene* scene, vtkMRMLTableNode* table, const char* column,
                                 const double color[3])
{
  auto* series = vtkMRMLPlotSeriesNode::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLPlotSeriesNode", column));
  series->SetAndObserveTableNodeID(table->GetID());
  series->SetXColumnName(distanceColumn);
  series->SetYColumnName(column);
  series->SetPlotType(vtkMRMLPlotSeriesNode::PlotTypeScatter);
  series->SetMarkerStyle(vtkMRMLPlotSeriesNode::MarkerStyleNone);
  series->SetLineWidth(3);
  series->SetColor(color[0], color[1], color[2]);
  return series;
}

vtkMRMLPlotChartNode* addChart(vtkMRMLScene* scene)
{
  const std::string title = vtkMRMLTr("vtkSlicerSurgicalPathScaleLogic", "Edge length over distance");
  auto* chart = vtkMRMLPlotChartNode::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLPlotChartNode", title));
  chart->SetTitle(title.c_str());
  chart->SetXAxisTitle(vtkMRMLTr("vtkSlicerSurgicalPathScaleLogic", "Distance (mm)").c_str());
  chart->SetYAxisTitle(vtkMRMLTr("vtkSlicerSurgicalPathScaleLogic", "Edge length (mm)").c_str());
  auto* table = vtkMRMLTableNode::SafeDownCast(scene->AddNewNodeByClass("vtkMRMLTableNode", title));
  host::showColumnNames(table);
  const double orange[3] = { 0.90, 0.45, 0.10 };
  const double blue[3] = { 0.15, 0.45, 0.75 };
  chart->AddAndObservePlotSeriesNodeID(addSeries(scene, table, targetColumn, orange)->GetID());
  chart->AddAndObservePlotSeriesNodeID(addSeries(scene, table, pathColumn, blue)->GetID());
  return chart;
}

bool isComplete(vtkMRMLPlotChartNode* chart)
{
  for (int n = 0; chart && n < 2; ++n)
  {
    vtkMRMLPlotSeriesNode* series = chart->GetNthPlotSeriesNode(n);
    if (!series || !series->GetTableNode()) return false;
  }
  return chart != nullptr;
}

} // namespace

vtkMRMLPlotChartNode* plotProfile(vtkMRMLSurgicalPathScaleNode* parameters)
{
  vtkMRMLPlotChartNode* chart = parameters->GetPlotChartNode(Node::ProfileChartRole());
  if (!isComplete(chart))
  {
    removeProfile(parameters);
    chart = addChart(parameters->GetScene());
    parameters->SetNode(Node::ProfileChartRole(), chart);
  }
  const Profile profile = profileOf(parameters);
  chart->GetNthPlotSeriesNode(1)->SetOpacity(profile.areSame() ? 0 : 1);
  chart->SetLegendVisibility(!profile.areSame());
  chart->GetNthPlotSeriesNode(0)->GetTableNode()->SetAndObserveTable(makeTable(profile));
  return chart;
}

void removeProfile(vtkMRMLSurgicalPathScaleNode* parameters)
{
  vtkMRMLPlotChartNode* chart = parameters->GetPlotChartNode(Node::ProfileChartRole());
  if (!chart) return;
  std::vector<vtkMRMLNode*> nodes;
  for (int n = 0; n < chart->GetNumberOfPlotSeriesNodes(); ++n)
  {
    vtkMRMLPlotSeriesNode* series = chart->GetNthPlotSeriesNode(n);
    if (!series) continue;
    nodes.push_back(series);
    vtkMRMLNode* table = series->GetTableNode();
    if (table && std::find(nodes.begin(), nodes.end(), table) == nodes.end()) nodes.push_back(table);
  }
  vtkMRMLScene* scene = parameters->GetScene();
  scene->RemoveNode(chart);
  for (vtkMRMLNode* node : nodes) scene->RemoveNode(node);
}

} // namespace surgicalmesher
