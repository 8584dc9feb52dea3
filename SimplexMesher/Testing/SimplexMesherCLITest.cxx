#include "ComplexIO.h"
#include "ExecutableTest.h"
#include "TissueMapIO.h"
#include "VoxelMesh.h"

#include <rapidjson/document.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>
#include <limits>
#include <map>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

/// A ball of tissue 7 within a box of tissue 1 that touches the end of the grid in x, and a scale for it.
class SimplexMesherCLI : public ExecutableTest
{
protected:
  SimplexMesherCLI() : ExecutableTest(SIMPLEXMESHERCLI) {}

  void SetUp() override
  {
    map = paintedMap({ 14, 12, 12 },
                     [](int i, int j, int k)
                     {
                       if ((i - 8) * (i - 8) + (j - 6) * (j - 6) + (k - 6) * (k - 6) < 8) return 7;
                       return i >= 3 && j >= 2 && j < 10 && k >= 2 && k < 10 ? 1 : 0;
                     });
    map.grid.origin = { 5, -9, 30 };
    write("map.nrrd", map);
    writeScaleFile("scale.nrrd", map.grid, 2.f);
  }

  void write(const std::string& name, const TissueMap& content, const std::string& more = "") const
  {
    folder.write(name, nrrd("uint16", nrrdGeometry(content.grid), content.labels, more));
  }

  void writeScaleFile(const std::string& name, const Grid& grid, float value) const
  {
    folder.write(name, nrrd("float", nrrdGeometry(grid), std::vector<float>(grid.voxelCount(), value)));
  }

  /// Volumes that the surface encloses, by tissue; fails unless every tissue's boundary is closed.
  std::map<Label, double> enclosedVolumes(const std::string& name) const
  {
    const SurfaceComplex surface = readSurface(folder.file(name)).surface;
    std::map<Label, double> volumes;
    std::map<std::pair<Label, std::pair<std::int32_t, std::int32_t>>, int> balance; // of each edge's directions
    for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    {
      const auto& ids = surface.triangles[t];
      const Vec3 a = surface.points[ids[0]], b = surface.points[ids[1]], c = surface.points[ids[2]];
      for (const int side : { 0, 1 })
      {
        const int sign = side == 0 ? 1 : -1;
        const Label label = surface.labels[t][side];
        volumes[label] += sign * dot(a, cross(b, c)) / 6;
        for (int n = 0; n < 3; ++n)
        {
          const std::int32_t from = ids[n], to = ids[(n + 1) % 3];
          balance[{ label, std::minmax(from, to) }] += from < to ? sign : -sign;
        }
      }
    }
    for (const auto& [edge, count] : balance) EXPECT_EQ(count, 0) << "tissue " << edge.first << " is open";
    volumes.erase(0);
    return volumes;
  }

  TissueMap map;
};

double volumeOf(const TissueMap& map, Label label)
{
  const Vec3& spacing = map.grid.spacing;
  return double(std::count(map.labels.begin(), map.labels.end(), label)) * spacing.x * spacing.y * spacing.z;
}

} // namespace

TEST_F(SimplexMesherCLI, WritesEveryOutputAndNoOther)
{
  expectDone("--scale scale.nrrd --preparedLabelMap p.nrrd --ambient a.vtu --report r.json map.nrrd s.vtp");
  EXPECT_EQ(folder.files(),
            (std::vector<std::string>{ "a.vtu", "map.nrrd", "p.nrrd", "r.json", "s.vtp", "scale.nrrd" }));
  const SurfaceFile surface = readSurface(folder.file("s.vtp"));
  EXPECT_EQ(surface.targetEdgeLength, std::vector<double>(surface.surface.points.size(), 2));
  EXPECT_EQ(surface.boundaryDistance.size(), surface.surface.points.size());
  rapidjson::Document report;
  report.Parse(readBytes(folder.file("r.json")).c_str());
  EXPECT_EQ(report["triangles"].GetUint64(), surface.surface.triangles.size());
}

TEST_F(SimplexMesherCLI, WritesTheSimplexMeshDualToTheSurface)
{
  expectDone("--scale scale.nrrd --simplexMesh simplex.vtp map.nrrd s.vtp");
  const SurfaceComplex surface = readSurface(folder.file("s.vtp")).surface;
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(folder.file("simplex.vtp").c_str());
  reader->Update();
  vtkPolyData* simplex = reader->GetOutput();
  ASSERT_EQ(simplex->GetNumberOfPoints(), vtkIdType(surface.triangles.size()));
  vtkDataArray* labels = simplex->GetCellData()->GetArray("TissueLabel");
  ASSERT_TRUE(labels);
  // Three corners of a polygon for each triangle, and each tissue on it but the outside.
  std::map<Label, int> expected, corners;
  for (const auto& pair : surface.labels)
    for (const Label label : pair)
      if (label != 0) expected[label] += 3;
  for (vtkIdType c = 0; c < simplex->GetNumberOfCells(); ++c)
    corners[Label(labels->GetTuple1(c))] += int(simplex->GetCell(c)->GetNumberOfPoints());
  EXPECT_EQ(corners, expected);
  ASSERT_TRUE(simplex->GetFieldData()->GetAbstractArray("SPACE"));
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
  {
    const auto& [a, b, c] = surface.triangles[t];
    Vec3 vertex;
    simplex->GetPoint(vtkIdType(t), &vertex.x);
    EXPECT_LT(norm((surface.points[a] + surface.points[b] + surface.points[c]) / 3 - vertex), 1e-4);
  }
}

TEST_F(SimplexMesherCLI, ClosesATissueThatTheBorderCuts)
{
  expectDone("--scale scale.nrrd map.nrrd s.vtp");
  const std::map<Label, double> volumes = enclosedVolumes("s.vtp");
  ASSERT_EQ(volumes.size(), 2u);
  for (const auto& [label, volume] : volumes) EXPECT_NEAR(volume / volumeOf(map, label), 1, 0.1) << label;
}

TEST_F(SimplexMesherCLI, ClosesAMapWithoutBackgroundAtItsBorder)
{
  const TissueMap full = paintedMap({ 9, 8, 10 }, [](int, int, int) { return 3; }, { 1, 1.5, 0.8 });
  write("full.nrrd", full);
  expectDone("--edgeLength 2 full.nrrd s.vtp");
  const std::map<Label, double> volumes = enclosedVolumes("s.vtp");
  ASSERT_EQ(volumes.size(), 1u);
  EXPECT_NEAR(volumes.at(3) / volumeOf(full, 3), 1, 0.05);
}

TEST_F(SimplexMesherCLI, LeavesAMapWithoutContactsAsItIs)
{
  folder.write("names.ctbl", "1 bone 200 200 180 255\n7 pituitary_gland 255 100 50 255\n");
  expectDone("--edgeLength 2 --names names.ctbl --preparedLabelMap p.nrrd --report r.json map.nrrd s.vtp");
  const TissueMap prepared = readTissueMap(folder.file("p.nrrd"));
  EXPECT_EQ(prepared.labels, map.labels);
  EXPECT_EQ(prepared.grid.size, map.grid.size);
  rapidjson::Document report;
  report.Parse(readBytes(folder.file("r.json")).c_str());
  EXPECT_EQ(report["preparation"]["criticalBlocksBefore"].GetUint64(), 0u);
  EXPECT_EQ(report["preparation"]["changes"].Size(), 0u);
}

TEST_F(SimplexMesherCLI, ChangesVoxelsAtContactsOnly)
{
  TissueMap touching = paintedMap({ 12, 8, 8 }, [](int i, int j, int k) { // two bars that share one voxel edge
    const bool inside = k >= 2 && k < 6;
    return inside && i >= 2 && i < 10 && ((i < 6 && j >= 2 && j < 4) || (i >= 6 && j >= 4 && j < 6)) ? 1 : 0;
  });
  write("touching.nrrd", touching);
  expectDone("--edgeLength 2 --preparedLabelMap p.nrrd touching.nrrd s.vtp");
  const TissueMap prepared = readTissueMap(folder.file("p.nrrd"));
  int changed = 0;
  for (int k = 0; k < 8; ++k)
  {
    for (int j = 0; j < 8; ++j)
    {
      for (int i = 0; i < 12; ++i)
      {
        const std::size_t n = touching.grid.index(i, j, k);
        if (prepared.labels[n] == touching.labels[n]) continue;
        ++changed;
        EXPECT_TRUE((i == 5 || i == 6) && (j == 3 || j == 4)) << i << " " << j << " " << k;
      }
    }
  }
  EXPECT_GT(changed, 0);
}

TEST_F(SimplexMesherCLI, KeepsNamesAndColours)
{
  folder.write("names.ctbl", "1 bone 200 200 180 255\n7 pituitary_gland 255 100 50 255\n9 absent 1 2 3 255\n");
  expectDone("--edgeLength 2 --names names.ctbl --preparedLabelMap p.nrrd map.nrrd s.vtp");
  for (const TissueTable& table :
       { readTissueMap(folder.file("p.nrrd")).table, readSurface(folder.file("s.vtp")).tissues })
  {
    ASSERT_EQ(table.size(), 2u);
    EXPECT_EQ(table.at(1).name, "bone");
    EXPECT_EQ(table.at(7).name, "pituitary gland");
    EXPECT_NEAR(table.at(7).color[1], 100 / 255., 0.003);
  }
  expectDone("--edgeLength 2 --preparedLabelMap q.nrrd p.nrrd t.vtp"); // what it wrote, it takes
  EXPECT_EQ(readTissueMap(folder.file("q.nrrd")).table.at(7).name, "pituitary gland");
}

TEST_F(SimplexMesherCLI, RefusesMapsAtFault)
{
  const std::vector<std::uint8_t> ones(16, 1);
  folder.write("text.nrrd", "not a map\n");
  folder.write("empty.nrrd", nrrd("uint8", cubeGeometry(2), std::vector<std::uint8_t>(8, 0)));
  folder.write("real.nrrd", nrrd("float", cubeGeometry(2), std::vector<float>(8, 0.5f)));
  folder.write("negative.nrrd", nrrd("int16", cubeGeometry(2), std::vector<std::int16_t>(8, -1)));
  folder.write("series.nrrd", nrrd("uint8", "dimension: 4\nsizes: 2 2 2 2\n", ones));
  folder.write("vector.nrrd",
               nrrd("uint8", "dimension: 4\nsizes: 2 2 2 2\nkinds: vector domain domain domain\n", ones));
  writeTissueMap(map, folder.file("cut.nii.gz"));
  const std::string whole = readBytes(folder.file("cut.nii.gz"));
  folder.write("cut.nii.gz", whole.substr(0, whole.size() / 2));
  const std::string more = "--edgeLength 2 --preparedLabelMap p.nrrd --ambient a.vtu --report r.json ";
  expectRefused(more + "missing.nrrd s.vtp", 1, "missing.nrrd: no such file");
  expectRefused(more + ". s.vtp", 1, "is a directory");
  expectRefused(more + "text.nrrd s.vtp", 1, "text.nrrd: ");
  expectRefused(more + "empty.nrrd s.vtp", 1, "empty.nrrd: no voxel but background");
  expectRefused(more + "real.nrrd s.vtp", 1, "real.nrrd: a voxel of value 0.5");
  expectRefused(more + "negative.nrrd s.vtp", 1, "negative.nrrd: a voxel of value -1");
  expectRefused(more + "series.nrrd s.vtp", 1, "series.nrrd: ");
  expectRefused(more + "vector.nrrd s.vtp", 1, "vector.nrrd: ");
  expectRefused(more + "cut.nii.gz s.vtp", 1, "cut.nii.gz: ");
  expectRefused(more + "--names missing.ctbl map.nrrd s.vtp", 1, "missing.ctbl: no such file");
}

TEST_F(SimplexMesherCLI, RefusesScalesAtFault)
{
  Grid small = map.grid;
  small.size[2] = 6;
  writeScaleFile("small.nrrd", small, 2);
  writeScaleFile("zero.nrrd", map.grid, 0);
  writeScaleFile("negative.nrrd", map.grid, -1);
  writeScaleFile("nan.nrrd", map.grid, std::numeric_limits<float>::quiet_NaN());
  writeScaleFile("infinite.nrrd", map.grid, std::numeric_limits<float>::infinity());
  for (const char* name : { "small", "zero", "negative", "nan", "infinite", "missing" })
  {
    const std::string file = std::string(name) + ".nrrd";
    expectRefused("--scale " + file + " --ambient a.vtu map.nrrd s.vtp", 1, file + ": ");
  }
}

TEST_F(SimplexMesherCLI, RefusesCommandLinesAtFault)
{
  expectRefused("map.nrrd s.vtp", 2, "neither --scale nor --edgeLength");
  expectRefused("--edgeLength 0 map.nrrd s.vtp", 2, "neither --scale nor --edgeLength");
  expectRefused("--edgeLength 2 --scale scale.nrrd map.nrrd s.vtp", 2, "both");
  for (const char* option : { "--edgeLength", "--minimumIslandVolume", "--maximumDistance" })
  {
    for (const char* value : { "-1", "nan", "inf", "1e999", "two" })
    {
      expectRefused(std::string("--scale scale.nrrd ") + option + " " + value + " map.nrrd s.vtp", 2, option + 2);
    }
  }
  expectRefused("--edgeLength 2 --report a.json --report b.json map.nrrd s.vtp", 2, "--report: given twice");
  expectRefused("--edgeLength 2 map.nrrd", 2, "surface");
}

TEST_F(SimplexMesherCLI, RefusesPlacesThatCanNotBeWrittenTo)
{
  expectRefused("--edgeLength 2 map.nrrd nowhere/s.vtp", 1, "nowhere");
  expectRefused("--edgeLength 2 --ambient nowhere/a.vtu map.nrrd s.vtp", 1, "nowhere");
  std::filesystem::create_symlink("/dev/full", folder.file("full.nrrd"));
  expectRefused("--edgeLength 2 --preparedLabelMap full.nrrd map.nrrd s.vtp", 1, "full.nrrd: device found");
  expectSaysThatAFileCanNotGrow("--edgeLength 1 --ambient a.vtu map.nrrd s.vtp");
}

TEST_F(SimplexMesherCLI, SaysThatTheDiskIsFull)
{
  expectSaysThatTheDiskIsFull("--edgeLength 1 --ambient disk/a.vtu map.nrrd disk/s.vtp");
}

TEST_F(SimplexMesherCLI, LeavesNothingWhenKilled)
{
  write("large.nrrd", paintedMap({ 48, 48, 48 }, [](int i, int j, int k) { return 1 + (i / 6 + j / 6 + k / 6) % 5; }));
  expectLeavesNothingWhenKilled(
    "--edgeLength 1 --preparedLabelMap p.nrrd --ambient a.vtu --report r.json large.nrrd s.vtp", "coarsening");
}
