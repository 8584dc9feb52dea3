#!/usr/bin/python3
"""Measures the rates of children of growing size, and how far their solutions are from that of the whole mesh.

usage: child_rates.py BIN OUTDIR [--document]

BIN holds the three modules and MultirateBenchmark, which uses one thread here. The map is the JHU atlas; the edges of
the child are 1 mm within each of the RADII around the example's target. Finished meshes and figures stay in OUTDIR and
are not made again. Writes rates.md and rates.json; --document puts the tables into Docs/Evidence.md.
"""
import argparse
import os
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, *folder) for folder in (("workflow", "example"), ("Testing", "Python"),
                                                           ("Testing", "Evidence"))]
import document  # noqa: E402
from brain_meshes import Programs  # noqa: E402
from maps import ATLAS  # noqa: E402
from parts import Parts  # noqa: E402

RADII = (6, 8, 10, 12)  # mm
WITH_ERRORS = 10  # mm; the example's radius, for which the differences from the whole mesh are measured
TARGET, LENGTHS = "0,0,-10", ("--minimumEdgeLength", 1, "--maximumEdgeLength", 8, "--decayLength", 25)
CHILD = re.compile(r"child (\d+): (\d+) unknowns, (\d+) of the interface, condensing ([\d.]+) s, factor ([\d.]+) s\n"
                   r"((?:  tool at .*\n)+)  any load: ([\d.]+) ms")
TOOL = re.compile(r"tool at +(\d+) points: ([\d.]+) ms")
ERRORS = re.compile(r"(linear|neo-Hookean): (\d+) steps, (\d+) iterations, ([\d.]+) s; whole mesh ([\d.]+) s; largest "
                    r"displacement ([\d.]+) mm, relative difference ([\d.e+-]+)")


def divide(run, file, target, lengths, radius):
    """Meshes the map in `file` and writes parent.vtu and child.vtu."""
    run("SurgicalPathScaleCLI", "--targetPoint=" + target, *lengths, "--childRadius", radius, file, "scale.nrrd")
    run("SimplexMesherCLI", "--scale", "scale.nrrd", "--minimumIslandVolume", 30, "--ambient", "ambient.vtu", file,
        "surface.vtp")
    run("FuchsTetrahedralizerCLI", "--scale", "scale.nrrd", "--ambient", "ambient.vtu", "--parentMesh", "parent.vtu",
        "--childMesh", "child.vtu", "surface.vtp", "mesh.vtu")


def benchmarked(run, *options):
    one_thread = {**os.environ, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    return subprocess.run([os.path.join(run.programs, "MultirateBenchmark"), "parent.vtu", "child.vtu", *options],
                          cwd=run.folder, env=one_thread, check=True, capture_output=True, text=True).stdout


def record_of(radius, printed):
    """Returns a record of what MultirateBenchmark has printed."""
    tetrahedra, unknowns = map(int, re.search(r"whole: (\d+) tetrahedra, (\d+) unknowns", printed).groups())
    children = [{"child": int(number), "unknowns": int(own), "interface": int(shared), "condensing": float(condensing),
                 "factor": float(factor), "tool": {points: float(ms) for points, ms in TOOL.findall(tools)},
                 "any": float(load)}
                for number, own, shared, condensing, factor, tools, load in CHILD.findall(printed)]
    errors = [{"law": law, "steps": int(steps), "iterations": int(iterations), "seconds": float(coupled),
               "wholeSeconds": float(whole), "largest": float(largest), "difference": float(difference)}
              for law, steps, iterations, coupled, whole, largest, difference in ERRORS.findall(printed)]
    return {"radius": radius, "tetrahedra": tetrahedra, "unknowns": unknowns, "children": children, "errors": errors}


def rate_rows(records):
    for record in records:
        for child in record["children"]:
            steps = " / ".join(f"{ms:.3f}" for ms in child["tool"].values())
            yield [f"{record['radius']:g}", f"{record['unknowns']:,}", child["child"], f"{child['unknowns']:,}",
                   f"{child['interface']:,}", f"{child['condensing']:.1f} / {child['factor']:.1f}", steps,
                   f"{1000 / max(child['tool'].values()):,.0f}", f"{child['any']:.1f}"]


def error_rows(records):
    for record in records:
        for row in record["errors"]:
            yield [row["law"], row["steps"], row["iterations"], f"{row['largest']:.1f}", f"{row['difference']:.1e}",
                   f"{row['seconds']:.1f}", f"{row['wholeSeconds']:.1f}"]


def tables_of(records):
    return {
        "child rates": document.table(
            ["child's radius (mm)", "unknowns of the whole", "child", "its unknowns", "of them on the interface",
             "condensing / factor, once (s)", "step, tool at 1 / 7 / 32 points (ms)", "rate at 32 points (Hz)",
             "any load (ms)"], rate_rows(records)),
        "child errors": document.table(
            ["law of the child", "steps", "iterations", "largest displacement (mm)", "difference from the whole, relative",
             "coupled (s)", "whole (s)"], error_rows(records))}


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("programs")
    parser.add_argument("folder")
    parser.add_argument("--document", action="store_true")
    options = parser.parse_args()
    parts, records = Parts(options.folder), []
    for radius in RADII:
        run = Programs(options.programs, Parts(parts.path(f"radius-{radius}")).folder)

        def make(radius=radius, run=run):
            divide(run, ATLAS, TARGET, LENGTHS, radius)
            return record_of(radius, benchmarked(run, *(() if radius == WITH_ERRORS else ("--rates",))))
        records.append(parts.record(f"rates-{radius}", make))
        print(records[-1], flush=True)
    tables = tables_of(records)
    document.leave(records, tables, parts.path("rates"), options.document)


if __name__ == "__main__":
    main()
