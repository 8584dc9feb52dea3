// SPDX-License-Identifier: Apache-2.0
#include "BrightnessModel.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace surgicalmesher
{

float medianOf(std::vector<float> values)
{
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 ? values[half] : 0.5f * (values[half - 1] + values[half]);
}

std::vector<float> valuesOf(const TrainingValues& training, std::size_t channel)
{
  std::vector<float> values;
  for (const std::vector<float>& point : training) values.push_back(point[channel]);
  return values;
}

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

BrightnessModel::BrightnessModel(std::vector<int> classes, const std::vector<TrainingValues>& training)
  : m_Classes(std::move(classes))
{
  const std::size_t channelCount = training[m_Classes.front()].front().size();
  const auto medianIn = [&](int c, std::size_t channel) { return medianOf(valuesOf(training[c], channel)); };
  std::stable_sort(m_Classes.begin(), m_Classes.end(), [&](int a, int b) { return medianIn(a, 0) < medianIn(b, 0); });
  m_Variances.assign(channelCount, 0);
  std::size_t count = 0;
  for (const int c : m_Classes)
  {
    m_Medians.emplace_back();
    for (std::size_t channel = 0; channel < channelCount; ++channel) m_Medians.back().push_back(medianIn(c, channel));
    for (const std::vector<float>& point : training[c])
      for (std::size_t channel = 0; channel < channelCount; ++channel)
        m_Variances[channel] += std::pow(double(point[channel]) - m_Medians.back()[channel], 2);
    count += training[c].size();
  }
  for (double& variance : m_Variances) variance = std::max(variance / double(count), 1e-12);
  for (std::size_t n = 1; channelCount == 1 && n < m_Classes.size(); ++n)
  {
    const float cut = bestThreshold(valuesOf(training[m_Classes[n - 1]], 0), valuesOf(training[m_Classes[n]], 0));
    m_Cuts.push_back(m_Cuts.empty() ? cut : std::max(cut, m_Cuts.back()));
  }
}

double BrightnessModel::distance2(std::size_t n, const HeadImages& images, std::size_t voxel) const
{
  double sum = 0;
  for (std::size_t channel = 0; channel < m_Variances.size(); ++channel)
    sum += std::pow(double(images.channels[channel].values[voxel]) - m_Medians[n][channel], 2) / m_Variances[channel];
  return sum;
}

int BrightnessModel::classOf(const HeadImages& images, std::size_t voxel) const
{
  if (m_Variances.size() > 1) return nearestClass(images, voxel, [](int) { return 0.0; });
  const float value = images.channels[0].values[voxel];
  return m_Classes[std::size_t(std::upper_bound(m_Cuts.begin(), m_Cuts.end(), value) - m_Cuts.begin())];
}

int BrightnessModel::nearestClass(const HeadImages& images, std::size_t voxel,
                                  const std::function<double(int)>& penalty) const
{
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < m_Classes.size(); ++n)
  {
    const double distance = penalty(m_Classes[n]) + distance2(n, images, voxel);
    if (!(distance < least)) continue;
    least = distance;
    best = m_Classes[n];
  }
  return best;
}

std::vector<float> BrightnessModel::probabilities(const HeadImages& images, std::size_t voxel) const
{
  std::vector<double> distances;
  for (std::size_t n = 0; n < m_Classes.size(); ++n) distances.push_back(distance2(n, images, voxel));
  const double least = *std::min_element(distances.begin(), distances.end());
  double sum = 0;
  for (double& distance : distances) sum += distance = std::exp(0.5 * (least - distance));
  std::vector<float> result;
  for (const double likelihood : distances) result.push_back(float(likelihood / sum));
  return result;
}

} // namespace surgicalmesher
