"""Runs ./example.sh with the modules just built and judges what it leaves. usage: test_example.py BIN OUTDIR

The judgments use the files alone, and none of the project's own measures.
"""
import json
import os
import re
import subprocess
import sys
import unittest

import numpy as np
from vtk.util.numpy_support import vtk_to_numpy

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "workflow", "example"))
from measures import (TETRAHEDRON_FACES, dihedral_angles, edge_ratios, euler_numbers_of_map,  # noqa: E402
                      euler_numbers_of_mesh, signed_volumes, valences)
from meshfiles import cell_array, interpolated, read_dataset, read_mesh, read_nrrd  # noqa: E402

BIN, OUTDIR = sys.argv[1:3]


class ExampleTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        run = subprocess.run([os.path.join(ROOT, "example.sh"), OUTDIR], env={**os.environ, "SURGICALMESHER_BIN": BIN},
                             stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True)
        cls.output = run.stdout
        print(run.stdout)
        if run.returncode:
            raise AssertionError(f"example.sh ended with {run.returncode}")
        cls.mesh = read_mesh(os.path.join(OUTDIR, "mesh.vtu"))
        cls.labels, cls.affine = read_nrrd(os.path.join(OUTDIR, "prepared.nrrd"))

    def test_tetrahedra_are_positively_wound(self):
        self.assertGreater(signed_volumes(self.mesh).min(), 0)

    def test_faces_are_shared_by_at_most_two_and_points_are_used(self):
        faces = np.sort(self.mesh.tetrahedra[:, TETRAHEDRON_FACES].reshape(-1, 3), axis=1)
        self.assertLessEqual(np.unique(faces, axis=0, return_counts=True)[1].max(), 2)
        self.assertEqual(len(np.unique(self.mesh.tetrahedra)), len(self.mesh.points))

    def test_tissues_are_those_of_the_prepared_map(self):
        tissues = np.setdiff1d(self.labels, [0])
        np.testing.assert_array_equal(np.unique(self.mesh.tissue), tissues)
        surface = read_dataset(os.path.join(OUTDIR, "surface.vtp"))
        np.testing.assert_array_equal(np.setdiff1d(cell_array(surface, "BoundaryLabels"), [0]), tissues)

    def test_surface_closes_around_every_tissue(self):
        surface = read_dataset(os.path.join(OUTDIR, "surface.vtp"))
        ids = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        labels = cell_array(surface, "BoundaryLabels")
        # Directed edges of the triangles that bound a tissue, all seen from inside it: each is met once each way.
        side = np.concatenate([labels[:, 0], labels[:, 1]])
        triangles = np.concatenate([ids, ids[:, ::-1]])
        edges = np.concatenate([np.column_stack([side, triangles[:, [k, (k + 1) % 3]]]) for k in range(3)])
        self.assertTrue(np.all(np.unique(edges, axis=0, return_counts=True)[1] == 1))
        np.testing.assert_array_equal(np.unique(edges, axis=0), np.unique(edges[:, [0, 2, 1]], axis=0))

    def test_topology_is_that_of_the_prepared_map(self):
        np.testing.assert_array_equal(euler_numbers_of_mesh(self.mesh), euler_numbers_of_map(self.labels))

    def test_volumes_are_those_of_the_prepared_map(self):
        voxel = abs(np.linalg.det(self.affine[:3, :3]))
        expected = voxel * np.bincount(self.labels.ravel())
        found = np.bincount(self.mesh.tissue, weights=signed_volumes(self.mesh), minlength=len(expected))
        for voxels, share in ((200, 0.02), (1000, 0.01)):  # without offsets of boundaries it was 0.016
            large = np.flatnonzero(expected > voxels * voxel)
            large = large[large != 0]
            np.testing.assert_allclose(found[large], expected[large], rtol=share)
        self.assertAlmostEqual(found.sum() / expected[1:].sum(), 1, delta=0.02)

    def test_mesh_is_finer_at_the_target(self):
        centers = self.mesh.points[self.mesh.tetrahedra].mean(axis=1)
        distance = np.linalg.norm(centers - [0, 0, -10], axis=1)
        volumes = signed_volumes(self.mesh)
        self.assertLess(10 * np.median(volumes[distance < 10]), np.median(volumes[distance > 40]))
        self.assertTrue(np.any(self.mesh.submesh[distance < 10] > 0))
        self.assertTrue(np.all(self.mesh.submesh[distance > 40] == 0))

    def test_report_tells_of_every_stage(self):
        with open(os.path.join(OUTDIR, "report.json"), encoding="utf-8") as file:
            report = json.load(file)
        self.assertEqual(set(report), {"scale", "surface", "mesh", "seconds", "warnings"})
        self.assertEqual(set(report["seconds"]), {"scale", "surface", "mesh", "pictures"})
        whole = report["mesh"]["quality"]["whole"]
        angles = dihedral_angles(self.mesh)
        scale, affine = read_nrrd(os.path.join(OUTDIR, "scale.nrrd"))
        ratios = edge_ratios(self.mesh, lambda middles: interpolated(scale, affine, middles))
        self.assertEqual(whole["tetrahedra"], len(self.mesh.tetrahedra))
        self.assertAlmostEqual(whole["dihedral"]["minimum"], angles.min(), 3)
        self.assertAlmostEqual(whole["dihedral"]["maximum"], angles.max(), 3)
        self.assertAlmostEqual(whole["minimumDihedral"]["mean"], angles.min(axis=1).mean(), 3)
        self.assertAlmostEqual(whole["edgeOverTarget"]["mean"], ratios.mean(), 3)
        self.assertAlmostEqual(whole["edgesNearTarget"], np.mean((ratios >= 0.7) & (ratios <= 1.4)), 3)
        self.assertAlmostEqual(whole["valence"]["mean"], valences(self.mesh).mean(), 3)

    def test_table_tells_of_counts_topology_and_estimate(self):
        surface = read_dataset(os.path.join(OUTDIR, "surface.vtp"))
        self.assertRegex(self.output, r"tissues of wrong topology +0 \(beside the prepared map\)\n")
        for name, number in (("triangles", surface.GetNumberOfPolys()), ("tetrahedra", len(self.mesh.tetrahedra))):
            row = re.search(rf"^{name} +([\d,]+) \(estimated ([\d,]+),", self.output, re.M)
            found, estimated = (int(text.replace(",", "")) for text in row.groups())
            self.assertEqual(found, number)
            self.assertLess(max(estimated / number, number / estimated), 1.5, name)

    def test_pictures_show_something(self):
        from matplotlib.image import imread
        for name in ("surface", "tetrahedra", "scale", "evolution", "histograms"):
            picture = imread(os.path.join(OUTDIR, name + ".png"))[..., :3]
            self.assertGreater(min(picture.shape[:2]), 500, name)
            ink = np.any(picture < 0.9, axis=-1)
            self.assertGreater(ink.mean(), 0.05, name)
            for border in (ink[:3], ink[-3:], ink[:, :3], ink[:, -3:]):
                self.assertFalse(border.any(), f"{name} is cut off")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
