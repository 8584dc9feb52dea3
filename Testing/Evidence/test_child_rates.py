"""Tests child_rates.py on a box of the atlas. usage: test_child_rates.py BIN OUTDIR"""
import os
import shutil
import sys
import unittest

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import child_rates as evidence  # noqa: E402  # sets the path for the others
from brain_meshes import Programs  # noqa: E402
from maps import cut_out, write_nrrd  # noqa: E402
from meshfiles import read_mesh  # noqa: E402
from parts import Parts  # noqa: E402

BIN, OUTDIR = sys.argv[1:3]
LENGTHS = ("--minimumEdgeLength", 2, "--maximumEdgeLength", 8, "--decayLength", 10)


class RatesTest(unittest.TestCase):
    def test_a_box_has_rates_and_the_differences_asked_for(self):
        shutil.rmtree(os.path.join(OUTDIR, "rates"), ignore_errors=True)
        run = Programs(BIN, Parts(os.path.join(OUTDIR, "rates")).folder)
        labels, affine = cut_out(np.s_[66:94, 84:112, 60:88])
        write_nrrd(run.path("map.nrrd"), labels, affine)
        target = ",".join(f"{x:g}" for x in affine[:3, :3] @ [14, 14, 14] + affine[:3, 3])
        evidence.divide(run, "map.nrrd", target, LENGTHS, 7)
        record = evidence.record_of(7, evidence.benchmarked(run))
        self.assertEqual(record["tetrahedra"], len(read_mesh(run.path("mesh.vtu")).tetrahedra))
        self.assertEqual([child["child"] for child in record["children"]],
                         list(range(1, 1 + read_mesh(run.path("mesh.vtu")).submesh.max())))
        for child in record["children"]:
            self.assertTrue(0 < child["interface"] < child["unknowns"] < record["unknowns"])
            self.assertEqual(len(child["tool"]), 3)
        self.assertEqual([row["law"] for row in record["errors"]], ["linear", "neo-Hookean"])
        self.assertLess(record["errors"][0]["difference"], 1e-8)
        self.assertLess(record["errors"][1]["difference"], 1e-6)
        self.assertGreater(record["errors"][1]["largest"], 0.5)
        tables = evidence.tables_of([record])
        self.assertEqual(tables["child rates"].count("\n"), 2 + len(record["children"]))
        self.assertEqual(tables["child errors"].count("\n"), 4)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
