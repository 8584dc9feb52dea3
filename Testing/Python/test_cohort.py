"""A cohort of eight maps, one of them damaged, by Snakemake on this machine. usage: test_cohort.py BIN OUTDIR"""
import os
import shutil
import sys
import unittest

import cohorts
from cohorts import all_files, assert_one_refused, read_config, read_summary, write_config

BIN, OUTDIR = sys.argv[1:3]


def run(modules=BIN):
    return cohorts.run_snakemake("local", modules)


def clear_folder():
    shutil.rmtree(OUTDIR, ignore_errors=True)
    os.makedirs(OUTDIR)
    os.chdir(OUTDIR)


class CohortTest(unittest.TestCase):
    """The tests of this class follow one another in the order of their names."""

    @classmethod
    def setUpClass(cls):
        clear_folder()
        cohorts.write_cohort(8, damaged=3)

    def assert_done(self, process, status=0):
        self.assertEqual(process.returncode, status, process.stdout)

    def test_1_seven_meshes_and_one_reported_failure(self):
        process = run()
        self.assert_done(process)
        assert_one_refused(self, "p3")
        self.assertIn("7 of 8 patients meshed", process.stdout)
        self.assertIn("p3: refused by scale:", process.stdout)

    def test_2_second_run_has_nothing_to_do(self):
        before = all_files()
        process = run()
        self.assert_done(process)
        self.assertIn("Nothing to be done", process.stdout)
        self.assertEqual(all_files(), before)

    def test_3_only_what_changed_is_done_again(self):
        before = all_files()
        config = read_config()
        config["patients"]["p5"]["maximumEdgeLength"] = 5
        write_config(config)
        self.assert_done(run())
        changed = {path.split(os.sep)[1] for path, time in all_files().items() if before.get(path) != time}
        self.assertEqual(changed, {"p5", "summary.csv", "summary.md"})

    def test_4_missing_map_is_that_patients_failure(self):
        os.rename("p6.nrrd", "p6.away")
        self.assert_done(run())
        row = read_summary()["p6"]
        self.assertEqual(row["state"], "refused by scale")
        self.assertIn("p6.nrrd", row["error"])
        os.rename("p6.away", "p6.nrrd")
        self.assert_done(run())
        assert_one_refused(self, "p3")

    def test_5_lost_job_is_reported_and_tried_again(self):
        os.makedirs("bin", exist_ok=True)
        for name in os.listdir(BIN):
            if "CLI" in name and not os.path.exists(os.path.join("bin", name)):
                os.symlink(os.path.join(BIN, name), os.path.join("bin", name))
        mesher = os.path.join("bin", "SimplexMesherCLI")
        os.remove(mesher)
        with open(mesher, "w", encoding="utf-8") as file:  # the machine kills the second patient's job
            file.write(f'#!/bin/sh\ncase "$*" in *p1.nrrd*) kill -9 $$;; esac\nexec {BIN}/SimplexMesherCLI "$@"\n')
        os.chmod(mesher, 0o755)
        for patient in ("p1", "p2"):
            shutil.rmtree(os.path.join("out", patient))
        self.assert_done(run(os.path.abspath("bin")), status=1)
        rows = read_summary()
        self.assertEqual(rows["p1"]["state"], "lost at surface")
        self.assertIn("signal 9", rows["p1"]["error"])
        self.assertEqual(rows["p2"]["state"], "meshed")
        self.assert_done(run())
        assert_one_refused(self, "p3")

    def test_6_every_patient_has_options_of_its_own(self):
        clear_folder()
        cohorts.write_cohort(1, damaged=0)
        cohorts.write_cohort(2, damaged=0)
        config = read_config()
        del config["patients"]["p0"]
        config["patients"]["p1"].update(nullDisplacementRadius=9, maximumEdgeLength=4)
        write_config(config)
        self.assert_done(run())
        self.assertEqual(read_summary()["p1"]["state"], "meshed")
        with open(os.path.join("out", "p1", "scale", "report.json"), encoding="utf-8") as file:
            self.assertIn('"maximumEdgeLength": 4.0', file.read())
        self.assertTrue(os.path.exists(os.path.join("out", "p1", "scale", "labels.nrrd")))


class RefusalTest(unittest.TestCase):
    def setUp(self):
        clear_folder()

    def assert_refused(self, config, *words):
        write_config(config)
        process = run()
        self.assertNotEqual(process.returncode, 0)
        for word in words:
            self.assertIn(word, process.stdout)
        self.assertFalse(os.path.exists("out"))

    def test_configurations(self):
        patient = {"map": "p0.nrrd", "targetPoint": "0,0,0"}
        self.assert_refused({"folder": "out"}, "no patients")
        self.assert_refused({"patients": {"p0": patient}, "output": "out"}, "unknown member output")
        self.assert_refused({"patients": {"p0": {**patient, "childRadus": 5}}}, "p0", "childRadus")
        self.assert_refused({"patients": {"p0": patient}, "options": {"threads": 1}}, "options", "threads")
        self.assert_refused({"patients": {"p0": {"targetPoint": "0,0,0"}}}, "p0 has no map")
        self.assert_refused({"patients": {"../p0": patient}}, "'../p0'")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
