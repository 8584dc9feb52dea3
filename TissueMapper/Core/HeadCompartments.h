// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The head in its images: where it is, where its bone is, and what lies inside the skull (Audette et al., section 2.2,
/// embedded structure).

#include "HeadImages.h"
#include "Progress.h"

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
  Extracranial, ///< but not in an orbit
  Intraorbital
};

/// Soft tissue known to lie inside the skull, outside, and in an orbit; voxels.
struct CompartmentSeeds
{
  std::vector<std::array<int, 3>> inside;
  std::vector<std::array<int, 3>> outside;
  std::vector<std::array<int, 3>> orbital;
};

/// Of one channel: the value that parts bone from soft tissue, and the medians between which the skull's border lies.
struct BoneContrast
{
  float threshold = 0;
  float boneMedian = 0;
  float softMedian = 0; ///< of the soft tissue nearest to bone
};

/// What shows before any tissue is told apart.
struct HeadSigns
{
  std::vector<bool> head;
  std::vector<bool> bone;
  std::vector<float> softness; ///< how far from bone's brightness towards that of soft tissue, 0.05 to 1
};

/// Distance (mm) of every voxel to the nearest of the mask; 0 in it, 1e6 for an empty mask.
std::vector<float> distanceTo(const Grid& grid, const std::vector<bool>& mask);

/// Which voxels are the head's: those over -500 HU of a CT, or else brighter than the threshold in the first image;
/// closed by 2 mm, with what they enclose but a CT's air. A hole that a ball of 3 mm doesn't pass is no way in but for
/// 6 mm, nor is the image's lower end: there the neck goes on.
std::vector<bool> headMask(const HeadImages& images, float threshold);

/// Bone is denser than `bone.threshold` in the CT, or else darker in the first image; softness is that of the
/// structural image.
HeadSigns headSigns(const HeadImages& images, const BoneContrast& bone, const BoneContrast& structural);

/// The compartment of every voxel. Soft tissue is inside or outside by three things together: extremely randomised trees
/// on brightness at several scales, on bone nearby and on depth, trained at the seeds; a flood from all seeds through
/// the widest ways between bones, which stops it at foramina; and a continuous cut of least weighted area between the
/// two (Chambolle and Pock, JMIV 40(1), 2011), cheap where softness is low. Orbits are what a front from orbital seeds
/// reaches outside the skull within 15 mm, a ball of 1 mm that bone stops and that no fissure lets through; without such
/// seeds there are none. Both sides of the skull have at least one seed, orbital ones outside. Throws InputError if no
/// orbital seed lies outside the skull. The same on any number of threads.
std::vector<Compartment> findCompartments(const HeadImages& images, const HeadSigns& signs,
                                          const CompartmentSeeds& seeds, const Progress& progress = {});

} // namespace surgicalmesher
