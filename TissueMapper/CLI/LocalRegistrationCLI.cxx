// SPDX-License-Identifier: Apache-2.0
// LocalRegistrationCLI: registers one image of a head to another, and resamples it to the other's grid.

#include "AvailableMemory.h"
#include "CommandLine.h"
#include "Errors.h"
#include "ImageRegistration.h"
#include "JsonMember.h"
#include "LocalRegistrationCLIXML.h"
#include "Place.h"
#include "Sampling.h"
#include "ThreadCount.h"
#include "TissueMapIO.h"

#include <rapidjson/ostreamwrapper.h>
#include <rapidjson/prettywriter.h>

#include <cmath>
#include <fstream>

using namespace surgicalmesher;

namespace
{

using JsonWriter = rapidjson::PrettyWriter<rapidjson::OStreamWrapper>;

std::vector<Vec3> readLandmarks(const std::string& file)
{
  std::vector<Vec3> points;
  for (const std::vector<Vec3>& markup : readMarkups(file)) points.insert(points.end(), markup.begin(), markup.end());
  if (points.size() < 3)
    throw InputError(file + ": " + std::to_string(points.size()) + " landmarks, expected three or more");
  return points;
}

void readLandmarks(const CommandLine& line, RegistrationOptions& options)
{
  const std::vector<std::string> files = line.texts("landmarks");
  if (files.empty() && options.start == RegistrationStart::Landmarks)
    throw UsageError("--initial landmarks: expected --landmarks");
  if (files.empty()) return;
  if (files.size() != 2)
    throw UsageError("--landmarks: " + std::to_string(files.size()) + " files, expected that of the fixed image and " +
                     "that of the moving one");
  options.fixedLandmarks = readLandmarks(files[0]);
  options.movingLandmarks = readLandmarks(files[1]);
  if (options.fixedLandmarks.size() != options.movingLandmarks.size())
  {
    throw InputError(files[1] + ": " + std::to_string(options.movingLandmarks.size()) + " landmarks, expected " +
                     std::to_string(options.fixedLandmarks.size()) + " as in " + files[0]);
  }
}

/// Returns the sphere of --sphere; none if it is the default.
std::optional<Sphere> readSphere(const CommandLine& line, const ScalarImage& fixed)
{
  const std::vector<double> numbers = line.numbers("sphere");
  if (numbers == std::vector<double>{ 0, 0, 0, 0 }) return std::nullopt;
  if (numbers.size() != 4 || !(numbers[3] >= 5 && numbers[3] <= 500))
    throw UsageError("--sphere: expected x,y,z of its centre and a radius from 5 to 500 mm");
  const Sphere sphere{ { numbers[0], numbers[1], numbers[2] }, numbers[3] };
  if (!isInVolume(fixed.grid, fixed.grid.worldToGrid(sphere.centre)))
    throw InputError(line.text("fixed") + ": the sphere's centre, " + place(sphere.centre) +
                     " LPS, lies outside the image");
  return sphere;
}

std::vector<bool> readMask(const CommandLine& line, const ScalarImage& fixed)
{
  const std::string file = line.text("mask");
  if (file.empty()) return {};
  const TissueMap map = readTissueMap(file);
  const Grid& a = map.grid;
  const Grid& b = fixed.grid;
  double apart = norm(a.origin - b.origin) + norm(a.spacing - b.spacing);
  for (int axis = 0; axis < 3; ++axis) apart += norm(a.axes[axis] - b.axes[axis]);
  if (a.size != b.size || apart > 1e-3) throw InputError(file + ": another grid than that of " + line.text("fixed"));
  std::vector<bool> mask;
  for (const Label label : map.labels) mask.push_back(label != 0);
  return mask;
}

/// Root mean square distance (mm) between the mapped fixed landmarks and the moving ones.
double landmarkError(const RegistrationOptions& options, const LinearMap& map)
{
  double sum = 0;
  for (std::size_t n = 0; n < options.fixedLandmarks.size(); ++n)
    sum += squaredNorm(map(options.fixedLandmarks[n]) - options.movingLandmarks[n]);
  return std::sqrt(sum / double(options.fixedLandmarks.size()));
}

void writeMap(JsonWriter& json, const char* key, const LinearMap& map)
{
  json.Key(key);
  json.StartArray();
  for (int row = 0; row < 3; ++row)
    writeValue(json, std::vector<double>{ map.rows[row].x, map.rows[row].y, map.rows[row].z, map.offset[row] });
  json.EndArray();
}

/// Maps are LPS, from the fixed image to the moving one, mm; information in nats.
void writeReport(const std::string& file, const CommandLine& line, const RegistrationOptions& options,
                 const Registration& found)
{
  std::ofstream stream(file.c_str(), std::ios::binary);
  rapidjson::OStreamWrapper wrapper(stream);
  JsonWriter json(wrapper);
  json.StartObject();
  writeMember(json, "module", "LocalRegistration");
  for (const char* name : { "fixed", "moving", "initial" }) writeMember(json, name, line.text(name));
  writeMember(json, "sphere", line.numbers("sphere"));
  writeMember(json, "agreeingStarts", found.agreeingStarts);
  writeMember(json, "otherStarts", found.otherStarts);
  writeMember(json, "informationAtStart", found.startInformation);
  writeMember(json, "informationBefore", found.globalInformationBefore);
  writeMember(json, "information", found.globalInformation);
  writeMember(json, "scale", found.scale);
  writeMap(json, "global", found.global);
  if (found.local)
  {
    writeMember(json, "targetInformationBefore", found.targetInformationBefore);
    writeMember(json, "targetInformation", found.targetInformation);
    writeMap(json, "local", *found.local);
  }
  if (!options.fixedLandmarks.empty())
  {
    writeMember(json, "landmarkErrorGlobal", landmarkError(options, found.global));
    writeMember(json, "landmarkError", landmarkError(options, found.finest()));
  }
  json.EndObject();
  stream << '\n' << std::flush;
  if (!stream) throw InputError(file + ": the report cannot be written whole");
}

void requireMemory(const ScalarImage& fixed, const ScalarImage& moving, const std::string& file)
{
  constexpr double bytesPerVoxel = 24; // the image, its copy without extremes, and the buffers of the blur
  const double needed = 50e6 + bytesPerVoxel * double(fixed.grid.voxelCount() + moving.grid.voxelCount());
  const std::optional<std::uint64_t> available = availableMemory();
  if (!available || needed <= double(*available)) return;
  throw InputError(file + ": images of this size take about " + std::to_string(std::lround(needed / 1e6)) +
                   " MB of memory, found " + std::to_string(std::lround(double(*available) / 1e6)) + " MB available");
}

Registration registerFiles(const CommandLine& line, const ScalarImage& fixed, const ScalarImage& moving,
                           const RegistrationOptions& options, const Progress& progress)
{
  try
  {
    return registerImages(fixed, moving, options, progress);
  }
  catch (const InputError& error)
  {
    throw InputError(line.text("moving") + " onto " + line.text("fixed") + ": " + error.what());
  }
}

void run(CommandLine& line)
{
  setThreadCount(line.integer("threads"));
  const Progress progress = line.progress();
  report(progress, 0, "reading");
  RegistrationOptions options;
  const std::string initial = line.text("initial");
  options.start = initial == "landmarks"   ? RegistrationStart::Landmarks
                  : initial == "principal" ? RegistrationStart::PrincipalAxes
                                           : RegistrationStart::Centre;
  readLandmarks(line, options);
  const ScalarImage fixed = readImage(line.text("fixed"));
  const ScalarImage moving = readImage(line.text("moving"));
  requireMemory(fixed, moving, line.text("moving"));
  options.target = readSphere(line, fixed);
  options.mask = readMask(line, fixed);
  const Registration found = registerFiles(line, fixed, moving, options, subProgress(progress, 0.05, 0.9));

  report(progress, 0.9, "writing");
  writeImage(resampled(moving, found.finest(), fixed.grid), line.outputFile("registered"));
  const std::string transformFile = line.outputFile("transform");
  if (!transformFile.empty()) writeTransform(found.finest(), transformFile);
  const std::string reportFile = line.outputFile("report");
  if (!reportFile.empty()) writeReport(reportFile, line, options, found);
  line.message("registered, scale " + std::to_string(found.scale) + ", " + std::to_string(found.agreeingStarts) +
               " of " + std::to_string(found.otherStarts) + " other starts agree");
  report(progress, 1, "done");
}

} // namespace

int main(int argc, char** argv) { return runModule(argc, argv, moduleXML, run); }
