// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A labelled tetrahedral complex that is changed by local, guarded operations only.
///
/// The complex fills a box: tetrahedra of label 0 are the space around the tissues. The *interface* is the set of faces
/// between different labels. Every operation preserves three invariants:
///   - Every tetrahedron is wound positively, so the complex is embedded and the interface cannot cross itself.
///   - At every vertex, each label occupies one disc of the vertex's link, so each tissue's boundary is a 2-manifold
///     and no operation changes any tissue's topology; only background that tissues enclose may vanish.
///   - Every boundary sample (a place where the map says that the boundary between two labels is) that lies within its
///     tolerance of a face between these two labels continues to do so. Where other labels come between the two, it may
///     instead lie within tolerance of the boundary of each of them and, if they still share faces nearby, within
///     EnvelopeBounds::separatedFactor tolerances of such a face.
///
/// A complex may be a block cut out of a larger one. The vertices on its border, whose star may continue outside, are
/// locked: no operation moves or removes them.

#include "BackgroundMesh.h"

#include <array>
#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

namespace surgicalmesher
{

/// A boundary sample as an element of the linked list of its face.
struct ListedSample : BoundarySample
{
  std::int32_t next = -1; ///< index in TetComplex::samples; -1: last of the list
  double distance2 = -1;  ///< squared distance to its face, mm^2; -1: not computed yet
};

class TetComplex
{
public:
  using Tet = std::array<std::int32_t, 4>;
  /// For each corner of a tetrahedron the other three, ascending; not wound as in kFaceCorners.
  static constexpr int otherCorners[4][3] = { { 1, 2, 3 }, { 0, 2, 3 }, { 0, 1, 3 }, { 0, 1, 2 } };

  /// `tets` must be positively wound and face-to-face. `lengths` is the target edge length at each point, mm.
  /// `neighbours` is computed if empty.
  TetComplex(std::vector<Vec3> points, std::vector<float> lengths, std::vector<Tet> tets, std::vector<Label> labels,
             std::vector<Tet> neighbours = {});

  // --- arrays; a deleted vertex has vertexTet -1, a deleted tetrahedron has -1 as its first vertex
  std::vector<Vec3> points;
  std::vector<float> lengths;
  std::vector<std::uint8_t> locked;
  std::vector<std::uint8_t> onInterface; ///< per vertex: whether tetrahedra of different labels meet there
  std::vector<std::int32_t> vertexTet;   ///< some tetrahedron at each vertex
  std::vector<Tet> tets;                 ///< vertex indices
  std::vector<Tet> neighbours;           ///< [t][i]: tetrahedron across the face opposite vertex i; -1 on the border
  std::vector<Label> labels;
  /// First sample of each face's list, -1: none. The tetrahedron of the larger label holds the list; on a block's
  /// border, the block that contains that tetrahedron.
  std::vector<std::array<std::int32_t, 4>> sampleHeads;
  std::vector<ListedSample> samples;
  /// Per sample, as in BackgroundMesh; empty if no sample has a normal. Not a member of ListedSample, because the
  /// samples are read more often than anything else, mostly without their normals.
  std::vector<std::array<float, 3>> sampleNormals;

  // --- queries
  bool alive(std::int32_t t) const { return tets[t][0] >= 0; }
  // The next three functions are called by all guards and avoid branches, which would be unpredictable here.
  /// Returns which corner of t (0..3) is v; v must be a vertex of t.
  int indexOf(std::int32_t t, std::int32_t v) const
  {
    assert(contains(t, v));
    const Tet& x = tets[t];
    return (int(x[1] == v) | 2 * int(x[2] == v) | 3 * int(x[3] == v)) & 3;
  }
  bool contains(std::int32_t t, std::int32_t v) const
  {
    const Tet& x = tets[t];
    return (int(x[0] == v) | int(x[1] == v) | int(x[2] == v) | int(x[3] == v)) != 0;
  }
  /// Returns the fourth vertex of t, given the other three.
  std::int32_t fourthVertex(std::int32_t t, std::int32_t a, std::int32_t b, std::int32_t c) const
  {
    const Tet& x = tets[t];
    return (x[0] ^ x[1]) ^ (x[2] ^ x[3]) ^ (a ^ b ^ c);
  }
  /// Returns the target length of edge ab, mm: the mean of the target lengths at its ends.
  double targetLength(std::int32_t a, std::int32_t b) const { return 0.5 * (lengths[a] + lengths[b]); }
  double quality(std::int32_t t) const;
  /// Returns the quality of tetrahedron t with vertex v at position p.
  double qualityWith(std::int32_t t, std::int32_t v, const Vec3& p) const;

  /// Visited marks of tetrahedra; a new search number resets them all at once.
  struct Marks
  {
    std::vector<std::uint32_t> of; ///< per tetrahedron, the number of the last search that visited it
    std::uint32_t search = 0;
  };
  /// Finds the tetrahedra at vertex v.
  void star(std::int32_t v, std::vector<std::int32_t>& tetrahedra) { star(v, tetrahedra, m_Marks); }
  /// The same, in the same order, for concurrent searches: each thread needs its own marks, one per tetrahedron.
  void star(std::int32_t v, std::vector<std::int32_t>& tetrahedra, Marks& marks) const;
  using FaceOfTet = std::pair<std::int32_t, int>; ///< (tetrahedron, its vertex 0..3 opposite the face)
  /// Finds the interface faces at v, each once. `star`: the tetrahedra at v.
  void interfaceFaces(std::int32_t v, const std::vector<std::int32_t>& star, std::vector<FaceOfTet>& faces) const;
  /// Finds the tetrahedra around edge ab in cyclic order, and the ring's vertices: vertices[i] belongs to tetrahedra
  /// i-1 and i. `seed`: any tetrahedron at the edge. Returns false if the edge lies on the border of the block.
  bool ring(std::int32_t a, std::int32_t b, std::int32_t seed, std::vector<std::int32_t>& tetrahedra,
            std::vector<std::int32_t>& vertices) const;

  /// Returns whether face i of t separates two labels; a face on the block's border does not.
  bool isInterface(std::int32_t t, int i) const
  {
    return neighbours[t][i] >= 0 && labels[neighbours[t][i]] != labels[t];
  }

  /// The same, but true only for the lower-numbered tetrahedron of the face, so that a loop over tetrahedra meets each
  /// interface face once.
  bool isInterfaceOfLesser(std::int32_t t, int i) const
  {
    const std::int32_t n = neighbours[t][i];
    return (int(n > t) & int(labels[n < 0 ? t : n] != labels[t])) != 0;
  }

  /// Returns false only if t has no interface face: a cheap test that avoids reading the neighbours of most tetrahedra.
  bool mayHaveInterface(std::int32_t t) const
  {
    const Tet& x = tets[t];
    return onInterface[x[0]] + onInterface[x[1]] + onInterface[x[2]] + onInterface[x[3]] >= 3;
  }

  // --- samples
  /// Adds a sample to face i of tetrahedron t, which must be an interface face or lie on the block's border. `position`
  /// and `tolerance` in mm; `normal` as in BackgroundMesh::Sample.
  void addSample(std::int32_t t, int i, const Vec3& position, float tolerance,
                 const std::array<float, 3>& normal = { 0, 0, 0 });
  std::array<float, 3> sampleNormal(std::int32_t sample) const
  {
    return sampleNormals.empty() ? std::array<float, 3>{ 0, 0, 0 } : sampleNormals[sample];
  }
  /// Returns the interface face (t, i) as seen from the tetrahedron that holds its samples.
  FaceOfTet holder(std::int32_t t, int i) const;

  // --- changes of the complex, without guards
  /// Replaces u by v in star(u) and deletes the ring of uv. The samples of the faces at u must have been detached
  /// before.
  void collapse(std::int32_t u, std::int32_t v, const std::vector<std::int32_t>& starOfU);
  /// Replaces tetrahedra by others that fill the same cavity. Every face of the cavity's border keeps its outer
  /// neighbour and, if its pair of labels persists, its samples; the samples of interface faces inside the cavity must
  /// have been detached before. Returns the ids of the new tetrahedra.
  std::vector<std::int32_t> replace(const std::vector<std::int32_t>& old, const std::vector<Tet>& tetrahedra,
                                    const std::vector<Label>& newLabels);
  /// Adds a vertex without tetrahedra and returns its id.
  std::int32_t addVertex(const Vec3& p, float length, bool isOnInterface);

private:
  std::int32_t allocate();

  Marks m_Marks;
  std::vector<std::int32_t> m_Free;
};

} // namespace surgicalmesher
