// SPDX-License-Identifier: Apache-2.0
#include "VolumeBalance.h"

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{

namespace
{

/// Corner number k of tetrahedron t, counted from i.
const Vec3& corner(const TetMesh& mesh, std::int32_t t, int i, int k)
{
  return mesh.points[mesh.tetrahedra[t][(i + k) & 3]];
}

/// Normal of the face opposite corner i, of twice the face's area; its side depends on i.
Vec3 normal(const TetMesh& mesh, std::int32_t t, int i)
{
  const Vec3 &a = corner(mesh, t, i, 1), &b = corner(mesh, t, i, 2), &c = corner(mesh, t, i, 3);
  return cross(b - a, c - a);
}

} // namespace

VolumeBalance::Lack VolumeBalance::lackOf(const BackgroundMesh& background) const
{
  const TetMesh& mesh = background.mesh;
  Lack lack{ std::vector<double>(labelCount), {} };
  for (const auto& [label, volume] : m_Volumes) lack.volumes[label] = volume;
  for (std::int32_t t = 0; t < std::int32_t(mesh.tetrahedra.size()); ++t)
  {
    const Label label = mesh.labels[t];
    lack.volumes[label] -=
      orient(corner(mesh, t, 0, 0), corner(mesh, t, 0, 1), corner(mesh, t, 0, 2), corner(mesh, t, 0, 3)) / 6;
    for (int i = 0; i < 4; ++i)
      if (const std::int32_t n = background.neighbours[t][i]; n >= 0 && mesh.labels[n] < label)
        lack.areas[{ mesh.labels[n], label }] += 0.5 * norm(normal(mesh, t, i));
  }
  return lack;
}

TissueOffsets VolumeBalance::offsets(const BackgroundMesh& background, double leastShare) const
{
  constexpr double gain = 1.3; // some vertices may not go where they should
  const Lack lack = lackOf(background);
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
  const Lack lack = lackOf(background);
  std::vector<double> area(labelCount);
  for (const auto& [pair, size] : lack.areas) area[pair.first] += size, area[pair.second] += size;
  std::vector<double> steps(labelCount);
  for (const auto& [label, volume] : m_Volumes)
    if (label != 0 && area[label] > 0) steps[label] = stepOf(label, gain * (lack.volumes[label] / area[label]));
  for (auto& sample : background.samples)
  {
    const std::int32_t t = sample.tetrahedron;
    const int face = sample.face;
    Vec3 outward = normal(mesh, t, face);
    if (dot(outward, corner(mesh, t, face, 0) - corner(mesh, t, face, 1)) > 0) outward = -1.0 * outward;
    const Label inside = mesh.labels[t], beyond = mesh.labels[background.neighbours[t][face]];
    sample.position += (steps[inside] - steps[beyond]) / norm(outward) * outward;
  }
}

/// How much farther a tissue's boundary goes out, mm: as wanted, within the most in all.
double VolumeBalance::stepOf(Label label, double wanted)
{
  double& moved = m_Moved[label];
  const double before = moved;
  moved = std::clamp(moved + wanted, -m_Most, m_Most);
  return moved - before;
}

} // namespace surgicalmesher
