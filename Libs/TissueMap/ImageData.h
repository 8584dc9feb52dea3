// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Checks that an image file holds the data that its header promises. ITK's readers, except that of NRRD, return zeros,
/// uninitialised memory or the last number of a text for missing data, and none of them verifies the checksums of
/// compressed data.

#include <cstdint>
#include <string>

namespace surgicalmesher
{

/// Throws InputError unless the data of `imageFile` (NRRD, NIfTI, MetaImage or GIPL, by its extension) are complete,
/// `byteCount` bytes after decompression (for NIfTI, including those before the first voxel), and their checksums are
/// correct. Data that are text have to be `valueCount` numbers, no more and no less.
void requireImageData(const std::string& imageFile, std::uint64_t byteCount, std::uint64_t valueCount);

/// Throws InputError if the file is too small to hold that many bytes of uncompressed data, even as text. To be called
/// when memory does not suffice for what a header promises, to distinguish a wrong header from a lack of memory.
void requirePlausibleData(const std::string& imageFile, std::uint64_t byteCount);

/// Throws InputError for headers at which ITK's readers hang or overflow a buffer: a MetaImage header with an
/// impossible number of dimensions, and an NRRD header with a field of more than 500 characters.
void requireCredibleDimensions(const std::string& imageFile);

} // namespace surgicalmesher
