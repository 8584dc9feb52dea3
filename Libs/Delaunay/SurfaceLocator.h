// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where points lie with respect to a labelled surface.

#include "TetMesh.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

namespace surgicalmesher
{

/// Safe to ask from several threads. Approximate arithmetic is good enough: a wrong answer costs a point, nothing else.
/// Keeps a reference to the surface.
class SurfaceLocator
{
public:
  explicit SurfaceLocator(const SurfaceComplex& surface);

  struct Answer
  {
    double distance; ///< to the surface, mm
    bool inside;     ///< of some tissue
  };

  Answer ask(const Vec3& p) const;

private:
  using Kernel = CGAL::Simple_cartesian<double>;
  using Triangles = std::vector<Kernel::Triangle_3>;
  using Iterator = Triangles::const_iterator;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Iterator>>>;

  Label labelTowards(const Vec3& p, Iterator closest) const;

  const SurfaceComplex& m_Surface;
  Triangles m_Triangles;
  Tree m_Tree;
};

} // namespace surgicalmesher
