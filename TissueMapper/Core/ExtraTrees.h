// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Extremely randomised trees for two classes (Geurts, Ernst and Wehenkel, Machine Learning 63(1), 2006).

#include <array>
#include <cstddef>
#include <vector>

namespace surgicalmesher
{

/// One row of features a sample.
using FeatureRows = std::vector<std::vector<float>>;

class ExtraTrees
{
public:
  /// `isFirst`: whether the sample is of the first class. Both classes weigh the same, whatever their numbers. The same
  /// forest for the same samples, on any machine.
  ExtraTrees(const FeatureRows& samples, const std::vector<bool>& isFirst, int treeCount);

  /// Of each of `count` rows of features that follow each other, the share of the trees' votes for the first class, in
  /// [0, 1].
  void probabilities(const float* rows, std::size_t count, float* shares) const;

private:
  struct Node
  {
    int feature = 0;
    float threshold = 0; ///< of a leaf, its share
    int below = 0;       ///< steps to the child of what is below the threshold; of a leaf, none
    int above = 0;
  };
  std::vector<Node> m_Nodes;
  std::vector<int> m_Roots;
  std::size_t m_FeatureCount;

  class Builder;
};

} // namespace surgicalmesher
