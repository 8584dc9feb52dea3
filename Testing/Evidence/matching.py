"""Selects feature points of an image and matches blocks, after Clatz et al. (IEEE TMI 24(11), 2005): the steps before
the mechanical registration of Chernikov et al."""
import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from scipy import ndimage

FRACTION = 0.05  # share of the mask's voxels that are candidates: those whose blocks vary most
APART = 3  # voxels between two features
BLOCK = 5  # voxels of a block on each side of its centre
REACH = 9  # voxels of twice the side that are searched on each side at half the resolution
REFINED = 3  # voxels that are searched on each side at full resolution


def features(image, mask, fraction=FRACTION, apart=APART, block=BLOCK):
    """Returns the voxels (n, 3) whose blocks lie in the mask and vary most, in descending order of variance. A voxel
    within `apart` voxels of an earlier one is left out."""
    size = 2 * block + 1
    mean = ndimage.uniform_filter(image.astype(float), size)
    variance = ndimage.uniform_filter(image.astype(float) ** 2, size) - mean**2
    inside = ndimage.minimum_filter(mask, size)
    candidates = np.argwhere(inside)
    values = variance[inside]
    ranked = candidates[np.argsort(-values, kind="stable")[:int(fraction * np.count_nonzero(mask))]]
    taken = np.zeros(mask.shape, bool)
    chosen = []
    for i, j, k in ranked:
        if not taken[i, j, k]:
            chosen.append((i, j, k))
            taken[max(0, i - apart):i + apart + 1, max(0, j - apart):j + apart + 1, max(0, k - apart):k + apart + 1] = True
    return np.array(chosen)


def correlations(fixed, moving, centre, start, block, reach):
    """Returns the correlation coefficients of the block of `fixed` at `centre` with the (2 reach + 1)^3 blocks of
    `moving` around centre + start."""
    def cut(image, at, radius):
        return image[tuple(slice(a - radius, a + radius + 1) for a in at)]
    wanted = cut(fixed, centre, block).ravel()
    wanted = wanted - wanted.mean()
    windows = sliding_window_view(cut(moving, centre + start, block + reach), (2 * block + 1,) * 3)
    shape = windows.shape[:3]
    windows = windows.reshape(-1, wanted.size)
    spread = np.einsum("ij,ij->i", windows, windows) - windows.sum(axis=1) ** 2 / wanted.size
    return (windows @ wanted / np.sqrt(np.maximum(spread * (wanted @ wanted), 1e-20))).reshape(shape)


def below_a_voxel(values, best):
    """Returns the offset (3) in voxels from the best value to the maximum of the parabola through it and its neighbours
    along each axis; 0 along an axis at whose border the best value lies."""
    offset = np.zeros(3)
    for axis in range(3):
        if 0 < best[axis] < values.shape[axis] - 1:
            low, middle, high = (values[tuple(best + step * np.eye(3, dtype=int)[axis])] for step in (-1, 0, 1))
            curvature = low - 2 * middle + high
            if curvature < -1e-9:
                offset[axis] = 0.5 * (low - high) / curvature
    return offset


def best_offset(values):
    best = np.array(np.unravel_index(np.argmax(values), values.shape))
    return best - np.array(values.shape) // 2, below_a_voxel(values, best)


def halved(image):
    return ndimage.gaussian_filter(image, 0.8)[::2, ::2, ::2]


def match(fixed, moving, points, block=BLOCK, reach=REACH, refined=REFINED):
    """Returns the displacements (n, 3) in voxels from each point of `fixed` to the block of `moving` that correlates
    best. The search runs at half the resolution first, then at full resolution near what it found."""
    margin = 2 * (block + reach + refined + 2)
    fixed, moving = (np.pad(image.astype(np.float32), margin + margin % 2) for image in (fixed, moving))
    points = np.asarray(points) + margin + margin % 2
    coarse_fixed, coarse_moving = halved(fixed), halved(moving)
    result = np.empty((len(points), 3))
    for n, point in enumerate(points):
        values = correlations(coarse_fixed, coarse_moving, (point + 1) // 2, np.zeros(3, int), max(2, block // 2), reach)
        start = 2 * best_offset(values)[0]
        step, rest = best_offset(correlations(fixed, moving, point, start, block, refined))
        result[n] = start + step + rest
    return result
