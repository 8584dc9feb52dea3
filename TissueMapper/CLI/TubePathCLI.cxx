// SPDX-License-Identifier: Apache-2.0
// TubePathCLI: traces a vessel or nerve through a few points in an image, and writes its axis, radius and voxels.

#include "AvailableMemory.h"
#include "CommandLine.h"
#include "Errors.h"
#include "JsonReport.h"
#include "PathRefinement.h"
#include "Place.h"
#include "TextFile.h"
#include "ThreadCount.h"
#include "TissueMapIO.h"
#include "TubeLabel.h"
#include "TubePathCLIXML.h"
#include "TubePathIO.h"

#include <algorithm>
#include <numeric>

using namespace surgicalmesher;

namespace
{

/// Results of the run besides its output files.
struct Results
{
  Label label = 1; ///< of the tube in the label map
  std::size_t voxels = 0;
  double weakest = 1; ///< least flux along the path divided by the mean
  std::vector<std::string> warnings;
};

void requireApart(const std::vector<Vec3>& places, const std::string& file)
{
  constexpr double leastDistance = 0.01; // mm
  const auto isApart = [&](const Vec3& p) { return norm(p - places.front()) > leastDistance; };
  if (std::any_of(places.begin(), places.end(), isApart)) return;
  throw InputError(file + ": " + std::to_string(places.size()) + " points in one place, expected two or more apart");
}

std::vector<Vec3> readPlaces(const CommandLine& line)
{
  const std::string file = line.text("points");
  if (file.empty()) throw UsageError("--points is missing, expected a markups file with points on the tube");
  const std::vector<std::vector<Vec3>> markups = readMarkups(file);
  if (markups.size() > 1)
  {
    throw InputError(file + ": " + std::to_string(markups.size()) + " markups, expected the points of one tube");
  }
  if (markups.front().size() < 2) throw InputError(file + ": one point, expected two or more on the tube");
  requireApart(markups.front(), file);
  return markups.front();
}

TubePathOptions readOptions(const CommandLine& line)
{
  TubePathOptions options;
  const std::vector<double> radius = line.numbers("radius");
  const bool isDefault = radius.size() == 2 && radius[0] == 0 && radius[1] == 0;
  if (!isDefault && !(radius.size() == 2 && radius[0] > 0 && radius[0] <= radius[1] && radius[1] <= 50))
  {
    throw UsageError("--radius: expected two numbers, the smallest and the largest radius, over 0 and at most 50 mm");
  }
  options.minimumRadius = radius[0];
  options.maximumRadius = radius[1];
  const std::string polarity = line.text("polarity");
  options.polarity = polarity == "bright" ? Polarity::Bright
                     : polarity == "dark" ? Polarity::Dark
                                          : Polarity::Automatic;
  const std::string potential = line.text("potential");
  options.potential = potential == "gradient"    ? Potential::Gradient
                      : potential == "intensity" ? Potential::Intensity
                                                 : Potential::Flux;
  options.snapDistance = line.number("snap");
  options.margin = line.number("margin");
  return options;
}

std::vector<TubePath> readBlocked(const CommandLine& line)
{
  std::vector<TubePath> tubes;
  for (const std::string& file : line.texts("block"))
  {
    for (const TubePath& tube : readTubePaths(file, 1))
    {
      if (tube.points.size() < 2) throw InputError(file + ": a path of one point, expected two points or more");
      tubes.push_back(tube);
    }
  }
  return tubes;
}

/// Reads the map of --addTo; without it, returns an empty map on the image's grid.
TissueMap readMap(const CommandLine& line, const Grid& grid)
{
  const std::string file = line.text("addTo");
  if (!file.empty()) return readTissueMap(file);
  TissueMap map;
  map.grid = grid;
  map.labels.assign(grid.voxelCount(), 0);
  return map;
}

/// Sets name and colour of the tube's tissue; a tissue that is present already and named keeps its own.
void nameTissue(const CommandLine& line, const TubePath& tube, TissueMap& map, Results& results)
{
  const std::vector<Label> present = presentLabels(map);
  if (std::binary_search(present.begin(), present.end(), results.label))
  {
    const std::string& name = map.table[results.label].name;
    results.warnings.push_back("label " + std::to_string(results.label) + (name.empty() ? "" : " (" + name + ")") +
                               " has voxels already: the tube joins them, and may touch them anywhere");
    if (!name.empty()) return;
  }
  map.table[results.label].name = line.text("name");
  map.table[results.label].color =
    tube.isBright ? std::array<double, 3>{ 0.85, 0.2, 0.2 } : std::array<double, 3>{ 0.95, 0.85, 0.3 };
}

void writeLabelMap(CommandLine& line, const TubePath& tube, const Grid& grid, Results& results)
{
  const std::string file = line.outputFile("labelMap");
  if (file.empty()) return;
  TissueMap map = readMap(line, grid);
  const bool isFree = !line.text("addTo").empty() && !line.given("label");
  if (isFree)
  {
    const std::vector<Label> free = freeLabels(map, 1);
    if (free.empty()) throw InputError(line.text("addTo") + ": all labels to 65535 are taken, expected a free one");
    results.label = free.front();
  }
  nameTissue(line, tube, map, results);
  const std::vector<std::size_t> voxels = tubeVoxels(map.grid, tube);
  if (voxels.empty()) throw InputError(line.text("addTo") + ": the path lies outside the label map");
  for (const std::size_t n : voxels) map.labels[n] = results.label;
  results.voxels = voxels.size();
  writeTissueMap(map, file);
}

void findOddities(const TubePath& tube, Results& results)
{
  const double mean = std::accumulate(tube.flux.begin(), tube.flux.end(), 0.0) / double(tube.flux.size());
  const auto weakest = std::min_element(tube.flux.begin(), tube.flux.end());
  results.weakest = mean > 0 ? std::max(0.0, *weakest) / mean : 0;
  if (results.weakest >= 0.2) return;
  const Vec3& p = tube.points[std::size_t(weakest - tube.flux.begin())];
  results.warnings.push_back("the tube is hardly to be seen near " + place(p) +
                             " LPS: a point there makes the path surer");
}

/// Writes minimum, mean and maximum of the values.
void write(JsonWriter& json, const char* key, const std::vector<double>& values)
{
  json.Key(key);
  json.StartObject();
  writeMember(json, "minimum", *std::min_element(values.begin(), values.end()));
  writeMember(json, "mean", std::accumulate(values.begin(), values.end(), 0.0) / double(values.size()));
  writeMember(json, "maximum", *std::max_element(values.begin(), values.end()));
  json.EndObject();
}

/// Lengths in mm, points in LPS, flux in the image's unit.
void writeReport(const std::string& file, const CommandLine& line, const TubePath& tube, const Results& results)
{
  const auto writeMembers = [&](JsonWriter& json)
  {
    writeMember(json, "module", "TubePath");
    writeMember(json, "image", line.text("image"));
    json.Key("parameters");
    json.StartObject();
    writeMember(json, "minimumRadius", line.numbers("radius")[0]);
    writeMember(json, "maximumRadius", line.numbers("radius")[1]);
    for (const char* name : { "polarity", "potential" }) writeMember(json, name, line.text(name));
    for (const char* name : { "snap", "margin" }) writeMember(json, name, line.number(name));
    writeMember(json, "label", results.label);
    json.EndObject();
    writeMember(json, "polarity", tube.isBright ? "bright" : "dark");
    writeMember(json, "points", tube.points.size());
    writeMember(json, "length", polylineLength(tube.points));
    write(json, "radius", tube.radii);
    write(json, "flux", tube.flux);
    writeMember(json, "weakestFlux", results.weakest);
    writeMember(json, "voxels", results.voxels);
    writeWarnings(json, results.warnings);
  };
  writeBytes(jsonText(writeMembers, { 6 }), file);
}

void requireMemory(double needed, const std::string& imageFile)
{
  const std::optional<std::uint64_t> available = availableMemory();
  if (!available || needed <= double(*available)) return;
  throw InputError(imageFile + ": the box of the points takes about " + text::rounded(needed / 1e9, 3) +
                   " GB of memory, found " + text::rounded(double(*available) / 1e9, 3) +
                   " GB available, expected more, or a smaller --margin");
}

TubePath traceFiles(const CommandLine& line, const ScalarImage& image, const std::vector<Vec3>& places,
                    const TubePathOptions& options, const Progress& progress)
{
  const std::vector<TubePath> blocked = readBlocked(line);
  try
  {
    return traceTube(image, places, blocked, options, progress);
  }
  catch (const InputError& error)
  {
    throw InputError(line.text("points") + " in " + line.text("image") + ": " + error.what());
  }
}

void run(CommandLine& line)
{
  setThreadCount(line.integer("threads"));
  const Progress progress = line.progress();
  report(progress, 0, "reading");
  const TubePathOptions options = readOptions(line);
  if (!line.text("addTo").empty() && line.outputFile("labelMap").empty())
    throw UsageError("--addTo goes nowhere without --labelMap");
  const std::vector<Vec3> places = readPlaces(line);
  const std::string imageFile = line.text("image");
  const ScalarImage image = readImage(imageFile);
  requireMemory(tubePathMemory(image.grid, places, options), imageFile);
  const TubePath tube = traceFiles(line, image, places, options, subProgress(progress, 0.1, 0.9));

  Results results;
  results.label = Label(line.integer("label"));
  findOddities(tube, results);
  report(progress, 0.9, "writing");
  writeTubePath(tube, line.text("name"), line.outputFile("path"));
  writeLabelMap(line, tube, image.grid, results);
  for (const std::string& warning : results.warnings) line.warning(warning);
  const double length = polylineLength(tube.points);
  line.message(std::string(tube.isBright ? "bright" : "dark") + " tube of " + text::rounded(length, 4) +
               " mm, radius " + text::rounded(*std::min_element(tube.radii.begin(), tube.radii.end()), 3) + " to " +
               text::rounded(*std::max_element(tube.radii.begin(), tube.radii.end()), 3) + " mm");
  line.returnValue("length", text::rounded(length, 8));
  const std::string reportFile = line.outputFile("report");
  if (!reportFile.empty()) writeReport(reportFile, line, tube, results);
  report(progress, 1, "done");
}

} // namespace

int main(int argc, char** argv) { return runModule(argc, argv, moduleXML, run); }
