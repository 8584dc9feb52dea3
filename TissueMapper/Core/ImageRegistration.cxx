// SPDX-License-Identifier: Apache-2.0
#include "ImageRegistration.h"

#include "RegistrationPoses.h"
#include "RegistrationSamples.h"
#include "Sampling.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{

namespace
{

/// Refines rotation, shift and scale from coarse images on finer ones. `start` is only compared with the result.
void refineGlobally(const std::vector<Level>& levels, const PoseSearch& search, const LinearParameters& start,
                    LinearParameters pose, Registration& result)
{
  const Extent& extent = search.extent();
  const LinearParameters first = pose;
  double overlap = 0;
  for (const Level& level : levels)
  {
    MutualInformation information = level.information(extent.centre);
    result.globalInformationBefore = information.at(start);
    pose = information.maximise(similaritiesFrom(pose, extent.radius), 7);
    result.globalInformation = information.at(pose);
    overlap = information.overlap();
  }
  if (overlap < 0.2)
    failToConverge(std::to_string(std::lround(100 * overlap)) + " % of the fixed image meets the moving one");
  const double moved = search.distance(first, pose);
  if (moved > 10)
    failToConverge("fine images lead " + std::to_string(std::lround(moved)) + " mm away from coarse ones");
  result.scale = scaleOf(pose);
  if (result.scale < 0.75 || result.scale > 1.33) failToConverge("the scale is " + std::to_string(result.scale));
  result.global = mapOf(pose, extent.centre);
}

/// Refines all twelve parameters with samples around the target.
void refineAround(const std::vector<Level>& levels, const Extent& extent, Registration& result)
{
  Matrix3 matrix;
  for (unsigned n = 0; n < 9; ++n) matrix(n / 3, n % 3) = result.global.rows[n / 3][int(n % 3)];
  const LinearParameters start = withMatrix(matrix, result.global(extent.centre) - extent.centre);
  LinearParameters parameters = start;
  for (const Level& level : levels)
  {
    MutualInformation information = level.information(extent.centre);
    result.targetInformationBefore = information.at(start);
    parameters = information.maximise(linearMapsFrom(parameters, extent.radius), 12);
    result.targetInformation = information.at(parameters);
  }
  result.local = mapOf(parameters, extent.centre);
  const double moved = distanceBetween(result.global, *result.local, extent);
  if (moved > 15)
    failToConverge("around the target it leads " + std::to_string(std::lround(moved)) +
                   " mm away from the pose of all");
}

} // namespace

Registration registerImages(const ScalarImage& fixed, const ScalarImage& moving, const RegistrationOptions& options,
                            const Progress& progress)
{
  const SingleThread oneOfItk;
  report(progress, 0, "coarse images");
  const ItkImage::Pointer fineFixed = withoutExtremes(fixed, "fixed");
  const ItkImage::Pointer fineMoving = withoutExtremes(moving, "moving");
  const auto level = [&](double spacing, const std::vector<Vec3>& samples)
  { return levelOf(fineFixed, fineMoving, spacing, samples); };
  const std::vector<Vec3> few = samplesEverywhere(fixed.grid, options.mask, 4000);
  const PoseSearch search(level(5, few), extentOf(few));

  report(progress, 0.1, "starts");
  std::vector<Pose> poses = startingPoses(options, search);
  Registration result;
  const Pose start = poses.front();
  result.startInformation = start.information;
  search.follow(poses);
  const Pose found = search.best(poses, 1, 0).front();
  report(progress, 0.3, "convergence");
  const Agreement agreement = requireThatItConverges(search, found, poses);
  result.agreeingStarts = agreement.count;
  result.otherStarts = agreement.of;

  report(progress, 0.5, "all");
  const std::vector<Vec3> more = samplesEverywhere(fixed.grid, options.mask, 40000);
  refineGlobally({ level(2, more), level(1, more) }, search, start.parameters, found.parameters, result);
  if (!options.target) return result;
  report(progress, 0.75, "around the target");
  const Sphere& target = *options.target;
  const std::vector<Vec3> around = samplesAround(fixed.grid, options.mask, target.centre, 0.5 * target.radius, 40000);
  refineAround({ level(2, around), level(1, around) }, extentOf(around), result);
  return result;
}

ScalarImage resampled(const ScalarImage& moving, const LinearMap& map, const Grid& grid)
{
  ScalarImage result;
  result.grid = grid;
  result.values.assign(grid.voxelCount(), *std::min_element(moving.values.begin(), moving.values.end()));
  const auto fillSlices = [&](vtkIdType first, vtkIdType last)
  {
    for (int k = int(first); k < int(last); ++k)
      for (int j = 0; j < grid.size[1]; ++j)
        for (int i = 0; i < grid.size[0]; ++i)
        {
          const Vec3 p = moving.grid.worldToGrid(map(grid.gridToWorld(grid.position(i, j, k))));
          if (isInVolume(moving.grid, p))
            result.values[grid.index(i, j, k)] = float(linearValue(moving.grid, moving.values, p));
        }
  };
  vtkSMPTools::For(0, grid.size[2], fillSlices);
  return result;
}

} // namespace surgicalmesher
