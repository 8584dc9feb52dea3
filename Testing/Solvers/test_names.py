"""Tests unusual tissue names, shells and null displacement, from the segmentation to every export and in solvers.

usage: test_names.py BIN OUTDIR
"""
import json
import os
import re
import shutil
import subprocess
import sys
import unittest
import xml.etree.ElementTree as xml

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, "workflow", "example"), os.path.join(ROOT, "Testing", "Python")]
from exported import READERS, meshio_read  # noqa: E402
from maps import cut_out, write_nrrd  # noqa: E402
from meshfiles import cell_array, read_dataset, read_mesh  # noqa: E402
from sidecar import Sidecar  # noqa: E402

BIN, OUTDIR = sys.argv[1:3]
SCRIPTS = os.path.dirname(os.path.abspath(__file__))
GRAMMAR = re.compile(r"[A-Za-z](_?[A-Za-z0-9])*")
NAMES = ["left caudate nucleus (head)", "Großhirnrinde, äußere", "N" * 200, "vessel", "Vessel", "vessel", "vessel 2",
         "5\" of dura 'mater'", "12 leading digits", "*ELSET, NSET=all", "<tissue> & \"co\"", "名前", "***",
         "outer boundary", "submesh_parent", "a/b\\c:d", "$EndPhysicalNames", "outside"]


def write_segmentation(file, labels, affine, names):
    """Writes an NRRD file with the names of the labels in its header, as Slicer does."""
    write_nrrd(file, labels, affine)
    with open(file, "rb") as stream:
        header, _, data = stream.read().partition(b"\n\n")
    lines = []
    for number, (label, name) in enumerate(names.items()):
        fields = {"ID": f"Segment_{label}", "LabelValue": label, "Layer": 0, "Name": name, "Color": "0.9 0.5 0.1"}
        lines += [f"Segment{number}_{key}:={value}" for key, value in fields.items()]
    with open(file, "wb") as stream:
        stream.write(header + ("\n" + "\n".join(lines)).encode() + b"\n\n" + data)


def run(module, *arguments):
    subprocess.run([os.path.join(BIN, module), *arguments], check=True, stdout=subprocess.DEVNULL)


def script(name, *arguments):
    done = subprocess.run([sys.executable, os.path.join(SCRIPTS, f"run_{name}.py"), *arguments],
                          stdin=subprocess.DEVNULL, capture_output=True, text=True)
    if done.returncode:
        raise AssertionError(f"run_{name}.py: {done.stdout[-2000:]}\n{done.stderr[-2000:]}")
    return [line.split() for line in done.stdout.splitlines()]


class NamesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(OUTDIR, ignore_errors=True)
        os.makedirs(OUTDIR)
        os.chdir(OUTDIR)
        labels, affine = cut_out(np.s_[64:84, 92:110, 32:50])
        cls.names = dict(zip((int(label) for label in np.setdiff1d(labels, [0])), NAMES))
        labels[~np.isin(labels, list(cls.names))] = 0
        write_segmentation("map.seg.nrrd", labels, affine, cls.names)
        center = affine @ [*(np.array(labels.shape) / 2), 1]
        with open("target.mrk.json", "w", encoding="ascii") as file:
            json.dump({"markups": [{"type": "Fiducial", "coordinateSystem": "LPS",
                                    "controlPoints": [{"position": list(center[:3])}]}]}, file)
        run("SurgicalPathScaleCLI", "--targets", "target.mrk.json", "--minimumEdgeLength", "1.5",
            "--maximumEdgeLength", "4", "--childRadius", "4", "--decayLength", "6", "map.seg.nrrd", "scale.nrrd")
        run("SimplexMesherCLI", "--scale", "scale.nrrd", "--ambient", "ambient.vtu", "map.seg.nrrd", "surface.vtp")
        shell = str(min(cls.names))
        run("FuchsTetrahedralizerCLI", "--scale", "scale.nrrd", "--ambient", "ambient.vtu", "--shell", shell,
            "--targets", "target.mrk.json", "--nonlinearDistance", "5", "--nullDisplacementRadius", "11",
            *(word for extension in (*READERS, "ply", "stl") for word in ("--export", "mesh." + extension)),
            "surface.vtp", "reference.vtu")
        cls.mesh = read_mesh("reference.vtu")
        cls.sidecar = Sidecar("mesh.inp")
        cls.sets = cls.sidecar.sets
        cls.tissues = {entry["ids"][0]: name for name, entry in cls.sets.items() if entry["kind"] == "tissue"}

    def test_sidecar_maps_valid_names_to_the_tissues_own(self):
        self.assertGreater(len(self.tissues), 12)
        self.assertEqual(set(self.tissues), set(np.unique(self.mesh.tissue)))
        self.assertEqual({label: self.sets[name]["original"] for label, name in self.tissues.items()},
                         {label: self.names[label] for label in self.tissues})

    def test_names_obey_the_grammar_and_differ(self):
        names = [*self.sets, *self.sidecar.materials]
        self.assertEqual(len({name.upper() for name in names}), len(names))
        for name in names:
            self.assertRegex(name, f"^{GRAMMAR.pattern}$")
            self.assertLessEqual(len(name), 80)

    def test_every_export_has_every_set_under_its_name(self):
        tetrahedra = {name: np.flatnonzero(self.mesh.tissue == label) for label, name in self.tissues.items()}
        surfaces = {name for name, entry in self.sets.items() if entry["type"] == "faces"}
        shells = {name for name, entry in self.sets.items() if entry["type"] == "shell"}
        self.assertEqual(len(shells), 1)
        for extension, read in READERS.items():
            with self.subTest(extension):
                file = read("mesh." + extension)
                for name, expected in tetrahedra.items():
                    if extension == "cdb" and len(name) > 32:  # over Ansys's limit: only both ends of a name are kept
                        (name,) = (n for n in file.cells if n[:8] == name[:8] and n[-8:] == name[-8:])
                        self.assertLessEqual(len(name), 32)
                    self.assertEqual(len(file.cells[name]), len(expected), name)
                if extension in ("inp", "feb"):
                    self.assertEqual(set(file.faces), surfaces)
                elif extension not in ("vtk", "vtu"):
                    self.assertLessEqual(set(file.faces) - shells, surfaces)
                    (shell,) = shells
                    elements = file.faces[shell] if shell in file.faces else file.cells[shell]
                    self.assertEqual(len(elements), self.sets[shell]["size"])

    def test_null_displacement_reaches_the_nodes(self):
        constitutive = cell_array(read_dataset("reference.vtu"), "Constitutive")
        self.assertEqual(set(constitutive), {0, 1, 2})
        still = self.mesh.points[np.unique(self.mesh.tetrahedra[constitutive == 2])]
        for extension in ("inp", "feb", "msh"):
            file = READERS[extension]("mesh." + extension)
            found = file.points[file.nodes["null_displacement_nodes"]]
            np.testing.assert_allclose(found[np.lexsort(found.T)], still[np.lexsort(still.T)], rtol=1e-12)
        medit = meshio_read("mesh.mesh")
        tag = self.sets["null_displacement_nodes"]["tag"]
        np.testing.assert_array_equal(medit.points[medit.point_data["medit:ref"] == tag], still)

    def test_shells_are_elements_under_their_name(self):
        (shell,) = (name for name, entry in self.sets.items() if entry["type"] == "shell")
        mesh = meshio_read("mesh.inp")
        self.assertIn(shell, mesh.cell_sets)
        self.assertEqual([len(block.data) for block in mesh.cells if block.type == "triangle"],
                         [self.sets[shell]["size"]])
        parts = {part.get("name"): part for part in xml.parse("mesh.feb").iterfind("Mesh/Elements")}
        self.assertEqual(len(parts[shell]), self.sets[shell]["size"])

    def test_surfaces_are_files_under_their_names(self):
        for extension in ("ply", "stl"):
            found = {name.split(".")[1] for name in os.listdir() if re.fullmatch(rf"mesh\.\w+\.{extension}", name)}
            self.assertEqual(found, set(self.tissues.values()))

    def ends(self):
        """Returns the names of three surfaces to clamp."""
        return [name for name, entry in self.sets.items()
                if entry["kind"] == "tissueInterface" and entry["ids"][1] == 0][:3]

    @unittest.skipUnless(shutil.which("ccx"), "ccx is not installed")
    def test_neo_hookean_tissue_is_linear_elastic_under_small_strain(self):
        run("FuchsTetrahedralizerCLI", "--scale", "scale.nrrd", "--ambient", "ambient.vtu", "--targets",
            "target.mrk.json", "--nonlinearDistance", "6", "--export", "soft.inp", "--export", "soft.msh2",
            "surface.vtp", "soft.vtu")
        self.assertEqual({material["law"] for material in Sidecar("soft.inp").materials.values()},
                         {"linear elastic", "neo-Hookean"})
        found = float(dict(script("calculix", "soft.inp", *self.ends()))["displacement"])
        linear = [line[1] for line in script("getfem", "soft.msh2", *self.ends()) if line[:1] == ["displacement"]]
        self.assertAlmostEqual(found / float(linear[0]), 1, delta=0.02)

    @unittest.skipUnless(shutil.which("ccx"), "ccx is not installed")
    def test_calculix_and_gmsh_read_the_names(self):
        figures = dict(script("calculix", "mesh.inp", *self.ends()))
        self.assertTrue(0 < float(figures["displacement"]) < 10, figures)
        for extension in ("msh", "msh2"):
            groups = [line for line in script("gmsh", "mesh." + extension) if line[0] == "group"]
            self.assertLessEqual(set(self.tissues.values()), {line[-1] for line in groups})


if __name__ == "__main__":
    outcome = unittest.main(argv=sys.argv[:1], exit=False).result
    for test, reason in outcome.skipped:
        print("skipped:", test, reason)
    sys.exit(1 if not outcome.wasSuccessful() else 77 if outcome.skipped else 0)
