"""Tests that OpenFOAM accepts the exported mesh with its tissues and boundaries. usage: test_openfoam.py EXPORTS

EXPORTS is the folder with the results of export_example.py. Without Debian's package openfoam, the status is 77.
"""
import os
import re
import shutil
import subprocess
import sys
import unittest

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, "workflow", "example"), os.path.join(ROOT, "Testing", "Python")]
from measures import signed_volumes  # noqa: E402
from meshfiles import read_mesh  # noqa: E402
from sidecar import Sidecar  # noqa: E402

EXPORTS = os.path.abspath(sys.argv[1])
CASE = os.path.join(EXPORTS, "openfoam")
SKIPPED = 77
SETTINGS = {
    "controlDict": "startFrom startTime; startTime 0; endTime 1; deltaT 1; writeInterval 1;",
    "createPatchDict": "pointSync false; patches ();",
    "fvSchemes": "gradSchemes { default Gauss linear; } divSchemes { default none; } laplacianSchemes { default none; } "
                 "ddtSchemes { default none; } interpolationSchemes { default linear; } snGradSchemes { default none; }",
    "fvSolution": "",
}


def foam(*command):
    done = subprocess.run(command, cwd=CASE, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, env={"WM_PROJECT_DIR": "/usr/share/openfoam", **os.environ})
    if done.returncode:
        raise AssertionError(f"{command}: {done.stdout[-3000:]}")
    return done.stdout


def entries(name):
    """Maps the names to the texts of the dictionaries that a file in polyMesh lists."""
    with open(os.path.join(CASE, "constant", "polyMesh", name), encoding="ascii") as file:
        content = file.read().split("* //")[1]  # the text after the header
    return dict(re.findall(r"^ *(\w+)\n *\{\n(.*?)^ *\}", content, re.M | re.S))


class OpenFoamTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.mesh = read_mesh(os.path.join(EXPORTS, "reference.vtu"))
        cls.sets = Sidecar(os.path.join(EXPORTS, "mesh.msh2")).sets
        shutil.rmtree(CASE, ignore_errors=True)
        os.makedirs(os.path.join(CASE, "system"))
        for name, content in SETTINGS.items():
            with open(os.path.join(CASE, "system", name), "w", encoding="ascii") as file:
                file.write(f"FoamFile {{ version 2.0; format ascii; class dictionary; object {name}; }}\n{content}\n")
        foam("gmshToFoam", os.path.join(EXPORTS, "mesh.msh2"))
        foam("createPatch", "-overwrite")
        cls.check = foam("checkMesh")

    def test_mesh_is_in_order(self):
        self.assertIn("Mesh OK.", self.check)
        self.assertIn(f"tetrahedra:    {len(self.mesh.tetrahedra)}\n", self.check)

    def test_tissues_are_cell_zones(self):
        rows = re.findall(r"^ +(tissue_\w+) +(\d+) +\d+ +([-+.e\d]+) +\(", self.check, re.M)
        labels = {name: entry["ids"][0] for name, entry in self.sets.items() if entry["kind"] == "tissue"}
        self.assertEqual({row[0] for row in rows}, set(labels))
        counts = np.bincount(self.mesh.tissue)
        volumes = np.bincount(self.mesh.tissue, weights=signed_volumes(self.mesh))
        for name, cells, volume in rows:
            self.assertEqual(int(cells), counts[labels[name]], name)
            self.assertAlmostEqual(float(volume) / volumes[labels[name]], 1, delta=1e-5, msg=name)

    def test_boundaries_are_patches_and_face_zones(self):
        with open(os.path.join(EXPORTS, "mesh.msh2"), encoding="ascii") as file:
            groups = {int(tag): name for tag, name in re.findall(r'^2 (\d+) "(\w+)"$', file.read(), re.M)}
        faces = {name: int(re.search(r"nFaces +(\d+);", text)[1]) for name, text in entries("boundary").items()}
        outer = set(faces)
        for name, text in entries("faceZones").items():
            faces[name] = faces.get(name, 0) + int(re.search(r"faceLabels +List<label> *\n?(\d+)", text)[1])
        interfaces = [(name, entry) for name, entry in self.sets.items() if "faceTags" in entry]
        self.assertGreater(len(interfaces), 100)
        for name, entry in interfaces:
            self.assertEqual(sum(faces[groups[tag]] for tag in entry["faceTags"]), entry["size"], name)
        self.assertEqual(outer, {name for name, entry in interfaces
                                 if entry["kind"] == "tissueInterface" and 0 in entry["ids"]})


if __name__ == "__main__":
    if not shutil.which("gmshToFoam"):
        print("skipped: OpenFOAM is not installed")
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1])
