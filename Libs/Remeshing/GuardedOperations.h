// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Edge collapse, vertex move, edge removal (flip), edge split and relabelling on a TetComplex, one file each, with
/// every guard that keeps the complex's promises: positive volumes and a least quality, the topology of every tissue,
/// the envelope of the interface, the curves along edges, the locks of a block's border. On the dual simplex mesh, collapse, split and flip of
/// interface edges are Delingette's Eulerian operators T1, T2 and T7 (Audette et al. 2007); done on the tetrahedra of
/// both sides they can neither tear nor cross.
///
/// An operation that returns false has changed nothing. Stars, measures and samples are kept from one to the next:
/// whoever changes the complex by other means goes on with new GuardedOperations.
///
/// *Quality* is worstSine2 (TetQuality.h); tetrahedra of label 0 are thrown away in the end and are let off with a
/// smaller one: theirs is multiplied by backgroundLeniency. Of the triangles between labels it is smallestSine2 times
/// EnvelopeBounds::triangleWeight.

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
  long t1 = 0, t2 = 0, t7 = 0; ///< collapses, splits and flips of edges of the interface, among those above

  OperationCounts& operator+=(const OperationCounts& more);
};

/// The quality from which on something counts as better than q.
inline double clearlyBetter(double q) { return q * 1.0001 + 1e-9; }

class GuardedOperations
{
public:
  /// `rigidity`: see quadricOf. `curves`, if given, along edges of the complex, stay so.
  GuardedOperations(TetComplex& complex, SizingFunction length, const EnvelopeBounds& bounds = {}, double rigidity = 0,
                    CurveChains* curves = nullptr);

  // --- what is measured, and where
  /// Of t, and of its triangles between labels.
  double quality(std::int32_t t) const;

  /// The worst quality of `tetrahedra`.
  double worstQuality(const std::vector<std::int32_t>& tetrahedra) const;

  /// Tetrahedra at v; kept until the next operation that changes anything, so asking again costs nothing.
  const std::vector<std::int32_t>& star(std::int32_t v) { return starOf(v, m_Star); }

  /// The same, kept apart, for the vertices that another one may go into.
  const std::vector<std::int32_t>& starOfTarget(std::int32_t v)
  {
    return v == m_Star.vertex ? m_Star.tets : target(v).tets;
  }

  /// The interface's faces at v; kept likewise.
  const std::vector<TetComplex::FaceOfTet>& interfaceFaces(std::int32_t v) { return interfaceFacesOf(v, m_Star); }
  const std::vector<TetComplex::FaceOfTet>& interfaceFacesOfTarget(std::int32_t v)
  {
    return interfaceFacesOf(v, v == m_Star.vertex ? m_Star : target(v));
  }

  struct Neighbour
  {
    std::int32_t vertex;
    bool alongInterface; ///< tetrahedra of different labels at the edge
  };
  /// The ends of the edges at v; kept likewise.
  const std::vector<Neighbour>& neighbours(std::int32_t v);

  /// The interface faces at v and their samples; kept likewise, and while only v moves.
  const Sheet& sheet(std::int32_t v)
  {
    return m_Envelope.holdsSheetOf(v) ? m_Envelope.sheet() : m_Envelope.gatherSheetOf(v, interfaceFaces(v));
  }

  bool watchesFeatures() const { return m_Envelope.watchesFeatures(); }

  /// The part of a step of v that leaves flat faces flat and sharp edges where they are, if that is asked for.
  Vec3 alongFeatures(std::int32_t v, const Vec3& step)
  {
    if (!m_Envelope.watchesFeatures() || !m_Complex.onInterface[v]) return step;
    sheet(v);
    return m_Envelope.alongFeatures(step);
  }

  /// To measure star(v) and sheet(v) with v anywhere; kept likewise, and while only v moves.
  StarQuality& measured(std::int32_t v) { return measured(v, m_Star); }

  /// The worst quality at v, were it at p, or some value below `atLeast` if it is less than that.
  double qualityAt(std::int32_t v, const Vec3& p, double atLeast) { return measured(v).worst(p, atLeast); }
  double qualityAt(std::int32_t v) { return qualityAt(v, m_Complex.points[v], -1); }

  // --- edge collapse (EdgeCollapse.cxx)
  /// Whether locks and labels let u go into its neighbour v at all, v staying or moving: one of the interface, only
  /// along it and wholly seen; one beside it, only without moving it.
  bool mayCollapse(std::int32_t u, std::int32_t v, bool moves) const;

  /// Whether coarsening may take u away: where there are curves, only beside these, which have cut the tetrahedra there;
  /// the lengths of the others were settled before.
  bool mayCoarsen(std::int32_t u);

  /// The worst quality that merging u into v at p would leave among the changed tetrahedra; some value below `atLeast`
  /// if it is less than that, or if an edge at v would become longer than maximumRatio times the target (one that is
  /// longer may stay, but not grow).
  double qualityAfterCollapse(std::int32_t u, std::int32_t v, const Vec3& p, double atLeast, double maximumRatio);

  /// Merges u into v at p if topology and envelope allow, and the triangles that come to lie between labels: the rest
  /// of collapse(), once the others have been asked.
  bool collapseWithin(std::int32_t u, std::int32_t v, const Vec3& p, double minimumQuality);

  /// Merges u into its neighbour v, which moves to p, if every changed tetrahedron reaches `minimumQuality` and all of
  /// the above allow it.
  bool collapse(std::int32_t u, std::int32_t v, const Vec3& p, double minimumQuality, double maximumRatio);

  // --- vertex move (VertexMove.cxx)
  /// Moves v to p, if every tetrahedron at v reaches `minimumQuality` and the envelope allows it.
  bool move(std::int32_t v, const Vec3& p, double minimumQuality)
  {
    return !m_Complex.locked[v] && qualityAt(v, p, minimumQuality) >= minimumQuality && moveWithin(v, p);
  }

  /// The rest of move(), once locks and quality have been asked.
  bool moveWithin(std::int32_t v, const Vec3& p);

  /// Takes back a move of v from p, the latest first where there were several: nothing is asked of what was so before.
  void moveBack(std::int32_t v, const Vec3& p);

  /// After several moves back: hands samples of v's faces to the nearest of them if some is beyond its tolerance. What
  /// one move has handed on to a face out of another's sight is still there.
  void reassignSamples(std::int32_t v);

  // --- edge removal (EdgeRemoval.cxx)
  /// Replaces the tetrahedra around edge ab by the best ones without it (Klincsek 1980, as Shewchuk uses it); an edge
  /// inside the sheet between two labels becomes the other diagonal of its two triangles. Without `minimumQuality`, all
  /// are to be better than the worst around ab.
  bool removeEdge(std::int32_t a, std::int32_t b, std::int32_t seed, std::optional<double> minimumQuality = {});

  /// The same for the least height of the tissues' tetrahedra, whose worst quality may fall to `goodQuality`.
  bool removeLowEdge(std::int32_t a, std::int32_t b, std::int32_t seed, double goodQuality);

  struct SwapGoal
  {
    double goodQuality;       ///< the worst quality may fall to this
    double usualSine;         ///< of a tetrahedron's worst angle
    double smoothness;        ///< what a radian of bending along an edge of the target length counts, in sines
    double leastGain;         ///< in sines
    bool sparesWhole = false; ///< leave edges alone around which a vertex isWhole()
  };
  /// The same for the sum over the tetrahedra of the sines of their worst angles, over the usual one, and for the
  /// sheet's bending. `refusals`, if given, are asked, and told.
  bool swapEdge(std::int32_t a, std::int32_t b, std::int32_t seed, const SwapGoal& goal,
                SwapRefusals* refusals = nullptr);

  /// Around the edge removed last.
  const std::vector<std::int32_t>& ringVertices() const { return m_RingVertices; }

  // --- edge split (EdgeSplit.cxx)
  /// Splits edge ab at p. Returns the new vertex, nothing if it may not be.
  std::optional<std::int32_t> split(std::int32_t a, std::int32_t b, std::int32_t seed, const Vec3& p,
                                    double minimumQuality);

  /// Takes back the split of an edge at v, which lies there again: v goes into the edge's end a.
  void takeBackSplit(std::int32_t v, std::int32_t a);

  // --- relabelling (Relabel.cxx)
  static constexpr double anyShare = std::numeric_limits<double>::infinity();

  /// Gives t to `label`, which lies beyond one of its faces, if that and its own keep their topology and their manifold
  /// boundaries: t is a simple point of either. With `mostLeft`, only if at most that share of the squared distances
  /// between the surface and its samples, there and back, is left.
  bool relabel(std::int32_t t, Label label, double minimumQuality, double mostLeft = anyShare);

  /// The position of the sample of v's faces that is nearest to v, if there is any.
  std::optional<Vec3> nearestSampleOf(std::int32_t v);

  /// Whether v, between labels, is more than `tolerances` tolerances from all samples of its faces.
  bool isSpike(std::int32_t v, double tolerances);

  TetComplex& complex() { return m_Complex; }
  Envelope& envelope() { return m_Envelope; }
  const OperationCounts& counts() const { return m_Counts; }
  double rigidity() const { return m_Rigidity; }
  /// Takes two relabellings that undid each other out of the counts.
  void uncountRelabels() { m_Counts.relabels -= 2; }

private:
  struct FaceAtEnd
  {
    SheetFace face;
    std::array<std::int32_t, 2> beside; ///< the vertices of its two tetrahedra that it has not
  };
  struct Star
  {
    std::int32_t vertex = -1; ///< -1: nobody's
    std::vector<std::int32_t> tets;
    bool isMeasured = false;
    StarQuality quality;
    std::vector<std::int32_t> ends; ///< of the edges at the vertex; empty until somebody has asked
    bool hasFaces = false, hasFacesAtEnd = false;
    std::vector<TetComplex::FaceOfTet> faces; ///< of the interface at the vertex
    std::vector<FaceAtEnd> facesAtEnd;        ///< the same, with what is beside them
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
  std::array<Star, 8> m_Targets;        ///< of those it may go into, which come by turns
  std::size_t m_NextTarget = 0;         ///< whose place goes to the next
  std::array<Star, 16> m_Recent;        ///< of vertices worked on before, which many are again soon
  std::size_t m_NextRecent = 0;         ///< whose place goes to the next
  std::int32_t m_NeighboursVertex = -1; ///< whose m_Neighbours are; -1: nobody's
  std::vector<Neighbour> m_Neighbours;
  struct Seen
  {
    std::uint32_t search = 0;
    std::int32_t at = 0; ///< in m_Neighbours
    Label label = 0;
  };
  std::vector<Seen> m_Seen; ///< per vertex, by the search of that number (label and place: of neighbours() alone)
  std::uint32_t m_Search = 0;
  std::int32_t m_RefusedVertex = -1; ///< whose collapses onto m_Refused would change a tissue's topology; -1: nobody's
  std::vector<std::int32_t> m_Refused;
  /// Around the edge worked on: tetrahedra and the vertices between them, beginning at a change of labels if there is
  /// one; the first label, or all of the polygon, ends at m_RingEnd.
  std::vector<std::int32_t> m_Ring, m_RingVertices;
  int m_RingEnd = 0;
  bool m_RingIsOnSheet = false;
  std::vector<TetComplex::Tet> m_Fresh; ///< to take the ring's place
  std::vector<Label> m_FreshLabels;
};

} // namespace surgicalmesher
