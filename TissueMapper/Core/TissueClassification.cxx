// SPDX-License-Identifier: Apache-2.0
#include "TissueClassification.h"

#include "BrightnessModel.h"
#include "Errors.h"
#include "GeodesicFront.h"
#include "Place.h"
#include "Sampling.h"
#include "TextFile.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace surgicalmesher
{

namespace
{

std::vector<TrainingValues> trainingValues(const HeadImages& images, const std::vector<TissueClass>& classes)
{
  const Grid& grid = images.grid();
  std::vector<TrainingValues> training;
  for (const TissueClass& tissue : classes)
  {
    if (tissue.points.empty()) throw InputError("class " + tissue.name + " has no training point");
    training.emplace_back();
    for (const Vec3& point : tissue.points)
    {
      const Vec3 p = grid.worldToGrid(point);
      if (!isInVolume(grid, p))
        throw InputError("training point " + place(point) + " LPS of " + tissue.name +
                         " lies outside the image, expected a place in it");
      const std::array<int, 3> v = nearestVoxel(grid, p);
      training.back().emplace_back();
      for (const ScalarImage& channel : images.channels)
        training.back().back().push_back(channel.values[grid.index(v[0], v[1], v[2])]);
    }
  }
  return training;
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
  // What contiguity took from bone, no compartment of soft tissue could be asked to take.
  if (isBound(classes[bone]))
    throw InputError("contiguity or a limit for " + classes[bone].name + ", expected neither");
  return bone;
}

/// Returns the contrast of bone in one channel, where bone is darker than all soft tissue (in a CT: brighter).
BoneContrast boneContrast(const HeadImages& images, const std::vector<TrainingValues>& training, int bone,
                          const std::vector<TissueClass>& classes, std::size_t channel)
{
  const bool isCt = int(channel) == images.ct;
  const float sign = isCt ? -1 : 1; // treats the CT as if bone were dark
  const auto medianIn = [&](std::size_t c) { return sign * medianOf(valuesOf(training[c], channel)); };
  float boneMedian = medianIn(std::size_t(bone)), softMedian = std::numeric_limits<float>::infinity();
  for (std::size_t c = 0; c < training.size(); ++c)
    if (int(c) != bone) softMedian = std::min(softMedian, medianIn(c));
  if (!(boneMedian < softMedian))
    throw InputError("training points of " + classes[bone].name +
                     (isCt ? " are no denser than those of soft tissue, expected a CT in Hounsfield units"
                           : " are no darker than those of soft tissue, expected an MR image in which bone is dark"));
  BoneContrast contrast{ 0, sign * boneMedian, sign * softMedian };
  if (isCt)
  {
    contrast.threshold = 0.5f * (contrast.boneMedian + contrast.softMedian);
    return contrast;
  }
  // Threshold against the class next in brightness to bone, together with all classes whose medians are near it.
  std::vector<float> soft;
  for (std::size_t c = 0; c < training.size(); ++c)
  {
    if (int(c) == bone || medianIn(c) > softMedian + (softMedian - boneMedian)) continue;
    const std::vector<float> values = valuesOf(training[c], channel);
    soft.insert(soft.end(), values.begin(), values.end());
  }
  contrast.threshold = bestThreshold(valuesOf(training[bone], channel), soft);
  return contrast;
}

bool isAdmitted(Admission admission, Compartment compartment)
{
  if (admission == Admission::Anywhere) return true;
  if (admission == Admission::Intracranial) return compartment == Compartment::Intracranial;
  if (admission == Admission::Intraorbital) return compartment == Compartment::Intraorbital;
  return admission == Admission::Extracranial && compartment != Compartment::Intracranial;
}

/// Classes of soft tissue that a compartment admits; all of them if compartments are not used.
std::vector<int> admitted(const std::vector<TissueClass>& classes, Compartment compartment, bool useCompartments)
{
  std::vector<int> result;
  for (std::size_t c = 0; c < classes.size(); ++c)
  {
    const Admission admission = classes[c].admission;
    if (admission == Admission::Bone) continue;
    if (!useCompartments || isAdmitted(admission, compartment)) result.push_back(int(c));
  }
  if (result.empty())
    throw InputError("no class of soft tissue may lie " +
                     std::string(compartment == Compartment::Intracranial ? "within" : "outside") + " the skull");
  return result;
}

CompartmentSeeds seedsOf(const Grid& grid, const std::vector<TissueClass>& classes)
{
  CompartmentSeeds seeds;
  for (const TissueClass& tissue : classes)
  {
    if (tissue.admission == Admission::Anywhere || tissue.admission == Admission::Bone) continue;
    auto& voxels = tissue.admission == Admission::Intracranial   ? seeds.inside
                   : tissue.admission == Admission::Intraorbital ? seeds.orbital
                                                                 : seeds.outside;
    for (const Vec3& point : tissue.points) voxels.push_back(nearestVoxel(grid, grid.worldToGrid(point)));
  }
  if (seeds.inside.empty() || (seeds.outside.empty() && seeds.orbital.empty()))
  {
    throw InputError(std::string("no training point of a class ") + (seeds.inside.empty() ? "within" : "outside") +
                     " the skull, expected some on both sides, or no compartments");
  }
  return seeds;
}

/// Rejects images that are too thin for ITK's filters: recursive Gaussians, which find compartments and the head in a
/// CT, and N4.
void requireSize(const HeadImages& images, const ClassificationOptions& options)
{
  if (options.useCompartments || images.ct >= 0)
    requireVoxels(images.grid(), 4, images.ct >= 0 ? "in a CT" : "to find compartments");
  if (options.correctBias) requireVoxels(images.grid(), 2, "to correct bias");
}

std::vector<Compartment> withoutCompartments(const HeadSigns& signs)
{
  std::vector<Compartment> compartments;
  for (std::size_t n = 0; n < signs.head.size(); ++n)
    compartments.push_back(!signs.head[n]  ? Compartment::Background
                           : signs.bone[n] ? Compartment::Bone
                                           : Compartment::Extracranial);
  return compartments;
}

/// Brightness models of soft tissue: intracranial, extracranial, intraorbital.
using Models = std::array<BrightnessModel, 3>;

Models makeModels(const std::vector<TissueClass>& classes, const std::vector<TrainingValues>& training,
                  bool useCompartments)
{
  const auto model = [&](Compartment compartment)
  { return BrightnessModel(admitted(classes, compartment, useCompartments), training); };
  return { model(Compartment::Intracranial), model(Compartment::Extracranial), model(Compartment::Intraorbital) };
}

const BrightnessModel& modelOf(const Models& models, Compartment compartment)
{
  return models[std::size_t(compartment) - std::size_t(Compartment::Intracranial)];
}

/// Returns the voxels that contiguity and limit leave to a class: those that a front from its training points reaches
/// through its voxels. A front starts at each training point, whatever the class of the voxel there.
std::vector<bool> reachedByClass(const Grid& grid, const TissueClass& tissue, const std::vector<int>& classOf,
                                 int number)
{
  std::vector<bool> isOpen(classOf.size());
  for (std::size_t n = 0; n < classOf.size(); ++n) isOpen[n] = classOf[n] == number;
  std::vector<std::size_t> seeds;
  for (const Vec3& point : tissue.points)
  {
    const std::array<int, 3> v = nearestVoxel(grid, grid.worldToGrid(point));
    seeds.push_back(grid.index(v[0], v[1], v[2]));
    isOpen[seeds.back()] = true;
  }
  return reachedFrom(grid, seeds, isOpen, tissue.limit);
}

/// Squared distance (in units of 5 mm) from each voxel to the certain voxels of each class: those that the class's
/// front reaches, or, for a class without contiguity and limit, all that brightness assigns to it.
class Proximity
{
public:
  Proximity(const Grid& grid, const std::vector<TissueClass>& classes, const std::vector<int>& classOf)
  {
    for (std::size_t c = 0; c < classes.size(); ++c)
    {
      std::vector<bool> isCertain(classOf.size());
      if (isBound(classes[c])) isCertain = reachedByClass(grid, classes[c], classOf, int(c));
      else
        for (std::size_t n = 0; n < classOf.size(); ++n) isCertain[n] = classOf[n] == int(c);
      m_Distances.push_back(distanceTo(grid, isCertain));
    }
  }
  double operator()(int number, std::size_t voxel) const
  {
    constexpr double unit = 5; // mm
    const double distance = m_Distances[std::size_t(number)][voxel] / unit;
    return distance * distance;
  }

private:
  std::vector<std::vector<float>> m_Distances;
};

/// Reassigns voxels that contiguity or a limit takes from a class to the next class in brightness and proximity, until
/// every class reaches all its voxels. A voxel that all classes of its compartment have been refused keeps its last
/// class, as every voxel of the head has one.
void enforceContiguity(const HeadImages& images, const std::vector<TissueClass>& classes, const Models& models,
                       const std::optional<Proximity>& proximity, std::vector<int>& classOf, Classification& result)
{
  constexpr double never = std::numeric_limits<double>::infinity();
  std::vector<std::vector<bool>> isRefused(classes.size(), std::vector<bool>(classOf.size(), false));
  for (bool hasChanged = true; hasChanged;)
  {
    hasChanged = false;
    for (std::size_t c = 0; c < classes.size(); ++c)
    {
      if (!isBound(classes[c])) continue;
      const std::vector<bool> reached = reachedByClass(images.grid(), classes[c], classOf, int(c));
      for (std::size_t n = 0; n < classOf.size(); ++n)
      {
        if (classOf[n] != int(c) || reached[n] || isRefused[c][n]) continue;
        isRefused[c][n] = true;
        const auto penalty = [&](int other) {
          return isRefused[std::size_t(other)][n] ? never : proximity ? (*proximity)(other, n) : 0;
        };
        const int other = modelOf(models, result.compartments[n]).nearestClass(images, n, penalty);
        if (other < 0) continue;
        classOf[n] = other;
        ++result.invalidated[c];
        hasChanged = true;
      }
    }
  }
}

/// Returns, by class, the number of voxels that it has beyond its contiguity and limit.
std::vector<std::size_t> unreachedVoxels(const Grid& grid, const std::vector<TissueClass>& classes,
                                         const std::vector<int>& classOf)
{
  std::vector<std::size_t> counts(classes.size(), 0);
  for (std::size_t c = 0; c < classes.size(); ++c)
  {
    if (!isBound(classes[c])) continue;
    const std::vector<bool> reached = reachedByClass(grid, classes[c], classOf, int(c));
    for (std::size_t n = 0; n < classOf.size(); ++n) counts[c] += classOf[n] == int(c) && !reached[n];
  }
  return counts;
}

void addProbabilities(const HeadImages& images, const std::vector<int>& classOf, const Models& models, int bone,
                      Classification& result)
{
  result.probabilities.assign(result.invalidated.size(), std::vector<float>(classOf.size(), 0));
  for (std::size_t n = 0; n < classOf.size(); ++n)
  {
    if (classOf[n] < 0) continue;
    if (classOf[n] == bone)
    {
      result.probabilities[bone][n] = 1;
      continue;
    }
    const BrightnessModel& model = modelOf(models, result.compartments[n]);
    const std::vector<float> found = model.probabilities(images, n);
    for (std::size_t k = 0; k < found.size(); ++k) result.probabilities[model.classes()[k]][n] = found[k];
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
  if (has("eye") || has("optic nerve") || has("orbit") || has("ocular") || has("rectus"))
    return Admission::Intraorbital;
  if (has("fat") || has("muscle") || has("skin") || has("connective")) return Admission::Extracranial;
  return Admission::Anywhere;
}

TissueTable compartmentTable()
{
  TissueTable table;
  const auto add = [&](Compartment compartment, const char* name, const std::array<double, 3>& color)
  {
    Tissue& tissue = table[Label(compartment)];
    tissue.name = name;
    tissue.color = color;
  };
  add(Compartment::Bone, "bone", { 0.95, 0.85, 0.60 });
  add(Compartment::Intracranial, "intracranial", { 0.30, 0.60, 0.85 });
  add(Compartment::Extracranial, "extracranial", { 0.85, 0.45, 0.35 });
  add(Compartment::Intraorbital, "intraorbital", { 0.45, 0.75, 0.40 });
  return table;
}

Classification classifyTissues(HeadImages images, const std::vector<TissueClass>& classes,
                               const ClassificationOptions& options, const Progress& progress)
{
  if (classes.size() < 2) throw InputError("one class is trained, expected two or more");
  requireSize(images, options);
  std::vector<TrainingValues> training = trainingValues(images, classes);
  const int bone = boneClass(classes);
  const auto contrastIn = [&](std::size_t channel) { return boneContrast(images, training, bone, classes, channel); };
  const std::size_t boneChannel = images.ct >= 0 ? std::size_t(images.ct) : 0;
  const BoneContrast contrast = contrastIn(boneChannel);
  if (options.correctBias || options.denoise)
  {
    report(progress, 0, "bias and noise");
    if (options.correctBias) correctBias(images, headMask(images, contrast.threshold));
    if (options.denoise) denoise(images);
    training = trainingValues(images, classes);
  }
  const BoneContrast corrected = contrastIn(boneChannel);
  const std::size_t structural = std::size_t(&images.structural() - images.channels.data());
  const HeadSigns signs = headSigns(images, corrected, structural == boneChannel ? corrected : contrastIn(structural));
  const Models models = makeModels(classes, training, options.useCompartments);
  Classification result;
  result.boneThreshold = corrected.threshold;
  result.invalidated.assign(classes.size(), 0);
  result.unreached.assign(classes.size(), 0);
  result.compartments = options.useCompartments ? findCompartments(images, signs, seedsOf(images.grid(), classes),
                                                                   subProgress(progress, 0.2, 0.9))
                                                : withoutCompartments(signs);
  report(progress, 0.9, "tissues");
  std::vector<int> classOf(signs.head.size(), -1);
  for (std::size_t n = 0; n < classOf.size(); ++n)
  {
    if (result.compartments[n] == Compartment::Bone) classOf[n] = bone;
    else if (result.compartments[n] != Compartment::Background)
      classOf[n] = modelOf(models, result.compartments[n]).classOf(images, n);
  }
  if (options.useContiguity && std::any_of(classes.begin(), classes.end(), isBound))
  {
    std::optional<Proximity> proximity;
    if (options.useProximity) proximity.emplace(images.grid(), classes, classOf);
    enforceContiguity(images, classes, models, proximity, classOf, result);
    result.unreached = unreachedVoxels(images.grid(), classes, classOf);
  }
  if (options.withProbabilities) addProbabilities(images, classOf, models, bone, result);
  result.map.grid = images.grid();
  for (const int c : classOf) result.map.labels.push_back(c < 0 ? Label(0) : classes[std::size_t(c)].label);
  for (const TissueClass& tissue : classes) result.map.table[tissue.label].name = tissue.name;
  report(progress, 1, "tissues");
  return result;
}

} // namespace surgicalmesher
