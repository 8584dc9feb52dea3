// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Target edge length from the distance to surgical targets and paths.
///
/// With d the distance from x to the nearest target, or to the nearest segment of a path,
///
///     L(d) = Lmin                                               d <= dmin
///     L(d) = Lmin + (Lmax - Lmin) (1 - exp(-(d - dmin) / dscale))   d >  dmin
///
/// (Audette et al., Computer Aided Surgery 12(1), 2007, eq. 1 with the distance to a point or to a linearised path).
/// Alternatively, the same function gives the areas As of simplex faces (Audette et al. 2005, eq. 2), with L = sqrt(2
/// As / sqrt(3)) by their eq. 3. L is the edge length of triangles and tetrahedra. Lengths and distances in mm.

#include "Distance.h"
#include "Gradation.h"
#include "Progress.h"
#include "ScaleField.h"
#include "TissueMap.h"

#include <map>
#include <vector>

namespace surgicalmesher
{

/// Lmin and Lmax: 0 < minimum <= maximum.
struct LengthRange
{
  double minimum = 1;
  double maximum = 8;
};

/// Rise of the edge length with distance.
struct Falloff
{
  double childRadius = 10; ///< dmin >= 0
  double decayLength = 25; ///< dscale > 0
};

/// Quantity that rises exponentially between its values for Lmin and Lmax.
enum class RisingQuantity
{
  Length,
  Area ///< As, proportional to the square of L: longer edges at the same distance
};

/// Returns the edge length L, mm, of simplex faces of area As, mm^2: sqrt(2 As / sqrt(3)).
double edgeLengthOfArea(double area);

/// Returns L(d) of the formula above, for any d >= 0; Lmax at infinity.
double edgeLength(double distance, const LengthRange& range, const Falloff& falloff,
                  RisingQuantity rising = RisingQuantity::Length);

/// Lengths of a single tissue: factor * L(d), with its own range.
struct TissueLength
{
  LengthRange range;
  double factor = 1; ///< > 0
};

/// Which distances determine the length if there are both targets and paths.
enum class Combination
{
  Smaller, ///< the smaller of the two lengths
  Targets,
  Paths
};

struct SurgicalScaleOptions
{
  LengthRange range;
  Falloff targetFalloff;
  Falloff pathFalloff;
  RisingQuantity rising = RisingQuantity::Length; ///< for all ranges
  Combination combination = Combination::Smaller;
  std::map<Label, TissueLength> tissues; ///< lengths of single tissues, instead of `range`
  double gradation = 0;                  ///< limit on |grad L|, mm per mm; 0: none. See limitGradation
  double spacing = 2;                    ///< voxel size of the scale volume, mm
};

/// Throws UsageError unless every length and distance is finite and in its range, the targets or paths that
/// `combination` requires are given, and the scale volume has fewer than 2^31 voxels; InputError for a path of fewer
/// than two points.
void checkScaleOptions(const SurgicalScaleOptions& options, const Grid& map, const std::vector<Vec3>& targets,
                       const std::vector<Path>& paths);

/// Returns the grid of a scale volume: cubic voxels of size `spacing` along the axes of the map's grid, centred on the
/// map. It covers the map up to the outer faces of its voxels, with a margin of at least one scale voxel and a fifth of
/// a map voxel on every side.
Grid scaleGrid(const Grid& map, double spacing);

/// Returns L at the voxel centres of scaleGrid(map.grid, options.spacing); `targets` and `paths` are in the world frame
/// of map.grid.
///
/// A tissue with lengths of its own applies at a voxel centre if one of its voxels lies in the box around it with sides
/// of two scale voxels, so that linear interpolation inside the tissue yields no more than the length of the tissue.
/// Where several tissues meet in a box, the smallest length applies; background applies only where it is alone. Throws
/// as checkScaleOptions does.
ScaleField computeSurgicalScale(const TissueMap& map, const std::vector<Vec3>& targets, const std::vector<Path>& paths,
                                const SurgicalScaleOptions& options, const Progress& progress = {});

/// Returns the largest spacing, mm, at which the interpolated volume exceeds the wanted length at targets and path
/// points by no more than half, wherever they lie between the voxels; infinity if the lengths differ by less than that.
double sufficientSpacing(const SurgicalScaleOptions& options, const std::vector<Vec3>& targets,
                         const std::vector<Path>& paths);

} // namespace surgicalmesher
