// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Images of one head on one grid: MR of any contrast, one CT at most.

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
  /// The first MR image, or the CT where there is no other.
  const ScalarImage& structural() const { return channels[ct == 0 && channels.size() > 1 ? 1 : 0]; }
  bool isCtAlone() const { return ct >= 0 && channels.size() == 1; }
};

/// An image with values below -500 is taken for a CT: there is air around a head. Throws InputError for none or more than
/// four channels, for grids that differ, and for two CTs.
HeadImages headImages(std::vector<ScalarImage> channels);

/// Takes the smooth drift of brightness out of every MR channel (N4: Tustison et al., IEEE Trans. Med. Imaging 29(6),
/// 2010, on every fourth voxel of the head). The same on any number of threads.
void correctBias(HeadImages& images, const std::vector<bool>& head);

/// Smooths noise within regions, all channels alike and each in units of its own noise, so that what is an edge in one
/// is kept in all (vector-valued anisotropic diffusion; Whitaker and Xue, ICIP 2001).
void denoise(HeadImages& images);

} // namespace surgicalmesher
