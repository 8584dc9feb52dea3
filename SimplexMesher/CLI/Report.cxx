// SPDX-License-Identifier: Apache-2.0
#include "Report.h"

#include "JsonReport.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <locale>
#include <sstream>

namespace surgicalmesher
{
namespace
{

/// Writes a position in LPS mm, rounded to a hundredth.
void writePlace(JsonWriter& json, const Vec3& place)
{
  json.StartArray();
  for (int axis = 0; axis < 3; ++axis) writeValue(json, std::round(place[axis] * 100) / 100 + 0.0);
  json.EndArray();
}

void writeTissue(JsonWriter& json, Label label, const TissueTable& table)
{
  writeMember(json, "label", label);
  writeMember(json, "name", nameOf(label, table));
}

void writeBetti(JsonWriter& json, const Betti& betti)
{
  writeMember(json, "components", betti.components);
  writeMember(json, "tunnels", betti.tunnels);
  writeMember(json, "cavities", betti.cavities);
}

std::vector<Label> labelsWhere(const TissueSettings& settings, const std::function<bool(const TissueSetting&)>& holds)
{
  std::vector<Label> labels;
  for (const auto& [label, setting] : settings)
  {
    if (holds(setting)) labels.push_back(label);
  }
  return labels;
}

void writeSelection(JsonWriter& json, const SurfaceReport& report)
{
  const TissueTable& given = report.selection.tableOfInput;
  json.Key("selection");
  json.StartObject();
  writeObjects(json, "groups", report.selection.groups,
               [&](const TissueGroup& group)
               {
                 writeMember(json, "label", group.label);
                 writeMember(json, "name", group.name);
                 writeObjects(json, "members", group.members, [&](Label member) { writeTissue(json, member, given); });
                 writeMember(json, "pieces", group.pieces.size());
               });
  writeObjects(json, "leftOut", report.selection.voxelsLeft,
               [&](const auto& left)
               {
                 writeTissue(json, left.first, given);
                 writeMember(json, "voxels", left.second);
               });
  writeObjects(json, "shells", labelsWhere(report.settings, [](const auto& s) { return s.role == TissueRole::Shell; }),
               [&](Label label)
               {
                 writeTissue(json, label, report.tissues);
                 writeMember(json, "edgeLength", report.settings.at(label).maximumEdgeLength);
               });
  writeObjects(json, "protected", labelsWhere(report.settings, [](const auto& s) { return s.isProtected; }),
               [&](Label label) { writeTissue(json, label, report.tissues); });
  json.EndObject();
}

void writePreparation(JsonWriter& json, const SurfaceReport& report)
{
  const PreparationReport& preparation = report.preparation.preparation;
  json.Key("preparation");
  json.StartObject();
  writeMember(json, "voxelRepeats", report.repeats.times);
  writeMember(json, "criticalBlocksBefore", preparation.criticalBlocksBefore);
  writeMember(json, "contactVoxelsChanged", voxelsOfFile(preparation.contactVoxelsChanged, report));
  writeObjects(json, "changes", preparation.changes,
               [&](const auto& entry)
               {
                 const TissueChanges& changes = entry.second;
                 writeTissue(json, entry.first, report.tissues);
                 writeMember(json, "islandsRemoved", changes.islandsRemoved);
                 writeMember(json, "islandVoxels", voxelsOfFile(changes.islandVoxels, report));
                 writeMember(json, "voxelsLost", voxelsOfFile(changes.voxelsLost, report));
                 writeMember(json, "voxelsGained", voxelsOfFile(changes.voxelsGained, report));
               });
  json.EndObject();
}

/// The changes of one tissue and kind.
struct PieceRange
{
  std::vector<MapChange>::const_iterator begin, end;
};

std::vector<PieceRange> byTissueAndKind(const std::vector<MapChange>& changes)
{
  std::vector<PieceRange> ranges;
  for (auto begin = changes.begin(); begin != changes.end();)
  {
    const auto end =
      std::find_if(begin, changes.end(),
                   [&](const MapChange& change) { return change.label != begin->label || change.kind != begin->kind; });
    ranges.push_back({ begin, end });
    begin = end;
  }
  return ranges;
}

std::size_t voxelsLost(const std::vector<MapChange>& changes)
{
  std::size_t voxels = 0;
  for (const MapChange& change : changes) voxels += change.kind < ChangeKind::Cavity ? change.voxels : 0;
  return voxels;
}

void writePieces(JsonWriter& json, const PieceRange& pieces, const SurfaceReport& report)
{
  std::size_t sum = 0;
  for (auto piece = pieces.begin; piece != pieces.end; ++piece) sum += piece->voxels;
  writeTissue(json, pieces.begin->label, report.tissues);
  writeMember(json, "kind", std::string(nameOf(pieces.begin->kind)));
  writeMember(json, "count", std::size_t(pieces.end - pieces.begin));
  writeMember(json, "voxels", voxelsOfFile(sum, report));
}

void writeSimplification(JsonWriter& json, const SurfaceReport& report)
{
  const std::vector<MapChange>& changes = report.preparation.simplification;
  json.Key("simplification");
  json.StartObject();
  writeMember(json, "featureScale", report.featureScale);
  writeMember(json, "voxelsChanged", voxelsOfFile(voxelsLost(changes), report));
  writeObjects(json, "keptWhole", report.preparation.keptWhole,
               [&](Label label) { writeTissue(json, label, report.tissues); });
  writeObjects(json, "changes", byTissueAndKind(changes),
               [&](const PieceRange& pieces)
               {
                 writePieces(json, pieces, report);
                 json.Key("places");
                 json.StartArray();
                 for (auto piece = pieces.begin; piece != pieces.end; ++piece) writePlace(json, piece->place);
                 json.EndArray();
               });
  json.EndObject();
}

/// Writes the number of pieces of one kind that labels have lost, and their voxels.
void writeRoughness(JsonWriter& json, const char* key, const SurfaceReport& report,
                    const std::function<bool(const MapChange&)>& holds)
{
  std::size_t pieces = 0, voxels = 0;
  for (const MapChange& change : report.smoothed)
  {
    if (change.kind >= ChangeKind::Cavity || !holds(change)) continue;
    ++pieces;
    voxels += change.voxels;
  }
  json.Key(key);
  json.StartObject();
  writeMember(json, "count", pieces);
  writeMember(json, "voxels", voxelsOfFile(voxels, report));
  json.EndObject();
}

/// Places are left out: there can be very many.
void writeSmoothing(JsonWriter& json, const SurfaceReport& report)
{
  json.Key("smoothing");
  json.StartObject();
  writeMember(json, "voxels", report.smoothing);
  writeMember(json, "voxelsChanged", voxelsOfFile(voxelsLost(report.smoothed), report));
  writeRoughness(json, "cracks", report, [](const auto& lost) { return lost.label == 0 && lost.voxels > 1; });
  writeRoughness(json, "ears", report, [](const auto& lost) { return lost.label != 0 && lost.voxels > 1; });
  writeRoughness(json, "singleSteps", report, [](const auto& lost) { return lost.voxels == 1; });
  writeObjects(json, "changes", byTissueAndKind(report.smoothed),
               [&](const PieceRange& pieces) { writePieces(json, pieces, report); });
  json.EndObject();
}

void writeStructures(JsonWriter& json, const SurfaceReport& report)
{
  writeObjects(json, "structures", report.structures,
               [&](const Structure& structure)
               {
                 writeMember(json, "label", structure.label);
                 writeMember(json, "name", structure.name);
                 writeMember(json, "voxels", voxelsOfFile(structure.voxels, report));
                 json.Key("centre");
                 writePlace(json, structure.centre);
                 writeMember(json, "tunnels", structure.topology.tunnels);
                 writeMember(json, "cavities", structure.topology.cavities);
               });
}

void writeThickness(JsonWriter& json, const SurfaceReport& report)
{
  std::vector<std::pair<Label, TissueThickness>> thin;
  TissueThickness all;
  for (const auto& [label, tissue] : report.thickness.tissues)
  {
    all.area += tissue.area;
    all.thinArea += tissue.thinArea;
    if (tissue.thinArea > 0) thin.emplace_back(label, tissue);
  }
  json.Key("thickness");
  json.StartObject();
  writeMember(json, "followed", report.followsThickness);
  writeMember(json, "area", all.area);
  writeMember(json, "thinnerThanLength", all.thinArea);
  writeMember(json, "share", all.area > 0 ? all.thinArea / all.area : 0.0);
  writeObjects(json, "tissues", thin,
               [&](const auto& entry)
               {
                 const TissueThickness& tissue = entry.second;
                 writeTissue(json, entry.first, report.tissues);
                 writeMember(json, "area", tissue.area);
                 writeMember(json, "thinnerThanLength", tissue.thinArea);
                 writeMember(json, "share", tissue.thinArea / tissue.area);
                 writeMember(json, "smallestThickness", tissue.smallest);
               });
  json.EndObject();
}

void writeEvolution(JsonWriter& json, const std::vector<EvolutionStep>& evolution)
{
  writeObjects(json, "evolution", evolution,
               [&](const EvolutionStep& step)
               {
                 writeMember(json, "stage", step.stage);
                 writeMember(json, "tetrahedra", step.tetrahedra);
                 writeMember(json, "faces", step.faces);
                 writeMember(json, "meanDistance", step.meanDistance);
                 writeMember(json, "maximumDistance", step.maximumDistance);
                 writeMember(json, "samplesBeyondTolerance", step.beyond);
                 writeMember(json, "T1", step.operations.t1);
                 writeMember(json, "T2", step.operations.t2);
                 writeMember(json, "T7", step.operations.t7);
                 writeMember(json, "collapses", step.operations.collapses);
                 writeMember(json, "splits", step.operations.splits);
                 writeMember(json, "flips", step.operations.flips);
                 writeMember(json, "relabels", step.operations.relabels);
                 writeMember(json, "moves", step.operations.moves);
               });
}

void writeDistances(JsonWriter& json, const char* key, const Distances& distances, const Grid& world)
{
  json.Key(key);
  json.StartObject();
  writeMember(json, "samples", distances.samples);
  writeMember(json, "mean", distances.mean);
  writeMember(json, "maximum", distances.maximum);
  json.Key("farthest");
  writePlace(json, world.gridToWorld(distances.farthest));
  json.EndObject();
}

void writeMaximumDistance(JsonWriter& json, const SurfaceReport& report, const Distances& fromMap,
                          const Distances& fromMesh)
{
  if (report.maximumDistance == 0) return;
  json.Key("maximumDistance");
  json.StartObject();
  writeMember(json, "asked", report.maximumDistance);
  writeMember(json, "holds", fromMap.beyond + fromMesh.beyond == 0);
  writeMember(json, "beyondFromMap", fromMap.beyond);
  writeMember(json, "beyondFromMesh", fromMesh.beyond);
  json.EndObject();
}

void writeFidelity(JsonWriter& json, const SurfaceReport& report)
{
  if (report.fidelity.empty()) return;
  const Distances fromMap = allDistances(report.fidelity, &TissueFidelity::mapToMesh);
  const Distances fromMesh = allDistances(report.fidelity, &TissueFidelity::meshToMap);
  json.Key("distances");
  json.StartObject();
  writeDistances(json, "mapToMesh", fromMap, report.world);
  writeDistances(json, "meshToMap", fromMesh, report.world);
  json.EndObject();
  writeMaximumDistance(json, report, fromMap, fromMesh);
  writeObjects(json, "fidelity", report.fidelity,
               [&](const auto& entry)
               {
                 const TissueFidelity& tissue = entry.second;
                 writeTissue(json, entry.first, report.tissues);
                 writeMember(json, "mapVolume", tissue.mapVolume);
                 writeMember(json, "meshVolume", tissue.meshVolume);
                 writeDistances(json, "mapToMesh", tissue.mapToMesh, report.world);
                 writeDistances(json, "meshToMap", tissue.meshToMap, report.world);
               });
}

constexpr std::size_t mostListed = 20;

template <class Item>
std::vector<Item> listed(const std::vector<Item>& items)
{
  return { items.begin(), items.begin() + std::ptrdiff_t(std::min(items.size(), mostListed)) };
}

void writeFoldedLength(JsonWriter& json, const char* key, const FoldedLength& edges)
{
  json.Key(key);
  json.StartObject();
  writeMember(json, "length", edges.length);
  writeMember(json, "folded", edges.folded);
  writeMember(json, "share", edges.length > 0 ? edges.folded / edges.length : 0.0);
  json.EndObject();
}

void writeFold(JsonWriter& json, const Fold& fold, const Grid& world)
{
  json.Key("place");
  writePlace(json, world.gridToWorld(fold.place));
  writeMember(json, "length", fold.length);
  writeMember(json, "edges", fold.edges);
  writeMember(json, "labels", fold.labels);
  writeMember(json, "outer", fold.isOuter);
  writeMember(json, "shape", fold.isConcave ? "concave" : "convex");
  if (fold.boundaryTurn >= 0) writeMember(json, "boundaryTurn", fold.boundaryTurn);
  writeMember(json, "reason", nameOf(fold.reason));
}

void writeReason(JsonWriter& json, FoldReason reason, const std::vector<Fold>& folds)
{
  std::size_t count = 0;
  double length = 0;
  for (const Fold& fold : folds)
  {
    if (fold.reason != reason) continue;
    ++count;
    length += fold.length;
  }
  writeMember(json, "reason", nameOf(reason));
  writeMember(json, "count", count);
  writeMember(json, "length", length);
}

void writeFolds(JsonWriter& json, const SurfaceReport& report)
{
  json.Key("folds");
  json.StartObject();
  writeMember(json, "count", report.folds.folds.size());
  writeFoldedLength(json, "sheets", report.folds.sheets);
  writeFoldedLength(json, "outer", report.folds.outer);
  std::vector<FoldReason> reasons;
  for (int reason = 0; reason < foldReasons; ++reason) reasons.push_back(FoldReason(reason));
  writeObjects(json, "reasons", reasons, [&](FoldReason reason) { writeReason(json, reason, report.folds.folds); });
  writeObjects(json, "longest", listed(report.folds.folds),
               [&](const Fold& fold) { writeFold(json, fold, report.world); });
  json.EndObject();
}

void writeEars(JsonWriter& json, const SurfaceReport& report)
{
  double volume = 0;
  for (const HangingPiece& ear : report.ears) volume += ear.volume;
  json.Key("ears");
  json.StartObject();
  writeMember(json, "count", report.ears.size());
  writeMember(json, "free",
              std::count_if(report.ears.begin(), report.ears.end(), [](auto& ear) { return ear.isFree; }));
  writeMember(json, "volume", volume);
  writeObjects(json, "largest", listed(report.ears),
               [&](const HangingPiece& ear)
               {
                 writeTissue(json, ear.label, report.tissues);
                 json.Key("place");
                 writePlace(json, report.world.gridToWorld(ear.place));
                 writeMember(json, "volume", ear.volume);
                 writeMember(json, "tetrahedra", ear.tetrahedra);
                 writeMember(json, "free", ear.isFree);
               });
  json.EndObject();
}

} // namespace

std::size_t voxelsOfFile(std::size_t voxels, const SurfaceReport& report) { return voxels * report.repeats.voxels(); }

std::string reportJson(const SurfaceReport& report)
{
  const auto writeMembers = [&](JsonWriter& json)
  {
    writeMember(json, "tissues", report.topology.size());
    writeMember(json, "points", report.points);
    writeMember(json, "triangles", report.triangles);
    writeSelection(json, report);
    writePreparation(json, report);
    writeSimplification(json, report);
    writeSmoothing(json, report);
    writeObjects(json, "topology", report.topology,
                 [&](const auto& tissue)
                 {
                   writeMember(json, "label", tissue.first);
                   writeBetti(json, tissue.second);
                 });
    writeStructures(json, report);
    writeThickness(json, report);
    writeFidelity(json, report);
    writeFolds(json, report);
    writeEars(json, report);
    writeEvolution(json, report.evolution);
    writeWarnings(json, report.warnings);
  };
  JsonStyle style;
  style.arraysInOneLine = true;
  return jsonText(writeMembers, style);
}

std::string evolutionCsv(const std::vector<EvolutionStep>& evolution)
{
  std::ostringstream csv;
  csv.imbue(std::locale::classic());
  csv << "step,stage,tetrahedra,faces,meanDistance,maximumDistance,T1,T2,T7,relabels,moves,collapses,splits,flips\n";
  std::size_t number = 0;
  for (const EvolutionStep& step : evolution)
  {
    csv << number++ << ",\"" << step.stage << "\"," << step.tetrahedra << ',' << step.faces << ',' << step.meanDistance
        << ',' << step.maximumDistance << ',' << step.operations.t1 << ',' << step.operations.t2 << ','
        << step.operations.t7 << ',' << step.operations.relabels << ',' << step.operations.moves << ','
        << step.operations.collapses << ',' << step.operations.splits << ',' << step.operations.flips << '\n';
  }
  return csv.str();
}

} // namespace surgicalmesher
