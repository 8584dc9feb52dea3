// SPDX-License-Identifier: Apache-2.0
#include "VolumeBalance.h"

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{

namespace
{

/// Returns a normal whose length is twice the triangle's area; its sense depends on the order of the corners.
Vec3 normal(const Vec3& a, const Vec3& b, const Vec3& c) { return cross(b - a, c - a); }

} // namespace

VolumeBalance::Tetrahedra VolumeBalance::tetrahedraOf(const BackgroundMesh& background)
{
  const TetMesh& mesh = background.mesh;
  return { mesh.points, mesh.tetrahedra, background.neighbours, mesh.labels };
}

VolumeBalance::Lack VolumeBalance::lackOf(const Tetrahedra& tetrahedra) const
{
  const std::vector<Label>& labels = tetrahedra.labels;
  Lack lack{ std::vector<double>(labelCount), {} };
  for (const auto& [label, volume] : m_Volumes) lack.volumes[label] = volume;
  for (std::size_t t = 0; t < tetrahedra.corners.size(); ++t)
  {
    const auto& x = tetrahedra.corners[t];
    if (x[0] < 0) continue;
    const auto at = [&](int k) -> const Vec3& { return tetrahedra.points[x[k & 3]]; };
    lack.volumes[labels[t]] -= orient(at(0), at(1), at(2), at(3)) / 6;
    for (int i = 0; i < 4; ++i)
      if (const std::int32_t n = tetrahedra.neighbours[t][i]; n >= 0 && labels[n] < labels[t])
        lack.areas[{ labels[n], labels[t] }] += 0.5 * norm(normal(at(i + 1), at(i + 2), at(i + 3)));
  }
  return lack;
}

TissueOffsets VolumeBalance::offsets(const BackgroundMesh& background, double leastShare) const
{
  return offsetsFor(lackOf(tetrahedraOf(background)), leastShare);
}

TissueOffsets VolumeBalance::offsets(const TetComplex& complex, double leastShare) const
{
  return offsetsFor(lackOf({ complex.points, complex.tets, complex.neighbours, complex.labels }), leastShare);
}

TissueOffsets VolumeBalance::offsetsFor(const Lack& lack, double leastShare) const
{
  constexpr double gain = 1.3; // the guards keep some vertices from moving
  std::map<Label, double> lacking;
  for (const auto& [label, volume] : m_Volumes)
    if (std::abs(lack.volumes[label]) >= leastShare * volume) lacking[label] = gain * lack.volumes[label];
  const auto moving = [&](Label label) { return lacking.count(label) > 0 ? label : Label(0); }; // 0 stays
  std::map<std::pair<Label, Label>, double> areas;
  for (const auto& [pair, area] : lack.areas)
  {
    const Label a = moving(pair.first), b = moving(pair.second);
    if (a != b) areas[std::minmax({ a, b })] += area;
  }
  return offsetsForVolumes(lacking, areas, m_Most);
}

void VolumeBalance::apply(BackgroundMesh& background, double gain)
{
  const TetMesh& mesh = background.mesh;
  const Lack lack = lackOf(tetrahedraOf(background));
  std::vector<double> area(labelCount);
  for (const auto& [pair, size] : lack.areas) area[pair.first] += size, area[pair.second] += size;
  std::vector<double> steps(labelCount);
  for (const auto& [label, volume] : m_Volumes)
    if (label != 0 && area[label] > 0) steps[label] = stepOf(label, gain * (lack.volumes[label] / area[label]));
  for (auto& sample : background.samples)
  {
    const std::int32_t t = sample.tetrahedron;
    const int face = sample.face;
    const auto at = [&](int k) -> const Vec3& { return mesh.points[mesh.tetrahedra[t][(face + k) & 3]]; };
    Vec3 outward = normal(at(1), at(2), at(3));
    if (dot(outward, at(0) - at(1)) > 0) outward = -1.0 * outward;
    const Label inside = mesh.labels[t], beyond = mesh.labels[background.neighbours[t][face]];
    sample.position += (steps[inside] - steps[beyond]) / norm(outward) * outward;
  }
}

/// Returns the next outward step of a tissue's boundary, mm: `wanted`, as far as the sum of all steps stays within the
/// bound.
double VolumeBalance::stepOf(Label label, double wanted)
{
  double& moved = m_Moved[label];
  const double before = moved;
  moved = std::clamp(moved + wanted, -m_Most, m_Most);
  return moved - before;
}

} // namespace surgicalmesher
