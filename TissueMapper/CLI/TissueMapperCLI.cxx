// SPDX-License-Identifier: Apache-2.0
// TissueMapperCLI: classifies the tissues of a head from images and training points, and writes their label map.

#include "AvailableMemory.h"
#include "CommandLine.h"
#include "Errors.h"
#include "JsonReport.h"
#include "TextFile.h"
#include "ThreadCount.h"
#include "TissueClassesIO.h"
#include "TissueMapIO.h"
#include "TissueMapperCLIXML.h"

#include <algorithm>
#include <filesystem>

using namespace surgicalmesher;

namespace
{

/// Assigns colours as common in anatomical atlases, in the order of the labels.
void colour(TissueTable& table)
{
  constexpr std::array<std::array<double, 3>, 10> colours{ { { 0.30, 0.60, 0.85 },
                                                             { 0.78, 0.56, 0.40 },
                                                             { 0.95, 0.92, 0.85 },
                                                             { 0.92, 0.80, 0.35 },
                                                             { 0.75, 0.30, 0.25 },
                                                             { 0.90, 0.70, 0.60 },
                                                             { 0.95, 0.85, 0.60 },
                                                             { 0.45, 0.65, 0.45 },
                                                             { 0.55, 0.45, 0.70 },
                                                             { 0.60, 0.60, 0.60 } } };
  std::size_t n = 0;
  for (auto& entry : table) entry.second.color = colours[n++ % colours.size()];
}

const char* nameOf(Admission admission)
{
  switch (admission)
  {
  case Admission::Intracranial: return "intracranial";
  case Admission::Extracranial: return "extracranial";
  case Admission::Intraorbital: return "intraorbital";
  case Admission::Bone: return "bone";
  default: return "any";
  }
}

/// Splits the name of the probability file into what precedes a class's label in the names of the files beside it, and
/// what follows it.
std::pair<std::string, std::string> besideProbability(const std::filesystem::path& name)
{
  const std::string file = name.filename().string();
  const std::size_t end = file.find('.');
  return { (name.parent_path() / file.substr(0, end)).string() + "-", file.substr(end) };
}

std::vector<std::string> channelFiles(const CommandLine& line)
{
  std::vector<std::string> files = line.texts("channel");
  for (const std::string& file : { line.text("channel2"), line.text("channel3") })
  {
    if (!file.empty()) files.push_back(file);
  }
  return files;
}

void writeReport(const std::string& file, const CommandLine& line, const std::vector<TissueClass>& classes,
                 const Classification& found)
{
  const auto writeMembers = [&](JsonWriter& json)
  {
    writeMember(json, "module", "TissueMapper");
    writeMember(json, "image", line.text("image"));
    json.Key("channels");
    json.StartArray();
    for (const std::string& channel : channelFiles(line)) writeValue(json, printable(channel));
    json.EndArray();
    writeMember(json, "biasCorrected", line.flag("correctBias"));
    writeMember(json, "denoised", line.flag("denoise"));
    writeMember(json, "compartments", !line.flag("noCompartments"));
    writeMember(json, "contiguity", !line.flag("noContiguity"));
    writeMember(json, "proximity", !line.flag("noProximity"));
    writeMember(json, "boneThreshold", found.boneThreshold);
    const std::map<Label, std::size_t> voxels = countVoxels(found.map);
    json.Key("classes");
    json.StartArray();
    for (std::size_t c = 0; c < classes.size(); ++c)
    {
      const auto count = voxels.find(classes[c].label);
      json.StartObject();
      writeMember(json, "label", classes[c].label);
      writeMember(json, "name", classes[c].name);
      writeMember(json, "compartment", nameOf(classes[c].admission));
      writeMember(json, "trainingPoints", classes[c].points.size());
      writeMember(json, "voxels", count == voxels.end() ? std::size_t(0) : count->second);
      writeMember(json, "invalidated", found.invalidated[c]);
      writeMember(json, "unreached", found.unreached[c]);
      json.EndObject();
    }
    json.EndArray();
  };
  writeBytes(jsonText(writeMembers, { 6 }), file);
}

void requireMemory(const ScalarImage& image, std::size_t channels, const std::string& file)
{
  constexpr double bytesPerVoxel = 80, perChannel = 30; // features of the trees, and the images they are computed from
  const double needed = 50e6 + (bytesPerVoxel + perChannel * double(channels)) * double(image.grid.voxelCount());
  const std::optional<std::uint64_t> available = availableMemory();
  if (!available || needed <= double(*available)) return;
  throw InputError(file + ": an image of this size takes about " + std::to_string(std::lround(needed / 1e6)) +
                   " MB of memory, found " + std::to_string(std::lround(double(*available) / 1e6)) + " MB available");
}

/// Writes one image with the probability of each voxel's class, and beside it one image for every class.
void writeProbabilities(CommandLine& line, const std::vector<TissueClass>& classes, Classification& found)
{
  const std::string file = line.outputFile("probability");
  if (file.empty()) return;
  const std::filesystem::path name = line.outputNames("probability").front();
  const auto [before, after] = besideProbability(name);
  ScalarImage image{ found.map.grid, std::vector<float>(found.map.labels.size(), 0) };
  for (std::size_t c = 0; c < classes.size(); ++c)
    for (std::size_t n = 0; n < image.values.size(); ++n)
      if (found.map.labels[n] == classes[c].label) image.values[n] = found.probabilities[c][n];
  writeImage(image, file);
  for (std::size_t c = 0; c < classes.size(); ++c)
  {
    image.values = std::move(found.probabilities[c]);
    writeImage(image, line.outputPath(before + std::to_string(classes[c].label) + after));
  }
}

void writeCompartments(const Classification& found, const std::string& file)
{
  TissueMap map;
  map.grid = found.map.grid;
  for (const Compartment compartment : found.compartments) map.labels.push_back(Label(compartment));
  map.table = compartmentTable();
  writeTissueMap(map, file);
}

HeadImages readImages(const CommandLine& line)
{
  std::vector<std::string> files = channelFiles(line);
  files.insert(files.begin(), line.text("image"));
  std::vector<ScalarImage> channels;
  for (const std::string& file : files)
  {
    channels.push_back(readImage(file));
    if (channels.size() == 1) requireMemory(channels[0], files.size(), file);
  }
  try
  {
    return headImages(std::move(channels));
  }
  catch (const InputError& error)
  {
    throw InputError(text::joined(files, ", ") + ": " + error.what());
  }
}

Classification classifyFiles(const CommandLine& line, const std::vector<TissueClass>& classes,
                             const ClassificationOptions& options, const Progress& progress)
{
  HeadImages images = readImages(line);
  try
  {
    return classifyTissues(std::move(images), classes, options, progress);
  }
  catch (const InputError& error)
  {
    throw InputError(line.text("training") + " in " + line.text("image") + ": " + error.what());
  }
}

void warnOfOddities(CommandLine& line, const std::vector<TissueClass>& classes, const Classification& found)
{
  const std::vector<Label> present = presentLabels(found.map);
  for (std::size_t c = 0; c < classes.size(); ++c)
  {
    const TissueClass& tissue = classes[c];
    if (!std::binary_search(present.begin(), present.end(), tissue.label)) line.warning(tissue.name + " has no voxel");
    if (found.unreached[c] == 0) continue;
    line.warning(std::to_string(found.unreached[c]) + " voxels of " + tissue.name +
                 " are not reached from its training points, but no other class may take them");
  }
}

void run(CommandLine& line)
{
  setThreadCount(line.integer("threads"));
  const Progress progress = line.progress();
  report(progress, 0, "reading");
  for (const std::string& name : line.outputNames("probability"))
  {
    const auto [before, after] = besideProbability(name);
    line.alsoWritesMany("probability", before, after);
  }
  if (line.text("training").empty())
    throw UsageError("--training is missing, expected a markups file of labelled training points");
  if (line.flag("noCompartments") && !line.outputNames("compartments").empty())
    throw UsageError("--compartments: none are found with --noCompartments");
  const std::vector<TissueClass> classes = readTissueClasses(line.text("training"), line.text("classes"));
  ClassificationOptions options;
  options.useCompartments = !line.flag("noCompartments");
  options.useContiguity = !line.flag("noContiguity");
  options.useProximity = !line.flag("noProximity");
  options.correctBias = line.flag("correctBias");
  options.denoise = line.flag("denoise");
  options.withProbabilities = !line.outputNames("probability").empty();
  Classification found = classifyFiles(line, classes, options, subProgress(progress, 0.05, 0.95));
  report(progress, 0.95, "writing");
  colour(found.map.table);
  writeTissueMap(found.map, line.outputFile("labelMap"));
  writeProbabilities(line, classes, found);
  const std::string compartmentsFile = line.outputFile("compartments");
  if (!compartmentsFile.empty()) writeCompartments(found, compartmentsFile);
  const std::string namesFile = line.outputFile("names");
  if (!namesFile.empty()) writeTissueNames(found.map.table, namesFile);
  const std::string reportFile = line.outputFile("report");
  if (!reportFile.empty()) writeReport(reportFile, line, classes, found);
  warnOfOddities(line, classes, found);
  line.message(std::to_string(presentLabels(found.map).size()) + " tissues");
  report(progress, 1, "done");
}

} // namespace

int main(int argc, char** argv) { return runModule(argc, argv, moduleXML, run); }
