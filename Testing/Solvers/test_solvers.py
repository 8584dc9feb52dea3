"""Tests that solvers open the exports and agree on how far a head sags. usage: test_solvers.py EXPORTS

EXPORTS is the folder with the results of export_example.py. Names the solvers that are not installed, and then ends
with status 77; CMake/debian-packages.txt lists them all.
"""
import importlib.util
import os
import shutil
import subprocess
import sys
import unittest
from concurrent.futures import ThreadPoolExecutor

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, "workflow", "example"), os.path.join(ROOT, "Testing", "Python")]
from meshfiles import read_mesh  # noqa: E402
from sagging_head import clamped_surfaces  # noqa: E402
from sidecar import Sidecar  # noqa: E402

EXPORTS = sys.argv[1]
SKIPPED = 77
PROGRAMS = {"calculix": ("inp", "ccx"), "fenicsx": ("xdmf", "dolfinx"), "freefem": ("mesh", "FreeFem++-nw"),
            "getfem": ("msh2", "getfem")}  # script: extension, and the program or Python module that it needs


def installed(name):
    return shutil.which(name) or importlib.util.find_spec(name)


def run(script, extension, *arguments):
    """Runs a script on an export and returns the words of each line that it prints."""
    environment = {**os.environ, "XDG_CACHE_HOME": os.path.join(EXPORTS, "cache"), "OMP_NUM_THREADS": "1"}
    done = subprocess.run([sys.executable, os.path.join(ROOT, "Testing", "Solvers", f"run_{script}.py"),
                           os.path.join(EXPORTS, "mesh." + extension), *arguments],
                          env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode:
        raise AssertionError(f"run_{script}.py: {done.stdout[-2000:]}\n{done.stderr[-2000:]}")
    return [line.split() for line in done.stdout.splitlines() if line.split()]


class SolversTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.mesh = read_mesh(os.path.join(EXPORTS, "reference.vtu"))
        cls.sets = Sidecar(os.path.join(EXPORTS, "mesh.inp")).sets
        clamped = clamped_surfaces(cls.mesh, cls.sets)
        jobs = {script: (extension, *clamped) for script, (extension, needs) in PROGRAMS.items() if installed(needs)}
        with ThreadPoolExecutor(2) as pool:
            started = {script: pool.submit(run, script, *arguments) for script, arguments in jobs.items()}
        cls.results = {script: dict(words for words in job.result() if len(words) == 2)
                       for script, job in started.items()}
        for script, found in cls.results.items():
            print(script, found)

    def result(self, script):
        if script not in self.results:
            self.skipTest(f"{PROGRAMS[script][1]} is not installed")
        return self.results[script]

    def test_calculix_finds_every_node_and_finite_displacements(self):
        result = self.result("calculix")
        self.assertEqual(int(result["nodes"]), len(self.mesh.points))
        self.assertTrue(0 < float(result["displacement"]) < 10, result)

    def test_others_find_the_mesh_and_its_tissues(self):
        for script in ("fenicsx", "freefem", "getfem"):
            with self.subTest(script):
                result = self.result(script)
                self.assertEqual(int(result["nodes"]), len(self.mesh.points))
                self.assertEqual(int(result["elements"]), len(self.mesh.tetrahedra))
                self.assertEqual(int(result["tissues"]), len(np.unique(self.mesh.tissue)))

    def test_all_find_the_same_displacement(self):
        """Compares solvers that each read another format and assemble their own equations, which shows that materials,
        tissues and clamped faces reach all of them."""
        displacements = {script: float(self.result(script)["displacement"]) for script in PROGRAMS}
        exact = displacements["getfem"]  # GetFEM uses a direct solver here; CalculiX's iterations end early
        for script, tolerance in (("fenicsx", 1e-6), ("freefem", 1e-6), ("calculix", 1e-4)):
            self.assertAlmostEqual(displacements[script] / exact, 1, delta=tolerance, msg=script)


class GmshTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not installed("gmsh"):
            raise unittest.SkipTest("gmsh is not installed")
        cls.mesh = read_mesh(os.path.join(EXPORTS, "reference.vtu"))
        cls.sets = Sidecar(os.path.join(EXPORTS, "mesh.msh")).sets

    def opened(self, extension):
        """Opens an export in Gmsh, which must have no complaints, and maps the name of every physical group to its
        dimension, tag and numbers of elements and nodes."""
        lines = run("gmsh", extension)
        figures = dict(words for words in lines if words[0] != "group")
        self.assertEqual(figures["complaints"], "0")
        self.assertGreater(float(figures["worst_quality"]), 0.05)
        return {name: tuple(map(int, numbers)) for word, *numbers, name in lines if word == "group"}

    def test_every_set_is_a_physical_group(self):
        """Tests version 4.1 of the format."""
        groups = self.opened("msh")
        dimension = {"elements": 3, "faces": 2, "shell": 2, "nodes": 0}
        expected = {name: (dimension[entry["type"]], entry["tag"], entry["size"])
                    for name, entry in self.sets.items() if "tag" in entry}
        second = [name for name in expected if name not in groups]
        self.assertEqual({name: numbers[:3] for name, numbers in groups.items()},
                         {name: numbers for name, numbers in expected.items() if name in groups})
        for name in second:  # the other side of an interface
            behind, front = self.sets[name]["ids"]
            self.assertLess(behind, front, name)
            self.assertIn(expected[name][:2], {numbers[:2] for numbers in groups.values()}, name)
        for name, entry in self.sets.items():
            if "nodes" in entry and name in groups:
                self.assertEqual(groups[name][3], self.sets[entry["nodes"]]["size"], name)

    def test_every_tissue_and_piece_is_a_physical_group(self):
        """Tests version 2.2 of the format."""
        groups = self.opened("msh2")
        tissues = {name: entry for name, entry in self.sets.items() if entry["kind"] == "tissue"}
        self.assertEqual({name: numbers[1:3] for name, numbers in groups.items() if numbers[0] == 3},
                         {name: (entry["ids"][0], entry["size"]) for name, entry in tissues.items()})
        pieces = {tag: elements for dimension, tag, elements, _ in groups.values() if dimension == 2}
        for name, entry in self.sets.items():
            if "faceTags" in entry:
                self.assertEqual(sum(pieces[tag] for tag in entry["faceTags"]), entry["size"], name)


if __name__ == "__main__":
    outcome = unittest.main(argv=sys.argv[:1], exit=False).result
    for test, reason in outcome.skipped:
        print("skipped:", test, reason)
    sys.exit(1 if not outcome.wasSuccessful() else SKIPPED if outcome.skipped else 0)
