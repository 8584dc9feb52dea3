#!/usr/bin/python3
"""Measures balloons (BalloonSurfaceCLI) in bodies of known size and, with --head, in a head.

usage: balloons.py OUTDIR [--bin BIN] [--head FILE.nii.gz] [--only NAME...] [--document]

The bodies are a ball of radius 14 voxels and an ellipsoid of 20 x 14 x 10, with seeds off their centres, and a shell
three voxels thick around a ball of radius 17, with a hole of diameter 6 or 8, at several edge lengths. The head is
training map 08 of SynthSeg (bone 515 and 516, eyes 506, ventricles 4): an eye, a lateral ventricle, the cranial cavity
and both orbits, and how much a flood and an advancing front leak out of cavity and orbits. Prints a line for each. The
cranial cavity is also drawn, in balloon.png, after 10, 100, 300 and 1,300 motions, which needs a display: run it by
workflow/example/display.py. --document copies the picture to Docs/images. NAME is ball, ellipsoid, shell, eye,
ventricle, orbits or cranium.
"""
import argparse
import json
import os
import shutil
import subprocess
import sys
import time

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import nibabel
import numpy as np
from PIL import Image
from scipy import ndimage
from scipy.spatial import cKDTree

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, *parts) for parts in (("workflow", "example"), ("Testing", "Python"))]
from maps import LPS_FROM_RAS, write_nrrd  # noqa: E402
from meshfiles import cell_array, read_dataset, read_nrrd  # noqa: E402
from views import INK, View, actor_of, put, save_image  # noqa: E402
from vtk.util.numpy_support import vtk_to_numpy  # noqa: E402

BONE = (515, 516)
CRANIUM = {"cranial cavity": (-7, -20, 45)}
ORBITS = {"left orbit": (24, -66, -32), "right orbit": (-35, -66, -32)}


def grow(options, name, labels, affine, seeds, stop, *more):
    """Grows balloons in a map from `seeds` (name: position in LPS mm) up to the labels `stop`. Returns surfaces
    (points, triangles) by label, and the report with the seconds taken."""
    path = os.path.join(options.outdir, name.replace(" ", "-"))
    write_nrrd(path + ".nrrd", labels.astype(np.uint16), affine)
    points = [{"label": seed, "position": [float(x) for x in place]} for seed, place in seeds.items()]
    with open(path + ".mrk.json", "w") as out:
        json.dump({"markups": [{"type": "Fiducial", "coordinateSystem": "LPS", "controlPoints": points}]}, out)
    begin = time.time()
    subprocess.run([os.path.join(options.bin, "BalloonSurfaceCLI"), "--quiet", "--seeds", path + ".mrk.json",
                    "--stop", ",".join(map(str, stop)), "--labelMap", path + "-with.nrrd", "--report", path + ".json",
                    *map(str, more), path + ".nrrd", path + ".vtp"], check=True, stderr=subprocess.DEVNULL)
    with open(path + ".json") as file:
        report = json.load(file)
    report["seconds"] = time.time() - begin
    surface = read_dataset(path + ".vtp")
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    triangles = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    sides = cell_array(surface, "BoundaryLabels")
    return {int(label): (points, outwards(triangles, sides, label)) for label in np.unique(sides[sides > 0])}, report


def outwards(triangles, sides, label):
    behind, before = triangles[sides[:, 0] == label], triangles[sides[:, 1] == label]
    return np.concatenate([behind, before[:, ::-1]])


def genus(triangles):
    edges = np.unique(np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), 1),
                      axis=0)
    closed = 2 * len(edges) == 3 * len(triangles)
    return (2 - (len(np.unique(triangles)) - len(edges) + len(triangles))) // 2 if closed else None


def volume(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return float(np.einsum("ij,ij", a, np.cross(b, c)) / 6)


def face_centres(inside):
    """Returns the centres (n, 3) of the voxel faces between inside and outside, as indices."""
    faces = []
    for axis in range(3):
        for step in (1, -1):
            at = np.argwhere(inside & ~np.roll(inside, -step, axis)).astype(float)
            at[:, axis] += 0.5 * step
            faces.append(at)
    return np.concatenate(faces)


def say(name, report, surfaces, *more):
    print("%s: %d motions%s, %.1f s, %.3f of the faces within the tolerance, genus %s; %s" % (
        name, report["motions"], "" if report["atRest"] else ", NOT AT REST", report["seconds"],
        report["withinTolerance"], "/".join(str(genus(t)) for _, t in surfaces.values()), "; ".join(more)), flush=True)


# ---- bodies of known size


def grid_of(size):
    return np.moveaxis(np.indices(size), 0, -1) - 0.5 * (np.array(size) - 1.0)


def body(options, name, radii, seed):
    places = grid_of([int(2 * r) + 8 for r in radii])
    wall = (((places / radii) ** 2).sum(-1) > 1)
    centre = 0.5 * (np.array(wall.shape) - 1)
    surfaces, report = grow(options, name, wall, np.eye(4), {name: centre + seed}, [1], "--edgeLength", 2)
    points, triangles = surfaces[2]
    x = points[np.unique(triangles)] - centre
    level = np.sqrt(((x / radii) ** 2).sum(1))
    distance = np.abs(level - 1) * level / np.linalg.norm(x / np.square(radii), axis=1)
    say(name, report, surfaces, "%.2f voxel off the wall at most, %.2f in the mean" % (distance.max(), distance.mean()))


def holed_shell(options, hole, length):
    places = grid_of((47,) * 3)
    radius = np.linalg.norm(places, axis=-1)
    ball = radius <= 17
    drilled = (places[..., 2] > 0) & (np.hypot(places[..., 0], places[..., 1]) <= hole / 2)
    results = []
    for name, wall in (("holed", ~ball & (radius <= 20) & ~drilled), ("whole", ~ball & (radius <= 20))):
        surfaces, report = grow(options, "%s shell %g %g" % (name, hole, length), wall, np.eye(4),
                                {"ball": (26, 25, 19)}, [1], "--edgeLength", length)
        results.append((surfaces, report, volume(*surfaces[2])))
    surfaces, report, filled = results[0]
    points, triangles = surfaces[2]
    cap = np.linalg.norm(points[np.unique(triangles)] - 23, axis=1).max() - 17
    say("shell, hole of %g, L = %g" % (hole, length), report, surfaces,
        "volume %+.2f %% of the voxels', %+.2f %% of the closed shell's" % (
            100 * (filled / ball.sum() - 1), 100 * (filled / results[1][2] - 1)),
        "cap %.2f voxels beyond the wall" % cap)


# ---- a head


def organ(options, name, labels, affine, label, fill):
    """Measures a balloon in the largest connected piece of a label; everything else stops the balloon. The holes of the
    piece are filled, after a closing by `fill` voxels if that is not 0."""
    pieces, _ = ndimage.label(labels == label)
    inside = pieces == 1 + np.bincount(pieces.ravel())[1:].argmax()
    inside = ndimage.binary_fill_holes(ndimage.binary_closing(inside, iterations=fill) if fill else inside)
    box = tuple(slice(x.min() - 4, x.max() + 5) for x in np.nonzero(inside))
    inside, shift = inside[box], np.eye(4)
    shift[:3, 3] = [part.start for part in box]
    affine = affine @ shift
    deepest = np.unravel_index(ndimage.distance_transform_edt(inside).argmax(), inside.shape)
    surfaces, report = grow(options, name, ~inside, affine, {name: affine[:3, :3] @ deepest + affine[:3, 3]}, [1],
                            "--edgeLength", 1.5, "--rigidity", 3)
    points, triangles = surfaces[2]
    at = (points[np.unique(triangles)] - affine[:3, 3]) @ np.linalg.inv(affine[:3, :3]).T
    tree = cKDTree(at)
    off = cKDTree(face_centres(inside)).query(at)[0]
    back = tree.query(face_centres(inside))[0]
    say(name, report, surfaces, "from voxel faces %.2f voxel at most, %.2f in the mean" % (off.max(), off.mean()),
        "from voxel faces to the nearest point %.2f at most" % back.max(),
        "volume %+.1f %%" % (100 * (report["tissues"][0]["volume"] / inside.sum() - 1)))


def compartment(options, name, labels, affine, seeds, length, limit):
    more = ["--edgeLength", length, "--limit", limit, "--growth", os.path.join(options.outdir, name + ".pvd")]
    surfaces, report = grow(options, name, labels, affine, seeds, BONE, *more)
    bone = np.isin(labels, BONE)
    inverse = np.linalg.inv(affine[:3, :3])
    for label, (points, triangles) in surfaces.items():
        seed = list(seeds.values())[label - min(surfaces)]
        print("  " + near_bone(points, triangles, bone, affine, inverse, seed, limit), flush=True)
    filled, its_affine = read_nrrd(os.path.join(options.outdir, name + "-with.nrrd"))
    index = np.argwhere(filled > labels.max()) @ its_affine[:3, :3].T + its_affine[:3, 3]
    inside = np.zeros(labels.shape, bool)
    inside[tuple(np.rint((index - affine[:3, 3]) @ inverse.T).astype(int).T)] = True
    say(name, report, surfaces, leaks(bone, inside, affine, inverse, seeds, limit))
    return report


def near_bone(points, triangles, bone, affine, inverse, seed, limit):
    """Describes how far the points are from bone, for those whose normal meets bone nearby. Points at the limit of the
    balloon are left out."""
    used = np.unique(triangles)
    normals = np.zeros_like(points)
    for k in range(3):
        a, b, c = (points[triangles[:, m]] for m in range(3))
        np.add.at(normals, triangles[:, k], np.cross(b - a, c - a))
    at, n = (points[used] - affine[:3, 3]) @ inverse.T, normals[used] @ inverse.T
    n /= np.linalg.norm(n, axis=1, keepdims=True)
    hits = np.zeros(len(at), bool)
    for way in np.arange(-1.5, 3.01, 0.25):
        there = np.clip(np.rint(at + way * n).astype(int), 0, np.array(bone.shape) - 1)
        hits |= bone[tuple(there.T)]
    hits &= np.linalg.norm(points[used] - seed, axis=1) < limit - 1.5
    off = cKDTree(face_centres(bone)).query(at[hits])[0]
    return "%d points, beside bone %d: %.2f voxel from its faces' centres in the mean, within 1 %.3f, largest %.2f" % (
        len(at), hits.sum(), off.mean(), (off <= 1).mean(), off.max())


def leaks(bone, inside, affine, inverse, seeds, limit):
    places = np.moveaxis(np.indices(bone.shape), 0, -1) @ affine[:3, :3].T + affine[:3, 3]
    within = np.zeros(bone.shape, bool)
    start = np.zeros(bone.shape, bool)
    for seed in seeds.values():
        within |= np.linalg.norm(places - seed, axis=-1) <= limit
        start[tuple(np.rint((np.array(seed) - affine[:3, 3]) @ inverse.T).astype(int))] = True
    free = within & ~bone
    flood = ndimage.binary_propagation(start, mask=free)
    shapes = [ndimage.generate_binary_structure(3, 1), ndimage.generate_binary_structure(3, 3)]
    front, steps = start, 0
    while (front & inside).sum() < 0.9 * inside.sum() and steps < limit * 2:
        front = ndimage.binary_dilation(front, shapes[steps % 2], mask=free)
        steps += 1
    return "%d voxels; a flood takes %.1f times as many, a front has leaked %.1f times when nine tenths are full" % (
        inside.sum(), flood.sum() / inside.sum(), (front & ~inside).sum() / inside.sum())


def draw(options, motions):
    """Draws the balloon in the cranial cavity after several numbers of motions, obliquely from the front. If it came to
    rest earlier, its final shape is drawn."""
    folder, last = options.outdir, read_dataset(os.path.join(options.outdir, "cranium.vtp"))
    extent = vtk_to_numpy(last.GetPoints().GetData())
    motions_shown, size = (10, 100, 300, 1300), (500, 420)
    figure = plt.figure(figsize=(len(motions_shown) * size[0] / 100, (size[1] + 40) / 100), dpi=100)
    for n, motion in enumerate(motions_shown):
        rests = motion >= motions
        surface = last if rests else read_dataset(os.path.join(folder, "cranium-%d.vtp" % motion))
        view = View([actor_of(surface, 0.5, (0.93, 0.82, 0.7))], (-1, 1, 0.24), size, extent)
        put(figure, view, n * size[0], 0)
        title = "{:,} motions".format(motion) + (" (at rest since {})".format(motions) if rests else "")
        figure.text((n + 0.5) / len(motions_shown), 0.985, title, ha="center", va="top", fontsize=16, color=INK)
    figure.canvas.draw()
    picture = os.path.join(folder, "balloon.png")
    save_image(Image.fromarray(np.asarray(figure.canvas.buffer_rgba())), picture, palette=True)
    if options.document:
        shutil.copy(picture, os.path.join(ROOT, "Docs", "images"))


def parse():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("outdir")
    parser.add_argument("--bin", default=os.path.join(ROOT, "build", "bin"))
    parser.add_argument("--head")
    parser.add_argument("--only", nargs="+")
    parser.add_argument("--document", action="store_true")
    return parser.parse_args()


def main():
    options = parse()
    os.makedirs(options.outdir, exist_ok=True)
    wanted = lambda name: not options.only or name in options.only
    if wanted("ball"):
        body(options, "ball", np.array([14.0, 14, 14]), (4, 3, -2))
    if wanted("ellipsoid"):
        body(options, "ellipsoid", np.array([20.0, 14, 10]), (7, -3, 2))
    for hole in (6, 8):
        for length in (0.6, 1.28, 2.5):
            if wanted("shell"):
                holed_shell(options, hole, length)
    if not options.head:
        return
    image = nibabel.load(options.head)
    labels, affine = np.asanyarray(image.dataobj).astype(np.uint16), LPS_FROM_RAS @ image.affine
    if wanted("eye"):
        organ(options, "eye", labels, affine, 506, 3)
    if wanted("ventricle"):
        organ(options, "ventricle", labels, affine, 4, 0)
    if wanted("orbits"):
        compartment(options, "orbits", labels, affine, ORBITS, 2, 26)
    if wanted("cranium"):
        draw(options, compartment(options, "cranium", labels, affine, CRANIUM, 4, 143)["motions"])


if __name__ == "__main__":
    main()
