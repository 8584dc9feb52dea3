// SPDX-License-Identifier: Apache-2.0
// surgicalmesher convert: exports a tetrahedral mesh in the formats of solvers.

#include "Commands.h"
#include "CurvedSides.h"
#include "Errors.h"
#include "Export.h"
#include "MaterialTable.h"
#include "NodeChoices.h"
#include "SecondOrder.h"
#include "ShellChoices.h"
#include "Units.h"

#include <set>

namespace surgicalmesher
{

namespace
{

FiniteElementOptions readOptions(CommandLine& line, const MeshFile& content)
{
  const std::set<Label> present(content.mesh.labels.begin(), content.mesh.labels.end());
  FiniteElementOptions options;
  const std::string materials = line.text("materials");
  std::vector<std::string> warnings;
  if (!materials.empty()) options.materials = readMaterialTable(materials, content.tissues, present, &warnings);
  for (const std::string& warning : warnings) line.warning(warning);
  options.shells = shellChoices(line.texts("shell"), content.tissues, present, line.number("shellThickness"));
  options.nodes = nodeChoices(line.texts("nodeSet"), line.texts("nodeMarkups"));
  return options;
}

} // namespace

void convertCommand(CommandLine& line)
{
  const std::vector<std::string> files = line.outputNames("models");
  if (line.flag("curvedSides") && line.integer("elementOrder") != 2)
    throw UsageError("--curvedSides is given, but not --elementOrder 2, expected both");
  for (const std::string& file : files)
  {
    requireOrder(file, line.integer("elementOrder"));
    for (const ExportSidecar& sidecar : exportSidecars(file))
    {
      if (sidecar.isMany) line.alsoWritesMany("models", sidecar.before, sidecar.after);
      else line.alsoWrites("models", sidecar.before);
    }
  }
  const Progress progress = line.progress();
  report(progress, 0, "reading");
  const MeshFile content = readMesh(line.text("mesh"));
  for (const Label label : content.mesh.labels)
  {
    if (label == 0)
      throw InputError(line.text("mesh") + ": tetrahedra of label 0 found, those of tissues alone expected");
  }
  FiniteElementModel model = finiteElementModel(content, readOptions(line, content));
  if (line.integer("elementOrder") == 2) model = withMidSideNodes(std::move(model));
  if (line.flag("curvedSides")) model = withCurvedSides(std::move(model));
  model = inUnits(std::move(model), unitsNamed(line.text("units")));
  double done = 0;
  for (const std::string& file : files)
  {
    report(progress, 0.3 + 0.7 * done++ / double(files.size()), file);
    exportModel(model, file, [&](const std::string& finalPath) { return line.outputPath(finalPath); });
  }
  report(progress, 1, "done");
}

} // namespace surgicalmesher
