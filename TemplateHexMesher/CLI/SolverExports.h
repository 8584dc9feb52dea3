// SPDX-License-Identifier: Apache-2.0
#pragma once
/// --export and --materials of both programs.

#include "CommandLine.h"
#include "Export.h"
#include "MaterialTable.h"
#include "SolidElements.h"

#include <set>

namespace surgicalmesher
{

/// What is written beside the exports; before anything is read.
inline void announceExports(CommandLine& line, const std::vector<std::string>& exports)
{
  for (const std::string& file : exports)
  {
    for (const ExportSidecar& sidecar : exportSidecars(file))
    {
      if (sidecar.isMany) line.alsoWritesMany("export", sidecar.before, sidecar.after);
      else line.alsoWrites("export", sidecar.before);
    }
  }
}

/// `points` in mm; `file` is named in messages.
inline void writeExports(CommandLine& line, const std::vector<std::string>& exports, const std::string& materials,
                         const ElementMeshFile& content, const Points& points, const std::string& file)
{
  if (exports.empty()) return;
  const SolidMesh solid = solidMeshOf(content, points, file);
  FiniteElementOptions options;
  if (!materials.empty())
    options.materials = readMaterialTable(materials, solid.tissues, { solid.labels.begin(), solid.labels.end() });
  const FiniteElementModel model = finiteElementModel(solid, options);
  for (const std::string& name : exports)
    exportModel(model, name, [&](const std::string& finalPath) { return line.outputPath(finalPath); });
}

} // namespace surgicalmesher
