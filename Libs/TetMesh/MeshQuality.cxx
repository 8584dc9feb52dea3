// SPDX-License-Identifier: Apache-2.0
#include "MeshQuality.h"

#include "FaceAdjacency.h"
#include "Grouped.h"
#include "JsonMember.h"
#include "Parallel.h"
#include "TetQuality.h"

#include <rapidjson/prettywriter.h>
#include <rapidjson/stringbuffer.h>
#include <vtkSMPTools.h>

#include <algorithm>
#include <cmath>
#include <locale>
#include <numeric>
#include <sstream>

namespace surgicalmesher
{
namespace
{

constexpr double kDegrees = 57.295779513082321;

// ---- groups ---------------------------------------------------------------------------------------------------------

struct Samples
{
  std::size_t points = 0;
  std::vector<double> dihedral, minimumDihedral, radiusRatio, scaledJacobian, volume, height, edgeOverTarget, valence;
};

/// Label at each point if all tetrahedra around it have it and it is not on the hull of the mesh, else -1.
std::vector<std::int32_t> innerPoints(const TetMesh& mesh)
{
  constexpr std::int32_t unseen = -2, mixed = -1;
  std::vector<std::int32_t> label(mesh.points.size(), unseen);
  const FaceAdjacency neighbours = faceAdjacency(mesh);
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    for (const std::int32_t id : mesh.tetrahedra[t])
    {
      if (label[id] == unseen) label[id] = mesh.labels[t];
      else if (label[id] != mesh.labels[t]) label[id] = mixed;
    }
  }
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    for (int f = 0; f < 4; ++f)
    {
      if (neighbours.across[t][f] >= 0) continue;
      for (const int c : kFaceCorners[f]) label[mesh.tetrahedra[t][c]] = mixed;
    }
  }
  return label;
}

std::vector<std::int32_t> valences(const TetMesh& mesh)
{
  std::vector<std::int32_t> result(mesh.points.size(), 0);
  for (const auto& tetrahedron : mesh.tetrahedra)
  {
    for (const std::int32_t id : tetrahedron) ++result[id];
  }
  return result;
}

/// Number of tetrahedra of each tissue at each point on its boundary.
std::vector<double> boundaryValences(const TetMesh& mesh, const std::vector<std::int32_t>& inner)
{
  std::vector<std::pair<std::int32_t, Label>> uses;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    for (const std::int32_t id : mesh.tetrahedra[t])
      if (inner[id] < 0) uses.emplace_back(id, mesh.labels[t]);
  std::sort(uses.begin(), uses.end());
  std::vector<double> result;
  for (auto begin = uses.begin(); begin != uses.end();)
  {
    const auto end = std::upper_bound(begin, uses.end(), *begin);
    result.push_back(double(end - begin));
    begin = end;
  }
  return result;
}

/// The edges of a mesh, ascending by their ends.
struct Edges
{
  std::vector<std::array<std::int32_t, 2>> ends;          ///< point ids, ascending
  std::vector<std::array<std::int32_t, 6>> ofTetrahedron; ///< numbers of edges, in the order of kEdgeCorners
};

Edges edgesOf(const TetMesh& mesh)
{
  struct Use
  {
    std::int32_t high;
    std::int32_t tetrahedron, local;
  };
  const std::size_t n = mesh.points.size();
  // Edges are grouped by their lower ends: some thirty per point are left to sort.
  Grouped<Use> uses(n,
                    [&](auto&& visit)
                    {
                      for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
                        for (int e = 0; e < 6; ++e)
                        {
                          const auto [low, high] =
                            std::minmax(mesh.tetrahedra[t][kEdgeCorners[e][0]], mesh.tetrahedra[t][kEdgeCorners[e][1]]);
                          visit(std::size_t(low), Use{ high, std::int32_t(t), e });
                        }
                    });
  const auto isLower = [](const Use& a, const Use& b) { return a.high < b.high; };
  parallelFor(n, [&](std::size_t v) { std::sort(uses.begin(v), uses.end(v), isLower); });
  Edges edges;
  edges.ofTetrahedron.resize(mesh.tetrahedra.size());
  for (std::size_t v = 0; v < n; ++v)
  {
    std::int32_t before = -1;
    for (const Use* use = uses.begin(v); use != uses.end(v); before = (use++)->high)
    {
      if (use->high != before) edges.ends.push_back({ std::int32_t(v), use->high });
      edges.ofTetrahedron[use->tetrahedron][use->local] = std::int32_t(edges.ends.size()) - 1;
    }
  }
  return edges;
}

struct TetrahedronMeasures
{
  std::array<double, 6> dihedral;
  double minimumDihedral, radiusRatio, scaledJacobian, volume, height;
};

TetrahedronMeasures measuresOf(const TetMesh& mesh, std::size_t t)
{
  const auto& ids = mesh.tetrahedra[t];
  const Vec3 &a = mesh.points[ids[0]], &b = mesh.points[ids[1]], &c = mesh.points[ids[2]], &d = mesh.points[ids[3]];
  const std::array<double, 6> angles = dihedralAngles(a, b, c, d);
  return { angles,
           *std::min_element(angles.begin(), angles.end()),
           radiusRatio(a, b, c, d),
           scaledJacobian(a, b, c, d),
           orient(a, b, c, d) / 6,
           leastHeight(a, b, c, d) };
}

/// Target length of the edge between two points, mm.
using EdgeTarget = std::function<double(std::int32_t a, std::int32_t b)>;

/// Data from which every group is assessed, computed once.
struct Context
{
  const TetMesh& mesh;
  std::vector<std::int32_t> inner = innerPoints(mesh);
  std::vector<std::int32_t> valence = valences(mesh);
  std::vector<TetrahedronMeasures> measures;
  Edges edges;
  std::vector<double> edgeOverTarget; ///< by edge; empty without a target

  Context(const TetMesh& ofMesh, const EdgeTarget& target) : mesh(ofMesh), measures(mesh.tetrahedra.size())
  {
    parallelFor(measures.size(), [&](vtkIdType t) { measures[t] = measuresOf(mesh, std::size_t(t)); });
    if (!target) return;
    edges = edgesOf(mesh);
    edgeOverTarget.resize(edges.ends.size());
    parallelFor(edgeOverTarget.size(),
                [&](vtkIdType e)
                {
                  const auto [a, b] = edges.ends[e];
                  edgeOverTarget[e] = norm(mesh.points[b] - mesh.points[a]) / target(a, b);
                });
  }
};

std::vector<double> edgesOverTarget(const Context& context, const std::vector<std::int32_t>& tetrahedra)
{
  std::vector<double> result;
  if (context.edgeOverTarget.empty()) return result;
  std::vector<std::uint8_t> used(context.edgeOverTarget.size(), 0);
  for (const std::int32_t t : tetrahedra)
    for (const std::int32_t e : context.edges.ofTetrahedron[t]) used[e] = 1;
  for (std::size_t e = 0; e < used.size(); ++e)
    if (used[e]) result.push_back(context.edgeOverTarget[e]);
  return result;
}

/// Number of tetrahedra of a group at each point of the mesh.
std::vector<std::int32_t> usesOf(const TetMesh& mesh, const std::vector<std::int32_t>& tetrahedra)
{
  std::vector<std::int32_t> uses(mesh.points.size(), 0);
  for (const std::int32_t t : tetrahedra)
    for (const std::int32_t id : mesh.tetrahedra[t]) ++uses[id];
  return uses;
}

Samples samplesOf(const Context& context, const std::vector<std::int32_t>& tetrahedra)
{
  Samples samples;
  for (const std::int32_t t : tetrahedra)
  {
    const TetrahedronMeasures& m = context.measures[t];
    samples.dihedral.insert(samples.dihedral.end(), m.dihedral.begin(), m.dihedral.end());
    samples.minimumDihedral.push_back(m.minimumDihedral);
    samples.radiusRatio.push_back(m.radiusRatio);
    samples.scaledJacobian.push_back(m.scaledJacobian);
    samples.volume.push_back(m.volume);
    samples.height.push_back(m.height);
  }
  const std::vector<std::int32_t> uses = usesOf(context.mesh, tetrahedra);
  for (std::size_t id = 0; id < uses.size(); ++id)
  {
    samples.points += uses[id] > 0;
    if (uses[id] > 0 && context.inner[id] >= 0 && uses[id] == context.valence[id]) samples.valence.push_back(uses[id]);
  }
  samples.edgeOverTarget = edgesOverTarget(context, tetrahedra);
  return samples;
}

QualityGroup groupOf(const std::vector<std::int32_t>& tetrahedra, const Samples& samples)
{
  QualityGroup group;
  group.tetrahedra = tetrahedra.size();
  group.points = samples.points;
  group.volume = std::accumulate(samples.volume.begin(), samples.volume.end(), 0.0);
  group.dihedral = distributionOf(samples.dihedral);
  group.minimumDihedral = distributionOf(samples.minimumDihedral);
  group.radiusRatio = distributionOf(samples.radiusRatio);
  group.scaledJacobian = distributionOf(samples.scaledJacobian);
  group.tetrahedronVolume = distributionOf(samples.volume);
  group.height = distributionOf(samples.height);
  group.edgeOverTarget = distributionOf(samples.edgeOverTarget);
  group.valence = distributionOf(samples.valence);
  const auto near = std::count_if(samples.edgeOverTarget.begin(), samples.edgeOverTarget.end(),
                                  [](double ratio) { return ratio > 0.7 && ratio < 1.4; });
  if (!samples.edgeOverTarget.empty()) group.edgesNearTarget = double(near) / double(samples.edgeOverTarget.size());
  return group;
}

Histogram histogramOf(const std::vector<double>& values, double low, double high, int bins)
{
  Histogram result{ low, high, std::vector<std::size_t>(bins, 0) };
  for (const double value : values)
  {
    const double place = (value - low) / (high - low) * bins;
    ++result.counts[static_cast<std::size_t>(std::clamp(place, 0.0, bins - 1.0))];
  }
  return result;
}

// ---- text -----------------------------------------------------------------------------------------------------------

using Writer = rapidjson::PrettyWriter<rapidjson::StringBuffer>;

void write(Writer& writer, const char* key, const Distribution& d)
{
  writeObject(writer, key,
              [&]
              {
                writeMember(writer, "count", d.count);
                writeMember(writer, "minimum", d.minimum);
                writeMember(writer, "percentile1", d.percentile1);
                writeMember(writer, "percentile5", d.percentile5);
                writeMember(writer, "median", d.median);
                writeMember(writer, "percentile95", d.percentile95);
                writeMember(writer, "percentile99", d.percentile99);
                writeMember(writer, "maximum", d.maximum);
                writeMember(writer, "mean", d.mean);
              });
}

void write(Writer& writer, const char* key, const Histogram& histogram)
{
  writeObject(writer, key,
              [&]
              {
                writeMember(writer, "low", histogram.low);
                writeMember(writer, "high", histogram.high);
                writeMember(writer, "counts", histogram.counts);
              });
}

void writeMembers(Writer& writer, const QualityGroup& group)
{
  writeMember(writer, "tetrahedra", group.tetrahedra);
  writeMember(writer, "points", group.points);
  writeMember(writer, "volume", group.volume);
  write(writer, "dihedral", group.dihedral);
  write(writer, "minimumDihedral", group.minimumDihedral);
  write(writer, "radiusRatio", group.radiusRatio);
  write(writer, "scaledJacobian", group.scaledJacobian);
  write(writer, "tetrahedronVolume", group.tetrahedronVolume);
  write(writer, "height", group.height);
  write(writer, "edgeOverTarget", group.edgeOverTarget);
  writeMember(writer, "edgesNearTarget", group.edgesNearTarget);
  write(writer, "valence", group.valence);
}

std::string nameOf(Label label, const TissueTable& tissues)
{
  const auto found = tissues.find(label);
  return found == tissues.end() ? std::string() : found->second.name;
}

} // namespace

std::array<double, 6> dihedralAngles(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const std::array<Vec3, 4> p{ a, b, c, d };
  std::array<Vec3, 4> normals;
  for (int f = 0; f < 4; ++f)
  {
    const auto& [i, j, k] = kFaceCorners[f];
    normals[f] = cross(p[j] - p[i], p[k] - p[i]);
  }
  std::array<double, 6> result;
  for (int e = 0; e < 6; ++e)
  {
    const auto& [k, l] = kEdgeCorners[5 - e]; // the faces opposite k and l meet at edge e
    // atan2 keeps its precision at flat angles, where acos loses half the digits
    result[e] = 180 - kDegrees * std::atan2(norm(cross(normals[k], normals[l])), dot(normals[k], normals[l]));
  }
  return result;
}

double radiusRatio(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const Vec3 u = b - a, v = c - a, w = d - a;
  const double sixVolumes = dot(cross(u, v), w);
  const double twoAreas = norm(cross(u, v)) + norm(cross(v, w)) + norm(cross(w, u)) + norm(cross(v - u, w - u));
  const Vec3 circumcentre = squaredNorm(u) * cross(v, w) + squaredNorm(v) * cross(w, u) + squaredNorm(w) * cross(u, v);
  const double denominator = twoAreas * norm(circumcentre);
  // r = sixVolumes / twoAreas, R = |circumcentre| / (2 sixVolumes)
  return denominator > 0 ? 6 * sixVolumes * std::abs(sixVolumes) / denominator : 0;
}

double scaledJacobian(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const double ab = norm(b - a), ac = norm(c - a), ad = norm(d - a), bc = norm(c - b), bd = norm(d - b),
               cd = norm(d - c);
  const double largest = std::max({ ab * ac * ad, ab * bc * bd, ac * bc * cd, ad * bd * cd });
  return largest > 0 ? std::sqrt(2.0) * orient(a, b, c, d) / largest : 0;
}

double leastHeight(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
{
  const Vec3 u = b - a, v = c - a, w = d - a;
  const double most = std::max(
    { squaredNorm(cross(u, v)), squaredNorm(cross(v, w)), squaredNorm(cross(w, u)), squaredNorm(cross(v - u, w - u)) });
  return most > 0 ? std::abs(dot(cross(u, v), w)) / std::sqrt(most) : 0;
}

Distribution distributionOf(std::vector<double> values)
{
  Distribution result;
  if (values.empty()) return result;
  result.count = values.size();
  result.mean = std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
  // Each selection reduces the range of the next.
  auto begin = values.begin();
  const auto percentile = [&](double share)
  {
    const auto at = values.begin() + std::llround(share * double(values.size() - 1));
    std::nth_element(begin, at, values.end());
    begin = at;
    return *at;
  };
  result.minimum = percentile(0);
  result.percentile1 = percentile(0.01);
  result.percentile5 = percentile(0.05);
  result.median = percentile(0.5);
  result.percentile95 = percentile(0.95);
  result.percentile99 = percentile(0.99);
  result.maximum = percentile(1);
  return result;
}

std::map<Label, double> tissueVolumes(const TetMesh& mesh)
{
  std::map<Label, double> volumes;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
  {
    const auto& [a, b, c, d] = mesh.tetrahedra[t];
    if (mesh.labels[t] != 0)
      volumes[mesh.labels[t]] += orient(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]) / 6;
  }
  return volumes;
}

double worstSine2(const TetMesh& mesh, std::size_t t)
{
  const auto& [a, b, c, d] = mesh.tetrahedra[t];
  return worstSine2(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]);
}

std::size_t countBelow(const TetMesh& mesh, double degrees)
{
  const double least = sine2OfDegrees(degrees);
  std::size_t below = 0;
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) below += mesh.labels[t] != 0 && worstSine2(mesh, t) < least;
  return below;
}

namespace
{

MeshQuality assessed(const TetMesh& mesh, const std::vector<std::int32_t>& subMesh, const EdgeTarget& target)
{
  const Context context(mesh, target);
  std::vector<std::int32_t> all(mesh.tetrahedra.size());
  std::iota(all.begin(), all.end(), 0);
  std::map<Label, std::vector<std::int32_t>> byTissue;
  std::map<std::int32_t, std::vector<std::int32_t>> bySubMesh;
  for (const std::int32_t t : all)
  {
    byTissue[mesh.labels[t]].push_back(t);
    if (!subMesh.empty()) bySubMesh[subMesh[t]].push_back(t);
  }
  MeshQuality result;
  // The largest tasks first, so that all threads end at about the same time.
  std::vector<std::function<void()>> tasks;
  tasks.push_back(
    [&]
    {
      const Samples samples = samplesOf(context, all);
      result.whole = groupOf(all, samples);
      result.dihedral = histogramOf(samples.dihedral, 0, 180, 90);
      result.edgeOverTarget = histogramOf(samples.edgeOverTarget, 0, 2.5, 100);
      result.valence = histogramOf(samples.valence, 0, 60, 60);
      result.boundaryValence = histogramOf(boundaryValences(mesh, context.inner), 0, 60, 60);
    });
  const auto add = [&](QualityGroup& group, const std::vector<std::int32_t>& tetrahedra)
  { tasks.push_back([&] { group = groupOf(tetrahedra, samplesOf(context, tetrahedra)); }); };
  for (const auto& [id, tetrahedra] : bySubMesh) add(result.subMeshes[id], tetrahedra);
  for (const auto& [label, tetrahedra] : byTissue) add(result.tissues[label], tetrahedra);
  runInParallel(tasks);
  return result;
}

} // namespace

MeshQuality assessQuality(const TetMesh& mesh, const std::vector<std::int32_t>& subMesh,
                          const std::function<double(const Vec3&)>& edgeLength)
{
  if (!edgeLength) return assessed(mesh, subMesh, {});
  return assessed(mesh, subMesh,
                  [&](std::int32_t a, std::int32_t b) { return edgeLength(0.5 * (mesh.points[a] + mesh.points[b])); });
}

MeshQuality assessQualityFromPoints(const TetMesh& mesh, const std::vector<std::int32_t>& subMesh,
                                    const std::vector<double>& edgeLengths)
{
  if (edgeLengths.empty()) return assessed(mesh, subMesh, {});
  return assessed(mesh, subMesh,
                  [&](std::int32_t a, std::int32_t b) { return 0.5 * (edgeLengths[a] + edgeLengths[b]); });
}

std::string qualityJSON(const MeshQuality& quality, const TissueTable& tissues)
{
  rapidjson::StringBuffer buffer;
  Writer writer(buffer);
  writer.StartObject();
  writeObject(writer, "whole", [&] { writeMembers(writer, quality.whole); });
  writeObjects(writer, "tissues", quality.tissues,
               [&](const auto& tissue)
               {
                 writeMember(writer, "label", tissue.first);
                 writeMember(writer, "name", nameOf(tissue.first, tissues));
                 writeMembers(writer, tissue.second);
               });
  writeObjects(writer, "subMeshes", quality.subMeshes,
               [&](const auto& subMesh)
               {
                 writeMember(writer, "subMesh", static_cast<std::size_t>(subMesh.first));
                 writeMembers(writer, subMesh.second);
               });
  writeObject(writer, "histograms",
              [&]
              {
                write(writer, "dihedral", quality.dihedral);
                write(writer, "edgeOverTarget", quality.edgeOverTarget);
                write(writer, "valence", quality.valence);
                write(writer, "boundaryValence", quality.boundaryValence);
              });
  writer.EndObject();
  return buffer.GetString();
}

} // namespace surgicalmesher
