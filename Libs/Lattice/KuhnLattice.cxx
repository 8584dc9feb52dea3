// SPDX-License-Identifier: Apache-2.0
#include "KuhnLattice.h"

#include "Errors.h"
#include "Parallel.h"

#include <algorithm>
#include <atomic>
#include <bitset>
#include <cmath>

namespace surgicalmesher
{

namespace
{

using Index = std::array<int, 3>;
using Tet = std::array<Index, 4>;

/// The set of points of the finest grid that are vertices of the lattice, numbered in the order of the grid, x fastest.
class ActivePoints
{
public:
  explicit ActivePoints(const Index& size) : m_Size(size), m_Words((count() + 63) / 64) {}

  std::size_t count() const { return std::size_t(m_Size[0]) * m_Size[1] * m_Size[2]; }
  bool inside(const Index& p) const
  {
    return p[0] >= 0 && p[1] >= 0 && p[2] >= 0 && p[0] < m_Size[0] && p[1] < m_Size[1] && p[2] < m_Size[2];
  }
  std::size_t at(const Index& p) const { return (std::size_t(p[2]) * m_Size[1] + p[1]) * m_Size[0] + p[0]; }
  bool test(const Index& p) const { return word(at(p) >> 6) >> (at(p) & 63) & 1; }
  /// Thread-safe.
  void set(const Index& p)
  {
    if (inside(p) && !test(p))
      m_Words[at(p) >> 6].fetch_or(std::uint64_t(1) << (at(p) & 63), std::memory_order_relaxed);
  }
  void number()
  {
    m_Before.resize(m_Words.size() + 1, 0);
    for (std::size_t w = 0; w < m_Words.size(); ++w) m_Before[w + 1] = m_Before[w] + bitCount(word(w));
  }
  std::int32_t id(const Index& p) const
  {
    const std::size_t a = at(p);
    return m_Before[a >> 6] + bitCount(word(a >> 6) & ((std::uint64_t(1) << (a & 63)) - 1));
  }
  std::int32_t numbered() const { return m_Before.back(); }
  /// Calls f(id, point) for all points of the set, from several threads.
  template <class F>
  void forEach(F&& f) const
  {
    parallelFor(m_Words.size(),
                [&](std::size_t w)
                {
                  std::int32_t n = m_Before[w];
                  for (std::uint64_t bits = word(w); bits; bits &= bits - 1)
                  {
                    const std::size_t a = w * 64 + bitCount((bits & -bits) - 1);
                    f(n++, Index{ int(a % m_Size[0]), int(a / m_Size[0] % m_Size[1]), int(a / m_Size[0] / m_Size[1]) });
                  }
                });
  }

private:
  static int bitCount(std::uint64_t bits) { return int(std::bitset<64>(bits).count()); }
  std::uint64_t word(std::size_t w) const { return m_Words[w].load(std::memory_order_relaxed); }

  Index m_Size;
  std::vector<std::atomic<std::uint64_t>> m_Words;
  std::vector<std::int32_t> m_Before;
};

/// Lattice coordinates are integer multiples of `unit`. Along each axis, a cell has `cellUnits` units and a voxel has
/// `cells` cells, so that cells are nearly cubes even if voxels are not.
struct Layout
{
  Index cells{ 1, 1, 1 };
  int levelsBelow = 0; ///< cellUnits = 2^levelsBelow
  int rootLevels = 5;  ///< a root cube is 2^rootLevels cells
  Index roots{};       ///< root cubes along each axis
  Index pad{};         ///< cells before the map's first voxel
  Vec3 unit;           ///< mm

  int cellUnits() const { return 1 << levelsBelow; }
  int rootUnits() const { return 1 << (levelsBelow + rootLevels); }
};

Layout makeLayout(const Grid& grid, double shortest, const LatticeOptions& options)
{
  // Least number of background cells on every side, so that the box never constrains a tissue. The padding before the
  // map is a multiple of it, so that blocks of that many voxels are cubes of the lattice (UniformBlocks.h).
  constexpr int margin = 8;
  Layout l;
  const double least = grid.smallestSpacing();
  double cell = 0;
  for (int a = 0; a < 3; ++a)
  {
    l.cells[a] = std::max(1, int(std::lround(grid.spacing[a] / least)));
    cell = std::max(cell, grid.spacing[a] / l.cells[a]);
  }
  while (l.levelsBelow < options.mostLevelsBelowVoxel && cell / l.cellUnits() > options.relativeSize * shortest)
    ++l.levelsBelow;
  for (int a = 0; a < 3; ++a)
  {
    const int cells = grid.size[a] * l.cells[a], root = 1 << l.rootLevels;
    l.roots[a] = (cells + 2 * margin + root - 1) / root;
    l.pad[a] = (l.roots[a] * root - cells) / 2 / margin * margin;
    l.unit[a] = grid.spacing[a] / l.cells[a] / l.cellUnits();
  }
  return l;
}

class Lattice
{
public:
  Lattice(const TissueMap& map, const ScaleField& scale, const LatticeOptions& options)
    : m_Map(map), m_Scale(scale), m_Options(options),
      m_Layout(makeLayout(map.grid, *std::min_element(scale.lengths.begin(), scale.lengths.end()), options)),
      m_Active(gridSize(m_Layout))
  {
  }

  void activate()
  {
    const Index r = m_Layout.roots;
    const int side = m_Layout.rootUnits();
    parallelForEach(std::size_t(r[0]) * r[1] * r[2],
                    [&](std::size_t i)
                    {
                      const Index c = root(i);
                      activateCube({ c[0] * side, c[1] * side, c[2] * side }, side);
                    });
    for (int k = 0; k <= r[2]; ++k)
      for (int j = 0; j <= r[1]; ++j)
        for (int i = 0; i <= r[0]; ++i) m_Active.set({ i * side, j * side, k * side });
    for (int half = 1; half < side; half *= 2) close(half);
    m_Active.number();
  }

  KuhnLattice generate(const Progress& progress)
  {
    KuhnLattice lattice;
    BackgroundMesh& out = lattice.background;
    out.mesh.points.resize(m_Active.numbered());
    out.lengths.resize(m_Active.numbered());
    m_Active.forEach(
      [&](std::int32_t id, const Index& p)
      {
        out.mesh.points[id] = position(p);
        out.lengths[id] = float(m_Scale(m_Map.grid.gridToWorld(out.mesh.points[id])));
      });
    const Index r = m_Layout.roots;
    std::vector<KuhnLattice> parts(std::size_t(r[0]) * r[1] * r[2]);
    parallelForEach(parts.size(), [&](std::size_t i) { generateRoot(root(i), parts[i]); });
    join(parts, lattice);
    report(progress, 1, "lattice");
    return lattice;
  }

private:
  /// Concatenates the parts in their order, array by array, and frees each array at once, to limit peak memory.
  static void join(std::vector<KuhnLattice>& parts, KuhnLattice& whole)
  {
    std::vector<std::int32_t> shifts{ 0 };
    for (const KuhnLattice& part : parts)
      shifts.push_back(shifts.back() + std::int32_t(part.background.mesh.tetrahedra.size()));
    parallelForEach(parts.size(),
                    [&](std::size_t n)
                    {
                      for (auto& sample : parts[n].background.samples) sample.tetrahedron += shifts[n];
                      for (auto& face : parts[n].interfaceFaces) face.first += shifts[n];
                    });
    join(parts, whole, tetrahedraOf);
    join(parts, whole, labelsOf);
    join(parts, whole, samplesOf);
    join(parts, whole, interfaceFacesOf);
  }

  template <class Value>
  static void join(std::vector<KuhnLattice>& parts, KuhnLattice& whole, std::vector<Value>& (*arrayOf)(KuhnLattice&))
  {
    std::vector<std::size_t> starts{ 0 };
    for (KuhnLattice& part : parts) starts.push_back(starts.back() + arrayOf(part).size());
    std::vector<Value>& joined = arrayOf(whole);
    joined.resize(starts.back());
    parallelForEach(parts.size(),
                    [&](std::size_t n)
                    {
                      std::vector<Value>& part = arrayOf(parts[n]);
                      std::copy(part.begin(), part.end(), joined.begin() + std::ptrdiff_t(starts[n]));
                      part = {};
                    });
  }

  static std::vector<std::array<std::int32_t, 4>>& tetrahedraOf(KuhnLattice& l) { return l.background.mesh.tetrahedra; }
  static std::vector<Label>& labelsOf(KuhnLattice& l) { return l.background.mesh.labels; }
  static std::vector<BackgroundMesh::Sample>& samplesOf(KuhnLattice& l) { return l.background.samples; }
  static std::vector<std::pair<std::int32_t, std::int32_t>>& interfaceFacesOf(KuhnLattice& l)
  {
    return l.interfaceFaces;
  }

  static Index gridSize(const Layout& l)
  {
    const int side = l.rootUnits();
    const Index size{ l.roots[0] * side + 1, l.roots[1] * side + 1, l.roots[2] * side + 1 };
    if (double(size[0]) * size[1] * size[2] > 6e10)
      throw EngineError("lattice: the map has too many cells at the scale asked for; use a larger minimum edge length");
    return size;
  }

  Index root(std::size_t i) const
  {
    const Index& r = m_Layout.roots;
    return { int(i % r[0]), int(i / r[0] % r[1]), int(i / r[0] / r[1]) };
  }

  Vec3 position(const Index& p) const
  {
    Vec3 x;
    for (int a = 0; a < 3; ++a)
      x[a] = (p[a] - m_Layout.pad[a] * m_Layout.cellUnits()) * m_Layout.unit[a] - 0.5 * m_Map.grid.spacing[a];
    return x;
  }

  /// Returns the voxel index along an axis of the cell that contains lattice coordinate p (in units, not necessarily
  /// integer).
  int voxel(double p, int axis) const
  {
    const int cell = int(std::floor(p / m_Layout.cellUnits())) - m_Layout.pad[axis];
    return cell < 0 ? -1 : cell / m_Layout.cells[axis];
  }

  /// Returns whether the cube of `side` units at `corner` contains voxels of different labels.
  bool mixed(const Index& corner, int side) const
  {
    Index low, high;
    for (int a = 0; a < 3; ++a)
    {
      low[a] = voxel(corner[a], a);
      high[a] = voxel(corner[a] + side - 0.5, a);
    }
    const Label first = labelAt(m_Map, low);
    for (int k = low[2]; k <= high[2]; ++k)
      for (int j = low[1]; j <= high[1]; ++j)
        for (int i = low[0]; i <= high[0]; ++i)
          if (labelAt(m_Map, { i, j, k }) != first) return true;
    return false;
  }

  bool tooLarge(const Index& corner, int side) const
  {
    const Index middle{ corner[0] + side / 2, corner[1] + side / 2, corner[2] + side / 2 };
    const double mm = side * std::max({ m_Layout.unit.x, m_Layout.unit.y, m_Layout.unit.z });
    Vec3 p = position(middle);
    if (side == 1) p += 0.5 * m_Layout.unit;
    return mm > m_Options.relativeSize * m_Scale(m_Map.grid.gridToWorld(p));
  }

  bool insideMap(const Index& corner, int side) const
  {
    for (int a = 0; a < 3; ++a)
      if (voxel(corner[a] + side - 0.5, a) < 0 || voxel(corner[a], a) >= m_Map.grid.size[a]) return false;
    return true;
  }

  void activateCube(const Index& corner, int side)
  {
    if (side == 1) return;
    if (!insideMap(corner, side)) return;
    const bool isMixed = side > m_Layout.cellUnits() && mixed(corner, side);
    // Background is discarded in the end: only its boundary with tissues needs small elements.
    const bool isTooLarge = isTissue(corner) && tooLarge(corner, side);
    if (!isMixed && !isTooLarge) return;
    if (side <= mostTetrahedralCells * m_Layout.cellUnits() && !tooLarge(corner, side))
      return activateMixedTetrahedra(corner, side);
    const int h = side / 2;
    for (int k = 0; k <= 2; ++k)
      for (int j = 0; j <= 2; ++j)
        for (int i = 0; i <= 2; ++i)
          if ((i | j | k) & 1) m_Active.set({ corner[0] + i * h, corner[1] + j * h, corner[2] + k * h });
    for (int k = 0; k < 2; ++k)
      for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) activateCube({ corner[0] + i * h, corner[1] + j * h, corner[2] + k * h }, h);
  }

  /// Side, in cells, of the largest cube whose tetrahedra are examined one by one. In larger cubes, nearly all
  /// tetrahedra contain several labels.
  static constexpr int mostTetrahedralCells = 4;

  /// Cuts only the tetrahedra that contain voxels of different labels. In a cube that a boundary crosses, half of the
  /// tetrahedra lie on one side of the boundary.
  void activateMixedTetrahedra(const Index& corner, int side)
  {
    forEachKuhnTetrahedron({ corner[0] / side, corner[1] / side, corner[2] / side }, side,
                           [&](const Tet& t) { activateMixed(t, 3, side); });
  }

  static constexpr int mixedLabel = -1;

  /// Returns the label of all voxels that t intersects, or mixedLabel if there are several; then activates t's
  /// bisection as well. `d` is t's tag, `side` that of its cube.
  int activateMixed(const Tet& t, int d, int side)
  {
    Tet left, right;
    const Index z = bisection(t, d, left, right);
    const int nextTag = d > 1 ? d - 1 : 3, nextSide = d > 1 ? side : side / 2;
    const bool last = nextSide == m_Layout.cellUnits(); // each half then lies in one cell
    const int inLeft = last ? labelOf(left) : activateMixed(left, nextTag, nextSide);
    const int inRight = last ? labelOf(right) : activateMixed(right, nextTag, nextSide);
    if (inLeft == inRight && inLeft != mixedLabel) return inLeft;
    m_Active.set(z);
    return mixedLabel;
  }

  Label labelOf(const Tet& t) const
  {
    const auto middle = [&](int a) { return 0.25 * (t[0][a] + t[1][a] + t[2][a] + t[3][a]); };
    return labelAt(m_Map, { voxel(middle(0), 0), voxel(middle(1), 1), voxel(middle(2), 2) });
  }

  bool isTissue(const Index& corner) const
  {
    return labelAt(m_Map, { voxel(corner[0], 0), voxel(corner[1], 1), voxel(corner[2], 2) }) != 0;
  }

  /// Activates the points that the active points of one level of bisection require: the midpoint of an edge requires
  /// the centres of the faces around it, the centre of a face those of its two cubes, the centre of a cube the cube's
  /// corners.
  void close(int half)
  {
    const Index n{ m_Layout.roots[0] * m_Layout.rootUnits(), m_Layout.roots[1] * m_Layout.rootUnits(),
                   m_Layout.roots[2] * m_Layout.rootUnits() };
    const auto closeLayer = [&](int k, int kind)
    {
      for (int j = 0; j <= n[1]; j += half)
      {
        const int odd = (k / half & 1) + (j / half & 1);
        if (odd > kind || odd < kind - 1) continue;
        for (int i = odd == kind ? 0 : half; i <= n[0]; i += 2 * half)
          if (m_Active.test({ i, j, k })) restOn({ i, j, k }, half, kind);
      }
    };
    for (int kind = 1; kind <= 3; ++kind) // odd multiples of half: 1 edge midpoint, 2 face centre, 3 cube centre
      parallelFor(std::size_t(n[2]) / half + 1, [&](std::size_t k) { closeLayer(int(k) * half, kind); });
  }

  void restOn(const Index& p, int half, int kind)
  {
    if (kind == 3)
    {
      for (int c = 0; c < 8; ++c)
        m_Active.set({ p[0] + (c & 1 ? half : -half), p[1] + (c & 2 ? half : -half), p[2] + (c & 4 ? half : -half) });
      return;
    }
    for (int a = 0; a < 3; ++a)
      if (!(p[a] / half & 1))
        for (int s : { -half, half })
        {
          Index q = p;
          q[a] += s;
          m_Active.set(q);
        }
  }

  /// Calls f(t) for the six Kuhn tetrahedra of the cube at index `cube` of the grid of cubes of that side. Their paths
  /// lead from the corner whose indices are all even to the corner whose indices are all odd.
  template <class F>
  static void forEachKuhnTetrahedron(const Index& cube, int side, F&& f)
  {
    Index from, to;
    for (int a = 0; a < 3; ++a)
    {
      from[a] = (cube[a] + (cube[a] & 1)) * side;
      to[a] = (cube[a] + 1 - (cube[a] & 1)) * side;
    }
    std::array<int, 3> axes{ 0, 1, 2 };
    do {
      Tet t;
      t[0] = t[1] = t[2] = from;
      t[3] = to;
      t[1][axes[0]] = t[2][axes[0]] = to[axes[0]];
      t[2][axes[1]] = to[axes[1]];
      f(t);
    } while (std::next_permutation(axes.begin(), axes.end()));
  }

  void generateRoot(const Index& root, KuhnLattice& out) const
  {
    forEachKuhnTetrahedron(root, m_Layout.rootUnits(), [&](const Tet& t) { bisect(t, 3, out); });
  }

  /// Maubach's bisection of t with tag d. Returns the new vertex.
  static Index bisection(const Tet& t, int d, Tet& left, Tet& right)
  {
    Index z;
    for (int a = 0; a < 3; ++a) z[a] = (t[0][a] + t[d][a]) / 2;
    left = right = t;
    left[d] = z;
    for (int i = 0; i < d; ++i) right[i] = t[i + 1];
    right[d] = z;
    return z;
  }

  void bisect(const Tet& t, int d, KuhnLattice& out) const
  {
    Tet left, right;
    const Index z = bisection(t, d, left, right);
    for (int a = 0; a < 3; ++a)
      if ((t[0][a] + t[d][a]) & 1) return emit(t, out);
    if (!m_Active.test(z)) return emit(t, out);
    const int next = d > 1 ? d - 1 : 3;
    bisect(left, next, out);
    bisect(right, next, out);
  }

  void emit(const Tet& t, KuhnLattice& out) const
  {
    std::array<std::int32_t, 4> ids;
    for (int i = 0; i < 4; ++i) ids[i] = m_Active.id(t[i]);
    Vec3 p[4];
    for (int i = 0; i < 4; ++i) p[i] = { double(t[i][0]), double(t[i][1]), double(t[i][2]) };
    Tet x = t;
    if (orient(p[0], p[1], p[2], p[3]) < 0) std::swap(ids[2], ids[3]), std::swap(x[2], x[3]);
    const Label label = labelOf(t);
    const std::int32_t id = std::int32_t(out.background.mesh.tetrahedra.size());
    out.background.mesh.tetrahedra.push_back(ids);
    out.background.mesh.labels.push_back(label);
    if (label != 0) placeSamples(x, id, label, out);
  }

  /// Records the interface faces of a tetrahedron towards smaller labels, which lie between voxels, and gives them the
  /// samples at the centres of the voxel faces that they cover: none, one or, between large tetrahedra, several.
  void placeSamples(const Tet& t, std::int32_t id, Label label, KuhnLattice& out) const
  {
    for (int f = 0; f < 4; ++f)
    {
      const Index &a = t[(f + 1) & 3], &b = t[(f + 2) & 3], &c = t[(f + 3) & 3];
      for (int axis = 0; axis < 3; ++axis)
      {
        if (a[axis] != b[axis] || a[axis] != c[axis]) continue;
        const double inward = t[f][axis] > a[axis] ? 0.25 : -0.25;
        Index here, beyond;
        for (int k = 0; k < 3; ++k)
        {
          const double middle = (a[k] + b[k] + c[k]) / 3.0;
          here[k] = voxel(middle + (k == axis ? inward : 0), k);
          beyond[k] = voxel(middle - (k == axis ? inward : 0), k);
        }
        if (here[axis] == beyond[axis] || labelAt(m_Map, beyond) >= label) continue;
        out.interfaceFaces.push_back({ id, f });
        Index low = here, high = here; // voxels beside the face
        for (int k = 0; k < 3; ++k)
        {
          if (k == axis) continue;
          low[k] = voxel(std::min({ a[k], b[k], c[k] }), k);
          high[k] = voxel(std::max({ a[k], b[k], c[k] }) - 0.5, k);
        }
        Index at;
        for (at[2] = low[2]; at[2] <= high[2]; ++at[2])
          for (at[1] = low[1]; at[1] <= high[1]; ++at[1])
            for (at[0] = low[0]; at[0] <= high[0]; ++at[0])
            {
              if (!coversCentre(a, b, c, axis, at)) continue;
              VoxelFace face{ at, axis };
              face.lower[axis] = std::min(here[axis], beyond[axis]);
              if (m_Options.isSampled && !m_Options.isSampled(face)) continue;
              out.background.samples.push_back({ { face.centre(m_Map.grid.spacing), 0 }, id, f });
            }
      }
    }
  }

  /// Returns whether triangle abc, which lies in a voxel face across `axis`, covers the centre of that face of `voxel`.
  /// As the centre lies on lattice edges, a fixed small displacement makes exactly one triangle cover it.
  bool coversCentre(const Index& a, const Index& b, const Index& c, int axis, const Index& voxel) const
  {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto middle = [&](int k)
    { return ((voxel[k] + 0.5) * m_Layout.cells[k] + m_Layout.pad[k]) * m_Layout.cellUnits(); };
    const double x = middle(u) - 0.11, y = middle(v) - 0.03;
    const auto side = [&](const Index& p, const Index& q)
    { return (q[u] - p[u]) * (y - p[v]) - (q[v] - p[v]) * (x - p[u]) > 0; };
    return side(a, b) == side(b, c) && side(b, c) == side(c, a);
  }

  const TissueMap& m_Map;
  const ScaleField& m_Scale;
  const LatticeOptions& m_Options;
  const Layout m_Layout;
  ActivePoints m_Active;
};

} // namespace

KuhnLattice kuhnLattice(const TissueMap& map, const ScaleField& scale, const LatticeOptions& options,
                        const Progress& progress)
{
  Lattice lattice(map, scale, options);
  lattice.activate();
  report(progress, 0.3, "lattice");
  return lattice.generate(progress);
}

} // namespace surgicalmesher
