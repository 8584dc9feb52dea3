"""The brain shift that registrations have to find: a nonlinear finite-element solution by CalculiX.

The brain lies on the side opposite a craniotomy. Fluid has drained down to a level: tissue above the level has weight,
and tissue below it floats. A ball of tissue under the craniotomy has been removed. The tissue is neo-Hookean (3 kPa,
Poisson's ratio 0.45), displacements are large, and the mesh is a lattice of hexahedra that is unrelated to the meshes
that are compared. The weight is increased until the largest displacement has the wanted value.
"""
import os
import re
import subprocess
from types import SimpleNamespace

import numpy as np
from scipy import ndimage
from scipy.spatial import cKDTree

from brain import blocks_of, positions_of

SIDE = 6  # mm, of hexahedra
YOUNGS_MODULUS, POISSONS_RATIO = 0.003, 0.45  # MPa
WEIGHT = 9.81e-6  # N/mm^3
UPWARDS = np.array([0.6, -0.5, 0.62]) / np.linalg.norm([0.6, -0.5, 0.62])  # LPS: to the left, the front and above
HELD, FLUID = 0.2, 0.35  # shares of the brain's height up to which the skull holds it, and up to which there is fluid
CAVITY_RADIUS, CAVITY_DEPTH = 14, 16  # mm; the depth is that of the cavity's centre
LARGEST_WEIGHT, INCREMENT = 0.2, 0.05  # shares of WEIGHT
CORNERS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])

DECK = """*NODE, NSET=ALL
{nodes}
*ELEMENT, TYPE=C3D8, ELSET=BRAIN
{elements}
*ELSET, ELSET=HEAVY
{heavy}
*NSET, NSET=HELD
{held}
*MATERIAL, NAME=TISSUE
*HYPERELASTIC, NEO HOOKE
{c10:.9g}, {d1:.9g}
*DENSITY
1.
*SOLID SECTION, ELSET=BRAIN, MATERIAL=TISSUE
*BOUNDARY
HELD, 1, 3
*STEP, NLGEOM, INC=1000
*STATIC, DIRECT
{increment}, 1.
*DLOAD
HEAVY, GRAV, {weight:.9g}, {down}
*NODE PRINT, NSET=ALL
U
*END STEP
"""


def cavity_of(body, affine, radius=CAVITY_RADIUS, depth=CAVITY_DEPTH):
    """Returns a mask of the ball that is removed, which lies on the line from the body's centroid upwards."""
    voxels = np.argwhere(body)
    positions = positions_of(voxels, affine)
    from_middle = positions - positions.mean(axis=0)
    height = from_middle @ UPWARDS
    beside = np.linalg.norm(from_middle - np.outer(height, UPWARDS), axis=1)
    top = height[beside < 2].max()
    centre = positions.mean(axis=0) + (top - depth) * UPWARDS
    inside = np.zeros(body.shape, bool)
    inside[tuple(voxels[np.linalg.norm(positions - centre, axis=1) <= radius].T)] = True
    return inside


def hexahedra(body, cavity, affine, side=SIDE):
    """Returns nodes (mm), hexahedra, and their lattice: all blocks of `side` voxels that contain a voxel of the body,
    except those that are at least half in the cavity. Only the largest connected piece is kept."""
    filled, lattice = blocks_of(body, affine, side, share=1e-6)
    taken, _ = blocks_of(cavity, affine, side)
    filled = filled & ~taken
    pieces, _ = ndimage.label(filled)
    filled = pieces == 1 + np.argmax(np.bincount(pieces.ravel())[1:])
    corner_lattice = lattice.copy()
    corner_lattice[:3, 3] -= lattice[:3, :3] @ np.full(3, 0.5)
    size = np.array(filled.shape) + 1
    ids = np.ravel_multi_index(np.moveaxis(np.argwhere(filled)[:, None] + CORNERS, -1, 0), size)
    if np.linalg.det(affine[:3, :3]) < 0:
        ids = ids[:, [4, 5, 6, 7, 0, 1, 2, 3]]
    used, elements = np.unique(ids, return_inverse=True)
    at = np.stack(np.unravel_index(used, size), axis=1)
    return SimpleNamespace(nodes=positions_of(at, corner_lattice), elements=elements.reshape(-1, 8), at=at,
                           shape=tuple(size), affine=corner_lattice)


def lines(ids):
    return "\n".join(f"{i + 1}," for i in ids)


def write_deck(file, mesh, largest_weight, increment):
    height = mesh.nodes @ UPWARDS
    low, high = height.min(), height.max()
    held = np.flatnonzero(height < low + HELD * (high - low))
    heavy = np.flatnonzero(height[mesh.elements].mean(axis=1) > low + FLUID * (high - low))
    nodes = "\n".join(f"{i + 1}, {x:.9g}, {y:.9g}, {z:.9g}" for i, (x, y, z) in enumerate(mesh.nodes))
    elements = "\n".join(f"{i + 1}, " + ", ".join(map(str, element + 1)) for i, element in enumerate(mesh.elements))
    with open(file, "w", encoding="ascii") as deck:
        deck.write(DECK.format(
            nodes=nodes, elements=elements, heavy=lines(heavy), held=lines(held),
            c10=YOUNGS_MODULUS / (4 * (1 + POISSONS_RATIO)), d1=6 * (1 - 2 * POISSONS_RATIO) / YOUNGS_MODULUS,
            increment=increment / largest_weight, weight=WEIGHT * largest_weight,
            down=", ".join(f"{x:.9g}" for x in -UPWARDS)))


def states_of(file, count):
    """Returns the displacements (n, 3) after each complete increment in CalculiX's .dat file; n is `count`."""
    with open(file, encoding="ascii") as stream:
        blocks = re.split(r"^ displacements.*$", stream.read(), flags=re.M)[1:]
    states = [np.array(block.split(), float).reshape(-1, 4)[:, 1:] for block in blocks]
    return [state for state in states if len(state) == count]


def at_shift(states, shift):
    """Returns the state whose largest displacement is `shift`, interpolated between the two increments around it."""
    states = [np.zeros_like(states[0]), *states]
    largest = np.array([np.linalg.norm(state, axis=1).max() for state in states])
    after = int(np.argmax(largest >= shift))
    if largest[after] < shift:
        raise ValueError(f"CalculiX reached {largest.max():.1f} mm, asked were {shift} mm")
    part = (shift - largest[after - 1]) / (largest[after] - largest[after - 1])
    state = (1 - part) * states[after - 1] + part * states[after]
    return state * shift / np.linalg.norm(state, axis=1).max()


def brain_shifts(folder, mesh, shifts, largest_weight=LARGEST_WEIGHT, increment=INCREMENT):
    """Maps each shift (mm) to the displacements of the nodes of the hexahedra. CalculiX may fail before the full weight
    is applied, as long as all shifts have been reached."""
    deck = os.path.join(folder, "truth")
    write_deck(deck + ".inp", mesh, largest_weight, increment)
    with open(deck + ".log", "w", encoding="utf-8") as log:
        subprocess.run(["ccx", "truth"], cwd=folder, stdout=log, stderr=log, check=False)
    states = states_of(deck + ".dat", len(mesh.nodes))
    return {shift: at_shift(states, shift) for shift in shifts}


def on_lattice(mesh, displacement):
    """Returns the displacements at all corners of the lattice; corners outside the mesh move like the nearest node."""
    everywhere = np.argwhere(np.ones(mesh.shape, bool))
    nearest = cKDTree(mesh.at).query(everywhere)[1]
    return displacement[nearest].reshape(*mesh.shape, 3)


def at_all_voxels(mesh, displacement, shape, affine):
    """Returns the displacements (..., 3) in mm at all voxels, trilinear between the corners of the lattice."""
    to_lattice = np.linalg.inv(mesh.affine) @ affine
    values = on_lattice(mesh, displacement)
    return np.stack([ndimage.affine_transform(values[..., axis].astype(np.float32), to_lattice[:3, :3],
                                              to_lattice[:3, 3], shape, order=1, mode="nearest")
                     for axis in range(3)], axis=-1)


def deformed(image, mask, cavity, displacement, affine, noise, seed=0):
    """Returns the image during the operation: the tissue at its new place, and dark fluid and air around it and in the
    cavity. `noise` is the standard deviation of the added noise."""
    inverse = np.linalg.inv(affine[:3, :3])
    moved = np.moveaxis(displacement @ inverse.T, -1, 0)  # voxels
    tissue = np.where(mask & ~cavity, image, 0).astype(np.float32)
    targets = np.argwhere(ndimage.binary_dilation(mask, iterations=int(np.ceil(np.abs(moved[:, mask]).max())) + 1)).T
    sources = targets.astype(float)
    for _ in range(20):  # x = y - u(x)
        sources = targets - np.stack([ndimage.map_coordinates(part, sources, order=1, mode="nearest") for part in moved])
    result = np.zeros(image.shape, np.float32)
    result[tuple(targets)] = ndimage.map_coordinates(tissue, sources, order=1)
    return result + np.random.default_rng(seed).normal(0, noise, image.shape).astype(np.float32)
