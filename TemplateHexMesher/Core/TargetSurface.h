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
  Eigen::Vector3d weights = Eigen::Vector3d::Zero(); ///< barycentric, of the triangle's corners
  std::int32_t triangle = -1;                        ///< -1: there is none
  bool onBorder = false;                             ///< on an edge of one triangle alone
};

/// The same surface with points at one place made one, as they are not in STL files, and without triangles of no area.
TriangleSurface withoutDuplicates(const TriangleSurface& surface);

/// Normals of triangles' corners, the area-weighted mean over the triangles around a point that lie within
/// `creaseDegrees` of this one: what changes faster is a crease. A column per corner, three for each triangle.
Points cornerNormals(const TriangleSurface& surface, double creaseDegrees);

/// Makes triangles that share an edge wind alike wherever only two meet there, each connected part as its first
/// triangle is, and returns the number of the part of each triangle.
std::vector<std::int32_t> windAlike(std::vector<Triangle>& triangles);

/// Edges, as pairs of ids, between two triangles whose normals differ by more than `creaseDegrees`.
std::vector<std::array<std::int32_t, 2>> creasesOf(const TriangleSurface& surface, double creaseDegrees);

constexpr double kCreaseDegrees = 50;

class TargetSurface
{
public:
  /// Takes at least one triangle. Its points keep their ids; neighbours are made to wind alike.
  explicit TargetSurface(const TriangleSurface& surface);

  /// Turns each connected part to agree with the template: with most of the normals of `points` (unit length) that are
  /// nearest to it and within `reach`. Parts that attract none are turned by the sign of their enclosed volume.
  void orientLike(const Points& points, const Points& normals, double reach);

  /// Of the points of each triangle that are closest to p, the one q with normal m that minimises
  /// |p - q|^2 + normalScale^2 |n - m|^2. `normalScale` in mm; 0 gives the closest point.
  SurfacePoint closest(const Eigen::Vector3d& point, const Eigen::Vector3d& normal, double normalScale) const;

  /// The closest point of the creases within `reach`; weights and onBorder are unset and `normal` is the crease's
  /// direction.
  SurfacePoint closestOnCrease(const Eigen::Vector3d& point, double reach) const;

  const TriangleSurface& surface() const { return m_Surface; }
  /// One column per corner, as cornerNormals gives them.
  const Points& normals() const { return m_Normals; }

private:
  class Tree;
  SurfacePoint onTriangle(std::int32_t triangle, const Eigen::Vector3d& point) const;
  void buildCreases();

  TriangleSurface m_Surface;
  std::vector<std::int32_t> m_Parts;          ///< per triangle
  std::vector<std::array<bool, 3>> m_Borders; ///< per triangle, of the edge opposite to each corner
  Points m_Normals;
  std::shared_ptr<const Tree> m_Tree;
  vtkSmartPointer<vtkPolyData> m_Creases; ///< none: no creases
  vtkSmartPointer<vtkStaticCellLocator> m_CreaseLocator;
};

} // namespace surgicalmesher
