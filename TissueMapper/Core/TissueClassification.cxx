// SPDX-License-Identifier: Apache-2.0
#include "TissueClassification.h"

#include "Errors.h"
#include "Place.h"
#include "Sampling.h"
#include "TextFile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace surgicalmesher
{

namespace
{

float medianOf(std::vector<float> values)
{
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 ? values[half] : 0.5f * (values[half - 1] + values[half]);
}

/// The value between two samples that parts them with the least share of errors, each sample weighing the same; the
/// middle of the best stretch.
float bestThreshold(const std::vector<float>& lower, const std::vector<float>& upper)
{
  std::vector<float> cuts = lower;
  cuts.insert(cuts.end(), upper.begin(), upper.end());
  std::sort(cuts.begin(), cuts.end());
  double leastError = std::numeric_limits<double>::infinity();
  double sum = 0;
  int count = 0;
  for (std::size_t n = 1; n < cuts.size(); ++n)
  {
    const float cut = 0.5f * (cuts[n - 1] + cuts[n]);
    const auto share = [&](const std::vector<float>& sample, bool above)
    {
      const auto wrong = std::count_if(sample.begin(), sample.end(), [&](float v) { return (v > cut) == above; });
      return double(wrong) / double(sample.size());
    };
    const double error = share(lower, true) + share(upper, false);
    if (error > leastError + 1e-9) continue;
    if (error < leastError - 1e-9)
    {
      leastError = error;
      sum = 0;
      count = 0;
    }
    sum += cut;
    ++count;
  }
  return float(sum / count);
}

/// Values of the image at the training points, by class.
std::vector<std::vector<float>> trainingValues(const ScalarImage& image, const std::vector<TissueClass>& classes)
{
  std::vector<std::vector<float>> values;
  for (const TissueClass& tissue : classes)
  {
    if (tissue.points.empty()) throw InputError("class " + tissue.name + " has no training point");
    values.emplace_back();
    for (const Vec3& point : tissue.points)
    {
      const Vec3 p = image.grid.worldToGrid(point);
      if (!isInVolume(image.grid, p))
        throw InputError("training point " + place(point) + " LPS of " + tissue.name + " lies outside the image");
      const std::array<int, 3> v = nearestVoxel(image.grid, p);
      values.back().push_back(image.values[image.grid.index(v[0], v[1], v[2])]);
    }
  }
  return values;
}

int boneClass(const std::vector<TissueClass>& classes)
{
  int bone = -1;
  for (std::size_t c = 0; c < classes.size(); ++c)
  {
    if (classes[c].admission != Admission::Bone) continue;
    if (bone >= 0) throw InputError("two classes of bone, " + classes[bone].name + " and " + classes[c].name);
    bone = int(c);
  }
  if (bone < 0) throw InputError("no class of bone among the training points, expected one named skull or bone");
  return bone;
}

/// Against the class that is next in brightness, and all whose medians lie near it.
BoneContrast boneContrast(const std::vector<std::vector<float>>& values, int bone,
                          const std::vector<TissueClass>& classes)
{
  BoneContrast contrast;
  contrast.boneMedian = medianOf(values[bone]);
  contrast.softMedian = std::numeric_limits<float>::infinity();
  for (std::size_t c = 0; c < values.size(); ++c)
  {
    if (int(c) != bone) contrast.softMedian = std::min(contrast.softMedian, medianOf(values[c]));
  }
  if (!(contrast.boneMedian < contrast.softMedian))
  {
    throw InputError("training points of " + classes[bone].name +
                     " are no darker than those of soft tissue, expected an MR image in which bone is dark");
  }
  std::vector<float> soft;
  for (std::size_t c = 0; c < values.size(); ++c)
  {
    if (int(c) == bone || medianOf(values[c]) > contrast.softMedian + (contrast.softMedian - contrast.boneMedian))
      continue;
    soft.insert(soft.end(), values[c].begin(), values[c].end());
  }
  contrast.threshold = bestThreshold(values[bone], soft);
  return contrast;
}

/// Classes of one compartment by brightness: class n lies between cuts n - 1 and n.
struct Scale
{
  std::vector<int> classes; ///< darkest first
  std::vector<float> cuts;

  int classOf(float value) const
  {
    return classes[std::size_t(std::upper_bound(cuts.begin(), cuts.end(), value) - cuts.begin())];
  }
};

Scale scaleOf(const std::vector<int>& classes, const std::vector<std::vector<float>>& values)
{
  Scale scale{ classes, {} };
  std::stable_sort(scale.classes.begin(), scale.classes.end(),
                   [&](int a, int b) { return medianOf(values[a]) < medianOf(values[b]); });
  for (std::size_t n = 1; n < scale.classes.size(); ++n)
  {
    const float cut = bestThreshold(values[scale.classes[n - 1]], values[scale.classes[n]]);
    scale.cuts.push_back(scale.cuts.empty() ? cut : std::max(cut, scale.cuts.back()));
  }
  return scale;
}

/// Classes that may be in a compartment; every soft one if compartments don't count.
std::vector<int> admitted(const std::vector<TissueClass>& classes, Admission compartment, bool useCompartments)
{
  std::vector<int> result;
  for (std::size_t c = 0; c < classes.size(); ++c)
  {
    const Admission admission = classes[c].admission;
    if (admission == Admission::Bone) continue;
    if (!useCompartments || admission == Admission::Anywhere || admission == compartment) result.push_back(int(c));
  }
  return result;
}

CompartmentSeeds seedsOf(const Grid& grid, const std::vector<TissueClass>& classes)
{
  CompartmentSeeds seeds;
  for (const TissueClass& tissue : classes)
  {
    const bool isInside = tissue.admission == Admission::Intracranial;
    if (!isInside && tissue.admission != Admission::Extracranial) continue;
    for (const Vec3& point : tissue.points)
      (isInside ? seeds.inside : seeds.outside).push_back(nearestVoxel(grid, grid.worldToGrid(point)));
  }
  if (seeds.inside.empty() || seeds.outside.empty())
  {
    throw InputError(std::string("no training point of a class ") + (seeds.inside.empty() ? "within" : "outside") +
                     " the skull, expected some on both sides, or no compartments");
  }
  return seeds;
}

/// Voxels of a class that a front from its training points reaches through voxels of the class, within its limit (mm).
std::vector<bool> reachedFrom(const Grid& grid, const TissueClass& tissue, const std::vector<int>& classOf, int number)
{
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
  std::vector<float> way(classOf.size(), std::numeric_limits<float>::infinity());
  for (const Vec3& point : tissue.points)
  {
    const std::array<int, 3> v = nearestVoxel(grid, grid.worldToGrid(point));
    const std::size_t n = grid.index(v[0], v[1], v[2]);
    if (classOf[n] != number) continue;
    way[n] = 0;
    queue.push({ 0, n });
  }
  const double limit = tissue.limit > 0 ? tissue.limit : std::numeric_limits<double>::infinity();
  std::vector<bool> reached(classOf.size(), false);
  while (!queue.empty())
  {
    const auto [here, n] = queue.top();
    queue.pop();
    if (reached[n]) continue;
    reached[n] = true;
    const int i = int(n % grid.size[0]);
    const int j = int(n / grid.size[0] % grid.size[1]);
    const int k = int(n / (std::size_t(grid.size[0]) * grid.size[1]));
    for (int step = 0; step < 27; ++step)
    {
      const std::array<int, 3> d{ step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1 };
      if (!grid.contains(i + d[0], j + d[1], k + d[2])) continue;
      const std::size_t m = grid.index(i + d[0], j + d[1], k + d[2]);
      if (classOf[m] != number || reached[m]) continue;
      const double there = here + norm({ d[0] * grid.spacing.x, d[1] * grid.spacing.y, d[2] * grid.spacing.z });
      if (there > limit || !(there < way[m])) continue;
      way[m] = float(there);
      queue.push({ there, m });
    }
  }
  return reached;
}

/// Takes away what contiguity and limits forbid, class by class, and gives it to the class next in brightness.
void enforceContiguity(const ScalarImage& image, const std::vector<TissueClass>& classes,
                       const std::vector<Scale>& scaleByCompartment, const std::vector<Compartment>& compartments,
                       const std::vector<std::vector<float>>& values, std::vector<int>& classOf,
                       std::vector<std::size_t>& invalidated)
{
  for (std::size_t c = 0; c < classes.size(); ++c)
  {
    if (!classes[c].isContiguous && !(classes[c].limit > 0)) continue;
    const std::vector<bool> reached = reachedFrom(image.grid, classes[c], classOf, int(c));
    for (std::size_t n = 0; n < classOf.size(); ++n)
    {
      if (classOf[n] != int(c) || reached[n]) continue;
      ++invalidated[c];
      const Scale& scale = scaleByCompartment[compartments[n] == Compartment::Intracranial ? 0 : 1];
      int best = -1;
      float least = std::numeric_limits<float>::infinity();
      for (const int other : scale.classes)
      {
        const float difference = std::abs(image.values[n] - medianOf(values[other]));
        if (other == int(c) || !(difference < least)) continue;
        least = difference;
        best = other;
      }
      if (best >= 0) classOf[n] = best;
    }
  }
}

} // namespace

Admission usualAdmission(const std::string& name)
{
  std::string lower = text::lowerCase(name);
  std::replace(lower.begin(), lower.end(), '_', ' ');
  const auto has = [&](const char* part) { return lower.find(part) != std::string::npos; };
  if (has("skull") || has("bone")) return Admission::Bone;
  if (has("csf") || has("cerebrospinal") || has("grey matter") || has("gray matter") || has("white matter") ||
      has("brain"))
    return Admission::Intracranial;
  if (has("fat") || has("muscle") || has("skin") || has("connective")) return Admission::Extracranial;
  return Admission::Anywhere;
}

Classification classifyTissues(const ScalarImage& image, const std::vector<TissueClass>& classes,
                               const ClassificationOptions& options, const Progress& progress)
{
  if (classes.size() < 2) throw InputError("one class is trained, expected two or more");
  const std::vector<std::vector<float>> values = trainingValues(image, classes);
  const int bone = boneClass(classes);
  const BoneContrast contrast = boneContrast(values, bone, classes);
  Classification result;
  result.boneThreshold = contrast.threshold;
  result.invalidated.assign(classes.size(), 0);
  if (options.useCompartments)
  {
    result.compartments =
      findCompartments(image, contrast, seedsOf(image.grid, classes), subProgress(progress, 0, 0.9));
  }
  else
  {
    const std::vector<bool> head = headMask(image, contrast.threshold);
    for (std::size_t n = 0; n < head.size(); ++n)
    {
      const bool isDark = image.values[n] <= contrast.threshold;
      result.compartments.push_back(!head[n] ? Compartment::Background
                                    : isDark ? Compartment::Bone
                                             : Compartment::Extracranial);
    }
  }
  report(progress, 0.9, "tissues");
  const std::vector<int> inside = admitted(classes, Admission::Intracranial, options.useCompartments);
  const std::vector<int> outside = admitted(classes, Admission::Extracranial, options.useCompartments);
  if (inside.empty() || outside.empty()) throw InputError("no class of soft tissue is trained");
  const std::vector<Scale> scales{ scaleOf(inside, values), scaleOf(outside, values) };
  std::vector<int> classOf(image.values.size(), -1);
  for (std::size_t n = 0; n < classOf.size(); ++n)
  {
    if (result.compartments[n] == Compartment::Bone) classOf[n] = bone;
    else if (result.compartments[n] != Compartment::Background)
      classOf[n] = scales[result.compartments[n] == Compartment::Intracranial ? 0 : 1].classOf(image.values[n]);
  }
  if (options.useContiguity)
    enforceContiguity(image, classes, scales, result.compartments, values, classOf, result.invalidated);
  result.map.grid = image.grid;
  for (const int c : classOf) result.map.labels.push_back(c < 0 ? Label(0) : classes[std::size_t(c)].label);
  for (const TissueClass& tissue : classes) result.map.table[tissue.label].name = tissue.name;
  report(progress, 1, "tissues");
  return result;
}

} // namespace surgicalmesher
