// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Mutual information of two images at sample points of the fixed one, and its maximisation over linear maps.

#include "ItkImage.h"
#include "LinearParameters.h"

#include <itkMattesMutualInformationImageToImageMetricv4.h>
#include <itkMultiThreaderBase.h>

#include <cstddef>

namespace surgicalmesher
{

/// Limits ITK filters and metrics created during its lifetime to one thread each.
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

  /// Construct and use within the lifetime of a SingleThread: with several ITK threads the sums depend on the order of
  /// summation. The images are only read, and must not be connected to a pipeline. Maps go from fixed points to moving
  /// ones.
  MutualInformation(const ItkImage* fixed, const ItkImage* moving, const Samples* samples, const Vec3& centre);

  /// Mutual information in nats; 0 if no sample falls in the moving image.
  double at(const LinearParameters& map);
  /// The same, with its gradient.
  double at(const LinearParameters& map, LinearParameters& gradient);
  /// Share of the samples that fell in the moving image at the last evaluation.
  double overlap() const;

  /// Returns the map at the local maximum reached by quasi-Newton steps from the chart's origin.
  LinearParameters maximise(const LinearChart& chart, int dimension);

private:
  using Metric = itk::MattesMutualInformationImageToImageMetricv4<ItkImage, ItkImage, ItkImage, double>;
  void set(const LinearParameters& map);

  Metric::Pointer m_Metric;
  std::size_t m_SampleCount = 0;
};

} // namespace surgicalmesher
