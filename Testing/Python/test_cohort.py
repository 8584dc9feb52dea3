"""A cohort of eight maps, one of them damaged, by Snakemake on this machine. usage: test_cohort.py BIN OUTDIR"""
import csv
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import unittest
import unittest.mock

import nibabel
import numpy as np

import cohorts
from cohorts import ROOT, all_files, assert_one_refused, read_config, read_summary, write_config, write_text

sys.path.insert(0, os.path.join(ROOT, "workflow", "example"))
sys.path.insert(0, os.path.join(ROOT, "workflow", "scripts"))
from cohort import Cohort  # noqa: E402
import stage  # noqa: E402
from configuration import ConfigurationError, read_configuration  # noqa: E402
from maps import write_nrrd  # noqa: E402
from measures import dihedral_angles, signed_volumes  # noqa: E402
from meshfiles import read_mesh, read_nrrd  # noqa: E402

BIN, OUTDIR = sys.argv[1:3]


def run(modules=BIN, **more):
    return cohorts.run_snakemake("local", modules, **more)


def text_of(file):
    with open(file, encoding="utf-8") as stream:
        return stream.read()


def read_rows(*path):
    with open(os.path.join(*path), encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def clear_folder():
    shutil.rmtree(OUTDIR, ignore_errors=True)
    os.makedirs(OUTDIR)
    os.chdir(OUTDIR)


class CohortTest(unittest.TestCase):
    """The tests of this class follow one another in the order of their names."""

    @classmethod
    def setUpClass(cls):
        clear_folder()
        cohorts.write_cohort(8, damaged=3, pictures=False)

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
        self.assertEqual(changed, {"p5", "summary.csv", "summary.md", "volumes.csv"})

    def test_4_missing_map_is_that_patients_failure(self):
        os.rename("p6.nrrd", "p6.away")
        self.assert_done(run())
        row = read_summary()["p6"]
        self.assertEqual(row["state"], "refused by scale")
        self.assertIn("p6.nrrd", row["error"])
        os.rename("p6.away", "p6.nrrd")
        self.assert_done(run())
        assert_one_refused(self, "p3")

    @staticmethod
    def write_failing_mesher():
        """Modules of which the mesher fails three patients as machines do, and refuses two."""
        os.makedirs("bin", exist_ok=True)
        for name in os.listdir(BIN):
            if "CLI" in name and not os.path.exists(os.path.join("bin", name)):
                os.symlink(os.path.join(BIN, name), os.path.join("bin", name))
        mesher = os.path.join("bin", "SimplexMesherCLI")
        os.remove(mesher)
        with open(mesher, "w", encoding="utf-8") as file:
            file.write('#!/bin/sh\ncase "$*" in\n'
                       '*p1.nrrd*) kill -9 $$;;\n'
                       '*p2.nrrd*) echo "SimplexMesherCLI: out of memory" >&2; exit 3;;\n'
                       '*p4.nrrd*) trap "" XFSZ; ulimit -f 8;;\n'  # all room that there is for a file
                       '*p6.nrrd*) echo "SimplexMesherCLI: p6.nrrd: cannot be read to its end" >&2; exit 1;;\n'
                       '*p0.nrrd*) echo "SimplexMesherCLI: surface: tissue 5 changed its topology" >&2; exit 3;;\n'
                       f'esac\nexec {BIN}/SimplexMesherCLI "$@"\n')
        os.chmod(mesher, 0o755)

    def test_5_lost_job_is_reported_and_tried_again(self):
        self.write_failing_mesher()
        lost = {"p1": "signal 9", "p2": "out of memory", "p4": "written"}
        for patient in (*lost, "p0", "p6", "p7"):
            shutil.rmtree(os.path.join("out", patient))
        self.assert_done(run(os.path.abspath("bin")), status=1)
        rows = read_summary()
        for patient, words in lost.items():
            self.assertEqual(rows[patient]["state"], "lost at surface", rows[patient])
            self.assertIn(words, rows[patient]["error"])
        self.assertEqual([rows[patient]["state"] for patient in ("p0", "p6", "p7")],
                         ["refused by surface", "refused by surface", "meshed"])
        self.assert_done(run())
        rows = read_summary()
        self.assertEqual({patient for patient in rows if rows[patient]["state"] != "meshed"}, {"p0", "p3", "p6"})

    def test_6_every_patient_has_options_of_its_own(self):
        clear_folder()
        cohorts.write_cohort(1, damaged=0)
        cohorts.write_cohort(2, damaged=0, pictures=False)
        config = read_config()
        del config["patients"]["p0"]
        config["patients"]["p1"].update(nullDisplacementRadius=9, maximumEdgeLength=4)
        write_config(config)
        self.assert_done(run())
        self.assertEqual(read_summary()["p1"]["state"], "meshed")
        with open(os.path.join("out", "p1", "scale", "report.json"), encoding="utf-8") as file:
            self.assertIn('"maximumEdgeLength": 4.0', file.read())
        self.assertTrue(os.path.exists(os.path.join("out", "p1", "scale", "labels.nrrd")))


def write_nifti(file):
    """The map p0.nrrd."""
    labels, affine = read_nrrd("p0.nrrd")
    nibabel.save(nibabel.Nifti1Image(labels, np.diag([-1, -1, 1, 1]) @ affine), file)


OWN = "minimumEdgeLength: 4, maximumEdgeLength: 6, childRadius: 5"
QUICK = "folder: out\npictures: no\n"


class ConfigurationTest(unittest.TestCase):
    """Cohorts of small maps, in ways that configurations are written."""

    def setUp(self):
        clear_folder()
        cohorts.write_cohort(2, damaged=1)  # p0.nrrd, and p1.nrrd that is cut off
        self.point = read_config()["patients"]["p0"]["targetPoint"]

    def meshed(self, process, folder="out"):
        """The patients that have a mesh; prints what became of the others."""
        self.assertEqual(process.returncode, 0, process.stdout)
        rows = read_summary(folder)
        for name, row in rows.items():
            if row["state"] != "meshed":
                print(f"{self.id()}: {name}: {row['state']}: {row['error']}", flush=True)
        return {name for name, row in rows.items() if row["state"] == "meshed"}

    def write_target(self, name):
        position = [float(x) for x in self.point.split(",")]
        with open(name, "w", encoding="utf-8") as file:
            json.dump({"markups": [{"type": "Fiducial", "coordinateSystem": "LPS",
                                    "controlPoints": [{"id": "1", "position": position}]}]}, file)

    def test_b07_names_are_text_whatever_yaml_makes_of_them(self):
        names = ("010", "007", "1e3", "yes", "2026-11-23", "1_0", "p.1")
        patients = "".join(f"  {name}: {{map: p0.nrrd, targetPoint: \"{self.point}\"}}\n" for name in names)
        write_text(f"{QUICK}options: {{{OWN}}}\npatients:\n{patients}")
        self.assertEqual(self.meshed(run()), set(names))
        for name in names:
            self.assertTrue(os.path.exists(f"out/{name}/mesh/mesh.vtu"), name)

    def test_b09_folders_with_spaces_and_quotes(self):
        root = os.path.abspath("a source folder")
        os.makedirs(root)
        shutil.copytree(os.path.join(ROOT, "workflow"), os.path.join(root, "workflow"))
        os.rename("p0.nrrd", "the 'first' map.nrrd")
        folder = "my $cohort's folder"
        write_config({"folder": folder, "options": cohorts.OPTIONS,
                      "patients": {"a": {"map": "the 'first' map.nrrd", "targetPoint": self.point}}})
        self.assertEqual(self.meshed(run(root=root), folder), {"a"})
        self.assertFalse(os.path.exists("my"))

    def test_b15_booleans_in_quotes(self):
        for text, on in (("'no'", False), ("no", False), ("'yes'", True), ("true", True)):
            write_text(f"{QUICK}options: {{{OWN}, followThickness: {text}}}\n"
                       f"patients: {{a: {{map: p0.nrrd, targetPoint: \"{self.point}\"}}}}\n")
            self.assertEqual(self.meshed(run()), {"a"}, text)
            with open("out/a/surface/report.json", encoding="utf-8") as file:
                self.assertEqual(json.load(file)["thickness"]["followed"], on, text)

    def test_members_given_to_snakemake(self):
        write_text(f"folder: out\noptions: {{{OWN}}}\n"
                   f"patients: {{01: {{map: p0.nrrd, targetPoint: \"{self.point}\"}}}}\n")
        given = ["--config", "folder=elsewhere", "threads=1", "pictures=no"]
        self.assertEqual(self.meshed(run(arguments=given), "elsewhere"), {"01"})
        self.assertFalse(os.path.exists("elsewhere/01/picture"))
        self.assertEqual(read_summary("elsewhere")["01"]["picture"], "")

    def test_patients_by_a_pattern(self):
        os.makedirs("maps")
        for name in ("003", "anna"):
            os.makedirs(f"maps/{name}")
            shutil.copy("p0.nrrd", f"maps/{name}/{name}.nrrd")
            self.write_target(f"maps/{name}/{name}.mrk.json")
        write_text(f"{QUICK}options: {{{OWN}, targets: '{{folder}}/{{patient}}.mrk.json'}}\n"
                   "patients: maps/*/*.nrrd\n")
        self.assertEqual(self.meshed(run()), {"003", "anna"})

    def test_files_of_any_name(self):
        os.makedirs("the maps")
        for name in ("ben (2)", "an na's", "a+b", "müller", "Ünal"):
            write_nifti(f"the maps/{name}.nii.gz")
            self.write_target(f"the maps/{name}.mrk.json")
        write_text(f"{QUICK}options: {{{OWN}, targets: '{{folder}}/{{file}}.mrk.json'}}\n"
                   "patients: the maps/*.nii.gz\n")
        self.assertEqual(self.meshed(run()), {"ben_2_", "an_na_s", "a_b", "m_ller", "_nal"})

    def test_patients_by_a_table(self):
        with open("list.csv", "w", encoding="utf-8") as file:
            file.write(f"patient,map,targetPoint,maximumEdgeLength\n007,p0.nrrd,\"{self.point}\",5\n"
                       f"008,p1.nrrd,\"{self.point}\",\n")
        write_text(f"{QUICK}options: {{{OWN}}}\npatients: list.csv\n")
        self.assertEqual(self.meshed(run()), {"007"})
        self.assertEqual(read_summary()["008"]["state"], "refused by scale")
        with open("out/007/scale/report.json", encoding="utf-8") as file:
            self.assertEqual(json.load(file)["parameters"]["maximumEdgeLength"], 5)

    def test_patients_of_a_bids_folder(self):
        anat = "bids/derivatives/seg/sub-01/anat"
        os.makedirs(anat)
        write_nifti(f"{anat}/sub-01_space-orig_dseg.nii.gz")
        write_nifti(f"{anat}/sub-01 (2)_dseg.nii.gz")
        write_text(f"{QUICK}options: {{{OWN}, targetPoint: '{self.point}'}}\npatients: bids\n")
        self.assertEqual(self.meshed(run()), {"sub-01_space-orig", "sub-01_2_"})

    def test_b08_bytes_of_bad_files_and_damaged_results_leave_the_table_whole(self):
        with open("names.lut", "wb") as file:
            file.write(b"\xff\x00\x1b[2J\xfe table\n" * 20)
        patients = {name: {"map": "p0.nrrd", "targetPoint": self.point} for name in ("a", "b", "c", "d")}
        patients["a"]["names"] = "names.lut"
        write_config({"folder": "out", "pictures": False, "options": cohorts.OPTIONS, "patients": patients})
        self.assertEqual(self.meshed(run()), {"b", "c", "d"})
        row = read_summary()["a"]
        self.assertEqual(row["state"], "refused by scale")
        self.assertIn("names.lut", row["error"])
        for text in (row["error"], text_of("out/summary.md")):
            self.assertNotRegex(text, "[\x00\x1b]")
        with open("out/b/surface/report.json", "w", encoding="utf-8") as file:
            file.write("{ half")
        with open("out/c/mesh/run.json", "w", encoding="utf-8") as file:
            file.write('{"stage": "x|\\n\\u001b[2J", "status": 1, "error": "a|b\\n| c | d |\\u001b"}')
        summary = [sys.executable, os.path.join(ROOT, "workflow", "scripts", "summary.py"), "out", *patients]
        done = subprocess.run(summary, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        rows = read_summary()
        self.assertEqual([row["state"] for row in rows.values()][0::3], ["refused by scale", "meshed"])
        self.assertEqual(rows["b"]["state"], "unreadable")
        self.assertRegex(rows["c"]["error"], r"^a\|b\\n\| c \| d \|\\x1b$")
        self.assertEqual(len(text_of("out/summary.md").splitlines()), 2 + len(patients))

    def test_volumes_quality_warnings_logs_and_pictures(self):
        write_config({"folder": "out", "options": cohorts.OPTIONS,
                      "patients": {"in": {"map": "p0.nrrd", "targetPoint": self.point},
                                   "far": {"map": "p0.nrrd", "targetPoint": "900,0,0"}}})
        self.assertEqual(self.meshed(run()), {"in", "far"})
        rows = read_summary()
        self.assertIn("outside the label map", rows["far"]["warnings"])
        labels, affine = read_nrrd("out/in/surface/prepared.nrrd")
        mesh = read_mesh("out/in/mesh/mesh.vtu")
        voxel, volume = abs(np.linalg.det(affine[:3, :3])), signed_volumes(mesh)
        self.assertAlmostEqual(float(rows["in"]["mapVolumeMm3"]), voxel * np.count_nonzero(labels), 0)
        self.assertAlmostEqual(float(rows["in"]["meshVolumeMm3"]), volume.sum(), 0)
        self.assertAlmostEqual(float(rows["in"]["meanMinimumDihedralDegrees"]),
                               dihedral_angles(mesh).min(axis=1).mean(), 1)
        tissues = [row for row in read_rows("out", "volumes.csv") if row["patient"] == "in"]
        self.assertEqual([int(row["label"]) for row in tissues], list(np.setdiff1d(labels, [0])))
        for row in tissues:
            label = int(row["label"])
            self.assertAlmostEqual(float(row["mapVolumeMm3"]), voxel * np.count_nonzero(labels == label), 0)
            self.assertAlmostEqual(float(row["meshVolumeMm3"]), volume[mesh.tissue == label].sum(), 0)
        for name, row in rows.items():
            self.assertTrue(os.path.exists(os.path.join("out", row["log"])), name)
            self.assertGreater(os.path.getsize(os.path.join("out", row["picture"])), 10_000, name)


class StageTest(unittest.TestCase):
    """What a program's end means: a result of the stage, or that the job is lost."""

    def setUp(self):
        clear_folder()

    def status_of(self, *command, name="surface"):
        """Of the stage's script."""
        stage = [sys.executable, os.path.join(ROOT, "workflow", "scripts", "stage.py"), name, f"out/p/{name}",
                 f"out/p/{name}.log", "--", *command]
        shutil.rmtree("out", ignore_errors=True)
        os.makedirs("out/p")
        done = subprocess.run(stage, check=False).returncode
        self.assertEqual(os.path.exists(f"out/p/{name}/run.json"), done == 0, command)
        return done

    def status_after(self, status, line):
        return self.status_of("sh", "-c", f"echo {shlex.quote(line)} >&2; exit {status}")

    def assert_is_said(self, words, file):
        """By the module's source."""
        self.assertIn(words, re.sub(r'"\s*"', "", text_of(os.path.join(ROOT, file))))

    def test_results(self):
        for status, line in ((0, ""), (2, "X: --edgeLength: '-1' found, a number expected"),
                             (1, "X: p0.nrrd: cannot be opened for reading"),
                             (1, "X: p0.nrrd: cannot be read to its end"),
                             (1, "X: out/a.msh: label 120 found, SimNIBS's tissues are 1 to 99"),
                             (3, "X: out of memory/a.vtp: tissue 5 got lost"), (3, "")):
            self.assertEqual(self.status_after(status, line), 0, line)

    def test_results_in_the_modules_words(self):
        for status, line, words, file in (
                (1, "out/a.xyz: cannot be written as an image, expected the extension of NRRD",
                 ": cannot be written as an image, expected the extension of ", "Libs/TissueMap/TissueMapIO.cxx"),
                (3, "constrained Delaunay: TetGen gave up with it found triangles that cut each other",
                 "constrained Delaunay: TetGen gave up with ", "Libs/Delaunay/SurfaceTetrahedralization.cxx"),
                (3, "surface: tissue 5 changed its topology", " changed its topology",
                 "SimplexMesher/CLI/SimplexMesherCLI.cxx"),
                (3, "map preparation: a tissue got lost in simplification",
                 "map preparation: a tissue got lost in simplification", "Libs/MapPreparation/ScaledPreparation.cxx")):
            self.assertIn(words, line)
            self.assert_is_said(words, file)
            self.assertEqual(self.status_after(status, f"X: {line}"), 0, line)

    def test_lost(self):
        for status, line, words, file in (
                (3, "out of memory", "out of memory", "Libs/CommandLine/CommandLine.cxx"),
                (3, "constrained Delaunay: TetGen gave up with out of memory", "out of memory",
                 "Libs/Delaunay/SurfaceTetrahedralization.cxx"),
                (3, "HDF5: no memory for the exported mesh", "HDF5: no memory for the exported mesh",
                 "Libs/FiniteElements/Export/XdmfExport.cxx"),
                (3, "no process of its own can be started for a library (Resource temporarily unavailable)",
                 "no process of its own can be started for a library (", "Libs/Foundation/SeparateProcess.cxx"),
                (3, "stdout: not all that was printed could be written, a place with room for it expected",
                 "stdout: not all that was printed could be written", "Libs/CommandLine/Platform.cxx"),
                (3, "out/a.vtp: output was not written", ": output was not written",
                 "Libs/CommandLine/OutputFiles.cxx"),
                (1, "out/a.vtu: can't be written to its end (No space left on device)", "written to its end",
                 "Libs/Foundation/TextFile.cxx"),
                (1, "out/a.vtu: can't be opened for writing (Permission denied)", "opened for writing",
                 "Libs/Foundation/TextFile.cxx"),
                (1, "out/a.nrrd: cannot be written whole, expected room for it on the disk",
                 ": cannot be written whole", "Libs/TissueMap/TissueMapIO.cxx"),
                (1, "out/a.nrrd: cannot be written (Broken pipe)", ": cannot be written (",
                 "Libs/TissueMap/TissueMapIO.cxx"),
                (1, "out/a.vtp: disk full or failing, room for the file expected", ": disk full or failing",
                 "Libs/CommandLine/OutputFiles.cxx"),
                (1, "out/a.vtp: can't be replaced, a writable file expected", ": can't be replaced",
                 "Libs/CommandLine/OutputFiles.cxx"),
                (1, "out/a.vtp: can't create a file in out, a writable folder expected", ": can't create a file in ",
                 "Libs/CommandLine/OutputFiles.cxx")):
            self.assertIn(words, line)
            self.assert_is_said(words, file)
            self.assertEqual(self.status_after(status, f"X: {line}"), 1, line)
            self.assertEqual(text_of("out/p/surface.log").strip(), f"X: {line}")
        self.assertEqual(self.status_after(139, ""), 1)
        self.assertEqual(text_of("out/p/surface.log").strip(), "sh ended by status 139")

    @staticmethod
    def write_cube(size):
        write_nrrd("cube.nrrd", np.ones((size,) * 3, np.uint16), np.eye(4))

    def mesher(self, *options, limit="true"):
        """The status of the surface's stage for the cube."""
        words = shlex.join([os.path.join(BIN, "SimplexMesherCLI"), *options, "cube.nrrd", "out/surface.vtp"])
        return self.status_of("sh", "-c", f"{limit}; exec {words}")

    def test_limits_of_memory(self):
        self.write_cube(60)
        said = set()
        for kilobytes in range(60_000, 140_001, 20_000):
            if self.mesher("--edgeLength", "1.5", limit=f"ulimit -v {kilobytes}"):
                said.add(text_of("out/p/surface.log").strip().split("\n")[-1])
            else:
                with open("out/p/surface/run.json", encoding="utf-8") as file:
                    self.assertEqual(json.load(file)["status"], 0)
        self.assertIn("SimplexMesherCLI: out of memory", said)

    def test_full_disks(self):
        self.write_cube(9)
        self.assertEqual(self.mesher("--edgeLength", "2", limit="exec >/dev/full"), 1)
        self.assertIn("SimplexMesherCLI: stdout: ", text_of("out/p/surface.log"))
        self.assertEqual(self.mesher("--edgeLength", "2", "--quiet", limit="trap '' XFSZ; ulimit -f 1"), 1)
        self.assertIn("surface.vtp: ", text_of("out/p/surface.log"))

    def test_memory_that_no_machine_has(self):
        self.write_cube(200)
        self.assertEqual(self.mesher("--edgeLength", "0.25"), 0)
        with open("out/p/surface/run.json", encoding="utf-8") as file:
            run = json.load(file)
        self.assertEqual(run["status"], 1)
        self.assertRegex(run["error"], "[0-9]{4}.[0-9] GB of memory, found .* available")
        for line in (run["error"], "X: a.vtp: at these edge lengths it takes about 9e+03 million tetrahedra and 2e+03 "
                                   "GB of memory, found 9.1 GB available, expected longer edges"):
            for memory, is_result in ((1e9, True), (1e13, False)):
                with unittest.mock.patch("stage.memory_of_machine", return_value=memory):
                    self.assertEqual(stage.is_result(1, line), is_result, line)
        self.assert_is_said(" GB of memory, found ", "FuchsTetrahedralizer/Core/SurfacePreparation.cxx")

    def test_long_lines_are_shortened_in_the_table(self):
        for status in (1, 9):
            self.status_of("sh", "-c", f"printf 'X: %05000d' 7 >&2; exit {status}", name="scale")
            if status == 9:
                write_text("X: " + "7" * 5000, "out/p/scale.log")
            summary = [sys.executable, os.path.join(ROOT, "workflow", "scripts", "summary.py"), "out", "p"]
            subprocess.run(summary, stdout=subprocess.DEVNULL, check=True)
            row = read_summary()["p"]
            self.assertEqual((row["state"], len(row["error"])),
                             ("lost at scale" if status == 9 else "refused by scale", stage.LONGEST + len(" ...")))


class RefusalTest(unittest.TestCase):
    def setUp(self):
        clear_folder()

    def test_snakemake_says_it_in_one_line_and_makes_nothing(self):
        patient = {"map": "p0.nrrd", "targetPoint": "1,2"}
        for config, words in (({"folder": "out"}, "no patients"),
                              ({"folder": "out", "patients": {"p0": patient}}, "three numbers")):
            write_config(config)
            process = run()
            self.assertNotEqual(process.returncode, 0)
            self.assertRegex(process.stdout, rf"\Aconfiguration: .*{words}.*\n\Z")
            self.assertFalse(os.path.exists("out"))

    def assert_refused(self, config, *words):
        write_config(config)
        self.assert_one_line(*words)

    def assert_one_line(self, *words):
        """As the Snakefile reads it, without Snakemake, which takes a second to start."""
        programs = {"PATH": os.pathsep.join([BIN, os.environ["PATH"]])}
        with unittest.mock.patch.dict(os.environ, programs), self.assertRaises(ConfigurationError) as refusal:
            Cohort(read_configuration(["cohort.yaml"], {}, {}))
        for word in words:
            self.assertIn(word, str(refusal.exception))
        self.assertNotIn("\n", str(refusal.exception))

    def test_configurations(self):
        patient = {"map": "p0.nrrd", "targetPoint": "0,0,0"}
        self.assert_refused({"folder": "out"}, "no patients")
        self.assert_refused({"patients": {"p0": patient}, "output": "out"}, "unknown member output")
        self.assert_refused({"patients": {"p0": {**patient, "childRadus": 5}}}, "p0", "childRadus")
        self.assert_refused({"patients": {"p0": patient}, "options": {"threads": 1}}, "options", "threads")
        self.assert_refused({"patients": {"p0": {"targetPoint": "0,0,0"}}}, "p0 has no map")
        for name in ("../p0", "ben (2)", "müller", "-p", ".p"):
            self.assert_refused({"patients": {name: patient}}, repr(name))
        self.assert_refused({"patients": {"p0": patient}, "threads": 1.5}, "threads")
        self.assert_refused({"patients": {"p0": patient}, "pictures": "perhaps"}, "pictures", "true or false")
        self.assert_refused({"patients": {"p0": patient}, "pictures": ["no"]}, "pictures", "true or false")
        write_text("x", "a {b}.nrrd")
        self.assert_refused({"patients": {"p0": {**patient, "map": "a {b}.nrrd"}}}, "a {b}.nrrd", "without { and }")
        self.assert_refused({"patients": "a *.nrrd"}, "a {b}.nrrd", "without { and }")
        for folder in ("", "out/{patient}", ["out"]):
            self.assert_refused({"patients": {"p0": patient}, "folder": folder}, "folder")

    def test_options_of_other_types(self):
        patient = {"map": "p0.nrrd", "targetPoint": "0,0,0"}
        for name, value, expected in (("minimumEdgeLength", "abc", "a number from 0.01 to 100"),
                                      ("minimumEdgeLength", -1, "a number from 0.01 to 100"),
                                      ("followThickness", "perhaps", "true or false"),
                                      ("combine", "larger", "one of smaller, targets, path"),
                                      ("targetPoint", "1,2", "three numbers"),
                                      ("targets", {"a": "b"}, "a value or a list"),
                                      ("export", "/tmp/x.inp", "without a folder")):
            self.assert_refused({"patients": {"p0": {**patient, name: value}}}, "patient p0", name, expected)
            self.assert_refused({"patients": {"p0": patient}, "options": {name: value}}, "options", name, expected)

    def test_lists_of_patients(self):
        self.assert_refused({"patients": "nothing/*.nrrd"}, "nothing/*.nrrd", "no label map found")
        self.assert_refused({"patients": "nothing.csv"}, "nothing.csv")
        os.makedirs("bids")
        self.assert_refused({"patients": "bids"}, "bids", "no label map found")
        for text, word in (("name,map\n", "expected a header row"), ("patient,map\n1,a\n1,b\n", "1 is there twice"),
                           ("patient,map\n1,a,b\n", "3 fields, expected 2"), ("patient,map\n1,\n", "1 has no map")):
            with open("list.csv", "w", encoding="utf-8") as file:
                file.write(text)
            self.assert_refused({"patients": "list.csv"}, word)
        for name in ("a", "b"):
            os.makedirs(name)
            open(f"{name}/head.nii.gz", "wb").close()
        self.assert_refused({"patients": "*/head.nii.gz"}, "are both called head")
        for name in ("a b", "a+b"):
            open(f"{name}.nii", "wb").close()
        self.assert_refused({"patients": "*.nii"}, "a b.nii and a+b.nii are both called a_b")
        write_text("folder: out\npatients:\n  a: {map: a}\n  a: {map: b}\n")
        self.assert_one_line("a is there twice")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
