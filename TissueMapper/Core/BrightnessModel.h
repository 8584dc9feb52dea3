// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Brightness statistics of tissue classes, estimated from their training points.

#include "HeadImages.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace surgicalmesher
{

/// Values at the training points of one class, indexed by point, then channel.
using TrainingValues = std::vector<std::vector<float>>;

float medianOf(std::vector<float> values);

/// Returns the values of all training points in one channel.
std::vector<float> valuesOf(const TrainingValues& training, std::size_t channel);

/// Returns the threshold between two samples with the least error, where each sample weighs the same whatever its size.
/// Candidates are the midpoints between neighbouring values; the mean of all equally good ones is returned.
float bestThreshold(const std::vector<float>& lower, const std::vector<float>& upper);

/// Brightness model of the classes that one compartment admits. With one channel, classes that are neighbours in
/// brightness are separated by the threshold of least error; with several channels, each class is a Gaussian around its
/// medians, with variances per channel that all classes share.
class BrightnessModel
{
public:
  /// `training` is indexed by class; `classes` are the classes that the compartment admits, at least one.
  BrightnessModel(std::vector<int> classes, const std::vector<TrainingValues>& training);

  int classOf(const HeadImages& images, std::size_t voxel) const;
  /// Returns the class with the least sum of penalty(class) and squared distance in brightness (in units of the
  /// variances); -1 if every penalty is infinite.
  int nearestClass(const HeadImages& images, std::size_t voxel, const std::function<double(int)>& penalty) const;
  /// Returns the probabilities of the admitted classes in the order of classes(); they sum to 1.
  std::vector<float> probabilities(const HeadImages& images, std::size_t voxel) const;
  const std::vector<int>& classes() const { return m_Classes; }

private:
  double distance2(std::size_t n, const HeadImages& images, std::size_t voxel) const;

  std::vector<int> m_Classes;                ///< with one channel, the darkest first
  std::vector<float> m_Cuts;                 ///< one channel only: class n lies between cuts n - 1 and n
  std::vector<std::vector<float>> m_Medians; ///< by class and channel
  std::vector<double> m_Variances;           ///< by channel
};

} // namespace surgicalmesher
