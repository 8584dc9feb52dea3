// SPDX-License-Identifier: Apache-2.0
#include "ExtraTrees.h"

#include <gtest/gtest.h>

#include <random>

using namespace surgicalmesher;

namespace
{

/// Points of the unit square, of the first class within a disc; a third feature says nothing.
void drawDisc(int count, unsigned seed, FeatureRows& samples, std::vector<bool>& isFirst)
{
  std::mt19937 random(seed);
  const auto uniform = [&] { return float(random()) / 4294967296.f; };
  for (int n = 0; n < count; ++n)
  {
    samples.push_back({ uniform(), uniform(), uniform() });
    const float x = samples.back()[0] - 0.5f;
    const float y = samples.back()[1] - 0.5f;
    isFirst.push_back(x * x + y * y < 0.1f);
  }
}

std::vector<float> probabilitiesOf(const ExtraTrees& trees, const FeatureRows& samples)
{
  std::vector<float> rows, shares(samples.size());
  for (const std::vector<float>& sample : samples) rows.insert(rows.end(), sample.begin(), sample.end());
  trees.probabilities(rows.data(), samples.size(), shares.data());
  return shares;
}

} // namespace

TEST(ExtraTrees, LearnsADiscThatNoSingleFeatureTells)
{
  FeatureRows samples, others;
  std::vector<bool> isFirst, isTrue;
  drawDisc(400, 1, samples, isFirst);
  drawDisc(1000, 2, others, isTrue);
  const ExtraTrees trees(samples, isFirst, 100);
  int right = 0;
  const std::vector<float> shares = probabilitiesOf(trees, others);
  for (std::size_t n = 0; n < others.size(); ++n) right += (shares[n] > 0.5f) == isTrue[n];
  EXPECT_GT(right, 900);
}

TEST(ExtraTrees, KnowsItsSamplesAndWeighsClassesAlike)
{
  const FeatureRows samples{ { 0 }, { 1 }, { 2 }, { 3 }, { 10 } };
  const std::vector<bool> isFirst{ false, false, false, false, true };
  const ExtraTrees trees(samples, isFirst, 50);
  EXPECT_EQ(probabilitiesOf(trees, samples), std::vector<float>({ 0, 0, 0, 0, 1 }));
  const FeatureRows same{ { 1 }, { 1 }, { 1 }, { 1 } };
  EXPECT_FLOAT_EQ(probabilitiesOf(ExtraTrees(same, { true, false, false, false }, 3), same).back(), 0.5f);
}

TEST(ExtraTrees, SaysTheSameOfARowWhateverRowsAreBesideIt)
{
  FeatureRows samples, others;
  std::vector<bool> isFirst, isTrue;
  drawDisc(100, 1, samples, isFirst);
  drawDisc(37, 2, others, isTrue);
  const ExtraTrees trees(samples, isFirst, 20);
  const std::vector<float> together = probabilitiesOf(trees, others);
  for (std::size_t n = 0; n < others.size(); ++n) EXPECT_EQ(together[n], probabilitiesOf(trees, { others[n] })[0]);
}
