// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The output of `--growth FILE.pvd`: the balloons after every tenth motion, in FILE-10.vtp, FILE-20.vtp and so on.
/// Each file appears as soon as it is complete, so that it can be viewed during the run; at the end, FILE.pvd is
/// written as an index, a ParaView collection with the motions as times.

#include "Balloon.h"
#include "CommandLine.h"
#include "MeshIO.h"

#include <functional>
#include <string>
#include <vector>

namespace surgicalmesher
{

class GrowthSeries
{
public:
  /// `index` holds the final name of `--growth` if it was given; otherwise nothing is written. Registers the names of
  /// the files (CommandLine::alsoWritesMany).
  GrowthSeries(CommandLine& line, const std::vector<std::string>& index);

  /// Returns the callback that writes the files, null unless `--growth` was given. `content` converts a surface in the
  /// map's grid frame to the content of a file.
  BalloonWatch watch(std::function<SurfaceFile(const SurfaceComplex&)> content);

  void writeIndex(const std::string& file) const;

private:
  std::string fileAfter(int motion) const; ///< name without folder

  CommandLine& m_Line;
  std::string m_Folder, m_Stem; ///< the stem is empty if nothing is to be written
  std::vector<int> m_Motions;
};

} // namespace surgicalmesher
