#!/usr/bin/python3
"""Measures time, memory and quality of our stages and of other meshers on the same inputs, at doubling sizes.

usage: benchmark.py BIN OUTDIR [--case PATTERN] [--threads N,N] [--page]
       benchmark.py BIN OUTDIR --map FILE.nii.gz --targets FILE [--spacing MM] [--featureScale S] [--threads N,N]

BIN holds the three modules, Mesh3Driver and TetGenDriver; a driver that is missing is left out. Runs the cases whose
names match the regular expression PATTERN, prints a line for each run, and adds the records to OUTDIR/benchmark.json,
which keeps those of other cases from earlier runs. Every record names its commit and its machine. --page draws the
curves of all records and writes the tables into Docs/Benchmarks.md; it needs a record of every case. With --map, the
only case is that map, resampled to voxels of --spacing (by default 1 mm).
"""
import argparse
import json
import os
import platform
import re
import subprocess
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
sys.path[:0] = [os.path.join(ROOT, "workflow", "example"), os.path.join(ROOT, "Testing", "Python")]
import inputs  # noqa: E402
from maps import write_nrrd  # noqa: E402
from measures import components_of_mesh, dihedral_angles, edge_ratios, euler_numbers_of_mesh  # noqa: E402
from meshfiles import interpolated, read_mesh, read_nrrd  # noqa: E402

SCALE = ["--minimumEdgeLength", "1", "--maximumEdgeLength", "8", "--childRadius", "10", "--decayLength", "25"]
ISLAND_VOLUME = "30"


def measured(command):
    """Runs a command and returns its figures (see measured.py) and its stdout."""
    watched = [sys.executable, os.path.join(HERE, "measured.py"), "figures.json", *command]
    process = subprocess.run(watched, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                             check=False)
    if process.returncode:
        sys.exit(f"{' '.join(command)} ended with {process.returncode}: {process.stderr[-300:]}")
    with open("figures.json", encoding="utf-8") as file:
        return json.load(file), process.stdout


def commit():
    git = ["git", "-C", ROOT]
    name = subprocess.run(git + ["rev-parse", "--short=12", "HEAD"], stdout=subprocess.PIPE, text=True, check=False)
    changed = subprocess.run(git + ["status", "--porcelain", "--untracked-files=no"], stdout=subprocess.PIPE, text=True,
                             check=False)
    return name.stdout.strip() + ("+changes" if changed.stdout.strip() else "")


def machine():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        models = re.findall(r"^model name\s*: (.*)$", file.read(), re.M)
    memory = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    return {"processor": models[0] if models else platform.machine(), "processors": os.cpu_count(),
            "memory": memory, "system": platform.platform()}


def quality_of(mesh_file, wanted):
    """Returns the quality of a mesh, measured independently of the program that made it. Target edge lengths are those
    of scale.nrrd; `wanted` maps each label to its number of pieces and its Euler number."""
    mesh = read_mesh(mesh_file)
    scale, affine = read_nrrd("scale.nrrd")
    angles = dihedral_angles(mesh)
    ratios = edge_ratios(mesh, lambda positions: interpolated(scale, affine, positions))
    pieces, euler = components_of_mesh(mesh), euler_numbers_of_mesh(mesh)
    wrong = [label for label, numbers in wanted.items()
             if label >= len(euler) or (pieces[label], euler[label]) != numbers]
    return {"tetrahedra": len(mesh.tetrahedra), "minimumDihedral": round(float(angles.min()), 2),
            "maximumDihedral": round(float(angles.max()), 2),
            "below20Degrees": int((angles.min(axis=1) < 20).sum()),
            "edgesNearTarget": round(float(np.mean((ratios >= 0.7) & (ratios <= 1.4))), 4),
            "wrongTissues": len(wrong)}


def run_ours(case, modules, threads, surface_options):
    """Runs our modules on map.nrrd and returns the figures of each stage."""
    def stage(program, *arguments):
        return measured([os.path.join(modules, program), "--threads", str(threads), *arguments])[0]
    return {
        "scale": stage("SurgicalPathScaleCLI", *case.focus, *SCALE, "map.nrrd", "scale.nrrd"),
        "surface": stage("SimplexMesherCLI", "--scale", "scale.nrrd", *surface_options, "--preparedLabelMap", "prepared.nrrd", "--ambient", "ambient.vtu", "--report", "surface.json",
                         "map.nrrd", "surface.vtp"),
        "mesh": stage("FuchsTetrahedralizerCLI", "--scale", "scale.nrrd", "--ambient", "ambient.vtu", "surface.vtp",
                      "mesh.vtu")}


def run_driver(modules, driver, *arguments):
    """Runs a driver and returns (name of the mesher, figures of the run with the seconds of its phases), or None if the
    driver is missing."""
    program = os.path.join(modules, driver)
    if not os.path.exists(program):
        return None
    figures, output = measured([program, *arguments])
    result = json.loads(output.strip().split("\n")[-1])
    return result["program"], {"whole": {**figures, "phases": result["seconds"]}}


def record_of(case, program, threads, description, stages, quality):
    record = {"case": case.name, "series": case.series, "program": program, "threads": threads, "commit": commit(),
              "machine": machine(), "input": description, "stages": stages,
              "seconds": round(sum(stage["seconds"] for stage in stages.values()), 3),
              "processorSeconds": round(sum(stage["processorSeconds"] for stage in stages.values()), 3),
              "peakMemory": max(stage["peakMemory"] for stage in stages.values()), "quality": quality}
    print(f"{case.name:32}{program:22}{threads} thread(s) {record['seconds']:9.1f} s"
          f" (processor {record['processorSeconds']:.1f} s)"
          f" {record['peakMemory'] / 1e6:9.0f} MB  {json.dumps(quality)}", flush=True)
    return record


def run_case(case, modules, threads, surface_options):
    """Yields the records of our modules for each number of threads, then those of the other meshers."""
    labels, affine = case.make()
    write_nrrd("map.nrrd", labels, affine)
    description = {"size": list(labels.shape), "spacing": case.spacing, "tissues": len(np.setdiff1d(labels, [0]))}
    del labels
    wanted = None
    for number in threads:
        stages = run_ours(case, modules, number, surface_options)
        if wanted is None:
            with open("surface.json", encoding="utf-8") as file:
                topology = json.load(file)["topology"]
            wanted = {t["label"]: (t["components"], t["components"] - t["tunnels"] + t["cavities"]) for t in topology}
            description["interfaceFaces"] = inputs.interface_faces(read_nrrd("prepared.nrrd")[0])
            quality = quality_of("mesh.vtu", wanted)
        yield record_of(case, "SurgicalMesher", number, description, stages, quality)
    peers = (("Mesh3Driver", "prepared.nrrd", "scale.nrrd", "peer.vtu", "--perturb", "--exude", "--timeLimit", "0"),
             ("TetGenDriver", "surface.vtp", "scale.nrrd", "peer.vtu"))
    for driver, *arguments in peers:
        result = run_driver(modules, driver, *arguments)
        if result:
            yield record_of(case, result[0], 1, description, result[1], quality_of("peer.vtu", wanted))


def read_records(file):
    if not os.path.exists(file):
        return []
    with open(file, encoding="utf-8") as stream:
        return json.load(stream)["runs"]


def merged(old, new):
    """Returns the new records, and the old ones that were not measured again, in the order of the cases."""
    def key(record):
        return record["case"], record["program"], record["threads"]
    order = {case.name: n for n, case in enumerate(inputs.CASES)}
    records = {key(record): record for record in old + new}
    return sorted(records.values(), key=lambda r: (order.get(r["case"], len(order)), r["program"], r["threads"]))


def require_every_case(parser, cases, records):
    """Ends the program if there is a case that neither has a record nor is about to be measured. This check comes
    before the runs, so that no time is lost on a page that would lack results."""
    known = {case.name for case in cases} | {record["case"] for record in records}
    missing = [case.name for case in inputs.CASES if case.name not in known]
    if missing:
        parser.error(f"--page: this folder has no record of {', '.join(missing)}, expected every case: "
                     "measure them, too")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("modules")
    parser.add_argument("folder")
    parser.add_argument("--case", default="")
    parser.add_argument("--threads", default="1,2")
    parser.add_argument("--page", action="store_true")
    parser.add_argument("--map")
    parser.add_argument("--targets")
    parser.add_argument("--spacing", type=float, default=1)
    parser.add_argument("--featureScale")
    arguments = parser.parse_args()
    modules = os.path.abspath(arguments.modules)
    cases = [case for case in inputs.CASES if re.search(arguments.case, case.name)]
    if arguments.map:
        if not arguments.targets:
            parser.error("--map needs --targets")
        file, focus = os.path.abspath(arguments.map), ("--targets", os.path.abspath(arguments.targets))
        series = os.path.basename(file).split(".")[0]
        if arguments.featureScale:
            series += f", featureScale {arguments.featureScale}"
        cases = [inputs.Case(series, lambda spacing: inputs.from_file(file, spacing), arguments.spacing, focus)]
    surface_options = ["--minimumIslandVolume", ISLAND_VOLUME]
    if arguments.featureScale:
        surface_options += ["--featureScale", arguments.featureScale]
    os.makedirs(arguments.folder, exist_ok=True)
    os.chdir(arguments.folder)
    records = read_records("benchmark.json")
    if arguments.page:
        require_every_case(parser, cases, records)
    for case in cases:
        new = list(run_case(case, modules, [int(n) for n in arguments.threads.split(",")], surface_options))
        records = merged(records, new)
        with open("benchmark.json", "w", encoding="utf-8") as file:
            json.dump({"runs": records}, file, indent=1)
    if arguments.page:
        import page  # pylint: disable=import-outside-toplevel  # only --page needs matplotlib
        page.write(records)


if __name__ == "__main__":
    main()
