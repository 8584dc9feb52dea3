// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What `--growth FILE.pvd` writes: the balloons after every tenth motion, FILE-10.vtp, FILE-20.vtp and so on, each in
/// place as soon as it is complete, to be looked at while the run goes on; in the end the index of all, a ParaView
/// collection with the motions as times.

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
  /// `index`: the final name of `--growth`, if it was given; nothing is written without. Claims the files' names
  /// (CommandLine::alsoWritesMany).
  GrowthSeries(CommandLine& line, const std::vector<std::string>& index);

  /// `content` puts a surface of the map's grid frame into the form of the files. Null unless `--growth` was given.
  BalloonWatch watch(std::function<SurfaceFile(const SurfaceComplex&)> content);

  void writeIndex(const std::string& file) const;

private:
  std::string fileAfter(int motion) const; ///< without folder

  CommandLine& m_Line;
  std::string m_Folder, m_Stem; ///< the stem is empty if nothing is wanted
  std::vector<int> m_Motions;
};

} // namespace surgicalmesher
