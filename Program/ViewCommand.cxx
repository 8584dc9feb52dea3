// SPDX-License-Identifier: Apache-2.0
// surgicalmesher view: draws a surface or a mesh without a display.

#include "Commands.h"
#include "Errors.h"
#include "MeshViews.h"
#include "TextFile.h"

namespace surgicalmesher
{

namespace
{

Vec3 pointOr(const CommandLine& line, const std::string& name, const Vec3& otherwise)
{
  const std::vector<Vec3> points = line.points(name);
  return points.empty() ? otherwise : points.front();
}

Vec3 middleOf(const std::vector<Vec3>& points)
{
  Vec3 sum;
  for (const Vec3& p : points) sum += p;
  return sum / double(points.size());
}

std::vector<Facet> shownFacets(const CommandLine& line, const Vec3& towards)
{
  const std::string file = line.text("mesh"), part = line.text("part"), extension = text::extensionOf(file);
  const bool isMesh = extension == ".vtu" || (extension == ".vtk" && part != "all");
  if (!isMesh && part != "all")
    throw UsageError("--part " + part + " is given, but " + file +
                     " is no mesh of tetrahedra (.vtu, .vtk), expected one");
  if (!isMesh) return outerFacets(readSurface(file));
  const MeshFile content = readMesh(file);
  if (part == "cut") return cutFacets(content, pointOr(line, "cutAt", middleOf(content.mesh.points)), towards);
  if (part == "all") return facetsOf(content, [](std::size_t) { return true; });
  std::vector<Facet> child = childFacets(content);
  if (child.empty()) throw InputError(file + ": no child mesh found, expected one for --part child");
  return child;
}

} // namespace

void viewCommand(CommandLine& line)
{
  const Progress progress = line.progress();
  report(progress, 0, "reading");
  const Vec3 towards = pointOr(line, "from", line.text("part") == "cut" ? fromFront : fromFrontLeftAbove);
  if (!(norm(towards) > 0)) throw UsageError("--from: 0,0,0 found, a direction expected");
  const std::vector<Facet> facets = shownFacets(line, towards);
  report(progress, 0.4, "drawing");
  const Camera camera = cameraOn(facets, towards, line.integer("width"), line.integer("height"));
  const Image image = annotated(drawn(facets, camera, !line.flag("withoutEdges")), camera);
  writeBytes(pngOf(image), line.outputFile("picture"));
  report(progress, 1, "done");
}

} // namespace surgicalmesher
