// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The option --export of both programs, and the options that depend on it.

#include "CommandLine.h"
#include "Errors.h"
#include "Export.h"
#include "MaterialTable.h"
#include "NodeChoices.h"
#include "SolidElements.h"
#include "Units.h"

#include <map>
#include <set>

namespace surgicalmesher
{

struct SolverExports
{
  std::vector<std::string> files;
  std::string materialFile;      ///< material table; empty: the default for all tissues
  std::vector<NodeChoice> nodes; ///< in mm
  Units units = Units::Millimetres;
  std::map<Label, TissueMaterial> materials; ///< from the table
};

/// Reads the export options and announces the files written beside the exports. Does not read any file yet. Throws
/// UsageError for node sets or materials without an export.
inline SolverExports readExports(CommandLine& line)
{
  SolverExports exports{ line.outputNames("export"),
                         line.text("materials"),
                         nodeChoices(line.texts("nodeSet"), line.texts("nodeMarkups")),
                         unitsNamed(line.text("units")),
                         {} };
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
  if (exports.files.empty() && !exports.materialFile.empty())
    throw UsageError("--materials is given, but no --export, expected both");
  return exports;
}

/// Reads the material table, before the long computation: it may name tissues that end up without elements. Warns of
/// tissues without a row.
inline void readMaterials(CommandLine& line, SolverExports& exports, const TissueTable& tissues,
                          const std::set<Label>& labels)
{
  if (exports.materialFile.empty()) return;
  std::vector<std::string> warnings;
  exports.materials = readMaterialTable(exports.materialFile, tissues, labels, &warnings);
  for (const std::string& warning : warnings) line.warning(warning);
}

/// Writes the exports. `points` in mm; `file` is the name used in messages.
inline void writeExports(CommandLine& line, const SolverExports& exports, const ElementMeshFile& content,
                         const Points& points, const std::string& file)
{
  if (exports.files.empty()) return;
  const SolidMesh solid = solidMeshOf(content, points, file);
  FiniteElementOptions options;
  options.nodes = exports.nodes;
  options.materials = exports.materials;
  const FiniteElementModel model = inUnits(finiteElementModel(solid, options), exports.units);
  for (const std::string& name : exports.files)
    exportModel(model, name, [&](const std::string& finalPath) { return line.outputPath(finalPath); });
}

} // namespace surgicalmesher
