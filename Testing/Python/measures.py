"""Measures of a tetrahedral mesh, to hold the project's own against. Meshes are as meshfiles.read_mesh gives them."""
from itertools import combinations

import numpy as np

TETRAHEDRON_EDGES = np.array([[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]])
TETRAHEDRON_FACES = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])  # face f is opposite vertex f


def signed_volumes(mesh):
    a, b, c, d = np.moveaxis(mesh.points[mesh.tetrahedra], 1, 0)
    return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6


def unique_edges(tetrahedra):
    """Every edge once: (e, 2) point ids, ascending."""
    return np.unique(np.sort(tetrahedra[:, TETRAHEDRON_EDGES].reshape(-1, 2), axis=1), axis=0)


def dihedral_angles(mesh):
    """The six dihedral angles (degrees) of every tetrahedron: (m, 6)."""
    corners = mesh.points[mesh.tetrahedra]
    normals = [np.cross(corners[:, b] - corners[:, a], corners[:, c] - corners[:, a]) for a, b, c in TETRAHEDRON_FACES]
    normals = [n / np.linalg.norm(n, axis=1, keepdims=True) for n in normals]
    cosines = [-np.sum(normals[k] * normals[l], axis=1) for k, l in TETRAHEDRON_EDGES]
    return np.degrees(np.arccos(np.clip(cosines, -1, 1))).T


def edge_ratios(mesh, target_length):
    """Length over target of every edge; target_length maps positions (n, 3) to mm, asked at the edges' middles."""
    ends = mesh.points[unique_edges(mesh.tetrahedra)]
    return np.linalg.norm(ends[:, 0] - ends[:, 1], axis=1) / target_length(ends.mean(axis=1))


def valences(mesh):
    """Tetrahedra per vertex, of vertices inside a tissue only: those whose tetrahedra have one label and close up."""
    faces = np.sort(mesh.tetrahedra[:, TETRAHEDRON_FACES].reshape(-1, 3), axis=1)
    tissue = np.repeat(mesh.tissue, 4)
    order = np.lexsort(faces.T)
    faces, tissue = faces[order], tissue[order]
    shared = np.all(faces[1:] == faces[:-1], axis=1) & (tissue[1:] == tissue[:-1])
    inside_a_tissue = np.r_[shared, False] | np.r_[False, shared]
    inner = np.ones(len(mesh.points), bool)
    inner[faces[~inside_a_tissue]] = False
    return np.bincount(mesh.tetrahedra.ravel(), minlength=len(mesh.points))[inner]


def components_of_mesh(mesh):
    """By label: the pieces of that tissue whose tetrahedra are connected across faces."""
    faces = np.sort(mesh.tetrahedra[:, TETRAHEDRON_FACES].reshape(-1, 3), axis=1)
    order = np.lexsort(faces.T)
    shared = np.flatnonzero(np.all(faces[order[1:]] == faces[order[:-1]], axis=1))
    a, b = order[shared] // 4, order[shared + 1] // 4
    inside = mesh.tissue[a] == mesh.tissue[b]
    a, b = a[inside], b[inside]
    piece = np.arange(len(mesh.tetrahedra))  # ends as the smallest number of a tetrahedron in the piece
    while np.any(piece[a] != piece[b]):
        low = np.minimum(piece[a], piece[b])
        for other in (piece[a], piece[b]):
            np.minimum.at(piece, other, low)
        piece = piece[piece]
    return np.bincount(mesh.tissue[np.unique(piece)], minlength=mesh.tissue.max() + 1)


def euler_numbers_of_mesh(mesh):
    """By label: vertices - edges + triangles - tetrahedra of the closed tetrahedra of that tissue."""
    euler = np.zeros(mesh.tissue.max() + 1, int)
    corners = np.sort(mesh.tetrahedra, axis=1)
    for count in range(1, 5):
        cells = np.concatenate([np.column_stack([mesh.tissue, corners[:, list(chosen)]])
                                for chosen in combinations(range(4), count)])
        euler += (-1) ** (count - 1) * np.bincount(np.unique(cells, axis=0)[:, 0], minlength=len(euler))
    return euler


def euler_numbers_of_map(labels):
    """By label: vertices - edges + faces - voxels of the closed voxels of that tissue; label 0 is not counted."""
    padded = np.pad(labels, 1)
    euler = np.zeros(labels.max() + 1, int)
    for extent in np.ndindex(2, 2, 2):  # along each axis, a cell is as long as a voxel (1) or lies between two (0)
        around = [padded[tuple(slice(1, -1) if long else slice(shift, size - 1 + shift)
                               for long, shift, size in zip(extent, shifts, padded.shape))].ravel()
                  for shifts in np.ndindex(*(2 - long for long in extent))]
        around = np.sort(around, axis=0)
        first = np.ones(around.shape, bool)
        first[1:] = around[1:] != around[:-1]
        euler += (-1) ** sum(extent) * np.bincount(around[first], minlength=len(euler))
    euler[0] = 0
    return euler
