// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The head in an MR image in which bone is dark: where it is, where its bone is, and what lies inside the skull
/// (Audette et al., section 2.2, embedded structure).

#include "Progress.h"
#include "ScalarImage.h"

#include <array>
#include <cstdint>
#include <vector>

namespace surgicalmesher
{

enum class Compartment : std::uint8_t
{
  Background,
  Bone,
  Intracranial,
  Extracranial
};

/// Soft tissue known to lie inside or outside the skull; voxels.
struct CompartmentSeeds
{
  std::vector<std::array<int, 3>> inside;
  std::vector<std::array<int, 3>> outside;
};

/// Values of tissue, brighter than which nothing is bone, and the medians between which the skull's border lies.
struct BoneContrast
{
  float threshold = 0;
  float boneMedian = 0;
  float softMedian = 0; ///< of the darkest soft tissue
};

/// Which voxels are the head's: brighter than the threshold after closing by 2 mm, and what they enclose. The image's
/// lower end is no way in: there the neck goes on.
std::vector<bool> headMask(const ScalarImage& image, float threshold);

/// The compartment of every voxel. Bone is what is dark within the head. Soft tissue is inside or outside by three
/// things together: extremely randomised trees on brightness at several scales, on bone nearby and on depth, trained at
/// the seeds; a flood from all seeds through the widest ways between bones, which stops it at foramina; and a
/// continuous cut of least weighted area between the two (Chambolle and Pock, JMIV 40(1), 2011), cheap where the image
/// is as dark as bone. Both lists of seeds have at least one voxel. The same on any number of threads.
std::vector<Compartment> findCompartments(const ScalarImage& image, const BoneContrast& bone,
                                          const CompartmentSeeds& seeds, const Progress& progress = {});

} // namespace surgicalmesher
