// SPDX-License-Identifier: Apache-2.0
// CGAL's Mesh_3 on a label map with a scale, to measure against: the same input, sizes and file format as ours.
//
// usage: Mesh3Driver LABELMAP SCALE.nrrd OUT.vtu [--perturb] [--exude] [--facetDistance MM] [--timeLimit SECONDS]
//
// L bounds the circumradii of facets and of tetrahedra; facets are at most facetDistance (1 mm) from the boundary that
// Mesh_3 interpolates; perturbation and exudation may take timeLimit (60 s) each, 0 for no limit. Prints one JSON
// object: seconds of each phase, sizes, peak memory. CGAL's own chatter is on stderr.

#include "Driver.h"
#include "Errors.h"
#include "MeshIO.h"
#include "TissueMapIO.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Image_3.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/make_mesh_3.h>
#include <CGAL/version.h>

#include <algorithm>
#include <iostream>
#include <unordered_map>

using namespace surgicalmesher;

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Domain = CGAL::Labeled_mesh_domain_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain, CGAL::Default, CGAL::Sequential_tag>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;

struct Options
{
  std::string labelMap, scale, mesh;
  bool perturb = false, exude = false;
  double facetDistance = 1; ///< mm
  double timeLimit = 60;    ///< seconds
};

Options readOptions(const std::vector<std::string>& arguments)
{
  Options options;
  std::vector<std::string> files;
  for (std::size_t i = 0; i < arguments.size(); ++i)
  {
    const std::string& word = arguments[i];
    const bool hasNext = i + 1 < arguments.size();
    if (word == "--perturb") options.perturb = true;
    else if (word == "--exude") options.exude = true;
    else if (word == "--facetDistance" && hasNext) options.facetDistance = std::stod(arguments[++i]);
    else if (word == "--timeLimit" && hasNext) options.timeLimit = std::stod(arguments[++i]);
    else files.push_back(word);
  }
  if (files.size() != 3)
    throw UsageError("usage: Mesh3Driver LABELMAP SCALE OUT.vtu [--perturb] [--exude] [--facetDistance MM] "
                     "[--timeLimit SECONDS]");
  options.labelMap = files[0];
  options.scale = files[1];
  options.mesh = files[2];
  return options;
}

/// Mesh_3 takes what lies beyond the outer voxels' centres for outside: a layer of background keeps their other half.
constexpr int kMargin = 1;

template <class Word>
void fillImage(const TissueMap& map, const std::vector<Label>& present, Word* data)
{
  const auto& size = map.grid.size;
  for (int k = 0; k < size[2]; ++k)
  {
    for (int j = 0; j < size[1]; ++j)
    {
      for (int i = 0; i < size[0]; ++i)
      {
        const Label label = map.labels[map.grid.index(i, j, k)];
        if (label == 0) continue;
        const std::size_t at =
          (std::size_t(k + kMargin) * (size[1] + 2 * kMargin) + j + kMargin) * (size[0] + 2 * kMargin) + i + kMargin;
        data[at] = Word(1 + (std::lower_bound(present.begin(), present.end(), label) - present.begin()));
      }
    }
  }
}

/// Tissues numbered 1, 2, 3 ... in the order of `present`, in as few bytes as they need.
CGAL::Image_3 imageOf(const TissueMap& map, const std::vector<Label>& present)
{
  const bool fitsByte = present.size() < 256;
  const auto& size = map.grid.size;
  const Vec3& spacing = map.grid.spacing;
  _image* image = _createImage(size[0] + 2 * kMargin, size[1] + 2 * kMargin, size[2] + 2 * kMargin, 1, spacing.x,
                               spacing.y, spacing.z, fitsByte ? 1 : 2, WK_FIXED, SGN_UNSIGNED);
  const std::size_t bytes = image->xdim * image->ydim * image->zdim * image->wdim;
  std::fill_n(static_cast<unsigned char*>(image->data), bytes, static_cast<unsigned char>(0));
  if (fitsByte) fillImage(map, present, static_cast<std::uint8_t*>(image->data));
  else fillImage(map, present, static_cast<std::uint16_t*>(image->data));
  return CGAL::Image_3(image);
}

/// From the image's own coordinates, which begin at its first voxel, to those of the map's grid.
Vec3 gridPosition(const Kernel::Point_3& p, const Grid& grid)
{
  return Vec3{ p.x(), p.y(), p.z() } - double(kMargin) * grid.spacing;
}

struct EdgeLengthField
{
  using FT = Kernel::FT;
  const ScaleField* scale; ///< seen from `grid`
  const Grid* grid;

  template <class Point, class Index>
  FT operator()(const Point& p, int, const Index&) const
  {
    return (*scale)(gridPosition(Kernel::Point_3(p.x(), p.y(), p.z()), *grid));
  }
};

TetMesh meshOf(const Complex& complex, const TissueMap& map, const std::vector<Label>& present)
{
  TetMesh mesh;
  std::unordered_map<const void*, std::int32_t> ids;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell)
  {
    std::array<std::int32_t, 4> tetrahedron;
    for (int corner = 0; corner < 4; ++corner)
    {
      const auto vertex = cell->vertex(corner);
      const auto [at, isNew] = ids.emplace(&*vertex, std::int32_t(mesh.points.size()));
      tetrahedron[corner] = at->second;
      const Kernel::Point_3 p = vertex->point().point();
      if (isNew) mesh.points.push_back(map.grid.gridToWorld(gridPosition(p, map.grid)));
    }
    mesh.tetrahedra.push_back(tetrahedron);
    mesh.labels.push_back(present[std::size_t(complex.subdomain_index(cell)) - 1]);
  }
  return mesh;
}

void run(const Options& options)
{
  using namespace CGAL::parameters;
  Stopwatch stopwatch;
  const TissueMap map = readTissueMap(options.labelMap);
  const ScaleField scale = inFrameOf(map.grid, readScale(options.scale));
  stopwatch.lap("read");

  const std::vector<Label> present = presentLabels(map);
  const CGAL::Image_3 image = imageOf(map, present);
  const Domain domain = Domain::create_labeled_image_mesh_domain(image, relative_error_bound = 1e-6);
  const EdgeLengthField length{ &scale, &map.grid };
  const CGAL::Mesh_criteria_3<Triangulation> criteria(facet_angle = 30, facet_size = length,
                                                      facet_distance = options.facetDistance,
                                                      cell_radius_edge_ratio = 3, cell_size = length);
  Complex complex = CGAL::make_mesh_3<Complex>(domain, criteria, no_perturb(), no_exude());
  stopwatch.lap("refine");
  if (options.perturb)
  {
    CGAL::perturb_mesh_3(complex, domain, time_limit = options.timeLimit);
    stopwatch.lap("perturb");
  }
  if (options.exude)
  {
    CGAL::exude_mesh_3(complex, time_limit = options.timeLimit);
    stopwatch.lap("exude");
  }

  MeshFile file;
  file.mesh = meshOf(complex, map, present);
  file.tissues = map.table;
  writeMesh(file, options.mesh);
  stopwatch.lap("write");
  std::cout << runJSON("CGAL Mesh_3 " CGAL_VERSION_STR, stopwatch, file.mesh.points.size(), file.mesh.tetrahedra.size())
            << '\n';
}

} // namespace

int main(int argc, char** argv)
{
  return runDriver([&] { run(readOptions({ argv + 1, argv + argc })); });
}
