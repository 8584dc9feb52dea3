"""./example.sh on a map of one's own, with a path and null displacement; and its refusals.

usage: test_own_map.py BIN OUTDIR
"""
import json
import os
import re
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
SCRIPTS = os.path.join(ROOT, "workflow", "example")
DISPLAY = os.path.join(SCRIPTS, "display.py")
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
        self.assertRegex(process.stdout, r"tissues of wrong topology +0 \(beside the prepared map\)\n")
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
        self.assert_refused(2, "followThickness", "refused", "map.nrrd", *targets, "--followThickness=perhaps")
        self.assertFalse(os.path.exists("refused"))
        os.makedirs("refused")
        shutil.copy("map.nrrd", os.path.join("refused", "prepared.nrrd"))
        self.assert_refused(2, "overwritten", "refused", "refused/prepared.nrrd", *targets)
        shutil.copy("target.mrk.json", os.path.join("refused", "report.json"))
        self.assert_refused(2, "overwritten", "refused", "map.nrrd", "--targets", "refused/report.json")
        self.assertEqual(sorted(os.listdir("refused")), ["prepared.nrrd", "report.json"])

    def test_b06_earlier_results_stay_until_there_are_new_ones(self):
        coarse = ("--minimumEdgeLength", "6", "--maximumEdgeLength", "8")
        os.makedirs("kept")
        for name in ("labels.nrrd", "mesh.vtu", "mine.txt"):
            with open(os.path.join("kept", name), "w", encoding="utf-8") as file:
                file.write("of before")
        self.assert_refused(2, "neither a target nor a path", "kept", "map.nrrd")
        self.assertEqual(sorted(os.listdir("kept")), ["labels.nrrd", "mesh.vtu", "mine.txt"])
        process = run("kept", "map.nrrd", "--targets", "target.mrk.json", *coarse)
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        left = os.listdir("kept")
        self.assertFalse([name for name in left if name.startswith(".")])
        self.assertNotIn("labels.nrrd", left, "of before, and of another map")
        self.assertIn("mine.txt", left)
        self.assertGreater(len(read_mesh("kept/mesh.vtu").tetrahedra), 0)

    def assert_shown(self, process, folder, *words):
        """The run went well and told on stderr, in one line and in the table, where the target is; all pictures are
        there."""
        self.assertEqual(process.returncode, 0, process.stderr)
        self.assertEqual(process.stderr.count("example.sh: "), 1, process.stderr)  # the programs warn, too
        table = re.search(r"^warning +(.*)$", process.stdout, re.M).group(1)
        for word in words:
            self.assertIn(word, process.stderr)
            self.assertIn(word, table)
        for name in PICTURES:
            self.assertTrue(os.path.exists(f"{folder}/{name}.png"), name)
        with open(f"{folder}/report.json", encoding="utf-8") as file:
            self.assertEqual(json.load(file)["warnings"], [table])

    def test_b05_targets_outside_of_the_map_and_beside_the_tissue(self):
        coarse = ("--minimumEdgeLength", "6", "--maximumEdgeLength", "8")
        self.assert_shown(run("far", "map.nrrd", "--targetPoint", "500,0,0", *coarse), "far",
                          "target (500, 0, 0) mm LPS", "outside the label map", "mm from the nearest tissue")
        labels = np.zeros((40, 30, 20), np.uint16)
        labels[4:16, 4:16, 4:16] = 3
        centred = np.diag([1.0, 1, 1, 1])
        centred[:3, 3] = -20, -15, -10
        write_nrrd("beside.nrrd", labels, centred)
        self.assert_shown(run("beside", "beside.nrrd", "--targetPoint", "10,5,0", *coarse), "beside",
                          "target (10, 5, 0) mm LPS lies beside the tissue", "opposite sign")

    def test_b05_maps_of_one_voxel_and_of_one_slice(self):
        write_nrrd("voxel.nrrd", np.ones((1, 1, 1), np.uint16), np.diag([2.0, 2, 2, 1]))
        self.assert_shown(run("voxel", "voxel.nrrd", "--targetPoint", "30,0,0"), "voxel", "outside the label map")
        labels = np.ones((20, 20, 1), np.uint16)
        labels[5:10, 5:10] = 2
        write_nrrd("slice.nrrd", labels, np.diag([2.0, 2, 2, 1]))
        process = run("slice", "slice.nrrd", "--targetPoint", "10,10,0", "--minimumEdgeLength", "3")
        self.assertEqual((process.returncode, process.stderr), (0, ""))
        self.assert_shown(run("slice", "slice.nrrd", "--targetPoint", "-9,-9,30"), "slice", "outside the label map")

    def test_axes_of_the_map_are_turned(self):
        turned = np.array([[0, 0, 3.0, -20], [3, 0, 0, -30], [0, -3, 0, 40], [0, 0, 0, 1]])
        write_nrrd("turned.nrrd", self.labels[::3, ::3, ::3], turned)
        inside = np.argwhere(self.labels[::3, ::3, ::3])
        target = "%g,%g,%g" % tuple((turned @ [*inside[len(inside) // 2], 1])[:3])
        process = run("turned", "turned.nrrd", "--targetPoint", target, "--minimumEdgeLength", "6")
        self.assertEqual((process.returncode, process.stderr), (0, ""))

    def test_a_picture_that_cannot_be_drawn_is_a_sentence(self):
        write_nrrd("small.nrrd", np.ones((8, 8, 8), np.uint16), np.diag([2.0, 2, 2, 1]))
        process = run("small", "small.nrrd", "--targetPoint", "8,8,8", "--minimumEdgeLength", "6")
        self.assertEqual(process.returncode, 0, process.stderr)
        os.remove("small/mesh.vtu")
        command = [sys.executable, DISPLAY, sys.executable, os.path.join(SCRIPTS, "pictures.py"), "small"]
        process = subprocess.run(command, stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual(process.returncode, 1)
        self.assertIn("pictures: tetrahedra.png cannot be drawn", process.stderr)
        self.assertNotIn("Traceback", process.stderr)

    def test_displays_that_begin_together_are_different_ones(self):
        command = [sys.executable, DISPLAY, "sh", "-c", "echo $DISPLAY; sleep 2"]
        begun = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True) for _ in range(4)]
        names = [process.communicate()[0] for process in begun]
        self.assertEqual([process.returncode for process in begun], [0] * 4)
        self.assertEqual(len(set(names)), 4, names)
        windows = ("import vtk\nfor _ in range(40):\n    window = vtk.vtkRenderWindow()\n"
                   "    window.SetOffScreenRendering(1)\n    window.AddRenderer(vtk.vtkRenderer())\n"
                   "    window.Render()\n    window.Finalize()\n    del window\n")
        many = subprocess.run([sys.executable, DISPLAY, sys.executable, "-c", windows], stderr=subprocess.PIPE,
                              text=True, check=False)
        self.assertEqual((many.returncode, many.stderr), (0, ""), "one window after the other")
        none = subprocess.run([sys.executable, DISPLAY, "true"], env={"PATH": "/nowhere"}, stderr=subprocess.PIPE,
                              text=True, check=False)
        self.assertEqual((none.returncode, none.stderr.count("\n")), (1, 1), none.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
