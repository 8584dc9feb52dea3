"""Meshes of a label map by Cleaver 2 (github SCIInstitute/Cleaver), for those who have its cleaver-cli: it is not a Debian
package. Its materials are the labels' signed distances, which it blurs by a voxel itself, as it does by default."""
from types import SimpleNamespace

import numpy as np
from scipy import ndimage

from measures import signed_volumes

NAME = "Cleaver 2"
MOST = 900  # processor seconds, after which it has not finished


def write_values(file, values, sides):
    """A volume as Cleaver reads it, which knows the size of voxels but neither origin nor directions."""
    directions = " ".join(f"({','.join(f'{x:.9g}' for x in row)})" for row in np.diag(sides))
    header = (f"NRRD0004\ntype: float\ndimension: 3\nspace: left-posterior-superior\nsizes: {' '.join(map(str, values.shape))}\n"
              f"space directions: {directions}\nspace origin: (0,0,0)\nendian: little\nencoding: raw\n\n")
    with open(file, "wb") as stream:
        stream.write(header.encode() + values.astype("<f4").tobytes(order="F"))


def signed_distance(mask):
    """Voxels from the mask's faces, positive inside."""
    return np.where(mask, ndimage.distance_transform_edt(mask) - 0.5, 0.5 - ndimage.distance_transform_edt(~mask))


def read(stem, values, affine, sides):
    """The tetrahedra of all labels but 0; Cleaver counts materials from 1, and the first voxel's middle is half a side
    from its origin."""
    nodes = np.loadtxt(stem + ".node", skiprows=2, ndmin=2)[:, 1:4]
    elements = np.loadtxt(stem + ".ele", skiprows=2, ndmin=2).astype(int)
    tissue = np.asarray(values)[elements[:, 5] - 1]
    used, kept = np.unique(elements[tissue > 0, 1:5] - 1, return_inverse=True)
    points = (nodes[used] / sides - 0.5) @ affine[:3, :3].T + affine[:3, 3]
    mesh = SimpleNamespace(points=points, tetrahedra=kept.reshape(-1, 4), tissue=tissue[tissue > 0])
    if np.median(signed_volumes(mesh)) < 0:
        mesh.tetrahedra = mesh.tetrahedra[:, [1, 0, 2, 3]]
    return mesh


def mesh_of(run, labels, affine, *options):
    """The mesh by `run.cleaver`; raises CalledProcessError where that fails or takes too long."""
    sides, values = np.linalg.norm(affine[:3, :3], axis=0), np.unique(labels)
    files = [f"cleaver-{label}.nrrd" for label in values]
    for file, label in zip(files, values):
        write_values(run.path(file), signed_distance(labels == label), sides)
    run(run.cleaver, "-I", "-e", "-j", "-n", "cleaver", *options, "-i", *files, most=MOST)
    return read(run.path("cleaver"), values, affine, sides)


def uniform_mesh_of(run, labels, affine, length):
    """The same with cells of at most that length (mm)."""
    write_values(run.path("cleaver-scale.nrrd"), np.full(labels.shape, length), np.linalg.norm(affine[:3, :3], axis=0))
    return mesh_of(run, labels, affine, "-z", "cleaver-scale.nrrd")
