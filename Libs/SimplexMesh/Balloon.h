// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Balloons: simplex meshes that grow from seed points until tissues stop them (Audette et al., section 2.3). Each
/// starts as a small sphere and expands under a balloon force along its normals.
///
/// The law of motion is that of SimplexMotion. The balloon force at a dual point with normal n acts along n. Where no
/// stopping tissue is within two voxels ahead, it is the pressure, which is larger in open space; otherwise it is half
/// the distance to the obstacle. The membrane thus comes to rest at the surface of the stopping tissues, at the limit,
/// or at the end of the map. A resistance to bending opposes it (bendingForces); its width is independent of the edge
/// lengths, so that the membrane does not enter openings up to `rigidity` wide, whatever the mesh. For the same reason
/// the pressure vanishes where a ball of that diameter does not fit behind the membrane. The guards of the operators
/// keep every membrane from crossing itself or another one.
///
/// While it grows, a balloon has edges no shorter than its rigidity requires; at rest, its faces are adapted to A_s(x)
/// and it settles once more.

#include "AreaAdaptation.h"
#include "Progress.h"
#include "SimplexForces.h"
#include "StoppingField.h"

namespace surgicalmesher
{

struct BalloonSeed
{
  Vec3 centre;
  Label tissue = 0;
};

struct BalloonOptions
{
  std::function<double(const Vec3&)> edgeLength; ///< L(x), mm; A_s = sqrt(3)/2 L^2
  double areaTolerance = 0.5;                    ///< relative to A_s
  double limit = 0;                              ///< largest distance from the seed, mm; 0: none
  Continuity continuity = Continuity::C2;
  double rigidity = 8;    ///< mm; the membrane does not enter openings up to this width
  double pressure = 0;    ///< mm per motion; 0: 0.15 voxel
  int mostMotions = 1300; ///< in total
};

/// Numbers of faces, by what holds them.
struct BalloonHalt
{
  std::size_t tissue = 0;    ///< a stopping tissue within a voxel
  std::size_t end = 0;       ///< the end of the map
  std::size_t limit = 0;     ///< the limit on the distance from the seed
  std::size_t neighbour = 0; ///< another balloon
  std::size_t rigidity = 0;  ///< none of these: the membrane's own resistance to bending, at an opening

  std::size_t faces() const { return tissue + end + limit + neighbour + rigidity; }
};

struct BalloonSize
{
  double volume = 0, area = 0; ///< mm^3, mm^2
  double radius() const;       ///< of the ball of that volume, mm
};

/// Returns volume and area of the balloons by tissue.
std::map<Label, BalloonSize> balloonSizes(const SurfaceComplex& surface);

struct BalloonStep
{
  int motion = 0;
  std::size_t faces = 0, vertices = 0;
  double volume = 0, area = 0; ///< mm^3, mm^2
  double meanMove = 0;         ///< mm, over the dual points, in the last motion
  double withinTolerance = 0;  ///< fraction of the faces whose area is within the tolerance
  AreaCounts operations;       ///< since the previous step
};

struct BalloonResult
{
  SurfaceComplex surface;             ///< labels [tissue, 0]; where balloons meet, see withSharedInterfaces
  std::vector<BalloonStep> evolution; ///< the last step describes the result
  std::map<Label, BalloonHalt> halts; ///< by tissue
  bool isAtRest = false;              ///< false if mostMotions was reached first
};

/// Called after every motion with the current membranes.
using BalloonWatch = std::function<void(int motion, const SimplexOperators& membranes)>;

/// Grows one balloon from each seed. All coordinates are in the grid frame of `field`. Throws InputError if a seed is
/// in a stopping tissue or outside the map, or if two seeds are within a voxel of each other.
BalloonResult growBalloons(const std::vector<BalloonSeed>& seeds, const StoppingField& field,
                           const BalloonOptions& options, const Progress& progress = {},
                           const BalloonWatch& watch = {});

} // namespace surgicalmesher
