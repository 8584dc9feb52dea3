// SPDX-License-Identifier: Apache-2.0
#include "StarQuality.h"
#include "ComplexInvariants.h"
#include "RandomMaps.h"
#include "TetQuality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

namespace surgicalmesher
{
namespace
{

/// `count` tetrahedra at vertex 0, which takes each of their four places in turn; every third one is background.
TetComplex starOf(std::size_t count, std::mt19937& random)
{
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Vec3> points{ {} };
  std::vector<TetComplex::Tet> tets;
  std::vector<Label> labels;
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto first = std::int32_t(points.size());
    for (int k = 0; k < 3; ++k) points.push_back({ uniform(random), uniform(random), uniform(random) });
    TetComplex::Tet t{ first, first + 1, first + 2, first };
    std::swap(t[3], t[i % 4]);
    t[i % 4] = 0;
    const auto p = [&](int k) { return points[t[k]]; };
    if (orient(p(0), p(1), p(2), p(3)) < 0) std::swap(t[(i + 1) % 4], t[(i + 2) % 4]);
    tets.push_back(t);
    labels.push_back(Label(i % 3));
  }
  const std::vector<float> lengths(points.size(), 1);
  return TetComplex(points, lengths, tets, labels);
}

double expected(const TetComplex& complex, std::int32_t t, const Vec3& p)
{
  const double q = complex.qualityWith(t, 0, p);
  return q > 0 && complex.labels[t] == 0 ? backgroundLeniency * q : q;
}

/// Around `middle`, against differences of each by itself.
void expectSumsOfGradients(StarQuality& quality, const Vec3& middle, std::mt19937& random)
{
  constexpr double h = 1e-4;
  std::uniform_real_distribution<double> uniform(-0.3, 0.3);
  for (int trial = 0; trial < 20; ++trial)
  {
    const Vec3 p = middle + Vec3{ uniform(random), uniform(random), uniform(random) };
    const std::vector<double> now = quality.each(p);
    for (const double most : { *std::min_element(now.begin(), now.begin() + quality.size()), now[0], 1e9 })
    {
      Vec3 sum;
      for (std::size_t i = 0; i < quality.size(); ++i)
      {
        if (now[i] > most) continue;
        Vec3 gradient;
        for (int axis = 0; axis < 3; ++axis)
        {
          Vec3 q = p;
          q[axis] += h;
          gradient[axis] = quality.each(q)[i] - now[i];
        }
        if (const double n = norm(gradient); n > 0) sum += gradient / n;
      }
      EXPECT_EQ(quality.sumOfGradients(p, h, most), sum);
    }
  }
}

class Stars : public ::testing::TestWithParam<std::size_t>
{
};

} // namespace

/// A tetrahedron with two corners and its vertex in line has no area on one side, but a volume as rounding will have
/// it. What was not a number then hid whatever was wound negatively beside it.
TEST(StarQuality, OfTheFlatIsANumberAndNotGood)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto place = [&] { return Vec3{ uniform(random), uniform(random), uniform(random) }; };
  for (int trial = 0; trial < 100; ++trial)
  {
    const Vec3 inLine = place();
    const std::vector<Vec3> points{ place(), place(), inLine, 2.0 * inLine };
    const bool isPositive = orient(points[0], points[1], points[2], points[3]) > 0;
    const TetComplex complex(points, { 1, 1, 1, 1 },
                             { isPositive ? TetComplex::Tet{ 0, 1, 2, 3 } : TetComplex::Tet{ 0, 1, 3, 2 } }, { 1 });
    StarQuality quality;
    quality.gather(complex, 0, { 0 });
    EXPECT_GT(quality.each(points[0])[0], 0);
    EXPECT_LT(quality.each({})[0], 1e-12);
    EXPECT_LT(quality.worst({}, 0), 1e-12);
  }
}

TEST_P(Stars, AreMeasuredAsTheirTetrahedraOneByOne)
{
  std::mt19937 random(1);
  const TetComplex complex = starOf(GetParam(), random);
  std::vector<std::int32_t> star(GetParam());
  for (std::size_t i = 0; i < star.size(); ++i) star[i] = std::int32_t(i);
  StarQuality quality;
  quality.gather(complex, 0, star);
  ASSERT_EQ(quality.size(), star.size());
  std::uniform_real_distribution<double> uniform(-0.3, 0.3);
  for (int trial = 0; trial < 20; ++trial)
  {
    const Vec3 p{ uniform(random), uniform(random), uniform(random) };
    const std::vector<double> each = quality.each(p);
    const std::int32_t without = complex.tets[0][1] ? complex.tets[0][1] : complex.tets[0][2];
    double worst = std::numeric_limits<double>::max(), worstWithout = worst;
    for (const std::int32_t t : star)
    {
      const double q = expected(complex, t, p);
      EXPECT_NEAR(each[t], q, 1e-12) << "tetrahedron " << t;
      EXPECT_EQ(quality.isBackground(t), complex.labels[t] == 0);
      worst = std::min(worst, q);
      if (!complex.contains(t, without)) worstWithout = std::min(worstWithout, q);
    }
    EXPECT_NEAR(quality.worst(p, -1), worst, 1e-12);
    if (star.size() > 1)
    {
      EXPECT_NEAR(quality.worst(p, -1, without), worstWithout, 1e-12);
    }
    EXPECT_LT(quality.worst(p, worst + 1), worst + 1) << "may stop early, but below what was asked";
  }
}

TEST_P(Stars, AddTheGradientsOfWhatIsBadAlone)
{
  std::mt19937 random(2);
  const TetComplex complex = starOf(GetParam(), random);
  std::vector<std::int32_t> star(GetParam());
  std::iota(star.begin(), star.end(), 0);
  StarQuality quality;
  quality.gather(complex, 0, star);
  expectSumsOfGradients(quality, {}, random);
}

/// With triangles between labels.
TEST(StarQuality, AddsTheGradientsOfTrianglesAsWell)
{
  std::mt19937 random(3);
  TetComplex complex = test::complexOf(test::tetrahedraOf(test::randomWellComposedMap(random, { 5, 5, 5 }, 3)), 1, 1);
  std::vector<std::int32_t> star;
  std::size_t withTriangles = 0;
  for (std::int32_t v = 0; v < std::int32_t(complex.points.size()); ++v)
  {
    if (!complex.onInterface[v]) continue;
    complex.star(v, star);
    std::vector<TetComplex::FaceOfTet> triangles;
    complex.interfaceFaces(v, star, triangles);
    StarQuality quality;
    quality.gather(complex, v, star, triangles, 0.3); // light, so that they are the worst
    withTriangles += quality.size() > star.size();
    expectSumsOfGradients(quality, complex.points[v], random);
  }
  EXPECT_GT(withTriangles, 20u);
}

INSTANTIATE_TEST_SUITE_P(OfEverySize, Stars, ::testing::Values(1, 3, 4, 5, 24));

} // namespace surgicalmesher
