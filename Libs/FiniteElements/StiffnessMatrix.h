// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The stiffness matrix of a mesh that is held at its bottom.

#include "TetMesh.h"

#include <array>
#include <vector>

namespace surgicalmesher
{

/// Number of each point among those that are free, or -1; `count`: how many are. Of each piece (tetrahedra joined
/// through faces) the outermost points towards -z are held: the lowest twentieth, three at least, and all that are as
/// low.
std::vector<std::int32_t> numberFreePoints(const TetMesh& mesh, std::int32_t& count);

/// Compressed rows of 3 x 3 blocks.
struct BlockMatrix
{
  using Block = std::array<double, 9>;

  std::vector<std::int64_t> rowStart;
  std::vector<std::int32_t> columns; ///< ascending within a row
  std::vector<Block> blocks;

  std::int32_t rows() const { return static_cast<std::int32_t>(rowStart.size()) - 1; }
  std::int64_t indexOf(std::int32_t row, std::int32_t column) const;
};

/// Linear elasticity of linear tetrahedra, Young's modulus 1. `number` as numberFreePoints() has it, for `rows` points.
BlockMatrix stiffnessMatrix(const TetMesh& mesh, const std::vector<std::int32_t>& number, std::int32_t rows,
                            double poissonsRatio);

} // namespace surgicalmesher
