#!/usr/bin/python3
"""Merges the example's reports and prints its figures. usage: report.py FOLDER STAGE=SECONDS...

Reads scale.json, surface.json and mesh.json in FOLDER, writes report.json beside them (one member per stage, and the
seconds of each), and prints a table of figures.
"""
import json
import os
import sys


def wrong_tissues(report):
    """Labels whose tetrahedra have other components, tunnels or cavities than the prepared map."""
    wanted, found = ({tissue["label"]: tissue for tissue in report[stage]["topology"]} for stage in ("surface", "mesh"))
    return sorted(label for label in wanted.keys() | found.keys() if wanted.get(label) != found.get(label))


def compared(number, estimate):
    return f"{number:,} (estimated {estimate:,}, {round(100 * (estimate / number - 1)):+} %)"


def rows(report):
    surface, mesh, estimate = report["surface"], report["mesh"]["quality"]["whole"], report["scale"]["estimate"]
    preparation, dihedral = surface["preparation"], mesh["dihedral"]
    islands = sum(tissue["islandsRemoved"] for tissue in preparation["changes"])
    yield "tissues", len(surface["topology"])
    yield "islands removed", f"{islands:,}"
    yield "voxels changed at contacts", f"{preparation['contactVoxelsChanged']:,}"
    yield "triangles", compared(surface["triangles"], estimate["triangles"])
    yield "tetrahedra", compared(mesh["tetrahedra"], estimate["tetrahedra"])
    yield "dihedral angles", f"{dihedral['minimum']:.1f} to {dihedral['maximum']:.1f} degrees"
    yield "mean of the smallest of each", f"{mesh['minimumDihedral']['mean']:.1f} degrees"
    yield "edges within 0.7..1.4 of target", f"{100 * mesh['edgesNearTarget']:.1f} %"
    yield "tissues of wrong topology", len(wrong_tissues(report))
    for stage, seconds in report["seconds"].items():
        yield f"time for {stage}", f"{seconds:.1f} s"


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
        print(f"{name:<34}{value}")


if __name__ == "__main__":
    main()
