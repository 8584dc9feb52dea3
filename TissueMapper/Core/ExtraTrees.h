// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Extremely randomised trees for two classes (Geurts, Ernst and Wehenkel, Machine Learning 63(1), 2006).

#include <array>
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

  /// Share of the trees' votes for the first class, in [0, 1].
  float probability(const float* features) const;

private:
  struct Node
  {
    int feature = -1; ///< of a leaf, -1
    float threshold = 0;
    int below = 0; ///< the other child is the next one
    float share = 0;
  };
  std::vector<Node> m_Nodes;
  std::vector<int> m_Roots;

  class Builder;
};

} // namespace surgicalmesher
