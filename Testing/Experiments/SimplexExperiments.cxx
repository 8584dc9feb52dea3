// SPDX-License-Identifier: Apache-2.0
// The surface experiments of Audette et al. 2007 (figures 5 to 8), on the surface alone: dense boundary, decimation by
// vtkDecimatePro, simplex mesh adapted to a scale; and vtkDecimatePro down to as many faces, for comparison.
//
//   SimplexExperiments FOLDER TEMPLATES [NAME]...
//
// FOLDER receives surfaces, simplex meshes, the evolution of each and table.csv; TEMPLATES holds mricron's atlases.
// NAMEs choose among cube, brain, tubes and path.

#include "Distance.h"
#include "Errors.h"
#include "MapPreparation.h"
#include "MeshChecks.h"
#include "MeshIO.h"
#include "MeshQuality.h"
#include "SimplexDeformation.h"
#include "TextFile.h"
#include "TissueMapIO.h"
#include "VoxelMesh.h"

#include <vtkCellArray.h>
#include <vtkDecimatePro.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <ctime>
#include <iostream>
#include <set>
#include <sstream>

using namespace surgicalmesher;

namespace
{

/// L = low up to `inner` mm from the target, then rising towards `high` over `decay` mm (Audette et al. 2007, eq. 1).
struct Rise
{
  double low, high, inner, decay;
  double operator()(double d) const
  {
    return d <= inner ? low : low + (high - low) * (1 - std::exp(-(d - inner) / decay));
  }
};

struct Experiment
{
  std::string name;
  TissueMap map;
  std::function<double(const Vec3&)> distance; ///< to the target, mm, in the grid frame
  Rise edgeLength, proximity;
  std::size_t facesBefore = 0; ///< to begin with; 0: the dense surface itself
};

SurfaceComplex decimated(const SurfaceComplex& surface, std::size_t faces)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& p : surface.points) points->InsertNextPoint(p.x, p.y, p.z);
  vtkNew<vtkCellArray> cells;
  for (const auto& [a, b, c] : surface.triangles) cells->InsertNextCell({ a, b, c });
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(cells);
  vtkNew<vtkDecimatePro> filter;
  filter->SetInputData(data);
  filter->PreserveTopologyOn();
  filter->SetFeatureAngle(30); // at its default of 15 it stops early
  filter->SetTargetReduction(1 - double(faces) / double(surface.points.size()));
  filter->Update();
  vtkPolyData* output = filter->GetOutput();
  SurfaceComplex result;
  for (vtkIdType p = 0; p < output->GetNumberOfPoints(); ++p)
  {
    result.points.emplace_back();
    output->GetPoint(p, &result.points.back().x);
  }
  for (vtkIdType c = 0; c < output->GetNumberOfPolys(); ++c)
  {
    vtkIdType size;
    const vtkIdType* ids;
    output->GetPolys()->GetCellAtId(c, size, ids);
    result.triangles.push_back({ int(ids[0]), int(ids[1]), int(ids[2]) });
  }
  result.labels.assign(result.triangles.size(), surface.labels[0]);
  return result;
}

bool sound(const SurfaceComplex& surface)
{
  const auto tissues = checkSurface(surface);
  return std::all_of(tissues.begin(), tissues.end(), [](const auto& tissue) { return tissue.second.manifold(); });
}

/// By vtkDecimatePro, or, where that stops early or leaves edges of four triangles, by the operators at one length
/// everywhere.
SurfaceComplex startOf(const SurfaceComplex& dense, const TissueBoundary& boundary, OperatorLimits limits,
                       std::size_t faces)
{
  SurfaceComplex start = decimated(dense, faces);
  if (double(start.points.size()) < 1.05 * double(faces) && sound(start)) return start;
  double area = 0;
  for (const auto& [a, b, c] : dense.triangles)
    area += 0.5 * norm(cross(dense.points[b] - dense.points[a], dense.points[c] - dense.points[a]));
  const double length = std::sqrt(area / (0.5 * std::sqrt(3.) * double(faces)));
  limits.edgeLength = [=](const Vec3&) { return length; };
  AdaptationOptions options;
  options.mostIterations = 4;
  options.mostFusions = 1;
  SimplexOperators mesh(dense, boundary, limits);
  adaptSimplexMesh(mesh, boundary, options);
  return mesh.surface();
}

double triangleAngle(const Vec3& at, const Vec3& b, const Vec3& c)
{
  return std::atan2(norm(cross(b - at, c - at)), dot(b - at, c - at)) * 180 / std::acos(-1.);
}

/// Pairs of triangles that cross, by the conservative test of the operators.
std::size_t crossings(const SurfaceComplex& surface)
{
  double mean = 0;
  for (const auto& [a, b, c] : surface.triangles) mean += norm(surface.points[a] - surface.points[b]);
  BoxGrid grid(mean / double(surface.triangles.size()));
  std::vector<CornerTriangle> shapes;
  std::vector<Box> boxes;
  for (const auto& t : surface.triangles)
  {
    shapes.push_back({ { surface.points[t[0]], surface.points[t[1]], surface.points[t[2]] }, t });
    boxes.push_back(Box::around(surface.points[t[0]]));
    boxes.back().add(surface.points[t[1]]);
    boxes.back().add(surface.points[t[2]]);
  }
  std::size_t count = 0;
  for (std::size_t t = 0; t < shapes.size(); ++t)
  {
    std::set<std::int32_t> near;
    grid.visit(boxes[t], [&](std::int32_t s) { return near.insert(s), true; });
    count +=
      std::count_if(near.begin(), near.end(), [&](std::int32_t s) { return trianglesCross(shapes[t], shapes[s]); });
    grid.insert(std::int32_t(t), boxes[t]);
  }
  return count;
}

/// Tissues that are not manifold or of another topology than wanted.
int wrongTissues(const std::map<Label, TissueSurface>& tissues, const std::map<Label, TissueSurface>& wanted)
{
  int wrong = 0;
  for (const auto& [label, tissue] : wanted)
  {
    const auto at = tissues.find(label);
    wrong += at == tissues.end() || !at->second.manifold() || at->second.euler != tissue.euler;
  }
  return wrong;
}

/// One row of the table: how good a surface is against the dense boundary and the scale asked for.
std::string rowOf(const Experiment& experiment, const std::string& what, const SurfaceComplex& surface,
                  const SurfaceComplex& dense, double seconds)
{
  const TissueBoundary boundary(dense, 25), mesh(surface, 25);
  std::vector<double> out, back, near, angles, ratios;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const auto& [a, b, c] = surface.triangles[t];
    const Vec3 p = surface.points[a], q = surface.points[b], r = surface.points[c];
    const auto nearest = boundary.nearest((p + q + r) / 3, surface.labels[t]);
    out.push_back(nearest ? nearest->distance : 25);
    angles.push_back(std::min({ triangleAngle(p, q, r), triangleAngle(q, r, p), triangleAngle(r, p, q) }));
    for (const auto& [from, to] : { std::pair{ p, q }, { q, r }, { r, p } })
      ratios.push_back(norm(from - to) / experiment.edgeLength(experiment.distance(0.5 * (from + to))));
  }
  for (std::size_t t = 0; t < dense.triangles.size(); ++t)
  {
    const auto& [a, b, c] = dense.triangles[t];
    const Vec3 p = (dense.points[a] + dense.points[b] + dense.points[c]) / 3;
    const auto nearest = mesh.nearest(p, dense.labels[t]);
    back.push_back(nearest ? nearest->distance : 25);
    if (experiment.distance(p) < experiment.edgeLength.inner) near.push_back(back.back());
  }
  const auto tissues = checkSurface(surface), wanted = checkSurface(dense);
  double worstVolume = 0;
  for (const auto& [label, tissue] : wanted)
    worstVolume =
      std::max(worstVolume, tissues.count(label) ? std::abs(tissues.at(label).volume / tissue.volume - 1) : 1.);
  const double good = double(std::count_if(ratios.begin(), ratios.end(), [](double x) { return x > 0.7 && x < 1.4; })) /
                      double(ratios.size());
  const Distribution angle = distributionOf(angles), outward = distributionOf(out), backward = distributionOf(back),
                     child = distributionOf(near);
  std::ostringstream row;
  row << experiment.name << ',' << what << ',' << surface.points.size() << ',' << surface.triangles.size() << ','
      << outward.mean << ',' << outward.maximum << ',' << backward.mean << ',' << backward.maximum << ',' << child.mean
      << ',' << child.maximum << ',' << angle.minimum << ',' << angle.percentile1 << ',' << angle.mean << ',' << good
      << ',' << wrongTissues(tissues, wanted) << ',' << crossings(surface) << ',' << worstVolume << ',' << seconds;
  return row.str();
}

constexpr const char* columns =
  "experiment,surface,faces,triangles,outMean,outMaximum,backMean,backMaximum,childMean,childMaximum,angleMinimum,"
  "anglePercentile1,angleMean,edgesNearTarget,wrongTissues,crossings,volumeError,seconds";

void writeResult(const SurfaceComplex& surface, const Experiment& experiment, const std::string& path)
{
  SurfaceFile content;
  content.surface = surface;
  const TissueBoundary boundary(smoothedBoundary(experiment.map), 10);
  std::vector<double> distance(surface.points.size(), 0);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (std::int32_t p : surface.triangles[t])
    {
      const auto nearest = boundary.nearest(surface.points[p], surface.labels[t]);
      distance[p] = std::max(distance[p], nearest ? nearest->distance : boundary.reach());
    }
  content.boundaryDistance = distance;
  for (const Vec3& p : surface.points)
    content.targetEdgeLength.push_back(experiment.edgeLength(experiment.distance(p)));
  writeSurface(content, path + ".vtp");
  if (!sound(surface)) return;
  const SimplexMesh mesh = simplexMeshOf(surface);
  PolygonFile polygons;
  polygons.points = mesh.points;
  for (SimplexFace& face : simplexFaces(mesh))
  {
    polygons.polygons.push_back(std::move(face.vertices));
    polygons.labels.push_back(face.tissue);
  }
  writePolygons(polygons, path + "-simplex.vtp");
}

void perform(const Experiment& experiment, const std::string& folder, std::string& table)
{
  const SurfaceComplex dense = smoothedBoundary(experiment.map);
  const TissueBoundary boundary(dense, 10);
  OperatorLimits limits;
  limits.edgeLength = [&](const Vec3& p) { return experiment.edgeLength(experiment.distance(p)); };
  limits.proximity = [&](const Vec3& p) { return experiment.proximity(experiment.distance(p)); };
  const SurfaceComplex before =
    experiment.facesBefore > 0 ? startOf(dense, boundary, limits, experiment.facesBefore) : dense;
  std::cout << experiment.name << ": " << dense.points.size() << " faces, " << std::flush;
  const std::clock_t start = std::clock();
  SimplexOperators mesh(before, boundary, limits);
  const std::vector<SimplexStep> steps = adaptSimplexMesh(mesh, boundary, {});
  const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
  const SurfaceComplex after = mesh.surface();
  const std::string path = folder + "/" + experiment.name;
  writeBytes(evolutionCSV(steps), path + "-evolution.csv");
  writeResult(dense, experiment, path + "-dense");
  writeResult(before, experiment, path + "-before");
  writeResult(after, experiment, path + "-after");
  const auto add = [&](const std::string& what, const SurfaceComplex& surface, double time)
  { table += rowOf(experiment, what, surface, dense, time) + "\n"; };
  add("dense", dense, 0);
  if (experiment.facesBefore > 0)
  {
    const SurfaceComplex other = decimated(dense, after.points.size());
    writeResult(other, experiment, path + "-decimated");
    add("to begin with", before, 0);
    add("vtkDecimatePro", other, 0);
  }
  add("simplex", after, seconds);
  std::cout << steps.front().faces << " to " << after.points.size() << " faces in " << seconds << " s of processor time"
            << std::endl;
}

/// Well-composed, without islands and pockets below `volume` mm^3, in the grid's own frame.
TissueMap prepared(TissueMap map, double volume = 0)
{
  PreparationOptions options;
  options.minimumIslandVolume = options.minimumCavityVolume = volume;
  prepareMap(map, options);
  map.grid = inOwnFrame(map.grid);
  return map;
}

/// A hollow cube with two openings along x and two along y, and a hemispherical gland under its inner ceiling.
Experiment invaginatedCube()
{
  const auto paint = [](int i, int j, int k)
  {
    const double x = i - 31.5, y = j - 31.5, z = k - 31.5;
    const double outer = std::max({ std::abs(x), std::abs(y), std::abs(z) });
    const bool gland = z < 16 && x * x + y * y + (z - 16) * (z - 16) < 64;
    const bool opening = z * z + std::min(x * x, y * y) < 49;
    return gland || (outer < 24 && outer > 16 && !opening) ? 1 : 0;
  };
  const Vec3 target{ 31.5, 31.5, 47.5 - 4 };
  return { "cube",
           prepared(test::paintedMap({ 64, 64, 64 }, paint)),
           [=](const Vec3& p) { return norm(p - target); },
           { 2, 11.5, 10, 20 },
           { 0.4, 2.5, 10, 20 },
           1224 };
}

/// The outside of the brain: all tissues of the JHU atlas as one, dense around the pituitary gland.
Experiment brain(const std::string& templates)
{
  TissueMap map = everyNth(readTissueMap(templates + "/jhu189.nii.gz"), 3);
  for (Label& label : map.labels) label = label != 0;
  const Vec3 target = map.grid.worldToGrid({ 0, 0, -10 });
  return { "brain",
           prepared(map, 1e4),
           [=](const Vec3& p) { return norm(p - target); },
           { 4, 12.5, 10, 35 },
           { 1.5, 4, 10, 35 },
           2618 };
}

/// A forked artery and two nerves that cross, at constant density.
Experiment tubes()
{
  const std::vector<std::array<Vec3, 2>> artery{ { Vec3{ 24, 20, 4 }, { 24, 22, 26 } },
                                                 { Vec3{ 24, 22, 26 }, { 12, 26, 44 } },
                                                 { Vec3{ 24, 22, 26 }, { 37, 25, 44 } } };
  const std::vector<std::array<Vec3, 2>> nerves{ { Vec3{ 8, 44, 8 }, { 24, 38, 24 } },
                                                 { Vec3{ 40, 44, 8 }, { 24, 38, 24 } },
                                                 { Vec3{ 24, 38, 24 }, { 10, 40, 42 } },
                                                 { Vec3{ 24, 38, 24 }, { 38, 40, 42 } } };
  const auto within = [](const Vec3& p, const auto& segments, double radius)
  {
    return std::any_of(segments.begin(), segments.end(),
                       [&](const auto& s) { return distanceToSegment(p, s[0], s[1]) < radius; });
  };
  const auto paint = [&](int i, int j, int k)
  {
    const Vec3 p{ double(i), double(j), double(k) };
    return within(p, artery, 3) ? 1 : within(p, nerves, 2.2) ? 2 : 0;
  };
  return { "tubes",
           prepared(test::paintedMap({ 48, 56, 48 }, paint)),
           [](const Vec3&) { return 0.; },
           { 2, 2, 1, 1 },
           { 0.4, 0.4, 1, 1 } };
}

/// A phantom of head and brain, dense along a path through the nose to the pituitary gland. What of the head is both
/// more than 10 mm from the path and more than 25 mm from its end is tissue of null displacement (label 3).
Experiment path()
{
  constexpr double voxel = 3;
  const Vec3 nose{ 84, 6, 66 }, gland{ 84, 92, 84 };
  const auto within = [](const Vec3& p, const Vec3& centre, const Vec3& axes)
  {
    const Vec3 d = p - centre;
    return d.x * d.x / (axes.x * axes.x) + d.y * d.y / (axes.y * axes.y) + d.z * d.z / (axes.z * axes.z) < 1;
  };
  const auto paint = [=](int i, int j, int k)
  {
    const Vec3 p{ i * voxel, j * voxel, k * voxel };
    if (within(p, { 84, 108, 114 }, { 60, 78, 54 })) return 2;
    if (!within(p, { 84, 102, 90 }, { 78, 96, 84 })) return 0;
    return distanceToSegment(p, nose, gland) > 10 && norm(p - gland) > 25 ? 3 : 1;
  };
  return { "path",
           prepared(test::paintedMap({ 56, 68, 60 }, paint, { voxel, voxel, voxel }), 1e3),
           [=](const Vec3& p) { return distanceToSegment(p, nose, gland); },
           { 4, 18, 10, 30 },
           { 1.5, 5, 10, 30 } };
}

} // namespace

int main(int argc, char** argv)
{
  if (argc < 3)
  {
    std::cerr << "usage: SimplexExperiments FOLDER TEMPLATES [NAME]...\n";
    return 2;
  }
  try
  {
    const std::string folder = argv[1], templates = argv[2];
    std::string table = std::string(columns) + "\n";
    const std::set<std::string> names(argv + 3, argv + argc);
    const auto wanted = [&](const std::string& name) { return names.empty() || names.count(name) > 0; };
    if (wanted("cube")) perform(invaginatedCube(), folder, table);
    if (wanted("brain")) perform(brain(templates), folder, table);
    if (wanted("tubes")) perform(tubes(), folder, table);
    if (wanted("path")) perform(path(), folder, table);
    writeBytes(table, folder + "/table.csv");
  }
  catch (const Error& error)
  {
    std::cerr << error.what() << "\n";
    return error.exitStatus();
  }
  return 0;
}
