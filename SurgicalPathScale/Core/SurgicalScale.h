// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Target edge length from the distance to surgical targets and paths.
///
/// With d the distance from x to the nearest target, or to the nearest segment of a path,
///
///     L(d) = Lmin                                               d <= dmin
///     L(d) = Lmin + (Lmax - Lmin) (1 - exp(-(d - dmin) / dscale))   d >  dmin
///
/// (Audette et al., Computer Aided Surgery 12(1), 2007, eq. 1 with the distance to a point or to a linearised path). The
/// same function may rule the areas As of simplex faces instead (Audette et al. 2005, eq. 2), with L = sqrt(2 As /
/// sqrt(3)) by their eq. 3. Here L is the edge of triangles and tetrahedra. Lengths and distances in mm.

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

/// How fast the length rises with distance.
struct Falloff
{
  double childRadius = 10; ///< dmin >= 0
  double decayLength = 25; ///< dscale > 0
};

/// What rises exponentially between its values for Lmin and Lmax.
enum class RisingQuantity
{
  Length,
  Area ///< As, which goes with the square of L: longer edges at the same distance
};

/// L of an area As of simplex faces, in mm: sqrt(2 As / sqrt(3)).
double edgeLengthOfArea(double area);

/// The formula above, for any d >= 0; Lmax at infinity.
double edgeLength(double distance, const LengthRange& range, const Falloff& falloff,
                  RisingQuantity rising = RisingQuantity::Length);

/// A tissue's own lengths: factor * L(d) with its own range.
struct TissueLength
{
  LengthRange range;
  double factor = 1; ///< > 0
};

/// Which distance counts where there are targets and paths.
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
  RisingQuantity rising = RisingQuantity::Length; ///< of all ranges
  Combination combination = Combination::Smaller;
  std::map<Label, TissueLength> tissues; ///< exceptions to `range`
  double gradation = 0;                  ///< limit on |grad L|, mm per mm; 0 sets none. See limitGradation
  double spacing = 2;                    ///< voxel size of the scale volume
};

/// Throws UsageError unless every length and distance is finite and in its range, there is what `combination` asks for,
/// and the scale volume would have at most 2^31 voxels; InputError for a path of fewer than two points.
void checkScaleOptions(const SurgicalScaleOptions& options, const Grid& map, const std::vector<Vec3>& targets,
                       const std::vector<Path>& paths);

/// The grid of a scale volume: the axes of the map's grid, cubic voxels of `spacing`, centred on the map, which it
/// covers to the outer faces of its voxels with at least one scale voxel and a fifth of the map's to spare on every side.
Grid scaleGrid(const Grid& map, double spacing);

/// L at the voxel centres of scaleGrid(map.grid, options.spacing); `targets` and `paths` in the world of map.grid.
///
/// A tissue with lengths of its own counts at a voxel centre if one of its voxels lies in the box of two voxels' side
/// around it, so that linear interpolation inside the tissue asks for no more than the tissue's length; where several
/// tissues meet in a box the smallest length wins, and background counts only where it is alone.
/// Throws as checkScaleOptions does.
ScaleField computeSurgicalScale(const TissueMap& map, const std::vector<Vec3>& targets, const std::vector<Path>& paths,
                                const SurgicalScaleOptions& options, const Progress& progress = {});

/// The largest spacing, mm, at which the volume asks for no more than half again of what is wanted at any target or point
/// of a path, wherever it lies between the voxels; infinite if lengths differ by less than that.
double sufficientSpacing(const SurgicalScaleOptions& options, const std::vector<Vec3>& targets,
                         const std::vector<Path>& paths);

} // namespace surgicalmesher
