"""NOTICE names the programs that contain each library. usage: test_notice.py BIN"""
import glob
import os
import re
import subprocess
import sys
import unittest

BIN = sys.argv[1]
ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
# What shows in a program that it contains a library: the name of a shared one, or of a symbol.
TRACES = {"TetGen": r"^\s*libtet", "CGAL": r"[ :]CGAL::", "CHOLMOD": r"^\s*libcholmod", "GMP": r"^\s*libgmp\.",
          "Eigen": r"[ :]Eigen::"}


def output_of(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=False).stdout


def programs_by_library():
    with open(os.path.join(ROOT, "NOTICE"), encoding="utf-8") as file:
        rows = re.findall(r"^  (\w+)[^\n]*\n    (\w[^\n]*)$", file.read(), re.M)
    return {library: set(re.findall(r"\w+CLI|surgicalmesher", programs)) for library, programs in rows}


class NoticeTest(unittest.TestCase):
    def test_programs_of_each_library(self):
        found = {library: set() for library in TRACES}
        programs = glob.glob(os.path.join(BIN, "*CLI")) + [os.path.join(BIN, "surgicalmesher")]
        self.assertGreater(len(programs), 8)
        for program in programs:
            contained = output_of("ldd", program) + output_of("nm", "-C", program)
            for library, trace in TRACES.items():
                if re.search(trace, contained, re.M):
                    found[library].add(os.path.basename(program))
        listed = programs_by_library()
        for library, names in found.items():
            self.assertEqual(listed[library], names, library)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
