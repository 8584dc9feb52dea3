"""surgicalmesher: the bytes of the programs in a row, and what it adds to them.

usage: test_program.py BIN PAGES OUTDIR
"""
import base64
import glob
import html.parser
import io
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import time
import unittest

import nibabel
import numpy as np
from PIL import Image

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, "workflow", "example"), os.path.join(ROOT, "Testing", "Python")]
from maps import LPS_FROM_RAS, cut_out, write_nrrd  # noqa: E402
from measures import signed_volumes  # noqa: E402
from meshfiles import read_mesh  # noqa: E402

BIN, PAGES, OUTDIR = (os.path.abspath(path) for path in sys.argv[1:4])
TARGET = "-4,12,-7"
HEAD = "/usr/share/mricron/templates/ch2.nii.gz"
TRAINING = os.path.join(ROOT, "workflow", "from-image", "training.mrk.json")
SELLA = "0,-7,-29"
COARSE = ("--minimumEdgeLength", "8", "--maximumEdgeLength", "20")
TISSUE_OF_NONE = "label,maximumEdgeLength\n4242,2\n"  # which the surface stage refuses
SIZES = ("--minimumEdgeLength", "3", "--maximumEdgeLength", "6", "--childRadius", "4")


def run(*arguments):
    return subprocess.run([os.path.join(BIN, arguments[0]), *arguments[1:]], stdin=subprocess.DEVNULL, text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)


def surgicalmesher(*arguments):
    return run("surgicalmesher", *arguments)


def bytes_of(file):
    with open(file, "rb") as stream:
        return stream.read()


def run_three_programs(folder):
    os.makedirs(folder)
    inside = lambda name: os.path.join(folder, name)
    for command in (
            ("SurgicalPathScaleCLI", "--targetPoint", TARGET, *SIZES, "map.nrrd", inside("scale.nrrd")),
            ("SimplexMesherCLI", "--minimumIslandVolume", "30", "--scale", inside("scale.nrrd"), "--preparedLabelMap",
             inside("prepared.nrrd"), "--ambient", inside("ambient.vtu"), "map.nrrd", inside("surface.vtp")),
            ("FuchsTetrahedralizerCLI", "--scale", inside("scale.nrrd"), "--ambient", inside("ambient.vtu"), "--export",
             inside("head.inp"), inside("surface.vtp"), inside("mesh.vtu"))):
        done = run(*command)
        assert done.returncode == 0, done.stderr


def write_coarse_head(file, step=4):
    """The T1 of Colin27, its voxels averaged by cubes of `step`."""
    head = nibabel.load(HEAD)
    count = [n // step for n in head.shape]
    fine = np.asanyarray(head.dataobj)[tuple(slice(n * step) for n in count)].astype(float)
    coarse = fine.reshape(*(part for n in count for part in (n, step))).mean(axis=(1, 3, 5))
    enlarged = np.diag([step, step, step, 1.0])
    enlarged[:3, 3] = (step - 1) / 2
    write_nrrd(file, np.rint(coarse).astype(np.uint16), LPS_FROM_RAS @ head.affine @ enlarged)


def run_four_programs(folder):
    os.makedirs(folder)
    inside = lambda name: os.path.join(folder, name)
    names = ("--names", inside("tissues.ctbl"))
    for command in (
            ("TissueMapperCLI", "--training", TRAINING, *names, "head.nrrd", inside("tissues.nrrd")),
            ("SurgicalPathScaleCLI", "--targetPoint", SELLA, *COARSE, *names, inside("tissues.nrrd"),
             inside("scale.nrrd")),
            ("SimplexMesherCLI", "--minimumIslandVolume", "4000", *names, "--scale", inside("scale.nrrd"),
             "--preparedLabelMap", inside("prepared.nrrd"), "--ambient", inside("ambient.vtu"), inside("tissues.nrrd"),
             inside("surface.vtp")),
            ("FuchsTetrahedralizerCLI", "--scale", inside("scale.nrrd"), "--ambient", inside("ambient.vtu"),
             inside("surface.vtp"), inside("mesh.vtu"))):
        done = run(*command)
        assert done.returncode == 0, done.stderr


def write_hexahedra(file):
    """Two unit cubes of the labels 3 and 7, as a legacy VTK file."""
    points = [(x, y, z) for x in range(3) for y in range(2) for z in range(2)]
    number = {point: n for n, point in enumerate(points)}
    corners = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
    cells = [[number[x + dx, dy, dz] for dx, dy, dz in corners] for x in range(2)]
    with open(file, "w", encoding="ascii") as stream:
        stream.write("# vtk DataFile Version 3.0\ncubes\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 12 double\n")
        stream.writelines("%d %d %d\n" % point for point in points)
        stream.write("CELLS 2 18\n" + "".join("8 " + " ".join(map(str, cell)) + "\n" for cell in cells))
        stream.write("CELL_TYPES 2\n12\n12\nCELL_DATA 2\nSCALARS TissueLabel int 1\nLOOKUP_TABLE default\n3\n7\n")


def write_cube(file, length):
    """Twelve triangles, as ASCII STL."""
    corners = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]) * length
    squares = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    with open(file, "w", encoding="ascii") as stream:
        stream.write("solid cube\n")
        for a, b, c, d in squares:
            for triangle in ((a, b, c), (a, c, d)):
                stream.write("facet normal 0 0 0\nouter loop\n")
                stream.writelines("vertex %g %g %g\n" % tuple(corners[n]) for n in triangle)
                stream.write("endloop\nendfacet\n")
        stream.write("endsolid cube\n")


class Page(html.parser.HTMLParser):
    """What a page links to, its table rows, and its text."""

    def __init__(self, text):
        super().__init__()
        self.links, self.rows, self.open, self.text = [], 0, [], ""
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.links += [value for name, value in attrs if name in ("href", "src")]
        self.rows += tag == "tr"
        if tag not in ("meta", "br", "image", "path", "i"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        if tag not in ("image", "path", "i"):
            assert self.open.pop() == tag, tag

    def handle_data(self, data):
        self.text += data


class ProgramTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        os.environ.pop("DISPLAY", None)
        shutil.rmtree(OUTDIR, ignore_errors=True)
        os.makedirs(OUTDIR)
        os.chdir(OUTDIR)
        labels, affine = cut_out(np.s_[58:90, 84:116, 30:56])
        write_nrrd("map.nrrd", labels, affine)
        run_three_programs("three")
        cls.command = ("mesh", "map.nrrd", "out", "--target", TARGET, *SIZES, "--minimumIslandVolume", "30", "--export",
                       "head.inp")
        done = surgicalmesher(*cls.command)
        assert done.returncode == 0, done.stderr
        cls.first = done.stdout

    def assert_same_as_three_programs(self, folder):
        for name in ("scale.nrrd", "prepared.nrrd", "surface.vtp", "ambient.vtu", "mesh.vtu"):
            self.assertEqual(bytes_of(os.path.join(folder, name)), bytes_of(os.path.join("three", name)), name)

    def assert_refused(self, status, words, *arguments):
        before = sorted(glob.glob("**", recursive=True))
        done = surgicalmesher(*arguments)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (status, 1), done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)
        self.assertEqual(sorted(glob.glob("**", recursive=True)), before)

    def test_bytes_are_those_of_the_three_programs(self):
        self.assert_same_as_three_programs("out")
        self.assertEqual(bytes_of("out/head.inp"), bytes_of("three/head.inp"))

    def test_what_has_not_changed_is_not_run_again(self):
        shutil.copytree("out", "again")
        command = [word if word != "out" else "again" for word in self.command]
        stamps = {file: os.stat(file).st_mtime_ns for file in glob.glob("again/*.vt*")}
        self.assertEqual(surgicalmesher(*command, "--threads", "1").stdout.count("nothing has changed"), 3)
        self.assertEqual({file: os.stat(file).st_mtime_ns for file in stamps}, stamps)
        with open("again/mesh.vtu", "r+b") as stream:
            stream.truncate(1000)
        self.assertEqual(surgicalmesher(*command).stdout.count("nothing has changed"), 2)
        self.assert_same_as_three_programs("again")
        done = surgicalmesher(*command, "--nonlinearDistance", "5")
        self.assertEqual((done.returncode, done.stdout.count("nothing has changed")), (0, 2), done.stderr)
        self.assertNotEqual(bytes_of("again/mesh.vtu"), bytes_of("out/mesh.vtu"))

    def test_json_tells_which_files_were_written(self):
        command = self.command_into("told", "--progress", "json", "--export", "head.stl")
        for anew in (True, False):
            events = [json.loads(line) for line in surgicalmesher(*command).stdout.splitlines()]
            told = [event["output"] for event in events if "output" in event]
            names = os.listdir("told") if anew else ["report.html", "run.toml"]
            self.assertEqual(sorted(told), sorted(os.path.abspath(f"told/{name}") for name in names))
        piece = (set(glob.glob("told/head*.stl")) - {"told/head.stl"}).pop()
        self.files_that_are_not_utf8_are_found(os.path.basename(piece))

    def files_that_are_not_utf8_are_found(self, piece):
        os.makedirs("linked")
        latin = os.fsdecode(b"linked/m\xfcller.stl")
        os.symlink(os.path.basename(latin), f"linked/{piece}")
        command = self.command_into("linked", "--progress", "json", "--export", "head.stl")
        events = [json.loads(line) for line in surgicalmesher(*command).stdout.splitlines()]
        self.assertIn(os.path.abspath(latin), [event.get("output") for event in events])
        with open(latin, "ab") as file:
            file.write(b"more")
        self.assertEqual(surgicalmesher(*command).stdout.count("nothing has changed"), 2)
        self.assertFalse(bytes_of(latin).endswith(b"more"))

    def command_into(self, folder, *more):
        return [word if word != "out" else folder for word in self.command[:-2]] + list(more)

    def test_files_of_the_users_in_the_folder_stay(self):
        os.makedirs("mine")
        command = [os.path.join(BIN, "surgicalmesher"), *self.command_into("mine", "--export", "a.stl")]
        for _ in range(2):
            with open("mine/log.txt", "a", encoding="utf-8") as log:
                subprocess.run(command, stdin=subprocess.DEVNULL, stdout=log, check=True)
        self.assertEqual(bytes_of("mine/log.txt").decode().count("nothing has changed"), 3)
        shutil.copy("mine/a.stl", "mine/a.mine.stl")
        pieces = set(glob.glob("mine/a.*")) - {"mine/a.mine.stl"}
        self.assertGreater(len(pieces), 3)  # the names, the whole and one for each tissue
        done = surgicalmesher(*self.command_into("mine"))
        self.assertEqual((done.returncode, done.stdout.count("nothing has changed")), (0, 2), done.stderr)
        self.assertEqual(glob.glob("mine/a.*"), ["mine/a.mine.stl"])
        self.assertTrue(os.path.exists("mine/log.txt"))

    def test_a_rerun_that_fails_leaves_nothing_that_does_not_fit(self):
        shutil.copytree("out", "failed")
        with open("absent.csv", "w", encoding="ascii") as file:
            file.write(TISSUE_OF_NONE)
        done = surgicalmesher("mesh", "--config", "failed/run.toml", "--childRadius", "3", "--tissues", "absent.csv")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertFalse(set(os.listdir("failed")) & {"report.html", "mesh.vtu", "surface.vtp", "head.inp"})
        self.assertIn("childRadius = 3\n", bytes_of("failed/run.toml").decode())

    def files_in(self, folder):
        return {name: (bytes_of(f"{folder}/{name}"), os.stat(f"{folder}/{name}").st_mtime_ns)
                for name in os.listdir(folder)}

    def test_a_mistake_costs_no_finished_run(self):
        shutil.copytree("out", "kept")
        before = self.files_in("kept")
        with open("absent.csv", "w", encoding="ascii") as file:
            file.write(TISSUE_OF_NONE)
        command = self.command_into("kept", "--export", "head.inp")
        target = command.index("--target")
        for words in (command[:target] + command[target + 2:],
                      [*command, "--nullDisplacementRadius", "3", "--nullDisplacementTissues", "nobody"],
                      [*command, "--tissues", "absent.csv"],
                      ["mesh", "map.nrrd", "kept", "--target", TARGET, "--minimumEdgeLength", "9",
                       "--maximumEdgeLength", "3"]):
            done = surgicalmesher(*words)
            self.assertIn(done.returncode, (1, 2), done.stderr)
            self.assertEqual(self.files_in("kept"), before, words)
        done = surgicalmesher(*command)
        self.assertEqual((done.returncode, done.stdout.count("nothing has changed")), (0, 3), done.stderr)

    def test_what_ends_a_rerun_leaves_the_earlier_run(self):
        for how in (signal.SIGINT, signal.SIGKILL):
            folder = f"whole{how}"
            shutil.copytree("out", folder)
            before = self.files_in(folder)
            command = [os.path.join(BIN, "surgicalmesher"), *self.command_into(folder, "--maximumDistance", "0.3")]
            with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as process:
                for line in process.stdout:
                    if "surface: " in line:
                        break
                process.send_signal(how)
            self.assertEqual(process.returncode, -how)
            after = self.files_in(folder)
            self.assertEqual({name: after.get(name) for name in before}, before)
            self.assertEqual(surgicalmesher(*command[1:]).returncode, 0)
            self.assertEqual(set(os.listdir(folder)), {name for name in before if not name.startswith("head.inp")})

    def test_an_input_in_the_folder_stays_by_whatever_path(self):
        os.makedirs("real")
        os.symlink("real", "link")
        shutil.copy("map.nrrd", "ref.nrrd")
        null = ("--nullDisplacementRadius", "6")
        done = surgicalmesher("mesh", "ref.nrrd", "real", "--target", TARGET, *COARSE, *null)
        self.assertEqual(done.returncode, 0, done.stderr)
        labels = bytes_of("real/labels.nrrd")
        for arguments in (("real/labels.nrrd", "link"), ("link/labels.nrrd", "real")):
            done = surgicalmesher("mesh", *arguments, "--target", TARGET, *COARSE)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(bytes_of("real/labels.nrrd"), labels)
            done = surgicalmesher("mesh", "ref.nrrd", "real", "--target", TARGET, *COARSE, *null)
            self.assertEqual(done.returncode, 0, done.stderr)

    def test_names_of_exports_are_kept(self):
        os.makedirs("odd")
        names = ["odd/a\"b.inp", "odd/c,d.inp", "odd/g, h.k"]
        done = surgicalmesher(*self.command_into("oddly"), *[word for name in names for word in ("--export", name)])
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in names:
            self.assertTrue(os.path.exists(name), name)
            os.remove(name)
        for name in names[0], names[2]:
            done = surgicalmesher("convert", "out/mesh.vtu", name)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue(os.path.exists(name), name)

    def test_a_caller_that_ignores_the_ends_of_its_children(self):
        ignore = lambda: signal.signal(signal.SIGCHLD, signal.SIG_IGN)
        scale = ["SurgicalPathScaleCLI", "--targetPoint", TARGET, *SIZES, "map.nrrd", "ignored.nrrd"]
        for program, *arguments in (scale, ["surgicalmesher", *self.command_into("ignored", "--export", "head.inp")]):
            done = subprocess.run([os.path.join(BIN, program), *arguments], stdout=subprocess.DEVNULL,
                                  stderr=subprocess.PIPE, text=True, check=False, preexec_fn=ignore)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(bytes_of("ignored/mesh.vtu"), bytes_of("out/mesh.vtu"))

    def test_the_programs_are_found_whatever_this_one_is_called(self):
        done = subprocess.run(["bash", "-c", 'exec -a anything "$@"', "bash", os.path.join(BIN, "surgicalmesher"),
                               "estimate", "map.nrrd", "--target", TARGET, *SIZES], stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def estimate_in(self, place, how=None):
        """Status and errors of an estimate with its temporary files in `place`, ended by a signal in the first stage."""
        command = [os.path.join(BIN, "surgicalmesher"), "estimate", "map.nrrd", "--target", TARGET,
                   "--minimumEdgeLength", "0.5", "--maximumEdgeLength", "0.5", "--spacing", "0.5", "--estimate",
                   "ended.json"]
        with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              text=True, env=dict(os.environ, TMPDIR=place)) as process:
            for line in process.stdout:
                if how and "scale: " in line:
                    process.send_signal(how)
                    break
            if how == signal.SIGPIPE:
                process.stdout.close()
            errors = process.stderr.read()
        return process.returncode, errors

    def test_an_estimate_leaves_nothing_behind(self):
        os.makedirs("scratch")
        words = {signal.SIGINT: "interrupted", signal.SIGTERM: "told to end", signal.SIGHUP: "hung up on"}
        for how in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGPIPE):
            told = f"surgicalmesher estimate: {words[how]}, no output was written\n" if how in words else ""
            self.assertEqual(self.estimate_in(os.path.abspath("scratch"), how), (-how, told))
            self.assertEqual((os.listdir("scratch"), glob.glob(".ended*")), ([], []))
        self.assertEqual(self.estimate_in(os.path.abspath("scratch"), signal.SIGKILL)[0], -signal.SIGKILL)
        left = os.listdir("scratch")
        self.assertEqual(len(left), 1)
        os.makedirs("scratch/surgicalmesher-mine")
        self.assertEqual(self.estimate_in(os.path.abspath("scratch")), (0, ""))
        self.assertEqual(os.listdir("scratch"), ["surgicalmesher-mine"])
        os.remove("ended.json")

    def test_no_place_for_temporary_files(self):
        for place in ("/nowhere", os.path.abspath("map.nrrd"), "/proc"):
            status, errors = self.estimate_in(place)
            self.assertEqual((status, errors.count("\n")), (1, 1), errors)
            self.assertIn("TMPDIR: ", errors)
            self.assertIn(place, errors)

    def test_a_first_run_that_fails_leaves_files_of_the_users(self):
        os.makedirs("first")
        mine = {"report.html": "mine", "run.toml": f'labelMap = "../map.nrrd"\nfolder = "."\ntissues = "tissues.csv"\n'
                                                   f"targetPoint = [{TARGET}]\n", "tissues.csv": TISSUE_OF_NONE}
        for name, text in mine.items():
            with open(f"first/{name}", "w", encoding="ascii") as file:
                file.write(text)
        self.assertEqual(surgicalmesher("mesh", "--config", "first/run.toml").returncode, 1)
        with open("first/stages.json", encoding="utf-8") as file:
            self.assertEqual(list(json.load(file)), ["scale"])
        self.assertEqual({name: bytes_of(f"first/{name}").decode() for name in mine}, mine)

    def test_only_data_of_a_header_are_inputs_beside_it(self):
        os.makedirs("beside")
        image = nibabel.Nifti1Pair(np.asarray(cut_out(np.s_[58:90, 84:116, 30:56])[0]).astype(np.uint8), np.eye(4))
        nibabel.save(image, "beside/pat.hdr")
        for name in ("beside/pat.hdr", "map.nrrd"):
            stem = os.path.splitext(name)[0]
            command = ("mesh", name, "of-" + os.path.basename(stem), "--target", "10,10,10", *COARSE)
            self.assertEqual(surgicalmesher(*command).returncode, 0)
            with open(stem + ".log", "w", encoding="ascii") as file:
                file.write("mine")
            self.assertEqual(surgicalmesher(*command).stdout.count("nothing has changed"), 3)
        os.remove("map.log")
        with open("of-pat/stages.json", encoding="utf-8") as file:
            names = {os.path.basename(path) for path in json.load(file)["scale"]["inputs"]}
        self.assertEqual(names, {"pat.hdr", "pat.img"})

    def test_help_promises_lists_of_files_where_there_are_some(self):
        text = " ".join(surgicalmesher("mesh", "--help").stdout.split())
        targets = text[text.index("--targets "):text.index("--path ")]
        export = text[text.index("--export "):text.index("--elementOrder ")]
        self.assertIn("separate files by commas for several", targets)
        self.assertIn("repeat the flag for several", export)

    def test_data_of_a_header_may_have_any_name(self):
        labels = np.asarray(cut_out(np.s_[58:90, 84:116, 30:56])[0]).astype(np.uint8)
        for data in ("pat.01.raw", "pat.001", "other.raw"):
            folder = "named-" + data
            os.makedirs(folder)
            header = ("NRRD0004\ntype: unsigned char\ndimension: 3\nspace: left-posterior-superior\nsizes: %d %d %d\n"
                      "space directions: (1,0,0) (0,1,0) (0,0,1)\nencoding: raw\nspace origin: (0,0,0)\n"
                      "data file: %s\n" % (*labels.shape, data))
            with open(f"{folder}/pat.01.nhdr", "w", encoding="ascii") as file:
                file.write(header)
            labels.tofile(f"{folder}/{data}")
            command = ("mesh", f"{folder}/pat.01.nhdr", f"{folder}/results", "--target", "10,10,10", *COARSE, "--export",
                       f"{folder}/pat.inp")
            self.assertEqual(surgicalmesher(*command).returncode, 0)
            with open(f"{folder}/pat.01.log", "w", encoding="ascii") as file:
                file.write("mine")
            self.assertEqual(surgicalmesher(*command).stdout.count("nothing has changed"), 3)
            np.flip(labels, 0).tofile(f"{folder}/{data}")
            done = surgicalmesher(*command)
            self.assertEqual((done.returncode, done.stdout.count("nothing has changed")), (0, 0), done.stderr)

    def test_a_working_directory_that_is_gone(self):
        for arguments in (("mesh", os.path.abspath("map.nrrd"), "new", "--target", TARGET),
                          ("mesh", "--config", "run.toml"), ("estimate", "map.nrrd", "--target", TARGET)):
            os.makedirs("gone")
            command = ["bash", "-c", 'cd gone && rmdir ../gone && exec "$@"', "bash", os.path.join(BIN, "surgicalmesher")]
            done = subprocess.run([*command, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                  check=False)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)

    def test_a_run_is_repeated_by_its_configuration(self):
        done = surgicalmesher("mesh", "--config", "out/run.toml", "repeated")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_same_as_three_programs("repeated")
        with open("repeated/run.toml", encoding="utf-8") as file:
            self.assertEqual(file.read(), bytes_of("out/run.toml").decode())
        done = surgicalmesher("mesh", "--config", "repeated/run.toml")
        self.assertEqual((done.returncode, done.stdout.count("nothing has changed")), (0, 3), done.stderr)

    def test_configuration_holds_any_name_of_a_file(self):
        os.makedirs("line\nend")
        shutil.copy("map.nrrd", 'line\nend/"map"\x7f.nrrd')
        command = ("mesh", 'line\nend/"map"\x7f.nrrd', "two\nlines", "--target", TARGET, *COARSE)
        done = surgicalmesher(*command)
        self.assertEqual(done.returncode, 0, done.stderr)
        done = surgicalmesher("mesh", "--config", "two\nlines/run.toml")
        self.assertEqual((done.returncode, done.stdout.count("nothing has changed")), (0, 3), done.stderr)
        latin = os.fsdecode(b"m\xfcller.nrrd")
        shutil.copy("map.nrrd", latin)
        self.assert_refused(2, ["m\\xfcller.nrrd", "UTF-8 expected"], "mesh", latin, "new", "--target", TARGET)
        os.remove(latin)

    def test_configuration_of_a_finished_run_reruns_nothing(self):
        shutil.copytree("out", "resumed")
        before = {name: bytes_of(f"resumed/{name}") for name in os.listdir("resumed") if name.endswith((".vtu", ".vtp", ".nrrd"))}
        done = surgicalmesher("mesh", "--config", "resumed/run.toml", "resumed")
        self.assertEqual((done.returncode, done.stdout.count("nothing has changed")), (0, 3), done.stderr)
        self.assertEqual({name: bytes_of(f"resumed/{name}") for name in before}, before)

    def test_configuration_in_a_copied_folder_is_of_the_copy(self):
        shutil.copytree("out", "copied")
        stamps = {file: os.stat(file).st_mtime_ns for file in glob.glob("out/*")}
        done = surgicalmesher("mesh", "--config", "copied/run.toml")
        self.assertEqual((done.returncode, done.stdout.count("nothing has changed")), (0, 3), done.stderr)
        self.assertIn(os.path.abspath("copied/report.html"), done.stdout)
        self.assertEqual({file: os.stat(file).st_mtime_ns for file in stamps}, stamps)

    def test_export_with_a_folder_lies_there(self):
        shutil.copytree("out", "elsewhere")
        os.makedirs("exported")
        command = [word if word != "out" else "elsewhere" for word in self.command]
        done = surgicalmesher(*command[:-1], "exported/head.inp")
        self.assertEqual((done.returncode, done.stdout.count("nothing has changed")), (0, 2), done.stderr)
        self.assertEqual(bytes_of("exported/head.inp"), bytes_of("out/head.inp"))
        self.assertFalse(os.path.exists("elsewhere/head.inp"))
        done = surgicalmesher("mesh", "--config", "elsewhere/run.toml")
        self.assertEqual((done.returncode, done.stdout.count("nothing has changed")), (0, 3), done.stderr)

    def test_moved_folder_keeps_its_own_map_and_exports(self):
        shutil.copytree("out", "full")
        shutil.copy("map.nrrd", "full")
        os.makedirs("full/models")
        command = ["full/map.nrrd" if word == "map.nrrd" else "full" if word == "out" else word for word in self.command]
        done = surgicalmesher(*command[:-1], "full/models/head.inp")
        self.assertEqual(done.returncode, 0, done.stderr)
        os.rename("full", "moved")
        done = surgicalmesher("mesh", "--config", "moved/run.toml")
        self.assertEqual((done.returncode, done.stdout.count("nothing has changed")), (0, 3), done.stderr)
        self.assertFalse(os.path.exists("full"))

    def test_defaults_that_differ_have_an_option_each(self):
        lines = bytes_of("out/run.toml").decode().splitlines()
        for line in ("gradation = 0", "simplexMesherGradation = 0.3"):
            self.assertIn(line, lines)
        shutil.copytree("out", "graded")
        command = [word if word != "out" else "graded" for word in self.command]
        done = surgicalmesher(*command, "--simplexMesherGradation", "0.1")
        self.assertEqual((done.returncode, done.stdout.count("nothing has changed")), (0, 1), done.stderr)
        with open("graded/stages.json", encoding="utf-8") as file:
            stages = json.load(file)
        self.assertEqual([name for name in stages if "--gradation=0.1" in stages[name]["arguments"]], ["surface"])

    def test_configuration_by_hand(self):
        with open("hand.toml", "w", encoding="utf-8") as file:
            file.write('labelMap = "map.nrrd"\nfolder = "by-hand"\ntargetPoint = [-4, 12, -7]\nminimumEdgeLength = 3.0\n'
                       'maximumEdgeLength = 6\nchildRadius = 9\nminimumIslandVolume = 30\n')
        done = surgicalmesher("mesh", "--config=hand.toml", "--childRadius", "4")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_same_as_three_programs("by-hand")

    def completed(self, *words):
        script = (f"source {PAGES}/completions/surgicalmesher; COMP_WORDS=(surgicalmesher {' '.join(words)}); "
                  f"COMP_CWORD={len(words)}; _surgicalmesher; echo ${{COMPREPLY[@]}}")
        return subprocess.run(["bash", "-euc", script], check=True, stdout=subprocess.PIPE, text=True).stdout.split()

    def test_completion(self):
        self.assertEqual(self.completed("qua"), ["quality"])
        self.assertEqual(self.completed("mesh", "--prese"), ["--preset"])
        self.assertEqual(self.completed("mesh", "--preset", "dr"), ["draft"])
        self.assertEqual(self.completed("view", "--part", "c"), ["cut", "child"])

    def test_manual_pages_have_the_options_of_the_help(self):
        for command in ("mesh", "estimate", "quality", "convert", "view"):
            page = bytes_of(os.path.join(PAGES, "man1", f"surgicalmesher-{command}.1")).decode()
            told = set(re.findall(r"^\.B \\-\\-(\w+)$", page, re.M))
            common = {"help", "version", "xml", "returnparameterfile", "echo", "progress", "quiet",
                      "processinformationaddress"}
            options = set(re.findall(r"^  --(\w+)", surgicalmesher(command, "--help").stdout, re.M)) - common
            self.assertEqual(told, options)

    def test_report_is_one_whole_page(self):
        page = Page(bytes_of("out/report.html").decode())
        self.assertEqual(page.open, [])
        with open("out/mesh.json", encoding="utf-8") as file:
            quality = json.load(file)["quality"]
        with open("out/surface.json", encoding="utf-8") as file:
            preparation = json.load(file)["preparation"]
        self.assertEqual(page.rows, 2 + len(quality["tissues"]) + len(preparation["changes"]))
        self.assertIn(f"{quality['whole']['tetrahedra']:,}tetrahedra", page.text)
        self.assertEqual(len(page.links), 3)
        for link in page.links:
            kind, data = link.split(",")
            self.assertEqual(kind, "data:image/png;base64")
            opacity = np.asarray(Image.open(io.BytesIO(base64.b64decode(data))))[..., 3]
            self.assertTrue(0.1 < (opacity == 255).mean() < 0.9)

    def test_warnings_come_first_in_the_report(self):
        done = surgicalmesher("mesh", "map.nrrd", "warned", "--target", "-4,12,70", *SIZES, "--preset", "draft")
        self.assertEqual(done.returncode, 0, done.stderr)
        text = Page(bytes_of("warned/report.html").decode()).text
        self.assertLess(text.index("lies outside the label map"), text.index("tetrahedra"))

    def test_picture_of_a_cube(self):
        write_cube("cube.stl", 10)
        for name in ("cube.png", "again.png"):
            done = surgicalmesher("view", "cube.stl", name, "--from", "0,0,1", "--withoutEdges", "--width", "400",
                                  "--height", "400")
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(bytes_of("cube.png"), bytes_of("again.png"))
        pixels = np.asarray(Image.open("cube.png"))[..., :3]
        rows, columns = np.nonzero(np.all(pixels == 204, axis=-1))  # the tissues' grey, 0.8, lit from the viewer
        self.assertEqual((len(rows), np.ptp(rows), np.ptp(columns)), (360 * 360, 359, 359))
        bar = np.nonzero(np.all(pixels[394] == 34, axis=-1))[0]
        self.assertAlmostEqual(np.ptp(bar) + 1, 2 / 10 * 360, delta=3)  # 2 mm

    def test_pictures_of_a_mesh(self):
        shown = {}
        for part in ("all", "cut"):
            done = surgicalmesher("view", "out/mesh.vtu", part + ".png", "--part", part, "--width", "300", "--height", "300")
            self.assertEqual(done.returncode, 0, done.stderr)
            shown[part] = np.asarray(Image.open(part + ".png"))
        self.assertTrue(np.any(shown["all"] != shown["cut"]))
        write_cube("cube.stl", 10)
        self.assert_refused(2, ["cube.stl", "no mesh of tetrahedra"], "view", "cube.stl", "x.png", "--part", "cut")

    def test_refusals(self):
        for name, text in (("key.toml", "minimumEdgLength = 3\n"), ("value.toml", "childRadius = -1\n"),
                           ("list.toml", "childRadius = [1, 2]\n"), ("kind.toml", 'followThickness = "perhaps"\n'),
                           ("broken.toml", "childRadius = \n")):
            with open(name, "w", encoding="ascii") as file:
                file.write(text)
        target = ("--target", TARGET)
        for status, words, arguments in (
                (2, ["meshh", "did you mean mesh?"], ["meshh"]),
                (2, ["did you mean --childRadius?"], ["mesh", "map.nrrd", "new", *target, "--childRadus", "4"]),
                (2, ["from 0 to 500"], ["mesh", "map.nrrd", "new", *target, "--childRadius", "-4"]),
                (2, ["unknown flag", "--report"], ["mesh", "map.nrrd", "new", *target, "--report", "x.json"]),
                (2, ["neither a target nor a path"], ["mesh", "map.nrrd", "new"]),
                (2, ["out/scale.nrrd would be overwritten"], ["mesh", "out/scale.nrrd", "out", *target]),
                (2, [".doc"], ["mesh", "map.nrrd", "new", *target, "--export", "head.doc"]),
                (1, ["nothing.nrrd"], ["mesh", "nothing.nrrd", "new", *target]),
                (1, ["nowhere not found"], ["mesh", "map.nrrd", "new", *target, "--export", "nowhere/head.inp"]),
                (1, ["map.nrrd", "not a folder"], ["mesh", "map.nrrd", "map.nrrd", *target]),
                (1, ["key.toml", "did you mean minimumEdgeLength?"], ["mesh", "--config", "key.toml"]),
                (1, ["value.toml", "from 0 to 500"], ["mesh", "--config", "value.toml"]),
                (1, ["list.toml", "one value expected"], ["mesh", "--config", "list.toml"]),
                (1, ["kind.toml", "true or false"], ["mesh", "--config", "kind.toml"]),
                (1, ["broken.toml, line 1"], ["mesh", "--config", "broken.toml"]),
                (2, ["--preset"], ["mesh", "--config", "hand.toml", "--preset", "fine"]),
                (2, ["--classes is given without"], ["mesh", "map.nrrd", "new", *target, "--classes", "a.csv"]),
                (2, ["--channel is given without"], ["mesh", "map.nrrd", "new", *target, "--channel", "b"]),
                (2, ["--denoise is given without --training"], ["mesh", "map.nrrd", "new", *target, "--denoise"]),
                (2, ["unknown flag", "--channel2"], ["mesh", "map.nrrd", "new", *target, "--channel2", "map.nrrd"]),
                (1, ["none.mrk.json"], ["mesh", "map.nrrd", "new", *target, "--training", "none.mrk.json"]),
                (2, ["--denoise is given without --training"], ["estimate", "map.nrrd", *target, "--denoise"]),
                (2, ["unknown flag", "--probability"], ["estimate", "map.nrrd", *target, "--probability", "p.nrrd"]),
                (1, ["none.mrk.json"], ["estimate", "map.nrrd", *target, "--training", "none.mrk.json"]),
                (1, ["none.csv"], ["mesh", "map.nrrd", "new", *target, "--training", TRAINING, "--classes=none.csv"]),
                (2, [".doc"], ["convert", "out/mesh.vtu", "head.doc"]),
                (1, ["no volume element found"], ["quality", "out/surface.vtp"]),
                (1, ["map.nrrd"], ["quality", "map.nrrd"])):
            with self.subTest(arguments=arguments):
                self.assert_refused(status, words, *arguments)

    def test_places_that_are_taken_are_found_before_anything_runs(self):
        for name in ("report.html", "run.toml", "stages.json", "mesh.vtu"):
            with self.subTest(name=name):
                os.makedirs(f"taken/{name}")
                self.assert_refused(1, [f"taken/{name}: folder found"], *self.command_into("taken"))
                os.rmdir(f"taken/{name}")

    def test_an_image_becomes_a_mesh(self):
        write_coarse_head("head.nrrd")
        run_four_programs("four")
        command = ("mesh", "head.nrrd", "imaged", "--training", TRAINING, "--target", SELLA, *COARSE,
                   "--minimumIslandVolume", "4000")
        done = surgicalmesher(*command)
        self.assertEqual(done.returncode, 0, done.stderr)
        for name in ("tissues.nrrd", "tissues.ctbl", "scale.nrrd", "prepared.nrrd", "surface.vtp", "ambient.vtu",
                     "mesh.vtu"):
            self.assertEqual(bytes_of(f"imaged/{name}"), bytes_of(f"four/{name}"), name)
        with open("imaged/classification.json", encoding="utf-8") as file:
            classes = {part["name"] for part in json.load(file)["classes"]}
        with open("imaged/surface.json", encoding="utf-8") as file:
            meshed = {re.sub(r" \d+$", "", part["name"]) for part in json.load(file)["structures"]}  # pieces: muscle 1
        self.assertEqual(meshed, classes)
        done = surgicalmesher(*command)
        self.assertEqual((done.returncode, done.stdout.count("nothing has changed")), (0, 4), done.stderr)
        done = surgicalmesher("mesh", "--config", "imaged/run.toml")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout.count("nothing has changed"), 4)
        self.assertEqual(bytes_of("imaged/mesh.vtu"), bytes_of("four/mesh.vtu"))
        self.estimate_of_the_image_is_that_of_its_map()
        self.a_label_map_takes_the_images_place()

    def estimate_of_the_image_is_that_of_its_map(self):
        figures = []
        for name, image in (("of-image", ("head.nrrd", "--training", TRAINING)),
                            ("of-map", ("four/tissues.nrrd", "--names", "four/tissues.ctbl"))):
            done = surgicalmesher("estimate", *image, "--target", SELLA, *COARSE, "--estimate", f"{name}.json")
            self.assertEqual(done.returncode, 0, done.stderr)
            figures.append(bytes_of(f"{name}.json"))
        self.assertEqual(*figures)

    def a_label_map_takes_the_images_place(self):
        """In the folder of an image, a map's run leaves nothing of the classification."""
        done = surgicalmesher("mesh", "map.nrrd", "imaged", "--target", TARGET, *SIZES, "--minimumIslandVolume", "30")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_same_as_three_programs("imaged")
        for name in ("tissues.nrrd", "tissues.ctbl", "classification.json"):
            self.assertFalse(os.path.exists(f"imaged/{name}"), name)

    def test_interrupt_leaves_whole_stages_alone(self):
        command = [os.path.join(BIN, "surgicalmesher"), "mesh", "map.nrrd", "interrupted", "--target", TARGET,
                   "--minimumEdgeLength", "0.7", "--maximumEdgeLength", "0.8"]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
            for line in process.stdout:
                if "surface: coarsening" in line or "surface: lattice" in line:
                    break
            process.send_signal(signal.SIGINT)
            errors = process.communicate()[1]
        self.assertEqual(process.returncode, -signal.SIGINT, errors)
        self.assertIn("the same command goes on", errors)
        self.assertEqual(sorted(os.listdir("interrupted")), ["scale.json", "scale.nrrd", "stages.json"])

    def test_no_stage_outlives_its_parent(self):
        if not sys.platform.startswith("linux"):
            self.skipTest("only Linux tells a process that its parent has ended")
        command = [os.path.join(BIN, "surgicalmesher"), "mesh", "map.nrrd", "killed", "--target", TARGET,
                   "--minimumEdgeLength", "0.7", "--maximumEdgeLength", "0.8"]
        with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as process:
            for line in process.stdout:
                if "surface: " in line:
                    break
            process.kill()
        for _ in range(300):
            if not any(".partial" in name for name in os.listdir("killed")):
                return
            time.sleep(0.1)
        self.fail("temporaries of a stage are still there")

    def test_quality_of_tetrahedra(self):
        done = surgicalmesher("quality", "out/mesh.vtu", "--report", "quality.json")
        self.assertEqual(done.returncode, 0, done.stderr)
        mesh = read_mesh("out/mesh.vtu")
        volumes = signed_volumes(mesh)
        with open("quality.json", encoding="utf-8") as file:
            report = json.load(file)
        self.assertEqual(report["whole"]["tetrahedra"], len(volumes))
        for tissue in report["tissues"]:
            self.assertAlmostEqual(tissue["volume"], volumes[mesh.tissue == tissue["label"]].sum(), delta=1e-3)
        self.assertEqual(done.stdout.count("\n"), 2 + len(report["tissues"]))

    def test_closed_streams_are_no_fault_of_a_file(self):
        command = [os.path.join(BIN, "SurgicalPathScaleCLI"), "--targetPoint", TARGET, *SIZES, "map.nrrd", "closed.nrrd"]
        for closed in ("<&- >&-", "<&- 2>&-", ">&- 2>&-", "<&- >&- 2>&-"):
            done = subprocess.run(["bash", "-c", f'"$@" {closed}', "bash", *command], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (0, ""), closed)
            self.assertEqual(bytes_of("closed.nrrd"), bytes_of("three/scale.nrrd"))
            os.remove("closed.nrrd")
            for question in ("--help", "--version"):
                done = subprocess.run(["bash", "-c", f'"$@" {closed}', "bash", os.path.join(BIN, "surgicalmesher"), question],
                                      stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
                self.assertEqual((done.returncode, done.stderr), (0, ""), closed)

    @unittest.skipUnless(os.path.exists("/dev/full"), "only Linux has it")
    def test_stdout_without_room_is_noticed(self):
        for arguments in (["--help"], ["--version"], ["quality", "out/mesh.vtu"]):
            with open("/dev/full", "w", encoding="ascii") as full:
                done = subprocess.run([os.path.join(BIN, "surgicalmesher"), *arguments], stdout=full,
                                      stderr=subprocess.PIPE, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (3, 1), done.stderr)
            self.assertIn("stdout: not all that was printed", done.stderr)

    def run_with_memory(self, megabytes, *command):
        limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20, megabytes << 20))
        return subprocess.run([os.path.join(BIN, command[0]), *command[1:]], stdin=subprocess.DEVNULL, text=True,
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=False, preexec_fn=limit)

    def test_too_little_memory_is_no_fault_of_a_file(self):
        for megabytes in range(100, 200, 5):  # from too little for the libraries themselves to enough for all
            done = self.run_with_memory(megabytes, "surgicalmesher", "quality", "out/mesh.vtu")
            self.assertNotIn(done.returncode, (1, 2), done.stderr)
        write_nrrd("large.nrrd", np.ones((300, 300, 300), np.uint16), np.eye(4))
        for megabytes in range(80, 200, 10):
            done = self.run_with_memory(megabytes, "SimplexMesherCLI", "--edgeLength", "5", "large.nrrd", "large.vtp")
            self.assertNotIn(done.returncode, (0, 1, 2), done.stderr)
        os.remove("large.nrrd")

    def test_quality_of_hexahedra(self):
        write_hexahedra("cubes.vtk")
        done = surgicalmesher("quality", "cubes.vtk", "--report", "cubes.json")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open("cubes.json", encoding="utf-8") as file:
            tissues = json.load(file)["tissues"]
        self.assertEqual([(t["label"], t["elements"], t["volume"], t["minimumScaledJacobian"]) for t in tissues],
                         [(3, 1, 1, 1), (7, 1, 1, 1)])

    def test_converted_mesh_is_the_export_of_the_run(self):
        done = surgicalmesher("convert", "out/mesh.vtu", "converted.inp")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(bytes_of("converted.inp"), bytes_of("out/head.inp"))

    def test_estimate(self):
        done = surgicalmesher("estimate", "map.nrrd", "--target", TARGET, *SIZES, "--estimate", "estimate.json")
        self.assertEqual(done.returncode, 0, done.stderr)
        with open("estimate.json", encoding="utf-8") as file:
            estimate = json.load(file)
        count = len(read_mesh("out/mesh.vtu").tetrahedra)
        self.assertTrue(count / 2 < estimate["tetrahedra"] < count * 2, (count, estimate))
        finer = surgicalmesher("estimate", "map.nrrd", "--target", TARGET, "--minimumEdgeLength", "0.5",
                               "--maximumEdgeLength", "0.5", "--estimate", "finer.json")
        self.assertEqual(finer.returncode, 0, finer.stderr)
        with open("finer.json", encoding="utf-8") as file:
            self.assertGreater(json.load(file)["memoryBytes"], 1.5 * estimate["memoryBytes"])
        self.assertGreater(estimate["processorSeconds"], 0)

    def test_presets_are_values_of_options(self):
        done = surgicalmesher("mesh", "map.nrrd", "draft", "--target", TARGET, "--preset", "draft", "--childRadius", "4",
                              "--maximumEdgeLength", "6")
        self.assertEqual(done.returncode, 0, done.stderr)
        configuration = bytes_of("draft/run.toml").decode().splitlines()
        for line in ('preset = "draft"', "minimumEdgeLength = 2", "maximumEdgeLength = 6", "minimumIslandVolume = 30"):
            self.assertIn(line, configuration)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
