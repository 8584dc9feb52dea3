"""workflow/from-image on the image of a head of nested balls: every tissue from training points to tetrahedra.

usage: test_from_image.py BIN OUTDIR
"""
import json
import os
import shutil
import subprocess
import sys
import unittest

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "workflow", "example"))
from maps import write_nrrd  # noqa: E402
from measures import euler_numbers_of_map, euler_numbers_of_mesh  # noqa: E402
from meshfiles import read_mesh, read_nrrd  # noqa: E402

BIN, OUTDIR = sys.argv[1:3]
SCRIPT = os.path.join(ROOT, "workflow", "from-image", "from-image.sh")
SPACING = 2.0
# Outer radius (mm), brightness and name; muscle is as bright as grey matter, skin as CSF.
SHELLS = [(24, 110, "white matter"), (34, 85, "grey matter"), (40, 50, "CSF"), (45, 16, "skull"), (53, 85, "muscle"),
          (58, 50, "skin")]


def run(*arguments):
    return subprocess.run([SCRIPT, *arguments], env={**os.environ, "SURGICALMESHER_BIN": BIN},
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          check=False)


def head():
    """Shell's number by voxel (0 outside), its affine to LPS."""
    count = 63
    affine = np.diag([SPACING, SPACING, SPACING, 1.0])
    affine[:3, 3] = -SPACING * (count - 1) / 2
    radius = np.linalg.norm(affine[:3, 3] + SPACING * np.stack(np.indices((count,) * 3), -1), axis=-1)
    outer = np.array([shell[0] for shell in SHELLS])
    number = np.searchsorted(outer, radius) + 1
    return np.where(number > len(SHELLS), 0, number), affine


class FromImageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(OUTDIR, ignore_errors=True)
        os.makedirs(OUTDIR)
        os.chdir(OUTDIR)
        cls.number, affine = head()
        random = np.random.default_rng(1)
        brightness = np.array([2] + [shell[1] for shell in SHELLS])[cls.number]
        write_nrrd("t1.nrrd", np.clip(brightness + random.normal(0, 2, brightness.shape), 0, 255).astype(np.uint16),
                   affine)
        points = []
        for n, (_, _, name) in enumerate(SHELLS, 1):
            voxels = np.argwhere(cls.number == n)
            chosen = voxels[random.choice(len(voxels), 20, replace=False)]
            points += [{"label": name, "position": p} for p in (affine[:3, 3] + SPACING * chosen).tolist()]
        with open("points.mrk.json", "w", encoding="utf-8") as file:
            json.dump({"markups": [{"type": "Fiducial", "coordinateSystem": "LPS", "controlPoints": points}]}, file)
        cls.process = run("out", "t1.nrrd", "points.mrk.json", "--targetPoint", "0,0,30", "--minimumEdgeLength", "4",
                          "--maximumEdgeLength", "8", "--minimumIslandVolume", "200")

    def test_tissues_are_found_and_meshed(self):
        self.assertEqual(self.process.returncode, 0, self.process.stderr)
        found, _ = read_nrrd("out/tissues.nrrd")
        self.assertGreater(np.mean(found[self.number > 0] == self.number[self.number > 0]), 0.97)
        prepared, _ = read_nrrd("out/prepared.nrrd")
        mesh = read_mesh("out/mesh.vtu")
        self.assertEqual(set(mesh.tissue), set(range(1, len(SHELLS) + 1)))
        np.testing.assert_array_equal(euler_numbers_of_mesh(mesh), euler_numbers_of_map(prepared))

    def test_names_go_all_the_way(self):
        with open("out/report.json", encoding="utf-8") as file:
            names = {part["name"] for part in json.load(file)["surface"]["structures"]}
        self.assertEqual(names, {name for _, _, name in SHELLS})

    def test_pictures_are_there(self):
        for name in ("surface.png", "tetrahedra.png"):
            self.assertGreater(os.path.getsize(os.path.join("out", name)), 10_000)

    def test_bad_input_is_a_sentence(self):
        for arguments, status, words in ((["x", "t1.nrrd"], 2, "2 arguments"),
                                         (["x", "none.nrrd", "points.mrk.json"], 1, "none.nrrd: no such file"),
                                         (["x", "t1.nrrd", "none.mrk.json"], 1, "none.mrk.json: no such file"),
                                         (["x", "t1.nrrd", "t1.nrrd", "--edgeLength", "2"], 1, "t1.nrrd")):
            process = run(*arguments)
            self.assertEqual(process.returncode, status, arguments)
            self.assertIn(words, process.stderr)
            self.assertEqual(process.stderr.count("\n"), 1, process.stderr)
            self.assertFalse(os.path.exists("x"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
