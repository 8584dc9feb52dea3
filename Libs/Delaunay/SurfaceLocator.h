// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Where points lie with respect to a labelled surface.

#include "TetMesh.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <optional>

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

  Answer ask(const Vec3& p) const { return ask(p, {}); }

private:
  friend class SurfaceWalk;
  using Kernel = CGAL::Simple_cartesian<double>;
  using Triangles = std::vector<Kernel::Triangle_3>;
  using Iterator = Triangles::const_iterator;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Iterator>>>;

  /// `inside` where it is known.
  Answer ask(const Vec3& p, std::optional<bool> inside) const;
  Label labelTowards(const Vec3& p, Iterator closest) const;

  const SurfaceComplex& m_Surface;
  Triangles m_Triangles;
  Tree m_Tree;
};

/// Asks about points one after the other, each near the one before: within that one's distance there is no surface
/// between them. Keeps a reference to the locator.
class SurfaceWalk
{
public:
  explicit SurfaceWalk(const SurfaceLocator& locator) : m_Locator(locator) {}

  /// What the last point that was asked about tells of p: its side, and a distance that it has at least; nothing where
  /// p is too far from it.
  std::optional<SurfaceLocator::Answer> known(const Vec3& p) const;

  SurfaceLocator::Answer ask(const Vec3& p);

private:
  const SurfaceLocator& m_Locator;
  Vec3 m_Last;
  SurfaceLocator::Answer m_Answer{ 0, false };
};

} // namespace surgicalmesher
