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
  std::string folder;   ///< absolute; of the results
  RunOptions options;   ///< completed
};

struct Stage
{
  std::string name;                   ///< tissues, scale, surface or mesh
  std::string program;                ///< its file name
  std::vector<std::string> arguments; ///< files as absolute paths
  std::vector<std::string> inputs;    ///< files that it reads
  std::vector<std::string> outputs;   ///< files that it has to write
  double share = 0;                   ///< of the time that the stages take, as a rule, beside the others'
};

/// With training points the first stage classifies an image, and the others get its label map and, unless the options
/// name another, its colour table. Far tissue is marked in the map by the stage of the scale; the last one gets targets
/// and paths only to measure the nonlinear distance from them. Throws UsageError for an output that its program would
/// not write, and for options of the classification without training points.
std::vector<Stage> stagesOf(const RunRequest& request);

/// Those up to the scale alone.
std::vector<Stage> stagesToScale(const RunRequest& request);

/// The label map that is meshed: the user's, or what the classification makes of an image.
std::string labelMapOf(const RunRequest& request);

/// The sum of their shares.
double shareOf(const std::vector<Stage>& stages);

/// The path of a file from the folder of the results on, where it lies in it; both absolute.
std::optional<std::filesystem::path> pathInResults(const std::filesystem::path& file,
                                                   const std::filesystem::path& folder);

} // namespace surgicalmesher
