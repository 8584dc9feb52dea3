// SPDX-License-Identifier: Apache-2.0
#include "SmoothBoundary.h"

#include "Grouped.h"
#include "InterfaceSmoothing.h"
#include "LabelRuns.h"
#include "Parallel.h"
#include "VolumeOffsets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <unordered_map>

namespace surgicalmesher
{

namespace
{

constexpr double mostOffset = 0.3;   // voxels; largest offset of a tissue's boundary
constexpr double perGaussian = 1.5;  // standard deviation of the fit's weights, in that of the Gaussian
constexpr double reach = 2.2;        // radius of the fit, in standard deviations of its weights
constexpr double leastCosine = 0.35; // between normals; other samples do not take part in a fit
constexpr double margin = 0.14;      // voxels; distance of the boundary from the centres of the voxels beside a face

using Index = std::array<int, 3>;

/// A point of the smooth boundary, in voxel coordinates: the centre of voxel (i, j, k) is at (i, j, k).
struct Point
{
  Index lower; ///< voxel below the point's voxel face; the other voxel follows along `axis`
  int axis;
  Label inside; ///< the larger of the two labels
  Label outside;
  bool isInsideBelow; ///< whether `lower` has label `inside`
  Vec3 position;
  Vec3 normal;          ///< unit, out of `inside`
  double curvature = 0; ///< see Quadric::curvature, 1/voxel
  double scale = 1;     ///< factor on the width of the smoothing, see scaleAt

  Vec3 centre() const
  {
    Vec3 c{ double(lower[0]), double(lower[1]), double(lower[2]) };
    c[axis] += 0.5;
    return c;
  }
};

/// The integral of a one-dimensional Gaussian of standard deviation `sigma` over a voxel at distance x, and its
/// derivative.
class VoxelWeight
{
public:
  explicit VoxelWeight(double sigma) : m_Window(3 * sigma + 0.5), m_Reach(int(std::ceil(3 * sigma)) + 1)
  {
    const int n = m_Reach * perVoxel;
    for (int i = -n - 1; i <= n + 1; ++i)
    {
      const double x = double(i) / perVoxel, low = (x - 0.5) / sigma, high = (x + 0.5) / sigma;
      m_Values.push_back(0.5 * (std::erf(high * M_SQRT1_2) - std::erf(low * M_SQRT1_2)));
      m_Slopes.push_back((std::exp(-0.5 * high * high) - std::exp(-0.5 * low * low)) / (sigma * std::sqrt(2 * M_PI)));
    }
  }

  /// Distance beyond which voxels have hardly any weight, in voxels.
  double window() const { return m_Window; }

  /// Returns value and derivative at x, for |x| up to window().
  std::pair<double, double> operator()(double x) const
  {
    const double at = std::clamp((x + m_Reach) * perVoxel + 1, 0.0, double(m_Values.size()) - 1.001);
    const std::size_t i = std::size_t(at);
    const double t = at - double(i);
    return { m_Values[i] + t * (m_Values[i + 1] - m_Values[i]), m_Slopes[i] + t * (m_Slopes[i + 1] - m_Slopes[i]) };
  }

private:
  static constexpr int perVoxel = 128;
  double m_Window;
  int m_Reach;
  std::vector<double> m_Values, m_Slopes;
};

/// Returns the factor on the width of the smoothing where L is `length` voxels. For long triangles the steps of the
/// voxels are noise: to follow them would create short edges, which then have to be repaired.
double scaleAt(double length)
{
  constexpr double from = 8, perVoxel = 0.4, most = 4;
  return std::clamp(1 + perVoxel * (length - from), 1.0, most);
}

/// Moves points to where the smoothed indicators of their two labels are equal.
class IndicatorTie
{
public:
  IndicatorTie(const TissueMap& map, double sigma) : m_Map(map)
  {
    for (const double share : { 2.5, 1.8, 1.35, 1.0, 0.7, 0.5, 0.35 })
      m_Gaussians.push_back({ share, VoxelWeight(share * sigma) });
  }

  void place(Point& point) const
  {
    constexpr double ofScale = 0.7, usualWay = 0.6; // voxels
    const double widest = std::max(1.0, ofScale * point.scale);
    for (const auto& [share, weight] : m_Gaussians)
      if (share <= widest && follow(point, weight, usualWay * std::max(1.0, share))) return;
    point.position = point.centre();
    point.normal = {};
    point.normal[point.axis] = point.isInsideBelow ? 1 : -1;
  }

private:
  /// Newton steps along the gradient from the face's centre. Returns false if the two indicators are not equal anywhere
  /// near, or only farther than `farthest` voxels away.
  bool follow(Point& point, const VoxelWeight& weight, double farthest) const
  {
    const Vec3 home = point.centre();
    Vec3 p = home;
    for (int step = 0; step < 3; ++step)
    {
      const auto [value, gradient] = difference(point, p, weight);
      const double slope = norm(gradient);
      if (!(slope > 0.05)) return false;
      p += (-value / (slope * slope)) * gradient;
      if (squaredNorm(p - home) > farthest * farthest) return false;
      point.normal = -1.0 / slope * gradient;
    }
    if ((point.normal[point.axis] > 0) != point.isInsideBelow) return false;
    point.position = p;
    return true;
  }

  /// Returns the difference of the smoothed indicators of the point's two labels at p, and its gradient.
  std::pair<double, Vec3> difference(const Point& point, const Vec3& p, const VoxelWeight& weight) const
  {
    constexpr int most = 16;
    std::array<std::array<std::pair<double, double>, most>, 3> w;
    Index low, count;
    for (int a = 0; a < 3; ++a)
    {
      low[a] = int(std::ceil(p[a] - weight.window()));
      count[a] = std::min(most, int(std::floor(p[a] + weight.window())) - low[a] + 1);
      for (int i = 0; i < count[a]; ++i) w[a][i] = weight(low[a] + i - p[a]);
    }
    std::array<std::pair<double, double>, most + 1> ofFirst; // sums over the first n voxels of a row
    for (int i = 0; i < count[0]; ++i)
      ofFirst[i + 1] = { ofFirst[i].first + w[0][i].first, ofFirst[i].second + w[0][i].second };
    const auto signOf = [&](Label label) { return double(label == point.inside) - double(label == point.outside); };
    const bool isWithin = isInMap(low, count);
    std::array<Label, most> row;
    double value = 0;
    Vec3 gradient; // with respect to p: minus the derivatives of the weights, which are with respect to the voxels
    for (int k = 0; k < count[2]; ++k)
      for (int j = 0; j < count[1]; ++j)
      {
        const Label* const labels = isWithin ? labelsFrom({ low[0], low[1] + j, low[2] + k }) : row.data();
        for (int i = 0; i < count[0] && !isWithin; ++i) row[i] = labelAt(m_Map, { low[0] + i, low[1] + j, low[2] + k });
        int i = int(runLength(labels, std::size_t(count[0]))); // most rows have one label
        double sum = signOf(labels[0]) * ofFirst[i].first, slope = signOf(labels[0]) * ofFirst[i].second;
        for (; i < count[0]; ++i)
        {
          sum += signOf(labels[i]) * w[0][i].first;
          slope += signOf(labels[i]) * w[0][i].second;
        }
        value += sum * w[1][j].first * w[2][k].first;
        gradient.x -= slope * w[1][j].first * w[2][k].first;
        gradient.y -= sum * w[1][j].second * w[2][k].first;
        gradient.z -= sum * w[1][j].first * w[2][k].second;
      }
    return { value, gradient };
  }

  /// Returns whether all voxels of the box lie in the map.
  bool isInMap(const Index& low, const Index& count) const
  {
    for (int a = 0; a < 3; ++a)
      if (low[a] < 0 || low[a] + count[a] > m_Map.grid.size[a]) return false;
    return true;
  }

  /// Returns the labels of the map from a voxel on along its row.
  const Label* labelsFrom(const Index& voxel) const
  {
    const Index& size = m_Map.grid.size;
    return m_Map.labels.data() + (std::size_t(voxel[2]) * size[1] + voxel[1]) * size[0] + voxel[0];
  }

  const TissueMap& m_Map;
  std::vector<std::pair<double, VoxelWeight>> m_Gaussians; ///< factor on the standard deviation; widest first
};

std::uint32_t labelsOf(const Point& point) { return std::uint32_t(point.inside) << 16 | point.outside; }

/// Search structure for points in the order of their lower voxels: rows of voxels, cut into stretches.
class PointRows
{
public:
  PointRows(const std::vector<Point>& points, const Index& size)
    : m_Points(points), m_Size(size), m_PerRow(std::size_t(size[0] + 1) / stretch + 1)
  {
    m_Start.assign(std::size_t(size[1] + 1) * (size[2] + 1) * m_PerRow + 1, 0);
    for (const Point& p : points) ++m_Start[stretchOf(p.lower[0], p.lower[1], p.lower[2]) + 1];
    std::partial_sum(m_Start.begin(), m_Start.end(), m_Start.begin());
  }

  /// Calls f(point) for the points whose lower voxels are at most `radius` voxels from `voxel` along each axis.
  template <class F>
  void forEachNear(const Index& voxel, int radius, F&& f) const
  {
    const int first = std::max(-1, voxel[0] - radius), last = std::min(m_Size[0] - 1, voxel[0] + radius);
    for (int k = std::max(-1, voxel[2] - radius); k <= std::min(m_Size[2] - 1, voxel[2] + radius); ++k)
      for (int j = std::max(-1, voxel[1] - radius); j <= std::min(m_Size[1] - 1, voxel[1] + radius); ++j)
      {
        const std::size_t end = m_Start[stretchOf(last, j, k) + 1];
        for (std::size_t i = m_Start[stretchOf(first, j, k)]; i < end; ++i)
          if (m_Points[i].lower[0] >= first && m_Points[i].lower[0] <= last) f(m_Points[i]);
      }
  }

private:
  static constexpr int stretch = 16; // voxels

  /// Returns the number of the stretch that contains voxel (i, j, k).
  std::size_t stretchOf(int i, int j, int k) const
  {
    return (std::size_t(k + 1) * (m_Size[1] + 1) + (j + 1)) * m_PerRow + std::size_t(i + 1) / stretch;
  }

  const std::vector<Point>& m_Points;
  Index m_Size;
  std::size_t m_PerRow;
  std::vector<std::int32_t> m_Start; ///< first point of each stretch, and the end
};

/// Search structure for points between the same two labels: only rows that have such points, in the order of their
/// lower voxels. Skipping points between other labels one by one would take half the time of the fits in an atlas.
class LikePoints
{
public:
  /// `points` in the order of their lower voxels.
  explicit LikePoints(const std::vector<Point>& points) : m_Points(points)
  {
    std::vector<std::pair<std::uint32_t, std::int32_t>> order(points.size());
    parallelFor(points.size(), [&](std::size_t i) { order[i] = { labelsOf(points[i]), std::int32_t(i) }; });
    vtkSMPTools::Sort(order.begin(), order.end());
    m_Entries.reserve(points.size());
    for (const auto& [labels, i] : order) add(labels, i);
    m_Slices.push_back(std::int32_t(m_Rows.size()));
    m_Rows.push_back({ 0, std::int32_t(m_Entries.size()) });
  }

  /// Calls f for the points with the labels of `point` whose lower voxels are at most `radius` voxels from its own
  /// along each axis.
  template <class F>
  void forEachLike(const Point& point, int radius, F&& f) const
  {
    const auto [x, y, z] = point.lower;
    const Pair& pair = *std::lower_bound(m_Pairs.begin(), m_Pairs.end(), labelsOf(point),
                                         [](const Pair& p, std::uint32_t labels) { return p.labels < labels; });
    const int last = std::min(z + radius - pair.first, pair.slices - 1);
    for (int k = std::max(0, z - radius - pair.first); k <= last; ++k)
    {
      const auto end = m_Rows.begin() + m_Slices[pair.begin + k + 1];
      auto row = std::lower_bound(m_Rows.begin() + m_Slices[pair.begin + k], end, y - radius,
                                  [](const Row& r, int j) { return r.j < j; });
      for (; row != end && row->j <= y + radius; ++row)
        for (std::int32_t i = row->begin; i < row[1].begin && m_Entries[i].x <= x + radius; ++i)
          if (m_Entries[i].x >= x - radius) f(m_Points[m_Entries[i].point]);
    }
  }

private:
  struct Pair
  {
    std::uint32_t labels;
    int first;          ///< index k of its first slice
    int slices;         ///< number of its slices
    std::int32_t begin; ///< index of its first slice in m_Slices
  };
  struct Row
  {
    int j;
    std::int32_t begin; ///< index of its first point in m_Entries
  };
  struct Entry
  {
    std::int32_t x, point;
  };

  /// Appends point i; points must come sorted by labels, then by lower voxel.
  void add(std::uint32_t labels, std::int32_t i)
  {
    const auto [x, y, z] = m_Points[i].lower;
    const bool isNewPair = m_Pairs.empty() || m_Pairs.back().labels != labels;
    if (isNewPair) m_Pairs.push_back({ labels, z, 0, std::int32_t(m_Slices.size()) });
    Pair& pair = m_Pairs.back();
    const bool isNewSlice = z >= pair.first + pair.slices;
    for (; pair.slices <= z - pair.first; ++pair.slices) m_Slices.push_back(std::int32_t(m_Rows.size()));
    if (isNewSlice || m_Rows.back().j != y) m_Rows.push_back({ y, std::int32_t(m_Entries.size()) });
    m_Entries.push_back({ x, i });
  }

  const std::vector<Point>& m_Points;
  std::vector<Pair> m_Pairs;          ///< by labels
  std::vector<std::int32_t> m_Slices; ///< first row of each pair's slices, and the end
  std::vector<Row> m_Rows;            ///< rows with points, and the end
  std::vector<Entry> m_Entries;
};

/// Weighted least squares for the height a0 + a1 u + a2 v + a3 u^2 + a4 u v + a5 v^2.
class HeightFit
{
public:
  void add(double u, double v, double height, double weight)
  {
    m_Squares += weight * height * height;
    m_Weight += weight;
    const double basis[6] = { 1, u, v, u * u, u * v, v * v };
    for (int i = 0; i < 6; ++i)
    {
      m_Right[i] += weight * basis[i] * height;
      for (int j = 0; j <= i; ++j) m_Matrix[i][j] += weight * basis[i] * basis[j];
    }
  }

  double weight() const { return m_Weight; }

  /// Returns the weighted root mean square of the heights' residuals for the solution a.
  double misfit(const double (&a)[6]) const
  {
    double left = m_Squares;
    for (int i = 0; i < 6; ++i) left -= a[i] * m_Right[i];
    return std::sqrt(std::max(0.0, left) / m_Weight);
  }

  /// Solves for the coefficients a. A spring on the quadratic terms makes few points give a plane. Returns false if
  /// there are too few points even for a plane.
  bool solve(double spring, double (&a)[6])
  {
    for (int i = 3; i < 6; ++i) m_Matrix[i][i] += spring * weight();
    for (int i = 0; i < 6; ++i)
    {
      for (int j = 0; j <= i; ++j)
      {
        double sum = m_Matrix[i][j];
        for (int k = 0; k < j; ++k) sum -= m_Matrix[i][k] * m_Matrix[j][k];
        if (i == j && !(sum > 1e-6 * m_Matrix[0][0])) return false;
        m_Matrix[i][j] = i == j ? std::sqrt(sum) : sum / m_Matrix[j][j];
      }
      a[i] = m_Right[i];
      for (int k = 0; k < i; ++k) a[i] -= m_Matrix[i][k] * a[k];
      a[i] /= m_Matrix[i][i];
    }
    for (int i = 5; i >= 0; --i)
    {
      for (int k = i + 1; k < 6; ++k) a[i] -= m_Matrix[k][i] * a[k];
      a[i] /= m_Matrix[i][i];
    }
    return true;
  }

private:
  double m_Matrix[6][6] = {}, m_Right[6] = {}, m_Squares = 0, m_Weight = 0;
};

/// Returns two unit vectors that form an orthonormal frame with the unit vector n.
std::pair<Vec3, Vec3> frameOf(const Vec3& n)
{
  const Vec3 other = std::abs(n.x) < 0.6 ? Vec3{ 1, 0, 0 } : Vec3{ 0, 1, 0 };
  Vec3 u = cross(n, other);
  u = u / norm(u);
  return { u, cross(n, u) };
}

/// Moves the point along its normal so that the centres of the two voxels beside its face stay on their sides of its
/// plane, at least `margin` away. Wider smoothing reduces this distance by scale - 1 voxels, so that the centres may
/// even lie on the other side.
void keepLabels(Point& point)
{
  Vec3 below{ double(point.lower[0]), double(point.lower[1]), double(point.lower[2]) }, above = below;
  above[point.axis] += 1;
  const Vec3& in = point.isInsideBelow ? below : above;
  const Vec3& out = point.isInsideBelow ? above : below;
  const double room = margin - (point.scale - 1);
  const double least = dot(point.normal, in - point.position) + room;
  const double most = dot(point.normal, out - point.position) - room;
  if (least > 0 && most > least) point.position += least * point.normal;
  else if (most < 0 && most > least) point.position += most * point.normal;
}

/// The boundary near a point as a quadratic height field over a plane, fitted to neighbours with the same labels, and
/// measures of its reliability.
struct Quadric
{
  Vec3 origin, normal, u, v; ///< the plane's, orthonormal
  double sigma;              ///< standard deviation of the fit's weights, voxels
  double a[6];               ///< coefficients as in HeightFit, with u and v in units of `sigma`
  double misfit;             ///< root mean square residual of the neighbours, voxels
  double cover;              ///< sum of the weights, as a share of that of a boundary that continues all around

  /// Returns the root of the sum of the squared principal curvatures at the origin, 1/voxel, for small slopes.
  double curvature() const { return 2 * std::sqrt(a[3] * a[3] + a[5] * a[5] + 0.5 * a[4] * a[4]) / (sigma * sigma); }

  /// Returns `point` moved along the plane's normal onto the quadric, with the quadric's normal and curvature.
  Point onto(Point point) const
  {
    const Vec3 d = point.position - origin;
    const double s = dot(u, d) / sigma, t = dot(v, d) / sigma;
    const double height = a[0] + a[1] * s + a[2] * t + a[3] * s * s + a[4] * s * t + a[5] * t * t;
    const Vec3 across =
      normal - (a[1] + 2 * a[3] * s + a[4] * t) / sigma * u - (a[2] + a[4] * s + 2 * a[5] * t) / sigma * v;
    point.position += (height - dot(normal, d)) * normal;
    point.normal = across / norm(across);
    point.curvature = curvature();
    return point;
  }
};

/// Returns the fit at a point; nothing if there are too few neighbours.
std::optional<Quadric> quadricAt(const Point& point, const LikePoints& all, double sigma)
{
  const double squaredReach = reach * reach * sigma * sigma;
  const std::pair<Vec3, Vec3> frame = frameOf(point.normal);
  const Vec3 &u = frame.first, &v = frame.second;
  HeightFit fit;
  all.forEachLike(point, int(std::ceil(reach * sigma)),
                  [&](const Point& other)
                  {
                    const Vec3 d = other.position - point.position;
                    const double d2 = squaredNorm(d), cosine = dot(other.normal, point.normal);
                    if (d2 > squaredReach || cosine < leastCosine) return;
                    // A voxel face is weighted by the area of the boundary that it represents.
                    const double area = std::abs(other.normal[other.axis]);
                    const double weight = area * cosine * cosine * std::exp(-0.5 * d2 / (sigma * sigma));
                    fit.add(dot(u, d) / sigma, dot(v, d) / sigma, dot(point.normal, d), weight);
                  });
  Quadric result{ point.position, point.normal, u, v, sigma, {}, 0, 0 };
  if (!fit.solve(0.01, result.a)) return {};
  result.misfit = fit.misfit(result.a);
  result.cover = fit.weight() / (2 * M_PI * sigma * sigma * (1 - std::exp(-0.5 * reach * reach)));
  return result;
}

/// Returns whether the boundary is plain, that is, one smooth quadric apart from the steps of the voxels, in the range
/// of a fit of standard deviation `sigma`.
bool isPlain(const Quadric& q, double sigma)
{
  constexpr double mostMisfit = 0.2, leastCover = 0.75, mostTurn = 0.5; // turn: radians over the standard deviation
  return q.misfit < mostMisfit && q.cover > leastCover && q.curvature() * sigma < mostTurn;
}

/// Returns the widest fit at a point, in multiples of `sigma`, over which the boundary is plain; nothing if no fit
/// wider than `sigma` is plain.
std::optional<Quadric> widerQuadricAt(const Point& point, const LikePoints& all, double sigma)
{
  constexpr int widest = 5;
  std::optional<Quadric> best;
  for (int width = 2; width <= widest; ++width)
  {
    const std::optional<Quadric> wider = quadricAt(point, all, width * sigma);
    if (!wider || !isPlain(*wider, width * sigma)) return best;
    best = wider;
    if (!isPlain(*best, (width + 1) * sigma)) return best;
  }
  return best;
}

/// Groups of points with the same labels in the same cell of a few voxels, as ranges of `order`; within a group, points
/// are sorted by ascending Quadric::cover.
struct PointGroups
{
  std::vector<std::int32_t> order;
  std::vector<std::size_t> start; ///< start of each group in `order`, and the end
};

/// Groups the points whose `cover` (see Quadric) is positive.
PointGroups groupsOf(const std::vector<Point>& points, const std::vector<float>& cover)
{
  constexpr int cell = 2, padding = 2; // voxels; the lowest point is at -1
  using Key = std::array<std::int32_t, 5>;
  const auto keyOf = [&](std::int32_t i)
  {
    const Point& p = points[i];
    return Key{ (p.lower[2] + padding) / cell, (p.lower[1] + padding) / cell, (p.lower[0] + padding) / cell, p.inside,
                p.outside };
  };
  PointGroups groups;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (cover[i] > 0) groups.order.push_back(std::int32_t(i));
  vtkSMPTools::Sort(groups.order.begin(), groups.order.end(),
                    [&](std::int32_t i, std::int32_t k)
                    {
                      const Key a = keyOf(i), b = keyOf(k);
                      return a != b ? a < b : std::pair(cover[i], i) < std::pair(cover[k], k);
                    });
  for (std::size_t n = 0; n < groups.order.size(); ++n)
    if (n == 0 || keyOf(groups.order[n - 1]) != keyOf(groups.order[n])) groups.start.push_back(n);
  groups.start.push_back(groups.order.size());
  return groups;
}

/// Moves the points of a group that have similar normals onto one wide quadric, fitted at the first, least covered of
/// them: a point at the edge of a wall must not use a fit that is plain only farther inside.
void fitWider(const std::vector<Point>& points, std::vector<std::int32_t> group, const LikePoints& all, double sigma,
              std::vector<Point>& fitted)
{
  constexpr double sameWay = 0.9; // cosine between normals
  while (!group.empty())
  {
    const Point& first = points[group.front()];
    const auto quadric = widerQuadricAt(first, all, sigma * first.scale);
    const auto others =
      std::stable_partition(group.begin(), group.end(),
                            [&](std::int32_t i) {
                              return &points[i] == &first || (quadric && dot(points[i].normal, first.normal) > sameWay);
                            });
    if (quadric) std::for_each(group.begin(), others, [&](std::int32_t i) { fitted[i] = quadric->onto(points[i]); });
    group.erase(group.begin(), others);
  }
}

/// Returns the points moved onto quadrics as wide as the boundary is plain: a narrow fit does not see beyond the flat
/// cap of a large ball or a terrace of a gentle slope. Wide fits change little from point to point and are shared by
/// groups.
std::vector<Point> fitted(const std::vector<Point>& points, double sigma)
{
  const LikePoints all(points);
  std::vector<Point> result = points;
  std::vector<float> cover(points.size(), 0); // Quadric::cover where the boundary is plain
  parallelFor(points.size(),
              [&](std::size_t i)
              {
                const double own = sigma * points[i].scale;
                const std::optional<Quadric> narrow = quadricAt(points[i], all, own);
                if (!narrow) return;
                result[i] = narrow->onto(points[i]);
                if (isPlain(*narrow, 2 * own)) cover[i] = float(narrow->cover);
              });
  const PointGroups groups = groupsOf(points, cover);
  parallelFor(groups.start.size() - 1,
              [&](std::size_t g)
              {
                const auto at = groups.order.begin();
                fitWider(points, { at + groups.start[g], at + groups.start[g + 1] }, all, sigma, result);
              });
  parallelFor(points.size(), [&](std::size_t i) { keepLabels(result[i]); });
  return result;
}

/// Returns, by label, the offsets of the labels' boundaries, voxels, that restore the volumes that the points'
/// displacements have changed.
std::vector<double> offsets(const std::vector<Point>& points)
{
  std::vector<double> lost(labelCount), result(labelCount);
  std::unordered_map<std::uint32_t, double> areaOf; // by labelsOf()
  for (const Point& p : points)
  {
    const double sign = p.isInsideBelow ? 1 : -1;
    const double swept = sign * (p.position - p.centre())[p.axis];
    lost[p.inside] -= swept;
    lost[p.outside] += swept;
    areaOf[labelsOf(p)] += std::abs(p.normal[p.axis]);
  }
  std::map<std::pair<Label, Label>, double> areas;
  for (const auto& [labels, area] : areaOf) areas[{ Label(labels >> 16), Label(labels) }] = area;
  std::map<Label, double> lacking;
  for (std::size_t label = 0; label < labelCount; ++label)
    if (lost[label] != 0) lacking[Label(label)] = lost[label];
  for (const auto& [label, way] : offsetsForVolumes(lacking, areas, mostOffset)) result[label] = way;
  return result;
}

/// Returns the point at the voxel face whose centre is nearest to `position` (mm, in the grid frame).
Point pointOf(const Vec3& position, const TissueMap& map)
{
  Point point{};
  double farthest = -1;
  for (int a = 0; a < 3; ++a)
  {
    const double at = position[a] / map.grid.spacing[a];
    point.lower[a] = int(std::lround(at));
    if (const double off = std::abs(at - double(point.lower[a])); off > farthest) farthest = off, point.axis = a;
  }
  point.lower[point.axis] = int(std::lround(position[point.axis] / map.grid.spacing[point.axis] - 0.5));
  Index upper = point.lower;
  ++upper[point.axis];
  const Label below = labelAt(map, point.lower), above = labelAt(map, upper);
  point.isInsideBelow = below > above;
  point.inside = std::max(below, above);
  point.outside = std::min(below, above);
  return point;
}

/// Returns the radius, voxels, within which a surface of that curvature deviates invisibly little from its tangent
/// plane.
double planeRadius(double curvature, double scale)
{
  constexpr double invisible = 0.05, least = 0.7, most = 2;
  return std::clamp(std::sqrt(2 * invisible * scale / std::max(curvature, 1e-3)), least * scale, most * scale);
}

/// The point where planes meet: least squares of the distances to the planes, with a spring to a given position.
class MeetingPlanes
{
public:
  /// Adds the plane through the point at `way` from the position.
  void add(const Vec3& normal, const Vec3& way, double weight)
  {
    const Vec3& n = normal;
    m_Matrix[0] += weight * n.x * n.x, m_Matrix[1] += weight * n.x * n.y, m_Matrix[2] += weight * n.x * n.z;
    m_Matrix[3] += weight * n.y * n.y, m_Matrix[4] += weight * n.y * n.z, m_Matrix[5] += weight * n.z * n.z;
    m_Right += weight * dot(n, way) * n;
    m_Weight += weight;
  }

  double weight() const { return m_Weight; }

  /// Returns the step from the position to the meeting point; `spring` > 0 is the spring's weight relative to the
  /// planes'.
  Vec3 way(double spring) const
  {
    const double* m = m_Matrix;
    const double held = spring * m_Weight;
    const Vec3 r0{ m[0] + held, m[1], m[2] }, r1{ m[1], m[3] + held, m[4] }, r2{ m[2], m[4], m[5] + held };
    const Vec3 c0 = cross(r1, r2);
    return (m_Right.x * c0 + m_Right.y * cross(r2, r0) + m_Right.z * cross(r0, r1)) / dot(r0, c0);
  }

private:
  double m_Matrix[6] = {}, m_Weight = 0;
  Vec3 m_Right;
};

/// Returns the planes of the samples at the voxel faces that touch a lattice vertex on the interface, in voxels.
MeetingPlanes planesTouching(const Vec3& vertex, const PointRows& rows)
{
  constexpr double touching = 0.5 + 1e-6;
  MeetingPlanes planes;
  Index voxel;
  for (int a = 0; a < 3; ++a) voxel[a] = int(std::floor(vertex[a]));
  rows.forEachNear(voxel, 1,
                   [&](const Point& point)
                   {
                     const Vec3 d = vertex - point.centre();
                     for (int a = 0; a < 3; ++a)
                       if (std::abs(d[a]) > (a == point.axis ? 1e-6 : touching)) return;
                     planes.add(point.normal, point.position - vertex, 1);
                   });
  return planes;
}

Vec3 wayTouching(const Vec3& vertex, const PointRows& rows)
{
  constexpr double spring = 0.05;
  const MeetingPlanes planes = planesTouching(vertex, rows);
  return planes.weight() > 0 ? planes.way(spring) : Vec3{};
}

using SamplesAtVertices = Grouped<std::int32_t>; ///< numbers of points

/// Returns for each vertex of a lattice the points whose samples are held by a face at the vertex; `order[i].second` is
/// the sample of point i.
SamplesAtVertices samplesAtVertices(const BackgroundMesh& background,
                                    const std::vector<std::pair<std::int64_t, std::int32_t>>& order)
{
  const auto forEachCorner = [&](std::size_t first, std::size_t last, auto&& visit)
  {
    for (std::size_t i = first; i < last; ++i)
    {
      const BackgroundMesh::Sample& sample = background.samples[order[i].second];
      for (int k = 1; k <= 3; ++k)
        visit(std::size_t(background.mesh.tetrahedra[sample.tetrahedron][(sample.face + k) & 3]), std::int32_t(i));
    }
  };
  return SamplesAtVertices(background.mesh.points.size(), order.size(), forEachCorner);
}

/// Returns the planes of the samples that the triangles at vertex number `v` hold, with weights that fall with
/// distance.
MeetingPlanes planesHeld(const Vec3& vertex, double length, const std::vector<Point>& points,
                         const SamplesAtVertices& samples, std::int32_t v)
{
  constexpr double ofLength = 0.13; // standard deviation of the weights, share of L; at least a voxel
  const double sigma = std::max(1.0, ofLength * length);
  MeetingPlanes planes;
  for (const std::int32_t* n = samples.begin(v); n != samples.end(v); ++n)
  {
    const Vec3 way = points[*n].position - vertex;
    planes.add(points[*n].normal, way, std::exp(-0.5 * squaredNorm(way) / (sigma * sigma)));
  }
  return planes;
}

Vec3 wayToHeld(const MeetingPlanes& planes, double length)
{
  constexpr double spring = 0.03;
  constexpr double ofLength = 0.2, least = 1.5; // share of L, voxels; how far faces of blocks are off the boundary
  const Vec3 way = planes.way(spring);
  const double distance = norm(way), most = std::max(least, ofLength * length);
  return (distance > most ? most / distance : 1) * way;
}

/// Returns the vertices on the interface, ascending.
std::vector<std::int32_t> interfaceVertices(const KuhnLattice& lattice)
{
  const TetMesh& mesh = lattice.background.mesh;
  std::vector<bool> isThere(mesh.points.size(), false);
  for (const auto& [t, face] : lattice.interfaceFaces)
    for (int k = 1; k <= 3; ++k) isThere[mesh.tetrahedra[t][(face + k) & 3]] = true;
  std::vector<std::int32_t> result;
  for (std::size_t v = 0; v < isThere.size(); ++v)
    if (isThere[v]) result.push_back(std::int32_t(v));
  return result;
}

Vec3 scaled(const Vec3& p, const Vec3& by) { return { p.x * by.x, p.y * by.y, p.z * by.z }; }

/// Returns the points of the smooth boundary in the order of their voxels; fills `order`, whose `second` is the sample
/// of each point. `lengths`: L at each sample, voxels; if empty, smoothing is nowhere wider. `mostScales`: see
/// mostScalesOf.
std::vector<Point> smoothPoints(const std::vector<BackgroundMesh::Sample>& samples, const TissueMap& map, double sigma,
                                const std::vector<float>& lengths, const std::vector<double>& mostScales,
                                std::vector<std::pair<std::int64_t, std::int32_t>>& order)
{
  const Index size = map.grid.size;
  const std::size_t n = samples.size();
  order.resize(n);
  parallelFor(n,
              [&](std::size_t i)
              {
                const Point point = pointOf(samples[i].position, map);
                const auto [x, y, z] = point.lower;
                order[i] = { (((z + 1) * std::int64_t(size[1] + 1) + y + 1) * (size[0] + 1) + x + 1) * 3 + point.axis,
                             std::int32_t(i) };
              });
  vtkSMPTools::Sort(order.begin(), order.end());
  const IndicatorTie tie(map, sigma);
  std::vector<Point> points(n);
  parallelFor(n,
              [&](std::size_t i)
              {
                // Computed again: storing the points of the first loop would take as much memory again.
                points[i] = pointOf(samples[order[i].second].position, map);
                if (!lengths.empty())
                  points[i].scale = std::min(
                    { scaleAt(lengths[order[i].second]), mostScales[points[i].inside], mostScales[points[i].outside] });
                tie.place(points[i]);
                keepLabels(points[i]);
              });
  points = fitted(points, perGaussian * sigma);
  const std::vector<double> offset = offsets(points);
  parallelFor(n, [&](std::size_t i)
              { points[i].position += (offset[points[i].inside] - offset[points[i].outside]) * points[i].normal; });
  return points;
}

/// Returns the largest factor on the width of the smoothing by label: wider smoothing would flatten a tissue of few
/// voxels across.
std::vector<double> mostScalesOf(const std::map<Label, double>& thickness, double voxel)
{
  constexpr double perVoxel = 0.5;
  std::vector<double> result(labelCount, std::numeric_limits<double>::infinity());
  for (const auto& [label, mm] : thickness) result[label] = std::max(1.0, perVoxel * mm / voxel);
  return result;
}

/// Returns L at each sample, voxels.
std::vector<float> lengthsAtSamples(const BackgroundMesh& background, double voxel)
{
  std::vector<float> lengths(background.samples.size());
  parallelFor(lengths.size(),
              [&](std::size_t n)
              {
                const BackgroundMesh::Sample& sample = background.samples[n];
                const std::int32_t corner = background.mesh.tetrahedra[sample.tetrahedron][(sample.face + 1) & 3];
                lengths[n] = float(background.lengths[corner] / voxel);
              });
  return lengths;
}

/// Returns the positions of interface vertices on the smooth boundary, mm: where the planes of the samples at the voxel
/// faces around a vertex meet. Where L is at least two voxels, samples may be thinned and faces displaced by uniform
/// blocks: there the planes of the samples that the vertex's triangles hold are used. `order`: see smoothPoints().
std::vector<Vec3> meetingPoints(const BackgroundMesh& background, const std::vector<std::int32_t>& vertices,
                                const Grid& grid, const std::vector<Point>& points,
                                const std::vector<std::pair<std::int64_t, std::int32_t>>& order)
{
  constexpr double coarse = 2, leastWeight = 1e-9; // voxels
  const Vec3& mm = grid.spacing;
  const PointRows rows(points, grid.size);
  const SamplesAtVertices samples = samplesAtVertices(background, order);
  std::vector<Vec3> result(vertices.size());
  parallelFor(vertices.size(),
              [&](std::size_t i)
              {
                const std::int32_t v = vertices[i];
                const Vec3 home = scaled(background.mesh.points[v], { 1 / mm.x, 1 / mm.y, 1 / mm.z });
                const double length = background.lengths[v] / grid.smallestSpacing();
                MeetingPlanes held;
                if (length >= coarse) held = planesHeld(home, length, points, samples, v);
                const Vec3 way = held.weight() > leastWeight ? wayToHeld(held, length) : wayTouching(home, rows);
                result[i] = scaled(home + way, mm);
              });
  return result;
}

} // namespace

void moveToSmoothBoundary(KuhnLattice& lattice, const TissueMap& map, const SmoothBoundaryOptions& options)
{
  BackgroundMesh& background = lattice.background;
  const Vec3& mm = map.grid.spacing;
  const Vec3 perMm{ 1 / mm.x, 1 / mm.y, 1 / mm.z };
  const double voxel = map.grid.smallestSpacing();
  std::vector<std::pair<std::int64_t, std::int32_t>> order;
  const std::vector<Point> points =
    smoothPoints(background.samples, map, options.voxels,
                 options.isWiderWithL ? lengthsAtSamples(background, voxel) : std::vector<float>(),
                 mostScalesOf(options.thickness, voxel), order);
  parallelFor(points.size(),
              [&](std::size_t i)
              {
                const Point& p = points[i];
                BackgroundMesh::Sample& sample = background.samples[order[i].second];
                sample.position = scaled(p.position, mm);
                const Vec3 across = scaled(p.normal, perMm);
                const double radius = voxel * planeRadius(p.curvature, p.scale);
                const Vec3 normal = across / (norm(across) * radius);
                sample.normal = { float(normal.x), float(normal.y), float(normal.z) };
              });
  const std::vector<std::int32_t> vertices = interfaceVertices(lattice);
  moveVertices(background.mesh, vertices, meetingPoints(background, vertices, map.grid, points, order),
               options.minimumAngle);
}

std::vector<SmoothBoundaryPoint> smoothBoundaryPoints(const TissueMap& map, double voxels)
{
  const Vec3& mm = map.grid.spacing;
  std::vector<BackgroundMesh::Sample> samples;
  Index lower;
  for (lower[2] = -1; lower[2] < map.grid.size[2]; ++lower[2])
    for (lower[1] = -1; lower[1] < map.grid.size[1]; ++lower[1])
      for (lower[0] = -1; lower[0] < map.grid.size[0]; ++lower[0])
        for (int a = 0; a < 3; ++a)
        {
          Index upper = lower;
          ++upper[a];
          if (labelAt(map, lower) == labelAt(map, upper)) continue;
          Vec3 centre{ double(lower[0]), double(lower[1]), double(lower[2]) };
          centre[a] += 0.5;
          samples.emplace_back().position = scaled(centre, mm);
        }
  std::vector<std::pair<std::int64_t, std::int32_t>> order;
  std::vector<SmoothBoundaryPoint> result;
  for (const Point& p : smoothPoints(samples, map, voxels, {}, {}, order))
  {
    const Vec3 normal = scaled(p.normal, { 1 / mm.x, 1 / mm.y, 1 / mm.z });
    Index voxel = p.lower;
    voxel[p.axis] += p.isInsideBelow ? 0 : 1;
    result.push_back({ voxel, { p.inside, p.outside }, scaled(p.position, mm), normal / norm(normal) });
  }
  return result;
}

} // namespace surgicalmesher
