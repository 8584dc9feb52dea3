// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Files of VTK that follow one another in time.

#include <string>
#include <vector>

namespace surgicalmesher
{

struct SeriesFile
{
  std::string time; ///< a number, as it is to stand in the file
  std::string name; ///< relative to the collection's folder
};

/// Writes a collection (.pvd), which ParaView plays. Throws InputError unless all of it arrived.
void writeFileSeries(const std::vector<SeriesFile>& files, const std::string& collection);

} // namespace surgicalmesher
