// SPDX-License-Identifier: Apache-2.0
// SimplexMesherCLI reads a label map and a scale, and writes the prepared map, the common surface of all tissues and
// its ambient tetrahedra.

#include "AvailableMemory.h"
#include "BoundaryDistance.h"
#include "CommandLine.h"
#include "Errors.h"
#include "FaceAdjacency.h"
#include "IntensityImage.h"
#include "MemoryEstimate.h"
#include "MeshChecks.h"
#include "MeshIO.h"
#include "Parallel.h"
#include "Report.h"
#include "ScaleOption.h"
#include "SimplexMesh.h"
#include "SimplexMesherCLIXML.h"
#include "TextFile.h"
#include "TissueFidelity.h"
#include "TissueMapIO.h"
#include "TissueScale.h"
#include "TissueSurfaces.h"
#include "Warnings.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <sstream>

using namespace surgicalmesher;

namespace
{

/// Throws EngineError unless every tissue of the mesh has the Betti numbers that it has in the map.
void requireTopology(const TetMesh& mesh, const std::map<Label, Betti>& wanted)
{
  const auto got = meshTopology(mesh);
  for (const auto& [label, betti] : wanted)
  {
    const auto at = got.find(label);
    if (at == got.end()) throw EngineError("surface: tissue " + std::to_string(label) + " got lost");
    if (!(at->second == betti)) throw EngineError("surface: tissue " + std::to_string(label) + " changed its topology");
  }
}

TetMesh toWorld(TetMesh mesh, const Grid& grid)
{
  for (Vec3& p : mesh.points) p = grid.gridToWorld(p);
  return mesh;
}

/// Marks the labels to be held fixed; must precede the joining of groups.
void markNullDisplacement(CommandLine& line, TissueMap& map)
{
  const std::string labels = line.text("nullDisplacementLabels");
  if (text::trimmed(labels).empty()) return;
  const std::vector<Label> present = presentLabels(map);
  for (const std::string& word : text::splitFields(labels))
  {
    long label = 0;
    if (!text::parseInteger(text::trimmed(word), 1, 65535, label))
      throw UsageError("--nullDisplacementLabels: \"" + word + "\", expected labels from 1 to 65535");
    if (std::binary_search(present.begin(), present.end(), Label(label)))
      map.table[Label(label)].isNullDisplacement = true;
    else line.warning("--nullDisplacementLabels: no voxel of label " + std::to_string(label) + " in the label map");
  }
}

/// Makes the surroundings a tissue; must precede the reading of the tissue table, which may refer to it.
void fillSurroundings(const CommandLine& line, TissueMap& map)
{
  const auto label = Label(line.integer("background"));
  if (label == 0) return;
  if (!fillBackground(map, label))
    throw InputError(line.text("labelMap") + ": --background " + std::to_string(label) +
                     ", expected a label that no voxel has");
}

/// Reads the map and the settings of its tissues; joins groups and removes tissues that are left out.
TissueMap readMap(CommandLine& line, SurfaceReport& results)
{
  TissueMap map = readTissueMap(line.text("labelMap"));
  fillSurroundings(line, map);
  std::vector<std::string> warnings;
  completeTissueTable(map, line.text("names"), &warnings);
  const std::string intensities = likenessToIntensities(map);
  if (!intensities.empty()) warnings.push_back(line.text("labelMap") + ": " + intensities);
  for (const std::string& warning : warnings) line.warning(warning);
  markNullDisplacement(line, map);
  const std::string file = line.text("tissues");
  if (!file.empty()) results.settings = readTissueSettings(file, map);
  results.selection = selectTissues(map, results.settings);
  for (const std::string& warning : warningsOfGroups(results.selection)) line.warning(warning);
  return map;
}

std::string spacingText(const Grid& grid)
{
  const Vec3& mm = grid.spacing;
  const std::string x = text::rounded(mm.x), y = text::rounded(mm.y), z = text::rounded(mm.z);
  return (x == y && y == z ? x : x + " x " + y + " x " + z) + " mm";
}

/// Replaces voxels that repeat coarser ones by these. Surroundings that are a tissue must already be filled, since they
/// reach to the border, whose blocks must be complete.
void takeRepeatsOut(CommandLine& line, const ScaleField& asked, TissueMap& map, SurfaceReport& results)
{
  results.repeats = findRepeats(map, *std::min_element(asked.lengths.begin(), asked.lengths.end()));
  if (results.repeats.times == 1) return;
  map = withoutRepeats(map, results.repeats);
  const std::string times = std::to_string(results.repeats.times);
  line.message(line.text("labelMap") + ": every voxel is there " + times + " x " + times + " x " + times +
               " times; meshed are voxels of " + spacingText(map.grid));
}

PreparationOptions readPreparation(const CommandLine& line, const TissueSettings& settings)
{
  PreparationOptions options;
  options.minimumIslandVolume = line.number("minimumIslandVolume");
  options.minimumCavityVolume = line.number("minimumCavityVolume");
  for (const auto& [label, setting] : settings)
  {
    if (setting.islandVolume >= 0) options.islandVolumes[label] = setting.islandVolume;
    if (setting.cavityVolume >= 0) options.cavityVolumes[label] = setting.cavityVolume;
  }
  return options;
}

FeatureOptions readFeatures(const CommandLine& line, const TissueSettings& settings)
{
  FeatureOptions options;
  options.featureScale = line.number("featureScale");
  for (const auto& [label, setting] : settings)
  {
    if (setting.isProtected) options.protectedLabels.insert(label);
  }
  return options;
}

Proximity readProximity(const CommandLine& line)
{
  const std::vector<double> mm = line.numbers("proximity");
  const bool isNone = mm == std::vector<double>{ 0, 0 };
  if (!isNone && (mm.size() != 2 || !(mm[0] > 0) || mm[1] < mm[0]))
    throw UsageError("--proximity: expected NEAR,FAR with 0 < NEAR <= FAR (mm), or 0,0");
  return { mm[0], mm[1] };
}

void warnOfProximity(CommandLine& line, const MeshedMap& mesh)
{
  const EvolutionStep& last = mesh.evolution.back();
  if (last.beyond == 0) return;
  std::ostringstream text;
  text << "--proximity: " << last.beyond << " of " << mesh.background.samples.size()
       << " boundary samples are farther from the surface than asked for, the farthest " << last.maximumDistance
       << " mm";
  line.warning(text.str());
}

/// Prepares the map to which the surface is to be faithful.
void prepare(CommandLine& line, TissueMap& map, const ScaleField& scale, const FeatureOptions& features,
             const Progress& progress, SurfaceReport& results)
{
  results.featureScale = features.featureScale;
  results.preparation = prepareAtScale(map, followTissues(scale, map, results.settings, line.number("gradation")),
                                       readPreparation(line, results.settings), features, progress);
  results.tissues = map.table;
  const std::string file = line.outputFile("preparedLabelMap");
  runInParallel({ [&] { results.structures = structuresOf(map); },
                  [&]
                  {
                    if (!file.empty()) writeTissueMap(withRepeats(map, results.repeats), file);
                  } });
  for (const Structure& structure : results.structures) results.topology[structure.label] += structure.topology;
}

/// Returns the edge lengths that the surface follows on the prepared map.
ScaleField lengthsFor(CommandLine& line, const TissueMap& map, const ScaleField& asked,
                      const TissueMesherOptions& options, SurfaceReport& results)
{
  const double gradation = line.number("gradation");
  ScaleField scale = followTissues(asked, map, results.settings, gradation);
  results.thickness = measureThickness(map, scale);
  results.followsThickness = line.flag("followThickness");
  if (results.followsThickness) // the bounds of the table apply after this as well
  {
    scale = followThickness(scale, map, results.thickness.thinVoxels, gradation);
    scale = followTissues(scale, map, results.settings, gradation);
  }
  if (const double chordError = line.number("chordError"); chordError > 0)
  {
    scale = followBoundary(map, scale, options, chordError, gradation);
    scale = followTissues(scale, map, results.settings, gradation);
  }
  const std::string file = line.outputFile("followedScale");
  if (!file.empty()) writeScale(scaleVolume(scale, map.grid), file);
  return scale;
}

/// Returns the file content of a surface in the grid frame of `map`, transformed to its place in `world`.
SurfaceFile surfaceFile(const TetMesh& ambient, const TissueMap& map, const Grid& world, const ScaleField& scale)
{
  SurfaceFile content;
  content.surface = interfaceOf(ambient);
  content.boundaryDistance = boundaryDistances(content.surface, map);
  for (Vec3& p : content.surface.points)
  {
    p = world.gridToWorld(p);
    content.targetEdgeLength.push_back(scale(p));
  }
  content.tissues = map.table;
  return content;
}

PolygonFile simplexMeshFile(const SurfaceFile& surface)
{
  const SimplexMesh mesh = simplexMeshOf(surface.surface);
  PolygonFile content;
  content.points = mesh.points;
  content.tissues = surface.tissues;
  for (SimplexFace& face : simplexFaces(mesh))
  {
    content.polygons.push_back(std::move(face.vertices));
    content.labels.push_back(face.tissue);
  }
  return content;
}

/// Writes one file per tissue beside the index, named after the index and the label.
void writeTissueSurfaces(CommandLine& line, const SurfaceFile& content)
{
  const std::string index = line.outputFile("tissueSurfaces");
  if (index.empty()) return;
  const std::filesystem::path name = line.outputNames("tissueSurfaces").front();
  std::map<Label, std::string> files;
  for (const auto& [label, part] : tissueSurfaces(content))
  {
    files[label] = name.stem().string() + "-" + std::to_string(label) + ".vtp";
    writeSurface(part, line.outputPath((name.parent_path() / files[label]).string()));
  }
  writeBytes(multiBlockIndex(files, content.tissues), index);
}

void writeAmbient(CommandLine& line, const MeshedMap& mesh, const Grid& world, const TissueTable& tissues,
                  const ScaleField& scale)
{
  const std::string file = line.outputFile("ambient");
  if (file.empty()) return;
  MeshFile ambient;
  ambient.mesh = toWorld(mesh.background.mesh, world);
  ambient.targetAngle = mesh.targetAngle;
  ambient.tissues = tissues;
  for (const Vec3& p : ambient.mesh.points) ambient.targetEdgeLength.push_back(scale(p));
  writeMesh(ambient, file);
}

/// Writes all files of the surface except reports.
void writeSurfaces(CommandLine& line, const SurfaceFile& content)
{
  writeSurface(content, line.outputFile("surface"));
  writeTissueSurfaces(line, content);
  const std::string simplexMesh = line.outputFile("simplexMesh");
  if (!simplexMesh.empty()) writePolygons(simplexMeshFile(content), simplexMesh);
}

/// Checks what the command line alone determines.
void requireUsableOptions(CommandLine& line)
{
  for (const std::string& index : line.outputNames("tissueSurfaces"))
  {
    const std::filesystem::path name = index;
    line.alsoWritesMany("tissueSurfaces", (name.parent_path() / name.stem()).string() + "-", ".vtp");
  }
}

/// Assesses distances, only if figures are requested: it takes more than a second per million voxel faces.
void assessDistances(CommandLine& line, const SurfaceComplex& surface, const TissueMap& map, const Grid& world,
                     SurfaceReport& results)
{
  const double bound = line.number("maximumDistance");
  if (line.outputFile("report").empty() && bound == 0) return;
  SurfaceComplex inOwnFrame = surface;
  for (Vec3& p : inOwnFrame.points) p = world.worldToGrid(p);
  results.world = world;
  results.maximumDistance = bound;
  results.fidelity = assessFidelity(inOwnFrame, map, bound > 0 ? bound : std::numeric_limits<double>::infinity());
  const std::string volumes = warningOfVolumes(results.fidelity, map);
  if (!volumes.empty()) line.warning(volumes);
  if (bound == 0) return;
  for (const std::string& warning : warningsOfDistance(results.fidelity, bound, world)) line.warning(warning);
}

/// Whether `tissue` has a voxel thinner than L at or next to a position in the map's own frame.
bool isThinAt(const TissueMap& map, const std::vector<ThinVoxel>& thinVoxels, Label tissue, const Vec3& place)
{
  std::array<int, 3> at;
  for (int axis = 0; axis < 3; ++axis) at[axis] = int(std::lround(place[axis] / map.grid.spacing[axis]));
  for (int n = 0; n < 27; ++n)
  {
    const int i = at[0] + n % 3 - 1, j = at[1] + n / 3 % 3 - 1, k = at[2] + n / 9 - 1;
    if (!map.grid.contains(i, j, k)) continue;
    const std::size_t voxel = map.grid.index(i, j, k);
    const bool isThin = std::binary_search(thinVoxels.begin(), thinVoxels.end(), ThinVoxel{ voxel, 0 },
                                           [](const auto& a, const auto& b) { return a.voxel < b.voxel; });
    if (isThin && map.labels[voxel] == tissue) return true;
  }
  return false;
}

/// Assesses folds and ears, for the report only; `map` is in its own frame.
void assessShape(const BackgroundMesh& background, const TissueMap& map, SurfaceReport& results)
{
  const auto isThin = [&](Label tissue, const Vec3& place)
  { return isThinAt(map, results.thickness.thinVoxels, tissue, place); };
  const SurfaceComplex surface = interfaceOf(background.mesh, background.neighbours);
  results.folds = surfaceFolds(surface, boundaryNormals(background), isThin);
  results.ears = hangingPieces(background.mesh, background.neighbours);
}

void returnFigures(CommandLine& line, const SurfaceReport& results)
{
  line.returnValue("tissueCount", std::to_string(results.topology.size()));
  line.returnValue("pointCount", std::to_string(results.points));
  line.returnValue("triangleCount", std::to_string(results.triangles));
}

void writeReports(CommandLine& line, SurfaceReport& results)
{
  results.warnings = line.warnings();
  const std::string report = line.outputFile("report");
  if (!report.empty()) writeBytes(reportJson(results), report);
  const std::string evolution = line.outputFile("evolution");
  if (!evolution.empty()) writeBytes(evolutionCsv(results.evolution), evolution);
  std::ostringstream summary;
  summary << results.triangles << " triangles between " << results.topology.size() << " tissues, "
          << voxelsOfFile(results.preparation.preparation.contactVoxelsChanged, results)
          << " voxels changed to resolve contacts";
  line.message(summary.str());
}

void run(CommandLine& line)
{
  vtkSMPTools::Initialize(line.integer("threads"));
  const Progress progress = line.progress();
  report(progress, 0, "reading");
  requireUsableOptions(line);
  SurfaceReport results;
  TissueMap map = readMap(line, results);
  const ScaleField asked = readScaleOption(line.text("scale"), line.number("edgeLength"), map.grid);
  takeRepeatsOut(line, asked, map, results);
  completeShells(results.settings, map, asked);
  TissueMesherOptions options;
  options.maximumDistance = line.number("maximumDistance");
  options.smoothing = line.number("smoothing");
  options.rigidity = line.number("rigidity");
  options.continuity = Continuity(line.integer("continuity"));
  options.proximity = readProximity(line);
  options.features = readFeatures(line, results.settings);
  prepare(line, map, asked, options.features, subProgress(progress, 0.02, 0.06), results);
  const ScaleField scale = lengthsFor(line, map, asked, options, results);
  const std::string tooShort = warningOfShortLengths(map, scale, line.text("labelMap"));
  if (!tooShort.empty()) line.warning(tooShort);
  const MeshingSize size = meshingSize(map, scale, leavesVoxels(options));
  requireMemory(estimateSurfaceMemory(size), availableMemory(), line.text("labelMap"));

  const Grid world = map.grid;
  map.grid = inOwnFrame(world);
  MeshedMap mesh = meshTissues(map, inFrameOf(world, scale), options, subProgress(progress, 0.06, 0.9));

  report(progress, 0.9, "checks and files");
  const SurfaceFile content = surfaceFile(mesh.background.mesh, map, world, scale);
  const bool isReported = !line.outputFile("report").empty(); // outputFile() must not be called in parallel
  runInParallel({ [&]
                  {
                    requireSound(mesh.background.mesh, "surface");
                    requireTopology(mesh.background.mesh, results.topology);
                  },
                  [&]
                  {
                    writeSurfaces(line, content);
                    writeAmbient(line, mesh, world, map.table, scale);
                  },
                  [&]
                  {
                    if (isReported) assessShape(mesh.background, map, results);
                  } });
  results.points = content.surface.points.size();
  results.triangles = content.surface.triangles.size();
  results.evolution = mesh.evolution;
  if (options.proximity.isAsked()) warnOfProximity(line, mesh);
  results.smoothing = options.smoothing;
  results.smoothed = mesh.smoothed;
  report(progress, 0.95, "distances");
  assessDistances(line, content.surface, map, world, results);
  writeReports(line, results);
  returnFigures(line, results);
  report(progress, 1, "done");
}

} // namespace

int main(int argc, char** argv) { return runModule(argc, argv, moduleXML, run); }
