// SPDX-License-Identifier: Apache-2.0
#include "MeshReport.h"

#include "Errors.h"
#include "HostDifferences.h"
#include "MeshQuality.h"
#include "ModelMesh.h"
#include "vtkMRMLFuchsTetrahedralizerNode.h"

#include <vtkMRMLModelNode.h>
#include <vtkMRMLPlotChartNode.h>
#include <vtkMRMLPlotSeriesNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLSubjectHierarchyNode.h>
#include <vtkMRMLTableNode.h>

#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkStringArray.h>
#include <vtkTable.h>

#include <rapidjson/document.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace surgicalmesher
{
namespace
{

using Json = rapidjson::Value;
using Parameters = vtkMRMLFuchsTetrahedralizerNode;

// ---- nodes of a mesh ------------------------------------------------------------------------------------------------

/// Places the node below the mesh in the subject hierarchy.
void putBelow(vtkMRMLNode* node, vtkMRMLModelNode* mesh)
{
  vtkMRMLSubjectHierarchyNode* hierarchy = vtkMRMLSubjectHierarchyNode::GetSubjectHierarchyNode(mesh->GetScene());
  if (!hierarchy) return;
  const vtkIdType item = hierarchy->GetItemByDataNode(node), parent = hierarchy->GetItemByDataNode(mesh);
  if (item != vtkMRMLSubjectHierarchyNode::INVALID_ITEM_ID && parent != vtkMRMLSubjectHierarchyNode::INVALID_ITEM_ID)
    hierarchy->SetItemParent(item, parent);
}

/// Adds a node that is named after the mesh and shown below it.
template <class Node>
Node* addNode(vtkMRMLModelNode* mesh, const char* className, const std::string& title)
{
  auto* node =
    Node::SafeDownCast(mesh->GetScene()->AddNewNodeByClass(className, std::string(mesh->GetName()) + ": " + title));
  putBelow(node, mesh);
  return node;
}

/// Returns the nth node that the mesh references in `role`, created if there is none.
template <class Node>
Node* nodeOf(vtkMRMLModelNode* mesh, const char* role, int n, const char* className, const std::string& title)
{
  auto* node = Node::SafeDownCast(mesh->GetNthNodeReference(role, n));
  if (node) return node;
  node = addNode<Node>(mesh, className, title);
  mesh->SetNthNodeReferenceID(role, n, node->GetID());
  return node;
}

// ---- table ----------------------------------------------------------------------------------------------------------

double numberAt(const Json& group, const char* member, const char* ofDistribution = nullptr)
{
  const auto found = group.FindMember(member);
  if (found == group.MemberEnd()) return 0;
  const Json& value = found->value;
  if (!ofDistribution) return value.IsNumber() ? value.GetDouble() : 0;
  return value.IsObject() ? numberAt(value, ofDistribution) : 0;
}

struct Column
{
  const char* name; ///< not translated, since others may look columns up by it
  const char* member;
  const char* ofDistribution;
  double factor;
};

// clang-format off
constexpr Column columns[] = {
  { "tetrahedra",              "tetrahedra",        nullptr,   1 },
  { "points",                  "points",            nullptr,   1 },
  { "volume (ml)",             "volume",            nullptr,   0.001 },
  { "min dihedral (deg)",      "dihedral",          "minimum", 1 },
  { "max dihedral (deg)",      "dihedral",          "maximum", 1 },
  { "mean min dihedral (deg)", "minimumDihedral",   "mean",    1 },
  { "min radius ratio",        "radiusRatio",       "minimum", 1 },
  { "mean radius ratio",       "radiusRatio",       "mean",    1 },
  { "min scaled Jacobian",     "scaledJacobian",    "minimum", 1 },
  { "min volume (mm^3)",       "tetrahedronVolume", "minimum", 1 },
  { "min height (mm)",         "height",            "minimum", 1 },
  { "mean edge/target",        "edgeOverTarget",    "mean",    1 },
  { "edges near target (%)",   "edgesNearTarget",   nullptr,   100 },
  { "median valence",          "valence",           "median",  1 },
};
// clang-format on

struct Row
{
  std::string name;
  const Json* group;
};

std::vector<Row> rowsOf(const Json& quality)
{
  std::vector<Row> rows{ { vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "mesh"), &quality["whole"] } };
  for (const Json& tissue : quality["tissues"].GetArray())
  {
    const std::string name = tissue["name"].GetString();
    rows.push_back({ name.empty() ? std::to_string(int(numberAt(tissue, "label"))) : name, &tissue });
  }
  for (const Json& part : quality["subMeshes"].GetArray())
  {
    const int id = int(numberAt(part, "subMesh"));
    rows.push_back({ id == 0 ? vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "parent")
                             : vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "child") + " " + std::to_string(id),
                     &part });
  }
  return rows;
}

void fillTable(vtkMRMLTableNode* table, const Json& quality)
{
  const std::vector<Row> rows = rowsOf(quality);
  vtkNew<vtkTable> content;
  vtkNew<vtkStringArray> names;
  names->SetName("part");
  for (const Row& row : rows) names->InsertNextValue(row.name);
  content->AddColumn(names);
  for (const Column& column : columns)
  {
    vtkNew<vtkDoubleArray> values;
    values->SetName(column.name);
    for (const Row& row : rows)
      values->InsertNextValue(column.factor * numberAt(*row.group, column.member, column.ofDistribution));
    content->AddColumn(values);
  }
  table->SetAndObserveTable(content);
  host::showColumnNames(table);
  table->SetUseFirstColumnAsRowHeader(true);
  table->SetLocked(true);
}

/// Adds the columns of the conditioning, if the report has it.
void addConditioning(vtkMRMLTableNode* table, const Json& quality)
{
  const auto stiffness = quality.FindMember("stiffness");
  if (stiffness == quality.MemberEnd()) return;
  const std::pair<const char*, const char*> columns[] = { { "condition number", "conditionNumber" },
                                                          { "CG iterations", "iterations" } };
  for (const auto& [name, member] : columns)
  {
    vtkNew<vtkStringArray> values; // for the whole mesh only; the other rows stay empty
    values->SetName(name);
    values->SetNumberOfValues(table->GetNumberOfRows());
    values->SetValue(0, std::to_string(std::int64_t(numberAt(stiffness->value, member))));
    table->GetTable()->AddColumn(values);
  }
  table->Modified();
}

// ---- histograms -----------------------------------------------------------------------------------------------------

Histogram histogramOf(const Json& json)
{
  Histogram histogram;
  histogram.low = numberAt(json, "low");
  histogram.high = numberAt(json, "high");
  for (const Json& count : json["counts"].GetArray()) histogram.counts.push_back(count.GetUint64());
  return histogram;
}

Histogram radiusRatios(const TetMesh& mesh)
{
  constexpr int bins = 50;
  Histogram histogram{ 0, 1, std::vector<std::size_t>(bins, 0) };
  for (const auto& [a, b, c, d] : mesh.tetrahedra)
  {
    const double ratio = radiusRatio(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]);
    ++histogram.counts[std::min(int(bins * ratio), bins - 1)];
  }
  return histogram;
}

struct Plot
{
  std::string title;
  std::string axis;
  Histogram histogram;
};

void fillHistogramTable(vtkMRMLTableNode* table, const Plot& plot)
{
  const Histogram& histogram = plot.histogram;
  const double total = double(std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::size_t(0)));
  const double width = (histogram.high - histogram.low) / double(histogram.counts.size());
  vtkNew<vtkDoubleArray> places, shares;
  places->SetName("value");
  shares->SetName("share (%)");
  for (std::size_t i = 0; i < histogram.counts.size(); ++i)
  {
    places->InsertNextValue(histogram.low + (double(i) + 0.5) * width);
    shares->InsertNextValue(total > 0 ? 100 * double(histogram.counts[i]) / total : 0);
  }
  vtkNew<vtkTable> content;
  content->AddColumn(places);
  content->AddColumn(shares);
  table->SetAndObserveTable(content);
  host::showColumnNames(table);
  table->SetLocked(true);
}

void showHistogram(vtkMRMLModelNode* mesh, int n, const Plot& plot)
{
  auto* chart = nodeOf<vtkMRMLPlotChartNode>(mesh, Parameters::HistogramRole(), n, "vtkMRMLPlotChartNode", plot.title);
  vtkMRMLPlotSeriesNode* series = chart->GetPlotSeriesNode();
  if (!series) series = addNode<vtkMRMLPlotSeriesNode>(mesh, "vtkMRMLPlotSeriesNode", plot.title);
  vtkMRMLTableNode* table = series->GetTableNode();
  if (!table) table = addNode<vtkMRMLTableNode>(mesh, "vtkMRMLTableNode", plot.title);
  fillHistogramTable(table, plot);
  series->SetAndObserveTableNodeID(table->GetID());
  series->SetPlotType(vtkMRMLPlotSeriesNode::PlotTypeScatterBar);
  series->SetXColumnName(table->GetColumnName(0));
  series->SetYColumnName(table->GetColumnName(1));
  series->SetColor(0.17, 0.48, 0.71);
  chart->SetAndObservePlotSeriesNodeID(series->GetID());
  chart->SetTitle((std::string(mesh->GetName()) + ": " + plot.title).c_str());
  chart->SetXAxisTitle(plot.axis.c_str());
  chart->SetYAxisTitle(vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "share (%)").c_str());
  chart->SetLegendVisibility(false);
}

void showQuality(vtkMRMLModelNode* mesh, const Json& quality)
{
  auto* table = nodeOf<vtkMRMLTableNode>(mesh, Parameters::QualityTableRole(), 0, "vtkMRMLTableNode",
                                         vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "quality"));
  fillTable(table, quality);
  addConditioning(table, quality);
  const Json& histograms = quality["histograms"];
  const std::vector<Plot> plots{
    { vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "dihedral angles"),
      vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "dihedral angle (degrees)"),
      histogramOf(histograms["dihedral"]) },
    { vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "edge lengths"),
      vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "edge length over target"),
      histogramOf(histograms["edgeOverTarget"]) },
    { vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "valences"),
      vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "tetrahedra around an inner point"),
      histogramOf(histograms["valence"]) },
    { vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "radius ratios"),
      vtkMRMLTr("vtkSlicerFuchsTetrahedralizerLogic", "three times inner over outer radius"),
      radiusRatios(meshOfModel(mesh).mesh) },
  };
  for (std::size_t n = 0; n < plots.size(); ++n) showHistogram(mesh, int(n), plots[n]);
}

} // namespace

void showReport(vtkMRMLModelNode* mesh, const std::string& reportJSON)
{
  rapidjson::Document report;
  report.Parse(reportJSON.c_str());
  if (report.HasParseError() || !report.IsObject() || !report.HasMember("quality"))
    throw InputError("the report of the tetrahedra can't be read, expected a JSON object with the member quality");
  showQuality(mesh, report["quality"]);
}

void assessMesh(vtkMRMLModelNode* mesh)
{
  const MeshFile content = meshOfModel(mesh);
  const MeshQuality measured = assessQualityFromPoints(content.mesh, content.subMesh, content.targetEdgeLength);
  rapidjson::Document quality;
  quality.Parse(qualityJSON(measured, content.tissues).c_str());
  showQuality(mesh, quality);
}

} // namespace surgicalmesher
