"""Reads the example's outputs as NumPy arrays: volumes (.nrrd) and meshes (.vtp, .vtu), all in LPS and mm."""
import gzip
from types import SimpleNamespace

import numpy as np
import vtk
from vtk.util.numpy_support import vtk_to_numpy

NRRD_TYPES = {"unsigned char": "u1", "uint8": "u1", "short": "i2", "int16": "i2", "unsigned short": "u2",
              "uint16": "u2", "int": "i4", "int32": "i4", "unsigned int": "u4", "uint32": "u4",
              "float": "f4", "double": "f8"}


def read_nrrd(file):
    """Reads a scalar volume and returns its values [i, j, k] and the 4 x 4 matrix from indices to LPS mm."""
    with open(file, "rb") as stream:
        header, _, data = stream.read().partition(b"\n\n")
    lines = [line for line in header.decode("latin1").splitlines()[1:] if ":" in line and line[0] != "#"]
    fields = {key.strip().lower(): value.strip() for key, value in (line.split(":", 1) for line in lines)}
    if fields["encoding"] in ("gzip", "gz"):
        data = gzip.decompress(data)
    order = ">" if fields.get("endian") == "big" else "<"
    size = [int(n) for n in fields["sizes"].split()]
    values = np.frombuffer(data, order + NRRD_TYPES[fields["type"]]).reshape(size, order="F")
    vectors = [[float(x) for x in vector.strip("()").split(",")]
               for vector in (fields["space directions"] + " " + fields["space origin"]).split()]
    affine = np.vstack([np.transpose(vectors), [0, 0, 0, 1]])
    if fields["space"] in ("right-anterior-superior", "RAS"):
        affine = np.diag([-1, -1, 1, 1]) @ affine
    return values, affine


def interpolated(volume, affine, positions):
    """Returns the values of a volume at positions (..., 3) in LPS mm, by trilinear interpolation. Positions outside the
    volume get values of its border."""
    last = np.array(volume.shape) - 1
    indices = (positions - affine[:3, 3]) @ np.linalg.inv(affine[:3, :3]).T
    indices = np.clip(indices, 0, last)
    low = np.minimum(indices.astype(int), np.maximum(last - 1, 0))
    share = indices - low
    values = np.zeros(indices.shape[:-1])
    for corner in np.ndindex(2, 2, 2):
        weight = np.prod(np.where(corner, share, 1 - share), axis=-1)
        at = np.minimum(low + corner, last)
        values += weight * volume[at[..., 0], at[..., 1], at[..., 2]]
    return values


def read_dataset(file):
    """Reads a .vtu or .vtp file and returns the VTK data set."""
    reader = vtk.vtkXMLUnstructuredGridReader() if file.endswith(".vtu") else vtk.vtkXMLPolyDataReader()
    reader.SetFileName(file)
    reader.Update()
    return reader.GetOutput()


def cell_array(dataset, name):
    return vtk_to_numpy(dataset.GetCellData().GetArray(name))


def read_mesh(file):
    """Reads a mesh of tetrahedra and returns its points (n, 3), tetrahedra (m, 4), tissue (m,) and submesh (m,), which
    is None for meshes of other programs."""
    grid = read_dataset(file)
    return SimpleNamespace(
        points=vtk_to_numpy(grid.GetPoints().GetData()).astype(float),
        tetrahedra=vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 4),
        tissue=cell_array(grid, "TissueLabel"),
        submesh=cell_array(grid, "SubMesh") if grid.GetCellData().HasArray("SubMesh") else None)
