// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Images of one head on one grid: MR images of any contrast, and at most one CT.

#include "ScalarImage.h"

#include <cstddef>
#include <vector>

namespace surgicalmesher
{

struct HeadImages
{
  std::vector<ScalarImage> channels; ///< one to four
  int ct = -1;                       ///< the channel in Hounsfield units; -1: none

  const Grid& grid() const { return channels.front().grid; }
  /// The first MR image, or the CT if it is the only image.
  const ScalarImage& structural() const { return channels[ct == 0 && channels.size() > 1 ? 1 : 0]; }
  bool isCtAlone() const { return ct >= 0 && channels.size() == 1; }
};

/// Collects the channels. An image with values below -500 is taken for a CT, as a CT of a head contains air. Throws
/// InputError for no image or more than four, for grids that differ, and for two CTs.
HeadImages headImages(std::vector<ScalarImage> channels);

/// Removes the smooth brightness drift (bias field) from every MR channel by N4 (Tustison et al., IEEE Trans. Med.
/// Imaging 29(6), 2010), estimated within the head on every fourth voxel along each axis, or closer along an axis of
/// fewer than eight. Precondition: at least two voxels along each axis. The result is the same for any number of
/// threads.
void correctBias(HeadImages& images, const std::vector<bool>& head);

/// Smooths noise within regions by vector-valued anisotropic diffusion (Whitaker and Xue, ICIP 2001). All channels are
/// smoothed together, each in units of its own noise, so that an edge in one channel is kept in all.
void denoise(HeadImages& images);

} // namespace surgicalmesher
