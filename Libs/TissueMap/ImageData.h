// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Whether an image file holds the data that its header promises. ITK's readers, NRRD's aside, return zeros or whatever
/// was in memory for what is missing, and none of them looks at the check sums of compressed data.

#include <cstdint>
#include <optional>
#include <string>

namespace surgicalmesher
{

/// Throws InputError unless the data of `imageFile` (NRRD, NIfTI, Analyze, MetaImage or GIPL, told by its extension)
/// are all there, `byteCount` bytes once decompressed (for NIfTI, those before the first voxel included), and their
/// check sums hold.
void requireImageData(const std::string& imageFile, std::uint64_t byteCount);

/// Throws InputError if the file is too small to hold as many bytes of data uncompressed, as numbers of text even: where
/// memory lacks for what a header promises, that tells whether there is anything to be read.
void requirePlausibleData(const std::string& imageFile, std::uint64_t byteCount);

/// Throws InputError for a MetaImage header with a number of dimensions that its reader would never come back from.
void requireCredibleDimensions(const std::string& imageFile);

/// What a NIfTI-1 header says of where its voxels lie, as it stands in the file.
struct NiftiPlacement
{
  bool isInMetres = false;
  int sformCode = 0;
  double skew = 0; ///< degrees by which two columns of the sform miss the right angle, at most
};

/// Empty unless `file`, compressed or not, is NIfTI-1.
std::optional<NiftiPlacement> readNiftiPlacement(const std::string& file);

} // namespace surgicalmesher
