"""Child and parent of a real map apart are the whole mesh, and move like it. usage: test_divided_map.py BIN OUTDIR"""
import csv
import os
import shutil
import subprocess
import sys
import unittest

import numpy as np
from PIL import Image, ImageSequence
from vtk.util.numpy_support import vtk_to_numpy

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, "workflow", "example"), os.path.join(ROOT, "Testing", "Python")]
from elasticity import Cholesky, stiffness, unknowns, weight  # noqa: E402
from maps import cut_out, write_nrrd  # noqa: E402
from meshfiles import read_dataset, read_mesh  # noqa: E402

BIN, OUTDIR = sys.argv[1:3]


def run(module, *arguments):
    return subprocess.run([os.path.join(BIN, module), *arguments], capture_output=True, text=True)


def done(module, *arguments):
    result = run(module, *arguments)
    if result.returncode:
        raise AssertionError(result.stderr)


def point_array(file, name):
    return vtk_to_numpy(read_dataset(file).GetPointData().GetArray(name))


class DividedMapTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(OUTDIR, ignore_errors=True)
        os.makedirs(OUTDIR)
        os.chdir(OUTDIR)
        labels, affine = cut_out(np.s_[62:98, 80:116, 56:92])
        write_nrrd("map.nrrd", labels, affine)
        target = (affine @ [*(np.array(labels.shape) // 2), 1])[:3]
        done("SurgicalPathScaleCLI", "--targetPoint", "%g,%g,%g" % tuple(target), "--minimumEdgeLength", "2",
             "--maximumEdgeLength", "8", "--childRadius", "8", "--decayLength", "10", "map.nrrd", "scale.nrrd")
        done("SimplexMesherCLI", "--scale", "scale.nrrd", "--ambient", "ambient.vtu", "map.nrrd", "surface.vtp")
        done("FuchsTetrahedralizerCLI", "--scale", "scale.nrrd", "--ambient", "ambient.vtu", "--parentMesh",
             "parent.vtu", "--childMesh", "child.vtu", "surface.vtp", "mesh.vtu")

    def test_parts_are_the_whole_mesh(self):
        whole, parts = read_mesh("mesh.vtu"), {part: read_mesh(part + ".vtu") for part in ("parent", "child")}
        for name, chosen in (("parent", whole.submesh == 0), ("child", whole.submesh > 0)):
            part, ids = parts[name], point_array(name + ".vtu", "VolumePointId")
            np.testing.assert_array_equal(ids[part.tetrahedra], whole.tetrahedra[chosen])
            np.testing.assert_array_equal(part.points, whole.points[ids])
            np.testing.assert_array_equal(part.tissue, whole.tissue[chosen])

    def test_interface_is_numbered_alike_and_complete(self):
        numbers = []
        for file in ("parent.vtu", "child.vtu"):
            ids, interface = point_array(file, "VolumePointId"), point_array(file, "InterfaceId")
            shared = interface >= 0
            np.testing.assert_array_equal(np.sort(interface[shared]), np.arange(shared.sum()))
            numbers.append(dict(zip(ids[shared], interface[shared])))
        self.assertGreater(len(numbers[0]), 0)
        self.assertEqual(*numbers)
        in_both = np.intersect1d(point_array("parent.vtu", "VolumePointId"), point_array("child.vtu", "VolumePointId"))
        self.assertEqual(set(numbers[0]), set(in_both))

    def test_child_moves_as_in_the_whole(self):
        """Held, pushed and weighed down alike, the whole mesh has the displacements of its parts."""
        child = read_mesh("child.vtu")
        inner = point_array("child.vtu", "InterfaceId") < 0
        tip = child.points[inner][np.argmin(np.linalg.norm(child.points[inner] - child.points.mean(axis=0), axis=1))]
        with open("tool.csv", "w", encoding="utf-8") as file:
            file.write("seconds,x,y,z\n0,%r,%r,%r\n0.1,%r,%r,%r\n" % (*tip.tolist(), *(tip + [3, 1, 2]).tolist()))
        done("MultirateSolverCLI", "--tool", "tool.csv", "--toolRadius", "0", "--forces", "forces.csv",
             "--displacedParent", "p.vtu", "parent.vtu", "child.vtu", "c.vtu")
        whole = read_mesh("mesh.vtu")
        found = np.zeros_like(whole.points)
        for file in ("p.vtu", "c.vtu"):
            found[point_array(file, "VolumePointId")] = point_array(file, "Displacement")
        with open("forces.csv", encoding="utf-8") as file:
            last = list(csv.DictReader(file))[-1]
        matrix = stiffness(whole.points, whole.tetrahedra, 0.003, 0.45)
        forces = weight(whole.points, whole.tetrahedra, (0, 0, -4e-7))
        pushed = np.argmin(np.linalg.norm(whole.points - tip, axis=1))
        forces[unknowns(pushed)] += [float(last["force" + axis]) for axis in "XYZ"]
        free = np.flatnonzero(np.repeat(np.any(found != 0, axis=1), 3))
        expected = np.zeros(found.size)
        expected[free] = Cholesky(matrix[free][:, free]).solve(forces[free])
        difference = np.linalg.norm(found.ravel() - expected) / np.linalg.norm(expected)
        print(f"{len(free)} unknowns, relative difference {difference:.1e}")
        self.assertLess(difference, 1e-7)  # nine digits of the force are in the table
        self.assertGreater(np.abs(found[pushed]).max(), 0.1)
        held = np.all(found == 0, axis=1)
        self.assertAlmostEqual(held.sum() / len(found), 0.05, 1)
        self.assertTrue(np.all(whole.submesh[np.any(held[whole.tetrahedra], axis=1)] == 0))

    def test_a_replayed_tool_is_shown_moving_the_child(self):
        example = os.path.join(ROOT, "workflow", "example", "display.py")
        done_by = subprocess.run([sys.executable, example, os.path.join(ROOT, "workflow", "multirate", "replay.py"),
                                  "parent.vtu", "child.vtu", "replayed"], capture_output=True, text=True, check=False,
                                 env={**os.environ, "PATH": os.path.abspath(BIN) + ":" + os.environ["PATH"]})
        self.assertEqual(done_by.returncode, 0, done_by.stderr)
        with Image.open("replayed/multirate.gif") as picture:
            frames = [np.array(frame.convert("L"), float)[20:] for frame in ImageSequence.Iterator(picture)]
        changes = [np.abs(frame - frames[0]).mean() for frame in frames]
        self.assertEqual(len(frames), 31)
        self.assertGreater(np.argmax(changes), 10)
        self.assertGreater(max(changes), 5 * changes[1])
        self.assertLess(changes[-1], 0.1 * max(changes), "the tool lets back")

    def test_a_mesh_without_child_has_a_parent_alone(self):
        done("FuchsTetrahedralizerCLI", "--edgeLength", "4", "--parentMesh", "all.vtu", "surface.vtp", "uniform.vtu")
        np.testing.assert_array_equal(read_mesh("all.vtu").tetrahedra, read_mesh("uniform.vtu").tetrahedra)
        refused = run("FuchsTetrahedralizerCLI", "--edgeLength", "4", "--childMesh", "none.vtu", "surface.vtp",
                      "never.vtu")
        self.assertEqual(refused.returncode, 1)
        self.assertIn("no child", refused.stderr)
        self.assertFalse(os.path.exists("never.vtu") or os.path.exists("none.vtu"))


class ElasticityTest(unittest.TestCase):
    """What the comparison stands on, against solutions known beforehand."""

    def setUp(self):
        self.points = np.array([[0.0, 0, 0], [2, 0, 0], [0, 3, 0], [0, 0, 4], [1, 1, 5], [4, 4, 1]])
        self.tetrahedra = np.array([[0, 1, 2, 3], [1, 2, 3, 4], [1, 5, 2, 4]])
        self.stiffness = stiffness(self.points, self.tetrahedra, 7.0, 0.3)

    def test_rigid_motions_need_no_force(self):
        moved = np.cross([0.1, -0.2, 0.3], self.points) + [4, 5, 6]
        np.testing.assert_allclose(self.stiffness @ moved.ravel(), 0, atol=1e-12)

    def test_energy_of_uniform_stretch(self):
        strain = 0.01
        stretched = self.points * [strain, -0.3 * strain, -0.3 * strain]  # stress E * strain along x alone
        volume = np.abs(np.linalg.det(self.points[self.tetrahedra[:, 1:]] - self.points[self.tetrahedra[:, :1]])) / 6
        energy = 0.5 * stretched.ravel() @ self.stiffness @ stretched.ravel()
        self.assertAlmostEqual(energy / (0.5 * 7 * strain**2 * volume.sum()), 1, 10)

    def test_condensation_is_the_schur_complement(self):
        free = unknowns(np.arange(3, 6)).ravel()
        matrix = self.stiffness[free][:, free]
        last, first = np.array([8, 1, 4]), np.array([0, 2, 3, 5, 6, 7])
        dense = matrix.toarray()
        expected = dense[np.ix_(last, last)] - dense[np.ix_(last, first)] @ np.linalg.solve(
            dense[np.ix_(first, first)], dense[np.ix_(first, last)])
        np.testing.assert_allclose(Cholesky(matrix, last).condensed(), expected, rtol=1e-10, atol=1e-10)
        right_side = np.arange(9.0)
        np.testing.assert_allclose(matrix @ Cholesky(matrix, last).solve(right_side), right_side, atol=1e-10)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
