// SPDX-License-Identifier: Apache-2.0
#include "FitResults.h"

#include "Errors.h"
#include "HostDifferences.h"
#include "Text.h"
#include "TextFile.h"

#include <vtkMRMLTableNode.h>

#include <vtkNew.h>
#include <vtkStringArray.h>
#include <vtkTable.h>

#include <rapidjson/document.h>

#include <algorithm>
#include <vector>

namespace surgicalmesher
{
namespace
{

using Json = rapidjson::Value;

rapidjson::Document readReport(const std::string& file)
{
  rapidjson::Document report;
  report.Parse(text::readTextFile(file).c_str());
  if (!report.IsObject()) throw InputError(file + ": no report, expected a JSON object");
  return report;
}

/// Returns the value at a path of members; null if a member is missing.
const Json* at(const Json& json, const std::vector<const char*>& path)
{
  const Json* found = &json;
  for (const char* member : path)
  {
    if (!found->IsObject() || !found->HasMember(member)) return nullptr;
    found = &(*found)[member];
  }
  return found;
}

std::string textAt(const Json& json, const std::vector<const char*>& path)
{
  const Json* found = at(json, path);
  if (!found || !found->IsNumber()) return {};
  return found->IsUint64() ? std::to_string(found->GetUint64()) : text::rounded(found->GetDouble(), 4);
}

struct Row
{
  std::string mesh, shape;
  const Json* quality;   ///< null for a surface
  const Json* distances; ///< null for the template
};

std::vector<Row> rowsOf(const Json& report)
{
  const std::pair<const char*, std::string> stages[] = {
    { "template", vtkMRMLTr("vtkSlicerTemplateHexMesherLogic", "template") },
    { "spline", vtkMRMLTr("vtkSlicerTemplateHexMesherLogic", "spline alone") },
    { "fitted", vtkMRMLTr("vtkSlicerTemplateHexMesherLogic", "fitted") }
  };
  std::vector<Row> rows;
  for (const auto& [stage, name] : stages)
  {
    const Json *shapes = at(report, { "quality", stage }), *distances = at(report, { "distances", stage });
    const std::size_t before = rows.size();
    if (shapes)
    {
      for (const auto& shape : shapes->GetObject())
        rows.push_back({ name, shape.name.GetString(), &shape.value, distances });
    }
    if (rows.size() == before)
      rows.push_back({ name, vtkMRMLTr("vtkSlicerTemplateHexMesherLogic", "surface"), nullptr, distances });
  }
  return rows;
}

struct Column
{
  const char* name; ///< not translated, as other code may look columns up by name
  std::vector<const char*> path;
  bool isDistance;
};

std::vector<Column> columns()
{
  return { { "elements", { "elements" }, false },
           { "invalid", { "invalid" }, false },
           { "min scaled Jacobian", { "minimumScaledJacobian" }, false },
           { "mean scaled Jacobian", { "meanScaledJacobian" }, false },
           { "mean shape skew", { "meanShapeSkew" }, false },
           { "to target (mm)", { "fittedToTarget", "mean" }, true },
           { "95 % (mm)", { "fittedToTarget", "percentile95" }, true },
           { "from target (mm)", { "targetToFitted", "mean" }, true },
           { "95 % from target (mm)", { "targetToFitted", "percentile95" }, true } };
}

void addColumn(vtkTable* table, const char* name, const std::vector<std::string>& values)
{
  vtkNew<vtkStringArray> column;
  column->SetName(name);
  for (const std::string& value : values) column->InsertNextValue(value);
  table->AddColumn(column);
}

} // namespace

FitSummary readFitSummary(const std::string& reportFile)
{
  const rapidjson::Document report = readReport(reportFile);
  FitSummary summary;
  if (const Json* shapes = at(report, { "quality", "fitted" }))
  {
    for (const auto& shape : shapes->GetObject())
    {
      summary.elements += shape.value["elements"].GetUint64();
      summary.invalid += shape.value["invalid"].GetUint64();
      summary.minimum = std::min(summary.minimum, shape.value["minimumScaledJacobian"].GetDouble());
    }
  }
  if (const Json* turned = at(report, { "turnedFacets" })) summary.turnedFacets = turned->GetUint64();
  if (const Json* mean = at(report, { "distances", "fitted", "fittedToTarget", "mean" }))
    summary.toTarget = mean->GetDouble();
  if (const Json* landmarks = at(report, { "landmarks" }))
  {
    for (const Json& landmark : landmarks->GetArray())
      summary.residuals[landmark["name"].GetString()] = landmark["residual"].GetDouble();
  }
  return summary;
}

void fillQualityTable(const std::string& reportFile, vtkMRMLTableNode* table)
{
  const rapidjson::Document report = readReport(reportFile);
  const std::vector<Row> rows = rowsOf(report);
  const auto valuesOf = [&rows](const auto& value)
  {
    std::vector<std::string> values;
    for (const Row& row : rows) values.push_back(value(row));
    return values;
  };
  vtkNew<vtkTable> content;
  addColumn(content, "mesh", valuesOf([](const Row& row) { return row.mesh; }));
  addColumn(content, "shape", valuesOf([](const Row& row) { return row.shape; }));
  for (const Column& column : columns())
  {
    addColumn(content, column.name,
              valuesOf(
                [&column](const Row& row)
                {
                  const Json* group = column.isDistance ? row.distances : row.quality;
                  return group ? textAt(*group, column.path) : std::string();
                }));
  }
  table->SetAndObserveTable(content);
  host::showColumnNames(table);
  table->SetLocked(true);
}

} // namespace surgicalmesher
