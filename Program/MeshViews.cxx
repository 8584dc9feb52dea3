// SPDX-License-Identifier: Apache-2.0
#include "MeshViews.h"

#include "FaceAdjacency.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace surgicalmesher
{

namespace
{

/// Converts an OKLCh colour to sRGB (B. Ottosson, A perceptual color space for image processing, 2020); hue in turns.
Color fromOklch(double lightness, double chroma, double hue)
{
  const double turn = 2 * 3.14159265358979323846 * hue;
  const double a = chroma * std::cos(turn), b = chroma * std::sin(turn);
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3),
               m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3),
               s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  Color color{ 4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
               -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
               -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s };
  for (double& c : color)
  {
    c = std::clamp(c, 0.0, 1.0);
    c = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
  }
  return color;
}

/// Returns the n-th of a series of colours. Consecutive ones differ: hues by the golden ratio, in three lightnesses.
Color distinctColor(std::size_t n)
{
  return fromOklch(std::array<double, 3>{ 0.74, 0.62, 0.86 }[n % 3], 0.105,
                   std::fmod(0.618033988749895 * double(n), 1));
}

Vec3 centroid(const TetMesh& mesh, std::size_t t)
{
  Vec3 sum;
  for (const std::int32_t id : mesh.tetrahedra[t]) sum += mesh.points[std::size_t(id)];
  return sum / 4;
}

} // namespace

std::map<Label, Color> colorsOf(const std::vector<Label>& present, const TissueTable& tissues)
{
  const std::set<Label> labels(present.begin(), present.end());
  std::map<Label, Color> colors;
  std::set<Color> different;
  for (const Label label : labels)
  {
    const auto tissue = tissues.find(label);
    colors[label] = tissue == tissues.end() ? Tissue().color : tissue->second.color;
    different.insert(colors[label]);
  }
  if (different.size() > 1 || labels.size() < 2) return colors;
  std::size_t n = 0;
  for (auto& entry : colors) entry.second = distinctColor(n++);
  return colors;
}

std::vector<Facet> outerFacets(const SurfaceFile& content)
{
  const SurfaceComplex& surface = content.surface;
  std::vector<Label> present{ 1 };
  for (const auto& sides : surface.labels) present.insert(present.end(), sides.begin(), sides.end());
  std::map<Label, Color> colors = colorsOf(present, content.tissues);
  std::vector<Facet> facets;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const std::array<Label, 2> sides = surface.labels.empty() ? std::array<Label, 2>{ 1, 0 } : surface.labels[t];
    if (sides[0] != 0 && sides[1] != 0) continue;
    Facet facet;
    for (int i = 0; i < 3; ++i) facet.corners[i] = surface.points[std::size_t(surface.triangles[t][i])];
    facet.color = colors[std::max(sides[0], sides[1])];
    facets.push_back(facet);
  }
  return facets;
}

std::vector<Facet> facetsOf(const MeshFile& content, const std::function<bool(std::size_t)>& kept)
{
  const TetMesh& mesh = content.mesh;
  std::map<Label, Color> colors = colorsOf(mesh.labels, content.tissues);
  const FaceAdjacency neighbours = faceAdjacency(mesh);
  std::vector<Facet> facets;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    if (!kept(t)) continue;
    for (int f = 0; f < 4; ++f)
    {
      const std::int32_t beyond = neighbours.across[t][f];
      if (beyond >= 0 && kept(std::size_t(beyond))) continue;
      Facet facet;
      for (int i = 0; i < 3; ++i) facet.corners[i] = mesh.points[std::size_t(mesh.tetrahedra[t][kFaceCorners[f][i]])];
      facet.color = colors[mesh.labels[t]];
      facets.push_back(facet);
    }
  }
  return facets;
}

std::vector<Facet> cutFacets(const MeshFile& content, const Vec3& place, const Vec3& towards)
{
  const TetMesh& mesh = content.mesh;
  double low = dot(mesh.points.front(), towards), high = low;
  for (const Vec3& p : mesh.points)
  {
    low = std::min(low, dot(p, towards));
    high = std::max(high, dot(p, towards));
  }
  double depth = dot(place, towards);
  if (!(depth > low && depth < high)) depth = (low + high) / 2;
  return facetsOf(content, [&](std::size_t t) { return dot(centroid(mesh, t), towards) <= depth; });
}

std::vector<Facet> childFacets(const MeshFile& content)
{
  if (content.subMesh.empty()) return {};
  return facetsOf(content, [&](std::size_t t) { return content.subMesh[t] > 0; });
}

} // namespace surgicalmesher
