// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Compartments of the head in its images: the head's extent, its bone, and the inside of the skull (Audette et al.,
/// section 2.2, embedded structure).

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

/// Voxels of soft tissue known to lie inside the skull, outside it, and in an orbit.
struct CompartmentSeeds
{
  std::vector<std::array<int, 3>> inside;
  std::vector<std::array<int, 3>> outside;
  std::vector<std::array<int, 3>> orbital;
};

/// Contrast of bone in one channel: the threshold between bone and soft tissue, and the medians of both, between which
/// the brightness at the skull's border lies.
struct BoneContrast
{
  float threshold = 0;
  float boneMedian = 0;
  float softMedian = 0; ///< of the soft tissue class nearest to bone in brightness
};

/// Masks and weights found before tissues are classified, by voxel.
struct HeadSigns
{
  std::vector<bool> head;
  std::vector<bool> bone;
  std::vector<float> softness; ///< brightness from bone (0) to soft tissue (1), at least 0.05
};

/// Returns the distance (mm) of every voxel to the nearest voxel of the mask: 0 in the mask, 1e6 for an empty mask.
std::vector<float> distanceTo(const Grid& grid, const std::vector<bool>& mask);

/// Returns the voxels of the head: those above -500 HU in the CT, or, without a CT, above the threshold in the first
/// image. The mask is closed by a ball of 2 mm and filled from outside: the background is what a ball of 3 mm reaches
/// from the image's sides and upper end, and 6 mm further into openings too narrow for the ball. The lower end of the
/// image is not an entrance, as the neck continues there. Air in a CT is never part of the head.
std::vector<bool> headMask(const HeadImages& images, float threshold);

/// Bone is what is denser than `bone.threshold` in the CT, or, without a CT, darker in the first image. Softness is
/// computed from the structural image.
HeadSigns headSigns(const HeadImages& images, const BoneContrast& bone, const BoneContrast& structural);

/// Returns the compartment of every voxel. Three terms together decide whether soft tissue is inside or outside:
/// extremely randomised trees on brightness at several scales, nearby bone and depth, trained at the seeds; a flood
/// from all seeds through the widest passages between bones, which makes the two sides meet at foramina; and a
/// continuous cut of least weighted area between the two sides (Chambolle and Pock, JMIV 40(1), 2011), cheap where
/// softness is low. Orbits are what a ball of 1 mm reaches from the orbital seeds outside the skull within 15 mm; bone
/// stops the ball, and fissures are too narrow for it. Without orbital seeds there are no orbits. Precondition: at
/// least one seed on each side of the skull; orbital seeds count as outside. Throws InputError if no orbital seed lies
/// outside the skull. The result is the same for any number of threads.
std::vector<Compartment> findCompartments(const HeadImages& images, const HeadSigns& signs,
                                          const CompartmentSeeds& seeds, const Progress& progress = {});

} // namespace surgicalmesher
