"""The measures the example is judged by, on a mesh whose measures are known, and its reader of volumes."""
import gzip
import os
import sys
import tempfile
import unittest
from types import SimpleNamespace

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "workflow", "example"))
import measures  # noqa: E402
import meshfiles  # noqa: E402


def bcc_mesh(cells):
    """The canonical tetrahedra of a body-centred cubic lattice of cells^3 unit cubes."""
    ids, points = {}, []

    def vertex(position):
        if position not in ids:
            ids[position] = len(points)
            points.append(position)
        return ids[position]

    tetrahedra = []
    for cell in np.ndindex(cells, cells, cells):
        for axis in range(3):
            if cell[axis] + 1 == cells:
                continue
            u, v = (axis + 1) % 3, (axis + 2) % 3
            below, above = np.array(cell) + 0.5, np.array(cell) + 0.5
            above[axis] += 1
            ring = []
            for du, dv in ((0, 0), (1, 0), (1, 1), (0, 1)):
                corner = np.array(cell, float)
                corner[axis] += 1
                corner[u] += du
                corner[v] += dv
                ring.append(vertex(tuple(corner)))
            ends = vertex(tuple(below)), vertex(tuple(above))
            tetrahedra += [(ends[0], ends[1], ring[k], ring[(k + 1) % 4]) for k in range(4)]
    return SimpleNamespace(points=np.array(points), tetrahedra=np.array(tetrahedra),
                           tissue=np.ones(len(tetrahedra), int))


class CanonicalLatticeTest(unittest.TestCase):
    def setUp(self):
        self.mesh = bcc_mesh(4)

    def test_dihedral_angles_are_four_times_60_and_twice_90(self):
        angles = np.sort(measures.dihedral_angles(self.mesh), axis=1)
        np.testing.assert_allclose(angles, np.tile([60, 60, 60, 60, 90, 90], (len(angles), 1)), atol=1e-9)

    def test_edges_are_1_and_half_the_root_of_3(self):
        ratios = measures.edge_ratios(self.mesh, lambda middles: np.full(len(middles), 2.0))
        np.testing.assert_allclose(np.unique(ratios.round(9)), [np.sqrt(3) / 4, 0.5], atol=1e-9)

    def test_target_is_that_of_the_middle(self):
        corners = np.array([[0.0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]])
        one = SimpleNamespace(points=corners, tetrahedra=np.array([[0, 1, 2, 3]]))
        ratios = measures.edge_ratios(one, lambda middles: 1 + middles[:, 0])
        np.testing.assert_allclose(np.sort(ratios), np.sort([4 / 3, 4, 4, 32**0.5 / 3, 32**0.5 / 3, 32**0.5]))

    def test_inner_vertices_have_24_tetrahedra(self):
        valence = measures.valences(self.mesh)
        self.assertGreater(len(valence), 0)
        self.assertTrue(np.all(valence == 24))

    def test_vertices_between_tissues_are_not_inner(self):
        half = self.mesh.points[self.mesh.tetrahedra].mean(axis=1)[:, 0] < 2
        inner_before = len(measures.valences(self.mesh))
        self.mesh.tissue[half] = 2
        valence = measures.valences(self.mesh)
        self.assertLess(len(valence), inner_before)
        self.assertTrue(np.all(valence == 24))


class EulerNumberTest(unittest.TestCase):
    def test_of_maps(self):
        labels = np.zeros((9, 8, 12), int)
        labels[1:4, 1:4, 1:4] = 1
        labels[1:4, 1:4, 6:9] = 2
        labels[2, 2, 6:9] = 0  # a ring
        labels[5:8, 1:4, 1:4] = 3
        labels[6, 2, 2] = 4    # in a shell
        labels[5:9, 6:8, 0:12:2] = 5
        np.testing.assert_array_equal(measures.euler_numbers_of_map(labels), [0, 1, 0, 2, 1, 6])

    def test_of_meshes(self):
        mesh = bcc_mesh(4)
        one = measures.euler_numbers_of_mesh(mesh)
        np.testing.assert_array_equal(one, [0, 1])
        center = np.argmin(np.linalg.norm(mesh.points - 2, axis=1))
        mesh.tissue[np.any(mesh.tetrahedra == center, axis=1)] = 2  # a ball, and what is left of the block around it
        np.testing.assert_array_equal(measures.euler_numbers_of_mesh(mesh), [0, 2, 1])
        np.testing.assert_array_equal(measures.components_of_mesh(mesh), [0, 1, 1])

    def test_pieces_touch_across_faces_only(self):
        mesh = bcc_mesh(4)
        np.testing.assert_array_equal(measures.components_of_mesh(mesh), [0, 1])
        shared = [len(np.intersect1d(mesh.tetrahedra[0], other)) for other in mesh.tetrahedra]
        mesh.tissue[[0, shared.index(2)]] = 2  # two tetrahedra with an edge in common
        self.assertEqual(measures.components_of_mesh(mesh)[2], 2)
        mesh.tissue[:] = 1
        mesh.tissue[[0, shared.index(3)]] = 2  # two with a face in common
        self.assertEqual(measures.components_of_mesh(mesh)[2], 1)


class VolumeTest(unittest.TestCase):
    def write(self, encoding, space, values):
        data = values.astype(">f4").tobytes(order="F")
        header = (f"NRRD0004\n# a comment: with a colon\ntype: float\ndimension: 3\nspace: {space}\nsizes: 2 3 4\n"
                  "space directions: (0,2,0) (-1,0,0) (0,0,3)\nendian: big\n"
                  f"encoding: {encoding}\nspace origin: (10,20,30)\n\n")
        with open(self.file, "wb") as file:
            file.write(header.encode() + (gzip.compress(data) if encoding == "gzip" else data))

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.file = os.path.join(folder.name, "volume.nrrd")

    def test_values_and_places(self):
        values = np.arange(24.0).reshape(2, 3, 4)
        for encoding in ("gzip", "raw"):
            self.write(encoding, "left-posterior-superior", values)
            read, affine = meshfiles.read_nrrd(self.file)
            np.testing.assert_array_equal(read, values)
            np.testing.assert_allclose(affine @ [1, 2, 3, 1], [8, 22, 39, 1])

    def test_ras_is_turned_to_lps(self):
        self.write("raw", "right-anterior-superior", np.zeros((2, 3, 4)))
        _, affine = meshfiles.read_nrrd(self.file)
        np.testing.assert_allclose(affine @ [1, 2, 3, 1], [-8, -22, 39, 1])

    def test_interpolation_reproduces_linear_functions_and_holds_the_border(self):
        i, j, k = np.meshgrid(np.arange(5), np.arange(4), np.arange(3), indexing="ij")
        volume = 2.0 * i - 3.0 * j + 0.5 * k
        affine = np.array([[0, -1, 0, 10], [2, 0, 0, 20], [0, 0, 3, 30], [0, 0, 0, 1.0]])
        at = np.random.default_rng(7).uniform(0, 1, (50, 3)) * [4, 3, 2]
        places = at @ affine[:3, :3].T + affine[:3, 3]
        np.testing.assert_allclose(meshfiles.interpolated(volume, affine, places), at @ [2, -3, 0.5], atol=1e-12)
        beyond = affine @ [-5, 9, 1, 1]
        self.assertEqual(meshfiles.interpolated(volume, affine, beyond[:3]), volume[0, 3, 1])


if __name__ == "__main__":
    unittest.main()
