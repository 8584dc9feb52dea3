// SPDX-License-Identifier: Apache-2.0
// BalloonSurfaceCLI reads a label map and seeds, and writes closed surfaces grown from the seeds and the voxels they
// enclose.

#include "Balloon.h"
#include "BalloonSurfaceCLIXML.h"
#include "CommandLine.h"
#include "EnclosedVoxels.h"
#include "Errors.h"
#include "GrowthSeries.h"
#include "JsonReport.h"
#include "MeshChecks.h"
#include "MeshIO.h"
#include "Place.h"
#include "PrintableText.h"
#include "ScaleOption.h"
#include "SharedInterface.h"
#include "Structures.h"
#include "TextFile.h"
#include "TissueMapIO.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

using namespace surgicalmesher;

namespace
{

struct Seed
{
  Vec3 place; ///< LPS, mm
  std::string name;
};

std::vector<Seed> readSeeds(const CommandLine& line)
{
  const std::string file = line.text("seeds");
  if (file.empty()) throw UsageError("--seeds is missing, expected a markups file with a point for each balloon");
  std::vector<Seed> seeds;
  std::set<std::string> names;
  for (const Markup& markup : readLabelledMarkups(file))
    for (std::size_t n = 0; n < markup.points.size(); ++n)
    {
      const std::string given = n < markup.labels.size() ? text::trimmed(markup.labels[n]) : std::string();
      const std::string name = given.empty() ? "balloon " + std::to_string(seeds.size() + 1) : given;
      if (!names.insert(name).second)
        throw InputError(file + ": two seeds are called \"" + name + "\", expected a name for each");
      seeds.push_back({ markup.points[n], name });
    }
  if (seeds.empty()) throw InputError(file + ": no point, expected one for each balloon");
  return seeds;
}

std::set<Label> readStops(const CommandLine& line, const TissueMap& map)
{
  const std::string tissues = line.text("stop");
  if (text::trimmed(tissues).empty())
    throw UsageError("--stop is missing, expected labels or names of tissues, separated by commas");
  const std::vector<Label> present = presentLabels(map);
  std::set<Label> stops;
  for (const std::string& tissue : text::splitFields(tissues))
  {
    Label label = 0;
    if (!findTissue(tissue, map.table, label)) throw UsageError("--stop: " + whyNoTissue(tissue, map.table));
    if (label != 0 && !std::binary_search(present.begin(), present.end(), label))
      throw UsageError("--stop: no voxel of tissue " + tissue + " in the label map");
    stops.insert(label);
  }
  return stops;
}

/// Returns the seeds in the grid frame, each with a free label, whose name and colour are added to `map.table`.
std::vector<BalloonSeed> placeSeeds(const std::vector<Seed>& seeds, const std::string& file,
                                    const std::set<Label>& stops, TissueMap& map)
{
  const std::vector<Label> labels = freeLabels(map, seeds.size());
  if (labels.size() < seeds.size())
    throw InputError("the label map leaves " + std::to_string(labels.size()) + " labels, expected one for each of " +
                     std::to_string(seeds.size()) + " balloons");
  std::vector<BalloonSeed> placed;
  for (const Seed& seed : seeds)
  {
    const std::string what = file + ": seed \"" + seed.name + "\" at " + place(seed.place) + " LPS ";
    const Vec3 p = map.grid.worldToGrid(seed.place);
    std::array<int, 3> voxel;
    for (int a = 0; a < 3; ++a) voxel[a] = int(std::floor(p[a] / map.grid.spacing[a] + 0.5));
    if (!map.grid.contains(voxel[0], voxel[1], voxel[2])) throw InputError(what + "lies outside the label map");
    const Label here = labelAt(map, voxel);
    if (stops.count(here) > 0)
      throw InputError(what + "lies in " + nameOf(here, map.table) + ", which --stop names, expected a free place");
    placed.push_back({ p, labels[placed.size()] });
  }
  constexpr std::array<std::array<double, 3>, 4> colors{
    { { 0.55, 0.75, 0.9 }, { 0.95, 0.75, 0.55 }, { 0.65, 0.85, 0.6 }, { 0.85, 0.65, 0.85 } }
  };
  for (std::size_t n = 0; n < seeds.size(); ++n)
  {
    map.table[placed[n].tissue].name = seeds[n].name;
    map.table[placed[n].tissue].color = colors[n % colors.size()];
  }
  return placed;
}

BalloonOptions readOptions(const CommandLine& line)
{
  BalloonOptions options;
  options.areaTolerance = line.number("areaTolerance") / 100;
  options.limit = line.number("limit");
  options.rigidity = line.number("rigidity");
  const std::string continuity = line.text("continuity");
  options.continuity = continuity == "C0" ? Continuity::C0 : continuity == "C1" ? Continuity::C1 : Continuity::C2;
  return options;
}

std::string evolutionCSV(const std::vector<BalloonStep>& steps)
{
  std::ostringstream out;
  out << "motion,faces,vertices,area,volume,meanMove,withinTolerance,T1,T2,T7\n";
  for (const BalloonStep& s : steps)
    out << s.motion << ',' << s.faces << ',' << s.vertices << ',' << s.area << ',' << s.volume << ',' << s.meanMove
        << ',' << s.withinTolerance << ',' << s.operations.t1 << ',' << s.operations.t2 << ',' << s.operations.t7
        << '\n';
  return out.str();
}

/// Warns if balloons were held by something else than stopping tissues or did not come to rest.
void warn(CommandLine& line, const BalloonResult& result, const TissueMap& map, const BalloonOptions& options)
{
  for (const auto& [label, halt] : result.halts)
  {
    const std::string name = nameOf(label, map.table), of = " of " + std::to_string(halt.faces()) + " faces of ";
    if (halt.limit > 0)
    {
      std::ostringstream limit;
      limit << options.limit;
      line.warning(std::to_string(halt.limit) + of + name + " are held by the limit of " + limit.str() +
                   " mm alone: there the membrane has found no tissue to stop it");
    }
    if (2 * halt.rigidity > halt.faces())
      line.warning(std::to_string(halt.rigidity) + of + name +
                   " are held by the membrane's rigidity alone: a smaller --rigidity lets it into narrower places");
    if (halt.end > 0)
      line.warning(std::to_string(halt.end) + of + name + " are held by the end of the label map alone");
  }
  if (!result.isAtRest) line.warning("the balloons were still moving when the motions ran out");
}

void writeTissue(JsonWriter& json, Label label, const BalloonHalt& halt, const BalloonSize& size, std::size_t voxels,
                 const TissueTable& table)
{
  writeMember(json, "label", label);
  writeMember(json, "name", printable(nameOf(label, table)));
  writeMember(json, "volume", size.volume);
  writeMember(json, "area", size.area);
  writeMember(json, "voxels", voxels);
  writeMember(json, "faces", halt.faces());
  json.Key("heldBy");
  json.StartObject();
  writeMember(json, "tissue", halt.tissue);
  writeMember(json, "limit", halt.limit);
  writeMember(json, "end", halt.end);
  writeMember(json, "neighbour", halt.neighbour);
  writeMember(json, "rigidity", halt.rigidity);
  json.EndObject();
}

/// Returns the report: lengths in mm, areas in mm^2, volumes in mm^3.
std::string reportJSON(const CommandLine& line, const BalloonResult& result, const std::map<Label, std::size_t>& voxels,
                       const TissueTable& table)
{
  const auto writeMembers = [&](JsonWriter& json)
  {
    writeMember(json, "module", std::string("BalloonSurface"));
    json.Key("parameters");
    json.StartObject();
    for (const char* name : { "stop", "continuity" }) writeMember(json, name, line.text(name));
    for (const char* name : { "edgeLength", "areaTolerance", "limit", "rigidity" })
      writeMember(json, name, line.number(name));
    json.EndObject();
    const BalloonStep& last = result.evolution.back();
    writeMember(json, "motions", last.motion);
    writeMember(json, "atRest", result.isAtRest);
    writeMember(json, "withinTolerance", last.withinTolerance);
    writeMember(json, "triangles", result.surface.triangles.size());
    const std::map<Label, BalloonSize> sizes = balloonSizes(result.surface);
    writeObjects(json, "tissues", result.halts,
                 [&](const auto& tissue)
                 {
                   const Label label = tissue.first;
                   writeTissue(json, label, tissue.second, sizes.at(label), voxels.at(label), table);
                 });
    writeWarnings(json, line.warnings());
  };
  return jsonText(writeMembers, { 6 });
}

/// Assigns the enclosed voxels, except those of stopping tissues, to the balloons; returns their numbers.
std::map<Label, std::size_t> fill(TissueMap& map, const BalloonResult& result, const std::set<Label>& stops)
{
  std::map<Label, std::size_t> counts;
  for (const auto& [label, halt] : result.halts)
  {
    counts[label] = 0;
    for (const std::size_t voxel : enclosedVoxels(result.surface, label, map.grid))
    {
      if (stops.count(map.labels[voxel]) > 0) continue;
      map.labels[voxel] = label;
      ++counts[label];
    }
  }
  return counts;
}

SurfaceFile surfaceFile(const SurfaceComplex& surface, const TissueMap& map, const BalloonOptions& options)
{
  SurfaceFile content;
  content.surface = surface;
  for (Vec3& p : content.surface.points)
  {
    content.targetEdgeLength.push_back(options.edgeLength(p));
    p = map.grid.gridToWorld(p);
  }
  content.tissues = map.table;
  return content;
}

/// Gives balloons that lie against each other a common interface.
void shareInterfaces(BalloonResult& result, const TissueMap& map, const std::set<Label>& stops,
                     const BalloonOptions& options, const Progress& progress)
{
  const bool meet =
    std::any_of(result.halts.begin(), result.halts.end(), [](const auto& halt) { return halt.second.neighbour > 0; });
  if (!meet) return;
  std::vector<bool> isFree(map.labels.size());
  for (std::size_t n = 0; n < isFree.size(); ++n) isFree[n] = stops.count(map.labels[n]) == 0;
  const BalloonStep& last = result.evolution.back();
  const double edge = std::sqrt(last.area / double(last.vertices));
  const double gap = 2 * std::max(map.grid.largestSpacing(), edge);
  result.surface = withSharedInterfaces(result.surface, map.grid, isFree, gap, options.edgeLength, progress);
  requireSound(result.surface, "balloons' interface");
}

void run(CommandLine& line)
{
  vtkSMPTools::Initialize(line.integer("threads"));
  const Progress progress = line.progress();
  report(progress, 0, "reading");
  GrowthSeries growth(line, line.outputNames("growth"));
  BalloonOptions options = readOptions(line);
  const std::vector<Seed> seeds = readSeeds(line);
  TissueMap map = readTissueMap(line.text("map"));
  std::vector<std::string> oddities;
  completeTissueTable(map, line.text("names"), &oddities);
  for (const std::string& oddity : oddities) line.warning(oddity);
  const ScaleField scale = readScaleOption(line.text("scale"), line.number("edgeLength"), map.grid);
  const std::set<Label> stops = readStops(line, map);
  const std::vector<BalloonSeed> placed = placeSeeds(seeds, line.text("seeds"), stops, map);
  options.edgeLength = [&](const Vec3& p) { return double(scale(map.grid.gridToWorld(p))); };

  const StoppingField field(map, stops, options.rigidity / 2 + map.grid.largestSpacing());
  const BalloonWatch watch =
    growth.watch([&](const SurfaceComplex& surface) { return surfaceFile(surface, map, options); });
  BalloonResult result = growBalloons(placed, field, options, subProgress(progress, 0.1, 0.9), watch);
  shareInterfaces(result, map, stops, options, subProgress(progress, 0.9, 0.95));
  warn(line, result, map, options);

  report(progress, 0.95, "writing");
  writeSurface(surfaceFile(result.surface, map, options), line.outputFile("surface"));
  growth.writeIndex(line.outputFile("growth"));
  const std::map<Label, std::size_t> voxels = fill(map, result, stops);
  const std::string labelMap = line.outputFile("labelMap"), evolution = line.outputFile("evolution"),
                    reportFile = line.outputFile("report");
  if (!labelMap.empty()) writeTissueMap(map, labelMap);
  if (!evolution.empty()) writeBytes(evolutionCSV(result.evolution), evolution);
  if (!reportFile.empty()) writeBytes(reportJSON(line, result, voxels, map.table), reportFile);
  const std::string triangles = std::to_string(result.surface.triangles.size()),
                    motions = std::to_string(result.evolution.back().motion);
  line.message(triangles + " triangles after " + motions + " motions");
  line.returnValue("triangleCount", triangles);
  line.returnValue("motionCount", motions);
  report(progress, 1, "done");
}

} // namespace

int main(int argc, char** argv) { return runModule(argc, argv, moduleXML, run); }
