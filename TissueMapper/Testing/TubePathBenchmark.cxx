// SPDX-License-Identifier: Apache-2.0
// Prints how paths through phantom tubes keep to their axes, over radius, contrast to noise, shape and background.
//   TubePathBenchmark [DRAWS] [SECTION...]   sections: grid, backgrounds, clicks, coils

#include "TubeLabel.h"
#include "TubePhantoms.h"

#include <cstdio>
#include <cstdlib>
#include <string>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

struct Tally
{
  int draws = 0;
  int good = 0;
  double worstMean = 0, worstLargest = 0; ///< of the good ones
  double meanSum = 0;
  double radiusError = 0, worstRadius = 0;
  double dice = 0, worstDice = 1;
};

struct Bar
{
  double mean = 0.3;
  double largest = 1;
};

double dice(const std::vector<std::size_t>& found, const std::vector<std::size_t>& truth)
{
  std::vector<std::size_t> both;
  std::set_intersection(found.begin(), found.end(), truth.begin(), truth.end(), std::back_inserter(both));
  return 2.0 * double(both.size()) / double(found.size() + truth.size());
}

/// Voxels of the true tube between the planes across its ends: those whose centre is in it.
std::vector<std::size_t> trueVoxels(const Grid& grid, const TubeScene& scene)
{
  std::vector<std::size_t> voxels;
  const std::vector<Vec3>& axis = scene.truth;
  for (int k = 0; k < grid.size[2]; ++k)
    for (int j = 0; j < grid.size[1]; ++j)
      for (int i = 0; i < grid.size[0]; ++i)
      {
        const Vec3 p = grid.gridToWorld(voxelCentre(grid, { i, j, k }));
        double best = 1e9;
        for (const Vec3& a : axis) best = std::min(best, squaredNorm(p - a));
        if (best <= scene.tubes.front().radius * scene.tubes.front().radius) voxels.push_back(grid.index(i, j, k));
      }
  return voxels;
}

void tally(Tally& tally, const TubeScene& scene, ScalarImage image, const TubePathOptions& options, const Bar& bar,
           const std::vector<TubePath>& blocked = {}, bool withDice = false)
{
  ++tally.draws;
  try
  {
    const TubePath tube = traceTube(image, scene.places, blocked, options);
    const PathError error = pathError(tube.points, scene.truth);
    tally.meanSum += error.mean;
    double radius = 0;
    for (const double r : tube.radii) radius += r / double(tube.radii.size());
    const double off = std::abs(radius - scene.tubes.front().radius);
    tally.radiusError += off;
    tally.worstRadius = std::max(tally.worstRadius, off);
    if (withDice)
    {
      const double d = dice(tubeVoxels(image.grid, tube), trueVoxels(image.grid, scene));
      tally.dice += d;
      tally.worstDice = std::min(tally.worstDice, d);
    }
    if (std::getenv("TUBE_VERBOSE")) std::printf("    %.2f %.2f r %.2f\n", error.mean, error.largest, radius);
    if (error.mean > bar.mean || error.largest > bar.largest) return;
    ++tally.good;
    tally.worstMean = std::max(tally.worstMean, error.mean);
    tally.worstLargest = std::max(tally.worstLargest, error.largest);
  }
  catch (const std::exception& error)
  {
    std::printf("    %s\n", error.what());
  }
}

void print(const std::string& what, const Tally& t, bool withDice)
{
  std::printf("%-34s %3d of %3d  mean %.2f  worst good %.2f / %.2f  radius error %.2f (%.2f)", what.c_str(), t.good,
              t.draws, t.meanSum / t.draws, t.worstMean, t.worstLargest, t.radiusError / t.draws, t.worstRadius);
  if (withDice) std::printf("  Dice %.3f (%.3f)", t.dice / t.draws, t.worstDice);
  std::printf("\n");
  std::fflush(stdout);
}

std::string rowName(const std::string& shape, double radius, double cnr)
{
  char text[64];
  std::snprintf(text, sizeof text, "%-9s r %.2f CNR %.0f", shape.c_str(), radius, cnr);
  return text;
}

const std::array<std::string, 5> shapes{ "helix", "gap", "cross", "kiss", "kiss gap" };

TubeScene sceneNamed(const std::string& shape, const Placement& place, double radius)
{
  if (shape == "helix") return helixScene(place, radius);
  if (shape == "gap") return helixScene(place, radius, 10);
  if (shape == "cross") return crossingScene(place, radius);
  return kissingScene(place, radius, shape == "kiss" ? 0 : 10);
}

Bar barOf(double radius, double cnr)
{
  if (radius < 0.7) return { 0.5, 1.5 };
  return { 0.3, radius > 2.9 && cnr < 3.5 ? 1.5 : 1.0 };
}

void grid(int draws)
{
  std::printf("grid: helix of bend radius 20, gap of 10 mm at 30 %%, crossing at 60 degrees, kissing at one voxel\n");
  for (const double radius : { 0.5, 0.75, 1.0, 2.0, 3.0 })
  {
    for (const double cnr : { 3.0, 4.0, 5.0, 10.0 })
    {
      for (const std::string& shape : shapes)
      {
        if (shape == "kiss gap" && cnr != 5) continue;
        Tally t;
        for (int draw = 0; draw < draws; ++draw)
        {
          std::mt19937 random(1000 * draw + 17);
          const TubeScene scene = sceneNamed(shape, randomPlacement(random), radius);
          ScalarImage image = drawTubes(gridAround(scene.tubes, 8), scene.tubes);
          addNoise(image, 1 / cnr, random);
          tally(t, scene, image, {}, barOf(radius, cnr), {}, radius >= 1);
        }
        print(rowName(shape, radius, cnr), t, radius >= 1);
      }
    }
  }
  std::printf("kissing with a gap at the same place, the other tube traced first and blocked, CNR 5\n");
  for (const double radius : { 1.0, 2.0, 3.0 })
  {
    Tally t;
    for (int draw = 0; draw < draws; ++draw)
    {
      std::mt19937 random(1000 * draw + 17);
      const TubeScene scene = kissingScene(randomPlacement(random), radius, 10);
      ScalarImage image = drawTubes(gridAround(scene.tubes, 8), scene.tubes);
      addNoise(image, 0.2, random);
      const std::vector<Vec3>& other = scene.tubes[1].axis;
      const TubePath neighbour = traceTube(image, { other[40], other[other.size() - 41] }, {}, {});
      tally(t, scene, image, {}, barOf(radius, 5), { neighbour });
    }
    print(rowName("blocked", radius, 5), t, false);
  }
}

/// A helix with a gap, on what real images put behind it.
ScalarImage withBackground(const std::string& kind, TubeScene& scene, std::mt19937& random)
{
  const Vec3 middle = scene.truth[scene.truth.size() / 2];
  const double radius = scene.tubes.front().radius;
  if (kind == "ball")
  {
    std::normal_distribution<double> normal;
    const Vec3 tangent = scene.truth[scene.truth.size() / 2 + 5] - scene.truth[scene.truth.size() / 2 - 5];
    Vec3 away = cross(tangent, { normal(random), normal(random), normal(random) });
    away = away / norm(away);
    PhantomTube ball;
    ball.radius = 3;
    ball.axis = { middle + (radius + 4.5) * away };
    ball.contrast = { 1 };
    scene.tubes.push_back(ball);
  }
  ScalarImage image = drawTubes(gridAround(scene.tubes, 10), scene.tubes);
  const Grid& grid = image.grid;
  if (kind == "step")
  {
    std::normal_distribution<double> normal;
    Vec3 across{ normal(random), normal(random), normal(random) };
    across = across / norm(across);
    for (int k = 0; k < grid.size[2]; ++k)
      for (int j = 0; j < grid.size[1]; ++j)
        for (int i = 0; i < grid.size[0]; ++i)
        {
          const double side = dot(grid.gridToWorld(voxelCentre(grid, { i, j, k })) - middle, across);
          float& value = image.values[grid.index(i, j, k)];
          value = float(value + 0.6 * std::clamp(side + 0.5, 0.0, 1.0));
        }
  }
  if (kind == "texture")
  {
    // White noise, blurred along each axis by a Gaussian of 4 mm, brought to a deviation of 0.4.
    std::vector<float> texture(image.values.size());
    std::normal_distribution<float> normal;
    for (float& value : texture) value = normal(random);
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::vector<float> before = texture;
      const std::ptrdiff_t stride = axis == 0   ? 1
                                    : axis == 1 ? grid.size[0]
                                                : std::ptrdiff_t(grid.size[0]) * grid.size[1];
      for (std::size_t n = 0; n < texture.size(); ++n)
      {
        const int at = int(std::ptrdiff_t(n) / stride % grid.size[axis]);
        double sum = 0;
        for (int d = -10; d <= 10; ++d)
        {
          const int other = std::clamp(at + d, 0, grid.size[axis] - 1);
          sum += std::exp(-0.5 * d * d / 16.0) * before[std::size_t(std::ptrdiff_t(n) + (other - at) * stride)];
        }
        texture[n] = float(sum);
      }
    }
    double square = 0;
    for (const float value : texture) square += double(value) * value;
    const double scale = 0.4 / std::sqrt(square / double(texture.size()));
    for (std::size_t n = 0; n < texture.size(); ++n) image.values[n] += float(scale * texture[n]);
  }
  return image;
}

void backgrounds(int draws)
{
  std::printf("backgrounds: helix with a gap of 10 mm at 30 %%, CNR 5; flux, intensity, gradient\n");
  for (const std::string kind : { "flat", "step", "texture", "ball" })
  {
    for (const double radius : { 1.0, 2.0, 3.0 })
    {
      Tally t[3];
      for (int draw = 0; draw < draws; ++draw)
      {
        std::mt19937 random(1000 * draw + 23);
        TubeScene scene = helixScene(randomPlacement(random), radius, 10);
        ScalarImage image = withBackground(kind, scene, random);
        addNoise(image, 0.2, random);
        for (const Potential potential : { Potential::Flux, Potential::Intensity, Potential::Gradient })
        {
          TubePathOptions options;
          options.polarity = Polarity::Bright;
          options.potential = potential;
          const int n = potential == Potential::Flux ? 0 : potential == Potential::Intensity ? 1 : 2;
          tally(t[n], scene, image, options, { 0.3, 1.0 });
        }
      }
      print(rowName(kind, radius, 5) + " flux", t[0], false);
      print(rowName(kind, radius, 5) + " intensity", t[1], false);
      print(rowName(kind, radius, 5) + " gradient", t[2], false);
    }
  }
}

void clicks(int draws)
{
  std::printf("clicks 0.7 mm off the axis, CNR 5, helix\n");
  for (const double radius : { 1.0, 2.0, 3.0 })
  {
    Tally t;
    for (int draw = 0; draw < draws; ++draw)
    {
      std::mt19937 random(1000 * draw + 29);
      TubeScene scene = helixScene(randomPlacement(random), radius);
      ScalarImage image = drawTubes(gridAround(scene.tubes, 8), scene.tubes);
      addNoise(image, 0.2, random);
      std::normal_distribution<double> normal;
      for (std::size_t end = 0; end < 2; ++end)
      {
        const std::size_t n = end ? scene.truth.size() - 6 : 5;
        Vec3 away = cross(scene.truth[n + 5] - scene.truth[n - 5], { normal(random), normal(random), normal(random) });
        scene.places[end] += (0.7 / norm(away)) * away;
      }
      tally(t, scene, image, {}, { 0.3, 1.0 });
    }
    print(rowName("off axis", radius, 5), t, false);
  }
}

void coils(int draws)
{
  std::printf("coils, places half a turn apart, CNR 5\n");
  for (const double bend : { 4.0, 6.0, 10.0 })
  {
    for (const double radius : { 0.75, 1.0, 2.0, 3.0 })
    {
      if (1.6 * bend < 2 * radius + 2) continue; // the coil would fill itself
      Tally t;
      for (int draw = 0; draw < draws; ++draw)
      {
        std::mt19937 random(1000 * draw + 31);
        const TubeScene scene = coilScene(randomPlacement(random), radius, bend);
        ScalarImage image = drawTubes(gridAround(scene.tubes, 8), scene.tubes);
        addNoise(image, 0.2, random);
        tally(t, scene, image, {}, { 0.3, 1.0 });
      }
      print(rowName("bend " + std::to_string(int(bend)), radius, 5), t, false);
    }
  }
}

} // namespace

int main(int argc, char** argv)
{
  const int draws = argc > 1 ? std::atoi(argv[1]) : 4;
  const auto asked = [&](const std::string& section)
  {
    bool isAsked = argc < 3;
    for (int n = 2; n < argc; ++n) isAsked = isAsked || section == argv[n];
    return isAsked;
  };
  if (asked("grid")) grid(draws);
  if (asked("backgrounds")) backgrounds(draws);
  if (asked("clicks")) clicks(draws);
  if (asked("coils")) coils(draws);
  return 0;
}
