#!/usr/bin/python3
"""Solves a child mesh with its parent condensed onto the interface, and the whole mesh for comparison.

usage: condensation.py WHOLE.vtu PARENT.vtu CHILD.vtu [REPORT.json]

The meshes are those of FuchsTetrahedralizerCLI --parentMesh PARENT.vtu --childMesh CHILD.vtu. Their weight pulls them
down, the parent's lowest points are clamped, and one point of the child after the other is pushed. See
Docs/Multirate.md. Ends with status 1 if the child's displacements differ from those in the whole mesh by more than 1e-8
of their size.
"""
import json
import os
import sys
import time
from types import SimpleNamespace

import numpy as np
from scipy import sparse
from vtk.util.numpy_support import vtk_to_numpy

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, "workflow", "example"), os.path.join(ROOT, "Testing", "Python")]
from elasticity import Cholesky, stiffness, unknowns, weight  # noqa: E402
from meshfiles import read_dataset  # noqa: E402

YOUNGS_MODULUS, POISSONS_RATIO = 0.003, 0.45  # MPa; soft tissue
WEIGHT = (0, 0, -4e-7)  # N/mm^3, of a brain in cerebrospinal fluid: 40 kg/m^3 more than that
CLAMPED_SHARE = 0.05
PUSH, PUSHED_POINTS = 0.01, 10  # N
TOLERANCE = 1e-8


class Part:
    """Stiffness, weight and point numbers of one mesh."""

    def __init__(self, file):
        grid = read_dataset(file)
        self.points = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
        tetrahedra = vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4)
        arrays = {name: vtk_to_numpy(grid.GetPointData().GetArray(name))
                  for name in ("VolumePointId", "InterfaceId") if grid.GetPointData().HasArray(name)}
        self.volume_point = arrays.get("VolumePointId")
        self.interface = arrays.get("InterfaceId")
        self.tetrahedra = len(tetrahedra)
        self.stiffness = stiffness(self.points, tetrahedra, YOUNGS_MODULUS, POISSONS_RATIO)
        self.force = weight(self.points, tetrahedra, WEIGHT)

    def interface_unknowns(self):
        """In the order of the interface's numbers."""
        shared = np.flatnonzero(self.interface >= 0)
        return unknowns(shared[np.argsort(self.interface[shared])]).ravel()


def timed(function):
    start = time.perf_counter()
    result = function()
    return result, time.perf_counter() - start


def clamped_points(parent):
    """The lowest of the parent's inner points."""
    inner = np.flatnonzero(parent.interface < 0)
    heights = parent.points[inner, 2]
    return inner[heights <= np.quantile(heights, CLAMPED_SHARE)]


def pushed_points(child):
    """Inner points of the child next to its middle."""
    distance = np.linalg.norm(child.points - child.points.mean(axis=0), axis=1)
    distance[child.interface >= 0] = np.inf
    return np.argsort(distance)[:PUSHED_POINTS]


def without(fixed_points, part):
    """The unknowns of a part that are free."""
    return np.setdiff1d(np.arange(3 * len(part.points)), unknowns(fixed_points))


def norton_equivalent(parent, clamped):
    """The parent's stiffness and force as the interface feels them."""
    free = without(clamped, parent)
    interface = np.searchsorted(free, parent.interface_unknowns())
    factor = Cholesky(parent.stiffness[free][:, free], last=interface)
    displacement = factor.solve(parent.force[free])[interface]  # of a parent without child
    conductance = factor.condensed()
    return conductance, conductance @ displacement


def child_system(child, conductance, source):
    interface = child.interface_unknowns()
    rows, columns = np.repeat(interface, len(interface)), np.tile(interface, len(interface))
    matrix = child.stiffness + sparse.coo_matrix((conductance.ravel(), (rows, columns)), child.stiffness.shape)
    force = child.force.copy()
    force[interface] += source
    return Cholesky(matrix.tocsr(), last=interface), force


def pushes(part, points):
    """Forces on all unknowns, one column per pushed point."""
    result = np.zeros((3 * len(part.points), len(points)))
    result[unknowns(points)[:, 1], np.arange(len(points))] = PUSH
    return result


def solve_whole(whole, clamped, pushed):
    free = without(clamped, whole)
    factor, factor_seconds = timed(lambda: Cholesky(whole.stiffness[free][:, free]))
    forces = whole.force[:, None] + pushes(whole, pushed)
    columns, seconds = zip(*(timed(lambda force=force: factor.solve(force[free])) for force in forces.T))
    displacements = np.zeros_like(forces)
    displacements[free] = np.transpose(columns)
    return displacements, SimpleNamespace(unknowns=len(free), factor=factor_seconds, solve=np.mean(seconds))


def solve_child(child, parent, clamped, pushed):
    (conductance, source), condense_seconds = timed(lambda: norton_equivalent(parent, clamped))
    (factor, force), factor_seconds = timed(lambda: child_system(child, conductance, source))
    forces = force[:, None] + pushes(child, pushed)
    columns, seconds = zip(*(timed(lambda force=force: factor.solve(force)) for force in forces.T))
    return np.transpose(columns), SimpleNamespace(unknowns=len(force), condense=condense_seconds, factor=factor_seconds,
                                                  solve=np.mean(seconds))


def compare(whole, parent, child):
    clamped, pushed = clamped_points(parent), pushed_points(child)
    expected, of_whole = solve_whole(whole, parent.volume_point[clamped], child.volume_point[pushed])
    found, of_child = solve_child(child, parent, clamped, pushed)
    expected = expected[unknowns(child.volume_point).ravel()]
    difference = np.linalg.norm(found - expected, axis=0) / np.linalg.norm(expected, axis=0)
    return {
        "whole": {"tetrahedra": whole.tetrahedra, "unknowns": of_whole.unknowns, "factorSeconds": of_whole.factor,
                  "solveSeconds": of_whole.solve},
        "parent": {"tetrahedra": parent.tetrahedra, "interfacePoints": int(np.sum(parent.interface >= 0)),
                   "condenseSeconds": of_child.condense},
        "child": {"tetrahedra": child.tetrahedra, "unknowns": of_child.unknowns, "factorSeconds": of_child.factor,
                  "solveSeconds": of_child.solve},
        "largestDisplacement": float(np.linalg.norm(expected.reshape(-1, 3, PUSHED_POINTS), axis=1).max()),
        "relativeDifference": float(difference.max()),
    }


def print_table(report):
    whole, parent, child = report["whole"], report["parent"], report["child"]
    print(f"                        {'whole':>12} {'child':>12}")
    for name, key, form in (("tetrahedra", "tetrahedra", "12,d"), ("unknowns", "unknowns", "12,d"),
                            ("factorization (s)", "factorSeconds", "12.2f"), ("one load (s)", "solveSeconds", "12.4f")):
        print(f"{name:<24}{whole[key]:{form}} {child[key]:{form}}")
    print(f"\nparent: {parent['tetrahedra']:,} tetrahedra, condensed onto {parent['interfacePoints']:,} points in "
          f"{parent['condenseSeconds']:.2f} s, once")
    print(f"largest displacement of the child: {report['largestDisplacement']:.3g} mm")
    print(f"relative difference of the child's displacements: {report['relativeDifference']:.2g}")


def main():
    if len(sys.argv) not in (4, 5):
        sys.exit(__doc__)
    try:
        report = compare(*(Part(file) for file in sys.argv[1:4]))
    except ArithmeticError:
        sys.exit("the equations are singular: part of the mesh hangs on no clamped point, expected one body")
    print_table(report)
    if len(sys.argv) == 5:
        with open(sys.argv[4], "w", encoding="utf-8") as file:
            json.dump(report, file, indent=2)
            file.write("\n")
    if not report["relativeDifference"] <= TOLERANCE:
        sys.exit(1)


if __name__ == "__main__":
    main()
