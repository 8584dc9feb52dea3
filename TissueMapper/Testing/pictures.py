# SPDX-License-Identifier: Apache-2.0
"""Draws Docs/images/optic-nerve.png: the path that TubePathCLI finds through the optic nerve of
Debian's ch2, on its T1.

    pictures.py BUILD/bin/TubePathCLI OUTPUT.png
"""
import json
import os
import subprocess
import sys
import tempfile

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import nibabel
import numpy as np

IMAGE = "/usr/share/mricron/templates/ch2.nii.gz"
POINTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "optic-nerve.mrk.json")


def traced(program):
    """Control points in voxels of the image, and the radius at each, in voxels of 1 mm."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "path.mrk.json")
        subprocess.run([program, "--points", POINTS, IMAGE, path], check=True, stdout=subprocess.DEVNULL)
        with open(path, encoding="utf-8") as file:
            curve = json.load(file)["markups"][0]
    lps = np.array([point["position"] for point in curve["controlPoints"]])
    ras = np.c_[lps * [-1, -1, 1], np.ones(len(lps))]
    voxels = (ras @ np.linalg.inv(nibabel.load(IMAGE).affine).T)[:, :3]
    return voxels, np.array(curve["measurements"][0]["controlPointValues"])


def main(program, output):
    voxels, radius = traced(program)
    image = np.asarray(nibabel.load(IMAGE).dataobj).squeeze()
    figure, axes = plt.subplots(1, 3, figsize=(9, 3.2))
    low, high = 40, 100
    for axis, level in zip(axes, (35, 36, 37)):
        axis.imshow(image[low:high, 140:200, level].T, origin="lower", cmap="gray",
                    extent=(low - 0.5, high - 0.5, 139.5, 199.5))
        step = np.gradient(voxels[:, :2], axis=0)
        across = np.c_[-step[:, 1], step[:, 0]] / np.linalg.norm(step, axis=1)[:, None]
        axis.plot(voxels[:, 0], voxels[:, 1], color="tab:red", linewidth=1.2)
        for side in (-1, 1):
            edge = voxels[:, :2] + side * radius[:, None] * across
            axis.plot(edge[:, 0], edge[:, 1], color="gold", linewidth=0.8)
        axis.set_title(f"axial, z = {level - 71} mm", fontsize=8)
        axis.set_axis_off()
    figure.tight_layout()
    figure.savefig(output, dpi=110)


if __name__ == "__main__":
    main(*sys.argv[1:])
