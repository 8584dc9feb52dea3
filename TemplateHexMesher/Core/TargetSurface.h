// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The surface that a template is fitted to: closest points by position and normal, creases, open borders.

#include "ElementMesh.h"

#include <vtkSmartPointer.h>

#include <memory>

class vtkPolyData;
class vtkStaticCellLocator;

namespace surgicalmesher
{

struct SurfacePoint
{
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit length, interpolated where the surface is smooth
  Eigen::Vector3d weights = Eigen::Vector3d::Zero(); ///< barycentric weights of the triangle's corners
  std::int32_t triangle = -1;                        ///< -1: none found
  bool onBorder = false;                             ///< on an edge with a single triangle
};

/// Returns the surface with points of equal position merged, as in STL files they are not, and without degenerate
/// triangles.
TriangleSurface withoutDuplicates(const TriangleSurface& surface);

/// Returns the normals at triangle corners: area-weighted means over the triangles around the point whose normals are
/// within `creaseDegrees` of that of the corner's triangle. A column per corner, three per triangle.
Points cornerNormals(const TriangleSurface& surface, double creaseDegrees);

/// Orients triangles consistently across edges with exactly two triangles, each connected part like its first triangle.
/// Returns the number of its part for each triangle.
std::vector<std::int32_t> windAlike(std::vector<Triangle>& triangles);

/// Returns the edges, as pairs of ids, with exactly two triangles whose normals differ by more than `creaseDegrees`.
std::vector<std::array<std::int32_t, 2>> creasesOf(const TriangleSurface& surface, double creaseDegrees);

constexpr double kCreaseDegrees = 50;

class TargetSurface
{
public:
  /// Takes at least one triangle. Points keep their ids; triangles are oriented consistently.
  explicit TargetSurface(const TriangleSurface& surface);

  /// Orients each connected part like the template: by the sum of agreements with the normals of those `points` (unit
  /// length) that are closest to it and within `reach`. A part without such points is oriented by the sign of its
  /// enclosed volume.
  void orientLike(const Points& points, const Points& normals, double reach);

  /// For the point q closest to p on each triangle, with normal m, returns the q that minimises
  /// p - q|^2 + normalScale^2 |n - m|^2. `normalScale` in mm; 0 gives the closest point of the surface.
  SurfacePoint closest(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, double normalScale) const;

  /// Returns the closest point on a crease within `reach`. `normal` is the direction of the crease, `triangle` the
  /// index of its edge; weights and onBorder are unset.
  SurfacePoint closestOnCrease(const Eigen::Vector3d& point, double reach) const;

  const TriangleSurface& surface() const { return m_Surface; }
  /// One column per corner, as returned by cornerNormals().
  const Points& normals() const { return m_Normals; }

private:
  class Tree;
  SurfacePoint onTriangle(std::int32_t triangle, const Eigen::Vector3d& point) const;
  void buildCreases();

  TriangleSurface m_Surface;
  std::vector<std::int32_t> m_Parts;          ///< per triangle
  std::vector<std::array<bool, 3>> m_Borders; ///< per triangle: whether the edge opposite to each corner is a border
  Points m_Normals;
  std::shared_ptr<const Tree> m_Tree;
  vtkSmartPointer<vtkPolyData> m_Creases; ///< null: no creases
  vtkSmartPointer<vtkStaticCellLocator> m_CreaseLocator;
};

} // namespace surgicalmesher
