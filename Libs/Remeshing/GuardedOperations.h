#pragma once
/// Edge collapse, vertex move, edge removal (flip), edge split and relabelling on a TetComplex, each with every guard that
/// keeps the complex's promises. On the dual simplex mesh, collapse, split and flip of interface edges are Delingette's
/// Eulerian operators T1, T2 and T7 (Audette et al. 2007); done on the tetrahedra of both sides they can neither tear nor
/// cross.
///
/// An operation that returns false has changed nothing. Stars, measures and samples are kept from one to the next: whoever
/// changes the complex by other means goes on with new GuardedOperations.
///
/// *Quality* is worstSine2 (TetQuality.h); tetrahedra of label 0 are thrown away in the end and are let off with a smaller
/// one: theirs is multiplied by backgroundLeniency. Of the triangles between labels it is smallestSine2 times a weight: with 1,
/// their angles count like dihedral ones.

#include "BoundarySamples.h"
#include "SizingFunction.h"
#include "StarQuality.h"
#include "TetComplex.h"

#include <limits>
#include <optional>
#include <vector>

namespace surgicalmesher
{

struct OperationCounts
{
  long collapses = 0, moves = 0, flips = 0, splits = 0, relabels = 0;
};

/// What operations keep of the samples that they touch, and how much they ask of triangles between labels.
struct Envelope
{
  /// Of the root mean square distance, in units of the tolerance; nor does an operation raise one beyond it. Single points may
  /// use up their tolerance where the others lie close.
  double rmsLimit = 0.5;
  double toleranceFactor = 1;          ///< tolerances count so many times
  double triangleWeight = 0; ///< of triangles between labels, see above; 0: they have no quality
  /// In tolerances: a vertex between labels moves no farther than this from the nearest samples of its faces, nor does the
  /// middle of an edge longer than its target, or no farther than it is; and no vertex inside a label is laid bare out there.
  /// A spike gives good angles, and its sides pass the samples at its foot however long it grows. 0: no bound.
  double vertexDistance = 0;
  /// In tolerances, at least 1: where others have come between two labels, samples may be this far from their faces, if it
  /// has the boundary of either within tolerance.
  double separatedFactor = 1;
};

class GuardedOperations
{
public:
  GuardedOperations(TetComplex& complex, SizingFunction scale, const Envelope& guards = {});

  /// Of t, and of its triangles between labels.
  double quality(std::int32_t t) const;

  /// The worst quality of `tetrahedra`.
  double worstQuality(const std::vector<std::int32_t>& tetrahedra) const;

  /// Tetrahedra at v; kept until the next operation that changes anything, so asking again costs nothing.
  const std::vector<std::int32_t>& star(std::int32_t v) { return starOf(v, m_Star); }

  /// The same, kept apart, for the vertex that another one may go into.
  const std::vector<std::int32_t>& starOfTarget(std::int32_t v)
  {
    return v == m_Star.vertex ? m_Star.tets : starOf(v, m_StarOfV);
  }

  struct Neighbour
  {
    std::int32_t vertex;
    bool alongInterface; ///< tetrahedra of different labels at the edge
  };
  /// The ends of the edges at v; kept likewise.
  const std::vector<Neighbour>& neighbours(std::int32_t v);

  /// The interface faces at v and their samples; kept likewise, and while only v moves.
  const Sheet& sheet(std::int32_t v);

  /// To measure star(v) and sheet(v) with v anywhere; kept likewise, and while only v moves.
  StarQuality& measured(std::int32_t v) { return measured(v, m_Star); }

  /// The worst quality at v, were it at p, or some value below `atLeast` if it is less than that.
  double qualityAt(std::int32_t v, const Vec3& p, double atLeast) { return measured(v).worst(p, atLeast); }
  double qualityAt(std::int32_t v) { return qualityAt(v, m_Complex.points[v], -1); }

  /// Whether locks and labels let u go into its neighbour v at all, v staying or moving: one of the interface, only along it
  /// and wholly seen; one beside it, only without moving it.
  bool mayCollapse(std::int32_t u, std::int32_t v, bool moves) const;

  /// The worst quality that merging u into v at p would leave among the changed tetrahedra; some value below `atLeast` if it
  /// is less than that, or if an edge at v would become longer than maximumRatio times the target (one that is longer
  /// may stay, but not grow).
  double qualityAfterCollapse(std::int32_t u, std::int32_t v, const Vec3& p, double atLeast, double maximumRatio);

  /// Merges u into v at p if topology and samples allow, and the triangles that come to lie between labels: the rest of
  /// collapse(), once the others have been asked.
  bool collapseWithin(std::int32_t u, std::int32_t v, const Vec3& p, double minimumQuality);

  /// Merges u into its neighbour v, which moves to p, if every changed tetrahedron reaches `minimumQuality` and all of the
  /// above allow it.
  bool collapse(std::int32_t u, std::int32_t v, const Vec3& p, double minimumQuality, double maximumRatio);

  /// Moves v to p, if every tetrahedron at v reaches `minimumQuality` and the samples allows it.
  bool move(std::int32_t v, const Vec3& p, double minimumQuality)
  {
    return !m_Complex.locked[v] && qualityAt(v, p, minimumQuality) >= minimumQuality && moveWithin(v, p);
  }

  /// The rest of move(), once locks and quality have been asked.
  bool moveWithin(std::int32_t v, const Vec3& p);

  /// Takes back a move of v from p, the latest first where there were several: nothing is asked of what was so before.
  void moveBack(std::int32_t v, const Vec3& p);

  /// After several moves back: hands samples of v's faces to the nearest of them if some is beyond its tolerance. What one
  /// move has handed on to a face out of another's sight is still there.
  void bringHome(std::int32_t v);

  /// Replaces the tetrahedra around edge ab by the best ones without it (Klincsek 1980, as Shewchuk uses it); an edge
  /// inside the sheet between two labels becomes the other diagonal of its two triangles.
  bool removeEdge(std::int32_t a, std::int32_t b, std::int32_t seed, double minimumQuality);

  /// Splits edge ab at p.
  bool split(std::int32_t a, std::int32_t b, std::int32_t seed, const Vec3& p, double minimumQuality);

  /// Takes back the split of an edge at v, which lies there again: v goes into the edge's end a.
  void takeBackSplit(std::int32_t v, std::int32_t a);

  static constexpr double anyShare = std::numeric_limits<double>::infinity();

  /// Gives t to `label`, which lies beyond one of its faces, if that and its own keep their topology and their manifold
  /// boundaries: t is a simple point of either. With `mostLeft`, only if at most that share of the squared distances between
  /// the surface and its samples, there and back, is left.
  bool relabel(std::int32_t t, Label label, double minimumQuality, double mostLeft = anyShare);

  /// From now on samples may be left as far off as this, mm, whatever its tolerance.
  void setLeastTolerance(double distance) { m_LeastTolerance2 = distance * distance; }

  /// The point of the samples of v's faces that is nearest to v, if there is any.
  std::optional<Vec3> nearestSample(std::int32_t v);

  /// Whether v, between labels, is more than `vertexDistance` tolerances from all samples of its faces.
  bool isSpike(std::int32_t v, double vertexDistance);

  TetComplex& complex() { return m_Complex; }
  float scaleAt(const Vec3& p) const { return m_Scale(p); }

  OperationCounts counts;
  std::int32_t lastSplitVertex = -1;

private:
  struct Face ///< an interface face as it would be, and where its samples would go
  {
    std::array<Vec3, 3> corners;
    LabelPair labels;
    std::array<std::int32_t, 3> vertices;
    Vec3 normal;                   ///< unit
    std::array<Vec3, 3> slopes;    ///< gradients of the barycentric coordinates
    std::array<double, 3> heights; ///< squared, over the side opposite each corner
    std::int32_t tet;              ///< that has it as its `face` already; -1: not known yet
    int face;
    bool changes;
  };

  /// One vertex of the ring of an edge uv: as bits, the labels at its edges to u and to v, and those that both ends have at
  /// the edge of the ring after it.
  struct RingLabels
  {
    std::uint32_t atU = 0, atV = 0, atEdge = 0;
  };

  struct Star
  {
    std::int32_t vertex = -1; ///< -1: nobody's
    std::vector<std::int32_t> tets;
    bool isMeasured = false;
    StarQuality quality;
  };

  const std::vector<std::int32_t>& starOf(std::int32_t v, Star& star);
  StarQuality& measured(std::int32_t v, Star& star);
  void changed() { m_Star.vertex = m_StarOfV.vertex = m_NeighboursVertex = m_SheetVertex = m_RefusedVertex = -1; }
  double lenient(std::int32_t t, double q) const { return m_Complex.labels[t] == 0 ? q * backgroundLeniency : q; }
  double lenient(Label label, double q) const { return label == 0 ? q * backgroundLeniency : q; }
  bool keepsLength(std::int32_t end, std::int32_t x, std::int32_t v, const Vec3& p, double maximumRatio) const;
  bool keepsTissues(std::int32_t u, std::int32_t v);
  bool hasDisc(Label label, std::int32_t u, std::int32_t v) const;
  bool meetsLabels(const std::vector<std::int32_t>& star) const;
  bool collapseKeepsSamples(std::int32_t u, std::int32_t v, const Vec3& p);
  bool isSimple(std::int32_t t, Label label);
  void addMovedFaces(std::int32_t v, const Vec3& p);
  void place(std::int32_t v, const Vec3& p);
  void gather(std::int32_t t, int face);
  void addNewFace(const Vec3& a, const Vec3& b, const Vec3& c, const std::array<std::int32_t, 3>& ids, Label x, Label y,
                  std::int32_t tet = -1, int face = 0, bool changes = true);
  bool newFacesAreGood(double minimumQuality) const;
  double squaredDistanceNow(const Sheet& sheet, const SheetSample& point);
  bool nearestFace(const Sheet& sheet, SheetSample& point) const;
  double squaredDistanceToBoth(const Sheet& sheet, const SheetSample& point) const;
  bool pointStays(const Sheet& sheet, SheetSample& point);
  bool meanSquareStays(const Sheet& sheet);
  bool samplesStay(Sheet& sheet);
  bool changedSamplesStay();
  bool laysBare(std::int32_t t) const;
  bool comesNearer(const Sheet& sheet, double mostLeft);
  bool growsSpike(std::int32_t v, const Vec3& p);
  bool spansGap(const Sheet& sheet, std::int32_t v, const Vec3& from) const;
  void detachSamples(const Sheet& sheet);
  void attachSamples(const std::vector<std::int32_t>& around = {});
  void attach(const std::vector<SheetSample>& points, const std::vector<std::pair<std::int32_t, int>>& holders);
  void attachMoved();
  void handToNearest(std::int32_t v, const Vec3& p);
  void clearSamples();
  static bool has(LabelPair pair, Label label) { return (pair & 0xffff) == label || pair >> 16 == label; }
  std::uint32_t bitOf(Label label);
  std::uint32_t lookAround(const std::vector<std::int32_t>& star, std::int32_t other, std::uint32_t RingLabels::*atEnd);
  std::uint32_t closingOver(std::int32_t t, std::int32_t u, std::int32_t v);

  TetComplex& m_Complex;
  SizingFunction m_Scale;
  double m_MeanSquareLimit, m_SquaredToleranceFactor, m_TriangleWeight, m_VertexDistance, m_SquaredSeparatedFactor, m_LeastTolerance2 = 0;
  Star m_Star, m_StarOfV;               ///< of the vertex worked on, and of the one it may go into
  std::int32_t m_NeighboursVertex = -1; ///< whose m_Neighbours are; -1: nobody's
  std::vector<Neighbour> m_Neighbours;
  struct Seen
  {
    std::uint32_t search = 0;
    std::int32_t at = 0; ///< in m_Neighbours
    Label label = 0;
  };
  std::vector<Seen> m_Seen; ///< per vertex, by the search of that number
  std::uint32_t m_Search = 0;
  struct Place
  {
    std::uint32_t search = 0;
    std::int32_t at = 0; ///< in m_RingVertices
  };
  std::vector<Place> m_Places;       ///< likewise
  std::int32_t m_RefusedVertex = -1; ///< whose collapses onto m_Refused would change a tissue's topology; -1: nobody's
  std::vector<std::int32_t> m_Refused;
  std::vector<std::int32_t> m_Ring, m_RingVertices;
  std::int32_t m_SheetVertex = -1; ///< whose m_SheetAt is; -1: nobody's
  Sheet m_SheetAt;
  Sheet m_Changed; ///< the faces that an operation changes
  std::vector<Face> m_NewFaces;
  std::vector<std::pair<std::int32_t, int>> m_Holders; ///< of the new faces
  std::vector<Label> m_LocalLabels;
  std::vector<RingLabels> m_RingLabels;
  bool m_RingLosesLabels = false; ///< whether one may leave vertices of the ring
};

/// Squared distance from p to triangle abc, mm^2.
double squaredDistanceToTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

} // namespace surgicalmesher
