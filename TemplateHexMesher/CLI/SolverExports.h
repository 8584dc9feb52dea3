// SPDX-License-Identifier: Apache-2.0
#pragma once
/// --export of both programs, and what goes with it.

#include "CommandLine.h"
#include "Errors.h"
#include "Export.h"
#include "MaterialTable.h"
#include "NodeChoices.h"
#include "SolidElements.h"
#include "Units.h"

#include <set>

namespace surgicalmesher
{

struct SolverExports
{
  std::vector<std::string> files;
  std::string materials;         ///< a table; empty for the default
  std::vector<NodeChoice> nodes; ///< in mm
  Units units = Units::Millimetres;
};

/// What the command line asks for. Announces what is written beside the exports. Throws UsageError for sets of nodes
/// or materials without an export; before anything is read.
inline SolverExports readExports(CommandLine& line)
{
  SolverExports exports{ line.outputNames("export"), line.text("materials"),
                         nodeChoices(line.texts("nodeSet"), line.texts("nodeMarkups")),
                         unitsNamed(line.text("units")) };
  for (const std::string& file : exports.files)
  {
    for (const ExportSidecar& sidecar : exportSidecars(file))
    {
      if (sidecar.isMany) line.alsoWritesMany("export", sidecar.before, sidecar.after);
      else line.alsoWrites("export", sidecar.before);
    }
  }
  if (exports.files.empty() && !exports.nodes.empty())
    throw UsageError("--nodeSet or --nodeMarkups is given, but no --export, expected both");
  if (exports.files.empty() && !exports.materials.empty())
    throw UsageError("--materials is given, but no --export, expected both");
  return exports;
}

/// `points` in mm; `file` is named in messages.
inline void writeExports(CommandLine& line, const SolverExports& exports, const ElementMeshFile& content,
                         const Points& points, const std::string& file)
{
  if (exports.files.empty()) return;
  const SolidMesh solid = solidMeshOf(content, points, file);
  FiniteElementOptions options;
  options.nodes = exports.nodes;
  if (!exports.materials.empty())
    options.materials =
      readMaterialTable(exports.materials, solid.tissues, { solid.labels.begin(), solid.labels.end() });
  const FiniteElementModel model = inUnits(finiteElementModel(solid, options), exports.units);
  for (const std::string& name : exports.files)
    exportModel(model, name, [&](const std::string& finalPath) { return line.outputPath(finalPath); });
}

} // namespace surgicalmesher
