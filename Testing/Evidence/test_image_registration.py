"""Tests image_registration.py on a small body with a known deformation. usage: test_image_registration.py BIN OUTDIR"""
import os
import shutil
import sys
import unittest
from types import SimpleNamespace

import numpy as np
from scipy import ndimage

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import image_registration as evidence  # noqa: E402  # sets the path for the others
import hidden_truth  # noqa: E402
import lattice  # noqa: E402
import matching  # noqa: E402
import registration_page  # noqa: E402
import robust  # noqa: E402
from brain import blocks_of, closed, positions_of  # noqa: E402
from brain_meshes import Programs, body_of, distances_to_triangles, mesh_by, shape_of  # noqa: E402
from measures import signed_volumes  # noqa: E402
from parts import Parts  # noqa: E402

BIN, OUTDIR = sys.argv[1:3]
AFFINE = np.array([[1.0, 0, 0, -32], [0, -1, 0, 32], [0, 0, 1, -32], [0, 0, 0, 1]])
BINS = ((1, 4),)
SETTINGS = {"ours, ambient": [(2, 8)], "ours, surface alone": [(2, 8)], "CGAL Mesh_3": [(1, 8)],
            "CGAL surface + TetGen": [(1, 8)], "compressed lattice": [(7, 5)]}


def small_brain():
    """Returns an ellipsoid with a random texture."""
    x, y, z = np.meshgrid(*[np.arange(64.0) - 32] * 3, indexing="ij", sparse=True)
    mask = (x / 20) ** 2 + (y / 24) ** 2 + (z / 18) ** 2 < 1
    texture = ndimage.gaussian_filter(np.random.default_rng(0).standard_normal(mask.shape), 1.5)
    return SimpleNamespace(t1=(0.5 + 0.5 * texture / np.abs(texture).max()).astype(np.float32), mask=mask, body=mask,
                           affine=AFFINE)


class PartsTest(unittest.TestCase):
    def test_finished_parts_are_not_made_again(self):
        folder = os.path.join(OUTDIR, "parts")
        shutil.rmtree(folder, ignore_errors=True)
        parts, made = Parts(folder), []
        for value in (1, 2):
            self.assertEqual(parts.record("a", lambda value=value: made.append(value) or {"x": value}), {"x": 1})
            np.testing.assert_array_equal(parts.arrays("b", lambda value=value: {"y": np.full(3, value)})["y"], 1)
        self.assertEqual(made, [1])

    def test_a_part_that_fails_leaves_nothing(self):
        parts = Parts(os.path.join(OUTDIR, "parts"))
        with self.assertRaises(ZeroDivisionError):
            parts.record("c", lambda: 1 / 0)
        self.assertFalse(os.path.exists(parts.path("c.json")))


class MatchingTest(unittest.TestCase):
    def test_shifts_are_found_below_a_voxel_and_features_keep_apart(self):
        scene = small_brain()
        image = scene.t1 * scene.mask
        points = matching.features(image, scene.mask)
        self.assertGreater(len(points), 20)
        between = np.abs(points[:, None] - points[None]).max(axis=2) + 99 * np.eye(len(points), dtype=int)
        self.assertGreater(between.min(), matching.APART)
        shift = np.array([3.4, -5.3, 6.0])
        found = matching.match(image, ndimage.shift(image, shift, order=1), points)
        self.assertGreater(np.mean(np.linalg.norm(found - shift, axis=1) < 0.5), 0.95)

    def test_contrast_and_brightness_do_not_matter(self):
        scene = small_brain()
        points = matching.features(scene.t1, scene.mask)[:10]
        np.testing.assert_allclose(matching.match(scene.t1, 0.3 * scene.t1 + 2, points), 0, atol=0.05)


class TruthTest(unittest.TestCase):
    def test_states_between_increments_have_the_shift_asked_for(self):
        states = [np.array([[0.0, 0, 1], [0, 0, 4]]), np.array([[0.0, 0, 3], [0, 0, 8]])]
        np.testing.assert_allclose(hidden_truth.at_shift(states, 6), [[0, 0, 2], [0, 0, 6]])
        np.testing.assert_allclose(hidden_truth.at_shift(states, 2), [[0, 0, 0.5], [0, 0, 2]])
        with self.assertRaises(ValueError):
            hidden_truth.at_shift(states, 9)

    def test_an_image_moved_by_a_constant_is_the_image_elsewhere(self):
        scene = small_brain()
        displacement = np.zeros((*scene.mask.shape, 3)) + AFFINE[:3, :3] @ [2.0, 3, -1]
        nothing = np.zeros_like(scene.mask)
        moved = hidden_truth.deformed(scene.t1, scene.mask, nothing, displacement, AFFINE, 0)
        inside = ndimage.binary_erosion(scene.mask, iterations=2)
        expected = np.roll(scene.t1 * scene.mask, (2, 3, -1), axis=(0, 1, 2))
        np.testing.assert_allclose(moved[np.roll(inside, (2, 3, -1), axis=(0, 1, 2))],
                                   expected[np.roll(inside, (2, 3, -1), axis=(0, 1, 2))], atol=1e-5)

    def test_hexahedra_cover_the_body_but_for_the_cavity(self):
        scene = small_brain()
        cavity = hidden_truth.cavity_of(scene.body, AFFINE, radius=6, depth=6)
        mesh = hidden_truth.hexahedra(scene.body, cavity, AFFINE, 4)
        corners = mesh.nodes[mesh.elements]
        a, b, c = (corners[:, k] - corners[:, 0] for k in (1, 3, 4))
        np.testing.assert_allclose(np.einsum("ij,ij->i", np.cross(a, b), c), 64)  # positively oriented
        voxels = positions_of(np.argwhere(scene.body & ~ndimage.binary_dilation(cavity, iterations=7)), AFFINE)
        low = corners.min(axis=1)
        covered = {tuple(key) for key in np.rint((low - mesh.nodes.min(axis=0)) / 4).astype(int)}
        for key in np.floor((voxels - mesh.nodes.min(axis=0)) / 4).astype(int):
            self.assertIn(tuple(key), covered)

    @unittest.skipUnless(shutil.which("ccx"), "no CalculiX")
    def test_calculix_sags_a_body_that_is_held_below(self):
        scene = small_brain()
        cavity = hidden_truth.cavity_of(scene.body, AFFINE, radius=6, depth=6)
        mesh = hidden_truth.hexahedra(scene.body, cavity, AFFINE, 8)
        folder = Parts(os.path.join(OUTDIR, "calculix")).folder
        shifts = hidden_truth.brain_shifts(folder, mesh, (0.5, 1), largest_weight=4, increment=1)
        height = mesh.nodes @ hidden_truth.UPWARDS
        for shift, state in shifts.items():
            self.assertAlmostEqual(np.linalg.norm(state, axis=1).max(), shift)
            self.assertEqual(np.abs(state[height < height.min() + 0.19 * np.ptp(height)]).max(), 0)
            self.assertLess((state @ hidden_truth.UPWARDS)[height > height.max() - 8].max(), -0.5 * shift)


class MeshesTest(unittest.TestCase):
    def test_the_lattice_is_whole_and_comes_to_the_surface(self):
        points, tetrahedra = lattice.lattice_tetrahedra(np.zeros(3), np.full(3, 30.0), 10.0)
        volumes = signed_volumes(SimpleNamespace(points=points, tetrahedra=tetrahedra))
        np.testing.assert_allclose(volumes, 1000 / 12)
        scene = small_brain()
        body = body_of(scene.body, AFFINE)
        mesh = lattice.compressed(scene.body, AFFINE, body.surface, 6.0, 5.0)
        self.assertGreater(signed_volumes(mesh).min(), 0)
        self.assertLess(shape_of(mesh, body)["hausdorff95"], 2)
        self.assertAlmostEqual(signed_volumes(mesh).sum() / np.count_nonzero(scene.body), 1, delta=0.06)

    def test_distances_to_triangles_are_exact(self):
        corners = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0]])
        found = distances_to_triangles(np.array([[1.0, 1, 3], [-3, 0, 0], [4, 4, 0]]), corners, np.array([[0, 1, 2]]))
        np.testing.assert_allclose(found, [3, 3, np.sqrt(8)])

    def test_blocks_lie_where_the_body_does_and_closing_fills_fissures(self):
        scene = small_brain()
        blocks, affine = blocks_of(scene.body, AFFINE, 3)
        middle = [positions_of(np.argwhere(part), a).mean(axis=0) for part, a in ((blocks, affine), (scene.body, AFFINE))]
        np.testing.assert_allclose(*middle, atol=0.2)
        cleft = scene.mask.copy()
        cleft[31:33, :, 32:] = False
        self.assertLess(np.count_nonzero(scene.mask & ~closed(cleft, 4)), 0.1 * np.count_nonzero(scene.mask & ~cleft))


class RejectionTest(unittest.TestCase):
    def test_planted_outliers_go_and_the_rest_is_followed(self):
        scene = small_brain()
        mesh = lattice.compressed(scene.body, AFFINE, body_of(scene.body, AFFINE).surface, 8.0, 1.0)
        points = positions_of(matching.features(scene.t1, scene.mask, apart=2), AFFINE)
        true = 0.02 * points[:, [1, 2, 0]] + [3, 0, 1]
        given, planted = robust.with_outliers(true, 0.1, 5, 15)
        self.assertGreaterEqual(np.linalg.norm(given - true, axis=1)[planted].min(), 5)
        result = robust.register(mesh, points, given)
        self.assertGreaterEqual(1 - result.kept[planted].mean(), 0.9)
        self.assertEqual(np.count_nonzero(~result.kept), 10 * round(0.025 * len(points)))
        errors = np.linalg.norm(result.nodes - 0.02 * mesh.points[:, [1, 2, 0]] - [3, 0, 1], axis=1)
        self.assertLess(np.sqrt(np.mean(errors**2)), 0.3)


class ChoiceTest(unittest.TestCase):
    def test_of_a_meshers_meshes_at_the_distance_the_typical_one_is_chosen(self):
        def row(hausdorff, small, large, setting, mesher="a"):
            return {"mesher": mesher, "hausdorff": hausdorff, "errors": {"5": small, "10": large}, "setting": [setting]}
        rows = [row(8, 0.1, 0.2, 1), row(8, 0.24, 0.25, 2), row(8, 0.1, 0.6, 3), row(9, 0.1, 0.1, 4),
                row(8, 0.1, 0.1, 5, "b"), {"mesher": "a", "failed": "crash"}]
        near, far = evidence.chosen(rows, "a", (7, 8)), evidence.chosen(rows, "a", (8.5, 9))
        self.assertEqual(near["setting"], [2])
        np.testing.assert_allclose(near["errorsThere"], [0.15, 0.245, 0.35])
        self.assertEqual((far["setting"], len(far["errorsThere"])), ([4], 1))
        self.assertIsNone(evidence.chosen(rows, "a", (1, 2)))


class WholeTest(unittest.TestCase):
    def test_from_image_to_table(self):
        """Runs all parts except CalculiX, which is replaced by a smooth deformation of its nodes."""
        shutil.rmtree(os.path.join(OUTDIR, "whole"), ignore_errors=True)
        parts = Parts(os.path.join(OUTDIR, "whole"))
        scene = small_brain()
        scene.cavity = hidden_truth.cavity_of(scene.body, AFFINE, radius=5, depth=6)
        scene.hexahedra = hidden_truth.hexahedra(scene.body, scene.cavity, AFFINE, 4)
        height = (scene.hexahedra.nodes @ hidden_truth.UPWARDS + 20) / 40
        scene.shifts = {"4": -4 * np.outer(height**2, hidden_truth.UPWARDS)}
        scene.features = matching.features(scene.t1 * scene.body, scene.mask)
        scene.points = positions_of(scene.features, AFFINE)
        during = evidence.shifted(parts, scene, 4)
        matches = [evidence.matching_quality(scene, 4, during)]
        self.assertGreater(matches[0]["withinVoxel"], 0.85)
        body, run = body_of(scene.body, AFFINE), Programs(BIN, parts.folder)
        rows = evidence.swept(parts, scene, run, body, {4: during}, SETTINGS)
        table = evidence.compared(parts, scene, run, body, {4: during}, rows, BINS)
        for (_, mesher), row in table.items():
            self.assertIsNotNone(row, mesher)
            self.assertLess(row["dense"]["4"]["mean"], 0.25 * 4, mesher)
            self.assertAlmostEqual(row["dense"]["4"]["mean"], row["error"], delta=0.1)
        registration_page.write(parts, matches, rows, table, False,
                                lambda row: mesh_by(run, row["mesher"], body, row["setting"])[0])
        with open(parts.path("registration.md"), encoding="utf-8") as file:
            self.assertEqual(file.read().count("| 1 to 4 |"), 2 * len(SETTINGS))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
