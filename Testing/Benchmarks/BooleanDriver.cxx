// SPDX-License-Identifier: Apache-2.0
// Booleans of overlapping closed surfaces by CGAL's corefinement, to measure against: one way to interfaces that tissues
// share.
//
// usage: BooleanDriver OUT.vtp LABEL=SURFACE...
//
// Surfaces of tissues that were offset into each other a little. Every pair is corefined; of each surface those triangles
// stay that are in no surface before it, with that tissue behind them and, in front, the first of the later ones that
// they are in. Points nearer than 1e-6 of the whole become one. Prints one JSON object: seconds of each phase, sizes,
// peak memory.

#include "Driver.h"
#include "Errors.h"
#include "MeshIO.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <iostream>
#include <map>
#include <memory>

using namespace surgicalmesher;
namespace PMP = CGAL::Polygon_mesh_processing;

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Side = CGAL::Side_of_triangle_mesh<Mesh, Kernel>;

struct Body
{
  Label label = 0;
  Mesh surface;
};

/// Outward normals.
Body readBody(const std::string& argument)
{
  const std::size_t at = argument.find('=');
  if (at == std::string::npos) throw UsageError("usage: BooleanDriver OUT.vtp LABEL=SURFACE...");
  Body body;
  body.label = Label(std::stoi(argument.substr(0, at)));
  const SurfaceFile file = readSurface(argument.substr(at + 1));
  for (const Vec3& p : file.surface.points) body.surface.add_vertex({ p.x, p.y, p.z });
  for (const auto& t : file.surface.triangles)
  {
    const auto face =
      body.surface.add_face(Mesh::Vertex_index(t[0]), Mesh::Vertex_index(t[1]), Mesh::Vertex_index(t[2]));
    if (face == Mesh::null_face()) throw InputError(argument + ": more than two triangles at an edge");
  }
  if (!CGAL::is_closed(body.surface)) throw InputError(argument + ": not closed");
  PMP::orient_to_bound_a_volume(body.surface);
  return body;
}

void corefineAll(std::vector<Body>& bodies)
{
  for (std::size_t i = 0; i < bodies.size(); ++i)
  {
    for (std::size_t j = i + 1; j < bodies.size(); ++j)
    {
      PMP::corefine(bodies[i].surface, bodies[j].surface, CGAL::parameters::throw_on_self_intersection(true),
                    CGAL::parameters::throw_on_self_intersection(true));
    }
  }
}

/// Points by their place on a grid of 1e-6 of the whole.
class SharedPoints
{
public:
  explicit SharedPoints(double step) : m_Step(step) {}

  std::int32_t id(const Kernel::Point_3& p)
  {
    const std::array<long long, 3> place{ std::llround(p.x() / m_Step), std::llround(p.y() / m_Step),
                                          std::llround(p.z() / m_Step) };
    const auto [at, isNew] = m_Ids.emplace(place, std::int32_t(points.size()));
    if (isNew) points.push_back({ p.x(), p.y(), p.z() });
    return at->second;
  }

  std::vector<Vec3> points;

private:
  double m_Step;
  std::map<std::array<long long, 3>, std::int32_t> m_Ids;
};

/// The label in front of a triangle of body i with that middle; i's own label if the triangle is to go.
Label labelInFront(const std::vector<Body>& bodies, const std::vector<std::unique_ptr<Side>>& sides, std::size_t i,
                   const Kernel::Point_3& middle)
{
  for (std::size_t k = 0; k < i; ++k)
  {
    if ((*sides[k])(middle) != CGAL::ON_UNBOUNDED_SIDE) return bodies[i].label;
  }
  for (std::size_t k = i + 1; k < bodies.size(); ++k)
  {
    if ((*sides[k])(middle) == CGAL::ON_BOUNDED_SIDE) return bodies[k].label;
  }
  return 0;
}

SurfaceComplex assembled(const std::vector<Body>& bodies)
{
  std::vector<std::unique_ptr<Side>> sides;
  CGAL::Bbox_3 box;
  for (const Body& body : bodies)
  {
    sides.push_back(std::make_unique<Side>(body.surface));
    box += PMP::bbox(body.surface);
  }
  SharedPoints shared(1e-6 * std::max({ box.xmax() - box.xmin(), box.ymax() - box.ymin(), box.zmax() - box.zmin() }));
  SurfaceComplex complex;
  for (std::size_t i = 0; i < bodies.size(); ++i)
  {
    const Mesh& surface = bodies[i].surface;
    for (const auto face : surface.faces())
    {
      std::vector<Kernel::Point_3> p;
      for (const auto vertex : surface.vertices_around_face(surface.halfedge(face))) p.push_back(surface.point(vertex));
      const Label front = labelInFront(bodies, sides, i, CGAL::centroid(p[0], p[1], p[2]));
      if (front == bodies[i].label) continue;
      const std::array<std::int32_t, 3> triangle{ shared.id(p[0]), shared.id(p[1]), shared.id(p[2]) };
      if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) continue;
      complex.triangles.push_back(triangle);
      complex.labels.push_back({ bodies[i].label, front });
    }
  }
  complex.points = shared.points;
  return complex;
}

void run(const std::vector<std::string>& arguments)
{
  if (arguments.size() < 2) throw UsageError("usage: BooleanDriver OUT.vtp LABEL=SURFACE...");
  Stopwatch stopwatch;
  std::vector<Body> bodies;
  for (std::size_t i = 1; i < arguments.size(); ++i) bodies.push_back(readBody(arguments[i]));
  stopwatch.lap("read");
  try
  {
    corefineAll(bodies);
  }
  catch (const PMP::Corefinement::Self_intersection_exception&)
  {
    throw EngineError("CGAL: surfaces intersect themselves where they meet");
  }
  stopwatch.lap("corefine");
  SurfaceFile file;
  file.surface = assembled(bodies);
  stopwatch.lap("assemble");
  writeSurface(file, arguments[0]);
  stopwatch.lap("write");
  std::cout << runJSON("CGAL corefinement", stopwatch, file.surface.points.size(), 0) << '\n';
}

} // namespace

int main(int argc, char** argv)
{
  return runDriver([&] { run({ argv + 1, argv + argc }); });
}
