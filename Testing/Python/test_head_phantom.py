"""workflow/head-phantom on the base of a head built in code, of the phantom's labels and in its frame.

usage: test_head_phantom.py BIN OUTDIR
"""
import json
import os
import shutil
import subprocess
import sys
import unittest

import numpy as np
from vtk.util.numpy_support import vtk_to_numpy

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "workflow", "example"))
from maps import write_nrrd  # noqa: E402
from measures import (TETRAHEDRON_FACES, dihedral_angles, euler_numbers_of_map, euler_numbers_of_mesh,  # noqa: E402
                      signed_volumes, unique_edges)
from meshfiles import cell_array, read_dataset, read_mesh, read_nrrd  # noqa: E402

BIN, OUTDIR = sys.argv[1:3]
PHANTOM = os.path.join(ROOT, "workflow", "head-phantom")
SPACING = 3.0
CSF, GREY, WHITE, FAT, MUSCLE, SKIN, SKULL, CONNECTIVE = 1, 2, 3, 4, 5, 6, 7, 9
NERVES = {20: "left-optic-nerve", 21: "right-optic-nerve", 22: "left-orbital-nerve", 23: "right-orbital-nerve"}
NERVE_RADIUS = 2.5


def run(*arguments):
    return subprocess.run([os.path.join(PHANTOM, "head-phantom.sh"), *arguments],
                          env={**os.environ, "SURGICALMESHER_BIN": BIN}, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)


def points_of(file):
    with open(file, encoding="utf-8") as stream:
        return np.array([p["position"] for p in json.load(stream)["markups"][0]["controlPoints"]], float)


def distance_to(chain, positions):
    """Of positions (n, 3) to a polyline."""
    best = np.full(len(positions), np.inf)
    for a, b in zip(chain[:-1], chain[1:]):
        t = np.clip((positions - a) @ (b - a) / ((b - a) @ (b - a)), 0, 1)
        best = np.minimum(best, np.linalg.norm(positions - a - t[:, None] * (b - a), axis=1))
    return best


def base_of_a_head():
    """Labels and T1 of skin, fat (bright), bone (dark) and CSF around a brain, and nerves dark in fat, bright elsewhere;
    their affine to LPS."""
    size, origin = (25, 42, 23), np.array([-36, -92, -66])
    affine = np.diag([SPACING, SPACING, SPACING, 1.0])
    affine[:3, 3] = origin
    at = origin + SPACING * np.stack(np.indices(size), axis=-1)
    inner = np.minimum(at - origin, origin + SPACING * (np.array(size) - 1) - at).min(axis=-1)  # to the border
    x, y, z = np.moveaxis(at, -1, 0)
    labels = np.select([inner < 2, inner < 7, (y < -60) & (x > 0), (y < -60) & (z < -50), y < -30, (z < -36) | (y < -22),
                        z < -17, z < -8], [0, SKIN, MUSCLE, CONNECTIVE, FAT, SKULL, CSF, GREY], WHITE)
    t1 = np.array([0, 40, 110, 150, 250, 90, 130, 20, 0, 90])[labels]
    for label, name in NERVES.items():
        chain = points_of(os.path.join(PHANTOM, name + ".mrk.json"))
        near = distance_to(chain, at.reshape(-1, 3)).reshape(size) < NERVE_RADIUS
        t1[near] = 200 if label < 22 else 60
    return labels.astype(np.uint16), t1.astype(np.uint16), affine


class HeadPhantomTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(OUTDIR, ignore_errors=True)
        os.makedirs(OUTDIR)
        os.chdir(OUTDIR)
        labels, t1, affine = base_of_a_head()
        write_nrrd("map.nrrd", labels, affine)
        write_nrrd("t1.nrrd", t1, affine)
        cls.process = run("out", "map.nrrd", "t1.nrrd")

    def test_everything_is_there(self):
        self.assertEqual(self.process.returncode, 0, self.process.stderr)
        for file in ("mesh.vtu", "parent.vtu", "child.vtu", "nerves.vtp", "sheaths.vtp", "head.inp", "head.feb",
                     "head.msh", "report.json", "critical_tissues.png"):
            self.assertTrue(os.path.getsize(os.path.join("out", file)), file)
        self.assertFalse([name for name in os.listdir("out") if name.startswith((".", "with-"))])

    def test_tissues_are_those_of_the_map(self):
        mesh = read_mesh("out/mesh.vtu")
        self.assertGreater(signed_volumes(mesh).min(), 0)
        self.assertGreater(dihedral_angles(mesh).min(), 25)
        prepared, _ = read_nrrd("out/prepared.nrrd")
        np.testing.assert_array_equal(euler_numbers_of_mesh(mesh), euler_numbers_of_map(prepared))
        self.assertLessEqual(set(NERVES), set(np.unique(mesh.tissue)))

    def test_nerves_are_edges_and_sheaths_are_faces_of_the_tetrahedra(self):
        mesh = read_mesh("out/mesh.vtu")
        edges = {tuple(edge) for edge in unique_edges(mesh.tetrahedra)}
        lines = read_dataset("out/nerves.vtp")
        ids = vtk_to_numpy(lines.GetPointData().GetArray("VolumePointId"))
        chains = [ids[[lines.GetCell(n).GetPointId(k) for k in range(lines.GetCell(n).GetNumberOfPoints())]]
                  for n in range(lines.GetNumberOfCells())]
        links = np.sort(np.concatenate([np.stack([chain[:-1], chain[1:]], axis=1) for chain in chains]), axis=1)
        self.assertGreater(len(links), 20)
        self.assertLessEqual({tuple(link) for link in links}, edges)
        faces = np.sort(mesh.tetrahedra[:, TETRAHEDRON_FACES].reshape(-1, 3), axis=1)
        of_nerves = {tuple(face) for face in faces[np.repeat(np.isin(mesh.tissue, list(NERVES)), 4)]}
        sheaths = read_dataset("out/sheaths.vtp")
        ids = vtk_to_numpy(sheaths.GetPointData().GetArray("VolumePointId"))
        triangles = np.sort(ids[vtk_to_numpy(sheaths.GetPolys().GetConnectivityArray()).reshape(-1, 3)], axis=1)
        self.assertLessEqual({tuple(triangle) for triangle in triangles}, of_nerves)
        self.assertEqual(set(cell_array(sheaths, "TissueLabel")), set(NERVES))

    def test_only_what_is_away_from_the_path_is_held_still(self):
        mesh = read_mesh("out/mesh.vtu")
        still = cell_array(read_dataset("out/mesh.vtu"), "Constitutive") == 2
        centers = mesh.points[mesh.tetrahedra].mean(axis=1)
        sella = points_of(os.path.join(PHANTOM, "sella.mrk.json"))[0]
        to_path = distance_to(points_of(os.path.join(PHANTOM, "transsphenoidal-path.mrk.json")), centers)
        to_sella = np.linalg.norm(centers - sella, axis=1)
        slack = 2 * SPACING
        self.assertTrue(still.any() and not still.all())
        self.assertTrue((~still | (to_sella > 60 - slack) & (to_path > 30 - slack)).all())
        self.assertTrue((still | (to_sella < 60 + slack) | (to_path < 30 + slack)).all())
        self.assertLess(to_sella[mesh.submesh == 1].min(), 2)

    def test_models_have_the_beams(self):
        with open("out/head.inp", encoding="ascii") as file:
            self.assertIn("*BEAM SECTION", file.read())
        with open("out/head.feb", encoding="utf-8") as file:
            self.assertIn("linear-beam", file.read())

    def test_refusals_leave_nothing(self):
        for status, word, arguments in ((2, "expected OUTDIR MAP", ("none",)), (1, "no such file", ("none", "absent.nrrd")),
                                        (1, "T1 of the phantom", ("none", "map.nrrd", "absent.nii"))):
            process = run(*arguments)
            self.assertEqual(process.returncode, status, process.stderr)
            self.assertEqual(process.stderr.count("\n"), 1, process.stderr)
            self.assertIn(word, process.stderr)
            self.assertFalse(os.path.exists("none"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
