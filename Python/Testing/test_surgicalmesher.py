"""The installed package: meshes of arrays and images, bytes as the program's, cancelled and refused.

usage: test_surgicalmesher.py SOURCE PROGRAMS OUTDIR, by the environment's Python
"""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import unittest
import unittest.mock
import warnings

import meshio
import nibabel
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData

import surgicalmesher
from surgicalmesher._label_map import label_map, write_map
from surgicalmesher._meshing import option_arguments

SOURCE, PROGRAMS, OUTDIR = (os.path.abspath(path) for path in sys.argv[1:4])
sys.path[:0] = [os.path.join(SOURCE, "Testing", "Python"), os.path.join(SOURCE, "workflow", "example")]
from maps import LPS_FROM_RAS, cut_out, write_nrrd  # noqa: E402
from meshfiles import read_nrrd  # noqa: E402

TARGET = (-4.0, 12.0, -7.0)
OPTIONS = {"minimumEdgeLength": 1.5, "maximumEdgeLength": 6, "minimumIslandVolume": np.float32(30)}
FLAGS = ("--target=-4,12,-7", "--minimumEdgeLength=1.5", "--maximumEdgeLength=6", "--minimumIslandVolume=30")
ROTATION = np.linalg.qr(np.array([[4.0, 1, 0.5], [-1, 3, 0.2], [0.3, -0.4, -2]]))[0]
LEFT_HANDED = ROTATION * np.sign(np.linalg.det(ROTATION)) * [1, 1, -1]
SPACING, ORIGIN = (1.0, 1.5, 2.0), (3.0, -40.0, 12.5)
COMMAND = os.path.join(os.path.dirname(sys.executable), "surgicalmesher")


def program(*arguments, command=os.path.join(PROGRAMS, "surgicalmesher")):
    done = subprocess.run([command, *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, check=False)
    assert done.returncode == 0, done.stdout


def bytes_of(file):
    with open(file, "rb") as stream:
        return stream.read()


def ball(size=12):
    """A ball of the label 2 in one of the label 5."""
    distance = np.linalg.norm(np.indices((size,) * 3) - (size - 1) / 2, axis=0)
    return np.where(distance < size / 4, 2, np.where(distance < size / 2.2, 5, 0)).astype(np.uint8)


def oblique_affine():
    affine = np.eye(4)
    affine[:3, :3] = LEFT_HANDED * SPACING
    affine[:3, 3] = ORIGIN
    return affine


def write_nifti(file, qform, sform, units="unknown", unit=1):
    """The ball, placed by forms of these codes; `unit` is how many of the units are a mm."""
    affine = np.diag([unit, unit, unit, 1]) @ LPS_FROM_RAS @ oblique_affine()
    image = nibabel.Nifti1Image(ball(), affine)
    image.set_qform(affine, qform)
    image.set_sform(affine, sform)
    image.header.set_xyzt_units(units)
    nibabel.save(image, file)


def vtk_image(labels, in_cells=False):
    image = vtkImageData()
    image.SetDimensions(*(np.array(labels.shape) + in_cells))
    image.SetSpacing(SPACING)
    image.SetDirectionMatrix(*LEFT_HANDED.ravel())
    image.SetOrigin(np.array(ORIGIN) - 0.5 * in_cells * (LEFT_HANDED @ SPACING))
    data = image.GetCellData() if in_cells else image.GetPointData()
    data.SetScalars(numpy_to_vtk(labels.ravel(order="F"), deep=True))
    return image


class LabelMapTest(unittest.TestCase):
    def setUp(self):
        self.labels = np.random.default_rng(4).integers(0, 300, (3, 4, 5))

    def assert_map(self, image, affine=None, **grid):
        found = label_map(image, *(grid.get(name) for name in ("spacing", "origin", "directions")))
        np.testing.assert_array_equal(found.labels, self.labels)
        np.testing.assert_allclose(found.affine, oblique_affine() if affine is None else affine, atol=1e-12)

    def test_array(self):
        self.assert_map(self.labels, np.eye(4))
        self.assert_map(self.labels.astype(float), spacing=SPACING, origin=ORIGIN, directions=LEFT_HANDED)
        self.assert_map(self.labels.tolist(), np.diag([2, 3, 4, 1]), spacing=[2, 3, 4])

    def test_masked_voxels_are_background(self):
        masked = np.ma.masked_array(self.labels, self.labels % 7 == 0)
        self.labels = np.where(self.labels % 7 == 0, 0, self.labels)
        self.assert_map(masked, np.eye(4))
        self.assertNotIsInstance(label_map(masked, None, None, None).labels, np.ma.MaskedArray)
        hidden = np.ma.masked_array(np.where(masked.mask, np.nan, self.labels), masked.mask)
        self.assert_map(hidden, np.eye(4))
        write_map(label_map(masked, None, None, None), masked, "masked.nrrd")
        self.addCleanup(os.remove, "masked.nrrd")
        np.testing.assert_array_equal(read_nrrd("masked.nrrd")[0], self.labels)

    def test_nibabel(self):
        self.assert_map(nibabel.Nifti1Image(self.labels.astype(np.int16), LPS_FROM_RAS @ oblique_affine()))
        self.assert_map(nibabel.Nifti1Image(self.labels[..., None].astype(np.int16), LPS_FROM_RAS @ oblique_affine()))

    def test_vtk(self):
        self.assert_map(vtk_image(self.labels))
        self.assert_map(vtk_image(self.labels, in_cells=True))

    def test_vtk_image_that_begins_elsewhere(self):
        image = vtk_image(self.labels)
        first = np.array([2, -1, 7])
        image.SetExtent(*np.column_stack([first, first + self.labels.shape - 1]).ravel())
        shift = np.eye(4)
        shift[:3, 3] = 2, -1, 7
        self.assert_map(image, oblique_affine() @ shift)

    def test_simpleitk(self):
        try:
            import SimpleITK
        except ImportError:
            self.skipTest("no SimpleITK")
        image = SimpleITK.GetImageFromArray(self.labels.T.astype(np.uint16))
        image.SetSpacing(SPACING)
        image.SetOrigin(ORIGIN)
        image.SetDirection(LEFT_HANDED.ravel())
        self.assert_map(image)

    def test_pyvista(self):
        try:
            import pyvista
        except ImportError:
            self.skipTest("no pyvista")
        self.assert_map(pyvista.wrap(vtk_image(self.labels)))

    def test_refused(self):
        for labels in (self.labels + 0.5, -self.labels, self.labels + 65500, self.labels[0], vtkImageData()):
            with self.assertRaisesRegex(ValueError, "^labels: .*expected"):
                label_map(labels, None, None, None)
        with self.assertRaisesRegex(ValueError, "^spacing: .*scaleSpacing"):
            label_map(vtk_image(self.labels), SPACING, None, None)
        with self.assertRaisesRegex(ValueError, "^origin: "):
            label_map(vtk_image(self.labels), None, ORIGIN, None)

    def test_refused_grids(self):
        for number in (np.nan, np.inf):
            for grid, name in (([(1, number, 1), None, None], "spacing"), ([None, (0, 0, number), None], "origin"),
                               ([None, None, np.diag([1, 1, number])], "directions")):
                with self.assertRaisesRegex(ValueError, f"^{name}: .*(nan|inf).*expected"):
                    label_map(self.labels, *grid)
            image = vtk_image(self.labels)
            image.SetOrigin(0, 0, number)
            with self.assertRaisesRegex(ValueError, "^labels: .*(nan|inf).*expected"):
                label_map(image, None, None, None)


class MeshingTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(OUTDIR, ignore_errors=True)
        os.makedirs(OUTDIR)
        os.chdir(OUTDIR)
        cls.labels, cls.affine = cut_out(np.s_[58:90, 84:116, 30:56])
        write_nrrd("map.nrrd", cls.labels, cls.affine)
        program("mesh", "map.nrrd", "out", *FLAGS)
        cls.events = []
        cls.mesh = surgicalmesher.mesh(cls.image(), targets=TARGET, **OPTIONS,
                                       progress=lambda share, stage: cls.events.append((share, stage)))

    def setUp(self):
        os.makedirs("scratch")
        self.before = os.environ.get("TMPDIR")
        self.set_scratch(os.path.abspath("scratch"))

    def tearDown(self):
        left = os.listdir("scratch")
        os.rmdir("scratch") if not left else shutil.rmtree("scratch")
        self.set_scratch(self.before)
        self.assertEqual(left, [])

    @staticmethod
    def set_scratch(folder):
        import tempfile

        os.environ.pop("TMPDIR", None)
        if folder:
            os.environ["TMPDIR"] = folder
        tempfile.tempdir = None

    @classmethod
    def image(cls):
        return nibabel.Nifti1Image(cls.labels, LPS_FROM_RAS @ cls.affine)

    def assert_programs_bytes(self, mesh):
        mesh.save("saved.vtu")
        self.assertEqual(bytes_of("saved.vtu"), bytes_of("out/mesh.vtu"))

    def test_bytes_are_the_programs(self):
        self.assert_programs_bytes(self.mesh)
        self.assert_programs_bytes(surgicalmesher.mesh(
            self.labels, origin=self.affine[:3, 3], directions=self.affine[:3, :3], targets=[TARGET], threads=1,
            **OPTIONS))
        self.assert_programs_bytes(surgicalmesher.mesh("map.nrrd", targetPoint=[TARGET], **OPTIONS))

    def test_nifti_is_taken_as_its_file(self):
        arguments = dict(preset="draft", targets=(5, 5, 5))
        for forms in ((1, 0), (0, 1), (0, 0), (0, 1, "micron", 1000), (0, 0, "micron", 1000),
                      (0, 1, "meter", 0.001), (1, 0, "meter", 0.001)):
            write_nifti("forms.nii.gz", *forms)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # the target is in some of the balls only
                theirs = surgicalmesher.mesh("forms.nii.gz", **arguments)
                ours = surgicalmesher.mesh(nibabel.load("forms.nii.gz"), **arguments)
            self.assertEqual(ours.vtu, theirs.vtu, forms)
            self.assertLess(np.ptp(ours.points, axis=0).max(), 30, forms)

    def test_nifti_without_an_affine(self):
        image = nibabel.Nifti1Image(ball(), None)
        arguments = dict(preset="draft", targets=(5, 5, 5))
        self.assertEqual(surgicalmesher.mesh(image, **arguments).vtu, surgicalmesher.mesh(ball(), **arguments).vtu)

    def test_arrays(self):
        corners = self.mesh.points[self.mesh.tetrahedra]
        volumes = np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6
        self.assertGreater(volumes.min(), 0)
        self.assertEqual(np.unique(self.mesh.tetrahedra).tolist(), list(range(len(self.mesh.points))))
        in_map = np.bincount(self.labels.ravel())
        in_mesh = np.bincount(self.mesh.tissue_labels, volumes, len(in_map))
        large = np.flatnonzero(in_map[1:] > 500) + 1
        self.assertGreater(len(large), 5)
        np.testing.assert_allclose(in_mesh[large], in_map[large], rtol=0.1)
        self.assertEqual(set(np.unique(self.mesh.tissue_labels)), set(self.mesh.tissue_names))
        self.assertEqual(set(self.mesh.tissue_names), set(self.mesh.tissue_colors))
        self.assertEqual(len(self.mesh.target_edge_length), len(self.mesh.points))
        child = self.mesh.points[self.mesh.tetrahedra[self.mesh.sub_mesh == 1]].mean(axis=(0, 1))
        self.assertLess(np.linalg.norm(child - TARGET), 5)
        np.testing.assert_array_equal(self.mesh.constitutive, self.mesh.sub_mesh > 0)

    def test_progress(self):
        shares = [share for share, _ in self.events]
        self.assertEqual((shares, shares[0], shares[-1]), (sorted(shares), 0, 1))
        self.assertTrue({"scale: reading", "surface: lattice", "mesh: checks"} <= {stage for _, stage in self.events})

    def test_other_formats(self):
        program("convert", "out/mesh.vtu", "theirs.inp")
        self.mesh.save("ours.inp")
        self.assertEqual(bytes_of("ours.inp"), bytes_of("theirs.inp"))
        self.assertEqual(len(meshio.read("ours.inp").cells_dict["tetra"]), len(self.mesh.tetrahedra))
        with self.assertRaisesRegex(surgicalmesher.MeshingError, "ours.xyz") as caught:
            self.mesh.save("ours.xyz")
        self.assertEqual((caught.exception.status, os.path.exists("ours.xyz")), (2, False))

    def test_names_with_commas(self):
        os.makedirs("Doe, John")
        for ours, theirs in (("Doe, John/ours.inp", "theirs.inp"), ("ours, too.inp", "theirs.inp"),
                             ("a,b.xdmf", "theirs.xdmf")):
            program("convert", "out/mesh.vtu", theirs)
            for _ in range(2):  # new, and there already
                self.mesh.save(ours)
                self.assertEqual(bytes_of(ours), bytes_of(theirs).replace(b"theirs.h5", b"a,b.h5"))
        self.assertEqual(len(meshio.read("a,b.xdmf").cells_dict["tetra"]), len(self.mesh.tetrahedra))
        self.mesh.save("c,d.stl")
        self.assertTrue(all(os.path.getsize(name) for name in os.listdir() if name.startswith("c,d")))
        for file, status in (("no,such/ours.inp", 1), ("a,b.xyz", 2)):
            with self.assertRaises(surgicalmesher.MeshingError) as caught:
                self.mesh.save(file)
            self.assertEqual((caught.exception.status, os.path.exists(file)), (status, False), file)
        with self.assertRaises(surgicalmesher.MeshingError):
            self.mesh.save("ours, too.inp", noSuchOption=1)
        self.assertEqual(bytes_of("ours, too.inp"), bytes_of("theirs.inp"))

    def test_names_that_are_not_utf8(self):
        program("convert", "out/mesh.vtu", "theirs.inp")
        for name in (b"caf\xe9.inp", b"caf\xe9.xdmf", "caf\u00e9.inp".encode()):
            self.mesh.save(os.fsdecode(name))
            self.assertGreater(os.path.getsize(name), 0)
        self.assertEqual(bytes_of(b"caf\xe9.inp"), bytes_of("theirs.inp"))
        write_nrrd("ball.nrrd", ball().astype(np.uint16), np.eye(4))
        os.replace("ball.nrrd", b"ball\xe9.nrrd")
        with self.assertRaisesRegex(surgicalmesher.MeshingError, "UTF-8 expected"):
            surgicalmesher.mesh(os.fsdecode(b"ball\xe9.nrrd"), targets=(5, 5, 5), preset="draft")
        figures = surgicalmesher.estimate(os.fsdecode(b"ball\xe9.nrrd"), targets=(5, 5, 5))
        self.assertEqual(figures, surgicalmesher.estimate(ball(), targets=(5, 5, 5)))

    def test_values_of_options(self):
        for options, words in ((dict(minimumEdgeLength=np.array(3)), ["--minimumEdgeLength=3"]),
                               (dict(threads=[np.array(1.5)]), ["--threads=1.5"]),
                               (dict(correctBias=np.array(True), noProximity=False), ["--correctBias"]),
                               (dict(proximity=(0.5, 1)), ["--proximity=0.5,1"]),
                               (dict(proximity=np.array([0.5, 1])), ["--proximity=0.5,1"]),
                               (dict(proximity="0,0"), ["--proximity=0,0"]),
                               (dict(export=["a.inp", "b.inp"]), ["--export=a.inp", "--export=b.inp"]),
                               (dict(targetPoint=[(1, 2, 3), (4, 5, 6)]),
                                ["--targetPoint=1,2,3", "--targetPoint=4,5,6"])):
            self.assertEqual(option_arguments("mesh", options), words)
        figures = surgicalmesher.mesh(ball(), targets=(5, 5, 5), preset="draft", proximity=(0.5, 1))
        self.assertEqual(set(figures.tissue_labels), {2, 5})

    def test_values_that_can_be_read_once(self):
        arguments = dict(targets=(5, 5, 5), preset="draft")
        mesh = surgicalmesher.mesh(ball(), **arguments, proximity=(0.5, 1), targetPoint=[(1, 2, 3), (9, 5, 5)])
        for targets in ((5, 5, 5), iter([(5, 5, 5)]), zip([5], [5], [5])):
            once = surgicalmesher.mesh(ball(), targets=targets, preset="draft", proximity=(x / 2 for x in (1, 2)),
                                       targetPoint=zip((1, 9), (2, 5), (3, 5)))
            self.assertEqual(once.vtu, mesh.vtu)
        with self.assertRaisesRegex(ValueError, "^export: .*folder="):
            surgicalmesher.mesh(ball(), **arguments, export=map(str, ["head.inp"]))
        figures = [surgicalmesher.estimate(ball(), targets=(5, 5, 5), targetPoint=points, minimumEdgeLength=0.5)
                   for points in (zip((1, 9), (2, 5), (3, 5)), [(1, 2, 3), (9, 5, 5)], [map(int, "123"), (9, 5, 5)])]
        self.assertEqual(figures[:2], figures[1:])

    def test_options_that_answer_questions(self):
        for name in ("help", "version", "xml", "echo"):
            for call in (lambda **more: surgicalmesher.mesh(ball(), targets=(5, 5, 5), **more),
                         lambda **more: surgicalmesher.estimate(ball(), targets=(5, 5, 5), **more),
                         lambda **more: self.mesh.save("saved.inp", **more)):
                with self.assertRaisesRegex(ValueError, f"^{name}: "):
                    call(**{name: True})
        with self.assertRaisesRegex(ValueError, "^progress: "):
            surgicalmesher.estimate(ball(), targets=(5, 5, 5), progress=print)

    def test_files_that_are_no_mesh_of_all_arrays(self):
        self.mesh.save("plain.vtu", elementOrder=1)
        self.mesh.save("second.vtu", elementOrder=2)
        with open("cut.vtu", "wb") as stream:
            stream.write(self.mesh.vtu[:2000])
        for file, words in (("plain.vtu", "no array TissueNames"), ("second.vtu", ".*of four points alone"),
                            ("cut.vtu", "")):
            with self.assertRaisesRegex(surgicalmesher.MeshingError, f"^{file}: {words}.*expected") as caught:
                surgicalmesher.read_mesh(file)
            self.assertEqual(caught.exception.status, 1)

    def test_meshio(self):
        self.mesh.to_meshio().write("meshio.vtu")
        back = meshio.read("meshio.vtu")
        np.testing.assert_array_equal(back.points, self.mesh.points)
        np.testing.assert_array_equal(back.cells_dict["tetra"], self.mesh.tetrahedra)
        np.testing.assert_array_equal(back.cell_data["TissueLabel"][0], self.mesh.tissue_labels)

    def test_pyvista(self):
        try:
            import pyvista  # noqa: F401
        except ImportError:
            self.skipTest("no pyvista")
        grid = self.mesh.to_pyvista()
        np.testing.assert_array_equal(grid.cells_dict[10], self.mesh.tetrahedra)
        np.testing.assert_array_equal(grid.cell_data["TissueLabel"], self.mesh.tissue_labels)

    def test_folder_stays_and_is_gone_on_from(self):
        arguments = dict(preset="draft", targets=[(5, 5, 5)], spacing=(1, 1, 1.5), folder="kept", export="ball.msh")
        first = surgicalmesher.mesh(ball(), **arguments)
        self.assertIn("report.html", os.listdir("kept"))
        self.assertIn("ball.msh", os.listdir("kept"))
        stamp = os.stat("kept/mesh.vtu").st_mtime_ns
        surgicalmesher.mesh(ball(), **arguments)
        self.assertEqual(os.stat("kept/mesh.vtu").st_mtime_ns, stamp)
        program("mesh", "--config", "kept/run.toml", "--threads", "1", command=COMMAND)
        self.assertEqual(bytes_of("kept/mesh.vtu"), first.vtu)
        other = surgicalmesher.mesh(ball() // 5, **arguments)
        self.assertEqual(set(other.tissue_labels), {1})

    def assert_map_stays(self, folder, call, error):
        before, names = bytes_of(f"{folder}/map.nrrd"), set(os.listdir(folder))
        with self.assertRaises(error):
            call()
        self.assertEqual(bytes_of(f"{folder}/map.nrrd"), before)
        self.assertEqual(set(os.listdir(folder)), names)

    def test_failed_run_leaves_the_earlier_map(self):
        def refused():
            surgicalmesher.mesh(ball() // 5, **arguments, noSuchOption=1)

        def cancelled():
            surgicalmesher.mesh(ball() // 5, **arguments, progress=cancel)

        def cancel(share, stage):
            raise InterruptedError(stage)

        arguments = dict(preset="draft", targets=(5, 5, 5), folder="again")
        os.makedirs("again")
        with open("again/map.nrrd", "wb") as stream:
            stream.write(b"the user's own")
        self.assert_map_stays("again", refused, surgicalmesher.MeshingError)
        self.assert_map_stays("again", cancelled, InterruptedError)
        mesh = surgicalmesher.mesh(ball(), **arguments)
        self.assertEqual([name for name in os.listdir("again") if name.startswith((".", "map"))], ["map.nrrd"])
        self.assert_map_stays("again", refused, surgicalmesher.MeshingError)
        program("mesh", "--config", "again/run.toml")
        self.assertEqual(bytes_of("again/mesh.vtu"), mesh.vtu)

    def test_failed_run_leaves_the_earlier_options(self):
        def cancel(share, stage):
            if stage.startswith("surface"):
                raise InterruptedError(stage)

        arguments = dict(preset="draft", targets=(5, 5, 5), folder="options")
        mesh = surgicalmesher.mesh(ball(), **arguments, maximumEdgeLength=4)
        before = bytes_of("options/run.toml")
        for more in (dict(maximumEdgeLength=6, progress=cancel), dict(maximumEdgeLength=6, noSuchOption=1)):
            with self.assertRaises((InterruptedError, surgicalmesher.MeshingError)):
                surgicalmesher.mesh(ball() // 5, **arguments, **more)
            self.assertEqual(bytes_of("options/run.toml"), before)
        program("mesh", "--config", "options/run.toml")
        self.assertEqual(bytes_of("options/mesh.vtu"), mesh.vtu)
        self.assertEqual([name for name in os.listdir("options") if name.startswith(".")], [])

    def test_killed_run_is_made_good_by_the_next_call(self):
        arguments = dict(preset="draft", targets=(5, 5, 5), folder="killed")
        surgicalmesher.mesh(ball(), **arguments)
        before = {name: bytes_of(f"killed/{name}") for name in ("map.nrrd", "run.toml")}
        script = ("import os, sys, numpy, surgicalmesher\n"
                  "def kill(share, stage):\n"
                  "    if stage.startswith('surface'):\n"
                  "        os.killpg(0, 9)\n"
                  "surgicalmesher.mesh(numpy.ones((9, 9, 9)), preset='draft', targets=(5, 5, 5), maximumEdgeLength=6,"
                  " folder='killed', progress=kill)")
        done = subprocess.run([sys.executable, "-c", script], start_new_session=True, check=False)
        self.assertEqual(done.returncode, -signal.SIGKILL)
        for left in os.listdir("scratch"):
            os.rmdir(os.path.join("scratch", left))
        for name, content in before.items():
            self.assertNotEqual(bytes_of(f"killed/{name}"), content)
        with self.assertRaises(surgicalmesher.MeshingError):
            surgicalmesher.mesh(ball(), **arguments, noSuchOption=1)
        self.assertEqual({name: bytes_of(f"killed/{name}") for name in before}, before)
        self.assertEqual([name for name in os.listdir("killed") if name.endswith((".map.nrrd", ".run.toml"))], [])

    def test_map_that_is_a_link_stays_one(self):
        os.makedirs("linked")
        os.makedirs("store")
        os.symlink("../store/labels.nrrd", "linked/map.nrrd")
        arguments = dict(preset="draft", targets=(5, 5, 5), folder="linked")
        for labels in (ball(), ball() // 5):  # of a link to nothing, and to a file
            surgicalmesher.mesh(labels, **arguments)
            self.assertEqual(os.readlink("linked/map.nrrd"), "../store/labels.nrrd")
            np.testing.assert_array_equal(read_nrrd("store/labels.nrrd")[0], labels)
        with self.assertRaises(surgicalmesher.MeshingError):
            surgicalmesher.mesh(ball(), **arguments, noSuchOption=1)
        np.testing.assert_array_equal(read_nrrd("store/labels.nrrd")[0], ball() // 5)
        self.assertEqual(os.readlink("linked/map.nrrd"), "../store/labels.nrrd")
        self.assertEqual(os.listdir("store"), ["labels.nrrd"])

    def test_file_systems_without_hard_links(self):
        arguments = dict(preset="draft", targets=(5, 5, 5), folder="unlinked")
        with unittest.mock.patch("os.link", side_effect=PermissionError):
            surgicalmesher.mesh(ball(), **arguments)
            before = {name: bytes_of(f"unlinked/{name}") for name in os.listdir("unlinked")}
            with self.assertRaises(surgicalmesher.MeshingError):
                surgicalmesher.mesh(ball() // 5, **arguments, noSuchOption=1)
        self.assertEqual({name: bytes_of(f"unlinked/{name}") for name in os.listdir("unlinked")}, before)

    def test_map_that_cannot_be_written(self):
        os.makedirs("taken/map.nrrd")
        with self.assertRaises(OSError):
            surgicalmesher.mesh(ball(), preset="draft", targets=(5, 5, 5), folder="taken")
        self.assertEqual(os.listdir("taken"), ["map.nrrd"])

    def test_images_own_file_is_not_overwritten(self):
        os.makedirs("case")
        write_nifti("case/map.nii", 1, 1)
        with open("case/map.nii", "rb") as stream:
            before = stream.read()
        with self.assertRaisesRegex(ValueError, "map.nii: the image's own file would be overwritten"):
            surgicalmesher.mesh(nibabel.load("case/map.nii"), preset="draft", targets=(5, 5, 5), folder="case")
        with open("case/map.nii", "rb") as stream:
            self.assertEqual(stream.read(), before)

    def test_spacing_of_the_scale_volume(self):
        surgicalmesher.mesh(ball(), preset="draft", targets=(5, 5, 5), spacing=(1, 1, 1.5), scaleSpacing=0.75,
                            folder="finer")
        with open("finer/scale.json", encoding="utf-8") as stream:
            self.assertEqual(json.load(stream)["parameters"]["spacing"], 0.75)
        with self.assertRaisesRegex(surgicalmesher.MeshingError, "spacing.*-1"):
            surgicalmesher.estimate(ball(), targets=(5, 5, 5), scaleSpacing=-1)

    def test_estimate(self):
        figures = surgicalmesher.estimate(self.image(), targets=TARGET, minimumEdgeLength=1.5, maximumEdgeLength=6)
        self.assertLess(abs(figures["tetrahedra"] / len(self.mesh.tetrahedra) - 1), 0.5)
        finer = surgicalmesher.estimate(self.image(), targets=TARGET, minimumEdgeLength=0.5, maximumEdgeLength=0.5)
        self.assertGreater(finer["memoryBytes"], 1.5 * figures["memoryBytes"])

    def test_warning(self):
        with self.assertWarnsRegex(surgicalmesher.MeshingWarning, "outside the label map") as caught:
            surgicalmesher.mesh(ball(), targets=(500, 0, 0), preset="draft")
        self.assertEqual(caught.filename, os.path.abspath(__file__))

    def assert_refused(self, status, words, labels, **arguments):
        with self.assertRaisesRegex(surgicalmesher.MeshingError, words) as caught:
            surgicalmesher.mesh(labels, **arguments)
        self.assertEqual((caught.exception.status, str(caught.exception).count("\n")), (status, 0))
        self.assertFalse(str(caught.exception).startswith("surgicalmesher"))

    def test_refused(self):
        self.assert_refused(1, "no-such-file.nrrd: no such file", "no-such-file.nrrd")
        self.assert_refused(2, "childRadius", ball(), childRadius=-1)
        self.assert_refused(2, "noSuchOption", ball(), noSuchOption=3)
        self.assert_refused(2, "preset", ball(), preset="finest")
        self.assert_refused(1, "", np.zeros((4, 4, 4)), folder="refused")
        self.assertFalse(os.path.exists("refused"))
        with self.assertRaisesRegex(ValueError, "^targets: "):
            surgicalmesher.mesh(ball(), targets=[1, 2])
        with self.assertRaisesRegex(ValueError, "^folder: '' found"):
            surgicalmesher.mesh(ball(), folder="")
        with self.assertRaisesRegex(ValueError, "^spacing.*scaleSpacing"):
            surgicalmesher.mesh("map.nrrd", spacing=(1, 1, 1))
        with self.assertRaisesRegex(surgicalmesher.MeshingError, "map.nrrd: "), warnings.catch_warnings():
            surgicalmesher.read_mesh("map.nrrd")

    def test_programs_that_do_not_start(self):
        os.makedirs("broken")
        with unittest.mock.patch.dict(os.environ, SURGICALMESHER_PROGRAMS=os.path.abspath("broken")):
            self.assert_refused(3, "broken/surgicalmesher: .*expected the program", ball(), proximity=(0.5, 1))
            for script, status, words in (
                    ("echo $0: error while loading shared libraries: libx.so: no such file >&2; exit 127", 127,
                     "error while loading shared libraries: libx.so"),
                    ("kill -9 $$", -9, "ended with status -9$")):
                self.write_script("broken/surgicalmesher", script)
                self.assert_refused(status, words, ball())
                self.assert_refused(status, words, ball(), proximity=(0.5, 1))  # for which the program is asked first
            self.write_script("broken/surgicalmesher", "echo '<executable>'")
            self.assert_refused(3, "broken/surgicalmesher: no XML", ball(), proximity=(0.5, 1))

    @staticmethod
    def write_script(file, commands):
        with open(file, "w", encoding="utf-8") as stream:
            stream.write(f"#!/bin/sh\n{commands}\n")
        os.chmod(file, 0o755)

    def test_outputs_that_would_go_with_the_folder(self):
        for outputs in (dict(export="head.inp"), dict(export=["new/head.inp", "head.msh"]),
                        dict(export="a.inp,b.inp"), dict(evolution="e.csv"), dict(parentMesh=pathlib.Path("p.vtu"))):
            with self.assertRaisesRegex(ValueError, f"^{list(outputs)[0]}: .*folder="):
                surgicalmesher.mesh(ball(), targets=(5, 5, 5), preset="draft", **outputs)
        os.makedirs("elsewhere")
        write_nrrd("ball.nrrd", ball().astype(np.uint16), np.eye(4))
        with open("names.ctbl", "w", encoding="utf-8") as stream:  # an output of one program, an input of this one
            stream.write("2 inner 255 0 0 255\n5 outer 0 255 0 255\n")
        mesh = surgicalmesher.mesh("ball.nrrd", targets=(5, 5, 5), preset="draft", names="names.ctbl",
                                   evolution="elsewhere/e.csv", export=["elsewhere/ball.inp"])
        self.assertEqual(mesh.tissue_names, {2: "inner", 5: "outer"})
        self.assertEqual(set(os.listdir("elsewhere")), {"e.csv", "ball.inp", "ball.inp.names.json"})
        os.makedirs("commas")
        surgicalmesher.mesh(ball(), targets=(5, 5, 5), preset="draft", export="commas/a,b.inp",
                            evolution="commas/e,f.csv")
        self.assertEqual(set(os.listdir("commas")), {"e,f.csv", "a,b.inp", "a,b.inp.names.json"})

    def test_callback_cancels(self):
        def refuse(share, stage):
            if stage.startswith("surface"):
                raise InterruptedError(stage)

        with self.assertRaises(InterruptedError):
            surgicalmesher.mesh(self.image(), targets=TARGET, progress=refuse, folder="cancelled")
        self.assertEqual(set(os.listdir("cancelled")), {"scale.nrrd", "scale.json", "stages.json"})

    def test_interrupt_leaves_nothing(self):
        script = ("import surgicalmesher\n"
                  "surgicalmesher.mesh('map.nrrd', targets=(-4, 12, -7), minimumEdgeLength=0.4,"
                  " progress=lambda share, stage: print(stage, flush=True))")
        child = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                 text=True, start_new_session=True)
        for line in child.stdout:
            if "surface: coarsening" in line:
                break
        self.assertEqual(len(os.listdir("scratch")), 1)
        child.send_signal(signal.SIGINT)
        errors = child.communicate()[1]
        self.assertIn("KeyboardInterrupt", errors)
        self.assertEqual(child.returncode, -signal.SIGINT)
        with self.assertRaises(ProcessLookupError):  # none of its processes is left
            os.killpg(child.pid, 0)

    def test_command(self):
        for words in ([COMMAND], [sys.executable, "-m", "surgicalmesher"]):
            version = subprocess.run([*words, "--version"], stdout=subprocess.PIPE, text=True, check=True).stdout
            self.assertIn("0.1.0", version)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
