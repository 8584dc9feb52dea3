// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How bright classes are, as their training points show it.

#include "HeadImages.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace surgicalmesher
{

/// Values at the training points of a class: by point, of all channels.
using TrainingValues = std::vector<std::vector<float>>;

float medianOf(std::vector<float> values);

/// Of one channel.
std::vector<float> valuesOf(const TrainingValues& training, std::size_t channel);

/// The value between two samples that parts them with the least share of errors, each sample weighing the same; the
/// middle of the best stretch.
float bestThreshold(const std::vector<float>& lower, const std::vector<float>& upper);

/// The classes of one compartment. In one channel they are parted by thresholds of least error between neighbours in
/// brightness; in several, each is a Gaussian around its medians, with the variances that all have together.
class BrightnessModel
{
public:
  /// `training` by class; `classes` are those admitted here, one at least.
  BrightnessModel(std::vector<int> classes, const std::vector<TrainingValues>& training);

  int classOf(const HeadImages& images, std::size_t voxel) const;
  /// The class of the least sum of its squared distance in brightness, in deviations, and its penalty; -1 if every
  /// penalty is infinite.
  int nearestClass(const HeadImages& images, std::size_t voxel, const std::function<double(int)>& penalty) const;
  /// Of the classes admitted here, in the order of classes(); they add up to 1.
  std::vector<float> probabilities(const HeadImages& images, std::size_t voxel) const;
  const std::vector<int>& classes() const { return m_Classes; }

private:
  double distance2(std::size_t n, const HeadImages& images, std::size_t voxel) const;

  std::vector<int> m_Classes;                ///< in one channel, the darkest first
  std::vector<float> m_Cuts;                 ///< class n lies between cuts n - 1 and n
  std::vector<std::vector<float>> m_Medians; ///< by class and channel
  std::vector<double> m_Variances;           ///< by channel
};

} // namespace surgicalmesher
