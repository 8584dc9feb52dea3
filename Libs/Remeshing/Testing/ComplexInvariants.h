// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What holds for every TetComplex, recomputed from its bare arrays.

#include "FaceAdjacency.h"
#include "GuardedOperations.h"
#include "MeshChecks.h"
#include "TetComplex.h"
#include "TetQuality.h"
#include "Triangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <vector>

namespace surgicalmesher::test
{

inline std::array<std::int32_t, 3> faceKey(const TetComplex::Tet& tet, int face)
{
  std::array<std::int32_t, 3> key{ tet[(face + 1) & 3], tet[(face + 2) & 3], tet[(face + 3) & 3] };
  std::sort(key.begin(), key.end());
  return key;
}

/// The complex of a mesh with one target length everywhere, and one sample in the middle of each interface face.
inline TetComplex complexOf(const TetMesh& mesh, float length = 1, float tolerance = 0.5f)
{
  TetComplex complex(mesh.points, std::vector<float>(mesh.points.size(), length), mesh.tetrahedra, mesh.labels);
  for (std::int32_t t = 0; t < std::int32_t(complex.tets.size()); ++t)
  {
    for (int i = 0; i < 4; ++i)
    {
      if (!complex.isInterface(t, i) || complex.labels[complex.neighbours[t][i]] > complex.labels[t]) continue;
      const auto [a, b, c] = faceKey(complex.tets[t], i);
      complex.addSample(t, i, (complex.points[a] + complex.points[b] + complex.points[c]) / 3, tolerance);
    }
  }
  return complex;
}

/// The interface faces at v and their samples.
inline Sheet sheetOf(TetComplex& complex, std::int32_t v)
{
  std::vector<std::int32_t> star;
  complex.star(v, star);
  std::vector<TetComplex::FaceOfTet> faces;
  complex.interfaceFaces(v, star, faces);
  Sheet sheet;
  gatherSheet(complex, faces, sheet);
  return sheet;
}

/// The worst quality, which lets tetrahedra outside off with a smaller one.
inline double worstQuality(const GuardedOperations& operations, const TetComplex& complex)
{
  double worst = std::numeric_limits<double>::max();
  for (std::int32_t t = 0; t < std::int32_t(complex.tets.size()); ++t)
    if (complex.alive(t)) worst = std::min(worst, operations.quality(t));
  return worst;
}

/// The living tetrahedra and the points they use.
inline TetMesh meshOf(const TetComplex& complex)
{
  TetMesh mesh;
  std::vector<std::int32_t> ids(complex.points.size(), -1);
  for (std::int32_t t = 0; t < std::int32_t(complex.tets.size()); ++t)
  {
    if (!complex.alive(t)) continue;
    auto tet = complex.tets[t];
    for (std::int32_t& v : tet)
    {
      if (ids[v] < 0)
      {
        ids[v] = std::int32_t(mesh.points.size());
        mesh.points.push_back(complex.points[v]);
      }
      v = ids[v];
    }
    mesh.tetrahedra.push_back(tet);
    mesh.labels.push_back(complex.labels[t]);
  }
  return mesh;
}

/// Background turned into a tissue, so that the checks look at it too.
inline TetMesh withBackgroundAsTissue(TetMesh mesh)
{
  for (Label& label : mesh.labels)
  {
    if (label == 0) label = 65535;
  }
  return mesh;
}

inline double volumeOf(const TetMesh& mesh)
{
  double six = 0;
  for (const auto& [a, b, c, d] : mesh.tetrahedra)
    six += orient(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]);
  return six / 6;
}

inline std::map<Label, double> volumesOf(const TetMesh& mesh)
{
  std::map<Label, double> volumes;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    const auto& [a, b, c, d] = mesh.tetrahedra[t];
    volumes[mesh.labels[t]] += orient(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]) / 6;
  }
  return volumes;
}

/// Where a sample hangs.
struct SamplePlace
{
  std::int32_t tet = -1; ///< -1: let go
  int face = 0;
  std::array<Label, 2> pair{}; ///< ascending; of a block's border face: that of the tetrahedron, twice
  double distance = 0;         ///< mm to its face
};

inline std::vector<SamplePlace> samplePlaces(const TetComplex& complex)
{
  std::vector<SamplePlace> places(complex.samples.size());
  for (std::int32_t t = 0; t < std::int32_t(complex.tets.size()); ++t)
  {
    if (!complex.alive(t)) continue;
    for (int i = 0; i < 4; ++i)
    {
      const std::int32_t n = complex.neighbours[t][i];
      const Label mine = complex.labels[t], other = n < 0 ? mine : complex.labels[n];
      const auto [a, b, c] = faceKey(complex.tets[t], i);
      for (std::int32_t e = complex.sampleHeads[t][i]; e >= 0; e = complex.samples[e].next)
      {
        const double squared = squaredDistanceToTriangle(complex.samples[e].position, complex.points[a],
                                                         complex.points[b], complex.points[c]);
        places[e] = { t, i, { std::min(mine, other), std::max(mine, other) }, std::sqrt(squared) };
      }
    }
  }
  return places;
}

inline std::size_t attachedSamples(const TetComplex& complex)
{
  const auto places = samplePlaces(complex);
  return std::size_t(std::count_if(places.begin(), places.end(), [](const SamplePlace& p) { return p.tet >= 0; }));
}

/// Whether tetrahedra of different labels meet at each vertex.
inline std::vector<bool> meetingLabels(const TetComplex& c)
{
  std::vector<bool> result(c.points.size(), false);
  std::vector<int> label(c.points.size(), -1);
  for (std::int32_t t = 0; t < std::int32_t(c.tets.size()); ++t)
  {
    if (!c.alive(t)) continue;
    for (std::int32_t v : c.tets[t])
    {
      if (label[v] >= 0 && label[v] != c.labels[t]) result[v] = true;
      label[v] = c.labels[t];
    }
  }
  return result;
}

/// Neighbours mutual and across the same three vertices; every used vertex knows one of its tetrahedra; every
/// tetrahedron positive; the vertices on the interface are known as such; samples only at interface faces, on the side
/// of the larger label, and at faces on a block's border; no point in two lists or twice in one.
inline ::testing::AssertionResult isConsistent(const TetComplex& c)
{
  const auto failure = [] { return ::testing::AssertionFailure(); };
  std::vector<bool> used(c.points.size(), false), listed(c.samples.size(), false);
  std::map<std::array<std::int32_t, 3>, int> faces;
  const std::vector<bool> onInterface = meetingLabels(c);
  for (std::size_t v = 0; v < c.points.size(); ++v)
  {
    if (c.vertexTet[v] >= 0 && !c.locked[v] && bool(c.onInterface[v]) != onInterface[v])
      return failure() << "vertex " << v << " is wrong about the interface";
  }
  for (std::int32_t t = 0; t < std::int32_t(c.tets.size()); ++t)
  {
    if (!c.alive(t)) continue;
    for (std::int32_t v : c.tets[t])
    {
      if (v < 0 || v >= std::int32_t(c.points.size())) return failure() << "tetrahedron " << t << " has vertex " << v;
      used[v] = true;
    }
    if (!(c.quality(t) > 0)) return failure() << "tetrahedron " << t << " is inverted or flat";
    for (int i = 0; i < 4; ++i)
    {
      const auto key = faceKey(c.tets[t], i);
      if (++faces[key] > 2) return failure() << "a face of tetrahedron " << t << " has three tetrahedra";
      const std::int32_t n = c.neighbours[t][i];
      if (n >= 0)
      {
        if (n >= std::int32_t(c.tets.size()) || !c.alive(n)) return failure() << t << " has a dead neighbour " << n;
        int back = 0;
        for (int j = 0; j < 4; ++j) back += c.neighbours[n][j] == t && faceKey(c.tets[n], j) == key;
        if (back != 1) return failure() << n << " does not return the neighbour " << t;
      }
      if (c.sampleHeads[t][i] >= 0 && n >= 0 && c.labels[t] <= c.labels[n])
        return failure() << "face " << i << " of tetrahedron " << t << " holds samples, but is not the one to";
      for (std::int32_t e = c.sampleHeads[t][i]; e >= 0; e = c.samples[e].next)
      {
        if (e >= std::int32_t(c.samples.size())) return failure() << "no samples " << e;
        if (listed[e]) return failure() << "samples " << e << " is listed twice";
        listed[e] = true;
      }
    }
  }
  for (std::size_t t = 0; t < c.tets.size(); ++t)
  {
    if (!c.alive(std::int32_t(t))) continue;
    for (int i = 0; i < 4; ++i)
    {
      if (c.neighbours[t][i] < 0 && faces[faceKey(c.tets[t], i)] != 1)
        return failure() << "tetrahedron " << t << " ignores its neighbour across face " << i;
    }
  }
  for (std::size_t v = 0; v < c.points.size(); ++v)
  {
    const std::int32_t t = c.vertexTet[v];
    if (used[v] != (t >= 0)) return failure() << "vertex " << v << " is used or not, its tetrahedron is " << t;
    if (t >= 0 && (!c.alive(t) || !c.contains(t, std::int32_t(v))))
      return failure() << "tetrahedron " << t << " is not at vertex " << v;
  }
  return ::testing::AssertionSuccess();
}

/// All there is to a complex, comparable; the order within samples lists does not count.
struct ComplexState
{
  explicit ComplexState(const TetComplex& c)
    : points(c.points), lengths(c.lengths), locked(c.locked), tets(c.tets), neighbours(c.neighbours), labels(c.labels)
  {
    for (std::int32_t t = 0; t < std::int32_t(c.tets.size()); ++t)
    {
      for (std::int32_t i = 0; i < 4; ++i)
      {
        for (std::int32_t e = c.sampleHeads[t][i]; e >= 0; e = c.samples[e].next) lists.push_back({ t, i, e });
      }
    }
    std::sort(lists.begin(), lists.end());
  }

  bool operator==(const ComplexState& s) const
  {
    return points == s.points && lengths == s.lengths && locked == s.locked && tets == s.tets &&
           neighbours == s.neighbours && labels == s.labels && lists == s.lists;
  }

  std::vector<Vec3> points;
  std::vector<float> lengths;
  std::vector<std::uint8_t> locked;
  std::vector<TetComplex::Tet> tets, neighbours;
  std::vector<Label> labels;
  std::vector<std::array<std::int32_t, 3>> lists; ///< (tetrahedron, face, samples)
};

/// The one nearest to p.
inline std::int32_t vertexNear(const TetComplex& complex, const Vec3& p)
{
  std::int32_t nearest = 0;
  for (std::int32_t v = 0; v < std::int32_t(complex.points.size()); ++v)
    if (squaredNorm(complex.points[v] - p) < squaredNorm(complex.points[nearest] - p)) nearest = v;
  return nearest;
}

/// Vertices that share an edge with v, ascending.
inline std::vector<std::int32_t> neighboursOf(TetComplex& complex, std::int32_t v)
{
  std::vector<std::int32_t> star;
  complex.star(v, star);
  std::set<std::int32_t> around;
  for (std::int32_t t : star) around.insert(complex.tets[t].begin(), complex.tets[t].end());
  around.erase(v);
  return { around.begin(), around.end() };
}

/// Some tetrahedron at edge ab; -1 if there is no such edge.
inline std::int32_t tetrahedronAt(TetComplex& complex, std::int32_t a, std::int32_t b)
{
  std::vector<std::int32_t> star;
  complex.star(a, star);
  for (std::int32_t t : star)
  {
    if (complex.contains(t, b)) return t;
  }
  return -1;
}

} // namespace surgicalmesher::test
