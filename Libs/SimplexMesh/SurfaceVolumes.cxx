// SPDX-License-Identifier: Apache-2.0
#include "SurfaceVolumes.h"

namespace surgicalmesher
{

namespace
{

/// The gradients of the volumes of the tissues with respect to the points, and the mobilities of the points.
class VolumeGradients
{
public:
  VolumeGradients(const SurfaceComplex& surface, const std::map<Label, double>& tissues,
                  const std::vector<double>& mobility)
    : m_Entries(surface.points.size()), m_Ease(surface.points.size(), 0), m_Tissues(tissues.size())
  {
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    {
      const auto& [a, b, c] = surface.triangles[t];
      // A third of the triangle's vector area.
      const Vec3 &p = surface.points[a], third = cross(surface.points[b] - p, surface.points[c] - p) / 6;
      for (const std::int32_t v : surface.triangles[t])
      {
        m_Ease[v] += norm(third);
        for (int side = 0; side < 2; ++side)
          if (const auto tissue = tissues.find(surface.labels[t][side]); tissue != tissues.end())
            add(v, std::size_t(std::distance(tissues.begin(), tissue)), side == 0 ? third : -1.0 * third);
      }
    }
    for (std::size_t v = 0; v < m_Ease.size(); ++v) m_Ease[v] = m_Ease[v] > 0 ? mobility[v] / m_Ease[v] : 0;
  }

  Vec3 displacement(std::size_t v, const std::vector<double>& pressures) const
  {
    Vec3 sum;
    for (const auto& [tissue, gradient] : m_Entries[v]) sum += pressures[tissue] * gradient;
    return m_Ease[v] * sum;
  }

  /// Returns the volume that each tissue gains from the displacements caused by these pressures.
  std::vector<double> gains(const std::vector<double>& pressures) const
  {
    std::vector<double> result(m_Tissues, 0);
    for (std::size_t v = 0; v < m_Entries.size(); ++v)
    {
      const Vec3 way = displacement(v, pressures);
      for (const auto& [tissue, gradient] : m_Entries[v]) result[tissue] += dot(gradient, way);
    }
    return result;
  }

private:
  void add(std::int32_t v, std::size_t tissue, const Vec3& gradient)
  {
    for (auto& [known, sum] : m_Entries[v])
      if (known == tissue)
      {
        sum += gradient;
        return;
      }
    m_Entries[v].emplace_back(tissue, gradient);
  }

  std::vector<std::vector<std::pair<std::size_t, Vec3>>> m_Entries; ///< by point: tissue and gradient
  std::vector<double> m_Ease;                                       ///< mobility divided by area
  std::size_t m_Tissues;
};

double product(const std::vector<double>& a, const std::vector<double>& b)
{
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// Solves for the pressures by conjugate gradients. As many steps as there are tissues give the solution; far fewer are
/// accurate enough.
std::vector<double> pressuresFor(const VolumeGradients& gradients, std::vector<double> lacking)
{
  constexpr int mostSteps = 100;
  constexpr double accuracy = 1e-3;
  std::vector<double> pressures(lacking.size(), 0), way = lacking;
  double left = product(lacking, lacking);
  const double enough = accuracy * accuracy * left;
  for (int step = 0; step < mostSteps && left > enough; ++step)
  {
    const std::vector<double> gains = gradients.gains(way);
    const double curvature = product(way, gains);
    if (!(curvature > 0)) break;
    const double share = left / curvature, before = left;
    for (std::size_t i = 0; i < way.size(); ++i)
    {
      pressures[i] += share * way[i];
      lacking[i] -= share * gains[i];
    }
    left = product(lacking, lacking);
    for (std::size_t i = 0; i < way.size(); ++i) way[i] = lacking[i] + left / before * way[i];
  }
  return pressures;
}

} // namespace

std::map<Label, double> enclosedVolumes(const SurfaceComplex& surface)
{
  std::map<Label, double> volumes;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const auto& [a, b, c] = surface.triangles[t];
    const double volume = dot(surface.points[a], cross(surface.points[b], surface.points[c])) / 6;
    volumes[surface.labels[t][0]] += volume;
    volumes[surface.labels[t][1]] -= volume;
  }
  volumes.erase(Label(0));
  return volumes;
}

std::vector<Vec3> displacementsForVolumes(const SurfaceComplex& surface, const std::map<Label, double>& lacking,
                                          const std::vector<double>& mobility)
{
  const VolumeGradients gradients(surface, lacking, mobility);
  std::vector<double> wanted;
  for (const auto& [label, volume] : lacking) wanted.push_back(volume);
  const std::vector<double> pressures = pressuresFor(gradients, wanted);
  std::vector<Vec3> result;
  for (std::size_t v = 0; v < surface.points.size(); ++v) result.push_back(gradients.displacement(v, pressures));
  return result;
}

} // namespace surgicalmesher
