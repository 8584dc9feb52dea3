// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Directions for a vertex: where angles get better, and where its samples yield.

#include "GuardedOperations.h"
#include "Quadric.h"

#include <cmath>
#include <cstdint>

namespace surgicalmesher
{

/// How the samples, whatever the interface's rigidity, resist a step of v: a share `ease` of all its resistance in every direction besides.
Quadric heldAt(GuardedOperations& operations, std::int32_t v, double ease);

/// Whether a step is too small to be worth its tests, where L is `length`.
inline bool isNegligible(const Vec3& step, double length) { return squaredNorm(step) < 1e-4 * length * length; }

/// Turns `direction` at v into one that its samples resist less, along the features there; a unit vector, or zero.
Vec3 easiest(GuardedOperations& operations, std::int32_t v, const Quadric& held, const Vec3& direction);

/// The vertices next to one on the interface, and how many faces of its sheet are at each: more than two along a curve
/// between tissues.
using FacesAtNeighbours = std::vector<std::pair<std::int32_t, int>>;
void facesAtNeighbours(const Sheet& sheet, std::int32_t v, FacesAtNeighbours& result);

/// Whether v lies inside a label among 24 tetrahedra, none of them with a dihedral angle below 45 degrees or above 135:
/// what Fuchs's lattice, of 60 and 90 degrees, makes of a vertex, or nearly so. To move it can only harm the lattice.
bool isWhole(GuardedOperations& operations, std::int32_t v);

/// A fixed sequence of directions, for reproducible trials.
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

/// Unit direction at v, were it at p, that lifts the worst tetrahedra, whose quality is `worst`: the sum of the unit
/// gradients of all that are nearly as bad.
Vec3 uphill(GuardedOperations& operations, std::int32_t v, const Vec3& p, double worst);

} // namespace surgicalmesher
