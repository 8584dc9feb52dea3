// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The stages of a run, as command lines of the programs.

#include "RunOptions.h"

#include <filesystem>
#include <optional>

namespace surgicalmesher
{

struct RunRequest
{
  std::string labelMap; ///< absolute; with training points an image
  std::string folder;   ///< of the results; absolute
  RunOptions options;   ///< completed
};

struct Stage
{
  std::string name;                   ///< tissues, scale, surface or mesh
  std::string program;                ///< file name of the program
  std::vector<std::string> arguments; ///< files as absolute paths
  std::vector<std::string> inputs;    ///< files that it reads
  std::vector<std::string> outputs;   ///< files that the stage must write
  double share = 0;                   ///< typical duration, relative to the other stages
};

/// Returns the stages of a run. With training points, the first stage classifies an image; the other stages get its
/// label map and its colour table, unless the options name another table. The scale stage marks far tissue in the map.
/// The mesh stage gets targets and paths only if the nonlinear distance from them is to be measured. Throws UsageError
/// for an output that its program does not write, and for options of the classification without training points.
std::vector<Stage> stagesOf(const RunRequest& request);

/// Returns the stages up to and including the scale.
std::vector<Stage> stagesToScale(const RunRequest& request);

/// Returns the label map that is meshed: the user's, or the result of the classification of an image.
std::string labelMapOf(const RunRequest& request);

/// Returns the sum of the stages' shares.
double shareOf(const std::vector<Stage>& stages);

/// Returns the path of `file` relative to `folder`; empty if it lies elsewhere. Both paths are absolute.
std::optional<std::filesystem::path> pathInResults(const std::filesystem::path& file,
                                                   const std::filesystem::path& folder);

} // namespace surgicalmesher
