"""Tests that a mesh for SimNIBS has the tags, surfaces and frame that it expects. usage: test_simnibs.py MODULES FOLDER

SimNIBS is not in Debian; `surfaces` follows reconstruct_unique_surface in its mesh_io.py.
"""
import os
import shutil
import subprocess
import sys
import unittest

import numpy as np
import vtk
from vtk.util import numpy_support

from exported import blocks, by_number, meshio_read

MODULES, FOLDER = sys.argv[1:3]
RANKED = (1, 2, 9, 3, 4, 8, 7, 6, 10, 5)  # a face between two tissues belongs to the one that comes first here
RADII = {5: 20, 4: 17, 3: 14, 2: 11, 1: 7}  # of skin, bone, fluid, gray and white matter (mm)


def path(name):
    return os.path.join(FOLDER, name)


def run_module(*arguments):
    return subprocess.run([os.path.join(MODULES, arguments[0]), *arguments[1:]], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, cwd=FOLDER)


def head(name, shift=0):
    """Writes a label map of nested balls, the inner ones off the centre, and an eye that protrudes from the skin."""
    size, spacing = 44, 1.0
    z, y, x = np.mgrid[:size, :size, :size] - (size - 1) / 2
    labels = np.zeros((size,) * 3, np.int16)
    for label, radius in RADII.items():
        labels[x ** 2 + (y - (20 - radius) / 4) ** 2 + z ** 2 < radius ** 2] = label
    labels[(x - 8) ** 2 + (y - 17) ** 2 + z ** 2 < 9] = 6
    labels[labels > 0] += shift
    image = vtk.vtkImageData()
    image.SetDimensions(size, size, size)
    image.SetSpacing(spacing, spacing, spacing)
    image.SetOrigin(5, 100, -20)
    image.GetPointData().SetScalars(numpy_support.numpy_to_vtk(labels.ravel(), deep=True))
    writer = vtk.vtkMetaImageWriter()
    writer.SetInputData(image)
    writer.SetFileName(path(name))
    writer.SetCompression(False)
    writer.Write()


def surfaces(tetrahedra, tags):
    """Maps the sorted nodes of each face on the outside or between two tags to the tag that it belongs to, and to its
    tetrahedron with that tag."""
    owners = {}
    for corners in ([0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]):
        for t, face in enumerate(np.sort(tetrahedra[:, corners], axis=1).tolist()):
            owners.setdefault(tuple(face), []).append(t)
    found = {}
    for face, both in owners.items():
        if len(both) == 1 or tags[both[0]] != tags[both[1]]:
            first = min(both, key=lambda t: RANKED.index(tags[t]))
            found[face] = (tags[first], first)
    return found


class SimnibsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(FOLDER, ignore_errors=True)
        os.makedirs(FOLDER)
        head("head.mha")
        done = run_module("surgicalmesher", "mesh", "--targetPoint", "27,120,2", "--minimumEdgeLength", "3",
                          "--maximumEdgeLength", "4", "--export", "head.simnibs.msh", "head.mha", "out")
        assert done.returncode == 0, done.stderr
        cls.theirs = meshio_read(path("out/head.simnibs.msh"), file_format="gmsh")
        cls.tetrahedra, cls.tags = blocks(cls.theirs, "tetra", cls.theirs.cell_data["gmsh:physical"])
        cls.triangles, cls.face_tags = blocks(cls.theirs, "triangle", cls.theirs.cell_data["gmsh:physical"])

    def test_tags_of_tetrahedra_are_labels(self):
        self.assertEqual(set(by_number(self.tags)), {1, 2, 3, 4, 5, 6})
        places = self.theirs.points[self.tetrahedra]
        volumes = np.einsum("ij,ij->i", np.cross(places[:, 1] - places[:, 0], places[:, 2] - places[:, 0]),
                            places[:, 3] - places[:, 0]) / 6
        self.assertGreater(volumes.min(), 0)
        inner = volumes[self.tags == 1].sum()
        self.assertAlmostEqual(inner / (4 / 3 * np.pi * RADII[1] ** 3), 1, delta=0.1)

    def test_coordinates_are_ras(self):
        np.testing.assert_allclose(self.theirs.points.mean(axis=0), (-26.5, -121.5, 1.5), atol=1.5)

    def test_every_boundary_is_there_once_wound_out_of_its_tissue(self):
        expected = surfaces(self.tetrahedra, self.tags)
        faces = [tuple(face) for face in np.sort(self.triangles, axis=1).tolist()]
        self.assertEqual(len(set(faces)), len(faces))
        self.assertEqual(set(faces), set(expected))
        places = self.theirs.points
        for face, triangle, tag in zip(faces, self.triangles, self.face_tags):
            label, tetrahedron = expected[face]
            self.assertEqual(tag, 1000 + label)
            a, b, c = places[triangle]
            centre = places[self.tetrahedra[tetrahedron]].mean(axis=0)
            self.assertGreater(np.dot(np.cross(b - a, c - a), a - centre), 0)
        self.assertEqual(set(self.face_tags), {1001, 1002, 1003, 1004, 1005, 1006})

    def test_labels_of_electrodes_are_refused(self):
        head("electrodes.mha", 96)
        done = run_module("surgicalmesher", "mesh", "--targetPoint", "27,120,2", "--minimumEdgeLength", "3",
                          "--maximumEdgeLength", "4", "--export", "head.simnibs.msh", "electrodes.mha", "refused")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
        self.assertIn("label 10", done.stderr)
        self.assertFalse(os.path.exists(path("refused/head.simnibs.msh")))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
