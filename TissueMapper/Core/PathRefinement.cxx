// SPDX-License-Identifier: Apache-2.0
#include "PathRefinement.h"

#include "Sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace surgicalmesher
{

namespace
{

constexpr double pi = 3.14159265358979323846;

/// Two orthogonal unit vectors across a unit tangent.
std::array<Vec3, 2> acrossOf(const Vec3& tangent)
{
  int least = 0;
  for (int axis = 1; axis < 3; ++axis)
  {
    if (std::abs(tangent[axis]) < std::abs(tangent[least])) least = axis;
  }
  Vec3 other;
  other[least] = 1;
  const Vec3 u = cross(tangent, other);
  const Vec3 first = u / norm(u);
  return { first, cross(tangent, first) };
}

struct Centroid
{
  Vec3 place;
  double peak = 0;
};

/// Centroid of what exceeds `share` of the largest value in a disc across the path.
Centroid centroidAcross(const std::function<double(const Vec3&)>& ridge, const Vec3& p, const Vec3& tangent,
                        double discRadius)
{
  constexpr double share = 0.7;
  constexpr int rings = 5;
  const std::array<Vec3, 2> across = acrossOf(tangent);
  std::vector<std::pair<Vec3, double>> samples;
  Centroid result{ p, 0 };
  for (int a = -rings; a <= rings; ++a)
  {
    for (int b = -rings; b <= rings; ++b)
    {
      if (a * a + b * b > rings * rings) continue;
      const Vec3 q = p + (discRadius * a / rings) * across[0] + (discRadius * b / rings) * across[1];
      samples.push_back({ q, ridge(q) });
      result.peak = std::max(result.peak, samples.back().second);
    }
  }
  if (!(result.peak > 0)) return result;
  Vec3 sum;
  double total = 0;
  for (const auto& sample : samples)
  {
    const double weight = std::max(0.0, sample.second - share * result.peak);
    sum += weight * (sample.first - p);
    total += weight;
  }
  if (total > 0) result.place = p + sum / total;
  return result;
}

/// Extends the path at both ends by a straight segment of this length, in the direction of the chord over as long a
/// stretch of the path.
std::vector<Vec3> carriedOn(const std::vector<Vec3>& path, double length)
{
  const auto beyond = [&](const Vec3& end, auto begin, auto last)
  {
    Vec3 chord = end - *begin;
    for (; begin != last && norm(chord) < length; ++begin) chord = end - *begin;
    return norm(chord) > 0 ? end + (length / norm(chord)) * chord : end;
  };
  std::vector<Vec3> result{ beyond(path.front(), path.begin(), path.end()) };
  result.insert(result.end(), path.begin(), path.end());
  result.push_back(beyond(path.back(), path.rbegin(), path.rend()));
  return result;
}

/// Radius of curvature at each of some points `step` apart, over chords of about `chord` on either side; all are in the
/// same unit.
std::vector<double> bendRadii(const std::vector<Vec3>& points, double step, double chord)
{
  const int count = int(points.size());
  const int reach = std::clamp(int(std::lround(chord / step)), 1, std::max(1, (count - 1) / 2));
  std::vector<double> radii(count, std::numeric_limits<double>::infinity());
  for (int n = reach; n + reach < count; ++n)
  {
    const Vec3 bend = points[n - reach] - 2 * points[n] + points[n + reach];
    const double curvature = norm(bend) / (reach * step * reach * step);
    if (curvature > 0) radii[n] = 1 / curvature;
  }
  for (int n = 0; n < std::min(reach, count); ++n)
  {
    radii[n] = radii[std::min(reach, count - 1)];
    radii[count - 1 - n] = radii[std::max(0, count - 1 - reach)];
  }
  return radii;
}

/// Sliding minimum: the least value within `reach` indices on either side.
std::vector<double> windowMinimum(const std::vector<double>& values, int reach)
{
  const int count = int(values.size());
  std::vector<double> result(count);
  for (int n = 0; n < count; ++n)
  {
    result[n] =
      *std::min_element(values.begin() + std::max(0, n - reach), values.begin() + std::min(count, n + reach + 1));
  }
  return result;
}

/// Stiffness (voxel^4) at which smoothing moves a bend of this radius (voxels) by a fiftieth of a voxel, within bounds.
double stiffnessOf(double bendRadius)
{
  constexpr double movement = 0.02;
  return std::clamp(movement * bendRadius * bendRadius * bendRadius, 1.5, 30.0);
}

/// exp(-x) I1(x) for x >= 0, with I1 the modified Bessel function of the first kind.
double scaledBesselI1(double x)
{
  constexpr int steps = 256;
  double sum = 0;
  for (int n = 0; n < steps; ++n)
  {
    const double phi = pi * (n + 0.5) / steps;
    sum += std::exp(x * (std::cos(phi) - 1)) * std::cos(phi);
  }
  return sum / steps;
}

/// -dI/d(rho) of the image I of a disc of radius r and height 1, blurred by a Gaussian.
double blurredDiscSlope(double rho, double r, double sigma)
{
  const double variance = sigma * sigma;
  return r / variance * std::exp(-(rho - r) * (rho - r) / (2 * variance)) * scaledBesselI1(rho * r / variance);
}

/// -R dM/dR for a sphere of radius R = `radius` on the axis of a straight blurred tube of contrast 1.
double modelFlux(double tubeRadius, double radius, double sigma)
{
  constexpr int steps = 96;
  double sum = 0;
  for (int n = 0; n < steps; ++n)
  {
    const double theta = pi / 2 * (n + 0.5) / steps;
    const double sine = std::sin(theta);
    sum += blurredDiscSlope(radius * sine, tubeRadius, sigma) * sine * sine;
  }
  return radius * sum * (pi / 2) / steps;
}

/// Weight of the flux into the sphere for a tube radius. Small spheres hold few voxels: noise and interpolation in
/// their flux would bias the radii of thick tubes downwards.
double certainty(double radius) { return radius; }

/// Flux profiles, by sphere radius, of tubes with radii first, first + step, ...
struct ProfileTable
{
  double first = 0;
  double step = 0;
  std::vector<std::vector<double>> profiles;
};

ProfileTable makeProfiles(const std::vector<double>& radii, double voxel)
{
  const double variance = voxel * voxel / 12; // variance of the mean over a voxel
  ProfileTable table{ 0.3 * radii.front(), 0.05 * voxel, {} };
  for (double r = table.first; r < 1.3 * radii.back(); r += table.step)
  {
    std::vector<double> profile;
    for (const double radius : radii)
    {
      const double sphere = sphereRadius(radius);
      profile.push_back(certainty(radius) * modelFlux(r, sphere, std::hypot(std::sqrt(variance), sphereBlur(sphere))));
    }
    table.profiles.push_back(profile);
  }
  return table;
}

/// Squared residual of fitting `model`, scaled by a factor of at least 0, to `found`.
double residualOf(const std::vector<double>& model, const std::vector<double>& found)
{
  const double product = std::inner_product(model.begin(), model.end(), found.begin(), 0.0);
  const double square = std::inner_product(model.begin(), model.end(), model.begin(), 0.0);
  const double whole = std::inner_product(found.begin(), found.end(), found.begin(), 0.0);
  return product > 0 && square > 0 ? whole - product * product / square : whole;
}

double fittedRadius(const ProfileTable& table, const std::vector<double>& found)
{
  std::vector<double> residuals;
  for (const std::vector<double>& profile : table.profiles) residuals.push_back(residualOf(profile, found));
  const std::size_t best = std::min_element(residuals.begin(), residuals.end()) - residuals.begin();
  double offset = 0;
  if (best > 0 && best + 1 < residuals.size())
  {
    const double curvature = residuals[best - 1] - 2 * residuals[best] + residuals[best + 1];
    if (curvature > 0) offset = 0.5 * (residuals[best - 1] - residuals[best + 1]) / curvature;
  }
  return table.first + (double(best) + offset) * table.step;
}

/// Calls add(m, weight) with Gaussian weights (not normalised) for the points within 2.5 sigma of point n. The window
/// is shorter at the ends of the path.
template <typename Add>
void averageAlong(int count, double sigmaInSteps, int n, Add add)
{
  const int reach = int(std::ceil(2.5 * sigmaInSteps));
  for (int m = std::max(0, n - reach); m <= std::min(count - 1, n + reach); ++m)
    add(m, std::exp(-0.5 * (m - n) * (m - n) / (sigmaInSteps * sigmaInSteps)));
}

} // namespace

double polylineLength(const std::vector<Vec3>& points)
{
  double length = 0;
  for (std::size_t n = 1; n < points.size(); ++n) length += norm(points[n] - points[n - 1]);
  return length;
}

std::vector<Vec3> resampled(const std::vector<Vec3>& points, double step)
{
  const double length = polylineLength(points);
  const int count = std::max(2, int(std::lround(length / step)) + 1);
  std::vector<Vec3> result{ points.front() };
  double before = 0;
  std::size_t n = 1;
  for (int m = 1; m + 1 < count; ++m)
  {
    const double at = length * m / (count - 1);
    double edge = norm(points[n] - points[n - 1]);
    while (before + edge < at && n + 1 < points.size())
    {
      before += edge;
      ++n;
      edge = norm(points[n] - points[n - 1]);
    }
    const double t = edge > 0 ? (at - before) / edge : 0;
    result.push_back((1 - t) * points[n - 1] + t * points[n]);
  }
  result.push_back(points.back());
  return result;
}

std::vector<Vec3> tangentsOf(const std::vector<Vec3>& points)
{
  const int count = int(points.size());
  std::vector<Vec3> tangents(count);
  for (int n = 0; n < count; ++n)
  {
    const Vec3 chord = points[std::min(n + 2, count - 1)] - points[std::max(n - 2, 0)];
    const double length = norm(chord);
    tangents[n] = length > 0 ? chord / length : Vec3{ 1, 0, 0 };
  }
  return tangents;
}

// The normal matrix has five diagonals; it is positive definite if at least two weights are positive.
std::vector<Vec3> smoothed(const std::vector<Vec3>& y, const std::vector<double>& weights,
                           const std::vector<double>& stiffness, double step)
{
  const int count = int(y.size());
  if (count < 3) return y;
  std::vector<double> diagonal(count), first(count, 0), second(count, 0); // entries (n, n), (n, n - 1), (n, n - 2)
  std::vector<Vec3> x(count);
  for (int n = 0; n < count; ++n)
  {
    diagonal[n] = weights[n] * step;
    x[n] = diagonal[n] * y[n];
  }
  for (int n = 1; n + 1 < count; ++n)
  {
    const double s = stiffness[n] / (step * step * step);
    diagonal[n - 1] += s;
    diagonal[n] += 4 * s;
    diagonal[n + 1] += s;
    first[n] -= 2 * s;
    first[n + 1] -= 2 * s;
    second[n + 1] += s;
  }
  for (int n = 0; n < count; ++n) // LDL^T factorisation in place
  {
    if (n >= 2) second[n] /= diagonal[n - 2];
    if (n >= 1)
    {
      if (n >= 2) first[n] -= second[n] * diagonal[n - 2] * first[n - 1];
      first[n] /= diagonal[n - 1];
      diagonal[n] -= first[n] * first[n] * diagonal[n - 1];
    }
    if (n >= 2) diagonal[n] -= second[n] * second[n] * diagonal[n - 2];
    if (n >= 1) x[n] -= first[n] * x[n - 1];
    if (n >= 2) x[n] -= second[n] * x[n - 2];
  }
  for (int n = count - 1; n >= 0; --n)
  {
    x[n] = x[n] / diagonal[n];
    if (n + 1 < count) x[n] -= first[n + 1] * x[n + 1];
    if (n + 2 < count) x[n] -= second[n + 2] * x[n + 2];
  }
  return x;
}

std::vector<Vec3> refinedPath(const Grid& grid, const std::function<double(const Vec3&)>& ridge,
                              const std::vector<Vec3>& path)
{
  constexpr int rounds = 6;
  const double voxel = voxelLength(grid);
  const double unit = std::pow(voxel, 4); // of stiffness
  std::vector<Vec3> points = carriedOn(path, 3 * voxel);
  for (int round = 0; round < rounds; ++round)
  {
    points = resampled(points, 0.5 * voxel);
    if (points.size() < 4) return points;
    const double step = polylineLength(points) / double(points.size() - 1);
    const std::vector<Vec3> tangents = tangentsOf(points);
    std::vector<double> weights;
    std::vector<Vec3> centres;
    for (std::size_t n = 0; n < points.size(); ++n)
    {
      const Centroid centroid = centroidAcross(ridge, points[n], tangents[n], voxel);
      centres.push_back(centroid.place);
      weights.push_back(centroid.peak);
    }
    const double mean = std::accumulate(weights.begin(), weights.end(), 0.0) / double(weights.size());
    for (double& weight : weights) weight = mean > 0 ? std::clamp(weight / mean, 0.05, 2.0) : 1;
    std::vector<double> stiffness(points.size(), 3 * unit);
    const std::vector<Vec3> loose = smoothed(centres, weights, stiffness, step);
    const std::vector<double> bends = windowMinimum(bendRadii(loose, step, 2 * voxel), 6);
    for (std::size_t n = 0; n < points.size(); ++n) stiffness[n] = stiffnessOf(bends[n] / voxel) * unit;
    points = smoothed(centres, weights, stiffness, step);
  }
  return points;
}

std::vector<Vec3> fittedToEnds(std::vector<Vec3> path, const Vec3& first, const Vec3& last)
{
  const auto fitStart = [](std::vector<Vec3>& points, const Vec3& end)
  {
    if (points.size() < 4) return;
    // Only the nearer half is searched: the path may come by this end a second time.
    double best = std::numeric_limits<double>::infinity();
    std::size_t nearest = 0;
    for (std::size_t n = 0; n < points.size() / 2; ++n)
    {
      const double distance = squaredNorm(points[n] - end);
      if (distance < best)
      {
        best = distance;
        nearest = n;
      }
    }
    points.erase(points.begin(), points.begin() + std::ptrdiff_t(nearest));
    const std::size_t ahead = std::min<std::size_t>(4, points.size() - 1);
    const Vec3 chord = points[ahead] - points[0];
    const Vec3 tangent = chord / norm(chord);
    const double along = dot(end - points[0], tangent);
    if (along < 0) points.insert(points.begin(), points[0] + along * tangent);
    else if (along < norm(points[1] - points[0])) points[0] += along * tangent;
  };
  fitStart(path, first);
  std::reverse(path.begin(), path.end());
  fitStart(path, last);
  std::reverse(path.begin(), path.end());
  return path;
}

std::vector<double> radiiAlong(const FluxField& field, int sign, const std::vector<Vec3>& path)
{
  const double voxel = voxelLength(field.grid);
  const int count = int(path.size());
  const double step = count > 1 ? polylineLength(path) / (count - 1) : voxel;
  const double sigma = 3 * voxel / step;
  const ProfileTable table = makeProfiles(field.radii, voxel);
  std::vector<std::vector<double>> found(count, std::vector<double>(field.radii.size()));
  for (int n = 0; n < count; ++n)
  {
    for (std::size_t r = 0; r < field.radii.size(); ++r)
      found[n][r] = sign * certainty(field.radii[r]) * cubicValue(field.grid, field.flux[r], path[n]);
  }
  std::vector<double> radii(count);
  for (int n = 0; n < count; ++n)
  {
    std::vector<double> mean(field.radii.size(), 0);
    averageAlong(count, sigma, n,
                 [&](int m, double weight)
                 {
                   for (std::size_t r = 0; r < mean.size(); ++r) mean[r] += weight * found[m][r];
                 });
    radii[n] = fittedRadius(table, mean);
  }
  std::vector<double> result(count);
  for (int n = 0; n < count; ++n)
  {
    double sum = 0;
    double total = 0;
    averageAlong(count, sigma, n,
                 [&](int m, double weight)
                 {
                   sum += weight * radii[m];
                   total += weight;
                 });
    result[n] = sum / total;
  }
  return result;
}

} // namespace surgicalmesher
