// SPDX-License-Identifier: Apache-2.0
#include "LocalTopology.h"

#include "PaddedMap.h"

#include <cstdlib>

namespace surgicalmesher
{

constexpr int centre = 13;

int partsAround(const Neighbourhood& n, Label label)
{
  const auto& faces = sixNeighbours;
  std::array<int, 27> part;
  for (int v = 0; v < 27; ++v) part[v] = v != centre && n[v] == label ? v : -1;
  int parts = 0;
  for (const int f : faces) parts += part[f] >= 0;
  // An edge voxel joins the two face voxels beside it.
  for (int a = 0; a < 6; ++a)
  {
    for (int b = a + 1; b < 6; ++b)
    {
      const int edge = faces[a] + faces[b] - centre;
      if (faces[a] + faces[b] == 2 * centre || part[faces[a]] < 0 || part[faces[b]] < 0 || part[edge] < 0) continue;
      const int from = part[faces[b]], to = part[faces[a]];
      if (from == to) continue;
      --parts;
      for (const int f : faces)
      {
        if (part[f] == from) part[f] = to;
      }
    }
  }
  return parts;
}

namespace
{

using CornerMask = unsigned; ///< a set of corners, one bit each

bool faceConnected(CornerMask corners)
{
  CornerMask reached = corners & (~corners + 1);
  for (int step = 0; step < 7; ++step)
  {
    for (int c = 0; c < 8; ++c)
    {
      if (reached >> c & 1) reached |= (1u << (c ^ 1) | 1u << (c ^ 2) | 1u << (c ^ 4)) & corners;
    }
  }
  return reached == corners;
}

/// For each set of corners, whether a label may hold exactly these.
std::array<bool, 256> makeAllowedSets()
{
  std::array<bool, 256> allowed{};
  for (CornerMask m = 0; m < 256; ++m) allowed[m] = faceConnected(m) && faceConnected(~m & 255);
  return allowed;
}

const std::array<bool, 256> allowedSets = makeAllowedSets();

CornerMask cornersOf(Label label, const Block& block)
{
  CornerMask corners = 0;
  for (int c = 0; c < 8; ++c) corners |= CornerMask(block[c] == label) << c;
  return corners;
}

/// Whether the voxels around the centre that are not of the label hang together, across corners as well.
bool isOneAround(const Neighbourhood& n, Label label)
{
  std::array<int, 27> open{};
  std::array<bool, 27> seen{};
  int count = 0, parts = 0;
  seen[centre] = true;
  for (int start = 0; start < 27; ++start)
  {
    if (seen[start] || n[start] == label) continue;
    if (++parts > 1) return false;
    seen[start] = true;
    for (open[count++] = start; count > 0;)
    {
      const int v = open[--count], i = v % 3, j = v / 3 % 3, k = v / 9;
      for (int w = 0; w < 27; ++w)
      {
        if (seen[w] || n[w] == label) continue;
        if (std::abs(w % 3 - i) > 1 || std::abs(w / 3 % 3 - j) > 1 || std::abs(w / 9 - k) > 1) continue;
        seen[w] = true;
        open[count++] = w;
      }
    }
  }
  return parts == 1;
}

} // namespace

bool isCritical(const Block& block)
{
  CornerMask seen = 0;
  for (int c = 0; c < 8; ++c)
  {
    if (seen >> c & 1) continue;
    const CornerMask corners = cornersOf(block[c], block);
    if (!allowedSets[corners]) return true;
    seen |= corners;
    if (seen == 255) return false;
  }
  return false;
}

int criticalBlocks(const Neighbourhood& n)
{
  constexpr std::array<int, 8> lowCorners{ 0, 1, 3, 4, 9, 10, 12, 13 };
  int count = 0;
  for (const int l : lowCorners)
  {
    count += isCritical({ n[l], n[l + 1], n[l + 3], n[l + 4], n[l + 9], n[l + 10], n[l + 12], n[l + 13] });
  }
  return count;
}

bool isSimple(const Neighbourhood& n, Label label)
{
  for (const Label l : { n[centre], label })
    if (partsAround(n, l) != 1 || !isOneAround(n, l)) return false;
  return true;
}

bool keepsTopology(const Neighbourhood& n, Label label)
{
  if (!isSimple(n, label)) return false;
  Neighbourhood changed = n;
  changed[centre] = label;
  return criticalBlocks(changed) == 0;
}

} // namespace surgicalmesher
