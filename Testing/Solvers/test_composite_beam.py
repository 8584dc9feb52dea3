"""Compares a soft cantilever with a stiff curve along its axis, by CalculiX, with the theory of composite beams.

usage: test_composite_beam.py MODULES FOLDER. Without CalculiX the status is 77.
"""
import math
import os
import shutil
import subprocess
import sys
import unittest

import numpy as np
import vtk

MODULES, FOLDER = sys.argv[1:3]
SKIPPED = 77
LENGTH, SIDE, RADIUS = 60.0, 6.0, 0.6  # mm
SOFT, STIFF = 0.01, {"beam": 20.0, "truss": 0.3}  # MPa; chosen so that matrix and curve both carry much of the load
FORCE = 1e-5  # N

DECK = """*INCLUDE, INPUT=beam.inp
*NSET, NSET=root
{root}
*BOUNDARY
root, 1, 3
*STEP
*STATIC
*CLOAD
{loads}
*NODE PRINT, NSET=all_nodes
U
*END STEP
"""


def box():
    source = vtk.vtkCubeSource()
    source.SetBounds(0, LENGTH, -SIDE / 2, SIDE / 2, -SIDE / 2, SIDE / 2)
    triangles, clean = vtk.vtkTriangleFilter(), vtk.vtkCleanPolyData()
    triangles.SetInputConnection(source.GetOutputPort())
    clean.SetInputConnection(triangles.GetOutputPort())
    writer = vtk.vtkXMLPolyDataWriter()
    writer.SetInputConnection(clean.GetOutputPort())
    writer.SetFileName(os.path.join(FOLDER, "box.vtp"))
    writer.Write()


def axis():
    line = vtk.vtkLineSource()
    line.SetPoint1(0, 0, 0)
    line.SetPoint2(LENGTH, 0, 0)
    writer = vtk.vtkXMLPolyDataWriter()
    writer.SetInputConnection(line.GetOutputPort())
    writer.SetFileName(os.path.join(FOLDER, "fibre.vtp"))
    writer.Write()


def points_of(name, reader):
    reader.SetFileName(os.path.join(FOLDER, name))
    reader.Update()
    return reader.GetOutput()


def displacements(elements, component):
    """Solves by CalculiX a cantilever with FORCE on its free end along axis `component`. Returns the nodes' distances
    from the held end of the box and their displacements (n, 2), and the free length (mm).

    All nodes up to the fifth node of the chain are held, because CalculiX clamps the rotation of a single beam end only
    loosely.
    """
    with open(os.path.join(FOLDER, "materials.csv"), "w", encoding="ascii") as table:
        table.write(f"tissue, model, youngsModulus, poissonsRatio, density\n1, linear, {1000 * SOFT}, 0.3, 1000\n")
    subprocess.run([os.path.join(MODULES, "FuchsTetrahedralizerCLI"), "--edgeLength", "1",
                    "--curves", os.path.join(FOLDER, "fibre.vtp"), "--curveRadius", str(RADIUS),
                    "--curveElements", elements, "--curveYoungsModulus", str(1000 * STIFF[elements]),
                    "--materials", os.path.join(FOLDER, "materials.csv"),
                    "--curveMesh", os.path.join(FOLDER, "chain.vtp"), "--export", os.path.join(FOLDER, "beam.inp"),
                    os.path.join(FOLDER, "box.vtp"), os.path.join(FOLDER, "mesh.vtu")], check=True)
    mesh = points_of("mesh.vtu", vtk.vtkXMLUnstructuredGridReader())
    chain = points_of("chain.vtp", vtk.vtkXMLPolyDataReader())
    count = mesh.GetNumberOfPoints()
    at = [mesh.GetPoint(i)[0] for i in range(count)]
    held = sorted(chain.GetPoint(k)[0] for k in range(chain.GetNumberOfPoints()))[4]
    root = [i + 1 for i in range(count) if at[i] <= held + 1e-6]
    tip = [i + 1 for i in range(count) if abs(at[i] - LENGTH) < 1e-6]
    with open(os.path.join(FOLDER, "load.inp"), "w", encoding="ascii") as deck:
        deck.write(DECK.format(root=",\n".join(map(str, root)),
                               loads="\n".join(f"{i}, {component}, {FORCE / len(tip):.8g}" for i in tip)))
    run = subprocess.run(["ccx", "load"], cwd=FOLDER, stdout=subprocess.PIPE, text=True)
    if run.returncode or "*ERROR" in run.stdout:
        raise AssertionError(run.stdout[-3000:])
    with open(os.path.join(FOLDER, "load.dat"), encoding="ascii") as results:
        rows = [line.split() for line in results]
    moved = {int(row[0]): float(row[component]) for row in rows if len(row) == 4 and row[0].isdigit()}
    return np.array([(at[i], moved[i + 1]) for i in range(count)]), LENGTH - held


class CompositeBeam(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(FOLDER, ignore_errors=True)
        os.makedirs(FOLDER)
        box()
        axis()

    def test_bends_as_both_together(self):
        stiffness = SOFT * SIDE ** 4 / 12 + STIFF["beam"] * math.pi * RADIUS ** 4 / 4
        nodes, free = displacements("beam", 2)
        expected = FORCE * free ** 3 / (3 * stiffness)
        found = nodes[nodes[:, 0] > LENGTH - 1e-6, 1].mean()
        print("bending", found / expected)
        self.assertAlmostEqual(found / expected, 1, delta=0.03)

    def test_stretches_as_both_together(self):
        """Measures away from the ends, where the load passes from the matrix to the truss."""
        stiffness = SOFT * SIDE ** 2 + STIFF["truss"] * math.pi * RADIUS ** 2
        nodes, _ = displacements("truss", 1)
        within = nodes[(nodes[:, 0] > LENGTH / 6) & (nodes[:, 0] < LENGTH / 2)]
        found, expected = np.polyfit(within[:, 0], within[:, 1], 1)[0], FORCE / stiffness
        print("stretch", found / expected)
        self.assertAlmostEqual(found / expected, 1, delta=0.03)


if __name__ == "__main__":
    if not shutil.which("ccx"):
        print("not installed: ccx")
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1])
