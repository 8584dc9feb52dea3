// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Scales for tests, on a grid of their own.

#include "ScaleField.h"

#include <algorithm>
#include <cmath>

namespace surgicalmesher::test
{

/// Returns a scale of `low` mm up to `inner` mm from `centre` (world) that rises from there exponentially towards
/// `high` mm with the decay length `decay` mm; sampled on 16^3 points over `grid`.
inline ScaleField radialScale(const Grid& grid, const Vec3& centre, double low, double high, double inner, double decay)
{
  constexpr int samples = 16;
  ScaleField scale;
  scale.grid = grid;
  scale.grid.size = { samples, samples, samples };
  Vec3 corner;
  for (int a = 0; a < 3; ++a)
  {
    corner[a] = -0.5 * grid.spacing[a];
    scale.grid.spacing[a] = grid.size[a] * grid.spacing[a] / (samples - 1);
  }
  scale.grid.origin = grid.gridToWorld(corner);
  const auto& spacing = scale.grid.spacing;
  for (int k = 0; k < samples; ++k)
  {
    for (int j = 0; j < samples; ++j)
    {
      for (int i = 0; i < samples; ++i)
      {
        const double d = norm(scale.grid.gridToWorld({ i * spacing.x, j * spacing.y, k * spacing.z }) - centre);
        scale.lengths.push_back(float(low + (high - low) * (1 - std::exp(-std::max(0.0, d - inner) / decay))));
      }
    }
  }
  return scale;
}

} // namespace surgicalmesher::test
