#!/usr/bin/python3
"""Meshes whole maps of many tissues by ours and by CGAL Mesh_3 at the same scale, and names the tissues that are lost.

usage: whole_maps.py BIN OUTDIR [--case NAME FILE TARGET MIN,MAX,RADIUS,DECAY NAMES [OPTION..]].. [--document]

BIN holds the three modules and Mesh3Driver. A case consists of a name, a label map (.nii.gz, .nrrd), a target, which is
a point x,y,z (LPS, mm) or a label, whose centroid is taken, the four lengths of SurgicalPathScaleCLI, a file of tissue
names (- for none), and options of SimplexMesherCLI. With --fine VOXELS among these, tissues of fewer voxels have edges
of the minimum length. Without a case, the map is the JHU atlas. Finished maps stay in OUTDIR and are not meshed again.
Writes maps.md and maps.json; --document puts the tables into Docs/Evidence.md.
"""
import argparse
import os
import subprocess
import sys

import nibabel
import numpy as np
from scipy import ndimage

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, *folder) for folder in (("workflow", "example"), ("Testing", "Python"),
                                                           ("Testing", "Evidence"))]
import document  # noqa: E402
from brain_meshes import Programs  # noqa: E402
from fidelity import around, boundary_of_mesh  # noqa: E402
from maps import ATLAS, LPS_FROM_RAS  # noqa: E402
from measures import (components_of_mesh, dihedral_angles, euler_numbers_of_map, euler_numbers_of_mesh,  # noqa: E402
                      signed_volumes)
from meshfiles import interpolated, read_mesh, read_nrrd  # noqa: E402
from parts import Parts  # noqa: E402

LARGE = 1000  # voxels; only tissues with more count in the statistics of volumes
SPOILT = 0.25  # share of its volume; a tissue that has lost or gained more is listed
JHU = ["jhu189", ATLAS, "0,0,-10", "1,8,10,25", "-", "--minimumIslandVolume", "30"]


def options_of(arguments):
    cases, rest = [], []
    for word in arguments:
        if word == "--case":
            cases.append([])
        elif word == "--document" or not cases:
            rest.append(word)
        else:
            cases[-1].append(word)
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("programs")
    parser.add_argument("folder")
    parser.add_argument("--document", action="store_true")
    options = parser.parse_args(rest)
    if any(len(case) < 5 for case in cases):
        parser.error("--case needs a name, a map, a target, four lengths and a file of names")
    return options, cases or [JHU]


def read_names(file):
    """Maps labels to the names in a Slicer colour table or an ITK-SNAP label file; "-" stands for no file."""
    names = {}
    if file != "-":
        with open(file, encoding="utf-8") as stream:
            for fields in (line.split() for line in stream):
                if len(fields) > 1 and fields[0].isdigit():
                    names[int(fields[0])] = fields[1]
    return names


def read_map(file):
    """Returns the labels in a file and their affine to LPS mm."""
    if file.endswith(".nrrd"):
        labels, affine = read_nrrd(file)
        return labels.astype(int), affine
    image = nibabel.load(file)
    return np.rint(np.asanyarray(image.dataobj)).astype(int), LPS_FROM_RAS @ image.affine


def target_of(target, labels, affine):
    """Returns the target as SurgicalPathScaleCLI reads it: x,y,z. If `target` is a label, this is the centroid of its
    voxels."""
    if "," in target:
        return target
    middle = affine[:3, :3] @ np.argwhere(labels == int(target)).mean(axis=0) + affine[:3, 3]
    return ",".join(f"{x:.3f}" for x in middle)


def mean_distances(mesh, labels, affine):
    """Maps each label to the mean distance (mm) of its boundary in the mesh, at points 1 mm apart, from its boundary in
    the map."""
    boundary = boundary_of_mesh(mesh, 1.0)
    spacing = np.linalg.norm(affine[:3, :3], axis=0)
    result = {}
    for label, box in enumerate(ndimage.find_objects(labels), 1):
        points = around(boundary, label)
        if box is None or len(points) == 0:
            continue
        low = np.maximum([part.start - 4 for part in box], 0)
        cut = labels[tuple(slice(a, part.stop + 4) for a, part in zip(low, box))] == label
        cut, shift = np.pad(cut, 1), low - 1
        inner, outer = (ndimage.distance_transform_edt(part, spacing) for part in (cut, ~cut))
        half = 0.5 * spacing.min()
        moved = affine.copy()
        moved[:3, 3] += affine[:3, :3] @ shift
        signed = np.where(cut, half - inner, outer - half)
        result[label] = float(np.abs(interpolated(signed, moved, points)).mean())
    return result


def tissues_of(mesh, labels, affine):
    """Maps each label to its number of voxels, its volume over that in the map (0 if it is lost), whether its number of
    pieces and its Euler number are right, and its mean distance in voxels."""
    size = abs(np.linalg.det(affine[:3, :3]))
    voxels = np.bincount(labels.ravel())
    euler_map, euler, pieces = euler_numbers_of_map(labels), euler_numbers_of_mesh(mesh), components_of_mesh(mesh)
    volumes = np.bincount(mesh.tissue, signed_volumes(mesh), len(voxels))
    distances = mean_distances(mesh, labels, affine)
    result = {}
    for label in np.setdiff1d(labels, [0]).tolist():
        box = ndimage.find_objects((labels == label).astype(np.uint8))[0]
        count = ndimage.label(labels[box] == label)[1]
        there = label < len(euler)
        result[str(label)] = {
            "voxels": int(voxels[label]), "volume": float(volumes[label] / (voxels[label] * size)),
            "right": bool(there and euler[label] == euler_map[label] and pieces[label] == count),
            "distance": distances.get(label, np.inf) / size ** (1 / 3)}
    return result


def with_fine_tissues(options, run, labels, length):
    """Returns the options with --fine VOXELS replaced by a table of the small tissues, whose edges are at most `length`
    (mm)."""
    if "--fine" not in options:
        return options
    at = options.index("--fine")
    voxels = np.bincount(labels.ravel())
    small = [label for label in range(1, len(voxels)) if 0 < voxels[label] < int(options[at + 1])]
    with open(run.path("fine.csv"), "w", encoding="utf-8") as table:
        table.write("\n".join(["label,maximum", *(f"{label},{length}" for label in small)]))
    return options[:at] + (["--tissues", "fine.csv"] if small else []) + options[at + 2:]


def mesh_by(mesher, run, scale, file, options):
    """Returns the mesh of a mesher. CGAL Mesh_3 meshes the map that our modules have prepared, at the scale that they
    have followed, so they must run first."""
    if mesher == "ours":
        run("SimplexMesherCLI", "--scale", "scale.nrrd", *options, "--preparedLabelMap", "prepared.nrrd",
            "--followedScale", "followed.nrrd", "--ambient", "ambient.vtu", file, "surface.vtp")
        run("FuchsTetrahedralizerCLI", "--scale", "scale.nrrd", "--ambient", "ambient.vtu", "surface.vtp", "mesh.vtu")
        return read_mesh(run.path("mesh.vtu"))
    run("Mesh3Driver", "prepared.nrrd", "followed.nrrd", "mesh3.vtu", "--perturb", "--exude", "--facetDistance",
        scale.split(",")[0])
    return read_mesh(run.path("mesh3.vtu"))


def measured(case, mesher, run):
    name, file, target, scale, names, *options = case
    lengths = dict(zip(("--minimumEdgeLength", "--maximumEdgeLength", "--childRadius", "--decayLength"), scale.split(",")))
    file = os.path.abspath(file)
    given, affine = read_map(file)
    run.seconds = 0.0
    run("SurgicalPathScaleCLI", "--targetPoint=" + target_of(target, given, affine),
        *(word for pair in lengths.items() for word in pair), file, "scale.nrrd")
    if mesher == "ours":
        options += [] if names == "-" else ["--names", os.path.abspath(names)]
        options = with_fine_tissues(options, run, given, lengths["--minimumEdgeLength"])
    mesh = mesh_by(mesher, run, scale, file, options)
    seconds = run.seconds
    labels, affine = read_map(run.path("prepared.nrrd"))
    removed = np.setdiff1d(given, labels)
    angles = dihedral_angles(mesh)
    return {"map": name, "mesher": mesher, "seconds": seconds, "tetrahedra": len(mesh.tetrahedra),
            "smallestDihedral": float(angles.min()), "largestDihedral": float(angles.max()),
            "tissues": tissues_of(mesh, labels, affine),
            "removed": {str(label): int(np.count_nonzero(given == label)) for label in removed[removed > 0]}}


def measured_or_failed(case, mesher, run):
    try:
        return measured(case, mesher, run)
    except subprocess.CalledProcessError as failure:
        return {"map": case[0], "mesher": mesher, "failed": f"{os.path.basename(failure.cmd[0])} ended with "
                                                            f"{failure.returncode}"}


def row_of(record):
    if "failed" in record:
        return [record["map"], record["mesher"], "no mesh: " + record["failed"]] + [""] * 7
    tissues = record["tissues"].values()
    large = [abs(tissue["volume"] - 1) for tissue in tissues if tissue["voxels"] > LARGE]
    there = [tissue for tissue in tissues if np.isfinite(tissue["distance"])]
    distances = [tissue["distance"] for tissue in there]
    of_large = [tissue["distance"] for tissue in there if tissue["voxels"] > LARGE]
    given = len(tissues) + len(record["removed"])
    return [record["map"], record["mesher"], f"{len(tissues)} of {given}" if record["removed"] else given,
            f"{record['tetrahedra']:,}",
            f"{record['smallestDihedral']:.1f} .. {record['largestDihedral']:.1f}",
            sum(not tissue["right"] for tissue in tissues), sum(tissue["volume"] == 0 for tissue in tissues),
            f"{np.median(large):.2%} / {max(large):.1%}",
            f"{np.median(distances):.2f} / {max(of_large):.2f} / {max(distances):.2f}",
            f"{record['seconds']:.0f}"]


def spoilt(record, names):
    """Lists the tissues that are lost and those whose volume is off by more than SPOILT, smallest first."""
    if "failed" in record:
        return "all"
    found = sorted((tissue["voxels"], tissue["volume"], label) for label, tissue in record["tissues"].items()
                   if abs(tissue["volume"] - 1) > SPOILT)
    return ", ".join(f"{names.get(int(label), label)} ({'lost' if volume == 0 else f'{volume - 1:+.0%}'} of {voxels})"
                     for voxels, volume, label in found) or "none"


def lost_rows(record, names):
    """Yields a row of the lost tissues and, before that of our mesher, a row of the tissues that the preparation of the
    map removes for both meshers."""
    if record["mesher"] == "ours" and record.get("removed"):
        removed = sorted((voxels, names.get(int(label), label)) for label, voxels in record["removed"].items())
        yield [record["map"], "preparation", ", ".join(f"{name} ({voxels} in small islands)" for voxels, name in removed)]
    yield [record["map"], record["mesher"], spoilt(record, names)]


def tables_of(records, names):
    """Returns the tables; `names` maps each map to its names by label."""
    return {
        "whole maps": document.table(
            ["map", "mesher", "tissues", "tetrahedra", "dihedral angles (°)", "wrong", "lost",
             "volume of large tissues, median / worst", "mean distance, median / worst large / worst tissue (voxels)",
             "processor s"],
            [row_of(record) for record in records]),
        "lost tissues": document.table(
            ["map", "mesher", f"tissues lost or off by more than {SPOILT:.0%} of their volume (of so many voxels)"],
            [row for record in records for row in lost_rows(record, names[record["map"]])])}


def main():
    options, cases = options_of(sys.argv[1:])
    parts = Parts(options.folder)
    records = []
    for case in cases:
        run = Programs(options.programs, Parts(parts.path(case[0])).folder)
        for mesher in ("ours", "CGAL Mesh_3"):
            def make(case=case, mesher=mesher, run=run):
                return measured_or_failed(case, mesher, run)
            records.append(parts.record(f"{case[0]}-{mesher.split()[-1]}", make))
            print(row_of(records[-1]), flush=True)
    tables = tables_of(records, {case[0]: read_names(case[4]) for case in cases})
    document.leave(records, tables, parts.path("maps"), options.document)


if __name__ == "__main__":
    main()
