"""What is foretold of a mesh: its size within a factor of 1.5, memory that is enough, and at most three times as much as
is taken. usage: test_estimate.py BIN OUTDIR"""
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
from meshfiles import read_dataset, read_mesh  # noqa: E402

BIN, OUTDIR = sys.argv[1:3]


def run(module, *arguments):
    """Its peak memory, bytes."""
    measured = os.path.join(ROOT, "Testing", "Benchmarks", "measured.py")
    subprocess.run([sys.executable, measured, "figures.json", os.path.join(BIN, module), *arguments], check=True,
                   stdout=subprocess.DEVNULL)
    with open("figures.json", encoding="utf-8") as file:
        return json.load(file)["peakMemory"]


def is_sanitized():
    """Then what a program takes is mostly the sanitizer's."""
    with open(os.path.join(BIN, "SimplexMesherCLI"), "rb") as file:
        return b"__asan_init" in file.read()


class EstimateTest(unittest.TestCase):
    def setUp(self):
        shutil.rmtree(OUTDIR, ignore_errors=True)
        os.makedirs(OUTDIR)
        os.chdir(OUTDIR)

    def assert_foretold(self, box, *options):
        labels, affine = cut_out(box)
        write_nrrd("map.nrrd", labels, affine)
        target = (affine @ [*(np.array(labels.shape) // 2), 1])[:3]
        run("SurgicalPathScaleCLI", "--targetPoint", "%g,%g,%g" % tuple(target), *options, "--report", "scale.json",
            "map.nrrd", "scale.nrrd")
        common = ("--threads", "2", "--scale", "scale.nrrd", "--ambient", "ambient.vtu")
        taken = [run("SimplexMesherCLI", *common, "map.nrrd", "surface.vtp"),
                 run("FuchsTetrahedralizerCLI", *common, "surface.vtp", "mesh.vtu")]
        with open("scale.json", encoding="utf-8") as file:
            estimate = json.load(file)["estimate"]
        found = {"triangles": read_dataset("surface.vtp").GetNumberOfCells(),
                 "tetrahedra": len(read_mesh("mesh.vtu").tetrahedra)}
        for what, number in found.items():
            ratio = estimate[what] / number
            print("%s: %d %s, foretold %.2f times as many" % (" ".join(options), number, what, ratio))
            self.assertGreater(ratio, 1 / 1.5, what)
            self.assertLess(ratio, 1.5, what)
        foretold = max(estimate["surfaceMemoryBytes"], estimate["tetrahedralMemoryBytes"])
        print("%.0f MB, foretold %.0f" % (max(taken) / 1e6, foretold / 1e6))
        if not is_sanitized():
            self.assertGreater(foretold, max(taken))
            self.assertLess(foretold, 3 * max(taken))

    def test_around_a_target(self):
        self.assert_foretold(np.s_[58:98, 84:120, 30:66], "--minimumEdgeLength", "1", "--maximumEdgeLength", "8",
                             "--childRadius", "6")

    def test_with_one_length_everywhere(self):
        self.assert_foretold(np.s_[58:98, 84:120, 30:66], "--minimumEdgeLength", "2", "--maximumEdgeLength", "2")

    def test_with_elements_as_small_as_voxels(self):
        self.assert_foretold(np.s_[58:98, 84:120, 30:66], "--minimumEdgeLength", "1", "--maximumEdgeLength", "1.25")

    def test_with_elements_larger_than_the_tissues(self):
        self.assert_foretold(np.s_[30:70, 60:100, 60:100], "--minimumEdgeLength", "6", "--maximumEdgeLength", "6")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
