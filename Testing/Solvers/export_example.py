"""Exports the example's mesh in every format, with tissues of even label twice as stiff as the others.

usage: export_example.py BIN EXAMPLE OUTDIR
EXAMPLE is the folder with the results of example.sh.
"""
import os
import shutil
import subprocess
import sys

from sagging_head import materials

BIN, EXAMPLE, OUTDIR = map(os.path.abspath, sys.argv[1:4])
FORMATS = ("bdf", "cdb", "exo", "feb", "inp", "k", "mesh", "msh", "msh2", "ply", "stl", "vtk", "vtu", "xdmf")

shutil.rmtree(OUTDIR, ignore_errors=True)
os.makedirs(OUTDIR)
os.chdir(OUTDIR)
surface = os.path.join(EXAMPLE, "surface.vtp")
with open("materials.csv", "w", encoding="ascii") as table:
    table.write(materials(surface))
subprocess.run([os.path.join(BIN, "FuchsTetrahedralizerCLI"), "--scale", os.path.join(EXAMPLE, "scale.nrrd"),
                "--ambient", os.path.join(EXAMPLE, "ambient.vtu"), "--materials", "materials.csv",
                *(word for extension in FORMATS for word in ("--export", "mesh." + extension)),
                surface, "reference.vtu"], check=True, stdout=subprocess.DEVNULL)
