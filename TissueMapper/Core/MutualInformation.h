// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Mutual information of two images at samples of the fixed one, and its maximum over linear maps.

#include "ItkImage.h"
#include "LinearParameters.h"

#include <itkMattesMutualInformationImageToImageMetricv4.h>
#include <itkMultiThreaderBase.h>

#include <cstddef>

namespace surgicalmesher
{

/// While it lives, the filters and metrics of ITK that are made use one thread each.
class SingleThread
{
public:
  SingleThread() : m_Before(itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads())
  {
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(1);
  }
  ~SingleThread() { itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(m_Before); }
  SingleThread(const SingleThread&) = delete;
  void operator=(const SingleThread&) = delete;

private:
  itk::ThreadIdType m_Before;
};

class MutualInformation
{
public:
  using Samples = itk::PointSet<float, 3>;

  /// Construct and use it within a SingleThread: what several threads of ITK add up depends on which comes first. The
  /// images are read only, and must have no pipeline behind them. Maps are from fixed points to moving ones.
  MutualInformation(const ItkImage* fixed, const ItkImage* moving, const Samples* samples, const Vec3& centre);

  /// In nats; 0 where no sample meets the moving image.
  double at(const LinearParameters& map);
  /// In nats, with its gradient.
  double at(const LinearParameters& map, LinearParameters& gradient);
  /// Share of the samples that met the moving image when it was last evaluated.
  double overlap() const;

  /// The map of the nearest maximum, from that of no step on, by quasi-Newton steps.
  LinearParameters maximise(const LinearChart& chart, int dimension);

private:
  using Metric = itk::MattesMutualInformationImageToImageMetricv4<ItkImage, ItkImage, ItkImage, double>;
  void set(const LinearParameters& map);

  Metric::Pointer m_Metric;
  std::size_t m_SampleCount = 0;
};

} // namespace surgicalmesher
