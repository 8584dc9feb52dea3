// SPDX-License-Identifier: Apache-2.0
// Damages files of every kind that is read, and reads them: each is either read or refused with a sentence that begins
// with its name. usage: CorruptedFilesFuzz [FILES [FIRST_SEED]]
// File n depends on its seed, FIRST_SEED + n, alone, and is read in a process of its own: one that crashes, or takes
// twenty seconds of processor time, is counted, and the others go on. A single file is read in this process, for a
// debugger. Exit status 1 if one file is neither read nor refused, or leaves a file behind. Build with
// SurgicalMesher_SANITIZE for what only the sanitizers see.

#include "Errors.h"
#include "MeshIO.h"
#include "SeparateProcess.h"
#include "Shapes.h"
#include "TissueMapIO.h"
#include "TissueSettings.h"
#include "VoxelMesh.h"

#include <vtkLogger.h>
#include <vtkObject.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <random>
#include <sstream>

using namespace surgicalmesher;
namespace fs = std::filesystem;

namespace
{

struct Kind
{
  std::string name; ///< of the file, with its extension
  std::string bytes;
  std::function<void(const std::string& file)> read;
};

std::string bytesOf(const fs::path& file)
{
  std::ifstream stream(file, std::ios::binary);
  return { std::istreambuf_iterator<char>(stream), {} };
}

TissueMap twoTissues()
{
  TissueMap map = test::paintedMap({ 6, 5, 4 }, [](int i, int j, int k) { return i + j + k < 5 ? 1 : k > 2 ? 0 : 7; });
  map.table[1] = { "bone", { 1, 0.5, 0 } };
  map.table[7] = { "resting", {} };
  map.table[7].isNullDisplacement = true;
  return map;
}

std::string plyOf(const SurfaceComplex& surface)
{
  std::ostringstream text;
  text << "ply\nformat ascii 1.0\nelement vertex " << surface.points.size()
       << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << surface.triangles.size()
       << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& p : surface.points) text << p.x << ' ' << p.y << ' ' << p.z << '\n';
  for (const auto& [a, b, c] : surface.triangles) text << "3 " << a << ' ' << b << ' ' << c << '\n';
  return text.str();
}

std::string stlOf(const SurfaceComplex& surface)
{
  std::ostringstream text;
  text << "solid x\n";
  for (const auto& ids : surface.triangles)
  {
    text << "facet normal 0 0 0\nouter loop\n";
    for (const std::int32_t id : ids)
      text << "vertex " << surface.points[id].x << ' ' << surface.points[id].y << ' ' << surface.points[id].z << '\n';
    text << "endloop\nendfacet\n";
  }
  return text.str() + "endsolid x\n";
}

std::string legacyOf(const SurfaceComplex& surface)
{
  std::ostringstream text;
  text << "# vtk DataFile Version 4.2\nx\nASCII\nDATASET POLYDATA\nPOINTS " << surface.points.size() << " float\n";
  for (const Vec3& p : surface.points) text << p.x << ' ' << p.y << ' ' << p.z << '\n';
  text << "POLYGONS " << surface.triangles.size() << ' ' << 4 * surface.triangles.size() << '\n';
  for (const auto& [a, b, c] : surface.triangles) text << "3 " << a << ' ' << b << ' ' << c << '\n';
  return text.str();
}

/// Whole files of every kind, written by the project where it writes them.
std::vector<Kind> wholeFiles(const fs::path& folder)
{
  std::vector<Kind> kinds;
  const auto add = [&](const std::string& name, const std::function<void(const std::string&)>& read) {
    kinds.push_back({ name, bytesOf(folder / name), read });
  };
  const auto write = [&](const std::string& name, const std::string& bytes)
  { std::ofstream(folder / name, std::ios::binary) << bytes; };
  const auto file = [&](const std::string& name) { return (folder / name).string(); };

  const TissueMap map = twoTissues();
  for (const char* name : { "map.nrrd", "map.nii", "map.nii.gz", "map.mha", "map.gipl" })
  {
    writeTissueMap(map, file(name));
    add(name, [](const std::string& damaged) { readTissueMap(damaged); });
  }
  ScaleField scale;
  scale.grid = map.grid;
  scale.lengths.assign(map.labels.size(), 2.f);
  writeScale(scale, file("scale.nrrd"));
  add("scale.nrrd", [](const std::string& damaged) { readScale(damaged); });

  SurfaceFile surface;
  surface.surface = test::sphere({ 0, 0, 0 }, 10, 1, 1, 0);
  surface.tissues = map.table;
  surface.targetEdgeLength.assign(surface.surface.points.size(), 2);
  writeSurface(surface, file("s.vtp"));
  write("s.ply", plyOf(surface.surface));
  write("s.stl", stlOf(surface.surface));
  write("s.vtk", legacyOf(surface.surface));
  for (const char* name : { "s.vtp", "s.ply", "s.stl", "s.vtk" })
    add(name, [](const std::string& damaged) { readSurface(damaged); });
  MeshFile mesh;
  mesh.mesh = test::tetrahedraOf(map, 0);
  mesh.tissues = map.table;
  writeMesh(mesh, file("m.vtu"));
  writeMesh(mesh, file("m.vtk"));
  writeMesh(mesh, file("text.vtk"), FieldTexts::LeftOut);
  for (const char* name : { "m.vtu", "m.vtk", "text.vtk" })
    add(name, [](const std::string& damaged) { readMesh(damaged); });

  write("p.mrk.json", R"({"markups":[{"type":"Curve","coordinateSystem":"RAS","controlPoints":[)"
                      R"({"id":"1","position":[1,2,3],"positionStatus":"defined"},{"position":[4,5e1,-6.5]}]}]})");
  write("p.fcsv", "# CoordinateSystem = LPS\n# columns = id,x,y,z\nF,1,2,3\nG,4,5,6\n");
  for (const char* name : { "p.mrk.json", "p.fcsv" })
    add(name, [](const std::string& damaged) { readMarkups(damaged); });
  write("t.ctbl", "# Color table\n1 bone 200 200 180 255\n7 optic_nerve 255 0 51 255\n");
  write("t.csv", "LabelValue,Name,Color_R,Color_G,Color_B\n1,bone,1,2,3\n7,\"nerve, optic\",4,5,6\n");
  write("t.tsv", "index\tname\tcolor\n1\tbone\t#ff0000\n7\tnerve\tn/a\n");
  write("t.xml", "<atlas><header><type>Label</type></header><data><label index=\"1\">bone</label></data></atlas>");
  for (const char* name : { "t.ctbl", "t.csv", "t.tsv", "t.xml" })
    add(name, [](const std::string& damaged) { readTissueTable(damaged); });
  write("tissues.csv", "label,role,minimum,maximum,protected\n1,mesh,1,2,yes\n7,group rest,,,\n");
  add("tissues.csv", [map](const std::string& damaged) { readTissueSettings(damaged, map); });
  return kinds;
}

/// One to four damages: bytes changed, cut out, repeated, cut off, or digits that grow.
std::string damaged(std::string bytes, std::mt19937& random)
{
  for (int count = 1 + int(random() % 4); count > 0 && !bytes.empty(); --count)
  {
    const std::size_t at = random() % bytes.size(), length = 1 + random() % 40;
    switch (random() % 7)
    {
    case 0: bytes[at] = char(random()); break;
    case 1: bytes[at] = char(bytes[at] ^ (1 << random() % 8)); break;
    case 2: bytes.erase(at, length); break;
    case 3: bytes.insert(at, bytes.substr(random() % bytes.size(), length)); break;
    case 4: bytes.resize(at); break;
    case 5:
    {
      const std::size_t digit = bytes.find_first_of("0123456789", at);
      const char* const numbers[] = { "2147483648", "-1", "1e308", "nan", "99999999999999999999", "0", "4294967295" };
      if (digit != std::string::npos) bytes.replace(digit, 1, numbers[random() % 7]);
      break;
    }
    default: bytes.insert(at, std::string(1 + random() % 3000, "[<\"{ \n\0\xff"[random() % 8])); break;
    }
  }
  return bytes;
}

/// What is wrong with how the file is taken, or nothing.
std::string faultOf(const Kind& kind, const std::string& file)
{
  try
  {
    kind.read(file);
    return "";
  }
  catch (const InputError& error)
  {
    return std::string(error.what()).compare(0, file.size(), file) == 0 ? ""
                                                                        : std::string("refused by: ") + error.what();
  }
  catch (const std::exception& error)
  {
    return std::string("ends in: ") + error.what();
  }
}

/// What is wrong with how the file of this seed is taken, or nothing.
std::string run(unsigned seed, const std::vector<Kind>& kinds, const fs::path& folder, bool inThisProcess)
{
  std::mt19937 random(seed);
  const Kind& kind = kinds[random() % kinds.size()];
  const std::string file = (folder / ("damaged-" + kind.name)).string();
  std::ofstream(file, std::ios::binary) << damaged(kind.bytes, random);
  const std::string fault = inThisProcess ? faultOf(kind, file)
                                          : runInSeparateProcess([&] { return faultOf(kind, file); }, 20)
                                              .value_or("crashed, or took more than 20 s of processor time");
  fs::remove(file);
  return fault.empty() ? "" : kind.name + " " + fault;
}

std::size_t fileCount(const fs::path& folder)
{
  return std::size_t(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

} // namespace

int main(int argc, char** argv)
{
  const int files = argc > 1 ? std::atoi(argv[1]) : 300;
  const unsigned first = argc > 2 ? unsigned(std::atoi(argv[2])) : 1;
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  vtkObject::GlobalWarningDisplayOff();
  const fs::path folder = fs::temp_directory_path() / ("CorruptedFilesFuzz-" + std::to_string(std::random_device()()));
  fs::create_directories(folder);
  const std::vector<Kind> kinds = wholeFiles(folder);
  const std::size_t wholeCount = fileCount(folder);
  int faults = 0;
  for (unsigned seed = first; seed < first + unsigned(files); ++seed)
  {
    const std::string fault = run(seed, kinds, folder, files == 1);
    if (fault.empty()) continue;
    ++faults;
    std::cerr << "seed " << seed << ": " << fault << std::endl;
  }
  const std::size_t leftovers = fileCount(folder) - wholeCount;
  fs::remove_all(folder);
  std::cout << files << " files, " << faults << " taken wrongly, " << leftovers << " leftovers" << std::endl;
  return faults == 0 && leftovers == 0 ? 0 : 1;
}
