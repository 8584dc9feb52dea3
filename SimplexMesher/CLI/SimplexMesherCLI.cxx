// SimplexMesherCLI: label map and scale in; prepared map, shared surface of all tissues and its ambient tetrahedra out.

#include "BoundaryDistance.h"
#include "CommandLine.h"
#include "ComplexChecks.h"
#include "ComplexIO.h"
#include "DigitalTopology.h"
#include "Errors.h"
#include "FaceNeighbours.h"
#include "MapPreparation.h"
#include "SimplexMesh.h"
#include "SimplexMesherCLIXML.h"
#include "SurfaceMesher.h"
#include "TissueMapIO.h"

#include <rapidjson/prettywriter.h>
#include <rapidjson/stringbuffer.h>
#include <vtkSMPTools.h>

#include <sstream>

using namespace surgicalmesher;

namespace
{

using JsonWriter = rapidjson::PrettyWriter<rapidjson::StringBuffer>;

ScaleField readScaleFor(const CommandLine& line, const Grid& grid)
{
  const std::string file = line.text("scale");
  const double uniform = line.number("edgeLength");
  if (!file.empty() && uniform > 0) throw UsageError("--scale and --edgeLength are both given, expected one of them");
  if (file.empty() && !(uniform > 0)) throw UsageError("neither --scale nor --edgeLength is given, expected one of them");
  if (uniform > 0) return uniformScale(uniform);
  ScaleField scale = readScale(file);
  requireCover(scale, grid, file);
  return scale;
}

/// Every tissue of the mesh has the Betti numbers it has in the map.
void requireTopology(const TetraMesh& mesh, const std::map<Label, Betti>& wanted)
{
  const auto got = meshTopology(mesh);
  for (const auto& [label, betti] : wanted)
  {
    const auto at = got.find(label);
    if (at == got.end()) throw EngineError("surface: tissue " + std::to_string(label) + " got lost");
    if (!(at->second == betti)) throw EngineError("surface: tissue " + std::to_string(label) + " changed its topology");
  }
}

TetraMesh toWorld(TetraMesh mesh, const Grid& grid)
{
  for (Vec3& p : mesh.points) p = grid.gridToWorld(p);
  return mesh;
}

void write(JsonWriter& json, const char* key, double value)
{
  json.Key(key);
  json.Double(value);
}

void write(JsonWriter& json, const char* key, std::size_t value)
{
  json.Key(key);
  json.Uint64(value);
}

void writePreparation(JsonWriter& json, const PreparationReport& preparation)
{
  json.Key("preparation");
  json.StartObject();
  write(json, "criticalBlocksBefore", preparation.criticalBlocksBefore);
  write(json, "contactVoxelsChanged", preparation.contactVoxelsChanged);
  json.Key("changes");
  json.StartArray();
  for (const auto& [label, changes] : preparation.changes)
  {
    json.StartObject();
    write(json, "label", std::size_t(label));
    write(json, "islandsRemoved", changes.islandsRemoved);
    write(json, "islandVoxels", changes.islandVoxels);
    write(json, "voxelsLost", changes.voxelsLost);
    write(json, "voxelsGained", changes.voxelsGained);
    json.EndObject();
  }
  json.EndArray();
  json.EndObject();
}

void writeTopology(JsonWriter& json, const std::map<Label, Betti>& topology)
{
  json.Key("topology");
  json.StartArray();
  for (const auto& [label, betti] : topology)
  {
    json.StartObject();
    write(json, "label", std::size_t(label));
    write(json, "components", std::size_t(betti.components));
    write(json, "tunnels", std::size_t(betti.tunnels));
    write(json, "cavities", std::size_t(betti.cavities));
    json.EndObject();
  }
  json.EndArray();
}

void writeEvolution(JsonWriter& json, const std::vector<EvolutionStep>& evolution)
{
  json.Key("evolution");
  json.StartArray();
  for (const EvolutionStep& step : evolution)
  {
    json.StartObject();
    json.Key("stage");
    json.String(step.stage.c_str());
    write(json, "tetrahedra", step.tetrahedra);
    write(json, "meanDistance", step.meanDistance);
    write(json, "maximumDistance", step.maximumDistance);
    write(json, "collapses", std::size_t(step.operations.collapses));
    write(json, "splits", std::size_t(step.operations.splits));
    write(json, "flips", std::size_t(step.operations.flips));
    write(json, "moves", std::size_t(step.operations.moves));
    json.EndObject();
  }
  json.EndArray();
}

std::string reportOf(const SurfaceComplex& surface, const PreparationReport& preparation,
                     const std::map<Label, Betti>& topology, const std::vector<EvolutionStep>& evolution)
{
  rapidjson::StringBuffer buffer;
  JsonWriter json(buffer);
  json.StartObject();
  write(json, "tissues", topology.size());
  write(json, "points", surface.points.size());
  write(json, "triangles", surface.triangles.size());
  writePreparation(json, preparation);
  writeTopology(json, topology);
  writeEvolution(json, evolution);
  json.EndObject();
  return std::string(buffer.GetString()) + "\n";
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

void run(CommandLine& line)
{
  vtkSMPTools::Initialize(line.integer("threads"));
  const Progress progress = line.progress();
  report(progress, 0, "reading");
  TissueMap map = readTissueMap(line.text("labelMap"));
  completeTissueTable(map, line.text("names"));
  const ScaleField scale = readScaleFor(line, map.grid);

  PreparationOptions preparing;
  preparing.minimumIslandVolume = line.number("minimumIslandVolume");
  const PreparationReport preparation = prepareMap(map, preparing, subProgress(progress, 0.02, 0.06));
  const std::string preparedFile = line.outputFile("preparedLabelMap");
  if (!preparedFile.empty()) writeTissueMap(map, preparedFile);
  const std::map<Label, Betti> topology = tissueTopology(map);

  SurfaceMesherOptions options;
  options.maximumDistance = line.number("maximumDistance");
  const Grid world = map.grid;
  map.grid = inOwnFrame(world);
  SurfaceMesh mesh = meshTissues(map, inFrameOf(world, scale), options, subProgress(progress, 0.06, 0.9));

  report(progress, 0.9, "checks");
  requireSound(mesh.ambient.mesh, "surface");
  requireTopology(mesh.ambient.mesh, topology);
  SurfaceFile content;
  content.surface = interfaceOf(mesh.ambient.mesh);
  content.boundaryDistance = boundaryDistances(content.surface, map);
  for (Vec3& p : content.surface.points)
  {
    p = world.gridToWorld(p);
    content.targetEdgeLength.push_back(scale(p));
  }
  content.tissues = map.table;
  report(progress, 0.95, "writing");
  writeSurface(content, line.outputFile("surface"));
  const std::string simplexMesh = line.outputFile("simplexMesh");
  if (!simplexMesh.empty()) writePolygons(simplexMeshFile(content), simplexMesh);
  const std::string ambientFile = line.outputFile("ambient");
  if (!ambientFile.empty())
  {
    MeshFile ambient;
    ambient.mesh = toWorld(std::move(mesh.ambient.mesh), world);
    ambient.tissues = map.table;
    for (const Vec3& p : ambient.mesh.points) ambient.targetEdgeLength.push_back(scale(p));
    writeMesh(ambient, ambientFile);
  }
  const std::string reportFile = line.outputFile("report");
  if (!reportFile.empty()) writeBytes(reportOf(content.surface, preparation, topology, mesh.evolution), reportFile);
  std::ostringstream summary;
  summary << content.surface.triangles.size() << " triangles between " << topology.size() << " tissues, "
          << preparation.contactVoxelsChanged << " voxels changed to resolve contacts";
  line.message(summary.str());
  report(progress, 1, "done");
}

} // namespace

int main(int argc, char** argv) { return runModule(argc, argv, moduleXML, run); }
