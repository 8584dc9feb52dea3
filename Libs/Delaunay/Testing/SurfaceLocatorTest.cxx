// SPDX-License-Identifier: Apache-2.0
#include "SurfaceLocator.h"
#include "Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace surgicalmesher
{
namespace
{

constexpr double radius = 10;

TEST(SurfaceLocator, TellsDistanceAndSide)
{
  constexpr double sagitta = 0.05;
  const SurfaceComplex surface = test::sphere({}, radius, 4);
  const SurfaceLocator locator(surface);
  for (const double x : { 0.5, 5.0, 9.0, 11.0, 30.0 })
  {
    const SurfaceLocator::Answer answer = locator.ask({ x, 0.1, 0.2 });
    EXPECT_NEAR(answer.distance, std::abs(norm({ x, 0.1, 0.2 }) - radius), sagitta) << x;
    EXPECT_EQ(answer.inside, x < radius);
  }
}

TEST(SurfaceWalk, KnowsNoMoreThanIsTrueAndAnswersLikeTheLocator)
{
  const SurfaceComplex surface = test::sphere({}, radius, 3);
  const SurfaceLocator locator(surface);
  SurfaceWalk walk(locator);
  EXPECT_FALSE(walk.known({})) << "nothing has been asked yet";
  std::mt19937 random(1);
  std::uniform_real_distribution<double> step(-2, 2);
  Vec3 p;
  int known = 0, crossings = 0;
  bool inside = true;
  for (int n = 0; n < 2000; ++n)
  {
    for (int axis = 0; axis < 3; ++axis) p[axis] = std::clamp(p[axis] + step(random), -15.0, 15.0);
    const SurfaceLocator::Answer truth = locator.ask(p);
    if (const auto before = walk.known(p))
    {
      ++known;
      EXPECT_LE(before->distance, truth.distance + 1e-9);
      EXPECT_EQ(before->inside, truth.inside);
    }
    if (n % 3 != 0) continue; // what is known then is of a point some steps back
    const SurfaceLocator::Answer answer = walk.ask(p);
    EXPECT_EQ(answer.distance, truth.distance);
    EXPECT_EQ(answer.inside, truth.inside);
    crossings += std::exchange(inside, truth.inside) != truth.inside;
  }
  EXPECT_GT(known, 500);
  EXPECT_GT(crossings, 20) << "of the surface";
}

} // namespace
} // namespace surgicalmesher
