// SPDX-License-Identifier: Apache-2.0
#include "HtmlReport.h"

#include "Errors.h"
#include "MeshViews.h"
#include "ReportStyle.h"
#include "TextFile.h"

#include <rapidjson/document.h>
#include <vtksys/Base64.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace surgicalmesher
{

namespace
{

using Json = rapidjson::Value;

struct Results
{
  rapidjson::Document scale, surface, mesh;
  SurfaceFile surfaceFile;
  MeshFile meshFile;
  std::map<Label, Color> colors;
};

void parse(rapidjson::Document& json, const std::string& file)
{
  json.Parse(text::readTextFile(file).c_str());
  if (json.HasParseError() || !json.IsObject()) throw InputError(file + ": no JSON object, a stage's report expected");
}

/// Returns a number; NaN if the report has none.
double number(const Json& value)
{
  return value.IsNumber() ? value.GetDouble() : std::numeric_limits<double>::quiet_NaN();
}

std::string fixed(double value, int decimals)
{
  if (std::isnan(value)) return "&ndash;";
  char text[64];
  const double unit = std::pow(10.0, decimals);
  std::snprintf(text, sizeof(text), "%.*f", decimals, std::round(value * unit) / unit + 0.0); // not -0
  return text;
}

/// 12345 as 12,345.
std::string grouped(double count)
{
  std::string digits = fixed(count, 0);
  const int first = digits.front() == '-' ? 1 : 0;
  for (int at = int(digits.size()) - 3; at > first; at -= 3) digits.insert(std::size_t(at), ",");
  return digits;
}

std::string element(const std::string& name, const std::string& content)
{
  return "<" + name + ">" + content + "</" + name.substr(0, name.find(' ')) + ">";
}

// ---- warnings and figures

std::string warnings(const Results& results)
{
  std::string items;
  for (const auto* report : { &results.scale, &results.surface, &results.mesh })
  {
    for (const Json& warning : (*report)["warnings"].GetArray())
      items += element("li", text::xmlEscaped(warning.GetString()));
  }
  if (items.empty()) return "<p class=soft>No warnings.</p>\n";
  return "<section class=warnings><strong>Warnings</strong><ul>" + items + "</ul></section>\n";
}

std::string figure(const std::string& value, const std::string& what)
{
  return "<div><b>" + value + "</b><span class=soft>" + what + "</span></div>\n";
}

/// Counts the tissues whose tetrahedra differ from the prepared map in the number of components, tunnels or cavities.
std::size_t wrongTissues(const Results& results)
{
  std::map<unsigned, const Json*> found;
  for (const Json& tissue : results.mesh["topology"].GetArray()) found[tissue["label"].GetUint()] = &tissue;
  std::size_t wrong = 0;
  for (const Json& tissue : results.surface["topology"].GetArray())
  {
    const auto at = found.find(tissue["label"].GetUint());
    wrong += at == found.end() || *at->second != tissue;
  }
  return wrong;
}

std::string figures(const Results& results)
{
  const Json& whole = results.mesh["quality"]["whole"];
  const Json& distances = results.surface["distances"];
  return "<section class=figures>\n" + figure(grouped(number(results.surface["tissues"])), "tissues") +
         figure(grouped(number(results.surface["triangles"])), "triangles") +
         figure(grouped(number(whole["tetrahedra"])), "tetrahedra") +
         figure(grouped(number(whole["points"])), "points") +
         figure(fixed(number(whole["dihedral"]["minimum"]), 1) + "&deg; to " +
                  fixed(number(whole["dihedral"]["maximum"]), 1) + "&deg;",
                "dihedral angles") +
         figure(fixed(100 * number(whole["edgesNearTarget"]), 1) + " %", "of edges 0.7 to 1.4 of their target") +
         figure(fixed(number(distances["mapToMesh"]["mean"]), 2) + " mm", "mean distance, map to surface") +
         figure(fixed(number(distances["meshToMap"]["mean"]), 2) + " mm", "mean distance, surface to map") +
         figure(grouped(double(wrongTissues(results))), "tissues of wrong topology, beside the prepared map") +
         "</section>\n";
}

// ---- pictures

std::string base64(const std::string& bytes)
{
  std::vector<unsigned char> text(4 * (bytes.size() / 3 + 2));
  const auto* from = reinterpret_cast<const unsigned char*>(bytes.data());
  const std::size_t length = vtksysBase64_Encode(from, bytes.size(), text.data(), 0);
  return { reinterpret_cast<const char*>(text.data()), length };
}

std::string svgText(double x, double y, const std::string& anchor, int size, const std::string& text)
{
  return "<text x='" + fixed(x, 1) + "' y='" + fixed(y, 1) + "' text-anchor='" + anchor + "' font-size='" +
         std::to_string(size) + "'>" + text + "</text>";
}

/// Draws scale bar, the patient's sides, and a cross at the target.
std::string overlay(const Camera& camera, const Vec3* target)
{
  const Annotations notes = annotationsOf(camera);
  const double right = camera.width - 14, bottom = camera.height - 14, left = right - notes.barPixels;
  std::string svg = "<path d='M" + fixed(left, 1) + " " + fixed(bottom, 1) + "H" + fixed(right, 1) +
                    "' stroke='currentColor' stroke-width='5'/>" +
                    svgText((left + right) / 2, bottom - 10, "middle", 24, text::rounded(notes.barLength, 3) + " mm") +
                    svgText(14, 40, "start", 36, notes.left) + svgText(camera.width - 14, 40, "end", 36, notes.right);
  if (!target) return svg;
  const Vec3 at = camera.pixel(*target);
  const std::string cross = "M" + fixed(at.x - 12, 1) + " " + fixed(at.y, 1) + "h24m-12 -12v24";
  return svg + "<path d='" + cross + "' stroke='#fff' stroke-width='7' fill='none'/><path d='" + cross +
         "' stroke='#c8102e' stroke-width='4' fill='none'/>";
}

std::string picture(const std::vector<Facet>& facets, const Vec3& towards, const std::string& caption,
                    const Vec3* target = nullptr)
{
  if (facets.empty()) return {};
  const Camera camera = cameraOn(facets, towards, 900, 720);
  const std::string png = base64(pngOf(drawn(facets, camera)));
  const std::string size = std::to_string(camera.width) + " " + std::to_string(camera.height);
  return "<figure><svg viewBox='0 0 " + size + "' role='img' aria-label='" + caption + "'><image width='" +
         std::to_string(camera.width) + "' height='" + std::to_string(camera.height) +
         "' href='data:image/png;base64," + png + "'/>" + overlay(camera, target) + "</svg><figcaption>" + caption +
         "</figcaption></figure>\n";
}

Vec3 pointOf(const Json& array) { return { number(array[0]), number(array[1]), number(array[2]) }; }

/// The first target, or the end of the first path.
Vec3 targetOf(const Results& results)
{
  const Json& targets = results.scale["targets"];
  if (!targets.Empty()) return pointOf(targets[0]);
  const Json& points = results.scale["paths"][0]["points"];
  return pointOf(points[points.Size() - 1]);
}

std::string pictures(const Results& results)
{
  const Vec3 target = targetOf(results);
  return "<h2>Pictures</h2>\n<section class=pictures>\n" +
         picture(outerFacets(results.surfaceFile), fromFrontLeftAbove, "The surface, from the front, left and above") +
         picture(cutFacets(results.meshFile, target, fromFront), fromFront,
                 "The tetrahedra behind the target, from the front", &target) +
         picture(childFacets(results.meshFile), fromFrontLeftAbove, "The child mesh alone") + "</section>\n";
}

// ---- histograms

struct Axis
{
  double low, high, step;
};

/// Draws bars and ticks, and dashed lines at the ideal values.
std::string histogram(const Json& data, const Axis& axis, const std::vector<double>& ideals, const std::string& caption)
{
  constexpr double width = 460, height = 240, foot = 34;
  const Json& counts = data["counts"];
  double most = 1;
  for (const Json& count : counts.GetArray()) most = std::max(most, number(count));
  const double low = number(data["low"]), bin = (number(data["high"]) - low) / counts.Size();
  const auto x = [&](double value) { return width * (value - axis.low) / (axis.high - axis.low); };
  std::string bars;
  for (rapidjson::SizeType n = 0; n < counts.Size(); ++n)
  {
    const double tall = (height - foot - 8) * number(counts[n]) / most, at = x(low + n * bin);
    if (tall > 0 && at >= -1e-9 && at < width)
      bars += "M" + fixed(at, 1) + " " + fixed(height - foot, 1) + "v-" + fixed(tall, 1) + "h" +
              fixed(std::max(x(axis.low + bin) - 0.6, 0.6), 1) + "v" + fixed(tall, 1) + "z";
  }
  std::string svg = "<path d='" + bars + "' fill='var(--bar)'/>";
  for (const double ideal : ideals)
    svg += "<path d='M" + fixed(x(ideal), 1) + " 4V" + fixed(height - foot, 1) +
           "' stroke='var(--mark)' stroke-width='1.5' stroke-dasharray='5 4'/>";
  svg += "<path d='M0 " + fixed(height - foot, 1) + "H" + fixed(width, 1) + "' stroke='currentColor'/>";
  for (double tick = axis.low; tick <= axis.high + 1e-9; tick += axis.step)
    svg += svgText(x(tick), height - foot + 20, "middle", 15, text::rounded(tick, 3));
  return "<figure><svg viewBox='-16 0 492 240' role='img' aria-label='" + caption + "'>" + svg + "</svg><figcaption>" +
         caption + "</figcaption></figure>\n";
}

std::string histograms(const Results& results)
{
  const Json& data = results.mesh["quality"]["histograms"];
  return "<h2>Quality</h2>\n<p class=soft>Dashed: the ideal, a lattice of canonical tetrahedra with edges as long as "
         "their target.</p>\n<section class=pictures>\n" +
         histogram(data["dihedral"], { 0, 180, 30 }, { 60, 90 }, "Dihedral angles (degrees)") +
         histogram(data["edgeOverTarget"], { 0, 2.5, 0.5 }, { 1 }, "Edge length over its target") +
         histogram(data["valence"], { 0, 60, 10 }, { 24 }, "Tetrahedra around each inner point") + "</section>\n";
}

// ---- tables

std::string swatch(const Results& results, unsigned label)
{
  const auto found = results.colors.find(Label(label));
  if (found == results.colors.end()) return {};
  std::string rgb;
  for (const double c : found->second) rgb += (rgb.empty() ? "" : ",") + fixed(255 * c, 0);
  return "<i class=swatch style='background:rgb(" + rgb + ")'></i>";
}

std::string row(const std::vector<std::string>& cells, const char* kind)
{
  std::string text;
  for (const std::string& cell : cells) text += element(kind, cell);
  return element("tr", text) + "\n";
}

std::string tissueName(const Results& results, const Json& tissue)
{
  const unsigned label = tissue["label"].GetUint();
  return swatch(results, label) + std::to_string(label) + " " + text::xmlEscaped(tissue["name"].GetString());
}

std::vector<std::string> distanceCells(const Json& tissue)
{
  return { fixed(number(tissue["mapToMesh"]["mean"]), 2), fixed(number(tissue["mapToMesh"]["maximum"]), 2),
           fixed(number(tissue["meshToMap"]["mean"]), 2), fixed(number(tissue["meshToMap"]["maximum"]), 2) };
}

std::vector<std::string> qualityCells(const Json* tissue)
{
  if (!tissue) return { "0", "", "", "", "", "" };
  const Json& quality = *tissue;
  return { grouped(number(quality["tetrahedra"])),           fixed(number(quality["dihedral"]["minimum"]), 1),
           fixed(number(quality["dihedral"]["maximum"]), 1), fixed(number(quality["minimumDihedral"]["mean"]), 1),
           fixed(number(quality["radiusRatio"]["mean"]), 2), fixed(number(quality["height"]["minimum"]), 2) };
}

std::string tissues(const Results& results)
{
  std::map<unsigned, const Json*> quality;
  for (const Json& tissue : results.mesh["quality"]["tissues"].GetArray()) quality[tissue["label"].GetUint()] = &tissue;
  std::string rows;
  for (const Json& tissue : results.surface["fidelity"].GetArray())
  {
    const double map = number(tissue["mapVolume"]);
    const auto found = quality.find(tissue["label"].GetUint());
    const double mesh = found == quality.end() ? 0 : number((*found->second)["volume"]);
    std::vector<std::string> cells{ tissueName(results, tissue), grouped(map), grouped(mesh),
                                    map > 0 ? fixed(100 * (mesh / map - 1), 1) + " %" : "" };
    for (const std::string& cell : distanceCells(tissue)) cells.push_back(cell);
    for (const std::string& cell : qualityCells(found == quality.end() ? nullptr : found->second))
      cells.push_back(cell);
    rows += row(cells, "td");
  }
  const std::vector<std::string> head{ "tissue",
                                       "map<br>mm&sup3;",
                                       "mesh<br>mm&sup3;",
                                       "change",
                                       "map to mesh<br>mean mm",
                                       "largest<br>mm",
                                       "mesh to map<br>mean mm",
                                       "largest<br>mm",
                                       "tetra-<br>hedra",
                                       "smallest<br>dihedral",
                                       "largest<br>dihedral",
                                       "mean<br>smallest",
                                       "radius ratio<br>mean",
                                       "least<br>height mm" };
  return "<h2>Tissues</h2>\n<p class=soft>Volumes of the prepared map and of the mesh, distances between their "
         "boundaries both ways, and the tetrahedra.</p>\n<div class=table><table>\n<thead>" +
         row(head, "th") + "</thead><tbody>\n" + rows + "</tbody></table></div>\n";
}

std::string kindsOfSimplification(const Results& results)
{
  std::map<std::string, std::array<double, 2>> kinds; // number of places and of voxels
  for (const Json& change : results.surface["simplification"]["changes"].GetArray())
  {
    auto& sum = kinds[change["kind"].GetString()];
    sum[0] += number(change["count"]);
    sum[1] += number(change["voxels"]);
  }
  std::string items;
  for (const auto& [kind, sum] : kinds)
    items += element("li", text::xmlEscaped(kind) + ": " + grouped(sum[0]) + " places, " + grouped(sum[1]) + " voxels");
  return items.empty() ? "" : element("ul", items) + "\n";
}

std::string changes(const Results& results)
{
  const Json& preparation = results.surface["preparation"];
  std::string rows;
  double islands = 0;
  for (const Json& change : preparation["changes"].GetArray())
  {
    islands += number(change["islandsRemoved"]);
    rows += row({ tissueName(results, change), grouped(number(change["islandsRemoved"])),
                  grouped(number(change["islandVoxels"])), grouped(number(change["voxelsLost"])),
                  grouped(number(change["voxelsGained"])) },
                "td");
  }
  return "<h2>What was changed in the map</h2>\n<p>" + grouped(islands) + " islands removed; " +
         grouped(number(preparation["contactVoxelsChanged"])) +
         " voxels changed where a tissue touched itself only along an edge or a corner of voxels.</p>\n" +
         kindsOfSimplification(results) +
         (rows.empty()
            ? ""
            : "<details><summary>By tissue</summary><div class=table><table><thead>" +
                row({ "tissue", "islands<br>removed", "their<br>voxels", "voxels<br>lost", "voxels<br>gained" }, "th") +
                "</thead><tbody>\n" + rows + "</tbody></table></div></details>\n");
}

} // namespace

std::string htmlReport(const std::string& folder, const std::string& configuration)
{
  Results results;
  parse(results.scale, folder + "/scale.json");
  parse(results.surface, folder + "/surface.json");
  parse(results.mesh, folder + "/mesh.json");
  results.surfaceFile = readSurface(folder + "/surface.vtp");
  results.meshFile = readMesh(folder + "/mesh.vtu");
  results.colors = colorsOf(results.meshFile.mesh.labels, results.meshFile.tissues);
  const std::string map = text::xmlEscaped(results.scale["labelMap"].GetString());
  return "<!DOCTYPE html>\n<html lang=en><head><meta charset=utf-8>\n"
         "<meta name=viewport content='width=device-width,initial-scale=1'>\n<title>SurgicalMesher: " +
         map + "</title>\n<style>\n" + std::string(reportStyle) +
         "</style></head><body>\n<h1>Finite element mesh</h1>\n" + "<p class=soft>of " + map + "</p>\n" +
         warnings(results) + figures(results) + pictures(results) + histograms(results) + tissues(results) +
         changes(results) + "<h2>The run</h2>\n<details><summary>All options (run.toml)</summary>\n<pre>" +
         text::xmlEscaped(configuration) + "</pre></details>\n</body></html>\n";
}

} // namespace surgicalmesher
