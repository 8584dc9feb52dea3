// SPDX-License-Identifier: Apache-2.0
#include "StiffPairs.h"

#include "LinearTetrahedron.h"
#include "PairMatrix.h"
#include "Parallel.h"
#include "TetQuality.h"
#include "VertexSteps.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace surgicalmesher
{

namespace
{

using Block = StiffnessBlock;

void add(Block& sum, const Block& block, double factor)
{
  for (std::size_t i = 0; i < block.size(); ++i) sum[i] += factor * block[i];
}

Block stiffnessOf(const LinearTetrahedron& tetrahedron, int a, int b)
{
  static const LameConstants lame = lameConstants(1, 0.4);
  return stiffnessBlock(tetrahedron, a, b, lame);
}

/// The shape of tetrahedron t with vertex v at p.
LinearTetrahedron shapeOf(const TetComplex& complex, std::int32_t t, std::int32_t v = -1, const Vec3& p = {})
{
  std::array<Vec3, 4> corners;
  const auto& x = complex.tets[t];
  for (int i = 0; i < 4; ++i) corners[i] = x[i] == v ? p : complex.points[x[i]];
  return linearTetrahedron(corners);
}

/// Returns the stiffness matrix of two vertices, scaled by its diagonal: `a` and `b` are their diagonal blocks,
/// `between` is the block that couples them.
PairMatrix scaledMatrix(const Block& a, const Block& b, const Block& between)
{
  std::array<double, 6> factors;
  for (int i = 0; i < 6; ++i) factors[i] = 1 / std::sqrt(i < 3 ? a[4 * i] : b[4 * (i - 3)]);
  PairMatrix m;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
    {
      m[i][k] = factors[i] * factors[k] * a[3 * i + k];
      m[i + 3][k + 3] = factors[i + 3] * factors[k + 3] * b[3 * i + k];
      m[i][k + 3] = m[k + 3][i] = factors[i] * factors[k + 3] * between[3 * i + k];
    }
  return m;
}

/// Returns whether the block's diagonal is positive, which inverted tetrahedra can prevent.
bool isPositive(const Block& own) { return own[0] > 0 && own[4] > 0 && own[8] > 0; }
constexpr double outOfTheQuestion = 6; // the trace of a PairMatrix, which no eigenvalue exceeds

/// Returns the entry of a vertex; appends one if there is none.
template <class Entry>
Entry& entryOf(std::int32_t vertex, std::vector<Entry>& entries)
{
  const auto found =
    std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) { return entry.vertex == vertex; });
  if (found != entries.end()) return *found;
  entries.push_back({ vertex, {} });
  return entries.back();
}

class StiffPairs
{
public:
  StiffPairs(GuardedOperations& operations, const StiffPairOptions& options)
    : m_Operations(operations), m_Complex(operations.complex()), m_Options(options),
      m_Good(sine2OfDegrees(options.goodAngle)), m_Diagonal(m_Complex.points.size())
  {
    for (std::int32_t t = 0; t < std::int32_t(m_Complex.tets.size()); ++t)
      if (m_Complex.alive(t)) addDiagonals(t, 1);
  }

  void run()
  {
    for (const auto& [value, a, b] : stiffPairs())
      for (const std::int32_t v : { a, b })
        if (!m_Complex.locked[v]) soften(v);
  }

private:
  struct Pair
  {
    double value;
    std::int32_t a, b;
  };
  struct Neighbour
  {
    std::int32_t vertex;
    Block between{};
  };

  void addDiagonals(std::int32_t t, double factor)
  {
    if (m_Complex.labels[t] == 0) return;
    const LinearTetrahedron shape = shapeOf(m_Complex, t);
    for (int i = 0; i < 4; ++i) add(m_Diagonal[m_Complex.tets[t][i]], stiffnessOf(shape, i, i), factor);
  }

  /// A neighbour of the vertex being moved, and its corners in the tetrahedra at that vertex.
  struct Side
  {
    std::int32_t vertex;
    std::vector<std::pair<std::size_t, int>> corners; ///< (index in m_Tissues, corner of that tetrahedron)
  };

  /// Fills m_Tissues and m_Sides, in the order of the star.
  void gatherSides(std::int32_t v)
  {
    m_Tissues.clear();
    m_Sides.clear();
    for (const std::int32_t t : m_Operations.star(v))
    {
      if (m_Complex.labels[t] == 0) continue;
      const int at = m_Complex.indexOf(t, v);
      for (int i = 0; i < 4; ++i)
        if (i != at) entryOf(m_Complex.tets[t][i], m_Sides).corners.emplace_back(m_Tissues.size(), i);
      m_Tissues.push_back({ t, at });
    }
  }

  /// Fills m_Shapes with the shapes of the tetrahedra at v with v at p. Returns v's diagonal block.
  Block shapesAt(std::int32_t v, const Vec3& p)
  {
    Block own{};
    m_Shapes.clear();
    for (const auto& [t, at] : m_Tissues)
    {
      m_Shapes.push_back(shapeOf(m_Complex, t, v, p));
      add(own, stiffnessOf(m_Shapes.back(), at, at), 1);
    }
    return own;
  }

  /// Returns the matrix of the pair of v and a neighbour, `own` being v's diagonal block; nothing if tetrahedra are
  /// inverted.
  std::optional<PairMatrix> matrixOf(const Side& side, const Block& own) const
  {
    Block others{}, between{};
    for (const auto& [n, corner] : side.corners)
    {
      add(others, stiffnessOf(m_Shapes[n], corner, corner), 1);
      add(between, stiffnessOf(m_Shapes[n], m_Tissues[n].second, corner), 1);
    }
    add(others, m_Diagonal[side.vertex], 1);
    if (!isPositive(others)) return {};
    return scaledMatrix(own, others, between);
  }

  /// Adds the stiff pairs of v and neighbours with higher numbers; `star`: the tetrahedra at v.
  void addStiffPairs(std::int32_t v, const std::vector<std::int32_t>& star, std::vector<Pair>& pairs) const
  {
    std::vector<Neighbour> neighbours;
    neighbours.reserve(star.size());
    for (const std::int32_t t : star)
    {
      const auto& x = m_Complex.tets[t];
      if (m_Complex.labels[t] == 0 || *std::max_element(x.begin(), x.end()) == v) continue;
      const LinearTetrahedron shape = shapeOf(m_Complex, t);
      const int at = m_Complex.indexOf(t, v);
      for (int i = 0; i < 4; ++i)
        if (x[i] > v) add(entryOf(x[i], neighbours).between, stiffnessOf(shape, at, i), 1);
    }
    for (const Neighbour& n : neighbours)
    {
      const PairMatrix matrix = scaledMatrix(m_Diagonal[v], m_Diagonal[n.vertex], n.between);
      if (!areEigenvaluesBelow(m_Options.eigenvalue, matrix))
        pairs.push_back({ largestEigenvalue(matrix), v, n.vertex });
    }
  }

  /// Returns the pairs whose eigenvalue is not below the option's, stiffest first.
  std::vector<Pair> stiffPairs() const
  {
    constexpr std::size_t parts = 16;
    const std::size_t count = m_Complex.points.size();
    std::vector<std::vector<Pair>> found(parts);
    parallelForIfIdle(parts,
                      [&](std::size_t part)
                      {
                        TetComplex::Marks marks{ std::vector<std::uint32_t>(m_Complex.tets.size(), 0) };
                        std::vector<std::int32_t> star;
                        for (std::size_t v = part * count / parts; v < (part + 1) * count / parts; ++v)
                        {
                          if (m_Complex.vertexTet[v] < 0) continue;
                          m_Complex.star(std::int32_t(v), star, marks);
                          addStiffPairs(std::int32_t(v), star, found[part]);
                        }
                      });
    std::vector<Pair> pairs;
    for (const std::vector<Pair>& of : found) pairs.insert(pairs.end(), of.begin(), of.end());
    std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) { return x.value > y.value; });
    return pairs;
  }

  /// Returns the largest eigenvalue among the pairs of v, with v at p: `least` if none is above it, `most` if one is
  /// not below it. The tetrahedra at v must have been subtracted from m_Diagonal.
  double largestAt(std::int32_t v, const Vec3& p, double least, double most = outOfTheQuestion)
  {
    const Block own = shapesAt(v, p);
    if (!isPositive(own)) return outOfTheQuestion;
    for (Side& side : m_Sides)
    {
      const std::optional<PairMatrix> matrix = matrixOf(side, own);
      if (!matrix) return outOfTheQuestion;
      if (areEigenvaluesBelow(least, *matrix)) continue;
      const bool isRefused = !areEigenvaluesBelow(most, *matrix);
      const double largest = isRefused ? most : largestEigenvalue(*matrix);
      least = std::max(least, largest);
      if (least == largest) std::swap(side, m_Sides[0]); // probably the stiffest at the next position, too
      if (isRefused) return most;
    }
    return least;
  }

  void soften(std::int32_t v)
  {
    const std::vector<std::int32_t> star = m_Operations.star(v);
    gatherSides(v);
    for (const std::int32_t t : star) addDiagonals(t, -1);
    descend(v);
    for (const std::int32_t t : star) addDiagonals(t, 1);
  }

  Vec3 downhill(std::int32_t v, double now)
  {
    const Vec3 p = m_Complex.points[v];
    const double h = 1e-4 * m_Complex.lengths[v], near = 0.99 * now;
    Vec3 way;
    for (int axis = 0; axis < 3; ++axis)
    {
      Vec3 q = p;
      q[axis] += h;
      way[axis] = now - largestAt(v, q, near);
    }
    return way;
  }

  void descend(std::int32_t v)
  {
    const Vec3 start = m_Complex.points[v];
    const double soft = m_Options.eigenvalue;
    double now = largestAt(v, start, soft);
    if (now <= soft) return;
    const double size = m_Complex.lengths[v], floor = std::min(m_Good, m_Operations.qualityAt(v));
    const Quadric held = heldAt(m_Operations, v, m_Options.ease);
    double step = 0.08 * size;
    Vec3 down = downhill(v, now);
    for (int trial = 0; trial < m_Options.trials && now > soft && step > 0.01 * size; ++trial)
    {
      const Vec3 way = easiest(m_Operations, v, held, trial % 2 == 1 ? m_Directions.next() : down);
      const Vec3 q = m_Complex.points[v] + step * way;
      const bool isGood = norm(q - start) <= m_Options.reach * size && m_Operations.qualityAt(v, q, floor) >= floor;
      const double after = isGood ? largestAt(v, q, soft, now) : now;
      const bool moved = after < now && m_Operations.moveWithin(v, q);
      if (moved) now = after;
      if (moved && now > soft) down = downhill(v, now);
      step *= moved ? 1.3 : 0.8;
    }
  }

  GuardedOperations& m_Operations;
  const TetComplex& m_Complex;
  const StiffPairOptions& m_Options;
  const double m_Good;
  std::vector<Block> m_Diagonal;                       ///< diagonal block of each vertex
  std::vector<std::pair<std::int32_t, int>> m_Tissues; ///< tetrahedra of tissues at v, and v's corner in each
  std::vector<LinearTetrahedron> m_Shapes;             ///< shapes of m_Tissues
  std::vector<Side> m_Sides;
  Directions m_Directions;
};

} // namespace

double pairEigenvalue(const TetComplex& complex, std::int32_t a, std::int32_t b)
{
  Block ofA{}, ofB{}, between{};
  for (std::int32_t t = 0; t < std::int32_t(complex.tets.size()); ++t)
  {
    if (!complex.alive(t) || complex.labels[t] == 0) continue;
    const auto& x = complex.tets[t];
    const auto cornerOf = [&](std::int32_t v) { return int(std::find(x.begin(), x.end(), v) - x.begin()); };
    const int i = cornerOf(a), k = cornerOf(b);
    if (i == 4 && k == 4) continue;
    const LinearTetrahedron shape = shapeOf(complex, t);
    if (i < 4) add(ofA, stiffnessOf(shape, i, i), 1);
    if (k < 4) add(ofB, stiffnessOf(shape, k, k), 1);
    if (i < 4 && k < 4) add(between, stiffnessOf(shape, i, k), 1);
  }
  return largestEigenvalue(scaledMatrix(ofA, ofB, between));
}

void softenPairsOfBlock(GuardedOperations& operations, const StiffPairOptions& options)
{
  StiffPairs(operations, options).run();
}

} // namespace surgicalmesher
