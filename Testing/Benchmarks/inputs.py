"""The label maps that are measured: real and synthetic tissues, each at voxel sizes that halve."""
import os
import sys

import nibabel
import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Python"))
from maps import LPS_FROM_RAS, cut_out  # noqa: E402


def resampled(labels, affine, spacing):
    """The same box on voxels of side `spacing` (mm), each with the label at its centre (nearest neighbour)."""
    old = np.linalg.norm(affine[:3, :3], axis=0)
    size = np.rint(np.array(labels.shape) * old / spacing).astype(int)
    places = [np.minimum(((np.arange(n) + 0.5) * spacing / o).astype(int), m - 1)
              for n, o, m in zip(size, old, labels.shape)]
    moved = affine.copy()
    moved[:3, :3] *= spacing / old
    moved[:3, 3] += affine[:3, :3] @ (0.5 * (spacing / old - 1))
    return labels[np.ix_(*places)], moved


def atlas(spacing):
    """The whole atlas (189 tissues at 1 mm), its target at the origin of the file's space, moved there."""
    labels, affine = cut_out(np.s_[0:157, 0:189, 0:136])
    affine[:3, 3] -= [0, 0, -10]
    return resampled(labels, affine, spacing)


def nested_shapes(spacing):
    """Four ellipsoids around the origin, one in the other as scalp, skull, fluid and brain are, with two tubes through
    the innermost, in a box of 128 mm."""
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
    """A label map in NIfTI, resampled."""
    image = nibabel.load(file)
    labels = np.rint(np.asanyarray(image.dataobj)).astype(np.uint16)
    return resampled(labels, LPS_FROM_RAS @ image.affine, spacing)


class Case:
    """`focus` are the options that say where the mesh is fine."""

    def __init__(self, series, make, spacing, focus=("--targetPoint", "0,0,0")):
        self.series, self.spacing, self.focus = series, spacing, focus
        self.name = f"{series} {spacing:g} mm"
        self.make = lambda: make(spacing)


CASES = [Case("shapes", nested_shapes, spacing) for spacing in (4, 2, 1, 0.5)]
CASES += [Case("jhu189", atlas, spacing) for spacing in (2, 1, 0.5)]


def interface_faces(labels):
    """Number of voxel faces between different labels, the outside counting as background."""
    padded = np.pad(labels, 1)
    return sum(int(np.count_nonzero(np.diff(padded.astype(np.int32), axis=axis))) for axis in range(3))
