#include "ExecutableTest.h"
#include "FaceAdjacency.h"
#include "MeshIO.h"
#include "Shapes.h"

#include <limits>
#include <set>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

/// A ball of 10 mm radius around the origin, and a scale for it.
class FuchsTetrahedralizerCLI : public ExecutableTest
{
protected:
  FuchsTetrahedralizerCLI() : ExecutableTest(FUCHSTETRAHEDRALIZERCLI) {}

  void SetUp() override
  {
    writeBall("ball.vtp", 3);
    grid.size = { 11, 11, 11 };
    grid.spacing = { 2.5, 2.5, 2.5 };
    grid.origin = { -12.5, -12.5, -12.5 };
    writeScaleFile("scale.nrrd", grid, 2);
  }

  void writeBall(const std::string& name, int levels) const
  {
    SurfaceFile ball;
    ball.surface = sphere({ 0, 0, 0 }, 10, levels, 5);
    writeSurface(ball, folder.file(name));
  }

  void writeScaleFile(const std::string& name, const Grid& scaleGrid, float value) const
  {
    folder.write(name, nrrd("float", nrrdGeometry(scaleGrid), std::vector<float>(scaleGrid.voxelCount(), value)));
  }

  Grid grid;
};

} // namespace

TEST_F(FuchsTetrahedralizerCLI, WritesEveryOutputAndNoOther)
{
  expectDone("--scale scale.nrrd --report r.json ball.vtp m.vtu");
  EXPECT_EQ(folder.files(), (std::vector<std::string>{ "ball.vtp", "m.vtu", "r.json", "scale.nrrd" }));
  const MeshFile mesh = readMesh(folder.file("m.vtu")); // refuses flat and inverted tetrahedra and unused points
  EXPECT_EQ(mesh.mesh.labels, std::vector<Label>(mesh.mesh.tetrahedra.size(), 5));
  EXPECT_EQ(mesh.targetEdgeLength, std::vector<double>(mesh.mesh.points.size(), 2));
}

TEST_F(FuchsTetrahedralizerCLI, RefusesSurfacesAtFault)
{
  SurfaceFile broken;
  broken.surface = sphere({ 0, 0, 0 }, 10, 2);
  broken.surface.points[7].x = std::numeric_limits<double>::quiet_NaN();
  writeSurface(broken, folder.file("nan.vtp"));
  const std::string whole = readBytes(folder.file("ball.vtp"));
  folder.write("cut.vtp", whole.substr(0, whole.size() / 2));
  folder.write("empty.vtp", "");
  folder.write("text.vtp", "not a surface\n");
  const std::string more = "--edgeLength 2 --report r.json ";
  for (const char* name : { "missing", "nan", "cut", "empty", "text" })
  {
    const std::string file = std::string(name) + ".vtp";
    expectRefused(more + file + " m.vtu", 1, file + ": ");
  }
  expectRefused(more + ". m.vtu", 1, "is a folder");
}

TEST_F(FuchsTetrahedralizerCLI, RefusesAmbientTetrahedraAtFault)
{
  expectDone("--edgeLength 4 ball.vtp whole.vtu");
  const std::string whole = readBytes(folder.file("whole.vtu"));
  folder.write("cut.vtu", whole.substr(0, whole.size() / 2));
  folder.write("empty.vtu", "");
  for (const char* name : { "missing", "cut", "empty" })
  {
    const std::string file = std::string(name) + ".vtu";
    expectRefused("--edgeLength 2 --ambient " + file + " ball.vtp m.vtu", 1, file + ": ");
  }
  expectRefused("--edgeLength 2 --ambient . ball.vtp m.vtu", 1, "is a folder");
}

TEST_F(FuchsTetrahedralizerCLI, RefusesScalesAtFault)
{
  Grid small = grid;
  small.size[2] = 6;
  writeScaleFile("small.nrrd", small, 2);
  writeScaleFile("zero.nrrd", grid, 0);
  writeScaleFile("negative.nrrd", grid, -1);
  writeScaleFile("nan.nrrd", grid, std::numeric_limits<float>::quiet_NaN());
  writeScaleFile("infinite.nrrd", grid, std::numeric_limits<float>::infinity());
  for (const char* name : { "small", "zero", "negative", "nan", "infinite", "missing" })
  {
    const std::string file = std::string(name) + ".nrrd";
    expectRefused("--scale " + file + " --report r.json ball.vtp m.vtu", 1, file + ": ");
  }
}

TEST_F(FuchsTetrahedralizerCLI, RefusesCommandLinesAtFault)
{
  expectRefused("ball.vtp m.vtu", 2, "neither --scale nor --edgeLength");
  expectRefused("--edgeLength 0 ball.vtp m.vtu", 2, "neither --scale nor --edgeLength");
  expectRefused("--edgeLength 2 --scale scale.nrrd ball.vtp m.vtu", 2, "both");
  for (const char* value : { "-1", "nan", "inf", "1e999", "two" })
  {
    expectRefused(std::string("--edgeLength ") + value + " ball.vtp m.vtu", 2, "edgeLength");
  }
  expectRefused("--edgeLength 2 ball.vtp", 2, "mesh");
}

TEST_F(FuchsTetrahedralizerCLI, ExportsSeveralFormatsWithTheirSidecars)
{
  folder.write("m.csv", "tissue,model,youngsModulus,poissonsRatio\n5,linear,3,0.4\n");
  expectDone("--edgeLength 4 --export a.inp --export b.feb --materials m.csv --shell 5:outside --shellThickness 0.5 "
             "--shells s.vtp --targetPoint 10,0,0 --nonlinearDistance 5 --nullDisplacementRadius 15 ball.vtp m.vtu");
  EXPECT_EQ(folder.files(), (std::vector<std::string>{ "a.inp", "a.inp.names.json", "b.feb", "b.feb.names.json",
                                                       "ball.vtp", "m.csv", "m.vtu", "s.vtp", "scale.nrrd" }));
  const MeshFile mesh = readMesh(folder.file("m.vtu"));
  EXPECT_EQ(std::set<std::int32_t>(mesh.constitutive.begin(), mesh.constitutive.end()),
            (std::set<std::int32_t>{ 0, 1, 2 }));
  const std::string deck = readBytes(folder.file("a.inp"));
  for (const char* card : { "NAME=material_tissue_5_linear_elastic", "TYPE=S3", "*BOUNDARY\nnull_displacement_nodes" })
  {
    EXPECT_NE(deck.find(card), std::string::npos) << card;
  }
}

TEST_F(FuchsTetrahedralizerCLI, MakesShellsOfTissuesThatTheSurfaceMarks)
{
  SurfaceFile marked = readSurface(folder.file("ball.vtp"));
  marked.tissues[5].isShell = true;
  writeSurface(marked, folder.file("marked.vtp"));
  expectDone("--edgeLength 4 --shells s.vtp marked.vtp m.vtu");
  const SurfaceFile shells = readSurface(folder.file("s.vtp"));
  EXPECT_EQ(shells.surface.triangles.size(), interfaceOf(readMesh(folder.file("m.vtu")).mesh).triangles.size());
}

TEST_F(FuchsTetrahedralizerCLI, RefusesExportsAtFault)
{
  const std::string start = "--edgeLength 4 ", end = " ball.vtp m.vtu";
  expectRefused(start + "--export a.inp --export a.foo" + end, 2, ".feb, .inp, ");
  expectRefused(start + "--export nowhere/a.inp" + end, 1, "nowhere");
  expectRefused(start + "--export m.vtu" + end, 2, "another output");
  std::filesystem::create_directory(folder.file("a.inp.names.json"));
  expectRefused(start + "--export b.feb --export a.inp" + end, 1, "a.inp.names.json: folder found");

  expectRefused(start + "--shells s.vtp" + end, 2, "no --shell");
  expectRefused(start + "--shell 5" + end, 2, "neither --shells nor --export");
  for (const char* shell : { "6", "0", "nose", "5:7", ":5", "''", "5,6" })
  {
    expectRefused(start + "--shells s.vtp --shell " + shell + end, 2, "TISSUE:NEIGHBOUR");
  }
  expectRefused(start + "--shells s.vtp --shell 5:5" + end, 1, "no face");
}

TEST_F(FuchsTetrahedralizerCLI, RefusesMaterialsAndDistancesAtFault)
{
  const std::string start = "--edgeLength 4 --export b.inp ", end = " ball.vtp m.vtu";
  folder.write("nose.csv", "tissue,youngsModulus,poissonsRatio\nnose,3,0.4\n");
  expectRefused(start + "--materials nose.csv" + end, 1, "nose.csv:2: ");
  expectRefused(start + "--materials none.csv" + end, 1, "none.csv");
  expectRefused(start + "--nonlinearDistance 5" + end, 2, "no target or path");
  expectRefused(start + "--targetPoint 0,0,0" + end, 2, "distance");
  expectRefused(start + "--targetPoint 0,0,0 --nullDisplacementPathDistance 5" + end, 2, "no path");
  expectRefused(start + "--pathPoint 0,0,0 --nonlinearDistance 5" + end, 2, "two points");
  expectRefused(start + "--targets none.fcsv --nonlinearDistance 5" + end, 1, "none.fcsv");
}

TEST_F(FuchsTetrahedralizerCLI, RefusesPlacesThatCanNotBeWrittenTo)
{
  expectRefused("--edgeLength 2 ball.vtp nowhere/m.vtu", 1, "nowhere");
  expectRefused("--edgeLength 2 --report nowhere/r.json ball.vtp m.vtu", 1, "nowhere");
  std::filesystem::create_symlink("/dev/full", folder.file("full.vtu"));
  expectRefused("--edgeLength 2 ball.vtp full.vtu", 1, "full.vtu: device found");
  expectSaysThatAFileCanNotGrow("--edgeLength 2 ball.vtp m.vtu");
}

TEST_F(FuchsTetrahedralizerCLI, SaysThatTheDiskIsFull)
{
  expectSaysThatTheDiskIsFull("--edgeLength 1.5 --report disk/r.json ball.vtp disk/m.vtu");
}

TEST_F(FuchsTetrahedralizerCLI, SaysThatTheDiskIsFullOfAnExport)
{
  expectSaysThatTheDiskIsFull("--edgeLength 1.5 --export disk/a.inp ball.vtp m.vtu");
}

TEST_F(FuchsTetrahedralizerCLI, LeavesNothingWhenKilled)
{
  writeBall("fine.vtp", 5);
  expectLeavesNothingWhenKilled("--edgeLength 0.7 --report r.json fine.vtp m.vtu", "tetrahedra");
}
