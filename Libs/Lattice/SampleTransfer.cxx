// SPDX-License-Identifier: Apache-2.0
#include "SampleTransfer.h"

#include "BoundaryFaces.h"
#include "Triangle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>
#include <utility>

namespace surgicalmesher
{

namespace
{

constexpr int binSide = 4; // voxels
constexpr int reach = 3;   // bins, beyond which no face is near

using Index = std::array<int, 3>;
using Sample = BackgroundMesh::Sample;

using LabelPair = std::pair<Label, Label>; ///< ascending

LabelPair labelsBeside(const TissueMap& map, const VoxelFace& face)
{
  return std::minmax(labelAt(map, face.lower), labelAt(map, face.upper()));
}

/// Which voxel faces stay where only a share of them is wanted: by the fractional part of an additive sequence with the
/// plastic number's relatives for its steps, which leaves any share of them evenly spread.
bool isWithin(double share, const VoxelFace& face)
{
  if (share >= 1) return true;
  const std::array<double, 4> steps{ 0.8566748838545029, 0.7338918566271260, 0.6287067210378087, 0.5385972572236101 };
  const double at =
    0.5 + face.lower[0] * steps[0] + face.lower[1] * steps[1] + face.lower[2] * steps[2] + face.axis * steps[3];
  return at - std::floor(at) < share;
}

/// The faces between labels of a lattice, by labels and place.
class FaceBins
{
public:
  FaceBins(const KuhnLattice& lattice, const TissueMap& blocks)
    : m_Mesh(lattice.background.mesh), m_Faces(lattice.interfaceFaces), m_PerMm(1 / blocks.grid.smallestSpacing())
  {
    std::vector<std::size_t> ends(m_Faces.size()); // of each face's entries
    parallelFor(m_Faces.size(), [&](std::size_t f) { ends[f] = binsOf(std::int32_t(f)).count(); });
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    m_Entries.resize(ends.empty() ? 0 : ends.back());
    parallelFor(m_Faces.size(), [&](std::size_t f) { add(std::int32_t(f), blocks, f == 0 ? 0 : ends[f - 1]); });
    vtkSMPTools::Sort(m_Entries.begin(), m_Entries.end());
  }

  /// (tetrahedron, face) nearest to p between the two labels.
  std::optional<std::pair<std::int32_t, int>> nearest(const Vec3& p, const LabelPair& labels) const
  {
    double least = std::numeric_limits<double>::max();
    std::int32_t best = -1;
    const Index home = binOf(p);
    for (int r = 1; r <= reach && best < 0; ++r)
      for (int k = -r; k <= r; ++k)
        for (int j = -r; j <= r; ++j)
        {
          const Entry first{ labels, home[2] + k, home[1] + j, home[0] - r, -1 };
          for (auto e = std::lower_bound(m_Entries.begin(), m_Entries.end(), first);
               e != m_Entries.end() && e->labels == labels && e->z == first.z && e->y == first.y && e->x <= home[0] + r;
               ++e)
            if (const double d2 = squaredDistance(p, e->face); d2 < least) least = d2, best = e->face;
        }
    return best < 0 ? std::nullopt : std::optional(m_Faces[best]);
  }

private:
  struct Entry
  {
    LabelPair labels;
    int z, y, x;
    std::int32_t face;

    bool operator<(const Entry& other) const
    {
      return std::tie(labels, z, y, x, face) < std::tie(other.labels, other.z, other.y, other.x, other.face);
    }
  };

  Index binOf(const Vec3& p) const
  {
    Index bin;
    for (int a = 0; a < 3; ++a) bin[a] = int(std::floor(p[a] * m_PerMm / binSide));
    return bin;
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
    std::size_t count() const
    {
      return std::size_t(to[0] - from[0] + 1) * std::size_t(to[1] - from[1] + 1) * std::size_t(to[2] - from[2] + 1);
    }
  };

  /// That the box of a face reaches into.
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

  /// In all of them; its entries begin at `at`.
  void add(std::int32_t f, const TissueMap& blocks, std::size_t at)
  {
    const LabelPair labels = labelsBeside(blocks, faceUnder(f, blocks));
    const auto [from, to] = binsOf(f);
    for (int z = from[2]; z <= to[2]; ++z)
      for (int y = from[1]; y <= to[1]; ++y)
        for (int x = from[0]; x <= to[0]; ++x) m_Entries[at++] = { labels, z, y, x, f };
  }

  /// A voxel face that lattice face f reaches into.
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
  const double m_PerMm;
  std::vector<Entry> m_Entries;
};

/// Share of the voxel faces that stay where L is `length`.
double shareAt(double length, double perTriangle, const Vec3& spacing)
{
  if (perTriangle == 0) return 1;
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
  { return isWithin(shareAt(length(face.centre(spacing)), options.perTriangle, spacing), face); };
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
