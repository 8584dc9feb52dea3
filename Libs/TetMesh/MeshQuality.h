// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Quality of tetrahedral meshes for finite elements: measures of one tetrahedron, and their distributions over the
/// mesh, its tissues and its sub-meshes.

#include "TetMesh.h"

#include <functional>
#include <map>
#include <string>

namespace surgicalmesher
{

/// The six dihedral angles in degrees, in the order of kEdgeCorners. Regular tetrahedron: 70.53; canonical: 4 x 60, 2 x
/// 90.
std::array<double, 6> dihedralAngles(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Three times the ratio of the inradius to the circumradius, in (0, 1]; 0 or less if flat or inverted.
/// Regular: 1; canonical: sqrt(0.9).
double radiusRatio(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// sqrt(2) times the Jacobian over the largest product of the three edge lengths at a corner, in (0, 1] (Knupp, as in
/// Verdict). Regular: 1.
double scaledJacobian(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// The least of the four heights; 0 if flat.
double leastHeight(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Figures of a set of values; all zero if there are no values.
struct Distribution
{
  std::size_t count = 0;
  double minimum = 0, percentile1 = 0, percentile5 = 0, median = 0, percentile95 = 0, percentile99 = 0, maximum = 0;
  double mean = 0;
};

Distribution distributionOf(std::vector<double> values);

/// Counts of values in equal bins from `low` to `high`; values beyond are counted in the first and last bin.
struct Histogram
{
  double low = 0, high = 1;
  std::vector<std::size_t> counts;
};

/// Some of the tetrahedra of a mesh: all, one tissue's or one sub-mesh's.
struct QualityGroup
{
  std::size_t tetrahedra = 0;
  std::size_t points = 0;
  double volume = 0;            ///< mm^3
  Distribution dihedral;        ///< degrees, six per tetrahedron
  Distribution minimumDihedral; ///< degrees, of each tetrahedron
  Distribution radiusRatio;
  Distribution scaledJacobian;
  Distribution tetrahedronVolume; ///< mm^3
  Distribution height;            ///< mm, the least of each tetrahedron
  Distribution edgeOverTarget;    ///< each edge once; empty if there is no target
  double edgesNearTarget = 0;     ///< share of edges between 0.7 and 1.4 times their target
  Distribution valence;           ///< tetrahedra at each point whose tetrahedra are all of the group and of one tissue
};

struct MeshQuality
{
  QualityGroup whole;
  std::map<Label, QualityGroup> tissues;
  std::map<std::int32_t, QualityGroup> subMeshes;
  // The paper's three histograms (Audette et al. 2007, figure 10), over the whole mesh.
  Histogram dihedral; ///< degrees
  Histogram edgeOverTarget;
  Histogram valence;         ///< tetrahedra per inner point, one bin each
  Histogram boundaryValence; ///< tetrahedra of one tissue per point on its boundary: points count once for each tissue
};

/// worstSine2() of TetQuality.h for tetrahedron `t`.
double worstSine2(const TetMesh& mesh, std::size_t t);

/// How many tetrahedra of tissues (label not 0) have a dihedral angle below `degrees` or above 180 minus it.
std::size_t countBelow(const TetMesh& mesh, double degrees);

/// Volume of each tissue (label not 0), mm^3.
std::map<Label, double> tissueVolumes(const TetMesh& mesh);

/// Assesses the tetrahedra, including those of label 0. `subMesh` has one entry per tetrahedron, or is empty.
/// `edgeLength` is L(x) in mm, evaluated at the middle of each edge, or empty.
MeshQuality assessQuality(const TetMesh& mesh, const std::vector<std::int32_t>& subMesh,
                          const std::function<double(const Vec3&)>& edgeLength);
/// The same with L (mm) at each point; the target of an edge is the mean over its ends. Empty without a target.
MeshQuality assessQualityFromPoints(const TetMesh& mesh, const std::vector<std::int32_t>& subMesh,
                                    const std::vector<double>& edgeLengths);

/// One JSON object: whole, tissues, subMeshes, histograms.
std::string qualityJSON(const MeshQuality& quality, const TissueTable& tissues);

} // namespace surgicalmesher
