// SPDX-License-Identifier: Apache-2.0
#include "MeshIO.h"
#include "Errors.h"
#include "FaceAdjacency.h"
#include "MeshChecks.h"
#include "Shapes.h"
#include "TextFile.h"
#include "VoxelMesh.h"

#include <gtest/gtest.h>

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPLYWriter.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkSTLWriter.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace surgicalmesher
{
namespace
{

class ComplexIO : public testing::Test
{
protected:
  void SetUp() override
  {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    m_Folder = std::filesystem::path(testing::TempDir()) / (std::string("ComplexIO-") + info->name());
    std::filesystem::remove_all(m_Folder);
    std::filesystem::create_directories(m_Folder);
  }
  void TearDown() override { std::filesystem::remove_all(m_Folder); }

  std::string path(const std::string& name) const { return (m_Folder / name).string(); }

  template <class Action>
  void expectRefusal(const Action& action, const std::string& part) const
  {
    try
    {
      action();
      ADD_FAILURE() << "not refused; expected a message with '" << part << "'";
    }
    catch (const InputError& error)
    {
      const std::string message = error.what();
      EXPECT_NE(message.find(part), std::string::npos) << message;
      EXPECT_NE(message.find(m_Folder.filename().string()), std::string::npos) << "names no file: " << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
  }

  std::filesystem::path m_Folder;
};

std::string bytesOf(const std::string& file)
{
  std::ifstream stream(file, std::ios::binary);
  return { std::istreambuf_iterator<char>(stream), {} };
}

SurfaceFile someSurface()
{
  SurfaceFile content;
  content.surface = test::sphere({ 1.1, 2.2, 3.3 }, 4.4, 2, 7, 0);
  test::append(content.surface, test::sphere({ 1.1, 2.2, 3.3 }, 2.2, 1, 65535, 7));
  for (const Vec3& p : content.surface.points)
  {
    content.targetEdgeLength.push_back(1 + p.x * p.x);
    content.boundaryDistance.push_back(p.y / 3);
  }
  content.tissues[7] = { "left \"putamen\", <grey> & n\xc3\xa4"
                         "her",
                         { 0.1, 0.2, 0.3 } };
  return content;
}

MeshFile someMesh()
{
  MeshFile content;
  content.mesh =
    test::tetrahedraOf(test::paintedMap({ 3, 2, 2 }, [](int i, int, int) { return i; }, { 0.1, 0.7, 1.3 }));
  content.subMesh.assign(content.mesh.labels.begin(), content.mesh.labels.end());
  content.constitutive.assign(content.mesh.labels.begin(), content.mesh.labels.end());
  for (const Vec3& p : content.mesh.points)
  {
    content.targetEdgeLength.push_back(2 + p.x);
    content.subMeshInterface.push_back(p.x > 0);
    content.interfaceId.push_back(p.x > 0 ? static_cast<std::int32_t>(content.volumePointId.size()) : -1);
    content.volumePointId.push_back(2 * static_cast<std::int32_t>(content.volumePointId.size()));
  }
  content.tissues[2] = { "bone", { 1, 1, 0 }, true };
  return content;
}

bool samePoints(const std::vector<Vec3>& a, const std::vector<Vec3>& b)
{
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
}

vtkSmartPointer<vtkPolyData> polyDataOf(const SurfaceComplex& surface)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Vec3& p : surface.points) points->InsertNextPoint(p.x, p.y, p.z);
  vtkNew<vtkCellArray> cells;
  for (const auto& [a, b, c] : surface.triangles) cells->InsertNextCell({ a, b, c });
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

void writePolyData(vtkPolyData* data, const std::string& file)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(data);
  writer->SetFileName(file.c_str());
  ASSERT_TRUE(writer->Write());
}

TEST_F(ComplexIO, SurfaceComesBackAsItWas)
{
  const SurfaceFile written = someSurface();
  writeSurface(written, path("a.vtp"));
  const SurfaceFile read = readSurface(path("a.vtp"));
  EXPECT_TRUE(samePoints(read.surface.points, written.surface.points));
  EXPECT_EQ(read.surface.triangles, written.surface.triangles);
  EXPECT_EQ(read.surface.labels, written.surface.labels);
  EXPECT_EQ(read.targetEdgeLength, written.targetEdgeLength);
  EXPECT_EQ(read.boundaryDistance, written.boundaryDistance);
  ASSERT_EQ(read.tissues.size(), 2u);
  EXPECT_EQ(read.tissues.at(7).name, written.tissues.at(7).name);
  EXPECT_EQ(read.tissues.at(7).color, written.tissues.at(7).color);
  writeSurface(read, path("b.vtp"));
  EXPECT_EQ(bytesOf(path("a.vtp")), bytesOf(path("b.vtp")));
}

TEST_F(ComplexIO, MeshComesBackAsItWasFromBothFormats)
{
  const MeshFile written = someMesh();
  for (const std::string extension : { ".vtu", ".vtk" })
  {
    writeMesh(written, path("a" + extension));
    const MeshFile read = readMesh(path("a" + extension));
    EXPECT_TRUE(samePoints(read.mesh.points, written.mesh.points));
    EXPECT_EQ(read.mesh.tetrahedra, written.mesh.tetrahedra);
    EXPECT_EQ(read.mesh.labels, written.mesh.labels);
    EXPECT_EQ(read.subMesh, written.subMesh);
    EXPECT_EQ(read.constitutive, written.constitutive);
    EXPECT_EQ(read.subMeshInterface, written.subMeshInterface);
    EXPECT_EQ(read.volumePointId, written.volumePointId);
    EXPECT_EQ(read.interfaceId, written.interfaceId);
    EXPECT_EQ(read.targetEdgeLength, written.targetEdgeLength);
    EXPECT_EQ(read.tissues.at(2).name, "bone");
    EXPECT_TRUE(read.tissues.at(2).isShell);
    EXPECT_FALSE(read.tissues.at(1).isShell);
    writeMesh(read, path("b" + extension));
    EXPECT_EQ(bytesOf(path("a" + extension)), bytesOf(path("b" + extension))) << extension;
  }
}

TEST_F(ComplexIO, ReadsSurfacesOfOtherFormats)
{
  const SurfaceComplex surface = test::sphere({}, 8, 1);
  const auto data = polyDataOf(surface);
  vtkNew<vtkPLYWriter> ply;
  ply->SetInputData(data);
  ply->SetFileName(path("s.ply").c_str());
  ply->Write();
  vtkNew<vtkSTLWriter> stl;
  stl->SetInputData(data);
  stl->SetFileName(path("s.stl").c_str());
  stl->Write();
  vtkNew<vtkPolyDataWriter> legacy;
  legacy->SetInputData(data);
  legacy->SetFileName(path("s.vtk").c_str());
  legacy->Write();
  for (const std::string name : { "s.ply", "s.stl", "s.vtk" })
  {
    const SurfaceFile read = readSurface(path(name));
    EXPECT_EQ(read.surface.triangles.size(), surface.triangles.size()) << name;
    EXPECT_TRUE(read.surface.labels.empty()) << name;
  }
}

TEST_F(ComplexIO, TurnsRASToLPS)
{
  SurfaceComplex surface = test::sphere({ 5, 6, 7 }, 1, 1);
  vtkNew<vtkPolyDataWriter> writer;
  writer->SetInputData(polyDataOf(surface));
  writer->SetHeader("SPACE=RAS");
  writer->SetFileTypeToBinary();
  writer->SetFileName(path("ras.vtk").c_str());
  writer->Write();
  const SurfaceFile read = readSurface(path("ras.vtk"));
  for (std::size_t i = 0; i < surface.points.size(); ++i)
  {
    const Vec3& p = surface.points[i];
    EXPECT_TRUE((read.surface.points[i] == Vec3{ -p.x, -p.y, p.z }));
  }
}

TEST_F(ComplexIO, DropsPointsThatNoTriangleUses)
{
  SurfaceFile content = someSurface();
  content.surface.points.insert(content.surface.points.begin(), Vec3{ 99, 99, 99 });
  content.targetEdgeLength.insert(content.targetEdgeLength.begin(), 99);
  content.boundaryDistance.clear();
  for (auto& triangle : content.surface.triangles)
  {
    for (std::int32_t& id : triangle) ++id;
  }
  writeSurface(content, path("a.vtp"));
  const SurfaceFile read = readSurface(path("a.vtp"));
  EXPECT_TRUE(samePoints(read.surface.points, someSurface().surface.points));
  EXPECT_EQ(read.targetEdgeLength, someSurface().targetEdgeLength);
  EXPECT_EQ(read.surface.triangles, someSurface().surface.triangles);
}

TEST_F(ComplexIO, RefusesFilesThatAreNone)
{
  std::filesystem::create_directory(path("folder.vtp"));
  std::ofstream(path("text.vtp")) << "no XML";
  std::ofstream(path("empty.stl"));
  std::ofstream(path("text.ply")) << "hello";
  std::ofstream(path("text.vtk")) << "hello";
  std::ofstream(path("text.vtu")) << "<VTKFile type=\"PolyData\"></VTKFile>";
  expectRefusal([&] { readSurface(path("missing.vtp")); }, "no such file");
  expectRefusal([&] { readSurface(path("folder.vtp")); }, "folder");
  expectRefusal([&] { readSurface(path("surface.obj")); }, "no such file");
  for (const char* name : { "text.vtp", "empty.stl", "text.ply", "text.vtk" })
  {
    expectRefusal([&] { readSurface(path(name)); }, name);
  }
  expectRefusal([&] { readMesh(path("text.vtu")); }, "not a readable");
  expectRefusal([&] { readMesh(path("missing.vtu")); }, "no such file");
  expectRefusal([&] { readMesh(path("text.ply")); }, "expected .vtu or .vtk");
}

TEST_F(ComplexIO, RefusesTruncatedFiles)
{
  writeSurface(someSurface(), path("a.vtp"));
  writeMesh(someMesh(), path("a.vtu"));
  writeMesh(someMesh(), path("a.vtk"));
  for (const std::string name : { "a.vtp", "a.vtu", "a.vtk" })
  {
    const std::string bytes = bytesOf(path(name));
    for (const double share : { 0.1, 0.5, 0.8 })
    {
      writeBytes(bytes.substr(0, static_cast<std::size_t>(share * double(bytes.size()))), path("cut-" + name));
      expectRefusal([&]
                    { name == "a.vtp" ? (void)readSurface(path("cut-" + name)) : (void)readMesh(path("cut-" + name)); },
                    "cut-");
    }
  }
}

TEST_F(ComplexIO, RefusesSurfacesThatAreNotSound)
{
  const SurfaceComplex surface = test::sphere({}, 1, 1);
  writePolyData(polyDataOf({ surface.points, {}, {} }), path("empty.vtp"));
  expectRefusal([&] { readSurface(path("empty.vtp")); }, "no triangles");

  auto data = polyDataOf(surface);
  data->GetPoints()->SetPoint(3, 0, std::nan(""), 0);
  writePolyData(data, path("nan.vtp"));
  expectRefusal([&] { readSurface(path("nan.vtp")); }, "point 3");

  data = polyDataOf(surface);
  data->GetPolys()->InsertNextCell({ 0, 1, 1000 });
  writePolyData(data, path("index.vtp"));
  expectRefusal([&] { readSurface(path("index.vtp")); }, "1000");

  data = polyDataOf(surface);
  data->GetPolys()->InsertNextCell({ 0, 1, 1 });
  writePolyData(data, path("twice.vtp"));
  expectRefusal([&] { readSurface(path("twice.vtp")); }, "uses a point twice");
}

TEST_F(ComplexIO, RefusesArraysThatDoNotFit)
{
  const auto withLabels = [&](int components, int tuples, double behind, double front)
  {
    auto data = polyDataOf(test::sphere({}, 1, 1));
    vtkNew<vtkFloatArray> labels;
    labels->SetName("BoundaryLabels");
    labels->SetNumberOfComponents(components);
    for (int i = 0; i < components * tuples; ++i) labels->InsertNextValue(static_cast<float>(i % 2 ? front : behind));
    data->GetCellData()->AddArray(labels);
    writePolyData(data, path("labels.vtp"));
  };
  withLabels(2, 32, 1, 0);
  EXPECT_EQ(readSurface(path("labels.vtp")).surface.labels.size(), 32u);
  withLabels(1, 32, 1, 0);
  expectRefusal([&] { readSurface(path("labels.vtp")); }, "BoundaryLabels has 1 components");
  withLabels(2, 32, 1.5, 0);
  expectRefusal([&] { readSurface(path("labels.vtp")); }, "1.5");
  withLabels(2, 32, -1, 0);
  expectRefusal([&] { readSurface(path("labels.vtp")); }, "-1");
  withLabels(2, 32, 65536, 0);
  expectRefusal([&] { readSurface(path("labels.vtp")); }, "65536");
  withLabels(2, 32, 3, 3);
  expectRefusal([&] { readSurface(path("labels.vtp")); }, "label 3 on both sides");

  SurfaceFile content = someSurface();
  content.targetEdgeLength[4] = 0;
  writeSurface(content, path("length.vtp"));
  expectRefusal([&] { readSurface(path("length.vtp")); }, "TargetEdgeLength");
}

TEST_F(ComplexIO, RefusesMeshesThatAreNotSound)
{
  const auto refused = [&](const MeshFile& content, const std::string& part)
  {
    writeMesh(content, path("bad.vtu"));
    expectRefusal([&] { readMesh(path("bad.vtu")); }, part);
  };
  MeshFile inverted = someMesh();
  std::swap(inverted.mesh.tetrahedra[4][0], inverted.mesh.tetrahedra[4][1]);
  refused(inverted, "tetrahedron 4 is flat or inverted");
  MeshFile unlabelled = someMesh();
  unlabelled.mesh.labels.clear();
  refused(unlabelled, "no cell array TissueLabel");
  MeshFile outOfRange = someMesh();
  outOfRange.mesh.tetrahedra[0][2] = 100000;
  refused(outOfRange, "100000");
  MeshFile unused = someMesh();
  unused.mesh.points.push_back({});
  unused.targetEdgeLength.push_back(1);
  unused.subMeshInterface.push_back(0);
  unused.volumePointId.push_back(0);
  unused.interfaceId.push_back(-1);
  refused(unused, "belongs to no tetrahedron");

  vtkNew<vtkUnstructuredGrid> mixed;
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 4; ++i) points->InsertNextPoint(i == 1, i == 2, i == 3);
  mixed->SetPoints(points);
  const vtkIdType ids[4] = { 0, 1, 2, 3 };
  mixed->InsertNextCell(VTK_TETRA, 4, ids);
  mixed->InsertNextCell(VTK_TRIANGLE, 3, ids);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(mixed);
  writer->SetFileName(path("mixed.vtu").c_str());
  writer->Write();
  expectRefusal([&] { readMesh(path("mixed.vtu")); }, "cell 1 is of VTK type 5");
}

// VTK's legacy readers crash on these: cells of more points than there are numbers, and fewer types than cells.
TEST_F(ComplexIO, LegacyFilesWhoseCellsAreDamagedAreRefused)
{
  const std::string points = "POINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\n";
  const std::string grid = "# vtk DataFile Version 4.2\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n" + points;
  const std::string faces = "# vtk DataFile Version 4.2\nx\nASCII\nDATASET POLYDATA\n" + points;
  const std::string label = "CELL_DATA 1\nSCALARS TissueLabel int\nLOOKUP_TABLE default\n1\n";
  const auto write = [&](const std::string& text) { std::ofstream(path("cells.vtk")) << text; };
  write(grid + "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n" + label);
  EXPECT_EQ(readMesh(path("cells.vtk")).mesh.tetrahedra.size(), 1u);
  for (const std::string cells :
       { "CELLS 1 5\n400000000 0 1 2 3\nCELL_TYPES 1\n10\n", "CELLS 1 5\n-4 0 1 2 3\nCELL_TYPES 1\n10\n",
         "CELLS 1 5\n4 0 1 2 3\n", "CELLS 2 10\n4 0 1 2 3 4 0 1 2 3\nCELL_TYPES 1\n10\n",
         "CELLS 1 -5\n4 0 1 2 3\nCELL_TYPES 1\n10\n" })
  {
    write(grid + cells + label);
    expectRefusal([&] { readMesh(path("cells.vtk")); }, "cells.vtk: ");
  }
  write(faces + "POLYGONS 1 4\n300000000 0 1 2\n");
  expectRefusal([&] { readSurface(path("cells.vtk")); }, "cells.vtk: ");
}

// VTK's PLY reader ends its process where an element is not whole, and its XML readers leave their memory.
TEST_F(ComplexIO, SurfacesCutAnywhereAreRefusedOrReadByAProcessThatGoesOn)
{
  const SurfaceComplex surface = test::sphere({}, 8, 1);
  for (const std::string kind : { "ascii", "binary" })
  {
    vtkNew<vtkPLYWriter> writer;
    writer->SetInputData(polyDataOf(surface));
    writer->SetFileName(path("whole.ply").c_str());
    if (kind == "ascii") writer->SetFileTypeToASCII();
    else writer->SetFileTypeToBinary();
    writer->Write();
    const std::string bytes = bytesOf(path("whole.ply"));
    for (const double share : { 0.05, 0.3, 0.6, 0.9 })
    {
      writeBytes(bytes.substr(0, std::size_t(share * double(bytes.size()))), path("cut.ply"));
      expectRefusal([&] { readSurface(path("cut.ply")); }, "cut.ply: ");
    }
  }
  const std::string points = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  writeBytes(
    "ply\nformat ascii 1.0\n" + points +
      "element face 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n900000000 0 1 2\n",
    path("list.ply"));
  expectRefusal([&] { readSurface(path("list.ply")); }, "list.ply: ");
}

TEST_F(ComplexIO, WritersReportWhatTheyCannotWrite)
{
  expectRefusal([&] { writeSurface(someSurface(), path("missing/a.vtp")); }, "can't be opened");
  expectRefusal([&] { writeMesh(someMesh(), path("missing/a.vtu")); }, "can't be opened");
  expectRefusal([&] { writeMesh(someMesh(), path("a.obj")); }, ".vtu or .vtk");
  expectRefusal([&] { writeSurface(someSurface(), path("a.stl")); }, ".vtp");
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no device that is always full";
  for (const std::string name : { "full.vtp", "full.vtu", "full.vtk" })
  {
    std::filesystem::create_symlink("/dev/full", path(name));
    expectRefusal([&]
                  { name == "full.vtp" ? writeSurface(someSurface(), path(name)) : writeMesh(someMesh(), path(name)); },
                  "to its end");
  }
}

} // namespace
} // namespace surgicalmesher
