// SPDX-License-Identifier: Apache-2.0
#include "SampleTolerances.h"

#include "BoundaryFaces.h"
#include "Parallel.h"

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{

namespace
{

/// Returns the labels of the two voxels whose common face has its centre at p.
std::array<Label, 2> labelsBeside(const TissueMap& map, const Vec3& p)
{
  std::array<std::array<int, 3>, 2> voxels;
  for (int a = 0; a < 3; ++a)
  {
    const double at = p[a] / map.grid.spacing[a];
    voxels[0][a] = int(std::lround(at - 0.01));
    voxels[1][a] = int(std::lround(at + 0.01));
  }
  return { labelAt(map, voxels[0]), labelAt(map, voxels[1]) };
}

/// Returns the number of voxel faces between two labels inside the map.
std::size_t boundaryFaces(const TissueMap& map)
{
  return sumOverBoundarySlices<std::size_t>(map,
                                            [&](int k)
                                            {
                                              std::size_t count = 0;
                                              forEachBoundaryFace(map, k,
                                                                  [&](const VoxelFace& face) {
                                                                    count += isInside(map.grid, face.lower) &&
                                                                             isInside(map.grid, face.upper());
                                                                  });
                                              return count;
                                            });
}

/// Returns the share of the usual tolerance that a map allows. The number of voxels that a drift of the surfaces puts
/// into wrong tissues is their area times the drift, so that a large map with closely spaced surfaces must have smaller
/// drifts. In a small map, surfaces are closely spaced because its bodies are small.
double roomIn(const TissueMap& map)
{
  constexpr std::size_t large = 600000; // faces between tissues
  constexpr double usual = 3.0;         // tissue voxels per face
  const std::size_t faces = boundaryFaces(map);
  if (faces < large) return 1;
  const auto tissue = std::count_if(map.labels.begin(), map.labels.end(), [](Label l) { return l != 0; });
  const double ratio = double(tissue) / (usual * double(faces));
  return std::clamp(ratio * ratio, 0.5, 1.0);
}

/// Returns how far the boundary of each tissue may drift, mm: a drift that is invisible on a thick tissue takes a third
/// of the volume of a thin one. Thin tissues that simplification has kept are held less closely, since other features
/// of that size have been removed.
std::map<Label, double> mostDrifts(const std::map<Label, double>& thickness, double voxel,
                                   const FeatureOptions& features)
{
  constexpr double share = 0.28, perScale = 0.08, most = 0.4; // of the thickness
  std::map<Label, double> result;
  for (const auto& [label, mm] : thickness)
  {
    const double scale = features.protectedLabels.count(label) ? 0 : features.featureScale;
    result[label] = std::max(0.6 * voxel, std::min(share + perScale * scale, most) * mm);
  }
  return result;
}

/// Returns the proximity, interpolated in L between `shortest` and `longest`.
double proximityAt(double length, const ToleranceOptions& options)
{
  const double range = options.longest - options.shortest;
  const double share = range > 0 ? std::clamp((length - options.shortest) / range, 0., 1.) : 0;
  return options.proximity.near + share * (options.proximity.far - options.proximity.near);
}

} // namespace

void setTolerances(BackgroundMesh& background, const TissueMap& map, const std::map<Label, double>& thickness,
                   const SizingFunction& length, const ToleranceOptions& options)
{
  const double voxel = map.grid.largestSpacing(), room = roomIn(map), bound = options.maximumDistance;
  const std::map<Label, double> drifts = mostDrifts(thickness, map.grid.largestSpacing(), options.features);
  const double ofVoxel = options.isSmooth ? 0.24 : 0.42; // the steps of voxels alone take up most of the latter
  // Without roughness to follow, a closer fit needs no more tetrahedra.
  const double ofLength = options.isSmooth ? 0.053 : 0.095;
  // Takes effect where L is eight voxels or more: finer maps do not give finer meshes.
  const double ofLengthAlone = options.isSmooth ? 0.085 : 0;
  constexpr double mostAlone = 2; // voxels; beyond this, ends of tissues hang by single tetrahedra
  const auto usual = [&](double at)
  { return std::max(ofVoxel * voxel + ofLength * at, std::min(ofLengthAlone * at, mostAlone * voxel)); };
  parallelFor(background.samples.size(),
              [&](std::size_t n)
              {
                auto& sample = background.samples[n];
                const double at = length(sample.position);
                double tolerance = options.proximity.isAsked() ? proximityAt(at, options) : room * usual(at);
                for (const Label label : labelsBeside(map, sample.position))
                  if (label != 0) tolerance = std::min(tolerance, drifts.at(label));
                sample.tolerance = float(bound > 0 ? std::min(tolerance, bound) : tolerance);
              });
}

} // namespace surgicalmesher
