// SPDX-License-Identifier: Apache-2.0
#include "ReportTables.h"

#include "Errors.h"
#include "HostDifferences.h"
#include "MeshIO.h"
#include "TextFile.h"

#include <vtkMRMLModelNode.h>
#include <vtkMRMLPlotChartNode.h>
#include <vtkMRMLPlotSeriesNode.h>
#include <vtkMRMLScene.h>
#include <vtkMRMLTableNode.h>

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTriangle.h>

#include <rapidjson/document.h>

#include <array>
#include <map>
#include <utility>

namespace surgicalmesher
{
namespace
{

rapidjson::Document readReport(const std::string& file)
{
  rapidjson::Document report;
  report.Parse(text::readTextFile(file).c_str());
  if (report.HasParseError() || !report.IsObject()) throw InputError(file + ": no JSON object, expected a report");
  return report;
}

using Value = rapidjson::Value;

/// Returns the array at a path; an empty one if the report lacks it.
const Value& itemsOf(const Value& report, std::initializer_list<const char*> path)
{
  static const Value nothing(rapidjson::kArrayType);
  const Value* at = &report;
  for (const char* name : path)
  {
    if (!at->IsObject() || !at->HasMember(name)) return nothing;
    at = &(*at)[name];
  }
  return at->IsArray() ? *at : nothing;
}

double numberOf(const Value& item, const char* name)
{
  const auto found = item.FindMember(name);
  return found != item.MemberEnd() && found->value.IsNumber() ? found->value.GetDouble() : 0;
}

std::string textOf(const Value& item, const char* name)
{
  const auto found = item.FindMember(name);
  return found != item.MemberEnd() && found->value.IsString() ? found->value.GetString() : std::string();
}

/// Returns the member object, or an empty one.
const Value& memberOf(const Value& item, const char* name)
{
  static const Value nothing(rapidjson::kObjectType);
  const auto found = item.FindMember(name);
  return found != item.MemberEnd() && found->value.IsObject() ? found->value : nothing;
}

struct Report
{
  std::array<double, 3> topology{}; ///< components, tunnels, cavities
  std::array<double, 3> changes{};  ///< islands removed, voxels lost, voxels gained
  double thinShare = 0;             ///< fraction of the area
  double smallestThickness = 0;     ///< mm
  double area = 0;                  ///< mm^2
  std::array<double, 2> volumes{};  ///< mm^3: map, mesh
  std::array<double, 2> farthest{}; ///< mm: map to mesh, mesh to map
  int triangles = 0;
};

void addSurface(vtkPolyData* surface, std::map<Label, Report>& tissues)
{
  vtkDataArray* labels = surface->GetCellData()->GetArray("BoundaryLabels");
  vtkNew<vtkIdList> ids;
  for (vtkIdType t = 0; labels && t < surface->GetNumberOfCells(); ++t)
  {
    surface->GetCellPoints(t, ids);
    std::array<std::array<double, 3>, 3> p;
    for (int corner = 0; corner < 3; ++corner) surface->GetPoint(ids->GetId(corner), p[corner].data());
    for (int side = 0; side < 2; ++side)
    {
      const auto tissue = tissues.find(Label(labels->GetComponent(t, side)));
      if (tissue == tissues.end()) continue;
      ++tissue->second.triangles;
      tissue->second.area += vtkTriangle::TriangleArea(p[0].data(), p[1].data(), p[2].data());
    }
  }
}

std::map<Label, Report> reportByTissue(const Value& report, vtkPolyData* surface)
{
  std::map<Label, Report> tissues;
  for (const auto& item : itemsOf(report, { "topology" }).GetArray())
  {
    tissues[Label(numberOf(item, "label"))].topology = { numberOf(item, "components"), numberOf(item, "tunnels"),
                                                         numberOf(item, "cavities") };
  }
  for (const auto& item : itemsOf(report, { "preparation", "changes" }).GetArray())
  {
    const auto tissue = tissues.find(Label(numberOf(item, "label")));
    if (tissue == tissues.end()) continue; // background
    tissue->second.changes = { numberOf(item, "islandsRemoved"), numberOf(item, "voxelsLost"),
                               numberOf(item, "voxelsGained") };
  }
  for (const auto& item : itemsOf(report, { "thickness", "tissues" }).GetArray())
  {
    const auto tissue = tissues.find(Label(numberOf(item, "label")));
    if (tissue == tissues.end()) continue;
    tissue->second.thinShare = numberOf(item, "share");
    tissue->second.smallestThickness = numberOf(item, "smallestThickness");
  }
  for (const auto& item : itemsOf(report, { "fidelity" }).GetArray())
  {
    const auto tissue = tissues.find(Label(numberOf(item, "label")));
    if (tissue == tissues.end()) continue;
    tissue->second.volumes = { numberOf(item, "mapVolume"), numberOf(item, "meshVolume") };
    tissue->second.farthest = { numberOf(memberOf(item, "mapToMesh"), "maximum"),
                                numberOf(memberOf(item, "meshToMap"), "maximum") };
  }
  addSurface(surface, tissues);
  return tissues;
}

/// Adds columns to a table one after the other, with names in the user's language.
class TableFiller
{
public:
  explicit TableFiller(vtkMRMLTableNode* node) : m_Node(node) {}
  ~TableFiller()
  {
    m_Node->SetAndObserveTable(m_Table);
    host::showColumnNames(m_Node);
    m_Node->SetLocked(true);
  }
  TableFiller(const TableFiller&) = delete;
  void operator=(const TableFiller&) = delete;

  template <class Array, class Items, class ValueOf>
  void add(const std::string& name, const Items& items, const ValueOf& valueOf)
  {
    vtkNew<Array> column;
    column->SetName(name.c_str());
    for (const auto& item : items) column->InsertNextValue(valueOf(item));
    m_Table->AddColumn(column);
  }

private:
  vtkMRMLTableNode* m_Node;
  vtkNew<vtkTable> m_Table;
};

/// Column names of the evolution table, to which plots refer.
struct EvolutionColumns
{
  std::string step = vtkMRMLTr("SimplexMesher", "Step");
  std::string stage = vtkMRMLTr("SimplexMesher", "Stage");
  std::string tetrahedra = vtkMRMLTr("SimplexMesher", "Tetrahedra");
  std::string faces = vtkMRMLTr("SimplexMesher", "Faces");
  std::string meanDistance = vtkMRMLTr("SimplexMesher", "Mean distance (mm)");
  std::string maximumDistance = vtkMRMLTr("SimplexMesher", "Maximum distance (mm)");
  std::string beyond = vtkMRMLTr("SimplexMesher", "Samples beyond tolerance");
  std::string t1 = vtkMRMLTr("SimplexMesher", "T1 (interface collapses)");
  std::string t2 = vtkMRMLTr("SimplexMesher", "T2 (interface splits)");
  std::string t7 = vtkMRMLTr("SimplexMesher", "T7 (interface flips)");
  std::string relabels = vtkMRMLTr("SimplexMesher", "Relabelled tetrahedra");
  std::string moves = vtkMRMLTr("SimplexMesher", "Moves");
  std::string collapses = vtkMRMLTr("SimplexMesher", "Collapses of any edge");
  std::string splits = vtkMRMLTr("SimplexMesher", "Splits of any edge");
  std::string flips = vtkMRMLTr("SimplexMesher", "Flips of any edge");
};

/// A row of the shape table.
struct ShapeRow
{
  std::string what;
  double count = 0;
  double voxels = 0;
  double length = 0; ///< mm
  double volume = 0; ///< mm^3
};

/// Adds the roughness that smoothing removed from the map.
void addRoughness(const Value& report, std::vector<ShapeRow>& rows)
{
  const std::array<std::pair<const char*, std::string>, 3> kinds{
    { { "cracks", vtkMRMLTr("SimplexMesher", "Cracks of the map, smoothed") },
      { "ears", vtkMRMLTr("SimplexMesher", "Ears of the map, smoothed") },
      { "singleSteps", vtkMRMLTr("SimplexMesher", "Single steps of the map, smoothed") } }
  };
  for (const auto& [member, what] : kinds)
  {
    const Value& kind = memberOf(memberOf(report, "smoothing"), member);
    rows.push_back({ what, numberOf(kind, "count"), numberOf(kind, "voxels") });
  }
}

/// Returns the reason given in the report in the user's language.
std::string reasonText(const std::string& reason)
{
  const std::array<std::pair<const char*, std::string>, 5> reasons{
    { { "groove between two tissues", vtkMRMLTr("SimplexMesher", "Groove between two tissues") },
      { "crack", vtkMRMLTr("SimplexMesher", "Crack") },
      { "edge of a thin tissue", vtkMRMLTr("SimplexMesher", "Edge of a thin tissue") },
      { "edge in the map", vtkMRMLTr("SimplexMesher", "Edge in the map") },
      { "edge of the surface alone", vtkMRMLTr("SimplexMesher", "Edge of the surface alone") } }
  };
  for (const auto& [word, translated] : reasons)
  {
    if (reason == word) return translated;
  }
  return reason;
}

void addFolds(const Value& report, std::vector<ShapeRow>& rows)
{
  for (const auto& item : itemsOf(report, { "folds", "reasons" }).GetArray())
  {
    rows.push_back({ vtkMRMLTr("SimplexMesher", "Folds: ") + reasonText(textOf(item, "reason")),
                     numberOf(item, "count"), 0, numberOf(item, "length") });
  }
}

void addEars(const Value& report, std::vector<ShapeRow>& rows)
{
  const Value& ears = memberOf(report, "ears");
  rows.push_back(
    { vtkMRMLTr("SimplexMesher", "Ears of the mesh"), numberOf(ears, "count"), 0, 0, numberOf(ears, "volume") });
  rows.push_back({ vtkMRMLTr("SimplexMesher", "Ears of the mesh, held by no other tissue"), numberOf(ears, "free") });
}

std::string tissueName(const TissueTable& names, Label label)
{
  if (label == 0) return vtkMRMLTr("SimplexMesher", "outside");
  const auto found = names.find(label);
  return found != names.end() && !found->second.name.empty() ? found->second.name : std::to_string(label);
}

/// Returns the names of the item's labels, as "a, b".
std::string tissueNames(const Value& item, const TissueTable& names)
{
  std::string text;
  for (const auto& label : itemsOf(item, { "labels" }).GetArray())
    text += (text.empty() ? "" : ", ") + tissueName(names, Label(label.GetInt()));
  return text;
}

/// Returns a coordinate of `place`, converted from the report's LPS to Slicer's RAS.
double coordinateOf(const Value& item, int axis)
{
  const auto place = itemsOf(item, { "place" }).GetArray();
  if (int(place.Size()) <= axis || !place[axis].IsNumber()) return 0;
  return (axis < 2 ? -1 : 1) * place[axis].GetDouble();
}

std::string yesOrNo(const Value& item, const char* name)
{
  const auto found = item.FindMember(name);
  const bool isSo = found != item.MemberEnd() && found->value.IsBool() && found->value.GetBool();
  return isSo ? vtkMRMLTr("SimplexMesher", "yes") : vtkMRMLTr("SimplexMesher", "no");
}

template <class Items>
void addPlaces(TableFiller& table, const Items& items)
{
  const std::array<std::string, 3> names{ vtkMRMLTr("SimplexMesher", "R (mm)"), vtkMRMLTr("SimplexMesher", "A (mm)"),
                                          vtkMRMLTr("SimplexMesher", "S (mm)") };
  for (int axis = 0; axis < 3; ++axis)
    table.add<vtkDoubleArray>(names[axis], items, [axis](const auto& item) { return coordinateOf(item, axis); });
}

struct Plot
{
  std::string title, axis;
  std::vector<std::string> columns;
};

constexpr std::array<std::array<double, 3>, 3> lineColors{
  { { 0.12, 0.47, 0.71 }, { 0.84, 0.37, 0.0 }, { 0.17, 0.63, 0.17 } }
};

void fillSeries(vtkMRMLPlotSeriesNode* series, vtkMRMLTableNode* table, const std::string& column, std::size_t number)
{
  const auto& color = lineColors[number];
  series->SetName(column.c_str());
  series->SetAndObserveTableNodeID(table->GetID());
  series->SetPlotType(vtkMRMLPlotSeriesNode::PlotTypeScatter);
  series->SetXColumnName(EvolutionColumns().step);
  series->SetYColumnName(column);
  series->SetMarkerStyle(vtkMRMLPlotSeriesNode::MarkerStyleNone);
  series->SetLineStyle(vtkMRMLPlotSeriesNode::LineStyleSolid);
  series->SetColor(color[0], color[1], color[2]);
}

void fillChart(vtkMRMLPlotChartNode* chart, vtkMRMLTableNode* table, const Plot& plot)
{
  chart->SetName((table->GetName() + (": " + plot.title)).c_str());
  chart->SetTitle(plot.title.c_str());
  chart->SetXAxisTitle(EvolutionColumns().step.c_str());
  chart->SetYAxisTitle(plot.axis.c_str());
  chart->SetLegendVisibility(plot.columns.size() > 1);
  chart->SetLegendFontSize(12); // it lies over the curves
  for (std::size_t i = 0; i < plot.columns.size(); ++i)
  {
    vtkMRMLPlotSeriesNode* series = chart->GetNthPlotSeriesNode(int(i));
    const bool isNew = !series;
    if (isNew)
    {
      series = vtkMRMLPlotSeriesNode::SafeDownCast(chart->GetScene()->AddNewNodeByClass("vtkMRMLPlotSeriesNode"));
    }
    fillSeries(series, table, plot.columns[i], i);
    if (isNew) chart->AddAndObservePlotSeriesNodeID(series->GetID());
  }
}

} // namespace

void fillTissueTable(const std::string& reportFile, vtkMRMLModelNode* surface, vtkMRMLTableNode* node)
{
  const rapidjson::Document report = readReport(reportFile);
  const std::map<Label, Report> tissues = reportByTissue(report, surface->GetPolyData());
  const TissueTable names = tissuesOf(surface->GetPolyData()->GetFieldData());
  const auto count = [&](TableFiller& table, const std::string& name, const auto& valueOf)
  { table.add<vtkIntArray>(name, tissues, [&](const auto& entry) { return int(valueOf(entry.second)); }); };
  const auto measure = [&](TableFiller& table, const std::string& name, const auto& valueOf)
  { table.add<vtkDoubleArray>(name, tissues, [&](const auto& entry) { return valueOf(entry.second); }); };

  TableFiller table(node);
  table.add<vtkIntArray>(vtkMRMLTr("SimplexMesher", "Label"), tissues, [](const auto& entry) { return entry.first; });
  table.add<vtkStringArray>(vtkMRMLTr("SimplexMesher", "Tissue"), tissues,
                            [&](const auto& entry) { return tissueName(names, entry.first); });
  measure(table, vtkMRMLTr("SimplexMesher", "Area (mm²)"), [](const Report& r) { return r.area; });
  count(table, vtkMRMLTr("SimplexMesher", "Triangles"), [](const Report& r) { return r.triangles; });
  count(table, vtkMRMLTr("SimplexMesher", "Components"), [](const Report& r) { return r.topology[0]; });
  count(table, vtkMRMLTr("SimplexMesher", "Tunnels"), [](const Report& r) { return r.topology[1]; });
  count(table, vtkMRMLTr("SimplexMesher", "Cavities"), [](const Report& r) { return r.topology[2]; });
  count(table, vtkMRMLTr("SimplexMesher", "Islands removed"), [](const Report& r) { return r.changes[0]; });
  count(table, vtkMRMLTr("SimplexMesher", "Voxels lost"), [](const Report& r) { return r.changes[1]; });
  count(table, vtkMRMLTr("SimplexMesher", "Voxels gained"), [](const Report& r) { return r.changes[2]; });
  measure(table, vtkMRMLTr("SimplexMesher", "Thinner than L (%)"), [](const Report& r) { return 100 * r.thinShare; });
  measure(table, vtkMRMLTr("SimplexMesher", "Smallest thickness (mm)"),
          [](const Report& r) { return r.smallestThickness; });
  measure(table, vtkMRMLTr("SimplexMesher", "Volume in the map (mm³)"), [](const Report& r) { return r.volumes[0]; });
  measure(table, vtkMRMLTr("SimplexMesher", "Volume of the mesh (mm³)"), [](const Report& r) { return r.volumes[1]; });
  measure(table, vtkMRMLTr("SimplexMesher", "Farthest, map to mesh (mm)"),
          [](const Report& r) { return r.farthest[0]; });
  measure(table, vtkMRMLTr("SimplexMesher", "Farthest, mesh to map (mm)"),
          [](const Report& r) { return r.farthest[1]; });
}

void fillEvolutionTable(const std::string& reportFile, vtkMRMLTableNode* node)
{
  const rapidjson::Document report = readReport(reportFile);
  const auto steps = itemsOf(report, { "evolution" }).GetArray();
  const EvolutionColumns names;
  TableFiller table(node);
  const auto distance = [&](const std::string& name, const char* member)
  { table.add<vtkDoubleArray>(name, steps, [&](const auto& step) { return numberOf(step, member); }); };
  const auto number = [&](const std::string& name, const char* member)
  { table.add<vtkIntArray>(name, steps, [&](const auto& step) { return int(numberOf(step, member)); }); };
  int count = 0;
  table.add<vtkIntArray>(names.step, steps, [&](const auto&) { return count++; });
  table.add<vtkStringArray>(names.stage, steps, [](const auto& step) { return textOf(step, "stage"); });
  number(names.tetrahedra, "tetrahedra");
  number(names.faces, "faces");
  distance(names.meanDistance, "meanDistance");
  distance(names.maximumDistance, "maximumDistance");
  number(names.beyond, "samplesBeyondTolerance");
  number(names.t1, "T1");
  number(names.t2, "T2");
  number(names.t7, "T7");
  number(names.relabels, "relabels");
  number(names.moves, "moves");
  number(names.collapses, "collapses");
  number(names.splits, "splits");
  number(names.flips, "flips");
}

void fillShapeTable(const std::string& reportFile, vtkMRMLTableNode* node)
{
  const rapidjson::Document report = readReport(reportFile);
  std::vector<ShapeRow> rows;
  addRoughness(report, rows);
  addFolds(report, rows);
  addEars(report, rows);
  TableFiller table(node);
  table.add<vtkStringArray>(vtkMRMLTr("SimplexMesher", "What"), rows, [](const ShapeRow& row) { return row.what; });
  table.add<vtkIntArray>(vtkMRMLTr("SimplexMesher", "Count"), rows, [](const ShapeRow& row) { return int(row.count); });
  table.add<vtkIntArray>(vtkMRMLTr("SimplexMesher", "Voxels"), rows,
                         [](const ShapeRow& row) { return int(row.voxels); });
  table.add<vtkDoubleArray>(vtkMRMLTr("SimplexMesher", "Length (mm)"), rows,
                            [](const ShapeRow& row) { return row.length; });
  table.add<vtkDoubleArray>(vtkMRMLTr("SimplexMesher", "Volume (mm³)"), rows,
                            [](const ShapeRow& row) { return row.volume; });
}

void fillFoldTable(const std::string& reportFile, vtkMRMLModelNode* surface, vtkMRMLTableNode* node)
{
  const rapidjson::Document report = readReport(reportFile);
  const auto folds = itemsOf(report, { "folds", "longest" }).GetArray();
  const TissueTable names = tissuesOf(surface->GetPolyData()->GetFieldData());
  TableFiller table(node);
  table.add<vtkStringArray>(vtkMRMLTr("SimplexMesher", "Tissues"), folds,
                            [&](const auto& fold) { return tissueNames(fold, names); });
  addPlaces(table, folds);
  table.add<vtkDoubleArray>(vtkMRMLTr("SimplexMesher", "Length (mm)"), folds,
                            [](const auto& fold) { return numberOf(fold, "length"); });
  table.add<vtkStringArray>(vtkMRMLTr("SimplexMesher", "Reason"), folds,
                            [](const auto& fold) { return reasonText(textOf(fold, "reason")); });
  table.add<vtkStringArray>(vtkMRMLTr("SimplexMesher", "On the outer surface"), folds,
                            [](const auto& fold) { return yesOrNo(fold, "outer"); });
}

void fillEarTable(const std::string& reportFile, vtkMRMLModelNode* surface, vtkMRMLTableNode* node)
{
  const rapidjson::Document report = readReport(reportFile);
  const auto ears = itemsOf(report, { "ears", "largest" }).GetArray();
  const TissueTable names = tissuesOf(surface->GetPolyData()->GetFieldData());
  TableFiller table(node);
  table.add<vtkStringArray>(vtkMRMLTr("SimplexMesher", "Tissue"), ears,
                            [&](const auto& ear) { return tissueName(names, Label(numberOf(ear, "label"))); });
  addPlaces(table, ears);
  table.add<vtkDoubleArray>(vtkMRMLTr("SimplexMesher", "Volume (mm³)"), ears,
                            [](const auto& ear) { return numberOf(ear, "volume"); });
  table.add<vtkIntArray>(vtkMRMLTr("SimplexMesher", "Tetrahedra"), ears,
                         [](const auto& ear) { return int(numberOf(ear, "tetrahedra")); });
  table.add<vtkStringArray>(vtkMRMLTr("SimplexMesher", "Held by no other tissue"), ears,
                            [](const auto& ear) { return yesOrNo(ear, "free"); });
}

std::vector<vtkMRMLPlotChartNode*> plotEvolution(vtkMRMLTableNode* table,
                                                 const std::vector<vtkMRMLPlotChartNode*>& charts)
{
  const EvolutionColumns names;
  const std::array<Plot, 3> plots{ { { names.faces, names.faces, { names.faces } },
                                     { vtkMRMLTr("SimplexMesher", "Distance to the tissue boundary"),
                                       vtkMRMLTr("SimplexMesher", "Distance (mm)"),
                                       { names.meanDistance, names.maximumDistance } },
                                     { vtkMRMLTr("SimplexMesher", "Operations"),
                                       vtkMRMLTr("SimplexMesher", "Operations per step"),
                                       { names.t1, names.t2, names.t7 } } } };
  std::vector<vtkMRMLPlotChartNode*> result = charts;
  for (std::size_t i = 0; i < plots.size(); ++i)
  {
    if (i == result.size())
    {
      result.push_back(
        vtkMRMLPlotChartNode::SafeDownCast(table->GetScene()->AddNewNodeByClass("vtkMRMLPlotChartNode")));
    }
    fillChart(result[i], table, plots[i]);
  }
  return result;
}

} // namespace surgicalmesher
