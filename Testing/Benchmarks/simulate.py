# SPDX-License-Identifier: Apache-2.0
"""Simulates images that a scanner might make of a known map of tissues.

    simulate.py TRUTH CT.nii.gz [--spacing X,Y,Z] [--crop MM] [--headrest] [--noise HU] [--seed N]
    simulate.py TRUTH T1.nii.gz --t1 [--seed N]
    simulate.py TRUTH T1.nii.gz --of T1_AS_IT_IS.nii.gz [--seed N]

TRUTH has BrainWeb's labels of Colin27 or, if a label is over 9, those of FreeSurfer and SimNIBS. A CT has Hounsfield
units by label (HOUNSFIELD, HEAD), blurred by a Gaussian of 0.6 mm, and white noise, by default of 20 HU. --crop cuts
off that many mm at the top and at the bottom; --headrest adds a curved plate of 8 mm behind the head. --t1 makes a T1
with the brightness of each label (HEAD), blurred in the same way; --of starts from a T1 as it is. Both get a smooth
drift of brightness from 0.9 to 1.1, and Rician noise of 3 % of white matter's mean.
"""
import argparse

import nibabel
import numpy as np
from scipy import ndimage

HOUNSFIELD = [-1000, 10, 38, 30, -90, 55, 25, 900, 33, -30]
"""By label: air, CSF, grey matter, white matter, fat, muscle, skin, skull, glial matter, connective tissue."""

HEAD = {
    "CSF": (30, 10, [4, 5, 14, 15, 24, 43, 44]),
    "grey matter": (80, 38, [3, 8, 10, 11, 12, 13, 17, 18, 26, 42, 47, 49, 50, 51, 52, 53, 54, 58, 136, 137, 163, 164]),
    "white matter": (110, 30, [2, 7, 16, 25, 28, 41, 46, 57, 60, 85, 512]),
    "other tissue": (135, -40, [507]),
    "eye muscle": (60, 55, [508]),
    "skin": (75, 25, [511]),
    "skull": (12, 900, [515]),
    "marrow": (50, 400, [516]),
    "eye": (28, 8, [506]),
    "artery": (150, 50, [30, 62, 502]),
    "vein": (42, 60, [514]),
    "optic nerve": (98, 34, [530]),
    "mucosa": (92, 45, [509]),
}
"""By tissue of a SimNIBS head: brightness in a T1 (arteries bright by inflow, veins dark), HU, labels."""


def is_brainweb(labels):
    return labels.max() < len(HOUNSFIELD)


def values_by_label(labels, column):
    """Returns the brightness in a T1 (`column` 0) or the HU (`column` 1) of every voxel."""
    if is_brainweb(labels):
        if column == 0:
            raise SystemExit("--t1 needs a head of SimNIBS; of Colin27 there is a T1 (--of)")
        return np.array(HOUNSFIELD, np.float32)[labels]
    table = np.full(labels.max() + 1, (0, -1000)[column], np.float32)
    for tissue in HEAD.values():
        table[[label for label in tissue[2] if label < len(table)]] = tissue[column]
    return table[labels]


def white_matter(labels):
    return labels == 3 if is_brainweb(labels) else np.isin(labels, HEAD["white matter"][2])


def resample(values, affine, spacing):
    factor = np.array(spacing) / nibabel.affines.voxel_sizes(affine)
    size = np.floor((np.array(values.shape) - 1) / factor).astype(int) + 1
    return (ndimage.affine_transform(values, np.diag(factor), output_shape=tuple(size), order=1),
            affine @ np.diag([*factor, 1]))


def headrest(values, affine):
    """Returns the values (HU) with a plate behind the head, which is denser than soft tissue."""
    places = nibabel.affines.apply_affine(
        affine, np.stack(np.meshgrid(*map(np.arange, values.shape), indexing="ij"), -1))
    head = values > -500
    back = places[..., 1][head].min()
    radius = np.hypot(places[..., 0] - places[..., 0][head].mean(), places[..., 1] - (back + 95))
    plate = (radius > 97) & (radius < 105) & (places[..., 1] < back + 40) & ~head
    return np.where(plate, np.float32(150), values)


def crop(values, affine, mm):
    """Returns the values without `mm` at both ends of the axis that runs up and down, and their affine."""
    axis = int(np.argmax(np.abs(affine[2, :3])))
    count = int(round(mm / nibabel.affines.voxel_sizes(affine)[axis]))
    kept = [slice(None)] * 3
    kept[axis] = slice(count, values.shape[axis] - count)
    moved = affine.copy()
    moved[:3, 3] += affine[:3, axis] * count
    return values[tuple(kept)], moved


def blurred(values, affine):
    return ndimage.gaussian_filter(values, 0.6 / nibabel.affines.voxel_sizes(affine))


def noisy(values, truth, seed):
    x, y, z = np.meshgrid(*[np.linspace(-1, 1, n) for n in values.shape], indexing="ij")
    drift = 0.6 * x + 0.5 * y - 0.7 * z + 0.5 * x * y + 0.4 * z * z - 0.3 * y * y
    drift = 0.9 + 0.2 * (drift - drift.min()) / (drift.max() - drift.min())
    random = np.random.default_rng(seed)
    noise = 0.03 * values[white_matter(truth)].mean()
    return np.abs(values * drift + random.normal(0, noise, values.shape) + 1j * random.normal(0, noise, values.shape))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("truth")
    parser.add_argument("image")
    parser.add_argument("--spacing", type=lambda text: [float(x) for x in text.split(",")])
    parser.add_argument("--crop", type=float, default=0)
    parser.add_argument("--headrest", action="store_true")
    parser.add_argument("--noise", type=float, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--of")
    parser.add_argument("--t1", action="store_true")
    arguments = parser.parse_args()
    truth = nibabel.load(arguments.truth)
    affine = truth.affine
    labels = np.asarray(truth.dataobj).squeeze().astype(int)
    if arguments.of or arguments.t1:
        if arguments.of:
            values = np.asarray(nibabel.load(arguments.of).dataobj, np.float32).squeeze()
        else:
            values = blurred(values_by_label(labels, 0), affine)
        values = noisy(values, labels, arguments.seed).astype(np.float32)
        nibabel.save(nibabel.Nifti1Image(values, affine), arguments.image)
        return
    values = values_by_label(labels, 1)
    if arguments.headrest:
        values = headrest(values, affine)
    values = blurred(values, affine)
    if arguments.spacing:
        values, affine = resample(values, affine, arguments.spacing)
    values, affine = crop(values, affine, arguments.crop)
    values = values + np.random.default_rng(arguments.seed).normal(0, arguments.noise, values.shape)
    nibabel.save(nibabel.Nifti1Image(np.rint(values).astype(np.int16), affine), arguments.image)


if __name__ == "__main__":
    main()
