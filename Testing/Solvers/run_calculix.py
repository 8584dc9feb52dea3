#!/usr/bin/python3
"""CalculiX: a head sags under its weight in its fluid. usage: run_calculix.py mesh.inp [CLAMPED_SURFACE]...

Null displacement is always clamped, because mesh.inp clamps it. The materials are those of mesh.inp; the analysis is
nonlinear if they are. Writes the deck, gravity.inp, and CalculiX's results beside the mesh.
"""
import os
import subprocess
import sys

import numpy as np

from sidecar import GRAVITY, Sidecar

DECK = """*INCLUDE, INPUT={mesh}{clamped}
*STEP
*STATIC, SOLVER=ITERATIVE CHOLESKY
*DLOAD
all_elements, GRAV, {gravity}, 0., 0., -1.
*NODE PRINT, NSET=all_nodes
U
*END STEP
"""

if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
    sys.exit(__doc__)
folder, file = os.path.split(os.path.abspath(sys.argv[1]))
sets = Sidecar(sys.argv[1]).sets
clamped = "".join("\n*BOUNDARY\n%s, 1, 3" % sets[surface]["nodes"] for surface in sys.argv[2:])
with open(os.path.join(folder, "gravity.inp"), "w", encoding="ascii") as deck:
    deck.write(DECK.format(mesh=file, clamped=clamped, gravity=GRAVITY))

run = subprocess.run(["ccx", "gravity"], cwd=folder, stdout=subprocess.PIPE, text=True)
if run.returncode or "*ERROR" in run.stdout:
    sys.exit(run.stdout)
with open(os.path.join(folder, "gravity.dat"), encoding="ascii") as results:
    rows = [line.split() for line in results]
displacement = np.array([[float(x) for x in row[1:]] for row in rows if len(row) == 4 and row[0].isdigit()])
print("nodes", len(displacement))
print("displacement", np.linalg.norm(displacement, axis=1).max())
