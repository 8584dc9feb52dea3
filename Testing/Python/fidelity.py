"""How far the tissue boundaries of a mesh and those of its label map are apart.

Boundaries are points: the centres of voxel faces between two labels, and points spread over the mesh's triangles
between two labels. Hausdorff distances between them are as exact as the points are dense: half a voxel's diagonal at worst.
"""
from types import SimpleNamespace

import numpy as np
from scipy.spatial import cKDTree

from measures import TETRAHEDRON_FACES


def boundary_of_map(labels, affine):
    """Centres (n, 3), mm, of the voxel faces between two labels, and these labels (n, 2); 0 lies around the map."""
    padded = np.pad(labels, 1).astype(np.int32)
    points, sides = [], []
    for axis in range(3):
        low = tuple(slice(None, -1) if a == axis else slice(None) for a in range(3))
        high = tuple(slice(1, None) if a == axis else slice(None) for a in range(3))
        at = np.argwhere(padded[low] != padded[high])
        sides.append(np.column_stack([padded[low][tuple(at.T)], padded[high][tuple(at.T)]]))
        points.append(at - 1 + 0.5 * np.eye(3)[axis])
    return SimpleNamespace(points=np.concatenate(points) @ affine[:3, :3].T + affine[:3, 3],
                           sides=np.concatenate(sides))


def boundary_triangles(mesh):
    """Triangles (n, 3) between two labels or at the mesh's outside, and these labels (n, 2)."""
    faces = np.sort(mesh.tetrahedra[:, TETRAHEDRON_FACES].reshape(-1, 3), axis=1)
    tissue = np.repeat(mesh.tissue, 4)
    order = np.lexsort(faces.T)
    faces, tissue = faces[order], tissue[order]
    same = np.r_[np.all(faces[1:] == faces[:-1], axis=1), False]
    first = ~np.r_[False, same[:-1]]
    beyond = np.where(same, np.roll(tissue, -1), 0)
    between = first & (tissue != beyond)
    return faces[between], np.column_stack([tissue, beyond])[between]


def spread_points(corners, spacing):
    """Points over triangles (n, 3, 3), no farther apart than about `spacing`, and the triangle of each."""
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1)
    divisions = np.maximum(1, np.ceil(longest / spacing)).astype(int)
    points, triangles = [], []
    for n in np.unique(divisions):
        chosen = np.flatnonzero(divisions == n)
        i, j = (index.ravel() for index in np.indices((n + 1, n + 1)))
        inside = i + j <= n
        weights = np.column_stack([i, j, n - i - j])[inside] / n
        points.append(np.einsum("wc,tcx->twx", weights, corners[chosen]).reshape(-1, 3))
        triangles.append(np.repeat(chosen, len(weights)))
    return np.concatenate(points), np.concatenate(triangles)


def boundary_of_mesh(mesh, spacing):
    triangles, sides = boundary_triangles(mesh)
    points, owner = spread_points(mesh.points[triangles], spacing)
    return SimpleNamespace(points=points, sides=sides[owner])


def hausdorff(a, b, share=1):
    """Two-sided Hausdorff distance of two sets of points; with `share` below 1, of the nearest such share of both."""
    return max(np.quantile(cKDTree(there).query(here)[0], share) for here, there in ((a, b), (b, a)))


def around(boundary, label):
    """The points of a boundary that lie on the label's."""
    return boundary.points[np.any(boundary.sides == label, axis=1)]


def hausdorff_by_tissue(map_boundary, mesh_boundary, labels):
    """{label: distance}; infinite for a tissue that the mesh lacks."""
    result = {}
    for label in labels:
        found = around(mesh_boundary, label)
        result[int(label)] = hausdorff(around(map_boundary, label), found) if len(found) else np.inf
    return result
