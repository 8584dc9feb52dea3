"""Tests whole_maps.py on a box of the atlas. usage: test_whole_maps.py BIN OUTDIR"""
import os
import shutil
import sys
import unittest
from types import SimpleNamespace

import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import whole_maps as evidence  # noqa: E402  # sets the path for the others
from brain_meshes import Programs  # noqa: E402
from lattice import lattice_tetrahedra  # noqa: E402
from maps import cut_out, write_nrrd  # noqa: E402
from parts import Parts  # noqa: E402

BIN, OUTDIR = sys.argv[1:3]


class BoxTest(unittest.TestCase):
    def test_ours_keeps_every_tissue_of_a_box(self):
        shutil.rmtree(os.path.join(OUTDIR, "maps"), ignore_errors=True)
        run = Programs(BIN, Parts(os.path.join(OUTDIR, "maps")).folder)
        labels, affine = cut_out(np.s_[60:84, 90:114, 50:74])
        write_nrrd(run.path("box.nrrd"), labels, affine)
        inner = str(labels[12, 12, 12])
        case = ["box", run.path("box.nrrd"), inner, "1,4,6,10", "-", "--minimumIslandVolume", "30", "--fine", "300"]
        records = [evidence.measured(list(case), mesher, run) for mesher in ("ours", "CGAL Mesh_3")]
        tissues = records[0]["tissues"]
        self.assertGreater(len(tissues), 5)
        self.assertTrue(all(tissue["right"] for tissue in tissues.values()))
        self.assertLess(max(tissue["distance"] for tissue in tissues.values()), 0.5)
        self.assertLess(max(abs(t["volume"] - 1) for t in tissues.values() if t["voxels"] > 1000), 0.05)
        self.assertEqual(set(records[1]["tissues"]), set(tissues))
        self.assertEqual(set(tissues) | set(records[0]["removed"]), set(map(str, np.unique(labels[labels > 0]))))
        tables = evidence.tables_of(records, {"box": {}})
        self.assertIn("| box | ours |", tables["whole maps"])
        self.assertEqual(tables["lost tissues"].splitlines()[2].split("|")[3].strip(), "none")


class MeasuresTest(unittest.TestCase):
    def setUp(self):
        self.labels = np.zeros((12, 12, 12), int)
        self.labels[2:6, 2:10, 2:10], self.labels[6:10, 2:10, 2:10] = 1, 2
        points, tetrahedra = lattice_tetrahedra(np.full(3, 1.5), np.full(3, 9.5), 1.0)
        middle = points[tetrahedra].mean(axis=1)
        inside = np.all((middle > 1.5) & (middle < 9.5), axis=1)
        tetrahedra = tetrahedra[inside]
        self.mesh = SimpleNamespace(points=points, tetrahedra=tetrahedra,
                                    tissue=np.where(middle[inside][:, 0] < 5.5, 1, 2))

    def test_tissues_where_they_are_have_their_volume_and_no_distance(self):
        found = evidence.tissues_of(self.mesh, self.labels, np.eye(4))
        for tissue in found.values():
            self.assertAlmostEqual(tissue["volume"], 1, delta=0.2)
            self.assertLess(tissue["distance"], 0.3)

    def test_lost_and_shrunken_tissues_are_named(self):
        record = {"map": "m", "mesher": "x", "tissues": {
            "1": {"voxels": 900, "volume": 0, "right": False, "distance": np.inf},
            "2": {"voxels": 30, "volume": 0.6, "right": False, "distance": 0.4},
            "3": {"voxels": 50, "volume": 1.1, "right": True, "distance": 0.1}}}
        self.assertEqual(evidence.spoilt(record, {1: "nerve"}), "2 (-40% of 30), nerve (lost of 900)")

    def test_what_preparation_removed_stands_before_ours_only(self):
        tissue = {"voxels": 2000, "volume": 1.001, "right": True, "distance": 0.1}
        record = {"map": "m", "mesher": "ours", "tetrahedra": 9, "smallestDihedral": 20, "largestDihedral": 140,
                  "seconds": 1, "tissues": {"1": tissue}, "removed": {"7": 12}}
        self.assertEqual(list(evidence.lost_rows(record, {7: "nerve"})),
                         [["m", "preparation", "nerve (12 in small islands)"], ["m", "ours", "none"]])
        self.assertEqual(list(evidence.lost_rows({**record, "mesher": "x"}, {})), [["m", "x", "none"]])
        self.assertEqual(evidence.row_of(record)[2], "1 of 2")

    def test_a_target_is_a_point_or_the_middle_of_a_label(self):
        self.assertEqual(evidence.target_of("1,2,3", None, None), "1,2,3")
        affine = np.diag([-1.0, 1, 2, 1])
        self.assertEqual(evidence.target_of("2", self.labels, affine), "-7.500,5.500,11.000")

    def test_small_tissues_get_the_least_length(self):
        run = Programs(BIN, Parts(os.path.join(OUTDIR, "fine")).folder)
        self.labels[0, 0, :3] = 5
        options = ["--featureScale", "0.5", "--fine", "4", "--smoothing", "0"]
        self.assertEqual(evidence.with_fine_tissues(options, run, self.labels, "1"),
                         ["--featureScale", "0.5", "--tissues", "fine.csv", "--smoothing", "0"])
        with open(run.path("fine.csv"), encoding="utf-8") as table:
            self.assertEqual(table.read().split(), ["label,maximum", "5,1"])
        self.assertEqual(evidence.with_fine_tissues(["--fine", "3"], run, self.labels, "1"), [])
        self.assertEqual(evidence.with_fine_tissues(options[:2], run, self.labels, "1"), options[:2])

    def test_a_mesher_that_fails_has_a_row_that_says_so(self):
        folder = Parts(os.path.join(OUTDIR, "failing")).folder
        write_nrrd(os.path.join(folder, "empty.nrrd"), np.zeros((4, 4, 4), np.uint16), np.eye(4))
        case = ["empty", os.path.join(folder, "empty.nrrd"), "0,0,0", "1,4,6,10", "-"]
        record = evidence.measured_or_failed(case, "ours", Programs(BIN, folder))
        self.assertRegex(evidence.row_of(record)[2], r"no mesh: \w+CLI ended with \d")
        self.assertEqual(list(evidence.lost_rows(record, {})), [["empty", "ours", "all"]])
        self.assertEqual(len(evidence.row_of(record)), 10)

    def test_names_are_read_and_cases_split_from_options(self):
        options, cases = evidence.options_of(["bin", "out", "--document", "--case", "a", "f.nrrd", "0,0,0", "1,2,3,4", "-",
                                              "--featureScale", "0.5", "--case", "b", "g.nrrd", "1,1,1", "1,2,3,4", "-"])
        self.assertTrue(options.document)
        self.assertEqual([case[0] for case in cases], ["a", "b"])
        self.assertEqual(cases[0][5:], ["--featureScale", "0.5"])
        file = os.path.join(OUTDIR, "names.ctbl")
        os.makedirs(OUTDIR, exist_ok=True)
        with open(file, "w", encoding="utf-8") as stream:
            stream.write("# colours\n2 Left-White 1 2 3 255\n")
        self.assertEqual(evidence.read_names(file), {2: "Left-White"})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
