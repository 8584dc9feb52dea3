// SPDX-License-Identifier: Apache-2.0
#include "CurveInsertion.h"

#include "Compaction.h"
#include "CurveTracing.h"
#include "Distance.h"
#include "InterfaceSamples.h"
#include "Remesher.h"
#include "Schedule.h"

#include <algorithm>
#include <memory>

namespace surgicalmesher
{

namespace
{

/// Share of the tolerance that chains may use in favour of angles; the rest allows for rounding and for the places
/// between the points at which the target length is known.
constexpr double usedTolerance = 0.92;

/// Marks the points within `reach` target lengths of a curve.
std::vector<std::uint8_t> pointsNear(const std::vector<Vec3>& points, const CurveNetwork& curves, double reach)
{
  std::vector<std::uint8_t> isNear(points.size(), 0);
  for (const CurveArc& arc : curves.arcs)
    for (std::size_t k = 1; k < arc.points.size(); ++k)
    {
      const Vec3 &a = arc.points[k - 1], &b = arc.points[k];
      const double distance = reach * arc.lengths[k];
      for (std::size_t v = 0; v < points.size(); ++v)
        if (!isNear[v] && std::abs(points[v].x - a.x) <= 2 * distance)
          isNear[v] = distanceToSegment(points[v], a, b) <= distance;
    }
  return isNear;
}

/// Splits a mesh into the tetrahedra near the curves, as a complex, and the rest.
class Neighbourhood
{
public:
  Neighbourhood(const TetMesh& mesh, const CurveNetwork& curves, const SizingFunction& length) : m_Mesh(mesh)
  {
    constexpr double reach = 3.5;
    const std::vector<std::uint8_t> isNear = pointsNear(mesh.points, curves, reach);
    std::vector<TetComplex::Tet> tets;
    std::vector<Label> labels;
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    {
      const auto& x = mesh.tetrahedra[t];
      if (!isNear[x[0]] && !isNear[x[1]] && !isNear[x[2]] && !isNear[x[3]])
      {
        m_Rest.push_back(t);
        continue;
      }
      tets.push_back(x);
      labels.push_back(mesh.labels[t]);
    }
    m_Ids = compactPoints(tets, mesh.points.size());
    std::vector<float> lengths;
    for (const std::int32_t id : m_Ids) lengths.push_back(float(length(mesh.points[id])));
    m_Complex = std::make_unique<TetComplex>(valuesAt(mesh.points, m_Ids), std::move(lengths), std::move(tets),
                                             std::move(labels));
  }

  TetComplex& complex() { return *m_Complex; }

  /// Returns the whole mesh, and replaces the vertex ids of the complex in `chains` by point ids of that mesh.
  TetMesh mesh(std::vector<CurveChain>& chains) const
  {
    TetMesh result;
    result.points = m_Mesh.points;
    std::vector<std::int32_t> ids = m_Ids;
    for (std::size_t v = 0; v < m_Complex->points.size(); ++v)
    {
      if (v < m_Ids.size()) result.points[ids[v]] = m_Complex->points[v];
      else
      {
        ids.push_back(std::int32_t(result.points.size()));
        result.points.push_back(m_Complex->points[v]);
      }
    }
    for (const std::size_t t : m_Rest)
    {
      result.tetrahedra.push_back(m_Mesh.tetrahedra[t]);
      result.labels.push_back(m_Mesh.labels[t]);
    }
    for (std::int32_t t = 0; t < std::int32_t(m_Complex->tets.size()); ++t)
    {
      if (!m_Complex->alive(t)) continue;
      auto x = m_Complex->tets[t];
      for (auto& v : x) v = ids[v];
      result.tetrahedra.push_back(x);
      result.labels.push_back(m_Complex->labels[t]);
    }
    const std::vector<std::int32_t> used = compactPoints(result.tetrahedra, result.points.size());
    result.points = valuesAt(result.points, used);
    for (CurveChain& chain : chains)
      for (std::int32_t& v : chain.points)
        v = std::int32_t(std::lower_bound(used.begin(), used.end(), ids[v]) - used.begin());
    return result;
  }

private:
  const TetMesh& m_Mesh;
  std::vector<std::size_t> m_Rest;
  std::vector<std::int32_t> m_Ids; ///< point ids in the mesh of the first points of the complex; the others are new
  std::unique_ptr<TetComplex> m_Complex;
};

/// Samples the interface of the complex as it is now, so that later operations stay within `tolerance` of it.
void addSamples(TetComplex& complex, double tolerance)
{
  BackgroundMesh background;
  background.mesh.points = complex.points;
  background.lengths = complex.lengths;
  std::vector<std::int32_t> alive;
  for (std::int32_t t = 0; t < std::int32_t(complex.tets.size()); ++t)
  {
    if (!complex.alive(t)) continue;
    alive.push_back(t);
    background.mesh.tetrahedra.push_back(complex.tets[t]);
    background.mesh.labels.push_back(complex.labels[t]);
  }
  addInterfaceSamples(background, tolerance);
  for (const auto& sample : background.samples)
    complex.addSample(alive[sample.tetrahedron], sample.face, sample.position, sample.tolerance);
}

/// Returns the chain of each curve, joined from the chains of its arcs.
std::vector<CurveChain> chainsOf(const CurveChains& chains)
{
  const CurveNetwork& network = chains.network();
  std::vector<CurveChain> result(network.names.size());
  for (std::size_t n = 0; n < network.names.size(); ++n) result[n].name = network.names[n];
  for (std::size_t n = 0; n < network.arcs.size(); ++n)
  {
    const CurveArc& arc = network.arcs[n];
    CurveChain& chain = result[arc.curve];
    if (!chain.points.empty())
    {
      chain.points.pop_back(); // the node that the next arc begins with
      chain.radii.pop_back();
    }
    for (const auto& [v, s] : chains.chain(n))
    {
      chain.points.push_back(v);
      chain.radii.push_back(arc.radiusAt(s));
    }
  }
  return result;
}

} // namespace

std::vector<CurveChain> insertCurves(TetMesh& mesh, const CurveNetwork& curves, const SizingFunction& length,
                                     const CurveInsertionOptions& options)
{
  if (curves.arcs.empty()) return {};
  Neighbourhood neighbourhood(mesh, curves, length);
  TetComplex& complex = neighbourhood.complex();
  CurveNetwork network = curves;
  aimAtInterfaces(network, complex);
  CurveChains chains(network, complex, usedTolerance * options.tolerance);
  traceCurves(complex, chains);
  addSamples(complex, options.surfaceTolerance);
  const double smallest = *std::min_element(complex.lengths.begin(), complex.lengths.end());
  RemesherOptions remeshing;
  remeshing.featureAngle = options.featureAngle;
  for (const TetrahedralSweep& next : sweepsForCurves(options.targetAngle, smallest))
    runSweep(complex, length, next.sweep, remeshing, {}, &chains);
  std::vector<CurveChain> result = chainsOf(chains);
  mesh = neighbourhood.mesh(result);
  return result;
}

} // namespace surgicalmesher
