"""Tests what Cleaver is given and how its mesh is read, by a program that takes its place and labels a lattice with the
given materials; tests Cleaver itself if CLEAVER names its program. usage: test_cleaver.py BIN OUTDIR"""
import os
import shutil
import subprocess
import sys
import unittest

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
import compatible_interfaces as evidence  # noqa: E402  # sets the path for the others
import cleaver  # noqa: E402
from brain_meshes import Programs  # noqa: E402
from measures import signed_volumes  # noqa: E402
from parts import Parts  # noqa: E402

BIN, OUTDIR = sys.argv[1:3]
AFFINE = np.array([[0.0, -2, 0, 7], [1, 0, 0, -3], [0, 0, 3, 11], [0, 0, 0, 1]])
INSTEAD = '''#!/usr/bin/python3
import sys
sys.path[:0] = [{here!r}, {lib!r}, {tests!r}]
import numpy as np
from lattice import lattice_tetrahedra
from meshfiles import read_nrrd
words = sys.argv[1:]
volumes = [read_nrrd(file) for file in words[words.index("-i") + 1:]]
sides = np.diag(volumes[0][1])[:3]
points, tetrahedra = lattice_tetrahedra(np.zeros(3), sides * volumes[0][0].shape, 1.0)
at = np.floor(points[tetrahedra].mean(axis=1) / sides).astype(int)
inside = np.all(at < volumes[0][0].shape, axis=1)
at, tetrahedra = at[inside], tetrahedra[inside]
material = np.argmax([values[tuple(at.T)] for values, _ in volumes], axis=0)
with open(words[words.index("-n") + 1] + ".node", "w") as file:
    file.write("#\\n%d 3 0 0\\n\\n" % len(points))
    file.writelines("%d %g %g %g\\n" % (n + 1, *point) for n, point in enumerate(points))
with open(words[words.index("-n") + 1] + ".ele", "w") as file:
    file.write("#\\n%d 4 1\\n\\n" % len(tetrahedra))
    file.writelines("%d %d %d %d %d %d\\n" % (n + 1, *(t + 1), m + 1) for n, (t, m) in enumerate(zip(tetrahedra, material)))
'''


def program(name, text):
    folder = Parts(os.path.join(OUTDIR, "cleaver")).folder
    file = os.path.join(folder, name)
    with open(file, "w", encoding="utf-8") as stream:
        stream.write(text)
    os.chmod(file, 0o755)
    return Programs(BIN, folder, file)


def two_boxes():
    labels = np.zeros((9, 10, 7), int)
    labels[2:5, 2:8, 2:5], labels[5:7, 2:8, 2:5] = 3, 8
    return labels


class CleaverTest(unittest.TestCase):
    def test_labels_come_back_where_they_were(self):
        run = program("instead", INSTEAD.format(here=HERE, lib=os.path.join(HERE, "..", "..", "workflow", "example"),
                                                tests=os.path.join(HERE, "..", "Python")))
        labels = two_boxes()
        mesh = cleaver.uniform_mesh_of(run, labels, AFFINE, 1.0)
        self.assertEqual(set(mesh.tissue), {3, 8})
        self.assertGreater(signed_volumes(mesh).min(), 0)
        for label in (3, 8):
            wanted = np.argwhere(labels == label)
            middle = np.average(mesh.points[mesh.tetrahedra].mean(axis=1)[mesh.tissue == label], axis=0,
                                weights=signed_volumes(mesh)[mesh.tissue == label])
            np.testing.assert_allclose(middle, AFFINE[:3, :3] @ wanted.mean(axis=0) + AFFINE[:3, 3], atol=0.2)
            self.assertAlmostEqual(signed_volumes(mesh)[mesh.tissue == label].sum() / (6 * len(wanted)), 1, delta=0.15)

    def test_a_program_that_does_not_end_is_ended_and_said_so(self):
        run = program("endless", "#!/bin/sh\nwhile :; do :; done\n")
        with self.assertRaises(subprocess.CalledProcessError) as raised:
            run(run.cleaver, most=1)
        self.assertEqual(evidence.sentence(raised.exception), f"endless does not finish in {cleaver.MOST} s")

    @unittest.skipUnless(os.environ.get("CLEAVER"), "CLEAVER does not name its program")
    def test_cleaver_meshes_two_boxes(self):
        run = Programs(BIN, Parts(os.path.join(OUTDIR, "cleaver")).folder, os.environ["CLEAVER"])
        labels = np.kron(two_boxes(), np.ones((3, 3, 3), int))
        mesh = cleaver.uniform_mesh_of(run, labels, np.eye(4), 2.0)
        for label in (3, 8):
            volume = signed_volumes(mesh)[mesh.tissue == label].sum()
            self.assertAlmostEqual(volume / np.count_nonzero(labels == label), 1, delta=0.2)  # Cleaver blurs the labels

    def test_without_its_program_it_is_left_out(self):
        self.assertNotIn(cleaver.NAME, evidence.ways_of(Programs(BIN, OUTDIR)))
        self.assertIn(cleaver.NAME, evidence.ways_of(Programs(BIN, OUTDIR, shutil.which("true"))))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
