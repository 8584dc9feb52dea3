// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A curved slab of hexahedra, like a face cut off behind, and maps to bend it.

#include "ElementMesh.h"
#include "Landmarks.h"

#include <cmath>

namespace surgicalmesher::test
{

/// columns x rows x layers hexahedra over 100 x 80 mm, 10 mm thick, on a bowed sheet; their last axis points outwards.
inline ElementMesh slab(int columns = 10, int rows = 8, int layers = 2)
{
  ElementMesh mesh;
  const auto id = [&](int i, int j, int k) { return std::int32_t(i + (columns + 1) * (j + (rows + 1) * k)); };
  mesh.points.resize(3, (columns + 1) * (rows + 1) * (layers + 1));
  for (int k = 0; k <= layers; ++k)
  {
    for (int j = 0; j <= rows; ++j)
    {
      for (int i = 0; i <= columns; ++i)
      {
        const double x = 100. * i / columns - 50, y = 80. * j / rows - 40, z = 10. * k / layers;
        mesh.points.col(id(i, j, k)) = Eigen::Vector3d(x, y, z - (x * x + 0.5 * y * y) / 120);
      }
    }
  }
  for (int k = 0; k < layers; ++k)
  {
    for (int j = 0; j < rows; ++j)
    {
      for (int i = 0; i < columns; ++i)
      {
        mesh.elements.push_back({ ElementShape::Hexahedron,
                                  { id(i, j, k), id(i + 1, j, k), id(i + 1, j + 1, k), id(i, j + 1, k), id(i, j, k + 1),
                                    id(i + 1, j, k + 1), id(i + 1, j + 1, k + 1), id(i, j + 1, k + 1) } });
      }
    }
  }
  return mesh;
}

/// A smooth map that moves points by up to about 10 mm and has no fold.
inline Points bent(const Points& points)
{
  Points moved(3, points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i)
  {
    const Eigen::Vector3d p = points.col(i);
    moved.col(i) = Eigen::Vector3d(1.1 * p.x() + 3 * std::sin(p.y() / 20), 0.95 * p.y() + 2 * std::sin(p.x() / 25),
                                   p.z() + 5 * std::cos(p.x() / 30) * std::cos(p.y() / 25));
  }
  return moved;
}

inline TriangleSurface outerSurface(const ElementMesh& mesh)
{
  return compacted(mesh.points, trianglesOf(outerFaces(mesh.elements), mesh.points));
}

/// Every `step`-th point of the mesh and where `moved` has it.
inline LandmarkPairs everyNth(const Points& points, const Points& moved, int step)
{
  LandmarkPairs pairs;
  for (Eigen::Index i = 0; i < points.cols(); i += step) pairs.names.push_back(std::to_string(i));
  pairs.source.resize(3, Eigen::Index(pairs.names.size()));
  pairs.target = pairs.source;
  for (Eigen::Index i = 0; i < pairs.source.cols(); ++i)
  {
    pairs.source.col(i) = points.col(i * step);
    pairs.target.col(i) = moved.col(i * step);
  }
  return pairs;
}

} // namespace surgicalmesher::test
