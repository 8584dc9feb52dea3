"""The brain that is registered: a T1 image, its mask, and the smooth body that is meshed, all on one grid of 1 mm.

The T1 is ch2.nii.gz; the mask consists of all tissues of jhu189.nii.gz. Both files are in Debian's package mricron-data
and have the same space.
"""
from types import SimpleNamespace

import nibabel
import numpy as np
from scipy import ndimage

from maps import ATLAS, LPS_FROM_RAS

T1 = "/usr/share/mricron/templates/ch2.nii.gz"
CLOSED = 10  # mm; fissures narrower than twice this are closed in the body that is meshed
MARGIN = 24  # voxels around the atlas: room for the closing and for displaced tissue


def at_voxels(image, affine, shape):
    """Returns the values of the image at the voxels of another grid: those of the nearest voxel, 0 beyond the image."""
    to_image = np.linalg.inv(image.affine) @ np.diag([-1, -1, 1, 1]) @ affine
    return ndimage.affine_transform(np.asanyarray(image.dataobj).astype(np.float32), to_image[:3, :3], to_image[:3, 3],
                                    shape, order=0)


def closed(mask, radius):
    """Returns the mask after dilation and erosion by a ball of this radius (voxels), with its holes filled."""
    dilated = ndimage.distance_transform_edt(~mask) <= radius
    return ndimage.binary_fill_holes(ndimage.distance_transform_edt(dilated) > radius)


def brain(closing=CLOSED):
    """Returns t1 (from 0 to 1), mask (the atlas's tissues), body (the mask with its fissures closed), and the affine to
    LPS mm."""
    atlas = nibabel.load(ATLAS)
    mask = np.pad(ndimage.binary_fill_holes(np.asanyarray(atlas.dataobj) > 0), MARGIN)
    affine = LPS_FROM_RAS @ atlas.affine
    affine[:3, 3] -= affine[:3, :3] @ np.full(3, MARGIN)
    t1 = at_voxels(nibabel.load(T1), affine, mask.shape)
    return SimpleNamespace(t1=t1 / t1.max(), mask=mask, body=closed(mask, closing), affine=affine)


def blocks_of(body, affine, side, share=0.5):
    """Returns the body on larger voxels, `side` of its voxels wide, and their affine. A large voxel belongs to the body
    if at least `share` of it does; only the largest connected piece is kept, and its holes are filled."""
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
