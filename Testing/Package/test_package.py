"""What is installed serves outside of the build: a program of another project, and surgicalmesher moved elsewhere.

usage: test_package.py CMAKE BUILD OUTDIR
"""
import os
import shutil
import subprocess
import sys
import unittest

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(os.path.dirname(HERE), "Python"))
from maps import cut_out, write_nrrd  # noqa: E402

CMAKE, BUILD, OUTDIR = sys.argv[1:4]


def run(*command):
    done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          check=False)
    assert done.returncode == 0, done.stdout
    return done.stdout


class PackageTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(OUTDIR, ignore_errors=True)
        os.makedirs(OUTDIR)
        os.chdir(OUTDIR)
        for component in ("RuntimeLibraries", "Development"):
            run(CMAKE, "--install", BUILD, "--prefix", "first", "--component", component)
        os.rename("first", "moved")
        labels, affine = cut_out(np.s_[58:90, 84:116, 30:56])
        write_nrrd("map.nrrd", labels, affine)
        cls.tissues = len(np.unique(labels[labels > 0]))

    def test_moved_programs_and_a_program_of_another_project(self):
        run("moved/bin/surgicalmesher", "mesh", "map.nrrd", "out", "--target", "-4,12,-7", "--preset", "draft")
        quality = run("moved/bin/surgicalmesher", "quality", "out/mesh.vtu")
        run(CMAKE, "-S", HERE, "-B", "outside", f"-DCMAKE_PREFIX_PATH={OUTDIR}/moved", "-DCMAKE_BUILD_TYPE=Debug")
        run(CMAKE, "--build", "outside")
        tissues, count = run("outside/count_elements", "map.nrrd", "out/mesh.vtu").split()[::2]
        self.assertEqual(int(tissues), self.tissues)
        self.assertEqual(count, quality.splitlines()[1].split()[1])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
