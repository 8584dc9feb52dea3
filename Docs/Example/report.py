#!/usr/bin/python3
"""Merges the example's reports and prints its figures. usage: report.py FOLDER STAGE=SECONDS...

Reads scale.json, surface.json and mesh.json in FOLDER, writes report.json beside them (one member per stage, and the
seconds of each), and prints a table of figures.
"""
import json
import os
import sys


def rows(report):
    whole = report["mesh"]["quality"]["whole"]
    yield "tissues", len(report["mesh"]["quality"]["tissues"])
    yield "tetrahedra", f"{whole['tetrahedra']:,}"
    yield "dihedral angles (degrees)", f"{whole['dihedral']['minimum']:.1f} to {whole['dihedral']['maximum']:.1f}"
    yield "mean of the tetrahedra's smallest (degrees)", f"{whole['minimumDihedral']['mean']:.1f}"
    yield "edges within 0.7 to 1.4 of the target (%)", f"{100 * whole['edgesNearTarget']:.1f}"
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
    for name, value in rows(report):
        print(f"{name:<46}{value:>16}")


if __name__ == "__main__":
    main()
