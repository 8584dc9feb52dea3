// SPDX-License-Identifier: Apache-2.0
#include "HeadImages.h"

#include "Errors.h"
#include "ItkImage.h"
#include "ThreadCount.h"

#include <itkBSplineControlPointImageFilter.h>
#include <itkN4BiasFieldCorrectionImageFilter.h>
#include <itkShrinkImageFilter.h>
#include <itkVectorGradientAnisotropicDiffusionImageFilter.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace surgicalmesher
{

namespace
{

constexpr float kAir = -500; // HU, halfway between air and soft tissue
constexpr std::size_t kMostChannels = 4;

using Mask = itk::Image<unsigned char, 3>;

bool isCt(const ScalarImage& image) { return *std::min_element(image.values.begin(), image.values.end()) < kAir; }

/// Centre (world) of the corner voxel that lies at the far end of the axes whose bits are set in `axes`.
Vec3 cornerOf(const Grid& grid, int axes)
{
  Vec3 p;
  for (int axis = 0; axis < 3; ++axis) p[axis] = (axes >> axis & 1) * (grid.size[axis] - 1) * grid.spacing[axis];
  return grid.gridToWorld(p);
}

bool isSameGrid(const Grid& a, const Grid& b)
{
  const double most = 0.01 * a.smallestSpacing();
  for (int axes = 0; axes < 8; ++axes)
    if (!(norm(cornerOf(a, axes) - cornerOf(b, axes)) < most)) return false;
  return a.size == b.size;
}

template <typename Image>
typename Image::Pointer shrunk(const typename Image::Pointer& image)
{
  constexpr unsigned factor = 4, leastVoxels = 2; // N4's spline needs an extent along every axis
  const auto size = image->GetLargestPossibleRegion().GetSize();
  const auto filter = itk::ShrinkImageFilter<Image, Image>::New();
  filter->SetInput(image);
  for (unsigned axis = 0; axis < 3; ++axis)
    filter->SetShrinkFactor(axis, std::clamp(unsigned(size[axis]) / leastVoxels, 1u, factor));
  filter->Update();
  return filter->GetOutput();
}

/// Returns the logarithm of the bias field at every voxel.
std::vector<float> logarithmOfBias(const Grid& grid, const std::vector<float>& values, const std::vector<bool>& head)
{
  using N4 = itk::N4BiasFieldCorrectionImageFilter<ItkImage, Mask, ItkImage>;
  std::vector<bool> counts = head; // N4 takes logarithms: only positive values count
  for (std::size_t n = 0; n < counts.size(); ++n) counts[n] = counts[n] && values[n] > 0;
  const auto image = asItkImage<ItkImage>(inGridFrame(grid), values);
  const OneWorkUnit ofOthersToo; // also for the filters that N4 creates: their sums depend on the number of work units
  const auto filter = N4::New();
  filter->SetInput(shrunk<ItkImage>(image));
  filter->SetMaskImage(shrunk<Mask>(asItkImage<Mask>(inGridFrame(grid), counts)));
  N4::VariableSizeArrayType iterations(2);
  iterations.Fill(40);
  filter->SetNumberOfFittingLevels(2);
  filter->SetMaximumNumberOfIterations(iterations);
  filter->SetConvergenceThreshold(0.001);
  filter->Update();

  using Spline = itk::BSplineControlPointImageFilter<N4::BiasFieldControlPointLatticeType, N4::ScalarImageType>;
  const auto spline = Spline::New();
  spline->SetInput(filter->GetLogBiasFieldControlPointLattice());
  spline->SetSplineOrder(filter->GetSplineOrder());
  spline->SetSize(image->GetLargestPossibleRegion().GetSize());
  spline->SetOrigin(image->GetOrigin());
  spline->SetDirection(image->GetDirection());
  spline->SetSpacing(image->GetSpacing());
  spline->Update();
  std::vector<float> result(values.size());
  const auto* found = spline->GetOutput()->GetBufferPointer();
  for (std::size_t n = 0; n < result.size(); ++n) result[n] = found[n][0];
  return result;
}

/// Standard deviation of white noise, from third differences of four neighbours along the first axis, which vanish for
/// smooth brightness.
double noiseOf(const ScalarImage& image)
{
  std::vector<float> left;
  const auto& size = image.grid.size;
  for (int k = 0; k < size[2]; k += 2)
    for (int j = 0; j < size[1]; j += 2)
      for (int i = 3; i < size[0]; i += 4)
      {
        const float* v = &image.values[image.grid.index(i - 3, j, k)];
        const float residual = v[0] - 3 * v[1] + 3 * v[2] - v[3];
        if (residual != 0) left.push_back(std::abs(residual));
      }
  if (left.empty()) return 0;
  std::nth_element(left.begin(), left.begin() + std::ptrdiff_t(left.size() / 2), left.end());
  constexpr double medianToDeviation = 1.4826, gainOfResidual = 4.472136; // sqrt(1 + 9 + 9 + 1)
  return medianToDeviation * left[left.size() / 2] / gainOfResidual;
}

/// Smooths the channels as one vector image in units of `noise`.
template <unsigned channelCount>
void denoiseTogether(HeadImages& images, const std::vector<double>& noise)
{
  using Pixel = itk::Vector<float, channelCount>;
  using Image = itk::Image<Pixel, 3>;
  const auto image = Image::New();
  typename Image::SizeType size;
  for (int axis = 0; axis < 3; ++axis) size[axis] = images.grid().size[axis];
  image->SetRegions(typename Image::RegionType(size));
  image->Allocate();
  Pixel* pixels = image->GetBufferPointer();
  const std::size_t count = images.grid().voxelCount();
  for (std::size_t n = 0; n < count; ++n)
    for (unsigned c = 0; c < channelCount; ++c) pixels[n][c] = float(images.channels[c].values[n] / noise[c]);
  const auto filter = itk::VectorGradientAnisotropicDiffusionImageFilter<Image, Image>::New();
  filter->SetInput(image);
  filter->SetNumberOfIterations(6);
  filter->SetTimeStep(0.0625);
  filter->SetUseImageSpacing(false);
  filter->SetFixedAverageGradientMagnitude(1);
  filter->SetConductanceParameter(2); // in units of the noise
  filter->Update();
  const Pixel* smooth = filter->GetOutput()->GetBufferPointer();
  for (unsigned c = 0; c < channelCount; ++c)
    for (std::size_t n = 0; n < count; ++n) images.channels[c].values[n] = float(smooth[n][c] * noise[c]);
}

} // namespace

HeadImages headImages(std::vector<ScalarImage> channels)
{
  if (channels.empty() || channels.size() > kMostChannels)
    throw InputError(std::to_string(channels.size()) + " images, expected one to " + std::to_string(kMostChannels));
  HeadImages images;
  for (std::size_t c = 0; c < channels.size(); ++c)
  {
    if (!isSameGrid(channels[0].grid, channels[c].grid))
      throw InputError("image " + std::to_string(c + 1) +
                       " lies on another grid than the first, expected images resampled "
                       "to one grid, as LocalRegistrationCLI does it");
    if (!isCt(channels[c])) continue;
    if (images.ct >= 0) throw InputError("two images have values below -500, expected one CT at most");
    images.ct = int(c);
  }
  images.channels = std::move(channels);
  return images;
}

void correctBias(HeadImages& images, const std::vector<bool>& head)
{
  for (std::size_t c = 0; c < images.channels.size(); ++c)
  {
    if (int(c) == images.ct) continue;
    std::vector<float>& values = images.channels[c].values;
    const std::vector<float> bias = logarithmOfBias(images.grid(), values, head);
    for (std::size_t n = 0; n < values.size(); ++n) values[n] /= std::exp(bias[n]);
  }
}

void denoise(HeadImages& images)
{
  std::vector<double> noise;
  for (const ScalarImage& channel : images.channels) noise.push_back(std::max(1e-6, noiseOf(channel)));
  switch (noise.size())
  {
  case 1: return denoiseTogether<1>(images, noise);
  case 2: return denoiseTogether<2>(images, noise);
  case 3: return denoiseTogether<3>(images, noise);
  default: return denoiseTogether<kMostChannels>(images, noise);
  }
}

} // namespace surgicalmesher
