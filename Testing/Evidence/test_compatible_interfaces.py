"""Tests the ways of compatible_interfaces.py on two halves of a ball and a rod of a third tissue through it.

usage: test_compatible_interfaces.py BIN OUTDIR
"""
import os
import shutil
import sys
import unittest
from types import SimpleNamespace

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import compatible_interfaces as evidence  # noqa: E402  # sets the path for the others
import document  # noqa: E402
from brain_meshes import Programs  # noqa: E402
from lattice import lattice_tetrahedra  # noqa: E402
from parts import Parts  # noqa: E402

BIN, OUTDIR = sys.argv[1:3]
AFFINE = np.array([[1.0, 0, 0, -15], [0, -1, 0, 15], [0, 0, 1, -15], [0, 0, 0, 1]])


def three_tissues():
    x, y, z = np.meshgrid(*[np.arange(30) - 14.5] * 3, indexing="ij", sparse=True)
    labels = np.where(x + 0 * (y + z) < 0, 1, 2)
    labels[(x**2 + y**2 + 0 * z) < 16] = 3
    labels[x**2 + y**2 + z**2 > 144] = 0
    return labels


class WaysTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(os.path.join(OUTDIR, "ways"), ignore_errors=True)
        run = Programs(BIN, Parts(os.path.join(OUTDIR, "ways")).folder)
        given = evidence.given_to(run, three_tissues(), AFFINE, 3.0)
        cls.given, cls.rows = given, {name: evidence.measured(name, run, given) for name in evidence.ways_of(run)}

    def test_ours_and_the_background_have_every_tissue_right(self):
        for name in ("ours", "background material, ours"):
            row = self.rows[name]
            self.assertEqual(row.get("failed", ""), "")
            self.assertEqual((row["sharedOnce"], row["wrong"]) if name == "ours" else row["wrong"],
                             (1, []) if name == "ours" else [])
            self.assertGreater(row["smallestDihedral"], 25)
        self.assertLess(self.rows["ours"]["volumeWorst"], 0.05)
        self.assertGreater(self.rows["background material, ours"]["volumeWorst"], 0.05, "the coat takes volume")
        self.assertLess(self.rows["background material, ours"]["sharedOnce"], 0.1, "tissues do not touch")

    def test_labels_put_on_a_lattice_have_its_angles_and_its_steps(self):
        row = self.rows["label transfer"]
        self.assertAlmostEqual(row["smallestDihedral"], 60, places=5)
        self.assertGreater(row["jiggle"], 2 * self.rows["ours"]["jiggle"])
        self.assertEqual(row["sharedOnce"], 1)

    def test_every_way_has_a_row_whether_it_succeeds_or_not(self):
        table = evidence.table_of(list(self.rows.values()))
        self.assertEqual(table.count("\n"), 1 + len(evidence.WAYS), "all but Cleaver, whose program is not here")
        for name in ("CGAL Mesh_3", "background material, Mesh_3 and TetGen", "offset and booleans"):
            self.assertNotIn("failed", self.rows[name])

    def test_booleans_have_every_tissue_but_leave_gaps_between_smoothed_surfaces(self):
        row = self.rows["offset and booleans"]
        self.assertEqual(row["wrong"], [])
        self.assertGreater(row["sharedOnce"], 0.3)
        self.assertLess(row["volumeWorst"], 0.2)
        self.assertLess(row["smallestDihedral"], self.rows["ours"]["smallestDihedral"])


class MeasuresTest(unittest.TestCase):
    def test_a_lattice_of_regular_cells_is_orthogonal(self):
        points, tetrahedra = lattice_tetrahedra(np.zeros(3), np.full(3, 4.0), 1.0)
        mesh = SimpleNamespace(points=points, tetrahedra=tetrahedra, tissue=np.ones(len(tetrahedra), int))
        self.assertLess(evidence.orthogonality(mesh).max(), 1e-4)
        mesh.points = points * [1, 1, 3]
        self.assertGreater(evidence.orthogonality(mesh).max(), 20)

    def test_radius_ratio_is_one_for_regular_tetrahedra_only(self):
        points = np.array([[1.0, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
        mesh = SimpleNamespace(points=points, tetrahedra=np.array([[0, 1, 2, 3]]))
        np.testing.assert_allclose(evidence.radius_ratios(mesh), 1)
        mesh.points = points * [1, 1, 0.2]
        self.assertLess(evidence.radius_ratios(mesh)[0], 0.5)

    def test_jiggle_is_the_angle_between_neighbours_whichever_way_they_turn(self):
        angle = np.radians(30)
        corners = np.array([[0.0, 0, 0], [1, 0, 0], [0.5, 1, 0], [0.5, -np.cos(angle), np.sin(angle)]])
        for second in ([0, 1, 3], [1, 0, 3]):
            found = evidence.jiggle(corners, np.array([[0, 1, 2], second]), np.array([[1, 2], [2, 1]]))
            self.assertAlmostEqual(found, 30)

    def test_coats_keep_tissues_apart(self):
        coat = evidence.coated(three_tissues())
        for axis in range(3):
            a, b = np.moveaxis(coat, axis, 0)[1:], np.moveaxis(coat, axis, 0)[:-1]
            self.assertFalse(np.any((a != b) & (a > 0) & (b > 0)))

    def test_marching_cubes_share_the_sheet_between_two_tissues(self):
        labels = np.zeros((9, 8, 8), int)
        labels[1:4, 1:7, 1:7], labels[4:8, 1:7, 1:7] = 1, 2
        corners, triangles, sides = evidence.marching_cubes(labels, np.eye(4))
        between = np.all(sides > 0, axis=1)
        self.assertEqual({tuple(sorted(pair)) for pair in sides[between]}, {(1, 2)})
        self.assertGreater(np.count_nonzero(between), 30)
        a, b, c = np.moveaxis(corners[triangles[sides[:, 0] == 1]], 1, 0)
        outward = np.cross(b - a, c - a)
        self.assertTrue(np.all(np.sum(outward * ((a + b + c) / 3 - [2, 3.5, 3.5]), axis=1) > 0))


class DocumentTest(unittest.TestCase):
    def test_tables_replace_what_is_between_their_marks_and_nothing_else(self):
        page = "a\n<!-- x -->\nold\n<!-- end of x -->\nb\n"
        self.assertEqual(document.with_tables(page, {"x": "new\n"}), "a\n<!-- x -->\nnew\n<!-- end of x -->\nb\n")
        with self.assertRaises(ValueError):
            document.with_tables(page, {"y": "new\n"})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
