// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Extremely randomised trees for two classes (Geurts, Ernst and Wehenkel, Machine Learning 63(1), 2006).

#include <array>
#include <cstddef>
#include <vector>

namespace surgicalmesher
{

/// Feature vectors, one row per sample.
using FeatureRows = std::vector<std::vector<float>>;

class ExtraTrees
{
public:
  /// Trains the forest. `isFirst`: whether each sample belongs to the first class. Both classes have the same total
  /// weight, whatever their sizes. The same samples give the same forest on any machine.
  ExtraTrees(const FeatureRows& samples, const std::vector<bool>& isFirst, int treeCount);

  /// Writes to `shares` the probability of the first class for each of `count` consecutive rows of features, in [0, 1]:
  /// the mean over the trees of the first class's share of the weight in the leaf reached.
  void probabilities(const float* rows, std::size_t count, float* shares) const;

private:
  struct Node
  {
    int feature = 0;
    float threshold = 0; ///< split threshold; in a leaf, the first class's share of the weight
    int below = 0;       ///< offset to the child for values below the threshold; 0 in a leaf
    int above = 0;
  };
  std::vector<Node> m_Nodes;
  std::vector<int> m_Roots;
  std::size_t m_FeatureCount;

  class Builder;
};

} // namespace surgicalmesher
