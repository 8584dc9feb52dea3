#!/usr/bin/python3
"""Merges the example's reports and prints its figures. usage: report.py FOLDER STAGE=SECONDS...

Reads scale.json, surface.json and mesh.json in FOLDER, writes report.json beside them (one member per stage, and the
seconds of each), and prints a table of figures. What the reports say of the mesh is the modules' own account.
"""
import json
import os
import sys

import numpy as np

from meshfiles import dihedral_angles, edge_ratios, read_mesh


def rows(report, folder):
    mesh = read_mesh(os.path.join(folder, "mesh.vtu"))
    angles, ratios = dihedral_angles(mesh), edge_ratios(mesh)
    yield "tissues", len(np.unique(mesh.tissue))
    yield "tetrahedra", f"{len(mesh.tetrahedra):,}"
    yield "dihedral angles (degrees)", f"{angles.min():.1f} to {angles.max():.1f}"
    yield "mean of the tetrahedra's smallest (degrees)", f"{angles.min(axis=1).mean():.1f}"
    yield "edges within 0.7 to 1.4 of the target (%)", f"{100 * np.mean((ratios >= 0.7) & (ratios <= 1.4)):.1f}"
    for stage, seconds in report["seconds"].items():
        yield f"{stage} (s)", f"{seconds:.1f}"


def main():
    folder, *seconds = sys.argv[1:]
    report = {}
    for stage in ("scale", "surface", "mesh"):
        with open(os.path.join(folder, stage + ".json"), encoding="utf-8") as file:
            report[stage] = json.load(file)
    report["seconds"] = {stage: float(value) for stage, value in (pair.split("=") for pair in seconds)}
    with open(os.path.join(folder, "report.json"), "w", encoding="utf-8") as file:
        json.dump(report, file, indent=2)
        file.write("\n")
    for name, value in rows(report, folder):
        print(f"{name:<46}{value:>16}")


if __name__ == "__main__":
    main()
