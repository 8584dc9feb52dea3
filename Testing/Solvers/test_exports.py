"""Tests that every exported file holds the mesh and its sets. usage: test_exports.py EXPORTS

EXPORTS is the folder with the results of export_example.py. The files are read by meshio, or by short readers written
from the definition of the format, and compared with the mesh itself.
"""
import os
import sys
import unittest

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, "workflow", "example"), os.path.join(ROOT, "Testing", "Python")]
from exported import READERS, is_second_side, meshio_read  # noqa: E402
from measures import TETRAHEDRON_FACES, signed_volumes  # noqa: E402
from meshfiles import cell_array, read_dataset, read_mesh  # noqa: E402
from sidecar import Sidecar  # noqa: E402

EXPORTS = sys.argv[1]
WITH_FACES = ("exo", "feb", "inp", "k", "mesh", "msh", "msh2", "xdmf")
WITH_BOTH_SIDES = ("exo", "feb", "inp", "k")
DIGITS = 1e-10  # relative tolerance: legacy VTK text has 11 digits
DECIMALS = 1e-12  # absolute tolerance, for numbers near 0 in columns of fixed width


def path(name):
    return os.path.join(EXPORTS, name)


def in_order(rows):
    return rows[np.lexsort(rows.T)]


def canonical(cells):
    """Returns the cells as sorted rows in sorted order, which are equal for equal sets of cells."""
    return in_order(np.sort(cells, axis=1))


def directed_edges(triangles):
    return np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])


def surface_area(points, tetrahedra):
    faces, uses = np.unique(np.sort(tetrahedra[:, TETRAHEDRON_FACES].reshape(-1, 3)), axis=0, return_counts=True)
    a, b, c = np.moveaxis(points[faces[uses == 1]], 1, 0)
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


def enclosed_volume(points, triangles):
    a, b, c = np.moveaxis(points[triangles], 1, 0)
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


class ExportsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.mesh = read_mesh(path("reference.vtu"))
        cls.mesh.constitutive = cell_array(read_dataset(path("reference.vtu")), "Constitutive")
        cls.volumes = signed_volumes(cls.mesh)
        cls.sets = Sidecar(path("mesh.inp")).sets
        cls.files = {extension: read(path("mesh." + extension)) for extension, read in READERS.items()}
        for file in cls.files.values():
            file.id = cls.ids_of(file.points)

    @classmethod
    def ids_of(cls, points):
        """Returns the id that each point has in the mesh, which is found by its position."""
        order, other = np.lexsort(np.round(cls.mesh.points, 9).T), np.lexsort(np.round(points, 9).T)
        ids = np.empty(len(points), int)
        ids[other] = order
        return ids

    def interface(self, kind):
        return {name: entry for name, entry in self.sets.items() if entry["type"] == "faces" and entry["kind"] == kind}

    def faces_between(self, group, beyond):
        """Maps each pair of groups (high, low) to the faces between them, as faces of the tetrahedra of the first group
        with outward normals. Outside the mesh, the group is `beyond`."""
        faces = self.mesh.tetrahedra[:, TETRAHEDRON_FACES].reshape(-1, 3)
        owner = np.repeat(np.arange(len(self.mesh.tetrahedra)), 4)
        order = np.lexsort(np.sort(faces, axis=1).T)
        faces, owner = faces[order], owner[order]
        twins = np.flatnonzero(np.all(np.sort(faces[1:], axis=1) == np.sort(faces[:-1], axis=1), axis=1))
        other = np.full(len(faces), -1)
        other[twins], other[twins + 1] = twins + 1, twins
        there = np.where(other < 0, beyond, group[owner[other]])
        here = group[owner]
        return {pair: faces[(here == pair[0]) & (there == pair[1])]
                for pair in {tuple(p) for p in np.column_stack([here, there])[here > there]}}

    def test_sidecars_are_the_same(self):
        with open(path("mesh.inp.names.json"), "rb") as file:
            expected = file.read()
        for extension in (*READERS, "ply", "stl"):
            with open(path(f"mesh.{extension}.names.json"), "rb") as file:
                self.assertEqual(file.read(), expected, extension)

    def test_points_and_tetrahedra_are_those_of_the_mesh(self):
        for extension, file in self.files.items():
            self.assertEqual(len(np.unique(file.id)), len(self.mesh.points), extension)
            np.testing.assert_allclose(file.points, self.mesh.points[file.id], rtol=DIGITS, atol=DECIMALS)
            if extension != "msh":
                np.testing.assert_array_equal(file.id[file.tetrahedra], self.mesh.tetrahedra)
            np.testing.assert_array_equal(canonical(file.id[file.tetrahedra]), canonical(self.mesh.tetrahedra))

    def test_element_sets_are_the_tetrahedra_they_name(self):
        group = {"tissue": self.mesh.tissue, "subMesh": self.mesh.submesh, "constitutive": self.mesh.constitutive}
        for extension, file in self.files.items():
            kinds = {self.sets[name]["kind"] for name in file.cells if name in self.sets}
            self.assertIn("tissue", kinds)
            self.assertEqual(kinds >= set(group), extension not in ("bdf", "mesh", "msh2"), extension)
            for kind in kinds & set(group):
                names = [name for name, entry in self.sets.items() if entry["kind"] == kind]
                self.assertEqual({self.sets[name]["ids"][0] for name in names}, set(np.unique(group[kind])))
                for name in names:
                    members = np.flatnonzero(group[kind] == self.sets[name]["ids"][0])
                    found = canonical(file.id[file.tetrahedra[file.cells[name]]])
                    np.testing.assert_array_equal(found, canonical(self.mesh.tetrahedra[members]), name)

    def test_volume_of_every_tissue_is_that_of_the_mesh(self):
        expected = np.bincount(self.mesh.tissue, weights=self.volumes)
        rounding = DIGITS * np.abs(self.mesh.points).max()
        for file in self.files.values():
            a, b, c, d = np.moveaxis(file.points[file.tetrahedra], 1, 0)
            volumes = np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6
            self.assertGreater(volumes.min(), 0)
            found = {name: volumes[file.cells[name]].sum() for name, entry in self.sets.items()
                     if entry["kind"] == "tissue"}
            for name, volume in found.items():
                swept = 3 ** .5 * rounding * surface_area(file.points, file.tetrahedra[file.cells[name]])
                self.assertAlmostEqual(volume, expected[self.sets[name]["ids"][0]], delta=swept, msg=name)

    def test_face_sets_are_the_faces_they_name(self):
        pairs = {"tissueInterface": self.faces_between(self.mesh.tissue, 0),
                 "subMeshInterface": {pair: faces for pair, faces in self.faces_between(self.mesh.submesh, -1).items()
                                      if pair[1] >= 0},
                 "outerBoundary": {(): self.faces_between(np.ones(len(self.mesh.tetrahedra), int), 0)[1, 0]}}
        for kind, expected in pairs.items():
            first = {tuple(entry["ids"]): name for name, entry in self.interface(kind).items()
                     if not is_second_side(entry)}
            self.assertEqual(set(first), set(expected))
            for extension in WITH_FACES:
                file = self.files[extension]
                for pair, faces in expected.items():
                    found = file.id[file.faces[first[pair]]]
                    np.testing.assert_array_equal(canonical(found), canonical(faces), first[pair])
                    if kind == "subMeshInterface" and extension not in WITH_BOTH_SIDES:
                        continue  # there a triangle has only one winding, which follows the tissues
                    np.testing.assert_array_equal(in_order(directed_edges(found)), in_order(directed_edges(faces)),
                                                  first[pair])

    def test_surfaces_close_around_every_tissue(self):
        for file in (self.files[extension] for extension in WITH_FACES):
            around = {}
            for name, entry in self.interface("tissueInterface").items():
                if is_second_side(entry):
                    continue
                behind, front = entry["ids"]
                around.setdefault(behind, []).append(file.faces[name])
                if front:
                    around.setdefault(front, []).append(file.faces[name][:, ::-1])
            for label, parts in around.items():
                edges = directed_edges(np.concatenate(parts))
                np.testing.assert_array_equal(np.unique(edges, axis=0), np.unique(edges[:, ::-1], axis=0))
                self.assertEqual(len(np.unique(edges, axis=0)), len(edges))

    def test_both_sides_of_an_interface_are_the_same_faces_and_nodes(self):
        for file in (self.files[extension] for extension in WITH_BOTH_SIDES):
            sides = {}
            for kind in ("tissueInterface", "subMeshInterface"):
                for name, entry in self.interface(kind).items():
                    sides.setdefault((kind, *sorted(entry["ids"])), []).append(name)
            two = [names for names in sides.values() if len(names) == 2]
            self.assertGreater(len(two), 500)
            for first, second in two:
                self.assertEqual(self.sets[first]["nodes"], self.sets[second]["nodes"])
                np.testing.assert_array_equal(canonical(file.faces[first]), canonical(file.faces[second]))
                self.assertFalse(set(map(tuple, directed_edges(file.faces[first][:1]))) &
                                 set(map(tuple, directed_edges(file.faces[second][:1]))))
                for name in (first, second):
                    np.testing.assert_array_equal(np.unique(file.faces[name]),
                                                  np.sort(file.nodes[self.sets[name]["nodes"]]))

    def test_surface_files_enclose_their_tissues(self):
        for extension, rounding in (("ply", 1e-10), ("stl", 1e-4)):
            whole = meshio_read(path("mesh." + extension))
            self.assertAlmostEqual(enclosed_volume(whole.points, whole.cells[0].data) / self.volumes.sum(), 1,
                                   delta=rounding)
            for name, entry in self.sets.items():
                if entry["kind"] != "tissue":
                    continue
                surface = meshio_read(path(f"mesh.{name}.{extension}"))
                triangles = surface.cells[0].data
                edges = directed_edges(triangles)
                np.testing.assert_array_equal(np.unique(edges, axis=0), np.unique(edges[:, ::-1], axis=0))
                expected = self.volumes[self.mesh.tissue == entry["ids"][0]].sum()
                self.assertAlmostEqual(enclosed_volume(surface.points - self.mesh.points.mean(axis=0), triangles) /
                                       expected, 1, delta=rounding, msg=name)

    def test_two_materials_reach_the_tissues(self):
        materials = Sidecar(path("mesh.inp")).material_of_tissues()
        self.assertEqual(set(materials), set(np.unique(self.mesh.tissue)))
        for label, material in materials.items():
            self.assertAlmostEqual(material["youngsModulus"], 0.006 if label % 2 == 0 else 0.003)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
