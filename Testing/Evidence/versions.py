#!/usr/bin/python3
"""Writes a table of the programs' versions and the machine into Docs/Evidence.md. usage: versions.py BIN [CLEAVER]"""
import os
import re
import subprocess
import sys

import numpy
import scipy
import vtk

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, "Testing", "Benchmarks"), os.path.join(ROOT, "Testing", "Evidence")]
import benchmark  # noqa: E402
import document  # noqa: E402


def printed(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False).stdout


def debian(package):
    return printed("dpkg-query", "-W", "-f", "${Version}", package).strip()


def rows(programs, cleaver=None):
    ours = printed(os.path.join(programs, "SimplexMesherCLI"), "--version").strip()
    machine = benchmark.machine()
    calculix = re.search(r"[Vv]ersion\s+([\d.]+)", printed("ccx", "-v"))
    others = [["Cleaver", printed(cleaver, "--version").strip()]] if cleaver else []
    return [["SurgicalMesher", f"{ours}, commit {benchmark.commit()}"], ["CGAL", debian("libcgal-dev")],
            ["TetGen", debian("libtet1.5-dev")], ["CalculiX", calculix.group(1) if calculix else "none"], *others,
            ["VTK, SciPy, NumPy", f"{vtk.VTK_VERSION}, {scipy.__version__}, {numpy.__version__}"],
            ["images and atlas (mricron-data)", debian("mricron-data")],
            ["machine", f"{machine['processors']} processors ({machine['processor']})"]]


if __name__ == "__main__":
    document.put({"versions": document.table(["what", "version"], rows(*sys.argv[1:]))})
