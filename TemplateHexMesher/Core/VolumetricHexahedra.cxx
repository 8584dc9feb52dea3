// SPDX-License-Identifier: Apache-2.0
#include "VolumetricHexahedra.h"

#include "ChartMap.h"
#include "HoleFit.h"
#include "Parallel.h"

#include <algorithm>

namespace surgicalmesher
{
namespace
{

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kSamples = 4; ///< samples along each side of a grid square, for its share in a hole

/// Values for the squares of a grid, columns from right to left and rows from bottom to top, or for its crossings.
template <class Value>
struct Plane
{
  int columns, rows;
  std::vector<Value> values;

  Plane(int c, int r, const Value& value = {}) : columns(c), rows(r), values(std::size_t(c) * r, value) {}
  Value& at(int i, int k) { return values[std::size_t(k) * columns + i]; }
  const Value& at(int i, int k) const { return values[std::size_t(k) * columns + i]; }
};

/// Returns the share of each square that lies in a hole, averaged over the outer and the inner surface.
Plane<double> holeShares(const ChartMap& outer, const ChartMap& inner, int columns, int rows)
{
  Plane<double> shares(columns, rows);
  parallelFor(shares.values.size(),
              [&](std::size_t cell)
              {
                const auto i = int(cell) % columns, k = int(cell) / columns;
                int inHole = 0;
                for (int s = 0; s < kSamples * kSamples; ++s)
                {
                  const int right = s % kSamples, up = s / kSamples;
                  const Vector2d at((i + (right + 0.5) / kSamples) / columns, (k + (up + 0.5) / kSamples) / rows);
                  inHole += int(outer.at(at).inHole) + int(inner.at(at).inHole);
                }
                shares.values[cell] = inHole / (2. * kSamples * kSamples);
              });
  return shares;
}

/// Fills squares until no two kept squares touch only at a corner, where the mesh would be connected by an edge only.
void withoutPinches(Plane<char>& kept, const Plane<double>& shares)
{
  for (bool changed = true; changed;)
  {
    changed = false;
    for (int k = 1; k < kept.rows; ++k)
    {
      for (int i = 1; i < kept.columns; ++i)
      {
        const bool a = kept.at(i - 1, k - 1), b = kept.at(i, k - 1), c = kept.at(i - 1, k), d = kept.at(i, k);
        if (a != d || b != c || a == b) continue;
        const std::array<int, 2> first = { a ? i : i - 1, k - 1 }, second = { a ? i - 1 : i, k };
        const bool fillFirst = shares.at(first[0], first[1]) <= shares.at(second[0], second[1]);
        const auto& filled = fillFirst ? first : second;
        kept.at(filled[0], filled[1]) = 1;
        changed = true;
      }
    }
  }
}

Plane<char> keptSquares(const ChartMap& outer, const ChartMap& inner, int columns, int rows)
{
  const Plane<double> shares = holeShares(outer, inner, columns, rows);
  Plane<char> kept(columns, rows, 0);
  for (std::size_t c = 0; c < kept.values.size(); ++c) kept.values[c] = shares.values[c] <= 0.5;
  withoutPinches(kept, shares);
  return kept;
}

/// Counts the squares around a crossing: those kept, and all.
std::array<int, 2> squaresAround(const Plane<char>& kept, int i, int k)
{
  std::array<int, 2> count{};
  for (int r = std::max(0, k - 1); r <= std::min(k, kept.rows - 1); ++r)
  {
    for (int c = std::max(0, i - 1); c <= std::min(i, kept.columns - 1); ++c)
    {
      count[0] += kept.at(c, r);
      ++count[1];
    }
  }
  return count;
}

void addNodes(const ChartMap& outer, const ChartMap& inner, const Plane<char>& kept, const HexOptions& options,
              Plane<std::int32_t>& first, LayeredMesh& result)
{
  const int layers = options.divisions[1];
  std::vector<std::array<Vector3d, 2>> ends;
  for (int k = 0; k <= kept.rows; ++k)
  {
    for (int i = 0; i <= kept.columns; ++i)
    {
      const auto [around, all] = squaresAround(kept, i, k);
      if (around == 0) continue;
      first.at(i, k) = std::int32_t(result.nodes.size());
      const Vector2d at(double(i) / kept.columns, double(k) / kept.rows);
      ends.push_back({ outer.at(at).position, inner.at(at).position });
      for (int l = 0; l <= layers; ++l)
      {
        result.nodes.push_back({ i, l, k });
        result.atHole.push_back(around < all);
      }
    }
  }
  result.mesh.points.resize(3, Eigen::Index(result.nodes.size()));
  for (std::size_t c = 0; c < ends.size(); ++c)
  {
    const std::vector<double> depths = layerDepths((ends[c][1] - ends[c][0]).norm(), options);
    for (int l = 0; l <= layers; ++l)
      result.mesh.points.col(Eigen::Index(c) * (layers + 1) + l) =
        (1 - depths[l]) * ends[c][0] + depths[l] * ends[c][1];
  }
}

void addElements(const Plane<char>& kept, const Plane<std::int32_t>& first, int layers, LayeredMesh& result)
{
  for (int k = 0; k < kept.rows; ++k)
  {
    for (int l = 0; l < layers; ++l)
    {
      for (int i = 0; i < kept.columns; ++i)
      {
        if (!kept.at(i, k)) continue;
        Element element;
        const std::int32_t corners[4] = { first.at(i, k), first.at(i + 1, k), first.at(i + 1, k + 1),
                                          first.at(i, k + 1) };
        for (int c = 0; c < 4; ++c)
        {
          element.nodes[c] = corners[c] + l + 1;
          element.nodes[c + 4] = corners[c] + l;
        }
        result.mesh.elements.push_back(element);
        result.cells.push_back({ i, l, k });
      }
    }
  }
}

/// Inverts all elements if their total volume is negative: the handedness of the envelope's sides is not prescribed.
void windPositively(ElementMesh& mesh)
{
  double volume = 0;
  for (const Element& element : mesh.elements) volume += volumeOf(element, mesh.points);
  if (volume >= 0) return;
  for (Element& element : mesh.elements)
  {
    for (int c = 0; c < 4; ++c) std::swap(element.nodes[c], element.nodes[c + 4]);
  }
}

} // namespace

std::vector<double> layerDepths(double thickness, const HexOptions& options)
{
  const int count = options.divisions[1];
  const double even = thickness / count, limit = options.layers * options.outermost;
  const double towards = std::clamp(3 * (thickness - limit) / limit, 0.0, 1.0);
  double outermost = even;
  if (count > 2 && limit > 0) outermost += towards * (options.outermost - even);
  std::vector<double> depths{ 0 };
  for (int l = 0; l < count - 1; ++l)
  {
    const double inside = (thickness - 2 * outermost) / std::max(1, count - 2);
    depths.push_back(thickness > 0 ? (outermost + l * inside) / thickness : (l + 1.) / count);
  }
  depths.push_back(1);
  return depths;
}

LayeredMesh layeredHexahedra(const SlabParameterisation& slab, const HexOptions& options, const Progress& progress)
{
  report(progress, 0, "mapping the divided cube");
  const ChartMap outer(slab.outer), inner(slab.inner);
  const int columns = options.divisions[0], rows = options.divisions[2];
  const Plane<char> kept = keptSquares(outer, inner, columns, rows);
  Plane<std::int32_t> first(columns + 1, rows + 1, -1);
  LayeredMesh result;
  result.divisions = options.divisions;
  addNodes(outer, inner, kept, options, first, result);
  addElements(kept, first, options.divisions[1], result);
  windPositively(result.mesh);
  fitToHoles(result, slab.envelope, { outer.holes(), inner.holes() }, options.repairRounds,
             subProgress(progress, 0.3, 1));
  return result;
}

} // namespace surgicalmesher
