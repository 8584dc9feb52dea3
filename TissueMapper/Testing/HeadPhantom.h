// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A head of nested balls: skin, muscle with fat in it, skull with a hole below, CSF, grey and white matter. Muscle is
/// as bright as grey matter, skin as CSF, so that only their places part them.

#include "TissueClassification.h"

#include <cmath>
#include <random>

namespace surgicalmesher::test
{

struct HeadPhantom
{
  ScalarImage image;
  TissueMap truth; ///< 1 CSF, 2 grey matter, 3 white matter, 4 fat, 5 muscle, 6 skin, 7 skull
};

inline Label headTissue(const Vec3& p)
{
  const double r = norm(p);
  if (r > 30) return 0;
  if (r > 28) return 6;
  const bool isFat = std::abs(p.x) < 2.5 && p.y < 0;
  if (r > 24) return isFat ? 4 : 5;
  const bool isHole = std::hypot(p.x, p.y - 3) < 1.6 && p.z < 0;
  if (r > 21) return isHole ? 1 : 7;
  if (r > 19) return 1;
  return r > 15 ? 2 : 3;
}

inline HeadPhantom headPhantom(double noise)
{
  const std::array<float, 8> brightness{ 2, 50, 85, 110, 165, 85, 50, 16 };
  HeadPhantom head;
  Grid& grid = head.truth.grid;
  grid.size = { 67, 66, 65 };
  grid.origin = { -33, -33, -33 };
  std::mt19937 random(9);
  std::normal_distribution<float> normal(0, float(noise));
  for (int k = 0; k < grid.size[2]; ++k)
    for (int j = 0; j < grid.size[1]; ++j)
      for (int i = 0; i < grid.size[0]; ++i)
      {
        head.truth.labels.push_back(headTissue(grid.gridToWorld({ double(i), double(j), double(k) })));
        head.image.values.push_back(brightness[head.truth.labels.back()] + normal(random));
      }
  head.image.grid = grid;
  return head;
}

/// A CT of it, in Hounsfield units.
inline ScalarImage ctOf(const HeadPhantom& head, double noise)
{
  const std::array<float, 8> density{ -1000, 10, 38, 30, -90, 55, 25, 900 };
  ScalarImage image{ head.truth.grid, {} };
  std::mt19937 random(10);
  std::normal_distribution<float> normal(0, float(noise));
  for (const Label label : head.truth.labels) image.values.push_back(density[label] + normal(random));
  return image;
}

/// `count` random voxels of each class.
inline std::vector<TissueClass> trainingOf(const TissueMap& truth, int count)
{
  const std::array<const char*, 8> names{ "", "CSF", "grey matter", "white matter", "fat", "muscle", "skin", "skull" };
  std::mt19937 random(12);
  std::vector<TissueClass> classes;
  for (Label label = 1; label < 8; ++label)
  {
    TissueClass tissue;
    tissue.name = names[label];
    tissue.label = label;
    tissue.admission = usualAdmission(tissue.name);
    while (int(tissue.points.size()) < count)
    {
      const std::array<int, 3> v{ int(random() % unsigned(truth.grid.size[0])),
                                  int(random() % unsigned(truth.grid.size[1])),
                                  int(random() % unsigned(truth.grid.size[2])) };
      if (labelAt(truth, v) == label)
        tissue.points.push_back(truth.grid.gridToWorld({ double(v[0]), double(v[1]), double(v[2]) }));
    }
    classes.push_back(tissue);
  }
  return classes;
}

} // namespace surgicalmesher::test
