// SPDX-License-Identifier: Apache-2.0
#include "CurveFiles.h"

#include "MeshIO.h"
#include "Text.h"
#include "TissueMapIO.h"

#include <filesystem>

namespace surgicalmesher
{

namespace
{

std::vector<Polyline> polylinesOfMarkups(const std::string& file)
{
  std::vector<Polyline> lines;
  for (const Markup& markup : readLabelledMarkups(file))
  {
    const auto radius = markup.pointValues.find("Radius");
    lines.push_back({ markup.points, radius == markup.pointValues.end() ? std::vector<double>() : radius->second });
  }
  return lines;
}

} // namespace

std::vector<Curve> readCurves(const std::string& file, double missingRadius)
{
  const std::string extension = text::extensionOf(file);
  const std::string name = std::filesystem::path(file).filename().string();
  const bool isVtk = extension == ".vtp" || extension == ".vtk";
  std::vector<Polyline> lines = isVtk ? readPolylines(file) : polylinesOfMarkups(file);
  std::vector<Curve> curves;
  for (Polyline& line : lines)
  {
    const std::string number = lines.size() > 1 ? " " + std::to_string(curves.size() + 1) : "";
    if (line.radii.empty()) line.radii.assign(line.points.size(), missingRadius);
    for (double& radius : line.radii) radius = radius > 0 ? radius : missingRadius;
    curves.push_back({ name.substr(0, name.find('.')) + number, number.empty() ? file : file + ", curve" + number,
                       std::move(line.points), std::move(line.radii) });
  }
  return curves;
}

} // namespace surgicalmesher
