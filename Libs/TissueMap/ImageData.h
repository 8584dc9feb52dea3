// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Whether an image file holds the data that its header promises. ITK's readers, NRRD's aside, return zeros or whatever
/// was in memory for what is missing, and none of them looks at the check sums of compressed data.

#include <cstdint>
#include <string>

namespace surgicalmesher
{

/// Throws InputError unless the data of `imageFile` (NRRD, NIfTI, Analyze, MetaImage or GIPL, told by its extension)
/// are all there, `byteCount` bytes once decompressed (for NIfTI, those before the first voxel included), and their
/// check sums hold.
void requireImageData(const std::string& imageFile, std::uint64_t byteCount);

} // namespace surgicalmesher
