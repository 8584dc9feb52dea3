// SPDX-License-Identifier: Apache-2.0
#include "SpikeRemoval.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace surgicalmesher
{

namespace
{

constexpr double anyQuality = 0;

/// Returns the tetrahedra of tissues at v.
std::vector<std::int32_t> tissuesAt(GuardedOperations& operations, std::int32_t v)
{
  std::vector<std::int32_t> result;
  for (std::int32_t t : operations.star(v))
    if (operations.complex().labels[t] != 0) result.push_back(t);
  return result;
}

/// Returns the solid angle of t at its corner v (Van Oosterom and Strackee 1983), as a share of the sphere.
double shareOfSphere(const TetComplex& complex, std::int32_t t, std::int32_t v)
{
  Vec3 ways[3];
  int found = 0;
  for (const std::int32_t x : complex.tets[t])
    if (x != v) ways[found++] = complex.points[x] - complex.points[v];
  const auto& [a, b, c] = ways;
  const double la = norm(a), lb = norm(b), lc = norm(c);
  const double within = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
  return std::atan2(std::abs(dot(a, cross(b, c))), within) / (2 * M_PI);
}

/// Returns whether tissues have at most `few` tetrahedra at v and these stick out. In a flat wall they fill half the
/// sphere, however few they are, and their removal would leave a dent.
bool isEar(GuardedOperations& operations, std::int32_t v, std::size_t few)
{
  constexpr double sharp = 0.25; // share of the sphere; bumps that noise makes in a wall fill 0.35
  const std::vector<std::int32_t> tissues = tissuesAt(operations, v);
  if (tissues.size() > few) return false;
  double share = 0;
  for (std::int32_t t : tissues) share += shareOfSphere(operations.complex(), t, v);
  return share < sharp;
}

/// Relabels all tetrahedra at v to `label`, in any order that the guards allow, by backtracking. A relabelling that
/// leads nowhere is undone, unless the envelope refuses because the samples fit better now.
bool takeOff(GuardedOperations& operations, std::int32_t v, Label label, double quality)
{
  std::vector<std::int32_t> others;
  for (std::int32_t t : operations.star(v))
    if (operations.complex().labels[t] != label) others.push_back(t);
  for (std::int32_t t : others)
  {
    const Label own = operations.complex().labels[t];
    if (!operations.relabel(t, label, quality)) continue;
    if (others.size() == 1 || takeOff(operations, v, label, quality)) return true;
    if (operations.relabel(t, own, anyQuality)) operations.uncountRelabels();
  }
  return false;
}

/// Relabels background tetrahedra at v with two or more faces towards tissues to the tissue beyond the last of these
/// faces, until tissues have more than `few` tetrahedra at v.
void fillBeside(GuardedOperations& operations, std::int32_t v, std::size_t few)
{
  const TetComplex& c = operations.complex();
  const double least = sine2OfDegrees(usualAngle); // background may be worse than tissue may
  const std::vector<std::int32_t> star = operations.star(v);
  for (std::int32_t t : star)
  {
    if (c.labels[t] != 0) continue;
    if (tissuesAt(operations, v).size() > few) return;
    int sides = 0;
    Label tissue = 0;
    for (int i = 0; i < 4; ++i)
      if (c.isInterface(t, i)) ++sides, tissue = c.labels[c.neighbours[t][i]];
    if (sides >= 2) operations.relabel(t, tissue, least);
  }
}

/// The two labels at a vertex, that of fewer tetrahedra first, and the number of these tetrahedra.
struct TwoLabels
{
  Label fewer, more;
  std::size_t count;
};

/// Returns nothing if the number of labels at v is not two.
std::optional<TwoLabels> twoLabelsAt(GuardedOperations& operations, std::int32_t v)
{
  const TetComplex& c = operations.complex();
  const std::vector<std::int32_t>& star = operations.star(v);
  const Label a = c.labels[star.front()];
  Label b = a;
  std::size_t ofA = 0;
  for (std::int32_t t : star)
  {
    if (c.labels[t] == a) ++ofA;
    else if (b == a) b = c.labels[t];
    else if (c.labels[t] != b) return {};
  }
  if (b == a) return {};
  const std::size_t ofB = star.size() - ofA;
  return ofA < ofB ? TwoLabels{ a, b, ofA } : TwoLabels{ b, a, ofB };
}

/// Moves v towards its nearest sample, if it has any, as far as quality allows.
void pull(GuardedOperations& operations, std::int32_t v, double quality)
{
  const auto to = operations.nearestSampleOf(v);
  if (!to) return;
  const Vec3 from = operations.complex().points[v];
  quality = std::min(quality, operations.qualityAt(v));
  for (const double share : { 1.0, 0.7, 0.5, 0.35, 0.2, 0.1 })
    if (operations.move(v, from + share * (*to - from), quality)) return;
}

} // namespace

void removeEarsOfBlock(GuardedOperations& operations, std::size_t few)
{
  const TetComplex& c = operations.complex();
  for (std::int32_t v = 0; v < std::int32_t(c.points.size()); ++v)
    if (c.vertexTet[v] >= 0 && !c.locked[v] && c.onInterface[v] && isEar(operations, v, few))
      if (!takeOff(operations, v, 0, anyQuality)) fillBeside(operations, v, few);
}

void cutSpikesOfBlock(GuardedOperations& operations, const SpikeOptions& options)
{
  const TetComplex& c = operations.complex();
  const double least = sine2OfDegrees(options.keptAngle);
  for (std::int32_t v = 0; v < std::int32_t(c.points.size()); ++v)
  {
    if (c.vertexTet[v] < 0 || c.locked[v] || !c.onInterface[v]) continue;
    const auto labels = twoLabelsAt(operations, v);
    if (!labels || labels->count > options.few || !operations.isSpike(v, options.vertexDistance)) continue;
    operations.envelope().setLeastTolerance(
      std::min(options.maximumDistance, norm(*operations.nearestSampleOf(v) - c.points[v])));
    const bool isCut = takeOff(operations, v, labels->more, labels->more == 0 ? anyQuality : least);
    operations.envelope().setLeastTolerance(0);
    if (!isCut && options.pullAngle > 0) pull(operations, v, sine2OfDegrees(options.pullAngle));
  }
}

} // namespace surgicalmesher
