// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Edge collapse, vertex move, edge removal (flip), edge split and relabelling on a TetComplex, one source file each,
/// with all guards that keep the invariants of the complex: positive volumes and a least quality, the topology of every
/// tissue, the envelope of the interface, the curves along edges, the locks of a block's border. On the dual simplex
/// mesh, collapse, split and flip of interface edges are Delingette's Eulerian operators T1, T2 and T7 (Audette et al.
/// 2007); because they are applied to the tetrahedra of both sides, the interface can neither tear nor cross itself.
///
/// An operation that returns false has changed nothing. Stars, measures and samples are cached between operations:
/// after a change of the complex by other means, create new GuardedOperations.
///
/// The *quality* of a tetrahedron is worstSine2 (TetQuality.h). That of tetrahedra of label 0, which are discarded in
/// the end and may be worse, is multiplied by backgroundLeniency. The quality of an interface triangle is smallestSine2
/// times EnvelopeBounds::triangleWeight.

#include "CurveChains.h"
#include "Envelope.h"
#include "SizingFunction.h"
#include "StarQuality.h"
#include "SwapRefusals.h"
#include "TissueTopology.h"

#include <limits>
#include <optional>
#include <vector>

namespace surgicalmesher
{

struct OperationCounts
{
  long collapses = 0, moves = 0, flips = 0, splits = 0, relabels = 0;
  long t1 = 0, t2 = 0, t7 = 0; ///< collapses, splits and flips of interface edges, included in the counts above

  OperationCounts& operator+=(const OperationCounts& more);
};

/// The least quality that counts as better than q.
inline double clearlyBetter(double q) { return q * 1.0001 + 1e-9; }

class GuardedOperations
{
public:
  /// `length`: target edge length, for vertices that move or are new. `rigidity`: see quadricOf. `curves`: chains of
  /// edges of the complex that are to be kept, or null.
  GuardedOperations(TetComplex& complex, SizingFunction length, const EnvelopeBounds& bounds = {}, double rigidity = 0,
                    CurveChains* curves = nullptr);

  // --- vertex stars and qualities
  /// Returns the worst quality of tetrahedron t and its interface triangles; if triangleWeight is 0, of t alone.
  double quality(std::int32_t t) const;

  /// Returns the worst quality of `tetrahedra`.
  double worstQuality(const std::vector<std::int32_t>& tetrahedra) const;

  /// Returns the tetrahedra at v; cached until an operation changes the connectivity or a label.
  const std::vector<std::int32_t>& star(std::int32_t v) { return starOf(v, m_Star); }

  /// As star(), in a cache of its own, for the vertices onto which another vertex may be collapsed.
  const std::vector<std::int32_t>& starOfTarget(std::int32_t v)
  {
    return v == m_Star.vertex ? m_Star.tets : target(v).tets;
  }

  /// Returns the interface faces at v; cached likewise.
  const std::vector<TetComplex::FaceOfTet>& interfaceFaces(std::int32_t v) { return interfaceFacesOf(v, m_Star); }
  const std::vector<TetComplex::FaceOfTet>& interfaceFacesOfTarget(std::int32_t v)
  {
    return interfaceFacesOf(v, v == m_Star.vertex ? m_Star : target(v));
  }

  struct Neighbour
  {
    std::int32_t vertex;
    bool alongInterface; ///< whether tetrahedra of different labels meet at the edge
  };
  /// Returns the other ends of the edges at v; cached likewise.
  const std::vector<Neighbour>& neighbours(std::int32_t v);

  /// Returns the interface faces at v and their samples; cached likewise, and while no vertex but v moves.
  const Sheet& sheet(std::int32_t v)
  {
    return m_Envelope.holdsSheetOf(v) ? m_Envelope.sheet() : m_Envelope.gatherSheetOf(v, interfaceFaces(v));
  }

  bool watchesFeatures() const { return m_Envelope.watchesFeatures(); }

  /// Returns the part of a step of v that keeps flat faces flat and sharp edges in place; the whole step without a
  /// feature angle.
  Vec3 alongFeatures(std::int32_t v, const Vec3& step)
  {
    if (!m_Envelope.watchesFeatures() || !m_Complex.onInterface[v]) return step;
    sheet(v);
    return m_Envelope.alongFeatures(step);
  }

  /// Returns the evaluator of qualities at v for any position of v; cached likewise, and while no vertex but v moves.
  StarQuality& measured(std::int32_t v) { return measured(v, m_Star); }

  /// Returns the worst quality at v with v at p; if that is less than `atLeast`, any value below `atLeast`.
  double qualityAt(std::int32_t v, const Vec3& p, double atLeast) { return measured(v).worst(p, atLeast); }
  double qualityAt(std::int32_t v) { return qualityAt(v, m_Complex.points[v], -1); }

  // --- edge collapse (EdgeCollapse.cxx)
  /// Whether locks, labels and curves allow merging u into its neighbour v; `moves`: v moves as well. A vertex of the
  /// interface may merge only into another one, whose star must be complete in the block; a vertex inside a label must
  /// not move a vertex of the interface or a locked one.
  bool mayCollapse(std::int32_t u, std::int32_t v, bool moves) const;

  /// Whether coarsening may remove u. If there are curves, only vertices on a curve or next to one may go, because
  /// tracing has cut the tetrahedra there; the lengths of all other edges were settled before.
  bool mayCoarsen(std::int32_t u);

  /// Returns the worst quality among the changed tetrahedra after merging u into v at p. Returns any value below
  /// `atLeast` if the quality is less than that, or if an edge at v would become longer than `maximumRatio` times its
  /// target; an edge that is longer already must not grow.
  double qualityAfterCollapse(std::int32_t u, std::int32_t v, const Vec3& p, double atLeast, double maximumRatio);

  /// Merges u into v at p, if curves, envelope and topology allow it and the changed interface triangles reach
  /// `minimumQuality`: the part of collapse() after mayCollapse() and qualityAfterCollapse().
  bool collapseWithin(std::int32_t u, std::int32_t v, const Vec3& p, double minimumQuality);

  /// Merges u into its neighbour v, which moves to p, if every changed tetrahedron reaches `minimumQuality` and all
  /// guards above allow it.
  bool collapse(std::int32_t u, std::int32_t v, const Vec3& p, double minimumQuality, double maximumRatio);

  // --- vertex move (VertexMove.cxx)
  /// Moves v to p, if v is not locked, every quality at v reaches `minimumQuality`, and envelope and curves allow it.
  bool move(std::int32_t v, const Vec3& p, double minimumQuality)
  {
    return !m_Complex.locked[v] && qualityAt(v, p, minimumQuality) >= minimumQuality && moveWithin(v, p);
  }

  /// The part of move() after the tests of lock and quality.
  bool moveWithin(std::int32_t v, const Vec3& p);

  /// Undoes a move of v from p. Several moves must be undone latest first. No guard is tested, because the position was
  /// allowed before.
  void moveBack(std::int32_t v, const Vec3& p);

  /// After several moves have been undone: reassigns the samples of the faces at v to the nearest of these faces, if
  /// any sample is beyond its tolerance. Moves may have passed a sample on to a face out of reach of the moves back.
  void reassignSamples(std::int32_t v);

  // --- edge removal (EdgeRemoval.cxx)
  /// Replaces the tetrahedra around edge ab by the best ones without the edge (Klincsek 1980, as Shewchuk uses it). An
  /// interface edge between two labels is flipped to the other diagonal of its two triangles. `seed` is a tetrahedron
  /// at the edge. All new tetrahedra must reach `minimumQuality`; if not given, be better than the worst around ab.
  bool removeEdge(std::int32_t a, std::int32_t b, std::int32_t seed, std::optional<double> minimumQuality = {});

  /// As removeEdge(), to increase the least height of the tetrahedra of tissues; the worst quality may fall to
  /// `goodQuality`.
  bool removeLowEdge(std::int32_t a, std::int32_t b, std::int32_t seed, double goodQuality);

  struct SwapGoal
  {
    double goodQuality;       ///< the worst quality may fall to this
    double usualSine;         ///< sine that a tetrahedron's worst angle usually has
    double smoothness;        ///< weight, in sines, of a radian of bending along an edge of the target length
    double leastGain;         ///< in sines
    bool sparesWhole = false; ///< leave edges alone around which a vertex isWhole()
  };
  /// As removeEdge(), to increase the sum over the tetrahedra of tissues of the sine of the worst angle less the usual
  /// sine, and to flatten the interface if ab is an interface edge. `refusals`, if given, saves repeated tests and is
  /// kept up to date.
  bool swapEdge(std::int32_t a, std::int32_t b, std::int32_t seed, const SwapGoal& goal,
                SwapRefusals* refusals = nullptr);

  /// The vertices of the ring (the link) of the edge removed last.
  const std::vector<std::int32_t>& ringVertices() const { return m_RingVertices; }

  // --- edge split (EdgeSplit.cxx)
  /// Splits edge ab at p; `seed` is a tetrahedron at the edge. Returns the new vertex, or nothing if a guard refuses.
  std::optional<std::int32_t> split(std::int32_t a, std::int32_t b, std::int32_t seed, const Vec3& p,
                                    double minimumQuality);

  /// Undoes the split of an edge at vertex v by merging v into the edge's end a; v must lie where the split has put it.
  void takeBackSplit(std::int32_t v, std::int32_t a);

  // --- relabelling (Relabel.cxx)
  static constexpr double anyShare = std::numeric_limits<double>::infinity();

  /// Changes the label of t to `label` if that lies beyond one of the faces of t and both labels keep their topology
  /// and their manifold boundary: t is a simple point of both. With `mostLeft`, only if no more than that share of the
  /// squared distances between interface and samples, both ways, remains (Envelope::comesNearer).
  bool relabel(std::int32_t t, Label label, double minimumQuality, double mostLeft = anyShare);

  /// Returns the position of the sample nearest to v among those of the interface faces at v; nothing if there is none.
  std::optional<Vec3> nearestSampleOf(std::int32_t v);

  /// Whether interface vertex v is farther from the boundary (Envelope::squaredDistanceBy the nearest sample of its
  /// faces) than `tolerances` tolerances and the spacing of samples.
  bool isSpike(std::int32_t v, double tolerances);

  TetComplex& complex() { return m_Complex; }
  Envelope& envelope() { return m_Envelope; }
  const OperationCounts& counts() const { return m_Counts; }
  double rigidity() const { return m_Rigidity; }
  /// Subtracts two relabellings that undid each other from the counts.
  void uncountRelabels() { m_Counts.relabels -= 2; }

private:
  struct FaceAtEnd
  {
    SheetFace face;
    std::array<std::int32_t, 2> beside; ///< the vertices opposite the face in its two tetrahedra
  };
  /// The star of a vertex with all that is cached of it.
  struct Star
  {
    std::int32_t vertex = -1; ///< -1: none, the cache is empty
    std::vector<std::int32_t> tets;
    bool isMeasured = false;
    StarQuality quality;
    std::vector<std::int32_t> ends; ///< other ends of the edges at the vertex; empty until needed
    bool hasFaces = false, hasFacesAtEnd = false;
    std::vector<TetComplex::FaceOfTet> faces; ///< interface faces at the vertex
    std::vector<FaceAtEnd> facesAtEnd;        ///< the same faces with the vertices opposite them
  };

  const std::vector<std::int32_t>& starOf(std::int32_t v, Star& star);
  const std::vector<TetComplex::FaceOfTet>& interfaceFacesOf(std::int32_t v, Star& star);
  StarQuality& measured(std::int32_t v, Star& star);
  bool recall(std::int32_t v);
  Star& target(std::int32_t v);
  const std::vector<std::int32_t>& endsAt(Star& star);
  const std::vector<FaceAtEnd>& facesAtEnd(std::int32_t v, Star& star);
  void changed();
  double lenient(std::int32_t t, double q) const { return lenient(m_Complex.labels[t], q); }
  static double lenient(Label label, double q) { return label == 0 ? q * backgroundLeniency : q; }
  bool meetsLabels(const std::vector<std::int32_t>& star) const;
  bool keepsLength(std::int32_t end, std::int32_t x, std::int32_t v, const Vec3& p, double maximumRatio) const;
  bool findCollapsingRing(std::int32_t u, std::int32_t v);
  bool keepsTissues(std::int32_t u, std::int32_t v);
  bool openRing(std::int32_t a, std::int32_t b, std::int32_t seed, int largest);
  template <class Measure>
  std::optional<double> fillRing(std::int32_t a, std::int32_t b, double minimumQuality, const Measure& measure);
  bool closeRing(std::int32_t a, std::int32_t b, double minimumQuality);
  std::optional<double> worthSwapping(std::int32_t a, std::int32_t b, const SwapGoal& goal);
  void forgetAround(std::int32_t a, std::int32_t b, SwapRefusals& refusals);
  bool mayFlipSheet(std::int32_t a, std::int32_t b, double minimumQuality);
  bool ringHasWhole();
  bool staysBroad(std::int32_t a, std::int32_t b);
  double flatterBy(std::int32_t a, std::int32_t b) const;
  bool gatherCollapsingFaces(std::int32_t u, std::int32_t v, const Vec3& p);
  void place(std::int32_t v, const Vec3& p);

  TetComplex& m_Complex;
  CurveChains* const m_Curves;
  SizingFunction m_Length;
  Envelope m_Envelope;
  CollapseTopology m_Topology;
  const double m_TriangleWeight, m_Rigidity;
  const bool m_KeepsFolds;
  OperationCounts m_Counts;
  Star m_Star;                          ///< of the vertex worked on
  std::array<Star, 8> m_Targets;        ///< of the vertices it may be merged into, which are tried by turns
  std::size_t m_NextTarget = 0;         ///< entry of m_Targets replaced next, modulo the size
  std::array<Star, 16> m_Recent;        ///< of vertices worked on before, many of which soon are again
  std::size_t m_NextRecent = 0;         ///< entry of m_Recent replaced next, modulo the size
  std::int32_t m_NeighboursVertex = -1; ///< the vertex that m_Neighbours are of; -1: none
  std::vector<Neighbour> m_Neighbours;
  struct Seen
  {
    std::uint32_t search = 0; ///< number of the last search that met the vertex
    std::int32_t at = 0;      ///< index in m_Neighbours; set by neighbours() only
    Label label = 0;          ///< of the first tetrahedron at the edge; set by neighbours() only
  };
  std::vector<Seen> m_Seen; ///< per vertex
  std::uint32_t m_Search = 0;
  /// The vertex whose collapses onto m_Refused would change a tissue's topology, or have no closed ring; -1: none.
  std::int32_t m_RefusedVertex = -1;
  std::vector<std::int32_t> m_Refused;
  /// The ring of the edge worked on: its tetrahedra, and its vertices, of which m_RingVertices[i] lies between
  /// tetrahedra i - 1 and i. On a sheet (m_RingIsOnSheet), the labels change at 0 and at m_RingEnd, and the vertices
  /// there lie on the sheet; else m_RingEnd is the last vertex.
  std::vector<std::int32_t> m_Ring, m_RingVertices;
  int m_RingEnd = 0;
  bool m_RingIsOnSheet = false;
  std::vector<TetComplex::Tet> m_Fresh; ///< the tetrahedra that replace the ring
  std::vector<Label> m_FreshLabels;
};

} // namespace surgicalmesher
