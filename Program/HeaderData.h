// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The files that hold the voxels of an image whose header is a file of its own.

#include <string>
#include <vector>

namespace surgicalmesher
{

/// Returns the paths of the data files that the header of an NRRD or MetaImage file names: one file, a list, or a
/// pattern with numbers. Empty for data in the same file, for other formats, and for a header that cannot be read.
std::vector<std::string> dataFilesOf(const std::string& header);

} // namespace surgicalmesher
