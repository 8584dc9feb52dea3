// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Position of points relative to a labelled surface.

#include "TetMesh.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <optional>

namespace surgicalmesher
{

/// Returns the distance of points to the surface and whether they are inside a tissue. Thread-safe. Approximate
/// arithmetic suffices: a wrong answer costs one lattice point. Keeps a reference to the surface.
class SurfaceLocator
{
public:
  explicit SurfaceLocator(const SurfaceComplex& surface);

  struct Answer
  {
    double distance; ///< to the surface, mm
    bool inside;     ///< whether the point is inside a tissue
  };

  Answer ask(const Vec3& p) const { return ask(p, {}); }

private:
  friend class SurfaceWalk;
  using Kernel = CGAL::Simple_cartesian<double>;
  using Triangles = std::vector<Kernel::Triangle_3>;
  using Iterator = Triangles::const_iterator;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Iterator>>>;

  /// `inside`, if given, is the known side of p.
  Answer ask(const Vec3& p, std::optional<bool> inside) const;
  Label labelTowards(const Vec3& p, Iterator closest) const;

  const SurfaceComplex& m_Surface;
  Triangles m_Triangles;
  Tree m_Tree;
};

/// Queries a sequence of points, each near the previous one: within the distance of the previous point from the
/// surface, the side cannot change. Keeps a reference to the locator.
class SurfaceWalk
{
public:
  explicit SurfaceWalk(const SurfaceLocator& locator) : m_Locator(locator) {}

  /// Returns what follows for p from the last query: its side and a lower bound on its distance; nothing if p is too
  /// far away.
  std::optional<SurfaceLocator::Answer> known(const Vec3& p) const;

  SurfaceLocator::Answer ask(const Vec3& p);

private:
  const SurfaceLocator& m_Locator;
  Vec3 m_Last;
  SurfaceLocator::Answer m_Answer{ 0, false };
};

} // namespace surgicalmesher
