// SPDX-License-Identifier: Apache-2.0
#include "LocalTopology.h"

#include "PaddedMap.h"

#include <algorithm>
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

/// For each voxel, those that touch it and are at most `mostSteps` steps along axes away, itself included: 1 for faces
/// alone, 3 for edges and corners as well.
std::array<VoxelMask, 27> makeNearVoxels(int mostSteps)
{
  std::array<VoxelMask, 27> near{};
  for (int v = 0; v < 27; ++v)
    for (int w = 0; w < 27; ++w)
    {
      const int i = std::abs(w % 3 - v % 3), j = std::abs(w / 3 % 3 - v / 3 % 3), k = std::abs(w / 9 - v / 9);
      if (std::max({ i, j, k }) <= 1 && i + j + k <= mostSteps) near[v] |= VoxelMask(1) << w;
    }
  return near;
}

const std::array<VoxelMask, 27> acrossFaces = makeNearVoxels(1), acrossCorners = makeNearVoxels(3);

/// Whether the voxels around the centre that do not have the label exist and are connected, across corners as well.
bool isOneAround(const Neighbourhood& n, Label label)
{
  VoxelMask others = 0;
  for (int v = 0; v < 27; ++v) others |= VoxelMask(v != centre && n[v] != label) << v;
  return others != 0 && firstPart(others, false) == others;
}

} // namespace

VoxelMask firstPart(VoxelMask voxels, bool throughFacesOnly)
{
  const std::array<VoxelMask, 27>& near = throughFacesOnly ? acrossFaces : acrossCorners;
  VoxelMask part = voxels & (~voxels + 1);
  for (VoxelMask before = 0; part != before;)
  {
    before = part;
    for (int v = 0; v < 27; ++v)
      if (part >> v & 1) part |= near[v] & voxels;
  }
  return part;
}

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
