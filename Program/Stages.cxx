// SPDX-License-Identifier: Apache-2.0
#include "Stages.h"

#include "Descriptions.h"
#include "Errors.h"

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <set>

namespace surgicalmesher
{

namespace
{

std::string inFolder(const RunRequest& request, const std::string& name)
{
  return (std::filesystem::path(request.folder) / name).lexically_normal().string();
}

/// An output given by name only lies in the folder of the results.
std::string placeOfOutput(const RunRequest& request, const std::string& value)
{
  const std::filesystem::path path(value);
  return path.has_parent_path() ? absolutePath(value) : inFolder(request, value);
}

bool isGiven(const std::string& name, const ModuleDescription& program, const RunOptions& options)
{
  const auto found = options.find(name);
  return found != options.end() && !isDefault(*program.find(name), found->second);
}

bool isTaken(const Stage& stage, const Parameter& parameter, const ModuleDescription& program,
             const RunOptions& options)
{
  static const std::set<std::string> focus{ "targets", "path", "targetPoint", "pathPoint" };
  if (stageOptions().count(parameter.name) || parameter.longFlag.empty()) return false;
  if (!isGiven(parameter.name, program, options)) return false;
  if (stage.name == "tissues") return parameter.name != "names"; // `names` is the table that the other stages read
  if (stage.name != "mesh") return true;
  if (parameter.name.rfind("nullDisplacement", 0) == 0) return false;
  return !focus.count(parameter.name) || isGiven("nonlinearDistance", program, options);
}

/// Returns a file's name so that it remains one in a list separated by commas: in quotes, if need be, and quotes in it
/// twice.
std::string oneOfAList(const std::string& name)
{
  if (name.find_first_of(",\"") == std::string::npos) return name;
  std::string quoted = "\"";
  for (const char c : name) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

void addValue(Stage& stage, const RunRequest& request, const Parameter& parameter, const std::string& value)
{
  std::string text = value;
  if (parameter.isFile())
  {
    if (parameter.output) checkValue(parameter, value);
    text = parameter.output ? placeOfOutput(request, value) : absolutePath(value);
    (parameter.output ? stage.outputs : stage.inputs).push_back(text);
    if (parameter.multiple && parameter.output) text = oneOfAList(text);
  }
  stage.arguments.push_back("--" + parameter.longFlag + "=" + text);
}

/// Returns the options of a program under its own names.
RunOptions optionsOf(const ModuleDescription& program, const RunOptions& merged)
{
  RunOptions options;
  for (const Parameter* parameter : program.parameters())
  {
    const auto found = merged.find(mergedName(parameter->name, program));
    if (found != merged.end()) options[parameter->name] = found->second;
  }
  return options;
}

void addOptions(Stage& stage, const RunRequest& request, const char* xml)
{
  const ModuleDescription program = parseModuleDescription(xml);
  const RunOptions options = optionsOf(program, request.options);
  for (const Parameter* parameter : program.parameters())
  {
    if (!isTaken(stage, *parameter, program, options)) continue;
    if (parameter->type == "boolean") stage.arguments.push_back("--" + parameter->longFlag);
    else
    {
      for (const std::string& value : options.at(parameter->name)) addValue(stage, request, *parameter, value);
    }
  }
}

void addInput(Stage& stage, const std::string& flag, const std::string& file)
{
  stage.arguments.push_back(flag + file);
  stage.inputs.push_back(file);
}

void addOutput(Stage& stage, const std::string& flag, const std::string& file)
{
  stage.arguments.push_back(flag + file);
  stage.outputs.push_back(file);
}

bool marksFarTissue(const RunRequest& request)
{
  const ModuleDescription program = parseModuleDescription(pathScaleXML);
  return isGiven("nullDisplacementRadius", program, request.options) ||
         isGiven("nullDisplacementPathDistance", program, request.options);
}

bool isAnImage(const RunRequest& request)
{
  return isGiven("training", parseModuleDescription(tissueMapperXML), request.options);
}

/// Options of the classification have no effect on a label map.
void requireNoneOfAnImage(const RunRequest& request)
{
  const ModuleDescription classification = parseModuleDescription(tissueMapperXML);
  std::vector<ModuleDescription> others;
  for (const char* xml : { pathScaleXML, simplexMesherXML, tetrahedralizerXML })
    others.push_back(parseModuleDescription(xml));
  for (const auto& option : request.options)
  {
    const std::string& name = option.first;
    const Parameter* parameter = classification.find(name);
    const bool isShared =
      std::any_of(others.begin(), others.end(), [&](const auto& other) { return other.find(name); });
    if (parameter && !isShared && isGiven(name, classification, request.options))
      throw UsageError(parameter->spelling() +
                       " is given without --training, expected the training points of an image as well");
  }
}

Stage tissuesStage(const RunRequest& request)
{
  Stage stage{ "tissues", "TissueMapperCLI", {}, {}, {}, 0.24 };
  addOptions(stage, request, tissueMapperXML);
  addOutput(stage, "--names=", inFolder(request, "tissues.ctbl"));
  addOutput(stage, "--report=", inFolder(request, "classification.json"));
  addInput(stage, "", request.labelMap);
  addOutput(stage, "", inFolder(request, "tissues.nrrd"));
  return stage;
}

/// Returns the request for the stages after the classification of an image.
RunRequest requestOfTissues(RunRequest request)
{
  request.labelMap = labelMapOf(request);
  request.options.insert({ "names", { inFolder(request, "tissues.ctbl") } });
  return request;
}

Stage scaleStage(const RunRequest& request)
{
  Stage stage{ "scale", "SurgicalPathScaleCLI", {}, {}, {}, 0.02 };
  addOptions(stage, request, pathScaleXML);
  if (marksFarTissue(request)) addOutput(stage, "--outputLabelMap=", inFolder(request, "labels.nrrd"));
  addOutput(stage, "--report=", inFolder(request, "scale.json"));
  addInput(stage, "", request.labelMap);
  addOutput(stage, "", inFolder(request, "scale.nrrd"));
  return stage;
}

Stage surfaceStage(const RunRequest& request)
{
  Stage stage{ "surface", "SimplexMesherCLI", {}, {}, {}, 0.83 };
  addOptions(stage, request, simplexMesherXML);
  addInput(stage, "--scale=", inFolder(request, "scale.nrrd"));
  addOutput(stage, "--preparedLabelMap=", inFolder(request, "prepared.nrrd"));
  addOutput(stage, "--ambient=", inFolder(request, "ambient.vtu"));
  addOutput(stage, "--report=", inFolder(request, "surface.json"));
  addInput(stage, "", marksFarTissue(request) ? inFolder(request, "labels.nrrd") : request.labelMap);
  addOutput(stage, "", inFolder(request, "surface.vtp"));
  return stage;
}

Stage meshStage(const RunRequest& request)
{
  Stage stage{ "mesh", "FuchsTetrahedralizerCLI", {}, {}, {}, 0.11 };
  addOptions(stage, request, tetrahedralizerXML);
  addInput(stage, "--scale=", inFolder(request, "scale.nrrd"));
  addInput(stage, "--ambient=", inFolder(request, "ambient.vtu"));
  addOutput(stage, "--report=", inFolder(request, "mesh.json"));
  addInput(stage, "", inFolder(request, "surface.vtp"));
  addOutput(stage, "", inFolder(request, "mesh.vtu"));
  return stage;
}

} // namespace

std::string labelMapOf(const RunRequest& request)
{
  return isAnImage(request) ? inFolder(request, "tissues.nrrd") : request.labelMap;
}

std::vector<Stage> stagesToScale(const RunRequest& request)
{
  if (isAnImage(request)) return { tissuesStage(request), scaleStage(requestOfTissues(request)) };
  requireNoneOfAnImage(request);
  return { scaleStage(request) };
}

std::vector<Stage> stagesOf(const RunRequest& request)
{
  const RunRequest later = isAnImage(request) ? requestOfTissues(request) : request;
  std::vector<Stage> stages = stagesToScale(request);
  stages.push_back(surfaceStage(later));
  stages.push_back(meshStage(later));
  return stages;
}

double shareOf(const std::vector<Stage>& stages)
{
  return std::accumulate(stages.begin(), stages.end(), 0.0,
                         [](double sum, const Stage& stage) { return sum + stage.share; });
}

std::optional<std::filesystem::path> pathInResults(const std::filesystem::path& file,
                                                   const std::filesystem::path& folder)
{
  const std::filesystem::path path = file.lexically_relative(folder);
  if (path.empty() || *path.begin() == "..") return {};
  return path;
}

} // namespace surgicalmesher
