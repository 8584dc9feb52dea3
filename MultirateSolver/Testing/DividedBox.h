// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A box of tetrahedra, divided as FuchsTetrahedralizerCLI divides a mesh.

#include "ConstitutiveTags.h"
#include "MeshIO.h"
#include "VoxelMesh.h"

namespace surgicalmesher::test
{

struct DividedBox
{
  MeshFile parent, child;
};

/// The tetrahedra of one label as a part.
inline MeshFile partWithLabel(const TetMesh& whole, Label label)
{
  MeshFile part;
  std::vector<std::int32_t> number(whole.points.size(), -1);
  for (std::size_t t = 0; t < whole.tetrahedra.size(); ++t)
  {
    if (whole.labels[t] != label) continue;
    std::array<std::int32_t, 4> corners = whole.tetrahedra[t];
    for (std::int32_t& corner : corners)
    {
      std::int32_t& n = number[std::size_t(corner)];
      if (n < 0)
      {
        n = std::int32_t(part.mesh.points.size());
        part.mesh.points.push_back(whole.points[std::size_t(corner)]);
        part.volumePointId.push_back(corner);
      }
      corner = n;
    }
    part.mesh.tetrahedra.push_back(corners);
    part.mesh.labels.push_back(1);
  }
  return part;
}

/// 9 x 5 x 5 voxels of 4 mm; the children are blocks inside, of three voxels by 3 by 3 and, if there are two, of two by 3
/// by 3.
inline DividedBox dividedBox(int children)
{
  const TissueMap map = paintedMap({ 9, 5, 5 },
                                   [&](int i, int j, int k)
                                   {
                                     const bool isInside = j > 0 && j < 4 && k > 0 && k < 4;
                                     return isInside && ((i > 0 && i < 4) || (children == 2 && i > 5 && i < 8)) ? 2 : 1;
                                   },
                                   { 4, 4, 4 });
  const TetMesh whole = tetrahedraOf(map, 0);
  return { partWithLabel(whole, 1), partWithLabel(whole, 2) };
}

/// A bar of 10 x 3 x 3 voxels of 4 mm, of which the first is held; the child goes right across.
inline DividedBox dividedBar()
{
  const TetMesh whole = tetrahedraOf(
    paintedMap({ 10, 3, 3 }, [](int i, int, int) { return i == 0           ? 3
                                                          : i > 3 && i < 7 ? 2
                                                                           : 1; }, { 4, 4, 4 }), 0);
  TetMesh renamed = whole;
  for (Label& label : renamed.labels) label = label == 3 ? 1 : label;
  DividedBox bar{ partWithLabel(renamed, 1), partWithLabel(renamed, 2) };
  for (const Label label : whole.labels)
    if (label != 2) bar.parent.constitutive.push_back(label == 3 ? kNullDisplacement : kLinear);
  return bar;
}

/// A slender column of 5 x 5 x 12 voxels of 4 mm; the children are blocks of 2 x 2 x 2 at three of its edges near the
/// top, where a force on one bends the column under all.
inline DividedBox dividedColumn()
{
  const TissueMap map = paintedMap({ 5, 5, 12 },
                                   [](int i, int j, int k)
                                   {
                                     const bool isAtEdge = i != 2 && j != 2 && (i < 2 || j < 2);
                                     return isAtEdge && (k == 9 || k == 10) ? 2 : 1;
                                   },
                                   { 4, 4, 4 });
  const TetMesh whole = tetrahedraOf(map, 0);
  return { partWithLabel(whole, 1), partWithLabel(whole, 2) };
}

} // namespace surgicalmesher::test
