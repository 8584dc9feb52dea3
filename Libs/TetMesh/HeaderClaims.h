// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Detection of headers that promise more than their file can hold: readers would allocate memory for it, or wait for
/// it, without end.

#include <string>

namespace surgicalmesher
{

/// Throws InputError if a header in `file` (.vtp, .vtu, .vtk, .stl or .ply, by its extension) claims more points
/// or cells than the file has room for, however small each is and however well it is compressed.
void requireCredibleHeader(const std::string& file);

} // namespace surgicalmesher
