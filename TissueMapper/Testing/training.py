# SPDX-License-Identifier: Apache-2.0
"""Draws training points from a label map, and compares a classified map with it.

    training.py draw TRUTH COUNT SEED POINTS.mrk.json     COUNT random voxels of each class as labelled control points
    training.py compare TRUTH MAP                         share of the head's voxels that are right, Dice by class

TRUTH has BrainWeb's labels of Colin27; glial matter (8), which has no brightness of its own, is no class.
"""
import json
import sys

import nibabel
import numpy as np

NAMES = {1: "CSF", 2: "grey matter", 3: "white matter", 4: "fat", 5: "muscle", 6: "skin", 7: "skull",
         9: "connective tissue"}


def draw(truth, count, seed, output):
    image = nibabel.load(truth)
    labels = np.asarray(image.dataobj).squeeze()
    random = np.random.default_rng(int(seed))
    points = []
    for label, name in NAMES.items():
        voxels = np.argwhere(labels == label)
        chosen = voxels[random.choice(len(voxels), int(count), replace=False)]
        ras = np.c_[chosen, np.ones(len(chosen))] @ image.affine.T
        points += [{"label": name, "position": [-x, -y, z]} for x, y, z in ras[:, :3].tolist()]
    markup = {"type": "Fiducial", "coordinateSystem": "LPS", "coordinateUnits": "mm", "controlPoints": points}
    with open(output, "w", encoding="utf-8") as file:
        json.dump({"markups": [markup]}, file, indent=1)
        file.write("\n")


def compare(truth, found):
    """Both on the same grid; MAP's labels are 1, 2, ... in the order of NAMES."""
    true = np.asarray(nibabel.load(truth).dataobj).squeeze()
    number = np.zeros(len(NAMES) + 1, int)
    number[1:] = list(NAMES)
    classified = number[np.asarray(nibabel.load(found).dataobj).squeeze().astype(int)]
    if nibabel.load(truth).affine[0, 0] * nibabel.load(found).affine[0, 0] < 0:
        classified = classified[::-1]
    if nibabel.load(truth).affine[1, 1] * nibabel.load(found).affine[1, 1] < 0:
        classified = classified[:, ::-1]
    dice = {name: 2 * np.sum((true == label) & (classified == label)) / (np.sum(true == label) +
                                                                        np.sum(classified == label))
            for label, name in NAMES.items()}
    print(f"right {np.mean((true == classified)[true != 0]):.3f}  mean Dice {np.mean(list(dice.values())):.3f}")
    for label, name in NAMES.items():
        false = np.sum((classified == label) & (true != label))
        print(f"  {name:18s} Dice {dice[name]:.3f}  false positives {false}")


if __name__ == "__main__":
    {"draw": draw, "compare": compare}[sys.argv[1]](*sys.argv[2:])
