# SPDX-License-Identifier: Apache-2.0
"""Measures how near LocalRegistrationCLI comes to a known pose or distortion.

    registration.py starts LOCALREGISTRATIONCLI CT T1 COUNT [OPTION]...   COUNT poses off by up to 20 mm and 15 degrees
    registration.py local LOCALREGISTRATIONCLI CT T1 X,Y,Z RADIUS         4 mm of smooth distortion at a target

CT and T1 show one head in one frame (simulate.py makes such a CT). A pose is a rotation about the middle of the head
and a shift, which are written to the header of the T1; its error (mm) is that of 2,000 random voxels of soft tissue or
bone (over -500 HU). A distortion moves the T1 along y, by 4 mm at the target and less far from it, by a Gaussian of
25 mm; its error is measured within 15 mm of the target.
"""
import json
import os
import subprocess
import sys
import tempfile

import nibabel
import numpy as np
from scipy import ndimage


def run(program, fixed, moving, folder, options):
    report = os.path.join(folder, "report.json")
    result = subprocess.run([program, *options, "--report", report, fixed, moving, os.path.join(folder, "out.nrrd")],
                            capture_output=True, text=True, check=False)
    if result.returncode:
        return None, result.stderr.strip()
    with open(report, encoding="utf-8") as file:
        return json.load(file), ""


def head_points(ct, count, random):
    image = nibabel.load(ct)
    voxels = np.argwhere(np.asarray(image.dataobj) > -500)
    chosen = voxels[random.choice(len(voxels), count, replace=False)]
    return nibabel.affines.apply_affine(image.affine, chosen)


FLIP = np.diag([-1.0, -1.0, 1.0])  # RAS to LPS


def mapped(rows, ras):
    """Returns the points `ras` (n, 3; RAS) after the map `rows` (3 x 4), which is in LPS."""
    rows = np.asarray(rows)
    return ((ras @ FLIP) @ rows[:, :3].T + rows[:, 3]) @ FLIP


def rotation(vector):
    angle = np.linalg.norm(vector)
    x, y, z = vector / angle
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * k + (1 - np.cos(angle)) * k @ k


def random_pose(random, middle):
    """Returns a 4 x 4 matrix in RAS: a rotation of 3 to 15 degrees about `middle` and a shift of 4 to 20 mm."""
    direction, axis = (v / np.linalg.norm(v) for v in random.normal(size=(2, 3)))
    turn = rotation(axis * np.radians(15) * random.uniform(0.2, 1))
    pose = np.eye(4)
    pose[:3, :3] = turn
    pose[:3, 3] = middle - turn @ middle + direction * 20 * random.uniform(0.2, 1)
    return pose


def starts(program, ct, t1, count, *options):
    random = np.random.default_rng(3)
    points = head_points(ct, 2000, random)
    image = nibabel.load(t1)
    errors = []
    with tempfile.TemporaryDirectory() as folder:
        moved = os.path.join(folder, "t1.nii")
        for n in range(int(count)):
            pose = random_pose(random, points.mean(0))
            nibabel.save(nibabel.Nifti1Image(np.asarray(image.dataobj), pose @ image.affine), moved)
            report, refusal = run(program, ct, moved, folder, options)
            if report is None:
                print(f"start {n + 1:2d}  refused: {refusal}", flush=True)
                errors.append(np.inf)
                continue
            found = mapped(report["global"], points)
            distance = np.linalg.norm(found - nibabel.affines.apply_affine(pose, points), axis=1)
            errors.append(distance.mean())
            print(f"start {n + 1:2d}  mean {distance.mean():.3f}  largest {distance.max():.3f} mm", flush=True)
    print(f"all {len(errors)}: mean {np.mean(errors):.3f}, largest mean {np.max(errors):.3f} mm")


def local(program, ct, t1, target, radius):
    image = nibabel.load(t1)
    values = np.asarray(image.dataobj).squeeze().astype(np.float32)
    centre = np.array([float(x) for x in target.split(",")]) @ FLIP

    def shift(ras):
        return np.exp(-((ras - centre) ** 2).sum(-1) / (2 * 25 ** 2))[..., None] * np.array([0, 4.0, 0])

    grid = np.stack(np.meshgrid(*map(np.arange, values.shape), indexing="ij"), -1)
    ras = nibabel.affines.apply_affine(image.affine, grid)
    back = nibabel.affines.apply_affine(np.linalg.inv(image.affine), ras + shift(ras))
    warped = ndimage.map_coordinates(values, np.moveaxis(back, -1, 0), order=1)
    random = np.random.default_rng(4)
    points = random.normal(size=(2000, 3))
    points *= (15 * random.uniform(size=2000) ** (1 / 3) / np.linalg.norm(points, axis=1))[:, None]
    points += centre
    true = points - shift(points)  # a first guess: a point x has moved to the x' for which x' + shift(x') = x
    for _ in range(20):
        true = points - shift(true)
    with tempfile.TemporaryDirectory() as folder:
        moved = os.path.join(folder, "t1.nii")
        nibabel.save(nibabel.Nifti1Image(warped, image.affine), moved)
        report, refusal = run(program, ct, moved, folder, ["--sphere", f"{target},{radius}"])
    if report is None:
        print("refused: " + refusal)
        return
    for stage in ("global", "local"):
        error = np.linalg.norm(mapped(report[stage], points) - true, axis=1)
        print(f"{stage:6s}  mean {error.mean():.3f}  median {np.median(error):.3f}  largest {error.max():.3f} mm "
              f"within 15 mm of the target")


if __name__ == "__main__":
    commands = {"starts": starts, "local": local}
    if len(sys.argv) < 5 or sys.argv[1] not in commands:
        sys.exit(__doc__)
    commands[sys.argv[1]](*sys.argv[2:])
