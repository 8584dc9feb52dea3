// SimplexMesherCLI: label map and scale in; prepared map, shared surface of all tissues and its ambient tetrahedra out.

#include "CommandLine.h"
#include "ComplexChecks.h"
#include "ComplexIO.h"
#include "DigitalTopology.h"
#include "Errors.h"
#include "FaceNeighbours.h"
#include "MapPreparation.h"
#include "SimplexMesherCLIXML.h"
#include "SurfaceMesher.h"
#include "TissueMapIO.h"

#include <rapidjson/prettywriter.h>
#include <rapidjson/stringbuffer.h>
#include <vtkSMPTools.h>

#include <algorithm>
#include <cmath>
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

/// Signed distance, mm, of each surface point to the nearest face between voxels of different labels: positive where the
/// map has the label in front of the surface, negative otherwise. NaN-free: beyond the search range, the range itself.
std::vector<double> distancesToMap(const SurfaceComplex& surface, const TissueMap& map)
{
  constexpr int reach = 4; // voxels
  const Grid& g = map.grid;
  const auto labelAt = [&](int i, int j, int k) { return g.contains(i, j, k) ? map.labels[g.index(i, j, k)] : Label(0); };
  std::vector<Label> front(surface.points.size(), 0);
  for (std::size_t t = surface.triangles.size(); t-- > 0;)
    for (std::int32_t v : surface.triangles[t]) front[v] = surface.labels[t][1];
  std::vector<double> out(surface.points.size());
  vtkSMPTools::For(0, vtkIdType(out.size()), [&](vtkIdType begin, vtkIdType end) {
    for (vtkIdType v = begin; v < end; ++v)
    {
      const Vec3& p = surface.points[v];
      int c[3];
      for (int a = 0; a < 3; ++a) c[a] = int(std::lround(p[a] / g.spacing[a]));
      double best = reach * std::min({ g.spacing.x, g.spacing.y, g.spacing.z });
      best *= best;
      for (int k = c[2] - reach; k <= c[2] + reach; ++k)
        for (int j = c[1] - reach; j <= c[1] + reach; ++j)
          for (int i = c[0] - reach; i <= c[0] + reach; ++i)
            for (int a = 0; a < 3; ++a)
            {
              const int next[3] = { i + (a == 0), j + (a == 1), k + (a == 2) };
              if (labelAt(i, j, k) == labelAt(next[0], next[1], next[2])) continue;
              const int here[3] = { i, j, k };
              double d2 = 0;
              for (int b = 0; b < 3; ++b)
              {
                const double off = std::abs(p[b] - (b == a ? here[b] + 0.5 : here[b]) * g.spacing[b]);
                const double beyond = std::max(0.0, off - (b == a ? 0 : 0.5 * g.spacing[b]));
                d2 += beyond * beyond;
              }
              best = std::min(best, d2);
            }
      out[v] = (labelAt(c[0], c[1], c[2]) == front[v] ? 1 : -1) * std::sqrt(best);
    }
  });
  return out;
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
  content.boundaryDistance = distancesToMap(content.surface, map);
  for (Vec3& p : content.surface.points)
  {
    p = world.gridToWorld(p);
    content.targetEdgeLength.push_back(scale(p));
  }
  content.tissues = map.table;
  report(progress, 0.95, "writing");
  writeSurface(content, line.outputFile("surface"));
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
