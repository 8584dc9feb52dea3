"""The label maps of the benchmark: real and synthetic tissues, each at several voxel sizes, which halve."""
import os
import sys

import nibabel
import numpy as np
from scipy import ndimage

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Python"))
from maps import LPS_FROM_RAS, cut_out  # noqa: E402


def resampled(labels, affine, spacing):
    """Returns the labels and the affine of the same box with voxels of side `spacing` (mm). Each has the label of the
    old voxel at its centre."""
    old = np.linalg.norm(affine[:3, :3], axis=0)
    size = np.rint(np.array(labels.shape) * old / spacing).astype(int)
    places = [np.minimum(((np.arange(n) + 0.5) * spacing / o).astype(int), m - 1)
              for n, o, m in zip(size, old, labels.shape)]
    moved = affine.copy()
    moved[:3, :3] *= spacing / old
    moved[:3, 3] += affine[:3, :3] @ (0.5 * (spacing / old - 1))
    return labels[np.ix_(*places)], moved


def atlas(spacing):
    """Returns the whole atlas (189 tissues at 1 mm), resampled, and moved so that its target (0, 0, -10) becomes the
    origin."""
    labels, affine = cut_out(np.s_[0:157, 0:189, 0:136])
    affine[:3, 3] -= [0, 0, -10]
    return resampled(labels, affine, spacing)


def halves(values, axis):
    """Returns the values at the centres of voxels half as long along an axis, by linear interpolation. Values beyond
    the ends count as 0."""
    beyond = [(1, 1) if a == axis else (0, 0) for a in range(3)]
    padded = np.moveaxis(np.pad(values, beyond), axis, 0)
    fine = np.empty((2 * values.shape[axis],) + padded.shape[1:], values.dtype)
    fine[0::2] = 0.75 * padded[1:-1] + 0.25 * padded[:-2]
    fine[1::2] = 0.75 * padded[1:-1] + 0.25 * padded[2:]
    return np.moveaxis(fine, 0, axis)


def smoothed(labels, affine):
    """Returns the same box with voxels half as long. Each has the label whose indicator function, blurred by a Gaussian
    of 0.7 old voxels, is largest there, so that boundaries have steps of one new voxel, as in a finer segmentation."""
    fine, fine_affine = resampled(labels, affine, 0.5 * np.linalg.norm(affine[:3, 0]))
    largest = np.zeros(fine.shape, np.float32)
    reach = 3
    for label, box in enumerate(ndimage.find_objects(labels.astype(np.int32) + 1)):
        if box is None:
            continue
        box = tuple(slice(max(0, s.start - reach), s.stop + reach) for s in box)
        values = ndimage.gaussian_filter((labels[box] == label).astype(np.float32), 0.7, mode="nearest", truncate=3)
        for axis in range(3):
            values = halves(values, axis)
        there = tuple(slice(2 * s.start, 2 * s.start + n) for s, n in zip(box, values.shape))
        wins = values > largest[there]
        largest[there][wins] = values[wins]
        fine[there][wins] = label
    return fine, fine_affine


def smoothed_atlas(spacing):
    return smoothed(*atlas(2 * spacing))


def nested_shapes(spacing):
    """Returns four ellipsoids around the origin, nested like scalp, skull, fluid and brain, with two linked rings
    inside the innermost, in a box of 128 mm."""
    count = round(128 / spacing)
    x, y, z = np.meshgrid(*[(np.arange(count) + 0.5) * spacing - 64] * 3, indexing="ij", sparse=True)
    labels = np.zeros((count,) * 3, np.uint16)
    for label, radius in enumerate((58, 50, 42, 38), 1):
        labels[(x / radius) ** 2 + (y / (0.9 * radius)) ** 2 + (z / (0.8 * radius)) ** 2 < 1] = label
    labels[(np.hypot(x, y) - 18) ** 2 + z ** 2 < 6 ** 2] = 5
    labels[(np.hypot(x - 18, z) - 14) ** 2 + y ** 2 < 4 ** 2] = 6
    affine = np.diag([spacing, spacing, spacing, 1.0])
    affine[:3, 3] = 0.5 * spacing - 64
    return labels, affine


def from_file(file, spacing):
    """Reads a label map in NIfTI format and resamples it."""
    image = nibabel.load(file)
    labels = np.rint(np.asanyarray(image.dataobj)).astype(np.uint16)
    return resampled(labels, LPS_FROM_RAS @ image.affine, spacing)


class Case:
    """One input. `make(spacing)` returns its labels and affine; `focus` are the options that set where the mesh is
    fine."""

    def __init__(self, series, make, spacing, focus=("--targetPoint", "0,0,0")):
        self.series, self.spacing, self.focus = series, spacing, focus
        self.name = f"{series} {spacing:g} mm"
        self.make = lambda: make(spacing)


CASES = [Case("shapes", nested_shapes, spacing) for spacing in (4, 2, 1, 0.5)]
CASES += [Case("jhu189", make, spacing) for make, spacing in ((atlas, 2), (atlas, 1), (smoothed_atlas, 0.5))]
CASES += [Case("repeated jhu189", atlas, 0.5)]


def interface_faces(labels):
    """Returns the number of voxel faces between different labels; the outside counts as background."""
    padded = np.pad(labels, 1)
    return sum(int(np.count_nonzero(np.diff(padded.astype(np.int32), axis=axis))) for axis in range(3))
