#!/usr/bin/python3
"""Compares estimates with meshes. usage: estimates.py OUTDIR [--bin BIN] [--map FILE SHORTEST LONGEST]...

Estimates and meshes atlases of Debian's package mricron-data, or the given maps, on two threads. The target edge length
L (mm) grows from SHORTEST, within 10 mm of the origin of the map's space, to LONGEST. Prints a row of a table for each
mesh: the estimated numbers of triangles and tetrahedra over those of the mesh, and, both estimated and measured, the
peak memory of the stage that takes more and the processor seconds of the surface and the mesh stage together.
"""
import argparse
import json
import os
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "workflow", "example"))
from meshfiles import read_dataset  # noqa: E402

ATLASES = "/usr/share/mricron/templates/"
USUAL = [("jhu189", 1, 8), ("jhu189", 4, 32), ("jhu189", 1.5, 3), ("jhu189", 2, 2.5), ("aal", 1, 8), ("aal", 2, 3),
         ("inia19-NeuroMaps", 1, 8), ("inia19-NeuroMaps", 1, 1.5)]
HEAD = ("| map | L, mm | triangles | tetrahedra | memory, MB, foretold and taken | seconds, foretold and taken |\n"
        "|---|---|---:|---:|---:|---:|")


def measured(command):
    """Runs a command and returns its seconds, processorSeconds and peakMemory (bytes)."""
    tool = os.path.join(os.path.dirname(os.path.abspath(__file__)), "measured.py")
    subprocess.run([sys.executable, tool, "figures.json", *command], check=True, stdout=subprocess.DEVNULL)
    with open("figures.json", encoding="utf-8") as file:
        return json.load(file)


def foretold(programs, file, scale):
    subprocess.run([os.path.join(programs, "surgicalmesher"), "estimate", *scale, "--estimate", "estimate.json", file],
                   check=True, stdout=subprocess.DEVNULL)
    with open("estimate.json", encoding="utf-8") as stream:
        return json.load(stream)


def row(programs, file, shortest, longest):
    scale = ["--targetPoint=0,0,0", "--minimumEdgeLength", str(shortest), "--maximumEdgeLength", str(longest),
             "--childRadius", "10", "--decayLength", "25"]
    estimate = foretold(programs, file, scale)
    common = ["--threads", "2", "--scale", "scale.nrrd", "--ambient", "ambient.vtu"]
    program = {name: os.path.join(programs, name + "CLI")
               for name in ("SurgicalPathScale", "SimplexMesher", "FuchsTetrahedralizer")}
    subprocess.run([program["SurgicalPathScale"], *scale, file, "scale.nrrd"], check=True, stdout=subprocess.DEVNULL)
    taken = [measured([program["SimplexMesher"], *common, file, "surface.vtp"]),
             measured([program["FuchsTetrahedralizer"], *common, "surface.vtp", "mesh.vtu"])]
    found = {"triangles": read_dataset("surface.vtp").GetNumberOfCells(),
             "tetrahedra": read_dataset("mesh.vtu").GetNumberOfCells()}
    ratios = " | ".join(f"{estimate[what] / number:.2f}" for what, number in found.items())
    memory = max(stage["peakMemory"] for stage in taken)
    seconds = sum(stage["processorSeconds"] for stage in taken)
    name = os.path.basename(file).split(".")[0]
    return (f"| {name} | {shortest:g} to {longest:g} | {ratios} | {estimate['memoryBytes'] / 1e6:,.0f}, "
            f"{memory / 1e6:,.0f} | {estimate['processorSeconds']:.0f}, {seconds:.0f} |")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("folder")
    parser.add_argument("--bin", default=os.path.join(ROOT, "build", "bin"))
    parser.add_argument("--map", nargs=3, action="append", metavar=("FILE", "SHORTEST", "LONGEST"))
    arguments = parser.parse_args()
    maps = arguments.map or [(f"{ATLASES}{name}.nii.gz", *lengths) for name, *lengths in USUAL]
    maps = [(os.path.abspath(file), float(shortest), float(longest)) for file, shortest, longest in maps]
    programs = os.path.abspath(arguments.bin)
    os.makedirs(arguments.folder, exist_ok=True)
    os.chdir(arguments.folder)
    print(HEAD, flush=True)
    for file, shortest, longest in maps:
        print(row(programs, file, shortest, longest), flush=True)


if __name__ == "__main__":
    main()
