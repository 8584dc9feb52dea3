// SPDX-License-Identifier: Apache-2.0
#include "TetComplex.h"

#include "FaceAdjacency.h"
#include "Prefetch.h"
#include "TetQuality.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace surgicalmesher
{

namespace
{

using Tet = TetComplex::Tet;

/// Returns the three vertices opposite vertex i, in ascending order.
std::array<std::int32_t, 3> sortedFace(const Tet& t, int i)
{
  std::array<std::int32_t, 3> f{ t[(i + 1) & 3], t[(i + 2) & 3], t[(i + 3) & 3] };
  if (f[0] > f[1]) std::swap(f[0], f[1]);
  if (f[1] > f[2]) std::swap(f[1], f[2]);
  if (f[0] > f[1]) std::swap(f[0], f[1]);
  return f;
}

} // namespace

TetComplex::TetComplex(std::vector<Vec3> points_, std::vector<float> lengths_, std::vector<Tet> tets_,
                       std::vector<Label> labels_, std::vector<Tet> neighbours_)
  : points(std::move(points_)), lengths(std::move(lengths_)), locked(points.size(), 0), onInterface(points.size(), 0),
    vertexTet(points.size(), -1), tets(std::move(tets_)), neighbours(std::move(neighbours_)),
    labels(std::move(labels_)),
    sampleHeads(tets.size(), { -1, -1, -1, -1 }), m_Marks{ std::vector<std::uint32_t>(tets.size(), 0) }
{
  for (std::size_t t = 0; t < tets.size(); ++t)
    for (std::int32_t v : tets[t])
    {
      if (vertexTet[v] >= 0 && labels[vertexTet[v]] != labels[t]) onInterface[v] = 1;
      vertexTet[v] = std::int32_t(t);
    }
  if (neighbours.empty())
  {
    neighbours.assign(tets.size(), Tet{ -1, -1, -1, -1 });
    matchOpenFaces(tets, points.size(), neighbours);
  }
  for (std::size_t t = 0; t < tets.size(); ++t)
    for (int i = 0; i < 4; ++i)
      if (neighbours[t][i] < 0)
        for (int k = 1; k < 4; ++k) locked[tets[t][(i + k) & 3]] = 1;
}

double TetComplex::quality(std::int32_t t) const
{
  const Tet& x = tets[t];
  return worstSine2(points[x[0]], points[x[1]], points[x[2]], points[x[3]]);
}

double TetComplex::qualityWith(std::int32_t t, std::int32_t v, const Vec3& p) const
{
  const Tet& x = tets[t];
  return worstSine2(x[0] == v ? p : points[x[0]], x[1] == v ? p : points[x[1]], x[2] == v ? p : points[x[2]],
                    x[3] == v ? p : points[x[3]]);
}

void TetComplex::star(std::int32_t v, std::vector<std::int32_t>& out, Marks& marks) const
{
  const std::uint32_t search = ++marks.search;
  if (out.size() < 32) out.resize(32);
  std::size_t n = 1, room = out.size();
  out[0] = vertexTet[v];
  marks.of[out[0]] = search;
  for (std::size_t i = 0; i < n; ++i)
  {
    if (n + 4 > room) out.resize(room *= 2);
    const Tet& across = neighbours[out[i]];
    for (const int k : otherCorners[indexOf(out[i], v)])
    {
      const std::int32_t t = across[k];
      if (t < 0) continue;
      std::uint32_t& mark = marks.of[t];
      out[n] = t; // kept only if t is new; a branch on that would be unpredictable
      n += std::size_t(mark != search);
      mark = search;
      prefetch(&tets[t]);
      prefetch(&neighbours[t]);
    }
  }
  out.resize(n);
}

void TetComplex::interfaceFaces(std::int32_t v, const std::vector<std::int32_t>& star,
                                std::vector<FaceOfTet>& faces) const
{
  faces.clear();
  if (!onInterface[v]) return;
  for (const std::int32_t t : star)
    for (int i = 0; i < 4; ++i)
      if (tets[t][i] != v && isInterfaceOfLesser(t, i)) faces.emplace_back(t, i);
}

bool TetComplex::ring(std::int32_t a, std::int32_t b, std::int32_t seed, std::vector<std::int32_t>& tetrahedra,
                      std::vector<std::int32_t>& vertices) const
{
  tetrahedra.clear();
  vertices.clear();
  // The seed's winding fixes the sense of rotation: (a, b, from, to) is an even permutation of its corners. third[i][k]
  // is the corner of `from` if i and k are those of a and b.
  static constexpr int third[4][4] = { { 0, 2, 3, 1 }, { 3, 0, 0, 2 }, { 1, 3, 0, 0 }, { 2, 0, 1, 0 } };
  std::int32_t t = seed, from = tets[t][third[indexOf(t, a)][indexOf(t, b)]];
  do {
    tetrahedra.push_back(t);
    vertices.push_back(from);
    const std::int32_t to = fourthVertex(t, a, b, from);
    t = neighbours[t][indexOf(t, from)];
    if (t < 0) return false;
    from = to;
  } while (t != seed);
  return true;
}

TetComplex::FaceOfTet TetComplex::holder(std::int32_t t, int i) const
{
  const std::int32_t n = neighbours[t][i];
  if (n < 0 || labels[t] > labels[n]) return { t, i };
  for (int j = 0; j < 4; ++j)
    if (neighbours[n][j] == t && !contains(t, tets[n][j])) return { n, j };
  assert(false);
  return { n, 0 };
}

void TetComplex::addSample(std::int32_t t, int i, const Vec3& position, float tolerance,
                           const std::array<float, 3>& normal)
{
  const auto [h, j] = holder(t, i);
  samples.push_back({ { position, tolerance }, sampleHeads[h][j], -1 });
  if (normal != std::array<float, 3>{ 0, 0, 0 } || !sampleNormals.empty())
  {
    sampleNormals.resize(samples.size(), { 0, 0, 0 });
    sampleNormals.back() = normal;
  }
  sampleHeads[h][j] = std::int32_t(samples.size()) - 1;
}

void TetComplex::collapse(std::int32_t u, std::int32_t v, const std::vector<std::int32_t>& starOfU)
{
  for (std::int32_t t : starOfU)
  {
    const int iu = indexOf(t, u);
    if (!contains(t, v))
    {
      tets[t][iu] = v;
      vertexTet[v] = t;
    }
  }
  for (std::int32_t t : starOfU)
  {
    if (!contains(t, u)) continue;
    const int iv = indexOf(t, v), iu = indexOf(t, u);
    const std::int32_t nu = neighbours[t][iv], nv = neighbours[t][iu]; // across the face at u, and the face at v
    int ju = -1, jv = -1;
    if (nu >= 0)
      for (int k = 0; k < 4; ++k)
        if (neighbours[nu][k] == t) ju = k;
    if (nv >= 0)
      for (int k = 0; k < 4; ++k)
        if (neighbours[nv][k] == t) jv = k;
    const std::int32_t head = sampleHeads[t][iu] >= 0 ? sampleHeads[t][iu] : (jv >= 0 ? sampleHeads[nv][jv] : -1);
    if (ju >= 0) neighbours[nu][ju] = nv, sampleHeads[nu][ju] = -1;
    if (jv >= 0) neighbours[nv][jv] = nu, sampleHeads[nv][jv] = -1;
    // If nv is beyond the block's border, it has another label: otherwise there would be no samples.
    if (head >= 0 && nu >= 0 && (nv < 0 || labels[nu] > labels[nv])) sampleHeads[nu][ju] = head;
    else if (head >= 0 && nu >= 0 && labels[nu] < labels[nv]) sampleHeads[nv][jv] = head;
    for (std::int32_t x : tets[t])
      if (x != u && x != v) vertexTet[x] = nu >= 0 ? nu : nv;
    vertexTet[v] = nu >= 0 ? nu : nv;
    tets[t] = { -1, -1, -1, -1 };
    sampleHeads[t] = { -1, -1, -1, -1 };
    m_Free.push_back(t);
  }
  vertexTet[u] = -1;
}

std::int32_t TetComplex::allocate()
{
  if (!m_Free.empty())
  {
    const std::int32_t t = m_Free.back();
    m_Free.pop_back();
    return t;
  }
  tets.push_back({ -1, -1, -1, -1 });
  neighbours.push_back({ -1, -1, -1, -1 });
  labels.push_back(0);
  sampleHeads.push_back({ -1, -1, -1, -1 });
  m_Marks.of.push_back(0);
  return std::int32_t(tets.size()) - 1;
}

std::int32_t TetComplex::addVertex(const Vec3& p, float length, bool isOnInterface)
{
  points.push_back(p);
  lengths.push_back(length);
  locked.push_back(0);
  onInterface.push_back(isOnInterface);
  vertexTet.push_back(-1);
  return std::int32_t(points.size()) - 1;
}

std::vector<std::int32_t> TetComplex::replace(const std::vector<std::int32_t>& old, const std::vector<Tet>& fresh,
                                              const std::vector<Label>& newLabels)
{
  struct BorderFace
  {
    std::array<std::int32_t, 3> key;
    std::int32_t outer;
    int outerIndex;
    std::int32_t head;
  };
  const auto isOld = [&](std::int32_t t) { return std::find(old.begin(), old.end(), t) != old.end(); };
  std::vector<BorderFace> border;
  for (std::int32_t t : old)
    for (int i = 0; i < 4; ++i)
    {
      const std::int32_t n = neighbours[t][i];
      if (n >= 0 && isOld(n)) continue;
      BorderFace f{ sortedFace(tets[t], i), n, -1, sampleHeads[t][i] };
      if (n >= 0)
        for (int j = 0; j < 4; ++j)
          if (neighbours[n][j] == t && sortedFace(tets[n], j) == f.key) f.outerIndex = j;
      border.push_back(f);
    }
  for (std::int32_t t : old)
  {
    tets[t] = { -1, -1, -1, -1 };
    sampleHeads[t] = { -1, -1, -1, -1 };
    m_Free.push_back(t);
  }
  std::vector<std::int32_t> ids;
  for (std::size_t k = 0; k < fresh.size(); ++k)
  {
    const std::int32_t t = allocate();
    ids.push_back(t);
    tets[t] = fresh[k];
    neighbours[t] = { -1, -1, -1, -1 };
    labels[t] = newLabels[k];
    for (std::int32_t v : fresh[k]) vertexTet[v] = t;
  }
  for (std::size_t k = 0; k < ids.size(); ++k)
    for (int i = 0; i < 4; ++i)
    {
      const std::int32_t t = ids[k];
      if (neighbours[t][i] >= 0) continue;
      const auto key = sortedFace(tets[t], i);
      const auto b = std::find_if(border.begin(), border.end(), [&](const BorderFace& f) { return f.key == key; });
      if (b != border.end())
      {
        neighbours[t][i] = b->outer;
        if (b->outer >= 0) neighbours[b->outer][b->outerIndex] = t;
        if (b->head >= 0 && (b->outer < 0 || labels[t] > labels[b->outer])) sampleHeads[t][i] = b->head;
        continue;
      }
      for (std::size_t m = k + 1; m < ids.size() && neighbours[t][i] < 0; ++m)
        for (int j = 0; j < 4; ++j)
          if (neighbours[ids[m]][j] < 0 && sortedFace(tets[ids[m]], j) == key)
          {
            neighbours[t][i] = ids[m];
            neighbours[ids[m]][j] = t;
            break;
          }
    }
  return ids;
}

} // namespace surgicalmesher
