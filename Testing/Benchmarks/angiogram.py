# SPDX-License-Identifier: Apache-2.0
"""Compares paths through a vessel tree, each traced from two points, with the tree that a threshold shows.

    angiogram.py TUBEPATHCLI ANGIOGRAM COUNT THRESHOLD

The tree is the largest connected piece of voxels brighter than THRESHOLD. Its ridge consists of the voxels whose
distance from the outside is, along at least two axes, no smaller than that of both neighbours. The ends of the paths
are COUNT random pairs of ridge voxels at least 0.8 mm deep and 25 to 45 mm apart along the tree. Prints for each path
its length and that of the way through the tree's voxels, the share of its points inside the tree, the mean and largest
distance to the ridge (mm), and the time.
"""
import json
import os
import subprocess
import sys
import tempfile
import time

import nibabel
import numpy as np
from scipy import ndimage, sparse
from scipy.spatial import cKDTree

DEPTH, NEAREST, FARTHEST = 0.8, 25, 45  # mm


def largest_piece(mask):
    pieces, _ = ndimage.label(mask, np.ones((3, 3, 3)))
    return pieces == np.argmax(np.bincount(pieces.ravel())[1:]) + 1


def ridge_of(depth):
    axes = np.zeros(depth.shape, int)
    for axis in range(3):
        axes += (depth >= np.roll(depth, 1, axis)) & (depth >= np.roll(depth, -1, axis))
    return (depth > 0) & (axes >= 2)


def ways(voxels, spacing):
    """Returns the graph of neighbouring voxels (n, 3), whose edges are weighted with their distance (mm)."""
    pairs = cKDTree(voxels).query_pairs(1.8, output_type="ndarray")
    length = np.linalg.norm((voxels[pairs[:, 0]] - voxels[pairs[:, 1]]) * spacing, axis=1)
    return sparse.coo_matrix((length, pairs.T), (len(voxels),) * 2).tocsr()


def traced(program, image, points, folder):
    markup = {"type": "Curve", "coordinateSystem": "RAS", "coordinateUnits": "mm",
              "controlPoints": [{"label": "", "position": p.tolist()} for p in points]}
    files = [os.path.join(folder, name) for name in ("points.mrk.json", "path.mrk.json")]
    with open(files[0], "w", encoding="utf-8") as file:
        json.dump({"markups": [markup]}, file)
    begin = time.monotonic()
    subprocess.run([program, "--points", files[0], "--polarity", "bright", image, files[1]], check=True,
                   stdout=subprocess.DEVNULL)
    seconds = time.monotonic() - begin
    with open(files[1], encoding="utf-8") as file:
        path = json.load(file)["markups"][0]
    flip = [-1, -1, 1] if path["coordinateSystem"] == "LPS" else [1, 1, 1]
    return np.array([p["position"] for p in path["controlPoints"]]) * flip, seconds


def main(program, file, count, threshold):
    image = nibabel.load(file)
    spacing = np.array(image.header.get_zooms()[:3])
    tree = largest_piece(np.asarray(image.dataobj) > float(threshold))
    depth = ndimage.distance_transform_edt(np.pad(tree, 1), sampling=spacing)[1:-1, 1:-1, 1:-1]
    voxels = np.argwhere(tree)
    ridge = nibabel.affines.apply_affine(image.affine, np.argwhere(ridge_of(depth)))
    nearest = cKDTree(ridge)
    graph = ways(voxels, spacing)
    deep = np.flatnonzero((ridge_of(depth) & (depth >= DEPTH))[tuple(voxels.T)])
    random = np.random.default_rng(1)
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        while len(rows) < int(count):
            start = random.choice(deep)
            far = sparse.csgraph.dijkstra(graph, directed=False, indices=start, limit=FARTHEST)
            ends = deep[(far[deep] >= NEAREST) & (far[deep] <= FARTHEST)]
            if not len(ends):
                continue
            end = random.choice(ends)
            places = nibabel.affines.apply_affine(image.affine, voxels[[start, end]])
            path, seconds = traced(program, file, places, folder)
            length = np.linalg.norm(np.diff(path, axis=0), axis=1).sum()
            at = np.rint(nibabel.affines.apply_affine(np.linalg.inv(image.affine), path)).astype(int)
            inside = tree[tuple(np.clip(at, 0, np.array(tree.shape) - 1).T)].mean()
            distance = nearest.query(path)[0]
            rows.append([inside, distance.mean(), distance.max(), seconds])
            print(f"path {len(rows):2d}  {length:5.1f} mm of {far[end]:5.1f}  inside {inside:.3f}  to the ridge "
                  f"{distance.mean():.2f} mm, largest {distance.max():.2f}  {seconds:.1f} s", flush=True)
    print(f"all {len(rows)}: inside {np.mean(rows, 0)[0]:.3f}, least {np.min(rows, 0)[0]:.3f}; to the ridge "
          f"{np.mean(rows, 0)[1]:.2f} mm, largest mean {np.max(rows, 0)[1]:.2f}")


if __name__ == "__main__":
    main(*sys.argv[1:])
