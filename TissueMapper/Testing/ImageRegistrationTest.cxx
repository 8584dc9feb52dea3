// SPDX-License-Identifier: Apache-2.0
#include "ImageRegistration.h"

#include "Errors.h"
#include "MutualInformation.h"
#include "RegistrationPhantom.h"

#include <gtest/gtest.h>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

ScalarImage ct() { return registrationPhantom(LinearMap(), ctBrightness); }
ScalarImage mr() { return registrationPhantom(poseOff(), mrBrightness); }

/// The image in a frame turned by 180 degrees about an axis of the world.
ScalarImage turnedOver(ScalarImage image, int axis)
{
  const auto turn = [&](Vec3 v)
  {
    for (int other = 0; other < 3; ++other) v[other] *= other == axis ? 1 : -1;
    return v;
  };
  image.grid.origin = turn(image.grid.origin);
  for (Vec3& direction : image.grid.axes) direction = turn(direction);
  return image;
}

ScalarImage cropped(const ScalarImage& image, int first, int count)
{
  ScalarImage part;
  part.grid = image.grid;
  part.grid.size[2] = count;
  part.grid.origin = image.grid.gridToWorld(image.grid.position(0, 0, first));
  const auto begin = image.values.begin() + std::ptrdiff_t(image.grid.index(0, 0, first));
  part.values.assign(begin, begin + std::ptrdiff_t(part.grid.voxelCount()));
  return part;
}

void expectNoConvergence(const ScalarImage& fixed, const ScalarImage& moving)
{
  try
  {
    registerImages(fixed, moving, {});
    ADD_FAILURE() << "a pose is found";
  }
  catch (const InputError& error)
  {
    EXPECT_NE(std::string(error.what()).find("does not converge"), std::string::npos) << error.what();
  }
}

} // namespace

TEST(ImageRegistration, FindsThePoseOfTheOtherModality)
{
  const Registration found = registerImages(ct(), mr(), {});
  EXPECT_LT(worstError(found.global, 50), 1); // of voxels of 3.75 mm
  EXPECT_FALSE(found.local);
  RegistrationOptions options;
  options.start = RegistrationStart::PrincipalAxes;
  EXPECT_LT(worstError(registerImages(ct(), mr(), options).global, 50), 1);
}

TEST(ImageRegistration, FindsItOfACropInAFrameTurnedOver)
{
  for (const int axis : { 0, 2 })
  {
    const Registration found = registerImages(cropped(ct(), 14, 30), turnedOver(mr(), axis), {});
    LinearMap back = found.global;
    for (int row = 0; row < 3; ++row)
    {
      if (row == axis) continue;
      back.rows[row] = -back.rows[row];
      back.offset[row] = -back.offset[row];
    }
    EXPECT_LT(worstError(back, 30), 1.5) << axis;
  }
}

TEST(ImageRegistration, AHeadrestInOneImageDoesNotMatter)
{
  ScalarImage fixed = ct();
  for (int k = 0; k < fixed.grid.size[2]; ++k)
    for (int i = 4; i < fixed.grid.size[0] - 4; ++i)
      for (int j = fixed.grid.size[1] - 4; j < fixed.grid.size[1] - 1; ++j)
        fixed.values[fixed.grid.index(i, j, k)] = 300;
  EXPECT_LT(worstError(registerImages(fixed, mr(), {}).global, 50), 1.5);
}

TEST(ImageRegistration, LandmarksReplaceTheSearch)
{
  RegistrationOptions options;
  options.start = RegistrationStart::Landmarks;
  // The pose's own map, turned round: moving landmarks are drawn, fixed ones are where it brings them.
  options.movingLandmarks = { { 40, 0, 0 }, { 0, -40, 10 }, { -20, 15, -30 }, { 5, 30, 25 } };
  for (const Vec3& p : options.movingLandmarks) options.fixedLandmarks.push_back(poseOff()(p) + Vec3{ 3, -3, 2 });
  EXPECT_LT(worstError(registerImages(ct(), mr(), options).global, 50), 1);
}

TEST(ImageRegistration, AroundTheTargetFollowsWhatIsOnlyThere)
{
  const auto toPhantom = [](const Vec3& p) {
    return p + Vec3{ 0, 6 * std::exp(-squaredNorm(p - phantomTarget) / (2 * 30 * 30)), 0 };
  };
  const ScalarImage bent = registrationPhantom(toPhantom, mrBrightness);
  RegistrationOptions options;
  options.target = Sphere{ phantomTarget, 45 };
  const Registration found = registerImages(ct(), bent, options);
  ASSERT_TRUE(found.local);
  const double before = norm(toPhantom(found.global(phantomTarget)) - phantomTarget);
  EXPECT_LT(norm(toPhantom((*found.local)(phantomTarget)) - phantomTarget), 0.5 * before);
  EXPECT_GT(found.targetInformation, found.targetInformationBefore);
}

TEST(ImageRegistration, RefusesWhereNoPoseIsBetterThanAnother)
{
  ScalarImage noise = mr();
  std::mt19937 random(8);
  for (float& value : noise.values) value = float(random() % 1000);
  expectNoConvergence(ct(), noise);
  ScalarImage ball = ct(); // any turn of a ball is as good
  ScalarImage other = mr();
  for (std::size_t n = 0; n < ball.values.size(); ++n)
  {
    const auto [i, j, k] = ball.grid.voxelAt(n);
    const double d = norm(ball.grid.gridToWorld(ball.grid.position(i, j, k)));
    ball.values[n] = d < 75 ? 100.f : float(random() % 10);
    other.values[n] = d < 75 ? 30.f : float(random() % 10);
  }
  expectNoConvergence(ball, other);
}

TEST(ImageRegistration, RefusesImagesOfNothing)
{
  ScalarImage flat = mr();
  std::fill(flat.values.begin(), flat.values.end(), 3.f);
  EXPECT_THROW(registerImages(ct(), flat, {}), InputError);
  EXPECT_THROW(registerImages(ct(), cropped(mr(), 0, 3), {}), InputError);
  RegistrationOptions options;
  options.mask.assign(ct().values.size(), false);
  EXPECT_THROW(registerImages(ct(), mr(), options), InputError);
}

TEST(MutualInformation, ItsGradientIsThatOfItsValue)
{
  const ScalarImage fixed = ct();
  const ScalarImage moving = mr();
  const auto a = asItkImage<ItkImage>(fixed.grid, fixed.values);
  const auto b = asItkImage<ItkImage>(moving.grid, moving.values);
  const auto samples = MutualInformation::Samples::New();
  std::mt19937 random(3);
  for (unsigned n = 0; n < 20000; ++n)
  {
    MutualInformation::Samples::PointType p;
    for (unsigned axis = 0; axis < 3; ++axis) p[axis] = float(random() % 10000) / 125 - 40;
    samples->SetPoint(n, p);
  }
  const SingleThread oneOfItk;
  MutualInformation information(a, b, samples, {});
  const LinearParameters at{ 1, 0, 0, 0, 1, 0, 0, 0, 1, -6, 4, -9 };
  LinearParameters gradient;
  const double value = information.at(at, gradient);
  EXPECT_DOUBLE_EQ(value, information.at(at));
  for (const std::size_t n : { 9u, 10u, 11u })
  {
    LinearParameters above = at, below = at;
    above[n] += 0.5;
    below[n] -= 0.5;
    EXPECT_NEAR(information.at(above) - information.at(below), gradient[n], 0.25 * std::abs(gradient[n]) + 1e-3) << n;
  }
}
