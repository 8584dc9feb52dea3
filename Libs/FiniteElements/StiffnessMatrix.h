// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The stiffness matrix of a mesh that is held fixed at its bottom.

#include "TetMesh.h"

#include <array>
#include <vector>

namespace surgicalmesher
{

/// Returns the index of each point among the free ones, or -1 for held points; `count` receives the number of free
/// points. In each piece of the mesh (tetrahedra joined through faces), the points farthest towards -z are held: the
/// lowest twentieth, at least three, and all others at the same height.
std::vector<std::int32_t> numberFreePoints(const TetMesh& mesh, std::int32_t& count);

/// Matrix of 3 x 3 blocks in compressed-row storage.
struct BlockMatrix
{
  using Block = std::array<double, 9>;

  std::vector<std::int64_t> rowStart;
  std::vector<std::int32_t> columns; ///< ascending within a row
  std::vector<Block> blocks;

  std::int32_t rows() const { return static_cast<std::int32_t>(rowStart.size()) - 1; }
  std::int64_t indexOf(std::int32_t row, std::int32_t column) const;
};

/// Returns the stiffness matrix for linear elasticity on linear tetrahedra with Young's modulus 1. `number` is the
/// result of numberFreePoints(), `rows` its count of free points.
BlockMatrix stiffnessMatrix(const TetMesh& mesh, const std::vector<std::int32_t>& number, std::int32_t rows,
                            double poissonsRatio);

} // namespace surgicalmesher
