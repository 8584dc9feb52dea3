// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The envelope of the interface: bounds on the distances between the interface and the boundary samples, both ways.
///
/// Every sample (TetComplex.h) requires an interface face of its pair of labels within its tolerance. An operation
/// names the faces that it removes (addOldFace, or sheet() for a vertex that moves) and the faces that replace them
/// (addNewFace). The envelope assigns every sample of the old faces to the nearest new face of its labels, says whether
/// the distances are allowed, and attaches the samples to the new faces after the change of the complex. This bounds
/// the one-sided Hausdorff distance from the map's boundary to the mesh, for every pair of labels; vertexDistance
/// bounds the other side.

#include "FeatureSides.h"

#include <algorithm>

namespace surgicalmesher
{

struct EnvelopeBounds
{
  /// Bound, in tolerances, on the root mean square distance of an operation's samples to their new faces; a larger one
  /// is allowed if it does not grow. Single samples may use up their tolerance where the others lie close.
  double rmsLimit = 0.5;
  /// Factor on the tolerance of every sample.
  double toleranceFactor = 1;
  /// Factor on the quality of the interface triangles: 1 makes their angles count like dihedral angles, 0 ignores them.
  double triangleWeight = 0;
  /// Bound, in tolerances, on the distance to the nearest sample of its faces, for an interface vertex that moves and
  /// for the middle of an interface edge that a move or a collapse leaves longer than its target; a larger distance is
  /// allowed if it does not grow. Relabelling puts no vertex from inside a label on the interface beyond the bound.
  /// Prevents spikes, which pass the tests of angles and samples: their angles are good, and their sides stay near to
  /// the samples at their foot, however long they grow. 0: no bound.
  double vertexDistance = 0;
  /// Bound, in tolerances, on the distance of an interface vertex that moves from the plane of the nearest sample of
  /// its faces, if that sample has a normal and the boundary is nearly plane as far as the vertex; a larger one is
  /// allowed if it does not grow. Needed because vertexDistance lets a vertex between samples lie as far off as the
  /// samples are apart. 0: no bound; without effect if vertexDistance is 0.
  double planeDistance = 0;
  /// Spacing of the samples, mm; the least value of the bound vertexDistance, because a vertex of a perfectly smooth
  /// surface may lie that far from the nearest sample.
  double sampleSpacing = 0;
  /// Factor, at least 1, on the tolerance of a sample whose two labels have been separated by other labels. It applies
  /// to faces of the sample's own pair, if the boundaries of both of its labels are within the plain tolerance.
  double separatedFactor = 1;
  /// Angle, degrees, above which edges of the interface are sharp. Sharp edges, corners and flat faces are kept
  /// (FeatureSides). 0: no features.
  double featureAngle = 0;
  /// Refuses moves of a vertex that increase the folded length of the interface around it (foldedMore).
  bool keepsFolds = false;
  /// Keeps the vertices, edges and triangles of the interface exactly as they are; no other bound is tested then.
  bool interfaceHeld = false;
};

class Envelope
{
public:
  Envelope(TetComplex& complex, const EnvelopeBounds& bounds);

  bool isHeld() const { return m_Held; }

  /// Whether a distance (squared, mm^2) to the sample `nearest` exceeds both `tolerances` tolerances of the sample and
  /// the spacing of samples.
  bool isBeyond(const SheetSample& nearest, double squaredDistance, double tolerances) const
  {
    return squaredDistance > std::max(tolerances * tolerances * nearest.squaredTolerance(), m_SquaredSpacing);
  }

  /// Returns the squared distance, mm^2, of p from the boundary as the nearest sample tells it: from the plane of the
  /// sample, if it has a normal and the boundary is nearly plane as far as p, else from the sample.
  double squaredDistanceBy(const SheetSample& nearest, const Vec3& p) const;

  // --- faces that an operation removes, and faces that replace them
  void clear();
  /// Adds the interface face opposite vertex `face` of t to the old faces, unless it is one already.
  void addOldFace(std::int32_t t, int face);
  /// Adds a face that is known not to be among the old faces.
  void addOldFace(const SheetFace& face) { m_Old.faces.push_back(face); }
  /// Adds the new face abc with vertices `ids` between two labels. It lies opposite vertex `face` of tetrahedron `tet`
  /// after the change of the complex; tet -1: attach() looks for it. `changes` false: the face stays as it is, but may
  /// receive samples.
  void addNewFace(const Vec3& a, const Vec3& b, const Vec3& c, const std::array<std::int32_t, 3>& ids, LabelPair labels,
                  std::int32_t tet = -1, int face = 0, bool changes = true);
  bool hasNewFaces() const { return !m_NewFaces.empty(); }

  /// Whether all new faces that change reach `minimumQuality`, after multiplication by triangleWeight.
  bool trianglesReach(double minimumQuality) const;
  /// Whether the new faces keep flat sides flat and sharp edges in place; true without a feature angle.
  bool featuresStay();
  /// Assigns the samples of the old faces to the new ones. Returns whether every sample has a new face within its
  /// tolerance or no farther than its present face, and the mean square of the distances is within its limit or does
  /// not grow. For labels that other labels separate, see separatedFactor.
  bool samplesStay();
  /// After samplesStay(): whether the middle of a new edge at v that is longer than its target lies farther than
  /// vertexDistance from the samples of the old faces, and farther than with v at `from`.
  bool spansGap(std::int32_t v, const Vec3& from) const { return spansGap(m_Old, v, from); }
  /// After samplesStay(): whether a vertex of t that is inside a label now would come to lie on the interface farther
  /// than vertexDistance from the samples of the old faces.
  bool laysBare(std::int32_t t) const;
  /// After samplesStay(): whether the sum of the squared distances, in units of the tolerance, falls below the share
  /// `mostLeft` of its present value. The distances are those of the samples to the faces and of the faces to the
  /// samples; the latter, because a face far from all samples holds none that would show it.
  bool comesNearer(double mostLeft);

  /// Removes the samples from the old faces. Call before the complex changes.
  void detach();
  /// Attaches the samples to their new faces. Call after the complex has changed. Faces added without a tetrahedron are
  /// looked for among the tetrahedra `around`.
  void attach(const std::vector<std::int32_t>& around = {});

  // --- moves of one vertex
  bool holdsSheetOf(std::int32_t v) const { return m_SheetVertex == v; }
  /// Gathers the interface faces at v, `faces`, and their samples; valid while only v moves.
  const Sheet& gatherSheetOf(std::int32_t v, const std::vector<TetComplex::FaceOfTet>& faces);
  const Sheet& sheet() const { return m_Sheet; }
  void forgetSheet() { m_SheetVertex = -1; }
  bool watchesFeatures() const { return m_Sides.areWatched(); }
  /// Returns the part of a step of the sheet's vertex that preserves the features.
  Vec3 alongFeatures(const Vec3& step);
  /// Whether the bounds on features, samples, vertices and long edges allow the vertex of the sheet at p. Assigns the
  /// samples to the faces with the vertex at p.
  bool allowsSheetAt(const Vec3& p);
  /// After allowsSheetAt() has returned true: attaches the samples of the sheet to the faces assigned, and sorts them
  /// by face.
  void handOn();
  /// Attaches each sample of the sheet to the nearest of its faces with the vertex at p, at any distance.
  void handToNearest(const Vec3& p);
  bool hasSampleBeyondTolerance(); ///< of the sheet

  /// Sets a lower bound, mm, on the tolerances of all samples from now on; 0: none.
  void setLeastTolerance(double mm) { m_LeastTolerance2 = mm * mm; }
  /// Lifts the bounds on distances and features during its lifetime, for undoing an operation.
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
    std::int32_t tet;              ///< tetrahedron of the face, as in addNewFace(); -1: not known yet
    int face;                      ///< opposite this vertex of tet
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
  FeatureSides m_Sides; ///< of the faces tested last
  Sheet m_Old;          ///< the faces that an operation removes
  std::vector<Face> m_NewFaces;
  std::vector<TetComplex::FaceOfTet> m_Holders; ///< of the new faces
  std::int32_t m_SheetVertex = -1;              ///< the vertex that m_Sheet is at; -1: none
  Sheet m_Sheet;
  std::size_t m_LastRefusing = 0; ///< index of the sample that refused last, in m_Sheet or in an earlier sheet
};

} // namespace surgicalmesher
