"""The example's outputs as NumPy arrays: volumes (.nrrd) and meshes (.vtp, .vtu), all in LPS mm."""
import gzip
from types import SimpleNamespace

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

NRRD_TYPES = {"unsigned char": "u1", "uint8": "u1", "short": "i2", "int16": "i2", "unsigned short": "u2", "uint16": "u2",
              "int": "i4", "int32": "i4", "unsigned int": "u4", "uint32": "u4", "float": "f4", "double": "f8"}
TETRAHEDRON_EDGES = np.array([[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]])
TETRAHEDRON_FACES = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])  # face f is opposite vertex f


def read_nrrd(file):
    """A scalar volume: (values[i, j, k], affine from ijk to LPS mm)."""
    with open(file, "rb") as stream:
        header, _, data = stream.read().partition(b"\n\n")
    fields = dict(line.split(":", 1) for line in header.decode("latin1").splitlines()[1:] if ":" in line and line[0] != "#")
    fields = {key.strip().lower(): value.strip() for key, value in fields.items()}
    if fields["encoding"] in ("gzip", "gz"):
        data = gzip.decompress(data)
    order = ">" if fields.get("endian") == "big" else "<"
    values = np.frombuffer(data, order + NRRD_TYPES[fields["type"]]).reshape(np.array(fields["sizes"].split(), int), order="F")
    vectors = [[float(x) for x in vector.strip("()").split(",")]
               for vector in (fields["space directions"] + " " + fields["space origin"]).split()]
    affine = np.vstack([np.transpose(vectors), [0, 0, 0, 1]])
    if fields["space"] in ("right-anterior-superior", "RAS"):
        affine = np.diag([-1, -1, 1, 1]) @ affine
    return values, affine


def read_dataset(file):
    """The VTK data set itself, for pictures."""
    reader = vtk.vtkXMLUnstructuredGridReader() if file.endswith(".vtu") else vtk.vtkXMLPolyDataReader()
    reader.SetFileName(file)
    reader.Update()
    return reader.GetOutput()


def cell_array(dataset, name):
    return vtk_to_numpy(dataset.GetCellData().GetArray(name))


def read_mesh(file):
    """Tetrahedra: points (n, 3), tetrahedra (m, 4), target (n,) in mm, tissue (m,), submesh (m,)."""
    grid = read_dataset(file)
    return SimpleNamespace(
        points=vtk_to_numpy(grid.GetPoints().GetData()).astype(float),
        tetrahedra=vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4),
        target=vtk_to_numpy(grid.GetPointData().GetArray("TargetEdgeLength")).astype(float),
        tissue=cell_array(grid, "TissueLabel"),
        submesh=cell_array(grid, "SubMesh"))


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


def edge_ratios(mesh):
    """Length over target of every edge; the target is the mean of its two ends."""
    edges = unique_edges(mesh.tetrahedra)
    lengths = np.linalg.norm(mesh.points[edges[:, 0]] - mesh.points[edges[:, 1]], axis=1)
    return lengths / mesh.target[edges].mean(axis=1)


def valences(mesh):
    """Tetrahedra per vertex, of the vertices inside a tissue only: those whose tetrahedra have one label and close up."""
    faces = np.sort(mesh.tetrahedra[:, TETRAHEDRON_FACES].reshape(-1, 3), axis=1)
    tissue = np.repeat(mesh.tissue, 4)
    order = np.lexsort(faces.T)
    faces, tissue = faces[order], tissue[order]
    shared = np.all(faces[1:] == faces[:-1], axis=1) & (tissue[1:] == tissue[:-1])
    inside_a_tissue = np.r_[shared, False] | np.r_[False, shared]
    inner = np.ones(len(mesh.points), bool)
    inner[faces[~inside_a_tissue]] = False
    return np.bincount(mesh.tetrahedra.ravel(), minlength=len(mesh.points))[inner]
