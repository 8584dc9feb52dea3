// SPDX-License-Identifier: Apache-2.0
#include "ExtraTrees.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace surgicalmesher
{

class ExtraTrees::Builder
{
public:
  Builder(ExtraTrees& forest, const FeatureRows& samples, const std::vector<bool>& isFirst)
    : m_Forest(forest), m_Samples(samples), m_IsFirst(isFirst)
  {
    const double count = double(samples.size());
    const double first = double(std::count(isFirst.begin(), isFirst.end(), true));
    m_Weight[1] = first > 0 ? 0.5 * count / first : 0;
    m_Weight[0] = first < count ? 0.5 * count / (count - first) : 0;
  }

  int build(std::vector<int> members)
  {
    const int number = int(m_Forest.m_Nodes.size());
    m_Forest.m_Nodes.push_back({});
    const std::array<double, 2> weight = weightsOf(members);
    m_Forest.m_Nodes[number].threshold = float(weight[1] / (weight[0] + weight[1]));
    Split best;
    if (weight[0] > 0 && weight[1] > 0) best = bestSplit(members, weight);
    if (best.feature < 0) return number;
    const auto middle = std::stable_partition(members.begin(), members.end(),
                                              [&](int n) { return m_Samples[n][best.feature] < best.threshold; });
    const std::vector<int> below(members.begin(), middle);
    const int stepsAbove = build(std::vector<int>(middle, members.end())) - number;
    const int stepsBelow = build(below) - number;
    m_Forest.m_Nodes[number] = { best.feature, best.threshold, stepsBelow, stepsAbove };
    return number;
  }

private:
  struct Split
  {
    int feature = -1;
    float threshold = 0;
    double impurity = 1e300;
  };

  std::array<double, 2> weightsOf(const std::vector<int>& members) const
  {
    std::array<double, 2> weight{ 0, 0 };
    for (const int n : members) weight[m_IsFirst[n]] += m_Weight[m_IsFirst[n]];
    return weight;
  }

  /// Uniform in [0, 1). Uses the generator's bits directly, as the distributions of the standard library differ between
  /// platforms.
  double uniform() { return double(m_Random()) / 4294967296.0; }

  Split bestSplit(const std::vector<int>& members, const std::array<double, 2>& whole)
  {
    const int features = int(m_Samples.front().size());
    const int tries = std::max(1, int(std::lround(std::sqrt(double(features)))));
    Split best;
    int tried = 0;
    for (int attempt = 0; attempt < 4 * features && tried < tries; ++attempt)
    {
      const int feature = std::min(features - 1, int(uniform() * features));
      float low = m_Samples[members.front()][feature];
      float high = low;
      for (const int n : members)
      {
        low = std::min(low, m_Samples[n][feature]);
        high = std::max(high, m_Samples[n][feature]);
      }
      if (!(low < high)) continue;
      ++tried;
      const float threshold = std::max(std::nextafter(low, high), float(low + uniform() * (double(high) - low)));
      std::array<double, 2> below{ 0, 0 };
      for (const int n : members)
      {
        if (m_Samples[n][feature] < threshold) below[m_IsFirst[n]] += m_Weight[m_IsFirst[n]];
      }
      const double impurity = gini(below[0], below[1]) + gini(whole[0] - below[0], whole[1] - below[1]);
      if (impurity < best.impurity) best = { feature, threshold, impurity };
    }
    return best;
  }

  static double gini(double a, double b) { return a + b > 0 ? 2 * a * b / (a + b) : 0; }

  ExtraTrees& m_Forest;
  const FeatureRows& m_Samples;
  const std::vector<bool>& m_IsFirst;
  std::array<double, 2> m_Weight;
  std::mt19937 m_Random{ 1 };
};

ExtraTrees::ExtraTrees(const FeatureRows& samples, const std::vector<bool>& isFirst, int treeCount)
  : m_FeatureCount(samples.front().size())
{
  std::vector<int> all(samples.size());
  for (std::size_t n = 0; n < all.size(); ++n) all[n] = int(n);
  Builder builder(*this, samples, isFirst);
  for (int tree = 0; tree < treeCount; ++tree) m_Roots.push_back(builder.build(all));
}

// A bundle of rows descends each tree in lockstep, without branches, so that memory latency and branch mispredictions
// are hidden.
void ExtraTrees::probabilities(const float* rows, std::size_t count, float* shares) const
{
  constexpr std::size_t together = 16;
  for (std::size_t first = 0; first < count; first += together)
  {
    const std::size_t rowCount = std::min(together, count - first);
    std::array<float, together> sums{};
    for (const int root : m_Roots)
    {
      std::array<const Node*, together> nodes;
      nodes.fill(&m_Nodes[std::size_t(root)]);
      for (int steps = 1; steps != 0;)
      {
        steps = 0;
        for (std::size_t r = 0; r < rowCount; ++r)
        {
          const Node& node = *nodes[r];
          const bool isBelow = rows[(first + r) * m_FeatureCount + std::size_t(node.feature)] < node.threshold;
          const int step = isBelow ? node.below : node.above;
          nodes[r] += step;
          steps |= step;
        }
      }
      for (std::size_t r = 0; r < rowCount; ++r) sums[r] += nodes[r]->threshold;
    }
    for (std::size_t r = 0; r < rowCount; ++r) shares[first + r] = sums[r] / float(m_Roots.size());
  }
}

} // namespace surgicalmesher
