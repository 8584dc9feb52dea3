// SPDX-License-Identifier: Apache-2.0
#include "HeadImages.h"

#include "Errors.h"
#include "HeadPhantom.h"
#include "ThreadCount.h"

#include <gtest/gtest.h>
#include <vtkSMPTools.h>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

/// Brighter by a third from one side of the head to the other.
void addDrift(ScalarImage& image)
{
  for (std::size_t n = 0; n < image.values.size(); ++n)
    image.values[n] *= float(0.85 + 0.3 * double(n % image.grid.size[0]) / image.grid.size[0]);
}

std::vector<bool> headOf(const TissueMap& truth)
{
  std::vector<bool> head;
  for (const Label label : truth.labels) head.push_back(label != 0);
  return head;
}

/// Standard deviation of white matter's values over their mean.
double spread(const ScalarImage& image, const TissueMap& truth)
{
  double count = 0, sum = 0, squares = 0;
  for (std::size_t n = 0; n < truth.labels.size(); ++n)
  {
    if (truth.labels[n] != 3) continue;
    ++count;
    sum += image.values[n];
    squares += double(image.values[n]) * image.values[n];
  }
  return std::sqrt(squares / count - sum * sum / (count * count)) / (sum / count);
}

} // namespace

TEST(HeadImages, DriftIsTakenOutOfMrAlone)
{
  const HeadPhantom head = headPhantom(1);
  ScalarImage drifting = head.image;
  addDrift(drifting);
  HeadImages images = headImages({ ctOf(head, 5), drifting });
  EXPECT_EQ(images.ct, 0);
  const std::vector<float> ct = images.channels[0].values;
  correctBias(images, headOf(head.truth));
  EXPECT_LT(spread(images.structural(), head.truth), 0.5 * spread(drifting, head.truth));
  EXPECT_EQ(images.channels[0].values, ct);
}

TEST(HeadImages, NoiseIsSmoothedAndEdgesStay)
{
  const HeadPhantom head = headPhantom(4);
  HeadImages images = headImages({ head.image });
  denoise(images);
  EXPECT_LT(spread(images.channels[0], head.truth), 0.6 * spread(head.image, head.truth));
  const Grid& grid = head.truth.grid;
  const auto at = [&](int k) { return images.channels[0].values[grid.index(33, 33, k)]; };
  EXPECT_GT(at(33 + 20) - at(33 + 23), 20) << "from CSF to bone there are 34";
}

TEST(HeadImages, AreTheSameOnOneThreadAndMany)
{
  const HeadPhantom head = headPhantom(4);
  HeadImages one = headImages({ head.image, ctOf(head, 20) }), three = one;
  setThreadCount(3); // first: ITK does not take back what one thread sets
  correctBias(three, headOf(head.truth));
  denoise(three);
  setThreadCount(1);
  correctBias(one, headOf(head.truth));
  denoise(one);
  vtkSMPTools::Initialize();
  for (int c = 0; c < 2; ++c) EXPECT_EQ(one.channels[c].values, three.channels[c].values);
}

TEST(HeadImages, RefuseWhatDoesNotBelongTogether)
{
  const HeadPhantom head = headPhantom(1);
  EXPECT_THROW(headImages({}), InputError);
  EXPECT_THROW(headImages(std::vector<ScalarImage>(5, head.image)), InputError);
  EXPECT_THROW(headImages({ ctOf(head, 1), ctOf(head, 2) }), InputError);
  ScalarImage moved = head.image;
  moved.grid.origin.x += 1;
  EXPECT_THROW(headImages({ head.image, moved }), InputError);
  moved = head.image;
  moved.grid.spacing.x = 1.1;
  EXPECT_THROW(headImages({ head.image, moved }), InputError);
}
