// SPDX-License-Identifier: Apache-2.0
#include "InterfaceRelabelling.h"

#include "TetQuality.h"

#include <optional>

namespace surgicalmesher
{

namespace
{

/// Returns the label beyond two or more interface faces of t, if there is one.
std::optional<Label> beyondMostFaces(const TetComplex& c, std::int32_t t)
{
  const auto isBeyond = [&](int i, int k)
  { return c.neighbours[t][k] >= 0 && c.labels[c.neighbours[t][k]] == c.labels[c.neighbours[t][i]]; };
  for (int i = 0; i < 3; ++i)
  {
    if (!c.isInterface(t, i)) continue;
    for (int k = i + 1; k < 4; ++k)
      if (isBeyond(i, k)) return c.labels[c.neighbours[t][i]];
  }
  return std::nullopt;
}

} // namespace

void relabelBlock(GuardedOperations& operations, double keptAngle, double mostLeft)
{
  const TetComplex& c = operations.complex();
  const double least = sine2OfDegrees(keptAngle);
  for (std::int32_t t = 0; t < std::int32_t(c.tets.size()); ++t)
    if (c.alive(t))
      if (const auto label = beyondMostFaces(c, t)) operations.relabel(t, *label, least, mostLeft);
}

} // namespace surgicalmesher
