// SPDX-License-Identifier: Apache-2.0
#include "ExecutableTest.h"
#include "FaceAdjacency.h"
#include "MeshChecks.h"
#include "MeshIO.h"
#include "MeshQuality.h"
#include "Shapes.h"

#include <filesystem>
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
  folder.write("text.vtp", "not a surface\n");
  expectRefused("--edgeLength 2 --ambient whole.vtu text.vtp m.vtu", 1, "text.vtp: ");
  expectRefused("--edgeLength 2 --scale scale.nrrd --ambient missing.vtu ball.vtp m.vtu", 2, "both");
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
  expectRefused(start + "--export m.vtu" + end, 2, "is an output of mesh");
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

TEST_F(FuchsTetrahedralizerCLI, Trial_B02_SidecarsReplaceNothing)
{
  writeBall("x.tissue_5.vtp", 1);
  const std::string more = "--edgeLength 4 ";
  expectRefused(more + "--export x.stl --export x.tissue_5.stl ball.vtp m.vtu", 2, "one file per tissue");
  expectRefused(more + "--export x.inp --report x.inp.names.json ball.vtp m.vtu", 2, "is an output of");
  expectRefused(more + "--export m.vtu ball.vtp m.vtu", 2, "is an output of");
  std::filesystem::copy_file(folder.file("ball.vtp"), folder.file("x.tissue_5.stl"));
  expectRefused(more + "--export x.stl x.tissue_5.stl m.vtu", 2, "which is an input");
  expectRefused(more + "--export x.stl --materials x.tissue_5.stl ball.vtp m.vtu", 2, "which is an input");
#ifdef SURGICALMESHER_HDF5
  expectRefused(more + "--export x.xdmf --export x_facets.xdmf ball.vtp m.vtu", 2, "is an output of");
#endif
}

TEST_F(FuchsTetrahedralizerCLI, Trial_B12_TheSurfaceOfOneTissueIsFilled)
{
  SurfaceFile part;
  part.surface = sphere({ 0, 0, 0 }, 10, 3, 2, 1);
  for (std::size_t t = 0; t < part.surface.labels.size(); ++t)
  {
    const Vec3 p = part.surface.points[part.surface.triangles[t][0]];
    part.surface.labels[t] = { Label(2), Label(p.x > 0 ? 1 : p.y > 0 ? 3 : 0) };
  }
  writeSurface(part, folder.file("ts-2.vtp"));
  const Outcome result = run("--edgeLength 4 ts-2.vtp m.vtu");
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("ts-2.vtp is the surface of tissue 2 alone"), std::string::npos) << result.out;
  const MeshFile mesh = readMesh(folder.file("m.vtu"));
  EXPECT_EQ(std::set<Label>(mesh.mesh.labels.begin(), mesh.mesh.labels.end()), std::set<Label>{ 2 });
}

TEST_F(FuchsTetrahedralizerCLI, Trial_B14_HeadersThatClaimTooMuchAreRefused)
{
  folder.write("g.ply",
               "ply\nformat ascii 1.0\nelement vertex 1000000000\nproperty float x\nproperty float y\n"
               "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n");
  expectRefused("--edgeLength 4 g.ply m.vtu", 1, "g.ply: the header claims 1000000000 (element vertex), expected");
  std::string huge = readBytes(folder.file("ball.vtp"));
  const std::size_t at = huge.find("NumberOfPoints=\"") + 16;
  huge.replace(at, huge.find('"', at) - at, "2000000000");
  folder.write("huge.vtp", huge);
  expectRefused("--edgeLength 4 huge.vtp m.vtu", 1, "huge.vtp: the header claims 2000000000 (NumberOfPoints)");
  folder.write("huge.vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 900000000 float\n0 0 0\n");
  expectRefused("--edgeLength 4 huge.vtk m.vtu", 1, "huge.vtk: the header claims 900000000 (POINTS)");
  folder.write("huge.stl", std::string(80, ' ') + "\xff\xff\xff\x7f" + std::string(100, '\0'));
  expectRefused("--edgeLength 4 huge.stl m.vtu", 1, "huge.stl: the header claims 2147483647 (triangles)");
}

TEST_F(FuchsTetrahedralizerCLI, Trial_B14_SizesThatDoNotFitAreRefusedWithTheEstimate)
{
  SurfaceFile ball;
  ball.surface = sphere({ 0, 0, 0 }, 1e6, 2, 5);
  writeSurface(ball, folder.file("planet.vtp"));
  expectRefused("--edgeLength 0.5 planet.vtp m.vtu", 1, "planet.vtp: at these edge lengths it takes about");
}

TEST_F(FuchsTetrahedralizerCLI, Trial_B14_MetresAreNotMillimetres)
{
  SurfaceFile ball;
  ball.surface = sphere({ 0, 0, 0 }, 0.01, 2, 5);
  ball.surface.labels.clear();
  writeSurface(ball, folder.file("metres.vtp"));
  expectRefused("--edgeLength 3 metres.vtp m.vtu", 1,
                "metres.vtp: the whole surface is 0.0346 mm across, shorter than one edge of 3 mm; expected "
                "millimetres, found what look like metres");
}

TEST_F(FuchsTetrahedralizerCLI, Trial_B15_AMeshThatIsHeldStillIsSaid)
{
  const Outcome result = run("--edgeLength 4 --targetPoint 1000,0,0 --nullDisplacementRadius 10 ball.vtp m.vtu");
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.err.find("warning: target (1e+03, 0, 0) mm LPS lies outside the surface"), std::string::npos)
    << result.err;
  EXPECT_NE(result.err.find("warning: every tetrahedron is null displacement"), std::string::npos) << result.err;
}

TEST_F(FuchsTetrahedralizerCLI, SaysThatASurfaceWasMadeForOtherLengths)
{
  SurfaceFile ball;
  ball.surface = sphere({ 0, 0, 0 }, 10, 3, 5);
  ball.targetEdgeLength.assign(ball.surface.points.size(), 2);
  writeSurface(ball, folder.file("made.vtp"));
  expectDone("--edgeLength 3 made.vtp m.vtu");
  expectDone("--edgeLength 5 ball.vtp m.vtu"); // which does not say what it was made for
  const Outcome result = run("--edgeLength 5 made.vtp m.vtu");
  EXPECT_EQ(result.status, 0);
  EXPECT_NE(result.err.find("made for edges 0.4 times as long"), std::string::npos) << result.err;
}

// It moved by shares of L: by as much as it is large, where that is ten times as long.
TEST_F(FuchsTetrahedralizerCLI, ATissueMuchSmallerThanLKeepsItsVolume)
{
  SurfaceFile small;
  small.surface.points = { { 3.9, 3.8, 1.8 }, { 9.4, 3.9, 2.4 }, { 9.4, 7.6, 2.8 }, { 3.5, 7.1, 2.6 },
                           { 3.7, 3.3, 5.4 }, { 9.5, 3.7, 5.4 }, { 9.3, 7.0, 6.0 }, { 3.8, 7.8, 5.5 } };
  small.surface.triangles = { { 0, 2, 1 }, { 0, 3, 2 }, { 4, 5, 6 }, { 4, 6, 7 }, { 0, 1, 5 }, { 0, 5, 4 },
                              { 1, 2, 6 }, { 1, 6, 5 }, { 2, 3, 7 }, { 2, 7, 6 }, { 3, 0, 4 }, { 3, 4, 7 } };
  small.surface.labels.assign(small.surface.triangles.size(), { 5, 0 });
  small.boundaryDistance.assign(small.surface.points.size(), 0); // as of a map: no edge is watched
  writeSurface(small, folder.file("small.vtp"));
  const double volume = checkSurface(small.surface).at(5).volume;
  for (const char* length : { "6", "12", "60" })
  {
    expectDone(std::string("--edgeLength ") + length + " small.vtp m.vtu");
    EXPECT_NEAR(tissueVolumes(readMesh(folder.file("m.vtu")).mesh).at(5), volume, 0.1 * volume) << length;
  }
}

// Columns were named in lower case, and kinds of files that are read were left out.
TEST_F(FuchsTetrahedralizerCLI, Trial_B15_MessagesSpellAsTheHelpDoes)
{
  folder.write("m.csv", "tissue,youngsModulus,poissonsRatio\n5,soft,0.45\n");
  expectRefused("--edgeLength 4 --materials m.csv ball.vtp m.vtu", 1, "m.csv:2: youngsModulus");
  folder.write("m.csv", "tissue,youngsModulus,poissonsRatio\n5,9,0.7\n");
  expectRefused("--edgeLength 4 --materials m.csv ball.vtp m.vtu", 1, "m.csv:2: poissonsRatio");
  folder.write("ball.xyz", "0 0 0\n");
  expectRefused("--edgeLength 4 ball.xyz m.vtu", 1, "expected .vtp, .vtk, .stl, .ply or .obj");
  EXPECT_NE(run("--help").out.find("[a file (.vtp, .vtk, .stl, .ply, .obj)]"), std::string::npos);
}

// Trial, 3b: a tissue that --materials forgot became soft tissue without a word.
TEST_F(FuchsTetrahedralizerCLI, Trial_3b_TissuesWithoutAMaterialAreListed)
{
  SurfaceFile two;
  two.surface = sphere({ 0, 0, 0 }, 10, 3, 5);
  append(two.surface, sphere({ 30, 0, 0 }, 10, 3, 7));
  two.tissues[7].name = "skull";
  writeSurface(two, folder.file("two.vtp"));
  folder.write("m.csv", "tissue,youngsModulus,poissonsRatio\n5,9,0.45\n");
  const Outcome result =
    run("--edgeLength 4 --materials m.csv --export m.inp --report r.json --returnparameterfile r.txt two.vtp m.vtu "
        "--progress none");
  EXPECT_EQ(result.status, 0) << result.err;
  const std::string warning = "m.csv: no row for 1 of 2 tissues, which get the default of soft tissue, 3 kPa: skull";
  EXPECT_NE(result.err.find(warning), std::string::npos) << result.err;
  EXPECT_NE(readBytes(folder.file("r.json")).find(warning), std::string::npos);
  EXPECT_NE(readBytes(folder.file("m.inp")).find("0.009,"), std::string::npos);
  EXPECT_EQ(readBytes(folder.file("r.txt")).find("tetrahedronCount = "), 0u);
  folder.write("bad.csv", "tissue,youngsModulus\n5,9\n");
  expectRefused("--edgeLength 4 --materials bad.csv two.vtp m2.vtu", 1, "no column poissonsRatio");
}

// B4: bulged by 1.6 % of its volume, with angles of 11 degrees.
TEST_F(FuchsTetrahedralizerCLI, Trial_B04_ACubeOfTwelveTrianglesKeepsItsShape)
{
  folder.write("cube.ply",
               "ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
               "element face 12\nproperty list uchar int vertex_indices\nend_header\n"
               "-10 -10 -10\n10 -10 -10\n-10 10 -10\n10 10 -10\n-10 -10 10\n10 -10 10\n-10 10 10\n10 10 10\n"
               "3 0 2 1\n3 1 2 3\n3 4 5 6\n3 5 7 6\n3 0 1 4\n3 1 5 4\n"
               "3 2 6 3\n3 3 6 7\n3 0 4 2\n3 2 4 6\n3 1 3 5\n3 3 7 5\n");
  expectDone("--edgeLength 5 --returnparameterfile r.txt cube.ply m.vtu");
  const TetMesh mesh = readMesh(folder.file("m.vtu")).mesh;
  double volume = 0;
  for (const auto& [a, b, c, d] : mesh.tetrahedra)
    volume += orient(mesh.points[a], mesh.points[b], mesh.points[c], mesh.points[d]) / 6;
  EXPECT_NEAR(volume, 8000, 8);
  const std::string figures = readBytes(folder.file("r.txt")), key = "smallestDihedralAngle = ";
  ASSERT_NE(figures.find(key), std::string::npos);
  EXPECT_GE(std::stod(figures.substr(figures.find(key) + key.size())), 20);

  // A surface of a map is folded at the map's cracks, which are no sharp edges: the option is not for it.
  SurfaceFile ofMap = readSurface(folder.file("cube.ply"));
  ofMap.boundaryDistance.assign(ofMap.surface.points.size(), 0);
  writeSurface(ofMap, folder.file("cube.vtp"));
  expectDone("--edgeLength 5 cube.vtp kept.vtu");
  expectDone("--edgeLength 5 --featureAngle 0 cube.vtp free.vtu");
  EXPECT_EQ(readBytes(folder.file("kept.vtu")), readBytes(folder.file("free.vtu")));
  EXPECT_NE(readBytes(folder.file("kept.vtu")), readBytes(folder.file("m.vtu")));
}
