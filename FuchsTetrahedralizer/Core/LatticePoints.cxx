#include "LatticePoints.h"

#include "ComplexChecks.h"
#include "Errors.h"

#include <vtkCellArray.h>
#include <vtkGenericCell.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSMPThreadLocalObject.h>
#include <vtkSMPTools.h>
#include <vtkStaticCellLocator.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace surgicalmesher
{
namespace
{

/// Answers where a point lies with respect to the surface; safe to ask from several threads.
class SurfaceLocator
{
public:
  explicit SurfaceLocator(const SurfaceComplex& surface) : m_Surface(surface)
  {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (const Vec3& p : surface.points) points->InsertNextPoint(p.x, p.y, p.z);
    vtkNew<vtkCellArray> cells;
    for (const auto& [a, b, c] : surface.triangles) cells->InsertNextCell({ a, b, c });
    m_Data->SetPoints(points);
    m_Data->SetPolys(cells);
    m_Data->BuildCells();
    m_Locator->SetDataSet(m_Data);
    m_Locator->BuildLocator();
    m_Diagonal = m_Data->GetLength();
  }

  struct Answer
  {
    double distance; ///< to the surface, mm
    bool inside;     ///< of some tissue
  };

  Answer ask(const Vec3& p)
  {
    vtkGenericCell* cell = m_Cells.Local();
    Vec3 closest;
    vtkIdType triangle = -1;
    int subId;
    double squared;
    m_Locator->FindClosestPoint(&p.x, &closest.x, cell, triangle, subId, squared);
    return { std::sqrt(squared), labelSeenThrough(p, triangle, cell) != 0 };
  }

private:
  /// The label at p: on the near side of the first triangle towards the middle of the closest one. (The closest triangle
  /// itself can't be asked: where it is closest with an edge, either side of its plane may lie on the same side of the
  /// surface.) A wrong answer at a grazing hit costs a point, nothing else.
  Label labelSeenThrough(const Vec3& p, vtkIdType triangle, vtkGenericCell* cell)
  {
    const auto& [a, b, c] = m_Surface.triangles[triangle];
    const Vec3 middle = (m_Surface.points[a] + m_Surface.points[b] + m_Surface.points[c]) / 3;
    const Vec3 beyond = p + 1.001 * (middle - p);
    double t, hit[3], parametric[3];
    int subId;
    vtkIdType first = triangle;
    if (!m_Locator->IntersectWithLine(&p.x, &beyond.x, 1e-12 * m_Diagonal, t, hit, parametric, subId, first, cell))
    {
      first = triangle;
    }
    const auto& [i, j, k] = m_Surface.triangles[first];
    const bool front = orient(m_Surface.points[i], m_Surface.points[j], m_Surface.points[k], p) > 0;
    return m_Surface.labels[first][front ? 1 : 0];
  }

  const SurfaceComplex& m_Surface;
  vtkNew<vtkPolyData> m_Data;
  vtkNew<vtkStaticCellLocator> m_Locator;
  vtkSMPThreadLocalObject<vtkGenericCell> m_Cells;
  double m_Diagonal = 0;
};

double checkedLength(const EdgeLength& edgeLength, const Vec3& p)
{
  const double length = edgeLength(p);
  if (!(length > 0) || !std::isfinite(length))
  {
    throw InputError("the target edge length at " + place(p) + " is " + std::to_string(length) + ", expected more than 0");
  }
  return length;
}

/// Places on the lattice, counted in halves of the finest cube there can be.
using Place = std::int64_t;
using Places = std::array<Place, 3>;

/// Is the place a vertex of the lattice of cubes of this size: a corner of a cube or its centre?
bool onLattice(const Places& place, Place size)
{
  const auto remainder = [&](int axis) { return ((place[axis] % size) + size) % size; };
  const Place first = remainder(0);
  return (first == 0 || 2 * first == size) && remainder(1) == first && remainder(2) == first;
}

/// An octree of lattice cubes in a box around the surface, every cube as large as L(x) allows.
class LatticeOctree
{
public:
  LatticeOctree(const Vec3& low, const Vec3& high, double finest, double coarsest, const EdgeLength& edgeLength)
    : m_EdgeLength(edgeLength)
  {
    const double extent = std::max({ high.x - low.x, high.y - low.y, high.z - low.z });
    double block = finest / kLatticeMeanEdge;
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

  /// Does the place belong to the lattice with mean edge `length`, or with the box's own blocks if these are smaller?
  bool hasPlaceAt(const Places& place, double length) const
  {
    Place size = m_Block;
    while (size > 2 && double(size) * m_Unit * kLatticeMeanEdge > std::sqrt(2.0) * length) size /= 2;
    return onLattice(place, size);
  }

private:
  static constexpr int kMaximumDepth = 20;

  /// Too coarse by more than half an octave at the cube's centre, or by more than a whole one at a corner.
  bool tooCoarse(const Places& corner, Place size) const
  {
    const double meanEdge = m_Unit * double(size) * kLatticeMeanEdge;
    const auto lengthAt = [&](Place i, Place j, Place k)
    { return checkedLength(m_EdgeLength, positionOf({ corner[0] + i, corner[1] + j, corner[2] + k })); };
    if (meanEdge > std::sqrt(2.0) * lengthAt(size / 2, size / 2, size / 2)) return true;
    for (int c = 0; c < 8; ++c)
    {
      if (meanEdge > 2 * lengthAt((c & 1) * size, (c >> 1 & 1) * size, (c >> 2) * size)) return true;
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
  const EdgeLength& m_EdgeLength;
  std::vector<Places> m_Places;
};

/// Outside the tissues the lattice's edges grow by this much per distance from the surface.
constexpr double kOutsideGrowth = 0.5;

} // namespace

std::vector<Vec3> latticePoints(const SurfaceComplex& surface, const EdgeLength& edgeLength, double clearance)
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
  const LatticeOctree octree(low, high, finest, coarsest, edgeLength);
  const std::vector<Places>& places = octree.places();
  SurfaceLocator locator(surface);
  std::vector<char> keep(places.size());
  vtkSMPTools::For(0, static_cast<vtkIdType>(places.size()),
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const Vec3 p = octree.positionOf(places[i]);
        const double length = edgeLength(p);
        const SurfaceLocator::Answer answer = locator.ask(p);
        keep[i] = answer.distance >= clearance * length &&
                  (answer.inside || octree.hasPlaceAt(places[i], length + kOutsideGrowth * answer.distance));
      }
    });
  std::vector<Vec3> result;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    if (keep[i]) result.push_back(octree.positionOf(places[i]));
  }
  return result;
}

} // namespace surgicalmesher
