#!/usr/bin/python3
"""The problem of Docs/Solvers.md: a head that sags under its weight while the ends of some tissues are clamped.

usage: sagging_head.py materials SURFACE.vtp      prints materials.csv: tissues of even label 6 kPa, the others 3 kPa
       sagging_head.py clamped MESH.vtu EXPORT    prints the names of the surfaces to clamp, from the export's sidecar
"""
import os
import sys

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "workflow", "example"))
from meshfiles import cell_array, read_dataset, read_mesh  # noqa: E402
from sidecar import Sidecar  # noqa: E402


def materials(surface):
    """Returns the table of materials for the tissues of a surface, as text."""
    rows = ["%d, linear, %d, 0.45, 1000" % (label, 6 if label % 2 == 0 else 3)
            for label in np.setdiff1d(cell_array(read_dataset(surface), "BoundaryLabels"), [0])]
    return "\n".join(["tissue, model, youngsModulus, poissonsRatio, density", *rows]) + "\n"


def clamped_surfaces(mesh, sets):
    """Returns the names of the surfaces to clamp: the interfaces to the outside of tissues whose tetrahedra have their
    mean height in the lowest quarter of the mesh."""
    height = mesh.points[:, 2]
    limit = height.min() + 0.25 * np.ptp(height)
    chosen = []
    for name, entry in sets.items():
        if entry["type"] == "faces" and entry["kind"] == "tissueInterface" and entry["ids"][1] == 0:
            if height[mesh.tetrahedra[mesh.tissue == entry["ids"][0]]].mean() < limit:
                chosen.append(name)
    return chosen


def main():
    if len(sys.argv) == 3 and sys.argv[1] == "materials":
        sys.stdout.write(materials(sys.argv[2]))
    elif len(sys.argv) == 4 and sys.argv[1] == "clamped":
        print(*clamped_surfaces(read_mesh(sys.argv[2]), Sidecar(sys.argv[3]).sets))
    else:
        sys.exit("usage: sagging_head.py materials SURFACE.vtp | clamped MESH.vtu EXPORT")


if __name__ == "__main__":
    main()
