// SPDX-License-Identifier: Apache-2.0
#include "SurfacePreparation.h"

#include "AvailableMemory.h"
#include "EdgeDivision.h"
#include "Errors.h"
#include "SurfaceValidity.h"
#include "Text.h"
#include "TissueSurfaces.h"

#include <vtkBoundingBox.h>

#include <cmath>
#include <cstdint>

namespace surgicalmesher
{

namespace
{

constexpr double tetrahedronVolume = 0.11785; ///< volume of a regular tetrahedron with edge length 1
/// Spheres of 10^4 to 10^5 tetrahedra take 570 bytes each, plus 40 MB; the rest is margin.
constexpr double bytesPerTetrahedron = 700;

/// Throws InputError if the surface is smaller than one of its target edges: its coordinates are then hardly
/// millimetres, and the mesh would be a flat tetrahedron.
void requireMillimetres(const SurfaceComplex& surface, const SizingFunction& edgeLength, const std::string& name)
{
  if (surface.points.empty()) return;
  const vtkBoundingBox box = boxAround(surface);
  Vec3 centre;
  box.GetCenter(&centre.x);
  const double diagonal = box.GetDiagonalLength(), length = edgeLength(centre);
  if (diagonal >= length) return;
  throw InputError(name + ": the whole surface is " + text::rounded(diagonal) +
                   " mm across, shorter than one edge of " + text::rounded(length) + " mm; expected millimetres" +
                   (diagonal < 2 ? ", found what look like metres" : ""));
}

/// Returns the volume enclosed by all tissues together: faces between two of them cancel out.
double enclosedVolume(const SurfaceComplex& surface)
{
  double volume = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const auto& [a, b, c] = surface.triangles[t];
    const int sign = (surface.labels[t][0] != 0) - (surface.labels[t][1] != 0);
    volume += sign * dot(surface.points[a], cross(surface.points[b], surface.points[c])) / 6;
  }
  return std::abs(volume);
}

/// Returns the number of tetrahedra that fill the surfaces of all tissues, as the volume over that of regular
/// tetrahedra with the target edge lengths, sampled in the bounding box.
double estimateTetrahedra(const SurfaceComplex& surface, const SizingFunction& edgeLength)
{
  if (surface.points.empty()) return 0;
  constexpr int samples = 24;
  const vtkBoundingBox box = boxAround(surface);
  double perVolume = 0;
  for (int n = 0; n < samples * samples * samples; ++n)
  {
    const std::array<int, 3> at{ n % samples, n / samples % samples, n / (samples * samples) };
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = box.GetBound(2 * axis) + (at[axis] + 0.5) / samples * box.GetLength(axis);
    perVolume += 1 / (tetrahedronVolume * std::pow(edgeLength(p), 3));
  }
  return enclosedVolume(surface) * perVolume / (samples * samples * samples);
}

/// Throws InputError, with both figures, if that many tetrahedra do not fit into the available memory.
void requireMemoryFor(double tetrahedra, const std::string& name)
{
  const std::optional<std::uint64_t> available = availableMemory();
  const double needed = tetrahedra * bytesPerTetrahedron;
  if (!available || needed <= double(*available)) return;
  throw InputError(name + ": at these edge lengths it takes about " + text::rounded(tetrahedra / 1e6) +
                   " million tetrahedra and " + text::rounded(needed / 1e9) + " GB of memory, found " +
                   text::rounded(double(*available) / 1e9) + " GB available, expected longer edges");
}

} // namespace

vtkBoundingBox boxAround(const SurfaceComplex& surface)
{
  vtkBoundingBox box;
  for (const Vec3& p : surface.points) box.AddPoint(p.x, p.y, p.z);
  return box;
}

FillableSurface fillableSurface(const SurfaceComplex& surface, const SizingFunction& edgeLength,
                                const std::string& name)
{
  const bool labelled = !surface.labels.empty();
  if (!labelled) requireMillimetres(surface, edgeLength, name);
  FillableSurface result;
  result.surface = labelled ? withoutDuplicatePoints(surface) : closedShellsToTissues(surface, name);
  result.soleLabel = leaveNeighboursOut(result.surface);
  if (labelled) requireFillable(result.surface, name);
  requireMemoryFor(estimateTetrahedra(result.surface, edgeLength), name);
  result.surface = withDividedEdges(result.surface, edgeLength);
  return result;
}

} // namespace surgicalmesher
