"""A body-centred cubic lattice compressed to a surface, like the point-based meshers that Chernikov et al. compare (Liu
et al., mesh deformation-based multi-tissue mesh generation). The tetrahedra of the lattice inside the body form an
elastic body whose boundary is pulled to the surface; a weight (the paper's lambda) balances distance against strain.

This is a simple form: the targets are the nearest points of the surface, chosen anew in every step, and a step is
halved as long as it would make a tetrahedron too small or invert it.
"""
from types import SimpleNamespace

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import spsolve
from scipy.spatial import cKDTree

from elasticity import stiffness, unknowns
from fidelity import boundary_triangles
from measures import signed_volumes
from meshfiles import interpolated

STEPS = 20
SMALLEST = 0.05  # smallest volume of a tetrahedron, as a share of its volume in the lattice


def lattice_tetrahedra(low, high, side):
    """Returns the points and the positively oriented tetrahedra of the lattice over a box: four around each line
    between the centres of two adjacent cubes of width `side`."""
    size = np.ceil((high - low) / side).astype(int) + 1
    cubes = np.argwhere(np.ones(size, bool))
    corner_size = size + 1
    corners = low + side * np.argwhere(np.ones(corner_size, bool))
    centres = low + side * (cubes + 0.5)
    tetrahedra = []
    for axis in range(3):
        first = cubes[cubes[:, axis] + 1 < size[axis]]
        step, u, v = (np.eye(3, dtype=int)[(axis + shift) % 3] for shift in range(3))
        ends = [len(corners) + np.ravel_multi_index((first + k * step).T, size) for k in (0, 1)]
        ring = [np.ravel_multi_index((first + step + offset).T, corner_size) for offset in (0 * u, u, u + v, v)]
        for a, b in zip(ring, ring[1:] + ring[:1]):
            tetrahedra.append(np.stack([ends[0], a, b, ends[1]], axis=1))
    return np.concatenate([corners, centres]), np.concatenate(tetrahedra)


def inside(points, tetrahedra, body, affine):
    """Returns the points, renumbered, and the tetrahedra whose centroid and at least half of whose corners are in the
    body."""
    values = interpolated(body.astype(float), affine, points)
    middle = interpolated(body.astype(float), affine, points[tetrahedra].mean(axis=1))
    kept = tetrahedra[(middle >= 0.5) & (values[tetrahedra].mean(axis=1) >= 0.5)]
    used, tetrahedra = np.unique(kept, return_inverse=True)
    return points[used], tetrahedra.reshape(-1, 4)


def compressed(body, affine, surface, side, weight, steps=STEPS):
    """Returns the mesh: points (mm), tetrahedra, tissue. `surface` are dense points of the body's surface (mm), `side`
    is the width of the lattice's cubes (mm), and `weight` that of the distance against the strain."""
    low = surface.min(axis=0) - side
    points, tetrahedra = inside(*lattice_tetrahedra(low, surface.max(axis=0) + side, side), body, affine)
    smallest = SMALLEST * side**3 / 12
    outer = np.unique(boundary_triangles(SimpleNamespace(tetrahedra=tetrahedra,
                                                         tissue=np.ones(len(tetrahedra), int)))[0])
    pick = sparse.csr_matrix((np.ones(3 * len(outer)), (np.arange(3 * len(outer)), unknowns(outer).ravel())),
                             (3 * len(outer), 3 * len(points)))
    tree = cKDTree(surface)
    rest = stiffness(points, tetrahedra, 1.0, 0.3) / side  # the division makes its entries of the order of 1
    start, reached = points, points

    def mesh_at(positions):
        return SimpleNamespace(points=positions, tetrahedra=tetrahedra, tissue=np.ones(len(tetrahedra), int))

    for _ in range(steps):
        target = surface[tree.query(reached[outer])[1]] - start[outer]
        moved = spsolve((rest + weight * (pick.T @ pick)).tocsc(), weight * (pick.T @ target.ravel())).reshape(-1, 3)
        step = start + moved - reached
        while np.abs(step).max() > 1e-3 and signed_volumes(mesh_at(reached + step)).min() < smallest:
            step = step / 2
        if np.abs(step).max() <= 1e-3:
            break
        reached = reached + step
    return mesh_at(reached)
