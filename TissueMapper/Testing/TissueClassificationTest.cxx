// SPDX-License-Identifier: Apache-2.0
#include "TissueClassification.h"

#include "Errors.h"
#include "GeodesicFront.h"
#include "HeadPhantom.h"
#include "Sampling.h"

#include <gtest/gtest.h>
#include <vtkSMPTools.h>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

double shareRight(const TissueMap& found, const TissueMap& truth)
{
  std::size_t head = 0, right = 0;
  for (std::size_t n = 0; n < truth.labels.size(); ++n)
  {
    head += truth.labels[n] != 0;
    right += truth.labels[n] != 0 && truth.labels[n] == found.labels[n];
  }
  return double(right) / double(head);
}

/// Voxels called `label` that are none.
std::size_t falsePositives(const TissueMap& found, const TissueMap& truth, Label label)
{
  std::size_t count = 0;
  for (std::size_t n = 0; n < truth.labels.size(); ++n) count += found.labels[n] == label && truth.labels[n] != label;
  return count;
}

std::vector<std::size_t> voxelsOf(const Grid& grid, const std::vector<Vec3>& points)
{
  std::vector<std::size_t> voxels;
  for (const Vec3& point : points)
  {
    const std::array<int, 3> v = nearestVoxel(grid, grid.worldToGrid(point));
    voxels.push_back(grid.index(v[0], v[1], v[2]));
  }
  return voxels;
}

/// Voxels of a class that a front from its training points does not reach through the class within its limit.
std::size_t unreachedOf(const TissueMap& found, const TissueClass& tissue)
{
  std::vector<bool> isOpen;
  for (const Label label : found.labels) isOpen.push_back(label == tissue.label);
  const std::vector<std::size_t> seeds = voxelsOf(found.grid, tissue.points);
  for (const std::size_t n : seeds) isOpen[n] = true;
  const std::vector<bool> reached = reachedFrom(found.grid, seeds, isOpen, tissue.limit);
  std::size_t count = 0;
  for (std::size_t n = 0; n < reached.size(); ++n) count += found.labels[n] == tissue.label && !reached[n];
  return count;
}

/// Paints the voxels nearer to `centre` than `radius`.
void paintBall(ScalarImage& image, const Vec3& centre, double radius, float value)
{
  const Grid& grid = image.grid;
  for (int k = 0; k < grid.size[2]; ++k)
    for (int j = 0; j < grid.size[1]; ++j)
      for (int i = 0; i < grid.size[0]; ++i)
      {
        if (norm(grid.gridToWorld({ double(i), double(j), double(k) }) - centre) < radius)
          image.values[grid.index(i, j, k)] = value;
      }
}

} // namespace

TEST(TissueClassification, PartsByPlaceWhatLooksAlike)
{
  const HeadPhantom head = headPhantom(3);
  const std::vector<TissueClass> classes = trainingOf(head.truth, 20);
  const Classification with = classifyTissues(headImages({ head.image }), classes, {});
  ClassificationOptions without;
  without.useCompartments = false;
  const Classification flat = classifyTissues(headImages({ head.image }), classes, without);
  EXPECT_GT(shareRight(with.map, head.truth), 0.97);
  for (const Label label : { 1, 5 }) // CSF and muscle: 70 % fewer
  {
    EXPECT_LT(double(falsePositives(with.map, head.truth, label)),
              0.3 * double(falsePositives(flat.map, head.truth, label)))
      << label;
  }
}

TEST(TissueClassification, NoClassIsWhereItIsNotAdmitted)
{
  const HeadPhantom head = headPhantom(6);
  const Classification found = classifyTissues(headImages({ head.image }), trainingOf(head.truth, 20), {});
  for (std::size_t n = 0; n < found.map.labels.size(); ++n)
  {
    const Label label = found.map.labels[n];
    const Compartment compartment = found.compartments[n];
    EXPECT_EQ(label == 0, compartment == Compartment::Background);
    EXPECT_EQ(label == 7, compartment == Compartment::Bone);
    EXPECT_EQ(label >= 1 && label <= 3, compartment == Compartment::Intracranial);
  }
}

TEST(TissueClassification, TheFrontStopsInAHoleOfTheSkull)
{
  const HeadPhantom head = headPhantom(2);
  const Classification found = classifyTissues(headImages({ head.image }), trainingOf(head.truth, 20), {});
  const Grid& grid = head.truth.grid;
  std::size_t leaked = 0;
  for (int k = 0; k < grid.size[2]; ++k)
    for (int j = 0; j < grid.size[1]; ++j)
      for (int i = 0; i < grid.size[0]; ++i)
      {
        const bool isBeyond = norm(grid.gridToWorld({ double(i), double(j), double(k) })) > 25;
        leaked += isBeyond && found.compartments[grid.index(i, j, k)] == Compartment::Intracranial;
      }
  EXPECT_LT(leaked, 20u);
}

TEST(TissueClassification, WhatBelongsInAnOrbitStaysNearItsPoints)
{
  HeadPhantom head = headPhantom(2);
  const Vec3 orbit{ 26, 0, 0 }, cheek{ 0, 0, 26 };
  for (const Vec3& centre : { orbit, cheek }) paintBall(head.image, centre, 2.5, 200);
  std::vector<TissueClass> classes = trainingOf(head.truth, 20);
  TissueClass eye;
  eye.name = "left eye";
  eye.label = 8;
  eye.admission = usualAdmission(eye.name);
  eye.points = { orbit, orbit + Vec3{ 0, 1, 0 }, orbit + Vec3{ 0, 0, 1 } };
  classes.push_back(eye);
  const Classification found = classifyTissues(headImages({ head.image }), classes, {});
  ClassificationOptions anywhere;
  anywhere.useCompartments = false;
  const Classification without = classifyTissues(headImages({ head.image }), classes, anywhere);
  const Grid& grid = head.truth.grid;
  const std::size_t inOrbit = voxelsOf(grid, { orbit })[0], inCheek = voxelsOf(grid, { cheek })[0];
  EXPECT_EQ(found.map.labels[inOrbit], 8);
  EXPECT_EQ(found.compartments[inOrbit], Compartment::Intraorbital);
  EXPECT_NE(found.map.labels[inCheek], 8);
  EXPECT_EQ(without.map.labels[inCheek], 8);
  for (std::size_t n = 0; n < found.compartments.size(); ++n)
  {
    const bool isInOrbit = found.compartments[n] == Compartment::Intraorbital;
    const Label label = found.map.labels[n];
    ASSERT_TRUE(isInOrbit || label != 8);
    ASSERT_TRUE(!isInOrbit || label > 3); // nothing of the brain
  }
  classes.back().points = { { 0, 0, 0 } }; // within the skull
  EXPECT_THROW(classifyTissues(headImages({ head.image }), classes, {}), InputError);
}

TEST(TissueClassification, ASmallHoleInTheSkinLetsNoAirIntoTheSkull)
{
  HeadPhantom head = headPhantom(0);
  const std::vector<TissueClass> classes = trainingOf(head.truth, 20);
  const Classification whole = classifyTissues(headImages({ head.image }), classes, {});
  for (double x = 22; x < 33; ++x) paintBall(head.image, { x, 0, 0 }, 2.6, 2); // air, as dark as bone
  const Classification holed = classifyTissues(headImages({ head.image }), classes, {});
  const auto bone = [](const Classification& found)
  { return std::count(found.compartments.begin(), found.compartments.end(), Compartment::Bone); };
  EXPECT_NEAR(double(bone(holed)), double(bone(whole)), 300);
}

TEST(TissueClassification, LimitsAndContiguityTakeAwayWhatIsNotReached)
{
  HeadPhantom head = headPhantom(0);
  // A ball of fat's brightness, apart from the rest of the fat.
  const Grid& grid = head.truth.grid;
  std::vector<std::size_t> island;
  for (int k = 0; k < grid.size[2]; ++k)
    for (int j = 0; j < grid.size[1]; ++j)
      for (int i = 0; i < grid.size[0]; ++i)
      {
        if (norm(grid.gridToWorld({ double(i), double(j), double(k) }) - Vec3{ 0, 26, 0 }) < 1.8)
          island.push_back(grid.index(i, j, k));
      }
  for (const std::size_t n : island) head.image.values[n] = 165;
  std::vector<TissueClass> classes = trainingOf(head.truth, 20);
  classes[3].isContiguous = true;
  const Classification found = classifyTissues(headImages({ head.image }), classes, {});
  for (const std::size_t n : island) EXPECT_NE(found.map.labels[n], 4);
  EXPECT_GE(found.invalidated[3], island.size());
  ClassificationOptions without;
  without.useContiguity = false;
  const Classification flat = classifyTissues(headImages({ head.image }), classes, without);
  for (const std::size_t n : island) EXPECT_EQ(flat.map.labels[n], 4);
  classes[3].points.resize(1);
  classes[3].limit = 5;
  const Classification near = classifyTissues(headImages({ head.image }), classes, {});
  for (int k = 0; k < grid.size[2]; ++k)
    for (int j = 0; j < grid.size[1]; ++j)
      for (int i = 0; i < grid.size[0]; ++i)
      {
        if (near.map.labels[grid.index(i, j, k)] != 4) continue;
        EXPECT_LE(norm(grid.gridToWorld({ double(i), double(j), double(k) }) - classes[3].points[0]), 5.01);
      }
}

TEST(TissueClassification, WhatOneClassLosesGoesToWhatIsNear)
{
  HeadPhantom head = headPhantom(14);
  const Vec3 scarPlace{ 0, 0, 26 }, island{ 0, 26, 0 };
  paintBall(head.image, scarPlace, 2.5, 150);
  paintBall(head.image, island, 1.8, 165); // as fat, and next to that as a scar; in muscle
  std::vector<TissueClass> classes = trainingOf(head.truth, 20);
  classes[3].isContiguous = true;
  TissueClass scar;
  scar.name = "scar";
  scar.label = 8;
  scar.admission = Admission::Extracranial;
  for (const double x : { -1, 0, 1 }) scar.points.push_back(scarPlace + Vec3{ x, 0, 0 });
  classes.push_back(scar);
  const std::size_t n = voxelsOf(head.truth.grid, { island })[0];
  ClassificationOptions anywhere;
  anywhere.useProximity = false;
  EXPECT_EQ(classifyTissues(headImages({ head.image }), classes, anywhere).map.labels[n], 8);
  EXPECT_EQ(classifyTissues(headImages({ head.image }), classes, {}).map.labels[n], 5);
}

TEST(TissueClassification, WhatOneClassLosesNoOtherHasWhereItIsNotReached)
{
  const HeadPhantom head = headPhantom(14); // noise scatters all classes
  std::vector<TissueClass> classes = trainingOf(head.truth, 20);
  for (const std::size_t c : { 0, 2, 3, 5 }) classes[c].isContiguous = true;
  const Classification found = classifyTissues(headImages({ head.image }), classes, {});
  for (const std::size_t c : { 0, 2, 3, 5 })
  {
    EXPECT_GT(found.invalidated[c], 0u) << classes[c].name;
    EXPECT_EQ(unreachedOf(found.map, classes[c]), 0u) << classes[c].name;
    EXPECT_EQ(found.unreached[c], 0u) << classes[c].name;
  }
}

TEST(TissueClassification, CountsWhatAllClassesHaveBeenRefused)
{
  const HeadPhantom head = headPhantom(14);
  std::vector<TissueClass> classes = trainingOf(head.truth, 20);
  for (std::size_t c = 3; c < 6; ++c)
  {
    classes[c].isContiguous = true; // all that lie outside the skull
    classes[c].limit = 10;
  }
  const Classification found = classifyTissues(headImages({ head.image }), classes, {});
  std::size_t sum = 0;
  for (std::size_t c = 3; c < 6; ++c)
  {
    EXPECT_EQ(found.unreached[c], unreachedOf(found.map, classes[c])) << classes[c].name;
    sum += found.unreached[c];
  }
  EXPECT_GT(sum, 0u);
}

TEST(TissueClassification, SeveralImagesPartMoreThanOne)
{
  const HeadPhantom head = headPhantom(12);
  const std::vector<TissueClass> classes = trainingOf(head.truth, 20);
  const double one = shareRight(classifyTissues(headImages({ head.image }), classes, {}).map, head.truth);
  const Classification both = classifyTissues(headImages({ head.image, ctOf(head, 15) }), classes, {});
  EXPECT_GT(shareRight(both.map, head.truth), one + 0.02);
  EXPECT_EQ(falsePositives(both.map, head.truth, 7), 0u) << "bone is what is dense";
  ClassificationOptions denoised;
  denoised.denoise = true;
  const Classification smooth = classifyTissues(headImages({ head.image, ctOf(head, 15) }), classes, denoised);
  EXPECT_GT(shareRight(smooth.map, head.truth), shareRight(both.map, head.truth));
}

TEST(TissueClassification, ACtAloneShowsBoneAndWhatLiesWithin)
{
  const HeadPhantom head = headPhantom(1);
  std::vector<TissueClass> classes = trainingOf(head.truth, 20);
  const Classification found = classifyTissues(headImages({ ctOf(head, 5) }), classes, {});
  std::size_t wrong = 0, inside = 0;
  for (std::size_t n = 0; n < head.truth.labels.size(); ++n)
  {
    EXPECT_EQ(found.map.labels[n] == 7, head.truth.labels[n] == 7);
    inside += head.truth.labels[n] == 2 || head.truth.labels[n] == 3;
    wrong +=
      (head.truth.labels[n] == 2 || head.truth.labels[n] == 3) && found.compartments[n] != Compartment::Intracranial;
  }
  EXPECT_LT(double(wrong), 0.01 * double(inside));
}

TEST(TissueClassification, ProbabilitiesAddUpToOne)
{
  const HeadPhantom head = headPhantom(6);
  ClassificationOptions options;
  options.withProbabilities = true;
  const Classification found = classifyTissues(headImages({ head.image }), trainingOf(head.truth, 20), options);
  ASSERT_EQ(found.probabilities.size(), 7u);
  for (std::size_t n = 0; n < found.map.labels.size(); ++n)
  {
    double sum = 0;
    for (const std::vector<float>& ofClass : found.probabilities) sum += ofClass[n];
    EXPECT_NEAR(sum, found.map.labels[n] == 0 ? 0 : 1, 1e-5);
  }
}

TEST(TissueClassification, IsTheSameOnOneThreadAndMany)
{
  const HeadPhantom head = headPhantom(4);
  const std::vector<TissueClass> classes = trainingOf(head.truth, 10);
  vtkSMPTools::Initialize(1);
  const Classification one = classifyTissues(headImages({ head.image }), classes, {});
  vtkSMPTools::Initialize(3);
  const Classification three = classifyTissues(headImages({ head.image }), classes, {});
  vtkSMPTools::Initialize();
  EXPECT_EQ(one.map.labels, three.map.labels);
}

TEST(TissueClassification, RefusesWhatItCanNotTellApart)
{
  const HeadPhantom head = headPhantom(2);
  const std::vector<TissueClass> classes = trainingOf(head.truth, 5);
  const auto expectRefused = [&](std::vector<TissueClass> changed)
  { EXPECT_THROW(classifyTissues(headImages({ head.image }), changed, {}), InputError); };
  expectRefused({ classes[0] });
  std::vector<TissueClass> changed = classes;
  changed[2].points.clear();
  expectRefused(changed);
  changed = classes;
  changed[2].points[0] = { 400, 0, 0 };
  expectRefused(changed);
  changed = classes;
  changed.pop_back(); // no bone
  expectRefused(changed);
  changed = classes;
  changed[5].admission = Admission::Bone; // two
  expectRefused(changed);
  changed = classes;
  changed[6].isContiguous = true; // no other class could take what is not reached
  expectRefused(changed);
  expectRefused({ classes[0], classes[1], classes[6] }); // nothing outside
  changed = classes;
  std::swap(changed[3].points, changed[6].points); // bone as bright as fat
  expectRefused(changed);
}
