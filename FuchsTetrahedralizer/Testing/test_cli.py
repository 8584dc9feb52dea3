#!/usr/bin/python3
"""The tetrahedralizer from outside: what goes in, what comes out, what is refused and how.

Usage: test_cli.py EXECUTABLE FOLDER
"""
import itertools
import json
import math
import os
import shutil
import subprocess
import sys
import unittest

import vtk

EXECUTABLE, FOLDER = sys.argv[1:3]


def output_of(source):
    triangles = vtk.vtkTriangleFilter()
    triangles.SetInputConnection(source.GetOutputPort())
    triangles.PassLinesOff()
    triangles.PassVertsOff()
    triangles.Update()
    return triangles.GetOutput()


def sphere(radius, x=0.0):
    source = vtk.vtkSphereSource()
    source.SetRadius(radius)
    source.SetCenter(x, 0, 0)
    source.SetThetaResolution(16)
    source.SetPhiResolution(12)
    return output_of(source)


def together(*surfaces):
    joined = vtk.vtkAppendPolyData()
    for surface in surfaces:
        joined.AddInputData(surface)
    joined.Update()
    return joined.GetOutput()


def parametric(function):
    source = vtk.vtkParametricFunctionSource()
    source.SetParametricFunction(function)
    source.SetUResolution(24)
    source.SetVResolution(18)
    return output_of(source)


def configured(source, **settings):
    for name, value in settings.items():
        getattr(source, "Set" + name)(value)
    return output_of(source)


def label(surface, behind, front):
    labels = vtk.vtkIntArray()
    labels.SetName("BoundaryLabels")
    labels.SetNumberOfComponents(2)
    for _ in range(surface.GetNumberOfCells()):
        labels.InsertNextTuple2(behind, front)
    surface.GetCellData().AddArray(labels)
    return surface


def write(data, name):
    path = os.path.join(FOLDER, name)
    writers = {".vtp": vtk.vtkXMLPolyDataWriter, ".stl": vtk.vtkSTLWriter, ".ply": vtk.vtkPLYWriter,
               ".vtu": vtk.vtkXMLUnstructuredGridWriter}
    writer = writers[os.path.splitext(name)[1]]()
    writer.SetInputData(data)
    writer.SetFileName(path)
    writer.Write()
    return path


def read(path):
    reader = vtk.vtkXMLUnstructuredGridReader() if path.endswith(".vtu") else vtk.vtkUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def read_surface(path):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def one_in_five():
    """A tetrahedron of tissue 3 within four of background, and its four triangles."""
    corners = [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)]
    points = vtk.vtkPoints()
    for corner in corners + [tuple(-3 * x for x in corner) for corner in corners]:
        points.InsertNextPoint(corner)
    grid, labels = vtk.vtkUnstructuredGrid(), vtk.vtkIntArray()
    grid.SetPoints(points)
    labels.SetName("TissueLabel")
    surface, triangles = vtk.vtkPolyData(), vtk.vtkCellArray()
    surface.SetPoints(points)

    def add(ids, value):
        a, b, c, d = (points.GetPoint(i) for i in ids)
        if vtk.vtkTetra.ComputeVolume(a, b, c, d) < 0:
            ids = [ids[1], ids[0], *ids[2:]]
        grid.InsertNextCell(vtk.VTK_TETRA, 4, ids)
        labels.InsertNextValue(value)

    add([0, 1, 2, 3], 3)
    for apex in range(4):
        face = [i for i in range(4) if i != apex]
        add([*face, 4 + apex], 0)
        a, b, c, d = (points.GetPoint(i) for i in [*face, apex])
        outward = vtk.vtkTetra.ComputeVolume(a, b, c, d) < 0
        triangles.InsertNextCell(3, face if outward else face[::-1])
    grid.GetCellData().AddArray(labels)
    surface.SetPolys(triangles)
    return grid, label(surface, 3, 0)


class FuchsTetrahedralizer(unittest.TestCase):
    def setUp(self):
        shutil.rmtree(FOLDER, ignore_errors=True)
        os.makedirs(FOLDER)
        self.mesh = os.path.join(FOLDER, "mesh.vtu")
        self.report = os.path.join(FOLDER, "report.json")

    def run_module(self, *arguments, mesh=None):
        return subprocess.run([EXECUTABLE, *arguments, mesh or self.mesh], capture_output=True, text=True)

    def refused(self, status, expected, *arguments):
        run = self.run_module(*arguments)
        self.assertEqual(run.returncode, status, run.stderr)
        self.assertEqual(len(run.stderr.strip().splitlines()), 1, run.stderr)
        self.assertIn(expected, run.stderr)
        self.assertFalse(os.path.exists(self.mesh))

    def filled(self, *arguments, mesh=None):
        run = self.run_module("--report", self.report, *arguments, mesh=mesh)
        self.assertEqual(run.returncode, 0, run.stderr)
        with open(self.report, encoding="utf-8") as file:
            return json.load(file)

    def test_closed_surfaces_from_elsewhere(self):
        shapes = {
            "sphere": (sphere(10), 2),
            "cylinder": (configured(vtk.vtkCylinderSource(), Radius=5, Height=12, Resolution=16), 2),
            "cone": (configured(vtk.vtkConeSource(), Radius=6, Height=12, Resolution=20), 2),
            "cube": (configured(vtk.vtkCubeSource(), XLength=3), 0.5),
            "superquadric": (configured(vtk.vtkSuperquadricSource(), Size=8), 2),
            "toroid": (configured(vtk.vtkSuperquadricSource(), Size=8, Toroidal=1), 2),
            "torus": (parametric(vtk.vtkParametricTorus()), 0.2),
            "ellipsoid": (parametric(vtk.vtkParametricEllipsoid()), 0.2),
            "dodecahedron": (configured(vtk.vtkPlatonicSolidSource(), SolidType=4), 0.3),
            "icosahedron": (configured(vtk.vtkPlatonicSolidSource(), SolidType=3), 0.3),
        }
        for (name, (surface, length)), extension in itertools.product(shapes.items(), (".stl", ".ply", ".vtp")):
            with self.subTest(name + extension):
                report = self.filled("--edgeLength", str(length), write(surface, name + extension))
                self.assertEqual([tissue["label"] for tissue in report["quality"]["tissues"]], [1])
                properties = vtk.vtkMassProperties()
                properties.SetInputData(surface)
                volume = report["quality"]["whole"]["volume"]
                # The surface may move by 0.017 of the edge length, and four times as far at what is bad otherwise.
                self.assertLess(abs(volume - properties.GetVolume()), 0.03 * length * properties.GetSurfaceArea())

    def test_nested_shells_are_tissues_in_each_other(self):
        surface = together(sphere(10), sphere(6, 1), sphere(2, 2), sphere(3, 20))
        report = self.filled("--edgeLength", "1.5", write(surface, "nested.stl"))
        topology = {tissue["label"]: (tissue["components"], tissue["tunnels"], tissue["cavities"])
                    for tissue in report["topology"]}
        self.assertEqual(topology, {1: (1, 0, 1), 2: (1, 0, 1), 3: (1, 0, 0), 4: (1, 0, 0)})

    def test_starts_from_ambient_tetrahedra(self):
        grid, surface = one_in_five()
        ambient, surface_file = write(grid, "ambient.vtu"), write(surface, "surface.vtp")
        report = self.filled("--edgeLength", "2", "--ambient", ambient, surface_file)
        self.assertEqual(report["start"], "ambient tetrahedra")
        mesh = read(self.mesh)
        labels = mesh.GetCellData().GetArray("TissueLabel")
        self.assertEqual({labels.GetValue(i) for i in range(mesh.GetNumberOfCells())}, {3})
        os.remove(self.mesh)
        other = write(label(sphere(1), 3, 0), "other.vtp")
        self.refused(1, "of another surface", "--edgeLength", "2", "--ambient", ambient, other)
        unlabelled = write(sphere(1), "unlabelled.vtp")
        self.refused(1, "of another surface", "--edgeLength", "2", "--ambient", ambient, unlabelled)

    def test_writes_both_formats_and_the_same_bytes_twice(self):
        surface = write(label(sphere(10), 3, 0), "surface.vtp")
        legacy = os.path.join(FOLDER, "mesh.vtk")
        self.filled("--edgeLength", "2", surface)
        self.filled("--edgeLength", "2", surface, mesh=legacy)
        self.assertEqual(read(self.mesh).GetNumberOfCells(), read(legacy).GetNumberOfCells())
        with open(self.mesh, "rb") as file:
            first = file.read()
        self.filled("--edgeLength", "2", "--threads", "1", surface)
        with open(self.mesh, "rb") as file:
            self.assertEqual(first, file.read())

    def test_takes_the_surfaces_own_lengths(self):
        surface = label(sphere(10), 3, 0)
        lengths = vtk.vtkDoubleArray()
        lengths.SetName("TargetEdgeLength")
        for i in range(surface.GetNumberOfPoints()):
            lengths.InsertNextValue(1 if surface.GetPoint(i)[0] < -5 else 3)
        surface.GetPointData().AddArray(lengths)
        report = self.filled(write(surface, "surface.vtp"))
        self.assertEqual(report["subMeshes"]["children"], 1)
        self.assertTrue(report["subMeshes"]["interfacePoints"])
        mesh = read(self.mesh)
        for name in ("SubMesh", "Constitutive"):
            array = mesh.GetCellData().GetArray(name)
            self.assertEqual({array.GetValue(i) for i in range(mesh.GetNumberOfCells())}, {0, 1})

    def test_reports_the_conditioning(self):
        surface = write(sphere(10), "surface.stl")
        self.assertNotIn("stiffness", self.filled("--edgeLength", "3", surface)["quality"])
        stiffness = self.filled("--edgeLength", "3", "--conditioning", surface)["quality"]["stiffness"]
        self.assertTrue(stiffness["converged"])
        self.assertGreater(stiffness["conditionNumber"], 1)
        self.assertLess(stiffness["unknowns"], 3 * read(self.mesh).GetNumberOfPoints())
        # Chebyshev's bound on conjugate gradients, in a norm that differs from the residual's by the condition at most.
        bound = 0.5 * stiffness["conditionNumber"]**0.5 * math.log(2e8 * stiffness["conditionNumber"])
        self.assertTrue(10 < stiffness["iterations"] <= bound, stiffness)
        self.assertAlmostEqual(stiffness["iterations"], stiffness["iterationsPerCubeRoot"] * stiffness["unknowns"]**(1 / 3))
        self.assertEqual(stiffness["localModes"], [])
        os.remove(self.mesh)
        self.refused(2, "--report", "--edgeLength", "3", "--conditioning", surface)

    def test_reports_explicit_steps(self):
        surface = write(together(label(sphere(10), 1, 0), label(sphere(4, 20), 2, 0)), "surface.vtp")
        report = self.filled("--edgeLength", "3", surface)["quality"]
        explicit = report["explicit"]
        steps = {tissue["label"]: tissue["step"] for tissue in explicit["tissues"]}
        self.assertEqual(explicit["step"], min(steps.values()))
        self.assertEqual(explicit["smallest"][0]["height"], report["whole"]["height"]["minimum"])
        self.assertEqual(len(explicit["smallest"]), 100)
        with open(os.path.join(FOLDER, "materials.csv"), "w", encoding="utf-8") as file:
            file.write("tissue, youngsModulus, poissonsRatio\n1, 300, 0.45\n")
        stiff = self.filled("--edgeLength", "3", "--materials", os.path.join(FOLDER, "materials.csv"), surface)
        with_stiff = {tissue["label"]: tissue["step"] for tissue in stiff["quality"]["explicit"]["tissues"]}
        self.assertAlmostEqual(with_stiff[1] / steps[1], 0.1)
        self.assertAlmostEqual(with_stiff[2] / steps[2], 1)

    def test_shows_the_triangles_it_refuses(self):
        crossing = together(label(sphere(5), 1, 0), label(sphere(5, 6), 2, 0))
        self.refused(1, "cuts itself", "--edgeLength", "2", write(crossing, "crossing.vtp"))
        offending = os.path.join(FOLDER, "crossing.offending.vtp")
        self.assertGreater(read_surface(offending).GetNumberOfCells(), 4)
        plane = output_of(vtk.vtkPlaneSource())
        self.refused(1, "the surface is open", "--edgeLength", "1", write(plane, "plane.stl"))
        self.assertTrue(os.path.exists(os.path.join(FOLDER, "plane.offending.vtp")))
        os.remove(offending)
        named = os.path.join(FOLDER, "named.vtp")
        self.refused(1, "cuts itself", "--edgeLength", "2", "--offendingTriangles", named,
                     os.path.join(FOLDER, "crossing.vtp"))
        self.assertGreater(read_surface(named).GetNumberOfCells(), 4)
        self.assertFalse(os.path.exists(offending))
        turned = label(sphere(5), 1, 0)
        turned.GetCellData().GetArray("BoundaryLabels").SetTuple2(7, 0, 1)
        self.refused(1, "mismatched sides", "--edgeLength", "2", write(turned, "turned.vtp"))

    def test_refuses_wrong_command_lines_and_files(self):
        surface = write(sphere(5), "surface.stl")
        self.refused(2, "neither --scale nor --edgeLength", surface)
        self.refused(2, "--edgeLength", "--edgeLength", "-1", surface)
        self.refused(1, "missing.vtp", "--edgeLength", "1", os.path.join(FOLDER, "missing.vtp"))
        self.refused(1, "scale.nrrd", "--scale", os.path.join(FOLDER, "scale.nrrd"), surface)
        empty = os.path.join(FOLDER, "empty.vtp")
        with open(empty, "w", encoding="utf-8"):
            pass
        self.refused(1, "empty.vtp", "--edgeLength", "1", empty)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
