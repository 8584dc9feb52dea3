#!/usr/bin/python3
"""Curves from outside: files in, chains of edges and beams out, and what is refused.

Usage: test_curves.py EXECUTABLE FOLDER
"""
import json
import os
import shutil
import subprocess
import sys
import unittest

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

EXECUTABLE, FOLDER = sys.argv[1:3]


def path(name):
    return os.path.join(FOLDER, name)


def write(data, name):
    writer = vtk.vtkXMLPolyDataWriter()
    writer.SetInputData(data)
    writer.SetFileName(path(name))
    writer.Write()
    return path(name)


def read(reader, name):
    reader.SetFileName(path(name))
    reader.Update()
    return reader.GetOutput()


def ball():
    source = vtk.vtkSphereSource()
    source.SetRadius(10)
    source.SetThetaResolution(20)
    source.SetPhiResolution(14)
    source.Update()
    return write(source.GetOutput(), "ball.vtp")


def line(name, positions, radii=None):
    """A .vtp of one line, with Radius if there are radii."""
    points, cells, data = vtk.vtkPoints(), vtk.vtkCellArray(), vtk.vtkPolyData()
    cells.InsertNextCell(len(positions))
    for position in positions:
        cells.InsertCellPoint(points.InsertNextPoint(position))
    data.SetPoints(points)
    data.SetLines(cells)
    if radii:
        array = vtk.vtkDoubleArray()
        array.SetName("Radius")
        for radius in radii:
            array.InsertNextValue(radius)
        data.GetPointData().AddArray(array)
    return write(data, name)


def markups(name, positions, radius):
    """A curve in RAS, as Slicer writes it, with the measurement of Tube Path."""
    points = [{"position": [-x, -y, z], "positionStatus": "defined"} for x, y, z in positions]
    content = {"markups": [{"type": "Curve", "coordinateSystem": "RAS", "controlPoints": points, "measurements": [
        {"name": "Radius", "controlPointValues": [radius] * len(points)}]}]}
    with open(path(name), "w", encoding="ascii") as file:
        json.dump(content, file)
    return path(name)


class Curves(unittest.TestCase):
    def setUp(self):
        shutil.rmtree(FOLDER, ignore_errors=True)
        os.makedirs(FOLDER)
        self.surface = ball()

    def run_module(self, *arguments):
        return subprocess.run([EXECUTABLE, "--edgeLength", "2", *arguments, self.surface, path("mesh.vtu")],
                              capture_output=True, text=True)

    def test_chains_are_edges_of_the_mesh_and_beams_of_the_exports(self):
        vessel = line("vessel.vtp", [(-7, 0, 1), (0, 1, 0), (7, 0, 1)], [0.4, 0.8, 0.4])
        nerve = markups("nerve.mrk.json", [(0, 1, 0), (1, 7, 0)], 0.5)
        run = self.run_module("--curves", vessel, "--curves", nerve, "--curveMesh", path("curves.vtp"),
                              "--export", path("mesh.inp"), "--export", path("mesh.xdmf"))
        self.assertEqual(run.returncode, 0, run.stderr)
        mesh = read(vtk.vtkXMLUnstructuredGridReader(), "mesh.vtu")
        curves = read(vtk.vtkXMLPolyDataReader(), "curves.vtp")
        ids = vtk_to_numpy(curves.GetPointData().GetArray("VolumePointId"))
        radii = vtk_to_numpy(curves.GetPointData().GetArray("Radius"))
        places = vtk_to_numpy(curves.GetPoints().GetData())
        np.testing.assert_array_equal(places, vtk_to_numpy(mesh.GetPoints().GetData())[ids])
        names = curves.GetFieldData().GetAbstractArray("CurveNames")
        self.assertEqual([names.GetValue(i) for i in range(2)], ["vessel", "nerve"])
        self.assertAlmostEqual(radii.max(), 0.8, delta=0.05)
        edges = set()
        for cell in range(mesh.GetNumberOfCells()):
            corners = [mesh.GetCell(cell).GetPointId(k) for k in range(4)]
            edges |= {frozenset((a, b)) for a in corners for b in corners if a < b}
        ends, count = [], 0
        for cell in range(2):
            chain = [ids[curves.GetCell(cell).GetPointId(k)] for k in range(curves.GetCell(cell).GetNumberOfPoints())]
            self.assertTrue(all(frozenset(pair) in edges for pair in zip(chain, chain[1:])))
            count += len(chain) - 1
            ends.append(chain)
        self.assertIn(ends[1][0], ends[0][1:-1])
        with open(path("mesh.inp"), encoding="ascii") as file:
            deck = file.read()
        with open(path("mesh.inp.names.json"), encoding="ascii") as file:
            beams = [entry for entry in json.load(file)["sets"] if entry["kind"] == "beam"]
        self.assertEqual(sum(beam["size"] for beam in beams), count)
        for beam in beams:
            self.assertIn(f"*ELEMENT, TYPE=B31, ELSET={beam['name']}\n", deck)
        self.assertEqual({beam["original"] for beam in beams}, {"vessel", "nerve"})
        if os.path.exists(path("mesh.xdmf")):
            self.assertTrue(os.path.exists(path("mesh_curves.xdmf")))

    def test_extensions_may_be_in_capitals(self):
        vessel = line("VESSEL.VTP", [(-7, 0, 1), (7, 0, 1)])
        run = self.run_module("--curves", vessel, "--curveRadius", "0.5")
        self.assertEqual(run.returncode, 0, run.stderr)

    def test_bytes_are_the_same_with_any_number_of_threads(self):
        vessel = line("vessel.vtp", [(-7, 0, 1), (0, 1, 0), (7, 0, 1)], [0.4, 0.8, 0.4])
        written = []
        for threads in ("1", "3"):
            run = self.run_module("--threads", threads, "--curves", vessel, "--curveMesh", path("curves.vtp"))
            self.assertEqual(run.returncode, 0, run.stderr)
            for name in ("mesh.vtu", "curves.vtp"):
                with open(path(name), "rb") as file:
                    written.append(file.read())
        self.assertEqual(written[:2], written[2:])

    def test_refusals_leave_nothing(self):
        crossing = [(-5, 0, 0), (5, 0, 0), (5, 5, 0), (0, 5, 0), (0, -5, 0)]
        for arguments, status, expected in [
                (["--curves", line("out.vtp", [(0, 0, 0), (0, 0, 30)])], 1, "leaves the tissues"),
                (["--curves", line("eight.vtp", crossing)], 1, "crosses"),
                (["--curves", markups("one.mrk.json", [(0, 0, 0)], 1)], 1, "one point"),
                (["--curves", self.surface], 1, "no lines"),
                (["--curves", line("flat.vtp", [(0, 0, 0), (5, 0, 0)], [1, 0])], 1, "Radius"),
                (["--curveMesh", path("curves.vtp")], 2, "--curves")]:
            with self.subTest(expected=expected):
                run = self.run_module(*arguments)
                self.assertEqual(run.returncode, status, run.stderr)
                self.assertEqual(len(run.stderr.strip().splitlines()), 1, run.stderr)
                self.assertIn(expected, run.stderr)
                self.assertFalse(os.path.exists(path("mesh.vtu")))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
