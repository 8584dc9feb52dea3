// SPDX-License-Identifier: Apache-2.0
#include "SampleTransfer.h"

#include "BoundaryFaces.h"
#include "Grouped.h"
#include "Triangle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

namespace surgicalmesher
{

namespace
{

constexpr int binSide = 4; // voxels
constexpr int reach = 3;   // bins; faces farther away do not take a sample

using Index = std::array<int, 3>;
using Sample = BackgroundMesh::Sample;

using LabelPair = std::pair<Label, Label>; ///< ascending

LabelPair labelsBeside(const TissueMap& map, const VoxelFace& face)
{
  return std::minmax(labelAt(map, face.lower), labelAt(map, face.upper()));
}

/// Returns whether a voxel face belongs to the share of faces to keep. Compares the fractional part of an additive
/// recurrence, whose steps generalise the plastic number to four dimensions, with `share`, which spreads any share
/// evenly.
bool isWithin(double share, const VoxelFace& face)
{
  if (share >= 1) return true;
  const std::array<double, 4> steps{ 0.8566748838545029, 0.7338918566271260, 0.6287067210378087, 0.5385972572236101 };
  const double at =
    0.5 + face.lower[0] * steps[0] + face.lower[1] * steps[1] + face.lower[2] * steps[2] + face.axis * steps[3];
  return at - std::floor(at) < share;
}

/// The interface faces of a lattice, found by position and labels.
class FaceBins
{
public:
  FaceBins(const KuhnLattice& lattice, const TissueMap& blocks)
    : m_Mesh(lattice.background.mesh), m_Faces(lattice.interfaceFaces), m_Side(double(binSide) * blocks.grid.spacing)
  {
    for (int a = 0; a < 3; ++a) m_Size[a] = blocks.grid.size[a] / binSide + 3;
    std::vector<LabelPair> labels(m_Faces.size());
    parallelFor(labels.size(),
                [&](std::size_t f) { labels[f] = labelsBeside(blocks, faceUnder(std::int32_t(f), blocks)); });
    const auto forEachEntry = [&](std::size_t begin, std::size_t end, auto&& visit)
    {
      for (std::size_t f = begin; f < end; ++f)
        forEachBin(binsOf(std::int32_t(f)), [&](std::size_t bin) { visit(bin, Entry{ labels[f], std::int32_t(f) }); });
    };
    m_Entries = Grouped<Entry>(std::size_t(m_Size[0]) * m_Size[1] * m_Size[2], m_Faces.size(), forEachEntry);
    parallelFor(m_Entries.groups(), [&](std::size_t bin) { std::sort(m_Entries.begin(bin), m_Entries.end(bin)); });
  }

  /// Returns the face (tetrahedron, face) between the two labels that is nearest to p in the smallest neighbourhood of
  /// bins that has any; nothing if there is none within `reach` bins.
  std::optional<std::pair<std::int32_t, int>> nearest(const Vec3& p, const LabelPair& labels) const
  {
    const Index home = binOf(p);
    for (int r = 1; r <= reach; ++r)
    {
      const Index low{ std::max(0, home[0] - r), std::max(0, home[1] - r), std::max(0, home[2] - r) };
      Nearest best{ low };
      look(p, labels, home, best); // first, so that most of the other bins are too far
      for (int z = low[2]; z <= std::min(m_Size[2] - 1, home[2] + r); ++z)
        for (int y = low[1]; y <= std::min(m_Size[1] - 1, home[1] + r); ++y)
          for (int x = low[0]; x <= std::min(m_Size[0] - 1, home[0] + r); ++x)
            if (squaredDistance(p, Index{ x, y, z }) <= best.distance2) look(p, labels, { x, y, z }, best);
      if (best.face >= 0) return m_Faces[best.face];
    }
    return {};
  }

private:
  struct Entry
  {
    LabelPair labels;
    std::int32_t face;

    bool operator<(const Entry& other) const { return std::tie(labels, face) < std::tie(other.labels, other.face); }
  };

  /// The nearest face so far. Among faces at the same distance, the first one met when bins are visited in order from
  /// `corner` on, so that the result does not depend on the order of the search.
  struct Nearest
  {
    Index corner;
    double distance2 = std::numeric_limits<double>::max(); ///< mm^2
    std::int32_t face = -1;
  };

  void look(const Vec3& p, const LabelPair& labels, const Index& bin, Nearest& best) const
  {
    const std::size_t n = number(bin);
    const Entry* const end = m_Entries.end(n);
    const Entry* e = std::lower_bound(m_Entries.begin(n), end, Entry{ labels, -1 });
    for (; e != end && e->labels == labels; ++e)
      if (const double d2 = squaredDistance(p, e->face);
          d2 < best.distance2 || (d2 == best.distance2 && isMetBefore(e->face, best.face, best.corner)))
        best.distance2 = d2, best.face = e->face;
  }

  bool isMetBefore(std::int32_t f, std::int32_t g, const Index& corner) const
  {
    const auto met = [&](std::int32_t face)
    {
      const Index from = binsOf(face).from;
      return number({ std::max(from[0], corner[0]), std::max(from[1], corner[1]), std::max(from[2], corner[2]) });
    };
    return std::pair(met(f), f) < std::pair(met(g), g);
  }

  std::size_t number(const Index& bin) const { return (std::size_t(bin[2]) * m_Size[1] + bin[1]) * m_Size[0] + bin[0]; }

  /// Bin 0 lies before the origin, as the map begins half a voxel before it.
  Index binOf(const Vec3& p) const
  {
    Index bin;
    for (int a = 0; a < 3; ++a) bin[a] = std::clamp(int(std::floor(p[a] / m_Side[a])) + 1, 0, m_Size[a] - 1);
    return bin;
  }

  /// Squared distance from p to a bin, mm^2, a little too small, so that rounding never excludes a bin.
  double squaredDistance(const Vec3& p, const Index& bin) const
  {
    constexpr double slack = 1 - 1e-9;
    double sum = 0;
    for (int a = 0; a < 3; ++a)
    {
      const double from = p[a] - (bin[a] - 1) * m_Side[a], gap = std::max({ -from, from - m_Side[a], 0.0 });
      sum += gap * gap;
    }
    return slack * sum;
  }

  std::array<Vec3, 3> corners(std::int32_t f) const
  {
    const auto [t, face] = m_Faces[f];
    const auto& x = m_Mesh.tetrahedra[t];
    return { m_Mesh.points[x[(face + 1) & 3]], m_Mesh.points[x[(face + 2) & 3]], m_Mesh.points[x[(face + 3) & 3]] };
  }

  double squaredDistance(const Vec3& p, std::int32_t f) const
  {
    const auto [a, b, c] = corners(f);
    return squaredDistanceToTriangle(p, a, b, c);
  }

  struct Bins
  {
    Index from, to;
  };

  /// Returns the range of bins that the bounding box of a face intersects.
  Bins binsOf(std::int32_t f) const
  {
    const auto [a, b, c] = corners(f);
    Vec3 low = a, high = a;
    for (int k = 0; k < 3; ++k)
    {
      low[k] = std::min({ a[k], b[k], c[k] });
      high[k] = std::max({ a[k], b[k], c[k] });
    }
    return { binOf(low), binOf(high) };
  }

  template <class F>
  void forEachBin(const Bins& bins, F&& f) const
  {
    const auto& [from, to] = bins;
    for (int z = from[2]; z <= to[2]; ++z)
      for (int y = from[1]; y <= to[1]; ++y)
        for (int x = from[0]; x <= to[0]; ++x) f(number({ x, y, z }));
  }

  /// Returns a voxel face that lattice face f overlaps.
  VoxelFace faceUnder(std::int32_t f, const TissueMap& blocks) const
  {
    const auto [a, b, c] = corners(f);
    const Vec3 n = cross(b - a, c - a), middle = (a + b + c) / 3.0;
    VoxelFace face{ {}, 0 };
    for (int k = 0; k < 3; ++k)
    {
      if (std::abs(n[k]) > std::abs(n[face.axis])) face.axis = k;
      face.lower[k] = int(std::lround(middle[k] / blocks.grid.spacing[k]));
    }
    const int k = face.axis;
    face.lower[k] = int(std::lround(middle[k] / blocks.grid.spacing[k] - 0.5));
    return face;
  }

  const TetMesh& m_Mesh;
  const std::vector<std::pair<std::int32_t, std::int32_t>>& m_Faces;
  const Vec3 m_Side; ///< side lengths of a bin, mm
  Index m_Size;
  Grouped<Entry> m_Entries; ///< grouped by bin, x fastest
};

/// Returns the share of voxel faces to keep for `perTriangle` samples per triangle of edge length `length` (mm).
double shareAt(double length, double perTriangle, const Vec3& spacing)
{
  const double voxelFace = std::min({ spacing.x * spacing.y, spacing.y * spacing.z, spacing.z * spacing.x });
  const double triangle = 0.25 * std::sqrt(3.0) * length * length;
  return perTriangle * voxelFace / triangle;
}

} // namespace

KuhnLattice latticeWithSamplesOf(const TissueMap& map, const TissueMap& blocks, const ScaleField& scale,
                                 const SizingFunction& length, const SampleTransferOptions& options,
                                 const Progress& progress)
{
  const Vec3& spacing = map.grid.spacing;
  const auto isWanted = [&](const VoxelFace& face)
  {
    if (!options.perTriangle) return true;
    const double at = length(face.centre(spacing));
    return isWithin(shareAt(at, options.perTriangle(face, at), spacing), face);
  };
  const auto isSame = [&](const VoxelFace& face)
  {
    return labelAt(map, face.lower) == labelAt(blocks, face.lower) &&
           labelAt(map, face.upper()) == labelAt(blocks, face.upper());
  };
  LatticeOptions inPlace;
  inPlace.isSampled = [&](const VoxelFace& face) { return isSame(face) && isWanted(face); };
  KuhnLattice lattice = kuhnLattice(blocks, scale, inPlace, progress);

  const FaceBins bins(lattice, blocks);
  std::vector<std::vector<Sample>> slices(std::size_t(map.grid.size[2]) + 1);
  parallelForEach(slices.size(),
                  [&](std::size_t k)
                  {
                    forEachBoundaryFace(map, int(k) - 1,
                                        [&](const VoxelFace& face)
                                        {
                                          if (isSame(face) || !isWanted(face)) return;
                                          const Vec3 p = face.centre(spacing);
                                          if (const auto holder = bins.nearest(p, labelsBeside(map, face)))
                                            slices[k].push_back({ { p, 0 }, holder->first, holder->second });
                                        });
                  });
  std::vector<Sample>& samples = lattice.background.samples;
  for (const std::vector<Sample>& slice : slices) samples.insert(samples.end(), slice.begin(), slice.end());
  return lattice;
}

} // namespace surgicalmesher
