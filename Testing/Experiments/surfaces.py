#!/usr/bin/python3
"""Repeats the surface experiments of Audette et al. 2007 (figures 5 to 8) by the command line.

usage: surfaces.py FOLDER [--bin BIN] [--head HEAD] [--case NAME]... [--no-pictures]

The experiments are a cube with four openings and a gland (cube), the outside of a brain (brain), and tubes (tubes).
HEAD is a folder with head_08.nii.gz (256^3 voxels, 53 tissues) and head_08.path.mrk.json; with it, there are also the
arteries, veins and optic nerves of that head (vessels), and the head along the path through its nose (path). Writes to
FOLDER the surfaces, their evolution, surfaces.md, surfaces.json and a picture of each; pictures need a display: run it
by workflow/example/display.py.

A face of the simplex mesh belongs to a point of the surface and to a tissue there. Its centre is the mean of the
vertices around it, which are the centroids of the point's triangles. Distances are measured from these centres to the
marching cubes surface of the tissue, and back from the centroids of that surface's triangles.
"""
import argparse
import csv
import json
import os
import subprocess
import sys
from types import SimpleNamespace

import nibabel
import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, *parts) for parts in (("Testing", "Experiments"), ("Testing", "Python"),
                                                         ("Testing", "Benchmarks"))]
from inputs import from_file  # noqa: E402
from maps import LPS_FROM_RAS, cut_out, write_nrrd  # noqa: E402

MOST_SAMPLES = 60000  # of the distance back, for all tissues of a case together
VESSELS = (85, 502, 514, 530)  # labels of optic chiasm, arteries, veins and optic nerves in the head


# ---- maps

def cube(_):
    """Returns a hollow cube with four openings and a hemisphere under its inner ceiling, as in SimplexExperiments."""
    x, y, z = np.meshgrid(*[np.arange(64) - 31.5] * 3, indexing="ij", sparse=True)
    outer = np.maximum(np.maximum(np.abs(x), np.abs(y)), np.abs(z))
    gland = (z < 16) & (x**2 + y**2 + (z - 16)**2 < 64)
    opening = z**2 + np.minimum(x**2, y**2) < 49
    return (gland | ((outer < 24) & (outer > 16) & ~opening)).astype(np.uint16), np.eye(4)


def brain(_):
    """Returns all tissues of the JHU atlas as one, with every third voxel along each axis."""
    labels, affine = cut_out(np.s_[0:, 0:, 0:])
    return (np.squeeze(labels)[::3, ::3, ::3] > 0).astype(np.uint16), affine @ np.diag([3, 3, 3, 1])


def tubes(_):
    """Returns a forked artery and two nerves that cross."""
    points = np.stack(np.meshgrid(np.arange(48), np.arange(56), np.arange(48), indexing="ij"), axis=-1).astype(float)

    def within(segments, radius):
        found = np.zeros(points.shape[:3], bool)
        for start, end in np.asarray(segments, float):
            way = end - start
            at = np.clip((points - start) @ way / (way @ way), 0, 1)
            found |= np.linalg.norm(points - start - at[..., None] * way, axis=-1) < radius
        return found

    fork, crossing = (24, 22, 26), (24, 38, 24)
    artery = within((((24, 20, 4), fork), (fork, (12, 26, 44)), (fork, (37, 25, 44))), 3)
    nerves = within((((8, 44, 8), crossing), ((40, 44, 8), crossing), (crossing, (10, 40, 42)),
                     (crossing, (38, 40, 42))), 2.2)
    return np.where(artery, 1, np.where(nerves, 2, 0)).astype(np.uint16), np.eye(4)


def head(folder):
    return from_file(os.path.join(folder, "head_08.nii.gz"), 1.0)


def vessels(folder):
    labels, affine = head(folder)
    return np.where(np.isin(labels, VESSELS), labels, 0).astype(np.uint16), affine


def case(name, make, scale, mesher, near, far, faces=None, view=((0.5, 1, -0.35), (0, 0, 1)), needs_head=False):
    """Describes an experiment. `near` and `far` are the proximity (mm) where edges are shortest and longest; `faces`
    are the least and the largest number of faces in the paper."""
    return SimpleNamespace(name=name, make=make, scale=scale, mesher=mesher, near=near, far=far, faces=faces, view=view,
                           needs_head=needs_head)


CASES = (
    case("cube", cube, "--targetPoint 31.5,31.5,43.5 --minimumEdgeLength 2 --maximumEdgeLength 12 --childRadius 10 "
                       "--decayLength 20", "", 0.25, 2, (0, 603)),
    case("brain", brain, "--targetPoint 0,0,-10 --minimumEdgeLength 4 --maximumEdgeLength 15 --childRadius 10 "
                         "--decayLength 35", "--minimumIslandVolume 10000 --minimumCavityVolume 10000", 0.8, 3.6,
         (998, 1103), view=((0.3, 0.25, 1), (0, 1, 0))),
    case("tubes", tubes, "", "--edgeLength 2", 0.4, 0.4, view=((0.3, 1, -0.25), (0, 0, 1))),
    case("vessels", vessels, "", "--edgeLength 1.5 --minimumIslandVolume 200", 0.5, 0.5, view=((0.3, 1, -0.25), (0, 0, 1)),
         needs_head=True),
    case("path", head, "--path {head}/head_08.path.mrk.json --minimumEdgeLength 1 --maximumEdgeLength 8 --childRadius 10 "
                       "--decayLength 25", "--minimumIslandVolume 30 --featureScale 0.5", 0.5, 2,
         view=((-1, 0.15, -0.1), (0, 0, 1)), needs_head=True),
)


# ---- runs

def run(program, *arguments):
    subprocess.run([program, *arguments], check=True, stdout=subprocess.DEVNULL)


def mesh(case_, options):
    """Meshes a case and returns the names of its files by their kind."""
    files = {kind: os.path.join(options.folder, f"{case_.name}{end}")
             for kind, end in (("map", "-map.nrrd"), ("scale", "-scale.nrrd"), ("prepared", "-prepared.nii.gz"),
                               ("surface", ".vtp"), ("simplex", "-simplex.vtp"), ("evolution", "-evolution.csv"),
                               ("report", ".json"))}
    write_nrrd(files["map"], *case_.make(options.head))
    lengths = []
    if case_.scale:
        run(os.path.join(options.bin, "SurgicalPathScaleCLI"), *case_.scale.format(head=options.head).split(),
            files["map"], files["scale"])
        lengths = ["--scale", files["scale"]]
    run(os.path.join(options.bin, "SimplexMesherCLI"), *lengths, *case_.mesher.split(), "--proximity",
        f"{case_.near},{case_.far}", "--preparedLabelMap", files["prepared"], "--simplexMesh", files["simplex"],
        "--evolution", files["evolution"], "--report", files["report"], files["map"], files["surface"])
    return files


def evolution(file):
    with open(file, encoding="utf-8") as stream:
        return [{key: float(value) for key, value in row.items() if key != "stage"} for row in csv.DictReader(stream)]


def from_first_level(files):
    """Returns the steps of the evolution without the first, the lattice, whose faces are those of the voxels."""
    return evolution(files["evolution"])[1:]


# ---- measures

def read_polydata(file):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(file)
    reader.Update()
    return reader.GetOutput()


def read_map(file):
    """Returns the labels in a NIfTI file and their affine to LPS."""
    image = nibabel.load(file)
    return np.asanyarray(image.dataobj).astype(np.uint16), LPS_FROM_RAS @ image.affine


def polydata(points, triangles):
    surface, cells, place = vtk.vtkPolyData(), vtk.vtkCellArray(), vtk.vtkPoints()
    cells.SetData(3, numpy_to_vtk(np.ascontiguousarray(triangles, np.int64).ravel(), deep=True,
                                  array_type=vtk.VTK_ID_TYPE))
    place.SetData(numpy_to_vtk(np.ascontiguousarray(points, float), deep=True))
    surface.SetPoints(place)
    surface.SetPolys(cells)
    return surface


def marching_cubes(labels, affine, label):
    """Returns the points (mm) and triangles of the marching cubes surface around one label."""
    at = np.argwhere(labels == label)
    low, high = at.min(axis=0), at.max(axis=0) + 1
    box = np.pad((labels[tuple(slice(a, b) for a, b in zip(low, high))] == label).astype(np.float32), 1)
    image, filter_ = vtk.vtkImageData(), vtk.vtkFlyingEdges3D()
    image.SetDimensions(*box.shape)
    image.GetPointData().SetScalars(numpy_to_vtk(box.ravel(order="F"), deep=True))
    filter_.SetInputData(image)
    filter_.SetValue(0, 0.5)
    filter_.ComputeNormalsOff()
    filter_.Update()
    found = filter_.GetOutput()
    points = vtk_to_numpy(found.GetPoints().GetData()).astype(float) + low - 1
    triangles = vtk_to_numpy(found.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return points @ affine[:3, :3].T + affine[:3, 3], triangles


class Nearest:
    """Returns, when called with positions, their distances to a triangulated surface and the nearest triangles."""

    def __init__(self, points, triangles):
        self._surface, self._locator = polydata(points, triangles), vtk.vtkStaticCellLocator()
        self._locator.SetDataSet(self._surface)
        self._locator.BuildLocator()

    def __call__(self, places):
        at, cell, sub, squared = [0.0, 0.0, 0.0], vtk.reference(0), vtk.reference(0), vtk.reference(0.0)
        found = []
        for place in places:
            self._locator.FindClosestPoint(place, at, cell, sub, squared)
            found.append((float(squared)**0.5, int(cell)))
        distances, cells = zip(*found)
        return np.array(distances), np.array(cells)


def face_centres(points, triangles):
    """Returns the ids of the points that have triangles, and for each the mean of the centroids of its triangles."""
    centroids = np.repeat(points[triangles].mean(axis=1), 3, axis=0)
    ids, at = np.unique(triangles, return_inverse=True)
    at = at.ravel()
    count = np.bincount(at)
    return ids, np.column_stack([np.bincount(at, centroids[:, a]) / count for a in range(3)])


def measured(case_, files):
    """Returns the numbers of faces and the distances, everywhere and near the target. `excess` is the largest ratio of
    a distance to the proximity at its place."""
    surface = read_polydata(files["surface"])
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    triangles = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    sides = vtk_to_numpy(surface.GetCellData().GetArray("BoundaryLabels"))
    length = vtk_to_numpy(surface.GetPointData().GetArray("TargetEdgeLength")).astype(float)
    labels, affine = read_map(files["prepared"])
    low, high = length.min(), length.max()
    bound = case_.near + (case_.far - case_.near) * (length - low) / max(high - low, 1e-9)
    result = {"out": [], "back": [], "nearOut": [], "nearBack": [], "excess": [0.0]}
    tissues = [label for label in np.unique(labels) if label]
    random = np.random.default_rng(1)
    for label in tissues:
        own = triangles[(sides == label).any(axis=1)]
        dense, faces = marching_cubes(labels, affine, label)
        ids, centres = face_centres(points, own)
        out, _ = Nearest(dense, faces)(centres)
        middles = dense[faces].mean(axis=1)
        most = max(500, MOST_SAMPLES // len(tissues))
        back, cells = Nearest(points, own)(middles if len(middles) <= most else random.choice(middles, most, False))
        for kind, distance, at, bounds in (("Out", out, length[ids], bound[ids]),
                                           ("Back", back, length[own[cells]].mean(axis=1), bound[own[cells]].mean(axis=1))):
            result[kind.lower()].append(distance)
            result["near" + kind].append(distance[at <= 1.02 * low])
            result["excess"].append((distance / bounds).max())
    figures = {key: np.concatenate(value) for key, value in result.items() if key != "excess"}
    steps = from_first_level(files)
    return {"faces": len(points), "triangles": len(triangles), "tissues": len(tissues),
            "startFaces": int(max(step["faces"] for step in steps) / 2),
            "excess": max(result["excess"]), "T1": sum(s["T1"] for s in steps), "T2": sum(s["T2"] for s in steps),
            "T7": sum(s["T7"] for s in steps), "beyond": last_step(files["report"])["samplesBeyondTolerance"],
            "backMean": figures["back"].mean(),
            **{key + "Maximum": value.max() if len(value) else 0 for key, value in figures.items()}}


def last_step(report):
    with open(report, encoding="utf-8") as stream:
        return json.load(stream)["evolution"][-1]


# ---- table and pictures

COLUMNS = (("experiment", lambda case_, row: case_.name),
           ("tissues", lambda _, row: row["tissues"]),
           ("faces, from most to last", lambda _, row: f"{row['startFaces']:,} to {row['faces']:,}"),
           ("T1, T2, T7", lambda _, row: f"{row['T1']:,.0f}, {row['T2']:,.0f}, {row['T7']:,.0f}"),
           ("proximity", lambda case_, row: f"{case_.near:g} to {case_.far:g}"),
           ("face centres to boundary, max", lambda _, row: f"{row['outMaximum']:.2f}"),
           ("near target", lambda _, row: f"{row['nearOutMaximum']:.2f}"),
           ("from boundary, mean", lambda _, row: f"{row['backMean']:.2f}"),
           ("max", lambda _, row: f"{row['backMaximum']:.2f}"),
           ("near target", lambda _, row: f"{row['nearBackMaximum']:.2f}"))


def table_of(rows):
    lines = ["| " + " | ".join(title for title, _ in COLUMNS) + " |", "|" + "---|" * len(COLUMNS)]
    lines += ["| " + " | ".join(str(text(*row)) for _, text in COLUMNS) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def draw(case_, files, folder):
    import pictures

    surface = read_polydata(files["surface"])
    simplex = pictures.with_distance(read_polydata(files["simplex"]), surface)
    steps = from_first_level(files)
    shown = pictures.those(simplex, pictures.each_once(simplex, surface))
    panels = [("simplex mesh", pictures.picture(shown, *case_.view, by_distance=True)),
              ("its dual", pictures.picture(surface, *case_.view))]
    curves = [step["step"] for step in steps], {"faces": [step["faces"] / 2 for step in steps],
                                                "meanDistance": [step["meanDistance"] for step in steps]}
    pictures.sheet(panels, os.path.join(folder, f"surfaces-{case_.name}.png"), f"{surface.GetNumberOfPoints():,} faces",
                   curves=curves)


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("folder")
    parser.add_argument("--bin", default=os.path.join(ROOT, "build", "bin"))
    parser.add_argument("--head")
    parser.add_argument("--case", action="append")
    parser.add_argument("--no-pictures", action="store_true")
    options = parser.parse_args()
    os.makedirs(options.folder, exist_ok=True)
    rows = []
    for case_ in CASES:
        if case_.needs_head and not options.head or options.case and case_.name not in options.case:
            continue
        files = mesh(case_, options)
        rows.append((case_, measured(case_, files)))
        if not options.no_pictures:
            draw(case_, files, options.folder)
    table = table_of(rows)
    for end, text in ((".md", table), (".json", json.dumps({c.name: row for c, row in rows}, indent=1, default=float))):
        with open(os.path.join(options.folder, "surfaces" + end), "w", encoding="utf-8") as file:
            file.write(text)
    print(table)


if __name__ == "__main__":
    main()
