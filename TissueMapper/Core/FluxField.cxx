// SPDX-License-Identifier: Apache-2.0
#include "FluxField.h"

#include <vnl/algo/vnl_fft_1d.h>
#include <vtkSMPTools.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace surgicalmesher
{

namespace
{

using Complex = std::complex<float>;

constexpr double pi = 3.14159265358979323846;
constexpr int padding = 8; ///< least distance (voxels) between the image's end and its periodic repetition

/// Returns the least length of at least `minimum` without prime factors other than 2, 3 and 5.
int transformLength(int minimum)
{
  for (int length = minimum;; ++length)
  {
    int rest = length;
    for (const int prime : { 2, 3, 5 })
    {
      while (rest % prime == 0) rest /= prime;
    }
    if (rest == 1) return length;
  }
}

std::array<int, 3> transformSize(const std::array<int, 3>& size)
{
  return { transformLength(size[0] + padding), transformLength(size[1] + padding), transformLength(size[2] + padding) };
}

/// A complex array that is transformed along one axis after the other.
struct Spectrum
{
  std::array<int, 3> size;
  std::vector<Complex> data;

  std::size_t stride(int axis) const
  {
    return axis == 0 ? 1 : axis == 1 ? std::size_t(size[0]) : std::size_t(size[0]) * size[1];
  }
};

/// Start of the n-th line along `axis`.
std::size_t lineStart(const Spectrum& spectrum, int axis, vtkIdType n)
{
  const vtkIdType width = axis == 0 ? spectrum.size[1] : spectrum.size[0];
  const int first = axis == 0 ? 1 : 0;
  const int second = axis == 2 ? 1 : 2;
  return std::size_t(n % width) * spectrum.stride(first) + std::size_t(n / width) * spectrum.stride(second);
}

/// Discrete Fourier transform of all lines along one axis; direction -1: forward, 1: backward. Neither is normalised.
void transformAlong(Spectrum& spectrum, int axis, int direction)
{
  constexpr int bundle = 16; // lines processed together: for axes 1 and 2 they are neighbours in memory
  const int length = spectrum.size[axis];
  const std::size_t stride = spectrum.stride(axis);
  const vtkIdType lines = vtkIdType(spectrum.data.size()) / length;
  const auto transformLines = [&](vtkIdType begin, vtkIdType end)
  {
    vnl_fft_1d<float> fft(length);
    std::vector<Complex> buffer(std::size_t(length) * bundle);
    for (vtkIdType first = begin * bundle; first < std::min(end * bundle, lines); first += bundle)
    {
      const int count = int(std::min<vtkIdType>(bundle, lines - first));
      std::array<std::size_t, bundle> start{};
      for (int n = 0; n < count; ++n) start[n] = lineStart(spectrum, axis, first + n);
      for (int i = 0; i < length; ++i)
      {
        for (int n = 0; n < count; ++n) buffer[std::size_t(n) * length + i] = spectrum.data[start[n] + i * stride];
      }
      for (int n = 0; n < count; ++n) fft.transform(buffer.data() + std::size_t(n) * length, direction);
      for (int i = 0; i < length; ++i)
      {
        for (int n = 0; n < count; ++n) spectrum.data[start[n] + i * stride] = buffer[std::size_t(n) * length + i];
      }
    }
  };
  vtkSMPTools::For(0, (lines + bundle - 1) / bundle, 8, transformLines);
}

void transform(Spectrum& spectrum, int direction)
{
  for (int axis = 0; axis < 3; ++axis) transformAlong(spectrum, axis, direction);
}

/// Fills the lines along `axis` beyond `length` voxels by linear blending, so that the periodic image has no step at
/// its ends.
void closeAlong(Spectrum& spectrum, int axis, int length)
{
  const int whole = spectrum.size[axis];
  const std::size_t stride = spectrum.stride(axis);
  const vtkIdType lines = vtkIdType(spectrum.data.size()) / whole;
  for (vtkIdType n = 0; n < lines; ++n)
  {
    const std::size_t start = lineStart(spectrum, axis, n);
    const Complex last = spectrum.data[start + (length - 1) * stride];
    const Complex first = spectrum.data[start];
    for (int i = length; i < whole; ++i)
    {
      const float t = float(i - length + 1) / float(whole - length + 1);
      spectrum.data[start + i * stride] = (1 - t) * last + t * first;
    }
  }
}

/// Returns the padded image minus its mean, which leaves single precision to the variations.
Spectrum paddedImage(const ScalarImage& image)
{
  const std::array<int, 3>& size = image.grid.size;
  Spectrum spectrum{ transformSize(size), {} };
  spectrum.data.resize(std::size_t(spectrum.size[0]) * spectrum.size[1] * spectrum.size[2]);
  double sum = 0;
  for (const float value : image.values) sum += value;
  const float offset = float(sum / double(image.values.size()));
  for (int k = 0; k < size[2]; ++k)
  {
    for (int j = 0; j < size[1]; ++j)
    {
      const float* row = image.values.data() + image.grid.index(0, j, k);
      Complex* out = spectrum.data.data() + j * spectrum.stride(1) + k * spectrum.stride(2);
      for (int i = 0; i < size[0]; ++i) out[i] = row[i] - offset;
    }
  }
  for (int axis = 0; axis < 3; ++axis) closeAlong(spectrum, axis, size[axis]);
  return spectrum;
}

/// Returns -R dM/dR of a blurred wave of this wave number, relative to the amplitude of the wave.
double fluxTransfer(double waveNumber, double radius)
{
  const double x = waveNumber * radius;
  const double blur = waveNumber * sphereBlur(radius);
  return (x < 1e-4 ? x * x / 3 : std::sin(x) / x - std::cos(x)) * std::exp(-0.5 * blur * blur);
}

/// fluxTransfer() tabulated over the square of the wave number.
class TransferTable
{
public:
  TransferTable(double radius, double largestSquare) : m_Step(largestSquare / (count - 2)), m_Values(count)
  {
    for (int n = 0; n < count; ++n) m_Values[n] = float(fluxTransfer(std::sqrt(n * m_Step), radius));
  }
  float operator()(double square) const
  {
    const double index = square / m_Step;
    const int n = int(index);
    const float t = float(index - n);
    return (1 - t) * m_Values[n] + t * m_Values[n + 1];
  }

private:
  static constexpr int count = 16384;
  double m_Step;
  std::vector<float> m_Values;
};

/// Squares of the wave numbers (1/mm) along one axis, by index.
std::vector<double> squaredWaveNumbers(int length, double spacing)
{
  std::vector<double> squares(length);
  for (int n = 0; n < length; ++n)
  {
    const int wave = std::min(n, length - n);
    const double k = 2 * pi * wave / (length * spacing);
    squares[n] = k * k;
  }
  return squares;
}

/// Computes the flux of two radii with one transform: both transfer functions are real and even, so one flux becomes
/// the real part and the other the imaginary part.
void computePair(const Spectrum& image, const Grid& grid, double first, double second, Spectrum& work,
                 std::vector<float>& firstFlux, std::vector<float>& secondFlux)
{
  std::array<std::vector<double>, 3> squares;
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    squares[axis] = squaredWaveNumbers(image.size[axis], grid.spacing[axis]);
    largest += *std::max_element(squares[axis].begin(), squares[axis].end());
  }
  const TransferTable a(sphereRadius(first), largest);
  const TransferTable b(sphereRadius(second), largest);
  const float scale = 1 / float(image.data.size());
  vtkSMPTools::For(0, vtkIdType(image.size[1]) * image.size[2], 64,
                   [&](vtkIdType begin, vtkIdType end)
                   {
                     for (vtkIdType row = begin; row < end; ++row)
                     {
                       const double rest = squares[1][row % image.size[1]] + squares[2][row / image.size[1]];
                       const std::size_t start = std::size_t(row) * image.size[0];
                       for (int i = 0; i < image.size[0]; ++i)
                       {
                         const double square = squares[0][i] + rest;
                         work.data[start + i] = image.data[start + i] * Complex(scale * a(square), scale * b(square));
                       }
                     }
                   });
  transform(work, 1);
  for (int k = 0; k < grid.size[2]; ++k)
  {
    for (int j = 0; j < grid.size[1]; ++j)
    {
      const Complex* row = work.data.data() + j * work.stride(1) + k * work.stride(2);
      const std::size_t out = grid.index(0, j, k);
      for (int i = 0; i < grid.size[0]; ++i)
      {
        firstFlux[out + i] = row[i].real();
        secondFlux[out + i] = row[i].imag();
      }
    }
  }
}

} // namespace

double sphereRadius(double tubeRadius) { return std::sqrt(2.0) * tubeRadius; }

double sphereBlur(double sphereRadius) { return 0.25 * sphereRadius; }

std::vector<double> radiiBetween(double smallest, double largest, int count)
{
  if (count < 2 || !(largest > smallest)) return { smallest };
  std::vector<double> radii(count);
  for (int n = 0; n < count; ++n) radii[n] = smallest * std::pow(largest / smallest, double(n) / (count - 1));
  return radii;
}

double fluxMemory(const std::array<int, 3>& size, std::size_t radii)
{
  const std::array<int, 3> padded = transformSize(size);
  const double voxels = double(size[0]) * size[1] * size[2];
  return 2.0 * sizeof(Complex) * padded[0] * padded[1] * padded[2] + double(sizeof(float)) * (radii + 1) * voxels;
}

FluxField computeFlux(const ScalarImage& image, const std::vector<double>& radii, const Progress& progress)
{
  report(progress, 0, "flux of the gradient");
  FluxField field{ image.grid, radii, {} };
  field.flux.assign(radii.size(), std::vector<float>(image.values.size()));
  Spectrum spectrum = paddedImage(image);
  transform(spectrum, -1);
  Spectrum work = spectrum;
  std::vector<float> unused(radii.size() % 2 ? image.values.size() : 0);
  for (std::size_t n = 0; n < radii.size(); n += 2)
  {
    report(progress, double(n + 1) / double(radii.size() + 1), "flux of the gradient");
    const bool isLast = n + 1 == radii.size();
    computePair(spectrum, image.grid, radii[n], radii[isLast ? n : n + 1], work, field.flux[n],
                isLast ? unused : field.flux[n + 1]);
  }
  return field;
}

std::vector<float> strongestFlux(const FluxField& field, int sign, const RadiusRange& range)
{
  std::vector<float> strongest(field.grid.voxelCount(), 0);
  for (std::size_t r = range.begin; r < range.end; ++r)
  {
    const std::vector<float>& flux = field.flux[r];
    for (std::size_t n = 0; n < flux.size(); ++n) strongest[n] = std::max(strongest[n], sign * flux[n]);
  }
  return strongest;
}

} // namespace surgicalmesher
