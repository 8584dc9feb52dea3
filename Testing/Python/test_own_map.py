"""./example.sh on a map of one's own, with a path and null displacement; and its refusals.

usage: test_own_map.py BIN OUTDIR
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
from maps import cut_out, write_nrrd  # noqa: E402
from measures import euler_numbers_of_map, euler_numbers_of_mesh, signed_volumes  # noqa: E402
from meshfiles import cell_array, read_dataset, read_mesh, read_nrrd  # noqa: E402

BIN, OUTDIR = sys.argv[1:3]
PICTURES = ("surface", "tetrahedra", "scale", "evolution", "histograms")


def run(*arguments):
    return subprocess.run([os.path.join(ROOT, "example.sh"), *arguments], env={**os.environ, "SURGICALMESHER_BIN": BIN},
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                          check=False)


def write_markup(file, kind, points):
    control_points = [{"id": str(n), "position": list(point)} for n, point in enumerate(points)]
    with open(file, "w", encoding="utf-8") as stream:
        json.dump({"markups": [{"type": kind, "coordinateSystem": "LPS", "controlPoints": control_points}]}, stream)


class OwnMapTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(OUTDIR, ignore_errors=True)
        os.makedirs(OUTDIR)
        os.chdir(OUTDIR)
        cls.labels, affine = cut_out(np.s_[58:90, 84:116, 30:56])
        write_nrrd("map.nrrd", cls.labels, affine)
        cls.target, entry = ((affine @ [*index, 1])[:3] for index in ((16, 16, 13), (16, 31, 13)))
        write_markup("target.mrk.json", "Fiducial", [cls.target])
        write_markup("path.mrk.json", "Curve", [entry, cls.target])

    def assert_refused(self, status, word, *arguments):
        process = run(*arguments)
        self.assertEqual(process.returncode, status, process.stderr)
        self.assertEqual(process.stderr.count("\n"), 1, process.stderr)
        self.assertIn(word, process.stderr)

    def test_path_and_null_displacement(self):
        process = run("out", "map.nrrd", "--targets", "target.mrk.json", "--path", "path.mrk.json", "--minimumEdgeLength",
                      "3", "--maximumEdgeLength", "6", "--childRadius", "4", "--pathChildRadius=3",
                      "--nullDisplacementRadius", "8", "--nullDisplacementPathDistance", "4", "--minimumIslandVolume", "30")
        self.assertEqual(process.returncode, 0, process.stderr)
        prepared, _ = read_nrrd("out/prepared.nrrd")
        mesh = read_mesh("out/mesh.vtu")
        null_displacement = int(np.setdiff1d(np.unique(prepared), np.unique(self.labels)))
        self.assertGreater(signed_volumes(mesh).min(), 0)
        np.testing.assert_array_equal(euler_numbers_of_mesh(mesh), euler_numbers_of_map(prepared))
        constitutive = cell_array(read_dataset("out/mesh.vtu"), "Constitutive")
        np.testing.assert_array_equal(constitutive == 2, mesh.tissue == null_displacement)
        with open("out/report.json", encoding="utf-8") as file:
            scale = json.load(file)["scale"]
        self.assertEqual(scale["parameters"]["pathChildRadius"], 3)
        np.testing.assert_allclose(scale["targets"], [self.target], atol=1e-4)
        self.assertEqual(len(scale["paths"]), 1)
        self.assertRegex(process.stdout, r"tissues of wrong topology +0\n")
        for name in PICTURES:
            self.assertTrue(os.path.exists(f"out/{name}.png"), name)

    def test_refusals(self):
        targets = ("--targets", "target.mrk.json")
        self.assert_refused(1, "nothing.nrrd", "refused", "nothing.nrrd", *targets)
        self.assert_refused(2, "--targets", "refused", *targets)
        self.assert_refused(2, "neither a target nor a path", "refused", "map.nrrd")
        self.assert_refused(1, "nothing.mrk.json", "refused", "map.nrrd", "--targets", "nothing.mrk.json")
        self.assert_refused(2, "childRadus", "refused", "map.nrrd", *targets, "--childRadus", "4")
        self.assert_refused(2, "--childRadius", "refused", "map.nrrd", *targets, "--childRadius")
        self.assert_refused(2, "report", "refused", "map.nrrd", *targets, "--report", "r.json")
        self.assert_refused(2, "minimumEdgeLength", "refused", "map.nrrd", *targets, "--minimumEdgeLength", "-1")
        shutil.copy("map.nrrd", os.path.join("refused", "prepared.nrrd"))
        self.assert_refused(2, "overwritten", "refused", "refused/prepared.nrrd", *targets)
        self.assertFalse(os.path.exists(os.path.join("refused", "mesh.vtu")))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
