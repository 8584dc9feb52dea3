// SPDX-License-Identifier: Apache-2.0
#include "StiffnessConditioning.h"

#include "FaceAdjacency.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace surgicalmesher
{
namespace
{

constexpr double kPoissonsRatio = 0.4;
constexpr double kHeldShare = 0.05;
constexpr double kTolerance = 1e-8;

// ---- which points are free ------------------------------------------------------------------------------------------

/// One list of points per piece of the mesh, ascending.
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

/// Number among the free points, or -1.
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

// ---- the matrix -----------------------------------------------------------------------------------------------------

using Block = std::array<double, 9>;

/// Compressed rows of 3 x 3 blocks.
struct BlockMatrix
{
  std::vector<std::int64_t> rowStart;
  std::vector<std::int32_t> columns; ///< ascending within a row
  std::vector<Block> blocks;

  std::int32_t rows() const { return static_cast<std::int32_t>(rowStart.size()) - 1; }

  Block& at(std::int32_t row, std::int32_t column)
  {
    const auto begin = columns.begin() + rowStart[row], end = columns.begin() + rowStart[row + 1];
    return blocks[std::lower_bound(begin, end, column) - columns.begin()];
  }
};

/// Room for every pair of free points that share a tetrahedron.
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
  matrix.blocks.assign(pairs.size(), Block{});
  return matrix;
}

/// Gradients of the four barycentric coordinates, 1/mm, and six times the volume.
std::array<Vec3, 4> gradients(const TetMesh& mesh, const std::array<std::int32_t, 4>& ids, double& sixVolumes)
{
  const auto p = [&](int corner) { return mesh.points[ids[corner]]; };
  sixVolumes = orient(p(0), p(1), p(2), p(3));
  std::array<Vec3, 4> result;
  for (int f = 0; f < 4; ++f)
  {
    const auto& [i, j, k] = kFaceCorners[f];
    result[f] = cross(p(j) - p(i), p(k) - p(i)) / -sixVolumes;
  }
  return result;
}

/// Young's modulus 1.
BlockMatrix stiffness(const TetMesh& mesh, const std::vector<std::int32_t>& number, std::int32_t rows)
{
  constexpr double lambda = kPoissonsRatio / ((1 + kPoissonsRatio) * (1 - 2 * kPoissonsRatio));
  constexpr double mu = 0.5 / (1 + kPoissonsRatio);
  BlockMatrix matrix = emptyMatrix(mesh, number, rows);
  for (const auto& ids : mesh.tetrahedra)
  {
    double sixVolumes = 0;
    const std::array<Vec3, 4> g = gradients(mesh, ids, sixVolumes);
    for (int a = 0; a < 4; ++a)
    {
      for (int b = 0; b < 4; ++b)
      {
        if (number[ids[a]] < 0 || number[ids[b]] < 0) continue;
        Block& block = matrix.at(number[ids[a]], number[ids[b]]);
        const double volume = sixVolumes / 6, shear = mu * dot(g[a], g[b]);
        for (int i = 0; i < 3; ++i)
        {
          for (int j = 0; j < 3; ++j)
            block[3 * i + j] += volume * (lambda * g[a][i] * g[b][j] + mu * g[a][j] * g[b][i] + (i == j ? shear : 0));
        }
      }
    }
  }
  return matrix;
}

// ---- conjugate gradients --------------------------------------------------------------------------------------------

using Vector = std::vector<Vec3>;

double dot(const Vector& a, const Vector& b)
{
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += dot(a[i], b[i]);
  return sum;
}

void multiply(const BlockMatrix& matrix, const Vector& x, Vector& y)
{
  const auto rows = [&](vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType row = begin; row < end; ++row)
    {
      Vec3 sum;
      for (std::int64_t k = matrix.rowStart[row]; k < matrix.rowStart[row + 1]; ++k)
      {
        const Block& m = matrix.blocks[k];
        const Vec3& v = x[matrix.columns[k]];
        sum += Vec3{ m[0] * v.x + m[1] * v.y + m[2] * v.z, m[3] * v.x + m[4] * v.y + m[5] * v.z,
                     m[6] * v.x + m[7] * v.y + m[8] * v.z };
      }
      y[row] = sum;
    }
  };
  vtkSMPTools::For(0, matrix.rows(), rows);
}

Vector inverseDiagonal(const BlockMatrix& matrix)
{
  Vector result(matrix.rows());
  for (std::int32_t row = 0; row < matrix.rows(); ++row)
  {
    const auto begin = matrix.columns.begin() + matrix.rowStart[row];
    const auto end = matrix.columns.begin() + matrix.rowStart[row + 1];
    const Block& m = matrix.blocks[std::lower_bound(begin, end, row) - matrix.columns.begin()];
    result[row] = { 1 / m[0], 1 / m[4], 1 / m[8] };
  }
  return result;
}

/// Symmetric tridiagonal; its eigenvalues lie within those of the preconditioned matrix, the outer ones soon at them.
struct LanczosMatrix
{
  std::vector<double> diagonal, beside;

  double smallest() const { return eigenvalue(0); }
  double largest() const { return eigenvalue(static_cast<int>(diagonal.size()) - 1); }

private:
  /// Eigenvalues below x, by Sturm's sequence.
  int countBelow(double x) const
  {
    int count = 0;
    double pivot = 1;
    for (std::size_t i = 0; i < diagonal.size(); ++i)
    {
      pivot = diagonal[i] - x - (i > 0 ? beside[i - 1] * beside[i - 1] / pivot : 0);
      if (pivot == 0) pivot = std::numeric_limits<double>::min();
      if (pivot < 0) ++count;
    }
    return count;
  }

  /// The eigenvalue that `below` others are smaller than; all are positive and at most 12: an element's matrix has at
  /// most the trace of its own diagonal's.
  double eigenvalue(int below) const
  {
    double low = 0, high = 12;
    while (high - low > 1e-12 * high)
    {
      const double middle = 0.5 * (low + high);
      if (middle <= low || middle >= high) break;
      (countBelow(middle) > below ? high : low) = middle;
    }
    return 0.5 * (low + high);
  }
};

struct Solution
{
  LanczosMatrix lanczos;
  int iterations = 0;
  bool converged = false;
};

Solution solve(const BlockMatrix& matrix, const Vector& load)
{
  Solution solution;
  const Vector inverse = inverseDiagonal(matrix);
  const auto precondition = [&](const Vector& r, Vector& z)
  {
    for (std::size_t i = 0; i < r.size(); ++i)
    {
      for (int axis = 0; axis < 3; ++axis) z[i][axis] = inverse[i][axis] * r[i][axis];
    }
  };
  Vector r = load, z(r.size()), product(r.size());
  precondition(r, z);
  Vector direction = z;
  const double enough = kTolerance * kTolerance * dot(load, load);
  const int most = 1000 + static_cast<int>(3 * load.size()); // rounding delays what n steps would end
  double rz = dot(r, z), stepBefore = 0, turnBefore = 0;
  for (; solution.iterations < most && dot(r, r) > enough; ++solution.iterations)
  {
    multiply(matrix, direction, product);
    const double energy = dot(direction, product);
    if (!(energy > 0)) return solution;
    const double step = rz / energy;
    for (std::size_t i = 0; i < r.size(); ++i) r[i] -= step * product[i];
    precondition(r, z);
    const double turn = dot(r, z) / rz;
    for (std::size_t i = 0; i < r.size(); ++i) direction[i] = z[i] + turn * direction[i];
    if (solution.iterations > 0) solution.lanczos.beside.push_back(std::sqrt(turnBefore) / stepBefore);
    solution.lanczos.diagonal.push_back(1 / step + (solution.iterations > 0 ? turnBefore / stepBefore : 0));
    stepBefore = step;
    turnBefore = turn;
    rz *= turn;
  }
  solution.converged = dot(r, r) <= enough;
  return solution;
}

// ---- loads ----------------------------------------------------------------------------------------------------------

/// A quarter of each tetrahedron's weight, at density 1, at each of its corners.
Vector ownWeight(const TetMesh& mesh, const std::vector<std::int32_t>& number, std::int32_t count)
{
  Vector load(count);
  for (const auto& ids : mesh.tetrahedra)
  {
    const auto& p = mesh.points;
    const double volume = orient(p[ids[0]], p[ids[1]], p[ids[2]], p[ids[3]]) / 6;
    for (const std::int32_t id : ids)
    {
      if (number[id] >= 0) load[number[id]].z -= volume / 4;
    }
  }
  return load;
}

/// Forces that excite every mode: numbers in [-1, 1) from a linear congruential generator (Knuth's MMIX).
Vector scatteredForces(std::int32_t count)
{
  std::uint64_t state = 1;
  const auto next = [&]
  {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return double(state >> 11) / double(std::uint64_t(1) << 52) - 1;
  };
  Vector load(count);
  for (Vec3& force : load)
  {
    for (int axis = 0; axis < 3; ++axis) force[axis] = next();
  }
  return load;
}

} // namespace

StiffnessConditioning stiffnessConditioning(const TetMesh& mesh)
{
  StiffnessConditioning result;
  std::int32_t free = 0;
  const std::vector<std::int32_t> number = numberFreePoints(mesh, free);
  result.unknowns = 3 * static_cast<std::size_t>(free);
  if (free == 0) return result;
  const BlockMatrix matrix = stiffness(mesh, number, free);
  const Solution weighed = solve(matrix, ownWeight(mesh, number, free));
  const Solution scattered = solve(matrix, scatteredForces(free));
  result.iterations = weighed.iterations;
  result.converged = weighed.converged && scattered.converged;
  if (!result.converged) return result;
  const LanczosMatrix &a = weighed.lanczos, &b = scattered.lanczos;
  result.condition = std::max(a.largest(), b.largest()) / std::min(a.smallest(), b.smallest());
  return result;
}

} // namespace surgicalmesher
