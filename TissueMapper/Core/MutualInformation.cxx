// SPDX-License-Identifier: Apache-2.0
#include "MutualInformation.h"

#include <itkAffineTransform.h>
#include <vnl/vnl_matrix.h>
#include <vnl/vnl_vector.h>

#include <cmath>

namespace surgicalmesher
{

namespace
{

using Vector = vnl_vector<double>;

/// Minimises a function by BFGS with backtracking: each step is shortened until the value falls enough (Armijo). f(x,
/// gradient) returns the value and sets the gradient; arguments are scaled so that steps of about 1 are reasonable. The
/// optimisers of VNL, translated from Fortran, keep their state in static variables and are not thread safe.
template <typename Function>
Vector leastOf(Function f, Vector x)
{
  constexpr double largestStep = 8;
  constexpr double smallestStep = 0.003;
  constexpr int steps = 60;
  const unsigned count = x.size();
  vnl_matrix<double> inverse(count, count);
  inverse.set_identity();
  bool isFresh = true;
  Vector gradient(count);
  double value = f(x, gradient);
  for (int step = 0; step < steps; ++step)
  {
    Vector move = -(inverse * gradient);
    const double length = move.two_norm();
    if (!(dot_product(move, gradient) < 0)) break;
    if (length > largestStep) move *= largestStep / length;
    Vector nextGradient(count);
    double next = f(x + move, nextGradient);
    while (next > value + 1e-4 * dot_product(move, gradient) && move.two_norm() > smallestStep)
    {
      move *= 0.4;
      next = f(x + move, nextGradient);
    }
    if (!(next < value))
    {
      if (isFresh) break;
      inverse.set_identity(); // the gradient jumps between voxels: the curvature found so far may mislead
      isFresh = true;
      continue;
    }
    const Vector change = nextGradient - gradient;
    const double curvature = dot_product(move, change);
    const bool isSmall = move.two_norm() < smallestStep;
    x += move;
    value = next;
    gradient = nextGradient;
    if (isSmall) break;
    if (curvature < 1e-10) // negative curvature: the minimum is farther away
    {
      inverse *= 3;
      continue;
    }
    if (isFresh) inverse *= curvature / dot_product(change, change);
    isFresh = false;
    const Vector turned = inverse * change;
    inverse += outer_product(move, move) * ((1 + dot_product(change, turned) / curvature) / curvature) -
               (outer_product(turned, move) + outer_product(move, turned)) / curvature;
  }
  return x;
}

} // namespace

MutualInformation::MutualInformation(const ItkImage* fixed, const ItkImage* moving, const Samples* samples,
                                     const Vec3& centre)
  : m_Metric(Metric::New()), m_SampleCount(samples->GetNumberOfPoints())
{
  using Affine = itk::AffineTransform<double, 3>;
  const auto transform = Affine::New();
  Affine::InputPointType point;
  for (int axis = 0; axis < 3; ++axis) point[axis] = centre[axis];
  transform->SetCenter(point);
  m_Metric->SetFixedImage(fixed);
  m_Metric->SetMovingImage(moving);
  m_Metric->SetVirtualDomainFromImage(fixed);
  m_Metric->SetFixedSampledPointSet(samples);
  m_Metric->SetUseSampledPointSet(true);
  m_Metric->SetUseFixedImageGradientFilter(false);
  m_Metric->SetUseMovingImageGradientFilter(false);
  m_Metric->SetNumberOfHistogramBins(40);
  m_Metric->SetMovingTransform(transform);
  m_Metric->Initialize();
}

void MutualInformation::set(const LinearParameters& map)
{
  Metric::ParametersType values(unsigned(map.size()));
  std::copy(map.begin(), map.end(), values.begin());
  m_Metric->SetParameters(values);
}

double MutualInformation::at(const LinearParameters& map)
{
  set(map);
  try
  {
    return -m_Metric->GetValue();
  }
  catch (const itk::ExceptionObject&)
  {
    return 0;
  }
}

double MutualInformation::at(const LinearParameters& map, LinearParameters& gradient)
{
  set(map);
  gradient.fill(0);
  try
  {
    Metric::MeasureType value = 0;
    Metric::DerivativeType derivative(unsigned(map.size()));
    m_Metric->GetValueAndDerivative(value, derivative);
    // ITK's derivative is the descent direction of its value, which is minus the information: the gradient of the
    // information.
    std::copy(derivative.begin(), derivative.end(), gradient.begin());
    return -value;
  }
  catch (const itk::ExceptionObject&)
  {
    return 0;
  }
}

double MutualInformation::overlap() const { return double(m_Metric->GetNumberOfValidPoints()) / double(m_SampleCount); }

LinearParameters MutualInformation::maximise(const LinearChart& chart, int dimension)
{
  constexpr double scale = 100; // information changes by some hundredths of a nat per mm
  constexpr double little = 1e-3;
  const auto loss = [&](const Vector& steps, Vector& gradient)
  {
    std::vector<double> at(steps.begin(), steps.end());
    LinearParameters slope;
    const double information = this->at(chart(at), slope);
    for (std::size_t n = 0; n < at.size(); ++n)
    {
      at[n] += little;
      const LinearParameters above = chart(at);
      at[n] -= 2 * little;
      const LinearParameters below = chart(at);
      at[n] += little;
      double sum = 0;
      for (std::size_t p = 0; p < slope.size(); ++p) sum += slope[p] * (above[p] - below[p]) / (2 * little);
      gradient[unsigned(n)] = -scale * sum;
    }
    return -scale * information;
  };
  const Vector steps = leastOf(loss, Vector(unsigned(dimension), 0));
  return chart({ steps.begin(), steps.end() });
}

} // namespace surgicalmesher
