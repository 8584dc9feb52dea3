"""Meshes label maps by Cleaver 2 (SCIInstitute/Cleaver on GitHub), if its program cleaver-cli is at hand: there is no
Debian package. Its materials are the signed distances of the labels, which Cleaver by default blurs by a voxel."""
from types import SimpleNamespace

import numpy as np
from scipy import ndimage

from measures import signed_volumes

NAME = "Cleaver 2"
MOST = 900  # processor seconds, after which Cleaver is ended


def write_values(file, values, sides):
    """Writes a volume for Cleaver, which reads the size of the voxels but neither their origin nor their directions."""
    directions = " ".join(f"({','.join(f'{x:.9g}' for x in row)})" for row in np.diag(sides))
    header = (f"NRRD0004\ntype: float\ndimension: 3\nspace: left-posterior-superior\nsizes: {' '.join(map(str, values.shape))}\n"
              f"space directions: {directions}\nspace origin: (0,0,0)\nendian: little\nencoding: raw\n\n")
    with open(file, "wb") as stream:
        stream.write(header.encode() + values.astype("<f4").tobytes(order="F"))


def signed_distance(mask):
    """Returns the distance of each voxel's centre from the faces of the mask (voxels), positive inside."""
    return np.where(mask, ndimage.distance_transform_edt(mask) - 0.5, 0.5 - ndimage.distance_transform_edt(~mask))


def read(stem, values, affine, sides):
    """Reads Cleaver's mesh and returns the tetrahedra of all labels but 0, in the map's frame. Cleaver counts materials
    from 1, and its origin is half a voxel before the centre of the first voxel along each axis."""
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
    """Returns the mesh of a label map by `run.cleaver`. Raises CalledProcessError if that fails or takes too long."""
    sides, values = np.linalg.norm(affine[:3, :3], axis=0), np.unique(labels)
    files = [f"cleaver-{label}.nrrd" for label in values]
    for file, label in zip(files, values):
        write_values(run.path(file), signed_distance(labels == label), sides)
    run(run.cleaver, "-I", "-e", "-j", "-n", "cleaver", *options, "-i", *files, most=MOST)
    return read(run.path("cleaver"), values, affine, sides)


def uniform_mesh_of(run, labels, affine, length):
    """Returns the same as `mesh_of` with cells no longer than `length` (mm)."""
    write_values(run.path("cleaver-scale.nrrd"), np.full(labels.shape, length), np.linalg.norm(affine[:3, :3], axis=0))
    return mesh_of(run, labels, affine, "-z", "cleaver-scale.nrrd")
