// SPDX-License-Identifier: Apache-2.0
#include "TissueMapIO.h"

#include "Errors.h"
#include "TextFile.h"

#include <rapidjson/document.h>
#include <rapidjson/error/en.h>

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{

namespace
{

using Points = std::vector<Vec3>;
using Json = rapidjson::Value;

/// Whether positions in this coordinate system are RAS (else LPS). Older files write a number for it.
bool isRas(const std::string& system, const std::string& file)
{
  if (system == "RAS" || system == "0") return true;
  if (system == "LPS" || system == "1") return false;
  throw InputError(file + ": coordinate system \"" + system + "\", expected LPS or RAS");
}

Vec3 toLps(const Vec3& p, bool ras) { return ras ? Vec3{ -p.x, -p.y, p.z } : p; }

const Json* member(const Json& object, const char* name)
{
  const auto found = object.FindMember(name);
  return found == object.MemberEnd() ? nullptr : &found->value;
}

std::string textMember(const Json& object, const char* name, const std::string& missing)
{
  const Json* value = member(object, name);
  if (value && value->IsString()) return value->GetString();
  if (value && value->IsInt()) return std::to_string(value->GetInt());
  return missing;
}

/// Returns the member's `count` numbers; empty if it is no array of that many finite numbers.
std::vector<double> numbersOf(const Json& object, const char* name, rapidjson::SizeType count)
{
  const Json* values = member(object, name);
  if (!values || !values->IsArray() || values->Size() != count) return {};
  std::vector<double> numbers;
  for (const Json& value : values->GetArray())
  {
    if (!value.IsNumber() || !std::isfinite(value.GetDouble())) return {};
    numbers.push_back(value.GetDouble());
  }
  return numbers;
}

Vec3 readPosition(const Json& controlPoint, const std::string& file)
{
  const auto p = controlPoint.IsObject() ? numbersOf(controlPoint, "position", 3) : std::vector<double>();
  if (p.empty()) throw InputError(file + ": a control point without a position of three numbers");
  return { p[0], p[1], p[2] };
}

/// Reads the centre and normal of a plane, or the centre, size and orientation of a box: a matrix, row by row, whose
/// columns are the axes.
std::optional<MarkupRegion> readRegion(const Json& markup, const std::string& type, bool ras)
{
  const auto center = numbersOf(markup, "center", 3), normal = numbersOf(markup, "normal", 3);
  const auto size = numbersOf(markup, "size", 3), axes = numbersOf(markup, "orientation", 9);
  if (center.empty()) return {};
  MarkupRegion region;
  region.center = toLps({ center[0], center[1], center[2] }, ras);
  if (type == "Plane" && !normal.empty())
  {
    region.axes[2] = toLps({ normal[0], normal[1], normal[2] }, ras);
    return region;
  }
  if (type != "ROI" || size.empty() || axes.empty()) return {};
  region.size = { size[0], size[1], size[2] };
  for (std::size_t i = 0; i < 3; ++i) region.axes[i] = toLps({ axes[i], axes[3 + i], axes[6 + i] }, ras);
  return region;
}

/// `isPlaced`: for every control point of the file; values of points that are not placed are dropped.
void readMeasurements(const Json& markup, const std::vector<bool>& isPlaced, Markup& result)
{
  const Json* measurements = member(markup, "measurements");
  if (!measurements || !measurements->IsArray()) return;
  for (const Json& measurement : measurements->GetArray())
  {
    const Json* values = measurement.IsObject() ? member(measurement, "controlPointValues") : nullptr;
    if (!values || !values->IsArray() || values->Size() != isPlaced.size()) continue;
    std::vector<double> kept;
    for (rapidjson::SizeType n = 0; n < values->Size(); ++n)
    {
      const Json& value = (*values)[n];
      if (isPlaced[n] && value.IsNumber() && std::isfinite(value.GetDouble())) kept.push_back(value.GetDouble());
    }
    const std::string name = textMember(measurement, "name", "");
    if (kept.size() == result.points.size() && !name.empty()) result.pointValues[name] = kept;
  }
}

/// The unit of coordinates. The file has a text, or a list of the unit's code, the coding scheme and the unit's name.
std::string unitsOf(const Json& markup)
{
  const Json* value = member(markup, "coordinateUnits");
  if (!value || value->IsNull()) return "mm";
  if (value->IsArray() && !value->Empty()) value = &(*value)[0];
  return value->IsString() ? value->GetString() : "no text";
}

/// Reads the control points that are placed: Slicer also stores points that are "undefined", "missing" or "preview".
Markup readMarkup(const Json& markup, const std::string& file)
{
  const Json* controlPoints = markup.IsObject() ? member(markup, "controlPoints") : nullptr;
  if (!controlPoints || !controlPoints->IsArray()) throw InputError(file + ": a markup without controlPoints");
  const bool ras = isRas(textMember(markup, "coordinateSystem", "LPS"), file);
  const std::string units = unitsOf(markup);
  if (units != "mm") throw InputError(file + ": coordinates in \"" + units + "\", expected mm");
  Markup result;
  result.type = textMember(markup, "type", "");
  result.region = readRegion(markup, result.type, ras);
  std::vector<bool> isPlaced;
  for (const Json& controlPoint : controlPoints->GetArray())
  {
    isPlaced.push_back(!controlPoint.IsObject() || textMember(controlPoint, "positionStatus", "defined") == "defined");
    if (!isPlaced.back()) continue;
    result.points.push_back(toLps(readPosition(controlPoint, file), ras));
    result.labels.push_back(textMember(controlPoint, "label", ""));
  }
  readMeasurements(markup, isPlaced, result);
  const bool isClosed = result.type == "ClosedCurve";
  if (isClosed && result.points.size() > 1)
  {
    result.points.push_back(result.points.front());
    result.labels.push_back(result.labels.front());
    for (auto& entry : result.pointValues) entry.second.push_back(entry.second.front());
  }
  return result;
}

std::vector<Markup> readJson(const std::string& file)
{
  rapidjson::Document document;
  // Iterative: deeply nested brackets would overflow the stack.
  document.Parse<rapidjson::kParseFullPrecisionFlag | rapidjson::kParseIterativeFlag>(text::readTextFile(file).c_str());
  if (document.HasParseError())
  {
    throw InputError(file + ": not valid JSON at byte " + std::to_string(document.GetErrorOffset()) + " (" +
                     rapidjson::GetParseError_En(document.GetParseError()) + ")");
  }
  const Json* markups = document.IsObject() ? member(document, "markups") : nullptr;
  if (!markups || !markups->IsArray()) throw InputError(file + ": no array \"markups\", expected a markups file");
  std::vector<Markup> lists;
  for (const Json& markup : markups->GetArray()) lists.push_back(readMarkup(markup, file));
  return lists;
}

/// The text after `# key = ` in a comment line of an .fcsv file; empty for other lines.
std::string commentValue(const std::string& line, const std::string& key)
{
  const std::size_t equal = line.find('=');
  if (equal == std::string::npos || text::trimmed(line.substr(1, equal - 1)) != key) return {};
  return text::trimmed(line.substr(equal + 1));
}

/// The columns of an .fcsv file. Version 3 files have label,x,y,z,sel,vis; version 4 files name their columns.
struct Columns
{
  std::size_t x = 1; ///< y and z follow it
  std::size_t label = 0;
  std::size_t count = 0; ///< 0: not named
};

Columns readColumns(const std::string& columns, const std::string& file)
{
  const std::vector<std::string> names = text::splitFields(columns);
  const auto x = std::find(names.begin(), names.end(), "x");
  if (names.end() - x < 3 || x[1] != "y" || x[2] != "z")
  {
    throw InputError(file + ": columns \"" + columns + "\", expected x,y,z among them");
  }
  const auto label = std::find(names.begin(), names.end(), "label");
  return { std::size_t(x - names.begin()), std::size_t(label - names.begin()), names.size() };
}

/// Whether a row's point has a position. From version 5.2 on, Slicer writes two fields that the line of columns does
/// not name, positionStatus and autoCreated; points without a position lie at 0, 0, 0 in the file.
bool isPlaced(const std::vector<std::string>& fields, const Columns& columns)
{
  constexpr long defined = 2;
  long status = defined;
  return columns.count == 0 || fields.size() != columns.count + 2 ||
         !text::parseInteger(fields[columns.count], 0, 9, status) || status == defined;
}

/// Version 3 files (label,x,y,z,sel,vis) and version 4 files (id,x,y,z,ow,...) both have x second and both default to
/// RAS.
std::vector<Markup> readFcsv(const std::string& file)
{
  bool ras = true;
  Columns layout;
  Markup markup;
  const std::vector<std::string> lines = text::splitLines(text::readTextFile(file));
  for (std::size_t n = 0; n < lines.size(); ++n)
  {
    const std::string& line = lines[n];
    if (text::trimmed(line).empty()) continue;
    if (line[0] == '#')
    {
      const std::string system = commentValue(line, "CoordinateSystem");
      const std::string columns = commentValue(line, "columns");
      if (!system.empty()) ras = isRas(system, file);
      if (!columns.empty()) layout = readColumns(columns, file);
      continue;
    }
    const std::vector<std::string> fields = text::splitFields(line);
    if (!isPlaced(fields, layout)) continue;
    Vec3 p;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      if (layout.x + axis < fields.size() && text::parseNumber(fields[layout.x + axis], p[int(axis)])) continue;
      throw InputError(file + ":" + std::to_string(n + 1) + ": \"" + line.substr(0, 60) +
                       "\", expected three finite coordinates");
    }
    markup.points.push_back(toLps(p, ras));
    markup.labels.push_back(layout.label < fields.size() ? fields[layout.label] : std::string());
  }
  return { markup };
}

bool endsWith(const std::string& text, const std::string& end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

} // namespace

std::vector<Markup> readLabelledMarkups(const std::string& file)
{
  const std::string name = text::lowerCase(file);
  text::requireReadableFile(file);
  std::vector<Markup> lists;
  if (endsWith(name, ".json")) lists = readJson(file);
  else if (endsWith(name, ".fcsv")) lists = readFcsv(file);
  else throw InputError(file + ": not a markups file, expected .mrk.json or .fcsv");
  lists.erase(std::remove_if(lists.begin(), lists.end(), [](const Markup& markup) { return markup.points.empty(); }),
              lists.end());
  if (lists.empty()) throw InputError(file + ": no control point, expected at least one with a defined position");
  return lists;
}

std::vector<std::vector<Vec3>> readMarkups(const std::string& file)
{
  std::vector<Points> lists;
  for (const Markup& markup : readLabelledMarkups(file)) lists.push_back(markup.points);
  return lists;
}

Focus readFocus(const std::vector<Vec3>& targetPoints, const std::vector<std::string>& targetFiles,
                const Path& pathPoints, const std::vector<std::string>& pathFiles)
{
  Focus focus;
  focus.targets = targetPoints;
  for (const std::string& file : targetFiles)
  {
    for (const Points& points : readMarkups(file))
      focus.targets.insert(focus.targets.end(), points.begin(), points.end());
  }
  if (pathPoints.size() == 1) throw UsageError("--pathPoint is given once, expected two points or more");
  if (pathPoints.size() > 1 && !(pathLength(pathPoints) > 0))
    throw UsageError("--pathPoint: a path of length 0, expected points that differ");
  if (!pathPoints.empty()) focus.paths.push_back(pathPoints);
  for (const std::string& file : pathFiles)
  {
    for (const Path& path : readMarkups(file))
    {
      if (path.size() < 2) throw InputError(file + ": a path of one point, expected two points or more");
      if (!(pathLength(path) > 0)) throw InputError(file + ": a path of length 0, expected points that differ");
      focus.paths.push_back(path);
    }
  }
  return focus;
}

} // namespace surgicalmesher
