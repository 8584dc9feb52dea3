#!/usr/bin/python3
"""Merges the example's reports and prints its figures. usage: report.py FOLDER STAGE=SECONDS...

Reads scale.json, surface.json and mesh.json in FOLDER, writes report.json beside them (one member per stage, the
seconds of each, and all warnings), and prints a table of figures that ends with the warnings. Warnings about targets
and paths that do not lie in tissue, for which prepared.nrrd and surface.vtp are read, also go to stderr.
"""
import json
import os
import sys

STAGES = ("scale", "surface", "mesh")


def wrong_tissues(report):
    """Returns the labels that have other numbers of components, tunnels or cavities in the mesh than in the prepared
    map."""
    wanted, found = ({tissue["label"]: tissue for tissue in report[stage]["topology"]} for stage in ("surface", "mesh"))
    return sorted(label for label in wanted.keys() | found.keys() if wanted.get(label) != found.get(label))


def places_of_interest(folder, report):
    """Returns sentences about targets and ends of paths that do not lie in tissue."""
    from vtk.util.numpy_support import vtk_to_numpy

    from focus import sentences
    from meshfiles import read_dataset, read_nrrd
    surface = read_dataset(os.path.join(folder, "surface.vtp"))
    points = vtk_to_numpy(surface.GetPoints().GetData())
    return sentences(report["scale"], *read_nrrd(os.path.join(folder, "prepared.nrrd")), points)


def stage_warnings(report, places):
    """Returns the warnings of the stages, without those that `places` repeats in more detail."""
    told = [text for stage in STAGES for text in report[stage].get("warnings", [])]
    return [text for text in told if not any(place.startswith(text) for place in places)]


def compared(number, estimate):
    share = f", {round(100 * (estimate / number - 1)):+} %" if number else ""
    return f"{number:,} (estimated {estimate:,}{share})"


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
    yield "tissues of wrong topology", f"{len(wrong_tissues(report))} (beside the prepared map)"
    for stage, seconds in report["seconds"].items():
        yield f"time for {stage}", f"{seconds:.1f} s"
    for warning in report["warnings"]:
        yield "warning", warning


def main():
    folder, *seconds = sys.argv[1:]
    report = {}
    for stage in STAGES:
        with open(os.path.join(folder, stage + ".json"), encoding="utf-8") as file:
            report[stage] = json.load(file)
    report["seconds"] = {stage: float(value) for stage, value in (pair.split("=") for pair in seconds)}
    try:
        places = places_of_interest(folder, report)
    except ImportError as error:
        sys.exit(f"report: {error}, expected the packages that CMake/debian-packages.txt has for the example")
    report["warnings"] = places + stage_warnings(report, places)
    with open(os.path.join(folder, "report.json"), "w", encoding="utf-8") as file:
        json.dump(report, file, indent=2)
        file.write("\n")
    for name, value in rows(report):
        print(f"{name:<34}{value}")
    sys.stdout.flush()
    for place in places:
        print(f"example.sh: warning: {place}", file=sys.stderr)


if __name__ == "__main__":
    main()
