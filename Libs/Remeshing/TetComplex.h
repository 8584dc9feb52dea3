// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A labelled tetrahedral complex that is changed by local, guarded operations only.
///
/// The complex fills a box: tetrahedra of label 0 are the space around the tissues. The *interface* is the set of faces
/// between different labels. Three promises hold before and after every operation:
///   - every tetrahedron is wound positively, so the complex is embedded and the interface cannot cross itself;
///   - at every vertex, each label occupies one disc of the vertex's link, so each tissue's boundary is a 2-manifold
///     and no
///     operation changes any tissue's topology; only background that tissues enclose may vanish;
///   - every boundary sample (a place where the map says that the boundary between two labels is) lies within its
///     tolerance of a face between these two labels, or of the boundary of either and twice as far from such a face if
///     there is one, once it does.
///
/// A complex may be a block cut out of a larger one. The vertices on its border, whose star may go on outside, are
/// locked: no operation moves or removes them.

#include "BackgroundMesh.h"

#include <array>
#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

namespace surgicalmesher
{

/// In the list of its face.
struct ListedSample : BoundarySample
{
  std::int32_t next = -1;
  double distance2 = -1; ///< mm^2, to its face; -1 until somebody has asked
};

class TetComplex
{
public:
  using Tet = std::array<std::int32_t, 4>;
  /// The corners of a tetrahedron besides each of them, ascending, not wound as in kFaceCorners.
  static constexpr int otherCorners[4][3] = { { 1, 2, 3 }, { 0, 2, 3 }, { 0, 1, 3 }, { 0, 1, 2 } };

  /// `tets` must be positively wound and face-to-face. `lengths` is the target edge length at each point, mm.
  /// `neighbours` may be empty: then they are found.
  TetComplex(std::vector<Vec3> points, std::vector<float> lengths, std::vector<Tet> tets, std::vector<Label> labels,
             std::vector<Tet> neighbours = {});

  // --- the arrays; dead vertices have vertexTet -1, dead tetrahedra vertex 0 equal to -1
  std::vector<Vec3> points;
  std::vector<float> lengths;
  std::vector<std::uint8_t> locked;
  std::vector<std::uint8_t> onInterface; ///< per vertex: tetrahedra of different labels meet there
  std::vector<std::int32_t> vertexTet;   ///< some tetrahedron at each vertex
  std::vector<Tet> tets;                 ///< vertices
  std::vector<Tet> neighbours;           ///< [i] across the face opposite vertex i; -1 beyond a block
  std::vector<Label> labels;
  std::vector<std::array<std::int32_t, 4>> sampleHeads; ///< per face, held by the side of the larger label (on a
                                                        ///< block's border, by the block that has that side)
  std::vector<ListedSample> samples;
  std::vector<std::array<float, 3>> sampleNormals; ///< as in BackgroundMesh; empty if no sample has one, apart because
                                                   ///< samples without are read more often than anything else

  // --- queries
  bool alive(std::int32_t t) const { return tets[t][0] >= 0; }
  // What follows has no branches: which corner it is, or whether one is, cannot be foreseen, and all guards ask.
  /// Which corner of t is v, which must be one.
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
  /// The one besides three of the vertices of t.
  std::int32_t fourthVertex(std::int32_t t, std::int32_t a, std::int32_t b, std::int32_t c) const
  {
    const Tet& x = tets[t];
    return (x[0] ^ x[1]) ^ (x[2] ^ x[3]) ^ (a ^ b ^ c);
  }
  /// Of edge ab, mm: the mean of its ends'.
  double targetLength(std::int32_t a, std::int32_t b) const { return 0.5 * (lengths[a] + lengths[b]); }
  double quality(std::int32_t t) const;
  /// Quality of tetrahedron t with vertex v at position p.
  double qualityWith(std::int32_t t, std::int32_t v, const Vec3& p) const;

  /// Which tetrahedra a search has met.
  struct Marks
  {
    std::vector<std::uint32_t> of; ///< per tetrahedron, the number of the last search that has
    std::uint32_t search = 0;
  };
  /// Tetrahedra at vertex v.
  void star(std::int32_t v, std::vector<std::int32_t>& tetrahedra) { star(v, tetrahedra, m_Marks); }
  /// The same in the same order, for searches on several threads, each with marks of its own, as many as tetrahedra.
  void star(std::int32_t v, std::vector<std::int32_t>& tetrahedra, Marks& marks) const;
  using FaceOfTet = std::pair<std::int32_t, int>; ///< opposite the tetrahedron's vertex of that number
  /// The interface faces at v, each once, whose tetrahedra are `star`.
  void interfaceFaces(std::int32_t v, const std::vector<std::int32_t>& star, std::vector<FaceOfTet>& faces) const;
  /// Tetrahedra around edge ab in cyclic order, and the vertices between them (ring[i] in tetrahedra i-1 and i).
  /// False if the edge lies on the border of the block. `seed` is one tetrahedron at the edge.
  bool ring(std::int32_t a, std::int32_t b, std::int32_t seed, std::vector<std::int32_t>& tetrahedra,
            std::vector<std::int32_t>& vertices) const;

  /// Face i of t separates two labels (a border face of the block does not).
  bool isInterface(std::int32_t t, int i) const
  {
    return neighbours[t][i] >= 0 && labels[neighbours[t][i]] != labels[t];
  }

  /// The same, if t is the lesser of its two tetrahedra: among those of a star, each such face once.
  bool isInterfaceOfLesser(std::int32_t t, int i) const
  {
    const std::int32_t n = neighbours[t][i];
    return (int(n > t) & int(labels[n < 0 ? t : n] != labels[t])) != 0;
  }

  /// Whether t may have such a face at all: spares most tetrahedra the look at their neighbours.
  bool mayHaveInterface(std::int32_t t) const
  {
    const Tet& x = tets[t];
    return onInterface[x[0]] + onInterface[x[1]] + onInterface[x[2]] + onInterface[x[3]] >= 3;
  }

  // --- samples
  /// Adds a point to face i of tetrahedron t, whose sides must differ in label, or which is on the block's border.
  void addSample(std::int32_t t, int i, const Vec3& position, float tolerance,
                 const std::array<float, 3>& normal = { 0, 0, 0 });
  std::array<float, 3> sampleNormal(std::int32_t sample) const
  {
    return sampleNormals.empty() ? std::array<float, 3>{ 0, 0, 0 } : sampleNormals[sample];
  }
  /// The interface face (t, i), from that of its two sides which holds the samples.
  FaceOfTet holder(std::int32_t t, int i) const;

  // --- changes of the complex; no guard here
  /// Replaces u by v in star(u); the ring of uv dies. Samples of the faces at u must have been taken before.
  void collapse(std::int32_t u, std::int32_t v, const std::vector<std::int32_t>& starOfU);
  /// Replaces tetrahedra by others that fill the same cavity; every border face keeps its outer neighbour and, if its
  /// label pair persists, its samples. Samples of inner interface faces must have been taken before. Returns the
  /// new ids.
  std::vector<std::int32_t> replace(const std::vector<std::int32_t>& old, const std::vector<Tet>& tetrahedra,
                                    const std::vector<Label>& newLabels);
  std::int32_t addVertex(const Vec3& p, float length, bool isOnInterface);

private:
  std::int32_t allocate();

  Marks m_Marks;
  std::vector<std::int32_t> m_Free;
};

} // namespace surgicalmesher
