// SPDX-License-Identifier: Apache-2.0
// TetGen inside a surface of ours or of CGAL's, to measure against: the usual way from a label map to tetrahedra in two
// steps.
//
// usage: TetGenDriver SURFACE.vtp|MESH.vtu SCALE.nrrd OUT.vtu
//
// SURFACE.vtp is what SimplexMesherCLI leaves. MESH.vtu is what Mesh3Driver leaves without --perturb and --exude; the
// faces between its tissues are the surface, and nothing else of it is used. TetGen's own quality refinement (-q) with
// L at the surface's points for its sizes (-m). Prints one JSON object: seconds of each phase, sizes, peak memory.

#include "Driver.h"
#include "Errors.h"
#include "FaceAdjacency.h"
#include "MeshIO.h"
#include "TissueMapIO.h"

#include <tetgen.h>

#include <algorithm>
#include <iostream>
#include <map>

using namespace surgicalmesher;

namespace
{

using Triangle = std::array<std::int32_t, 3>;

Triangle ascending(Triangle t)
{
  std::sort(t.begin(), t.end());
  return t;
}

/// tetgenio frees with delete[] what it is given. Markers are the triangles' numbers from 1; 0 marks no facet.
void fillInput(const SurfaceComplex& surface, const ScaleField& scale, tetgenio& input)
{
  input.numberofpoints = static_cast<int>(surface.points.size());
  input.numberofpointmtrs = 1;
  input.pointlist = new double[3 * surface.points.size()];
  input.pointmtrlist = new double[surface.points.size()];
  for (std::size_t i = 0; i < surface.points.size(); ++i)
  {
    for (int axis = 0; axis < 3; ++axis) input.pointlist[3 * i + axis] = surface.points[i][axis];
    input.pointmtrlist[i] = scale(surface.points[i]);
  }
  input.numberoffacets = static_cast<int>(surface.triangles.size());
  input.facetlist = new tetgenio::facet[surface.triangles.size()];
  input.facetmarkerlist = new int[surface.triangles.size()];
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    tetgenio::facet& facet = input.facetlist[t];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    facet.polygonlist[0].numberofvertices = 3;
    facet.polygonlist[0].vertexlist = new int[3];
    std::copy(surface.triangles[t].begin(), surface.triangles[t].end(), facet.polygonlist[0].vertexlist);
    input.facetmarkerlist[t] = static_cast<int>(t) + 1;
  }
}

void runTetGen(tetgenio& input, tetgenio& output)
{
  std::string switches = "pqmMQ";
  try
  {
    ::tetrahedralize(switches.data(), &input, &output);
  }
  catch (const int code)
  {
    throw EngineError("TetGen gave up with code " + std::to_string(code));
  }
}

TetMesh meshOf(const tetgenio& output)
{
  TetMesh mesh;
  for (int i = 0; i < output.numberofpoints; ++i)
  {
    mesh.points.push_back({ output.pointlist[3 * i], output.pointlist[3 * i + 1], output.pointlist[3 * i + 2] });
  }
  for (int t = 0; t < output.numberoftetrahedra; ++t)
  {
    std::array<std::int32_t, 4> ids;
    std::copy_n(output.tetrahedronlist + output.numberofcorners * t, 4, ids.begin());
    if (orient(mesh.points[ids[0]], mesh.points[ids[1]], mesh.points[ids[2]], mesh.points[ids[3]]) < 0)
      std::swap(ids[0], ids[1]);
    mesh.tetrahedra.push_back(ids);
  }
  return mesh;
}

/// Number from 0 of the surface's triangle that each face of TetGen's on it is part of.
std::map<Triangle, std::int32_t> facesOnSurface(const tetgenio& output)
{
  std::map<Triangle, std::int32_t> result;
  for (int f = 0; f < output.numberoftrifaces; ++f)
  {
    const int* ids = output.trifacelist + 3 * f;
    const int marker = output.trifacemarkerlist[f];
    if (marker > 0) result[ascending({ ids[0], ids[1], ids[2] })] = marker - 1;
  }
  return result;
}

Vec3 normalOf(const std::vector<Vec3>& points, const Triangle& t)
{
  return cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]);
}

/// Each region between triangles takes the label that most of its faces ask for.
void labelRegions(const SurfaceComplex& surface, const std::map<Triangle, std::int32_t>& onSurface, TetMesh& mesh)
{
  const auto faceOf = [&](std::size_t t, int f)
  {
    Triangle face;
    for (int c = 0; c < 3; ++c) face[c] = mesh.tetrahedra[t][kFaceCorners[f][c]];
    return face;
  };
  const std::vector<std::int32_t> region = faceRegions(faceAdjacency(mesh), [&](std::int32_t t, int f)
                                                       { return onSurface.count(ascending(faceOf(t, f))) == 0; });
  std::map<std::int32_t, std::map<Label, int>> votes;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    for (int f = 0; f < 4; ++f)
    {
      const auto found = onSurface.find(ascending(faceOf(t, f)));
      if (found == onSurface.end()) continue;
      const Vec3 outward = normalOf(mesh.points, faceOf(t, f));
      const bool behind = dot(outward, normalOf(surface.points, surface.triangles[found->second])) > 0;
      ++votes[region[t]][surface.labels[found->second][behind ? 0 : 1]];
    }
  }
  for (const std::int32_t r : region)
  {
    const auto& of = votes[r];
    const auto most =
      std::max_element(of.begin(), of.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    mesh.labels.push_back(most == of.end() ? Label(0) : most->first);
  }
}

/// The surface and its tissues, from a file of either kind.
std::pair<SurfaceComplex, TissueTable> readInput(const std::string& name)
{
  if (name.size() > 4 && name.substr(name.size() - 4) == ".vtp")
  {
    const SurfaceFile file = readSurface(name);
    if (file.surface.labels.empty()) throw InputError(name + ": no BoundaryLabels, expected a surface of all tissues");
    return { file.surface, file.tissues };
  }
  const MeshFile file = readMesh(name);
  return { interfaceOf(file.mesh), file.tissues };
}

void run(const std::string& surfaceFile, const std::string& scaleFile, const std::string& meshFile)
{
  Stopwatch stopwatch;
  const auto [surface, tissues] = readInput(surfaceFile);
  const ScaleField scale = readScale(scaleFile);
  stopwatch.lap("read");
  tetgenio input, output;
  fillInput(surface, scale, input);
  runTetGen(input, output);
  TetMesh mesh = meshOf(output);
  labelRegions(surface, facesOnSurface(output), mesh);
  stopwatch.lap("TetGen");
  MeshFile file;
  file.mesh = withoutOutside(mesh);
  file.tissues = tissues;
  writeMesh(file, meshFile);
  stopwatch.lap("write");
  std::cout << runJSON("TetGen 1.5", stopwatch, file.mesh.points.size(), file.mesh.tetrahedra.size()) << '\n';
}

} // namespace

int main(int argc, char** argv)
{
  return runDriver(
    [&]
    {
      if (argc != 4) throw UsageError("usage: TetGenDriver SURFACE.vtp|MESH.vtu SCALE.nrrd OUT.vtu");
      run(argv[1], argv[2], argv[3]);
    });
}
