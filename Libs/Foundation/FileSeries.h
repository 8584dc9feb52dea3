// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Time series of VTK files.

#include <string>
#include <vector>

namespace surgicalmesher
{

struct SeriesFile
{
  std::string time; ///< a number, written to the file as it is
  std::string name; ///< relative to the collection's folder
};

/// Writes a collection file (.pvd), which ParaView plays as an animation. Throws InputError if the file cannot be
/// written completely.
void writeFileSeries(const std::vector<SeriesFile>& files, const std::string& collection);

} // namespace surgicalmesher
