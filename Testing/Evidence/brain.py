"""The brain that is registered: a T1 image, its mask, and the smooth body that is meshed; all on one grid of 1 mm.

T1: ch2.nii.gz, mask: all tissues of jhu189.nii.gz, both of Debian's mricron-data, in one space.
"""
from types import SimpleNamespace

import nibabel
import numpy as np
from scipy import ndimage

from maps import ATLAS, LPS_FROM_RAS

T1 = "/usr/share/mricron/templates/ch2.nii.gz"
CLOSED = 10  # mm; fissures narrower than twice this are closed in the body that is meshed
MARGIN = 24  # voxels around the atlas, for the closing and for what is displaced


def at_voxels(image, affine, shape):
    """The image's values at the voxels of another grid (nearest voxel; 0 beyond the image)."""
    to_image = np.linalg.inv(image.affine) @ np.diag([-1, -1, 1, 1]) @ affine
    return ndimage.affine_transform(np.asanyarray(image.dataobj).astype(np.float32), to_image[:3, :3], to_image[:3, 3],
                                    shape, order=0)


def closed(mask, radius):
    """The mask dilated and eroded by a ball, without holes."""
    dilated = ndimage.distance_transform_edt(~mask) <= radius
    return ndimage.binary_fill_holes(ndimage.distance_transform_edt(dilated) > radius)


def brain(closing=CLOSED):
    """t1 (0..1), mask (voxels of the atlas' tissues), body (the mask without its fissures), affine to LPS mm."""
    atlas = nibabel.load(ATLAS)
    mask = np.pad(ndimage.binary_fill_holes(np.asanyarray(atlas.dataobj) > 0), MARGIN)
    affine = LPS_FROM_RAS @ atlas.affine
    affine[:3, 3] -= affine[:3, :3] @ np.full(3, MARGIN)
    t1 = at_voxels(nibabel.load(T1), affine, mask.shape)
    return SimpleNamespace(t1=t1 / t1.max(), mask=mask, body=closed(mask, closing), affine=affine)


def blocks_of(body, affine, side, share=0.5):
    """The body on voxels of `side` (a whole number of its voxels): those filled by the share or more, in one piece."""
    padded = np.pad(body.astype(np.float32), [(side, side + -n % side) for n in body.shape])
    filled = padded.reshape(np.ravel([(n // side, side) for n in padded.shape])).mean(axis=(1, 3, 5)) >= share
    pieces, _ = ndimage.label(filled)
    if pieces.max():
        filled = pieces == 1 + np.argmax(np.bincount(pieces.ravel())[1:])
    coarse = affine @ np.diag([side, side, side, 1.0])
    coarse[:3, 3] = affine[:3, 3] + affine[:3, :3] @ np.full(3, (side - 1) / 2 - side)
    return ndimage.binary_fill_holes(filled), coarse


def positions_of(voxels, affine):
    return voxels @ affine[:3, :3].T + affine[:3, 3]
