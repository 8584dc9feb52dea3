"""A cohort of small real maps for tests, and what must hold of it after a run. Works in the current folder."""
import csv
import json
import os
import subprocess

import numpy as np

from maps import cut_out, write_nrrd

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
OPTIONS = {"minimumEdgeLength": 3, "maximumEdgeLength": 6, "childRadius": 5, "minimumIslandVolume": 30}


def write_cohort(count, damaged, pictures=True):
    """Maps p0, p1 ... of boxes of an atlas, number `damaged` cut off, and cohort.yaml (JSON is YAML)."""
    patients = {}
    for number in range(count):
        labels, affine = cut_out(np.s_[30 + 8 * number:54 + 8 * number, 86:110, 42:62])
        name = f"p{number}"
        write_nrrd(name + ".nrrd", labels, affine)
        target = (affine @ [12, 12, 10, 1])[:3]
        patients[name] = {"map": name + ".nrrd", "targetPoint": "%g,%g,%g" % tuple(target)}
    with open(f"p{damaged}.nrrd", "r+b") as file:
        file.truncate(os.path.getsize(file.name) // 2)
    write_config({"folder": "out", "pictures": pictures, "options": OPTIONS, "patients": patients})


def write_config(config):
    write_text(json.dumps(config))


def write_text(text, name="cohort.yaml"):
    """The file as it is."""
    with open(name, "w", encoding="utf-8") as file:
        file.write(text)


def read_config():
    with open("cohort.yaml", encoding="utf-8") as file:
        return json.load(file)


def run_snakemake(profile, modules, environment=(), root=ROOT, arguments=()):
    """The finished process, with all it said in stdout."""
    return subprocess.run(
        ["/usr/bin/snakemake", "--snakefile", os.path.join(root, "workflow", "Snakefile"), "--profile",
         os.path.join(root, "workflow", "profiles", profile), "--configfile", "cohort.yaml", *arguments],
        env={**os.environ, **dict(environment), "SURGICALMESHER_BIN": modules}, stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, timeout=600)


def read_summary(folder="out"):
    """Patient -> row of summary.csv."""
    with open(os.path.join(folder, "summary.csv"), encoding="utf-8", newline="") as file:
        return {row["patient"]: row for row in csv.DictReader(file)}


def all_files():
    """Path -> time of its last change, of everything in the cohort's folder."""
    paths = [os.path.join(folder, name) for folder, _, names in os.walk("out") for name in names]
    return {path: os.stat(path).st_mtime_ns for path in paths}


def assert_one_refused(test, refused):
    """All patients have a mesh but `refused`, whose line of the table says why."""
    rows = read_summary()
    test.assertEqual(set(rows), set(read_config()["patients"]))
    for patient, row in rows.items():
        mesh = os.path.join("out", patient, "mesh", "mesh.vtu")
        if patient == refused:
            test.assertFalse(os.path.exists(mesh))
            test.assertEqual(row["state"], "refused by scale")
            test.assertIn(refused + ".nrrd", row["error"])
            test.assertIn("truncated", row["error"])
        else:
            test.assertTrue(os.path.exists(mesh), row)
            test.assertEqual((row["state"], row["error"], row["wrongTissues"]), ("meshed", "", "0"))
            test.assertGreater(int(row["tetrahedra"]), 0)
