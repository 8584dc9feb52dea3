// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Directions in which to move a vertex: those that improve angles, and those that its samples resist least.

#include "GuardedOperations.h"
#include "Quadric.h"

#include <cmath>
#include <cstdint>

namespace surgicalmesher
{

/// Returns the resistance of the samples at v to a step of v (resistanceOf, without the interface's rigidity), plus
/// `ease` times its trace in every direction; the identity if v lies inside a label.
Quadric heldAt(GuardedOperations& operations, std::int32_t v, double ease);

/// Returns whether a step is too small to be worth its tests: below 1 % of the target length `length`.
inline bool isNegligible(const Vec3& step, double length) { return squaredNorm(step) < 1e-4 * length * length; }

/// Turns `direction` at v towards directions that the resistance `held` (see heldAt) opposes less, and along the
/// features at v. Returns a unit vector, or zero if features leave no direction.
Vec3 easiest(GuardedOperations& operations, std::int32_t v, const Quadric& held, const Vec3& direction);

/// The neighbours of a vertex on the interface, each with the number of faces of the vertex's sheet that contain it:
/// more than two along a curve where three or more labels meet.
using FacesAtNeighbours = std::vector<std::pair<std::int32_t, int>>;
void facesAtNeighbours(const Sheet& sheet, std::int32_t v, FacesAtNeighbours& result);

/// Returns whether v lies inside a label and has 24 tetrahedra, none with a dihedral angle below 45 degrees or above
/// 135: its star is then that of Fuchs's lattice (60 and 90 degrees), or nearly so, and moving v can only harm the
/// lattice.
bool isWhole(GuardedOperations& operations, std::int32_t v);

/// A fixed pseudo-random sequence of unit vectors, for reproducible trials.
class Directions
{
public:
  Vec3 next()
  {
    for (;;)
    {
      const Vec3 d{ uniform(), uniform(), uniform() };
      const double n = squaredNorm(d);
      if (n > 1e-3 && n <= 1) return d / std::sqrt(n);
    }
  }

private:
  double uniform()
  {
    m_State = m_State * 6364136223846793005ull + 1442695040888963407ull;
    return double(std::int64_t(m_State) >> 11) / 4503599627370496.0;
  }
  std::uint64_t m_State = 88172645463325252ull;
};

/// Returns the unit direction in which v, at p, improves its worst tetrahedra: the normalised sum of the unit quality
/// gradients of all that are nearly as bad as `worst`, the worst quality there.
Vec3 uphill(GuardedOperations& operations, std::int32_t v, const Vec3& p, double worst);

} // namespace surgicalmesher
