// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Simplex meshes that grow from points until tissues stop them (Audette et al., section 2.3): small spheres under
/// a balloon force along their normals.
///
/// The law of motion is that of SimplexMotion. At a dual point with normal n, the balloon force is the pressure along n
/// where no tissue is within two voxels ahead, more of it in the open, and half the way to what stops it otherwise, so
/// that the membrane comes to rest at the surface of the stopping tissues, at the limit, or at the map's end. Against
/// it stands the resistance to bending (bendingForces), at a width that does not depend on the length of edges:
/// openings up to the rigidity are closed over, whatever the mesh. For these there is no pressure, either, where a ball
/// as wide does not fit behind the membrane. The operators' guards keep every membrane from crossing itself or another
/// one.
///
/// The balloon grows with edges no shorter than its rigidity asks for; at rest, its faces are brought to A_s(x) and it
/// settles once more.

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
  double areaTolerance = 0.5;                    ///< of A_s
  double limit = 0;                              ///< mm from the seed; 0: none
  Continuity continuity = Continuity::C2;
  double rigidity = 8;    ///< mm; width of the openings that are closed over
  double pressure = 0;    ///< mm a motion; 0: 0.15 voxel
  int mostMotions = 1300; ///< in all
};

/// What holds the faces, in numbers of them.
struct BalloonHalt
{
  std::size_t tissue = 0;    ///< a stopping tissue, within a voxel
  std::size_t end = 0;       ///< the map's end
  std::size_t limit = 0;     ///< the distance from the seed
  std::size_t neighbour = 0; ///< another balloon
  std::size_t rigidity = 0;  ///< nothing but its own membrane: an opening

  std::size_t faces() const { return tissue + end + limit + neighbour + rigidity; }
};

struct BalloonSize
{
  double volume = 0, area = 0; ///< mm^3, mm^2
  double radius() const;       ///< of a ball of that volume, mm
};

/// By tissue.
std::map<Label, BalloonSize> balloonSizes(const SurfaceComplex& surface);

struct BalloonStep
{
  int motion = 0;
  std::size_t faces = 0, vertices = 0;
  double volume = 0, area = 0; ///< mm^3, mm^2
  double meanMove = 0;         ///< mm, of a dual point in the last motion
  double withinTolerance = 0;  ///< share of the faces
  AreaCounts operations;       ///< since the step before
};

struct BalloonResult
{
  SurfaceComplex surface;             ///< labels [tissue, 0]; see withSharedInterfaces where balloons meet
  std::vector<BalloonStep> evolution; ///< the last one is the result
  std::map<Label, BalloonHalt> halts; ///< by tissue
  bool isAtRest = false;              ///< or else the motions ran out
};

/// Called after every motion, with the membranes as they are.
using BalloonWatch = std::function<void(int motion, const SimplexOperators& membranes)>;

/// Everything in the grid frame of the field. Throws InputError if a seed is in a stopping tissue or outside the map,
/// or if two seeds are within a voxel of each other; UsageError for options without meaning.
BalloonResult growBalloons(const std::vector<BalloonSeed>& seeds, const StoppingField& field,
                           const BalloonOptions& options, const Progress& progress = {},
                           const BalloonWatch& watch = {});

} // namespace surgicalmesher
