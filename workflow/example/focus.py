"""Finds where targets and paths lie in the map that was meshed, and describes those that do not lie in tissue."""
import numpy as np


def points_of_interest(scale):
    """Returns (description, position in LPS mm) for each target and for the end of each path in the scale's report."""
    return ([("target", np.array(target, float)) for target in scale["targets"]]
            + [("end of the path", np.array(path["points"][-1], float)) for path in scale["paths"]])


def label_at(labels, affine, position):
    """Returns the label of the voxel at a position (LPS, mm), or None outside the map. `affine` is that of `labels`."""
    index = np.linalg.solve(affine, [*position, 1])[:3]
    if np.any(index < -0.5) or np.any(index > np.array(labels.shape) - 0.5):
        return None
    return int(labels[tuple(np.clip(np.rint(index).astype(int), 0, np.array(labels.shape) - 1))])


def nearest(points, position):
    """Returns the point of `points` (n, 3) that is nearest to a position, and its distance (mm)."""
    distances = np.linalg.norm(points - position, axis=1)
    return points[distances.argmin()], float(distances.min())


def sentence(what, position, labels, affine, points):
    """Returns a sentence about a point of interest that does not lie in tissue, or None if it does. `points` are the
    points of the surface."""
    label = label_at(labels, affine, position)
    if label:
        return None
    place = "(" + ", ".join(f"{x:g}" for x in np.round(position, 2)) + ") mm LPS"
    text = (f"{what} {place} lies {'outside the label map' if label is None else 'beside the tissue'}, "
            f"{nearest(points, position)[1]:.1f} mm from the nearest tissue")
    if label_at(labels, affine, position * [-1, -1, 1]):
        text += "; with x and y of opposite sign (LPS for RAS) it would lie in tissue"
    return text


def sentences(scale, labels, affine, points):
    """Returns a sentence for each point of interest that does not lie in tissue."""
    found = (sentence(what, at, labels, affine, points) for what, at in points_of_interest(scale))
    return [text for text in found if text]
