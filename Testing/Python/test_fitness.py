"""The measures of fidelity and registration, on meshes and deformations where they are known."""
import os
import sys
import unittest
from types import SimpleNamespace

import numpy as np
from scipy import sparse

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.append(os.path.join(ROOT, "Testing", "Benchmarks"))
import fitness  # noqa: E402
from elasticity import Cholesky  # noqa: E402
from fidelity import around, boundary_of_map, boundary_of_mesh, hausdorff, hausdorff_by_tissue  # noqa: E402
from measures import signed_volumes  # noqa: E402
from registration import (condition_numbers, conjugate_gradients, interpolation, nearest_tetrahedra,  # noqa: E402
                          registered, system)

KUHN = ((0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2))


def mesh_of(labels, spacing=1.0):
    """Six tetrahedra per voxel that is not 0; voxel centres are at spacing * ijk."""
    size = np.array(labels.shape) + 1
    tetrahedra, tissue = [], []
    for voxel in np.argwhere(labels):
        for axes in KUHN:
            corners = [voxel]
            for axis in axes:
                corners.append(corners[-1] + np.eye(3, dtype=int)[axis])
            ids = [int(np.ravel_multi_index(tuple(corner), size)) for corner in corners]
            tetrahedra.append(ids if (axes[0] + 1) % 3 == axes[1] else [ids[0], ids[2], ids[1], ids[3]])
            tissue.append(labels[tuple(voxel)])
    used, tetrahedra = np.unique(tetrahedra, return_inverse=True)
    points = np.stack(np.unravel_index(used, size), axis=1) - 0.5
    return SimpleNamespace(points=spacing * points, tetrahedra=tetrahedra.reshape(-1, 4), tissue=np.array(tissue))


class EqualDistanceTest(unittest.TestCase):
    ROWS = [{"mesher": "CGAL Mesh_3", "minimumEdgeLength": 1, "hausdorff95": d, "hausdorffTissuesMean": 2 * d,
             "iterations": 100 / d, "scaledCondition": 1000 / d**2} for d in (1, 2, 4)]

    def test_measures_between_meshes_follow_their_power_law(self):
        for wanted in (1, 1.5, 2.8, 4):
            self.assertAlmostEqual(fitness.at_distance(self.ROWS, "hausdorff95", "iterations", wanted), 100 / wanted)
        for beyond in (0.9, 4.1):
            self.assertTrue(np.isnan(fitness.at_distance(self.ROWS, "hausdorff95", "iterations", beyond)))

    def test_the_table_has_ratios_where_there_is_something_to_compare(self):
        ours = {"mesher": "SurgicalMesher", "minimumEdgeLength": 1, "hausdorff95": 2, "hausdorffTissuesMean": 1,
                "iterations": 100, "scaledCondition": 125}
        row = fitness.table_at_equal_distance([ours, *self.ROWS]).splitlines()[-1]
        self.assertEqual(row, "| 1..8 | 2.00 | 2.00 | 0.50 | 1.00 | - | - |")


def two_tissues():
    labels = np.zeros((6, 4, 4), int)
    labels[:3, :3, :3], labels[3:5, :3, :3] = 1, 2
    return labels


class FidelityTest(unittest.TestCase):
    def test_voxels_as_tetrahedra_are_where_the_map_is(self):
        labels = two_tissues()
        spacing = 0.25
        from_map, from_mesh = boundary_of_map(labels, np.eye(4)), boundary_of_mesh(mesh_of(labels), spacing)
        self.assertLess(hausdorff(from_map.points, from_mesh.points), 0.71)  # from a face's corner to its centre
        far_from_mesh = max(hausdorff_by_tissue(from_map, from_mesh, [1, 2]).values())
        self.assertLess(far_from_mesh, 0.71)

    def test_a_moved_mesh_is_as_far_as_it_moved(self):
        labels = two_tissues()
        from_map = boundary_of_map(labels, np.diag([1, 1, 1, 1.0]))
        mesh = mesh_of(labels)
        mesh.points[:, 0] += 3
        distances = hausdorff_by_tissue(from_map, boundary_of_mesh(mesh, 0.25), [1, 2])
        for distance in distances.values():
            self.assertGreater(distance, 3 - 0.01)
            self.assertLess(distance, 3.2)

    def test_a_missing_tissue_is_infinitely_far(self):
        labels = two_tissues()
        distances = hausdorff_by_tissue(boundary_of_map(labels, np.eye(4)),
                                        boundary_of_mesh(mesh_of(np.where(labels == 2, 0, labels)), 0.5), [1, 2])
        self.assertTrue(np.isfinite(distances[1]))
        self.assertEqual(distances[2], np.inf)

    def test_boundaries_have_the_labels_of_both_sides(self):
        labels = two_tissues()
        from_map = boundary_of_map(labels, np.eye(4))
        self.assertEqual(len(from_map.points), 9 + 2 * 9 + 4 * 9 + 4 * 6)
        middle = np.all(np.sort(from_map.sides, axis=1) == [1, 2], axis=1)
        np.testing.assert_array_equal(from_map.points[middle][:, 0], 2.5)
        outside = around(boundary_of_mesh(mesh_of(labels), 0.5), 0)
        self.assertAlmostEqual(outside[:, 0].min(), -0.5)
        self.assertAlmostEqual(outside[:, 0].max(), 4.5)

    def test_share_leaves_out_the_farthest(self):
        line = np.column_stack([np.arange(100.0), np.zeros(100), np.zeros(100)])
        bent = line + [[0, 0, 0]]
        bent[-1, 1] = 50
        self.assertAlmostEqual(hausdorff(line, bent), 50)
        self.assertLess(hausdorff(line, bent, 0.95), 1)


class RegistrationTest(unittest.TestCase):
    def setUp(self):
        self.mesh = mesh_of(np.ones((4, 4, 4), int))
        self.positions = np.random.default_rng(1).uniform(-0.4, 3.4, (60, 3))

    def test_linear_fields_are_interpolated_exactly_inside_and_outside(self):
        gradient = np.array([[1.0, 2, 3], [0, -1, 4], [2, 2, 0]])
        positions = np.concatenate([self.positions, [[-2.0, 1, 1], [5, 5, 5]]])
        h = interpolation(self.mesh.points, self.mesh.tetrahedra, positions)
        np.testing.assert_allclose(h @ (self.mesh.points @ gradient + 1).ravel(), (positions @ gradient + 1).ravel(),
                                   atol=1e-9)

    def test_positions_are_found_in_their_tetrahedra(self):
        centres = self.mesh.points[self.mesh.tetrahedra].mean(axis=1)
        np.testing.assert_array_equal(nearest_tetrahedra(self.mesh.points, self.mesh.tetrahedra, centres),
                                      np.arange(len(centres)))

    def test_rigid_motion_is_registered_at_once(self):
        equations = system(self.mesh, self.positions, 0.1, 0.45)
        moved = np.cross([0.1, 0.2, -0.1], self.positions) + [1, 2, 3]
        nodes = registered(equations, Cholesky(equations.A), moved, iterations=1)
        expected = np.cross([0.1, 0.2, -0.1], self.mesh.points) + [1, 2, 3]
        np.testing.assert_allclose(nodes, expected.ravel(), atol=1e-8)

    def test_repetition_brings_the_points_closer(self):
        equations = system(self.mesh, self.positions, 5, 0.45)
        factor = Cholesky(equations.A)
        given = np.sin(self.positions)
        errors = [np.linalg.norm((equations.H @ registered(equations, factor, given, n)).reshape(-1, 3) - given)
                  for n in (1, 2, 10)]
        self.assertGreater(errors[0], errors[1])
        self.assertGreater(errors[1], errors[2])

    def test_condition_numbers_are_those_of_dense_matrices(self):
        equations = system(self.mesh, self.positions, 0.1, 0.45)
        dense = equations.A.toarray()
        root = np.sqrt(np.diag(dense))
        plain, scaled = condition_numbers(equations.A, Cholesky(equations.A))
        self.assertAlmostEqual(plain / np.linalg.cond(dense), 1, delta=0.05)
        self.assertAlmostEqual(scaled / np.linalg.cond(dense / np.outer(root, root)), 1, delta=0.05)

    def test_conjugate_gradients_solve(self):
        matrix = sparse.diags([-1.0, 2.5, -1], [-1, 0, 1], (50, 50)).tocsr()
        right_side = np.arange(50.0)
        solution, iterations = conjugate_gradients(matrix, right_side)
        np.testing.assert_allclose(matrix @ solution, right_side, atol=1e-5)
        self.assertLessEqual(iterations, 50)


class FitnessTest(unittest.TestCase):
    def test_only_what_hangs_on_by_faces_is_kept(self):
        labels = np.zeros((4, 3, 2), int)
        labels[:2, :2, :2] = 1
        labels[2, 2, 1] = 2  # touches along an edge of a voxel
        labels[3, 0, 0] = 3
        body = fitness.largest_body(mesh_of(labels))
        self.assertEqual(set(body.tissue), {1})
        np.testing.assert_array_equal(np.unique(body.tetrahedra), np.arange(len(body.points)))
        self.assertAlmostEqual(signed_volumes(body).sum(), 8)

    def test_known_deformation_is_held_below_and_as_large_as_asked_for(self):
        labels = np.zeros((30, 30, 40), int)
        labels[3:27, 3:27, 3:37] = 5
        affine = np.diag([-1.0, 1, 2, 1])
        displacement, lattice, filled = fitness.synthetic_deformation(labels, affine)
        length = np.linalg.norm(displacement, axis=-1)
        self.assertAlmostEqual(length.max(), fitness.LARGEST_DISPLACEMENT)
        self.assertEqual(length[:, :, np.flatnonzero(filled.any(axis=(0, 1)))[0]].max(), 0)
        highest = np.unravel_index(length.argmax(), length.shape)
        self.assertGreater(displacement[highest][1], 0.9 * fitness.LARGEST_DISPLACEMENT)
        data = fitness.registration_data(np.repeat(labels, 2, axis=0), affine)
        self.assertEqual(len(data.points) + len(data.check_points),
                         fitness.REGISTRATION_POINTS + fitness.CHECK_POINTS)

    def test_table_has_a_row_for_meshes_and_for_failures(self):
        rows = [{"mesher": "CGAL Mesh_3", "minimumEdgeLength": 2.0, "failed": "Mesh3Driver ended with 3"}]
        self.assertIn("| CGAL Mesh_3 | 2..16 | Mesh3Driver ended with 3 |", fitness.table_of(rows))


if __name__ == "__main__":
    unittest.main()
