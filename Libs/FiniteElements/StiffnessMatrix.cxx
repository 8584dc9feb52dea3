// SPDX-License-Identifier: Apache-2.0
#include "StiffnessMatrix.h"

#include "FaceAdjacency.h"
#include "LinearTetrahedron.h"

#include <algorithm>

namespace surgicalmesher
{
namespace
{

constexpr double kHeldShare = 0.05;

/// Returns the points of each piece of the mesh, ascending.
std::vector<std::vector<std::int32_t>> pointsOfPieces(const TetMesh& mesh)
{
  const auto region = faceRegions(faceAdjacency(mesh), [](std::int32_t, int) { return true; });
  std::vector<std::vector<std::int32_t>> pieces(1 + *std::max_element(region.begin(), region.end()));
  for (std::size_t t = 0; t < region.size(); ++t)
    pieces[region[t]].insert(pieces[region[t]].end(), mesh.tetrahedra[t].begin(), mesh.tetrahedra[t].end());
  for (auto& points : pieces)
  {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
  }
  return pieces;
}

/// Returns a zero matrix with a block for every pair of free points that share a tetrahedron.
BlockMatrix emptyMatrix(const TetMesh& mesh, const std::vector<std::int32_t>& number, std::int32_t rows)
{
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  for (const auto& tetrahedron : mesh.tetrahedra)
  {
    for (const std::int32_t a : tetrahedron)
    {
      for (const std::int32_t b : tetrahedron)
      {
        if (number[a] >= 0 && number[b] >= 0) pairs.emplace_back(number[a], number[b]);
      }
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  BlockMatrix matrix;
  matrix.rowStart.assign(rows + 1, 0);
  for (const auto& [row, column] : pairs)
  {
    ++matrix.rowStart[row + 1];
    matrix.columns.push_back(column);
  }
  for (std::int32_t row = 0; row < rows; ++row) matrix.rowStart[row + 1] += matrix.rowStart[row];
  matrix.blocks.assign(pairs.size(), BlockMatrix::Block{});
  return matrix;
}

} // namespace

std::vector<std::int32_t> numberFreePoints(const TetMesh& mesh, std::int32_t& count)
{
  std::vector<std::int32_t> number(mesh.points.size(), 0);
  for (const auto& points : pointsOfPieces(mesh))
  {
    std::vector<double> heights;
    for (const std::int32_t id : points) heights.push_back(mesh.points[id].z);
    std::sort(heights.begin(), heights.end());
    const auto last = std::max<std::size_t>(2, static_cast<std::size_t>(kHeldShare * double(heights.size() - 1)));
    for (const std::int32_t id : points)
    {
      if (mesh.points[id].z <= heights[last]) number[id] = -1;
    }
  }
  count = 0;
  for (std::int32_t& n : number)
  {
    if (n >= 0) n = count++;
  }
  return number;
}

std::int64_t BlockMatrix::indexOf(std::int32_t row, std::int32_t column) const
{
  const auto begin = columns.begin() + rowStart[row], end = columns.begin() + rowStart[row + 1];
  return std::lower_bound(begin, end, column) - columns.begin();
}

BlockMatrix stiffnessMatrix(const TetMesh& mesh, const std::vector<std::int32_t>& number, std::int32_t rows,
                            double poissonsRatio)
{
  const LameConstants lame = lameConstants(1, poissonsRatio);
  BlockMatrix matrix = emptyMatrix(mesh, number, rows);
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    const auto& ids = mesh.tetrahedra[t];
    const LinearTetrahedron tetrahedron = linearTetrahedron(cornersOf(mesh, t));
    for (int a = 0; a < 4; ++a)
    {
      for (int b = 0; b < 4; ++b)
      {
        if (number[ids[a]] < 0 || number[ids[b]] < 0) continue;
        BlockMatrix::Block& sum = matrix.blocks[matrix.indexOf(number[ids[a]], number[ids[b]])];
        const StiffnessBlock block = stiffnessBlock(tetrahedron, a, b, lame);
        for (std::size_t i = 0; i < block.size(); ++i) sum[i] += block[i];
      }
    }
  }
  return matrix;
}

} // namespace surgicalmesher
