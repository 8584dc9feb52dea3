// SPDX-License-Identifier: Apache-2.0
#include "BccLattice.h"

#include "Errors.h"
#include "Parallel.h"
#include "Place.h"
#include "SurfaceLocator.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace surgicalmesher
{
namespace
{

double checkedLength(const SizingFunction& edgeLength, const Vec3& p)
{
  const double length = edgeLength(p);
  if (!(length > 0) || !std::isfinite(length))
  {
    throw InputError("the target edge length at " + place(p) + " is " + std::to_string(length) +
                     ", expected more than 0");
  }
  return length;
}

/// Coordinates of lattice points, in halves of the finest possible cube.
using Place = std::int64_t;
using Places = std::array<Place, 3>;

/// Whether the place is a vertex of the lattice with cubes of this size: a corner of a cube or its centre.
bool onLattice(const Places& place, Place size)
{
  const auto remainder = [&](int axis) { return ((place[axis] % size) + size) % size; };
  const Place first = remainder(0);
  return (first == 0 || 2 * first == size) && remainder(1) == first && remainder(2) == first;
}

/// The mean edge of the lattice over L(x) is between half of this value and this value: every cube belongs to the
/// nearest octave. Rounding to the finer octave instead would leave edges between L/2 and L, and the edge collapses
/// that mend these destroy the lattice.
constexpr double kCoarsest = 1.41421356237309505;

/// In octaves: values of log2 L within this distance count as near each other.
constexpr double kNearOctave = 0.05;

/// Returns the signed distance from one place to the other on the circle of an octave, at most a half in magnitude.
double circularStep(double from, double to) { return to - from - std::round(to - from); }

/// A value of log2 L on the circle of an octave, weighted by the number of vertices of a lattice that fits L there.
struct Octave
{
  double place, weight;
};

double weightNear(const std::vector<Octave>& octaves, double middle)
{
  double sum = 0;
  for (const Octave& o : octaves)
    if (std::abs(circularStep(middle, o.place)) <= kNearOctave) sum += o.weight;
  return sum;
}

/// Returns the place with the largest weight nearby; the first of several.
double densestOctave(const std::vector<Octave>& octaves)
{
  constexpr int places = 40; // each within reach of two others
  double densest = 0, most = 0;
  for (int place = 0; place < places; ++place)
    if (const double weight = weightNear(octaves, double(place) / places); weight > most)
      densest = double(place) / places, most = weight;
  return densest;
}

/// Returns the mean of the octaves near `middle`.
double meanNear(const std::vector<Octave>& octaves, double middle)
{
  double sum = 0, weight = 0;
  for (const Octave& o : octaves)
  {
    const double step = circularStep(middle, o.place);
    if (std::abs(step) > kNearOctave) continue;
    sum += o.weight * step;
    weight += o.weight;
  }
  return weight > 0 ? middle + sum / weight : middle;
}

/// Returns the direction of the mean of the octaves as points on a circle.
double meanOnCircle(const std::vector<Octave>& octaves)
{
  double x = 0, y = 0;
  for (const Octave& o : octaves)
  {
    x += o.weight * std::cos(2 * M_PI * o.place);
    y += o.weight * std::sin(2 * M_PI * o.place);
  }
  return std::atan2(y, x) / (2 * M_PI);
}

/// Returns the edge of the cube, within half an octave of the finest L(x), for which the lattice's mean edge fits L(x)
/// at as many of its vertices as possible; `lengths` are samples of L(x). It is found by mean shift from the circular
/// mean of log2 L; if no value is near that mean, as where L(x) has few values, from the densest place.
double fittingCube(const std::vector<double>& lengths, double finest)
{
  std::vector<Octave> octaves;
  for (const double length : lengths) octaves.push_back({ std::log2(length / finest), std::pow(finest / length, 3) });
  double octave = meanOnCircle(octaves);
  if (weightNear(octaves, octave) == 0) octave = densestOctave(octaves);
  for (int step = 0; step < 20; ++step) octave = meanNear(octaves, octave);
  return finest * std::exp2(circularStep(0, octave)) / kLatticeMeanEdge;
}

/// An octree of lattice cubes in a box around the surface. The edges of its cubes are `cube` times powers of 2, as L(x)
/// requires.
class LatticeOctree
{
public:
  LatticeOctree(const Vec3& low, const Vec3& high, double cube, double coarsest, const SizingFunction& edgeLength)
    : m_EdgeLength(edgeLength)
  {
    const double extent = std::max({ high.x - low.x, high.y - low.y, high.z - low.z });
    double block = cube;
    while (2 * block < extent / 4) block *= 2;
    const double margin = std::max(block / 2, 2 * coarsest);
    double root = block;
    while (root < extent + 2 * (margin + block)) root *= 2;
    m_Unit = root / double(Place(2) << kMaximumDepth);
    m_Block = std::llround(block / m_Unit);
    m_Origin = 0.5 * (low + high) - Vec3{ root / 2, root / 2, root / 2 };
    for (int axis = 0; axis < 3; ++axis)
    {
      m_BoxLow[axis] = static_cast<Place>(std::floor((low[axis] - margin - m_Origin[axis]) / block)) * m_Block;
      m_BoxHigh[axis] = static_cast<Place>(std::ceil((high[axis] + margin - m_Origin[axis]) / block)) * m_Block;
    }
    visit({ 0, 0, 0 }, Place(2) << kMaximumDepth);
    std::sort(m_Places.begin(), m_Places.end());
    m_Places.erase(std::unique(m_Places.begin(), m_Places.end()), m_Places.end());
  }

  const std::vector<Places>& places() const { return m_Places; }

  Vec3 positionOf(const Places& place) const
  {
    return m_Origin + m_Unit * Vec3{ double(place[0]), double(place[1]), double(place[2]) };
  }

  /// Whether the place belongs to the lattice with mean edge `length`, or to that of the blocks of the box if these are
  /// smaller.
  bool hasPlaceAt(const Places& place, double length) const
  {
    Place size = m_Block;
    while (size > 2 && double(size) * m_Unit * kLatticeMeanEdge > std::sqrt(2.0) * length) size /= 2;
    return onLattice(place, size);
  }

private:
  static constexpr int kMaximumDepth = 20;

  /// Whether a cube is too coarse at its centre, or by more than half an octave at a corner.
  bool tooCoarse(const Places& corner, Place size) const
  {
    const double meanEdge = m_Unit * double(size) * kLatticeMeanEdge;
    const auto lengthAt = [&](Place i, Place j, Place k) {
      return checkedLength(m_EdgeLength, positionOf({ corner[0] + i, corner[1] + j, corner[2] + k }));
    };
    if (meanEdge > kCoarsest * lengthAt(size / 2, size / 2, size / 2)) return true;
    for (int c = 0; c < 8; ++c)
    {
      const double length = lengthAt((c & 1) * size, (c >> 1 & 1) * size, (c >> 2) * size);
      if (meanEdge > std::sqrt(2.0) * kCoarsest * length) return true;
    }
    return false;
  }

  void add(const Places& place)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      if (place[axis] < m_BoxLow[axis] || place[axis] > m_BoxHigh[axis]) return;
    }
    m_Places.push_back(place);
  }

  void visit(const Places& corner, Place size)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      if (corner[axis] > m_BoxHigh[axis] || corner[axis] + size < m_BoxLow[axis]) return;
    }
    const bool split = size > 2 && (size > m_Block || tooCoarse(corner, size));
    const Place step = split ? size / 2 : size;
    for (int c = 0; c < 8; ++c)
    {
      const Places at{ corner[0] + (c & 1) * step, corner[1] + (c >> 1 & 1) * step, corner[2] + (c >> 2) * step };
      if (split) visit(at, step);
      else add(at);
    }
    if (!split) add({ corner[0] + size / 2, corner[1] + size / 2, corner[2] + size / 2 });
  }

  Vec3 m_Origin;
  double m_Unit = 1;
  Place m_Block = 1;
  Places m_BoxLow, m_BoxHigh;
  const SizingFunction& m_EdgeLength;
  std::vector<Places> m_Places;
};

/// Points nearer to the surface than kNear L(x) are moved off the lattice by up to kOffLattice L(x). Symmetric shapes
/// otherwise share positions with the planes and spheres of the lattice, and TetGen can fail on such coincidences.
constexpr double kNear = 1.5;
constexpr double kOffLattice = 0.01;

/// Returns a number in [-1, 1) that depends on the place and the axis alone, scattered by the finalizer of MurmurHash3.
double scatter(const Places& place, int axis)
{
  auto bits = static_cast<std::uint64_t>(axis);
  for (const Place coordinate : place)
  {
    bits = (bits ^ static_cast<std::uint64_t>(coordinate)) * 0xff51afd7ed558ccdULL;
    bits = (bits ^ (bits >> 33)) * 0xc4ceb9fe1a85ec53ULL;
    bits ^= bits >> 33;
  }
  return double(bits >> 11) / double(std::uint64_t(1) << 52) - 1;
}

/// Calls f(i, walk) for every i below `count`. Indices are divided into parts of fixed size, each with a walk of its
/// own, so that the results do not depend on the number of threads.
template <class F>
void forEachAlongWalks(std::size_t count, const SurfaceLocator& locator, const F& f)
{
  // Small enough to balance the threads, large enough for the first query of a walk not to matter.
  constexpr std::size_t ofPart = 400;
  parallelForEach((count + ofPart - 1) / ofPart,
                  [&](std::size_t part)
                  {
                    SurfaceWalk walk(locator);
                    for (std::size_t i = part * ofPart; i < std::min(count, (part + 1) * ofPart); ++i) f(i, walk);
                  });
}

/// Returns L(x) at the points of a grid that lie in tissues, or at the points of the surface if none does.
std::vector<double> lengthsInside(const SurfaceComplex& surface, const SurfaceLocator& locator, const Vec3& low,
                                  const Vec3& high, const SizingFunction& edgeLength)
{
  constexpr std::size_t perAxis = 20;
  const auto pointOf = [&](std::size_t i)
  {
    const std::array<std::size_t, 3> at{ i % perAxis, i / perAxis % perAxis, i / (perAxis * perAxis) };
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = low[axis] + (double(at[axis]) + 0.5) / double(perAxis) * (high[axis] - low[axis]);
    return p;
  };
  std::vector<char> isInside(perAxis * perAxis * perAxis);
  forEachAlongWalks(isInside.size(), locator,
                    [&](std::size_t i, SurfaceWalk& walk)
                    {
                      const Vec3 p = pointOf(i);
                      const auto known = walk.known(p);
                      isInside[i] = (known ? *known : walk.ask(p)).inside;
                    });
  std::vector<double> found;
  for (std::size_t i = 0; i < isInside.size(); ++i)
    if (isInside[i]) found.push_back(checkedLength(edgeLength, pointOf(i)));
  if (found.empty())
    for (const Vec3& p : surface.points) found.push_back(checkedLength(edgeLength, p));
  return found;
}

/// Growth of the lattice's edge length outside the tissues per distance from the surface.
constexpr double kOutsideGrowth = 0.5;

} // namespace

std::vector<Vec3> latticePoints(const SurfaceComplex& surface, const SizingFunction& edgeLength, double clearance)
{
  if (surface.triangles.empty()) return {};
  Vec3 low = surface.points.front(), high = low;
  double finest = std::numeric_limits<double>::infinity(), coarsest = 0;
  for (const Vec3& p : surface.points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
    const double length = checkedLength(edgeLength, p);
    finest = std::min(finest, length);
    coarsest = std::max(coarsest, length);
  }
  const SurfaceLocator locator(surface);
  const double cube = fittingCube(lengthsInside(surface, locator, low, high, edgeLength), finest);
  const LatticeOctree octree(low, high, cube, coarsest, edgeLength);
  const std::vector<Places>& places = octree.places();
  std::vector<char> keep(places.size());
  std::vector<Vec3> points(places.size());
  const auto isDense = [&](std::size_t i, double length, const SurfaceLocator::Answer& answer)
  { return answer.inside || octree.hasPlaceAt(places[i], length + kOutsideGrowth * answer.distance); };
  const auto decide = [&](std::size_t i, SurfaceWalk& walk)
  {
    Vec3& p = points[i] = octree.positionOf(places[i]);
    const double length = edgeLength(p);
    const auto known = walk.known(p);
    if (known && !isDense(i, length, *known)) return; // no denser farther away
    const SurfaceLocator::Answer answer = walk.ask(p);
    const bool dense = isDense(i, length, answer);
    keep[i] = dense && answer.distance >= clearance * length;
    if (answer.distance >= kNear * length) return;
    for (int axis = 0; axis < 3; ++axis) p[axis] += kOffLattice * length * scatter(places[i], axis);
  };
  forEachAlongWalks(places.size(), locator, decide);
  std::vector<Vec3> result;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    if (keep[i]) result.push_back(points[i]);
  }
  return result;
}

} // namespace surgicalmesher
