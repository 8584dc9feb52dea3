// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The envelope of the interface: how far it may lie from the boundary samples, and they from it.
///
/// Every sample (TetComplex.h) asks for an interface face of its pair of labels within its tolerance. An operation
/// names the faces that it takes away (addOldFace, or sheet() for a vertex that moves) and those that take their place
/// (addNewFace); the envelope hands every sample of the old faces to the nearest new one of its labels, says whether
/// that may be, and after the change of the complex attaches the samples there. This is the bound on the one-sided
/// Hausdorff distance from the map's boundary to the mesh, for every pair of labels; vertexDistance bounds the other
/// side.

#include "FeatureSides.h"

#include <algorithm>

namespace surgicalmesher
{

struct EnvelopeBounds
{
  /// Bound on the root mean square distance of the samples that an operation hands on to their faces, in tolerances,
  /// unless it does not grow. Single samples may use up their tolerance where the others lie close.
  double rmsLimit = 0.5;
  /// Factor on the tolerance of every sample.
  double toleranceFactor = 1;
  /// Factor on the quality of triangles between labels: 1 makes their angles count like dihedral ones; 0 leaves them
  /// out.
  double triangleWeight = 0;
  /// Bound, in tolerances, on the distance from an interface vertex, and from the middle of an interface edge longer
  /// than its target, to the nearest sample of its faces, unless it does not grow; and no vertex inside a label comes
  /// to lie on the interface beyond it. Prevents spikes: they have good angles, and their sides pass the samples at
  /// their foot however long they grow. 0: no bound.
  double vertexDistance = 0;
  /// Bound, in tolerances, on the distance of an interface vertex that moves from the plane of the nearest sample of its
  /// faces, if that has a normal and the boundary is plane between them, unless it does not grow. vertexDistance leaves a
  /// vertex between samples as far off as these are apart. 0: no bound.
  double planeDistance = 0;
  /// mm; vertexDistance is this at least: between samples so far apart a vertex of the smoothest surface is that far from
  /// the nearest.
  double sampleSpacing = 0;
  /// Factor, at least 1, on the tolerance to faces of its own pair for a sample whose two labels others have come
  /// between, if it has the boundary of either label within tolerance.
  double separatedFactor = 1;
  /// degrees; sharp edges, corners and flat faces of the interface stay what they are (FeatureSides). 0: there are none.
  double featureAngle = 0;
  /// No vertex moves to where more of the interface is folded around it (foldedMore).
  bool keepsFolds = false;
  /// The interface stays exactly as it is, its vertices, edges and triangles; the other bounds are then not asked.
  bool interfaceHeld = false;
};

class Envelope
{
public:
  Envelope(TetComplex& complex, const EnvelopeBounds& bounds);

  bool isHeld() const { return m_Held; }

  /// Whether a place that far from its nearest sample is beyond so many of its tolerances, and the spacing of samples.
  bool isBeyond(const SheetSample& nearest, double squaredDistance, double tolerances) const
  {
    return squaredDistance > std::max(tolerances * tolerances * nearest.squaredTolerance(), m_SquaredSpacing);
  }

  /// Of p from the boundary by the sample nearest to it, mm^2: from the sample's plane, if it has a normal and the
  /// boundary is plane between them, else from the sample.
  double squaredDistanceBy(const SheetSample& nearest, const Vec3& p) const;

  // --- faces that an operation takes away, and faces that take their place
  void clear();
  /// Takes note of the interface face (t, face), once.
  void addOldFace(std::int32_t t, int face);
  /// The same for one that is known not to have been noted.
  void addOldFace(const SheetFace& face) { m_Old.faces.push_back(face); }
  /// A face abc between two labels. `tet`, `face`: a tetrahedron that will have it; -1: attach() looks for one.
  /// `changes` false: it stays as it is, and may take other samples.
  void addNewFace(const Vec3& a, const Vec3& b, const Vec3& c, const std::array<std::int32_t, 3>& ids, LabelPair labels,
                  std::int32_t tet = -1, int face = 0, bool changes = true);
  bool hasNewFaces() const { return !m_NewFaces.empty(); }

  /// Whether the new triangles reach that quality.
  bool trianglesReach(double minimumQuality) const;
  /// Whether the new faces leave flat sides flat and sharp edges where they are, if that is asked for.
  bool featuresStay();
  /// Whether every sample of the old faces has a new face within its tolerance, or no farther than its face is now, and
  /// their mean square is within the limit or does not grow.
  bool samplesStay();
  /// Whether the middle of an edge at v, longer than its target, would lie farther than vertexDistance from the samples
  /// of the old faces, and farther than with v at `from`.
  bool spansGap(std::int32_t v, const Vec3& from) const { return spansGap(m_Old, v, from); }
  /// Whether a corner of t, inside a label so far, would lie on the interface beyond vertexDistance.
  bool laysBare(std::int32_t t) const;
  /// After samplesStay(): whether at most `mostLeft` would be left of the squared distances, in units of the tolerance,
  /// of the samples to the faces and of the faces to the samples. A face off all samples has none of its own to say so.
  bool comesNearer(double mostLeft);

  /// Takes the samples off the old faces; before the complex changes.
  void detach();
  /// Hands them to the new faces, those without a tetrahedron found among `around`; after the complex has changed.
  void attach(const std::vector<std::int32_t>& around = {});

  // --- moves of one vertex
  bool holdsSheetOf(std::int32_t v) const { return m_SheetVertex == v; }
  /// The interface faces at v, `faces`, and their samples; kept while only v moves.
  const Sheet& gatherSheetOf(std::int32_t v, const std::vector<TetComplex::FaceOfTet>& faces);
  const Sheet& sheet() const { return m_Sheet; }
  void forgetSheet() { m_SheetVertex = -1; }
  bool watchesFeatures() const { return m_Sides.areWatched(); }
  /// The part of a step of the sheet's vertex that leaves features as they are.
  Vec3 alongFeatures(const Vec3& step);
  /// Whether features, samplesStay() and vertexDistance allow the vertex of the sheet at p.
  bool allowsSheetAt(const Vec3& p);
  /// After that: hands the samples of the sheet to the faces as they are with the vertex there, and puts them in the
  /// order of these.
  void handOn();
  /// Hands the samples of the sheet to the nearest of its faces as they are with the vertex at p, however far.
  void handToNearest(const Vec3& p);
  /// Whether a sample of the sheet is beyond its tolerance.
  bool hasSampleBeyondTolerance();

  /// A tolerance, mm, that no sample's is less than from now on; 0: their own.
  void setLeastTolerance(double mm) { m_LeastTolerance2 = mm * mm; }
  /// Everything may be as it comes out, for as long as this lives: to take back what was so before.
  class Lifted
  {
  public:
    explicit Lifted(Envelope& envelope);
    ~Lifted();
    Lifted(const Lifted&) = delete;
    Lifted& operator=(const Lifted&) = delete;

  private:
    Envelope& m_Envelope;
    const double m_LeastTolerance2, m_MeanSquareLimit, m_VertexDistance;
    const FeatureSides m_Sides;
  };

private:
  struct Face
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

  bool featuresStay(const Sheet& sheet);
  double squaredDistanceNow(const Sheet& sheet, const SheetSample& sample);
  bool findNearestFace(const Sheet& sheet, SheetSample& sample) const;
  double squaredDistanceToBoth(const Sheet& sheet, const SheetSample& sample) const;
  bool isNearBoth(const Sheet& sheet, const SheetSample& sample, double most2) const;
  bool sampleStays(const Sheet& sheet, SheetSample& sample);
  bool meanSquareStays(const Sheet& sheet);
  bool sheetStays();
  bool growsSpike(const Vec3& p) const;
  bool leavesPlane(const SheetSample& sample, const Vec3& p) const;
  bool spansGap(const Sheet& sheet, std::int32_t v, const Vec3& from) const;
  void addMovedFaces(const Vec3& p);
  void detach(const Sheet& sheet);
  void attach(const std::vector<SheetSample>& samples, const std::vector<TetComplex::FaceOfTet>& holders);

  TetComplex& m_Complex;
  const bool m_Held;
  double m_MeanSquareLimit;
  const double m_SquaredToleranceFactor, m_TriangleWeight;
  double m_VertexDistance;
  const double m_PlaneDistance, m_SquaredSpacing, m_SquaredSeparatedFactor;
  double m_LeastTolerance2 = 0;
  FeatureSides m_Sides; ///< of the faces asked about last
  Sheet m_Old;          ///< the faces that an operation takes away
  std::vector<Face> m_NewFaces;
  std::vector<TetComplex::FaceOfTet> m_Holders; ///< of the new faces
  std::int32_t m_SheetVertex = -1;              ///< whose m_Sheet is; -1: nobody's
  Sheet m_Sheet;
  std::size_t m_LastRefusing = 0; ///< of its samples, or of those of another one before
};

} // namespace surgicalmesher
