# SPDX-License-Identifier: Apache-2.0
"""The mesh as numpy arrays, read from the program's file."""
import contextlib
import os
import tempfile
from dataclasses import dataclass, field
from typing import Any, Dict, Iterator, Tuple

import numpy as np
import numpy.typing as npt

from ._programs import MeshingError, run


@contextlib.contextmanager
def _one_name(file: str) -> Iterator[None]:
    """Makes the program take a name with commas as one name. It takes it as a list of names unless a file of that name
    exists; for as long as the body of the `with` statement runs, an empty file stands in."""
    if "," not in file or os.path.exists(file):
        yield
        return
    try:
        with open(file, "xb"):
            pass
    except OSError as error:
        raise MeshingError(f"{file}: {error.strerror}, a writable folder expected", 1) from None
    try:
        yield
    finally:
        if os.path.exists(file) and os.path.getsize(file) == 0:  # the program failed, or wrote files of other names
            os.remove(file)


@dataclass(frozen=True)
class Mesh:
    """A mesh of n points and m tetrahedra in all tissues; its arrays have the values of the file mesh.vtu.

    points              (n, 3) positions (mm, LPS)
    tetrahedra          (m, 4) indices of the corners in `points`, in positive orientation
    tissue_labels       (m,) label in the label map
    sub_mesh            (m,) 0 for the parent, the coarse part; 1, 2, ... for the children, the fine parts
    constitutive        (m,) 0 for linear, 1 for nonlinear, 2 for null displacement: tissue that is held still
    target_edge_length  (n,) target edge length at the points (mm)
    tissue_names        names by label
    tissue_colors       colours by label: red, green and blue from 0 to 1
    vtu                 content of the file mesh.vtu
    """

    points: npt.NDArray[np.float64]
    tetrahedra: npt.NDArray[np.int64]
    tissue_labels: npt.NDArray[np.int32]
    sub_mesh: npt.NDArray[np.int32]
    constitutive: npt.NDArray[np.int32]
    target_edge_length: npt.NDArray[np.float64]
    tissue_names: Dict[int, str]
    tissue_colors: Dict[int, Tuple[float, float, float]]
    vtu: bytes = field(repr=False)

    def __repr__(self) -> str:
        tissues = len(np.unique(self.tissue_labels))
        return f"<surgicalmesher.Mesh: {len(self.tetrahedra)} tetrahedra, {len(self.points)} points, {tissues} tissues>"

    def save(self, file: "str | os.PathLike[str]", **options: Any) -> None:
        """Writes the mesh to a file in the format of its extension.

        `.vtu` without options is written as the program made it; other formats (.inp, .feb, .msh, ...) are written by
        `surgicalmesher convert`, and `options` are its options. Raises MeshingError if that fails."""
        from ._meshing import option_arguments

        file = os.path.abspath(file)
        if file.endswith(".vtu") and not options:
            with open(file, "wb") as stream:
                stream.write(self.vtu)
            return
        with tempfile.TemporaryDirectory(prefix="surgicalmesher-") as scratch:
            source = os.path.join(scratch, "mesh.vtu")
            with open(source, "wb") as stream:
                stream.write(self.vtu)
            words = option_arguments("convert", options)
            with _one_name(file):
                run("convert", [*words, source, file])

    def to_meshio(self) -> Any:
        """Returns the mesh as a meshio.Mesh, with the arrays TissueLabel, SubMesh, Constitutive and
        TargetEdgeLength."""
        import meshio

        return meshio.Mesh(self.points, [("tetra", self.tetrahedra)],
                           point_data={"TargetEdgeLength": self.target_edge_length},
                           cell_data={name: [values] for name, values in self._cell_arrays().items()})

    def to_pyvista(self) -> Any:
        """Returns the mesh as a pyvista.UnstructuredGrid, with the arrays TissueLabel, SubMesh, Constitutive and
        TargetEdgeLength."""
        import pyvista

        grid = pyvista.UnstructuredGrid({pyvista.CellType.TETRA: self.tetrahedra}, self.points)
        for name, values in self._cell_arrays().items():
            grid.cell_data[name] = values
        grid.point_data["TargetEdgeLength"] = self.target_edge_length
        return grid

    def _cell_arrays(self) -> Dict[str, npt.NDArray[np.int32]]:
        return {"TissueLabel": self.tissue_labels, "SubMesh": self.sub_mesh, "Constitutive": self.constitutive}


def read_mesh(file: "str | os.PathLike[str]") -> Mesh:
    """Reads a mesh.vtu that Fuchs Tetrahedralizer or `surgicalmesher mesh` wrote, and returns the Mesh.

    Raises MeshingError for other files, also for a `.vtu` that `surgicalmesher convert` wrote, because it lacks the
    names and colours of the tissues."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import VTK_TETRA
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

    file = os.fspath(file)
    with open(file, "rb") as stream:
        content = stream.read()
    reader = vtkXMLUnstructuredGridReader()
    if not reader.CanReadFile(file):
        raise MeshingError(f"{file}: no VTK unstructured grid, expected tetrahedra that surgicalmesher wrote", 1)
    reader.SetFileName(file)
    reader.Update()
    grid = reader.GetOutput()
    if grid.GetNumberOfCells() == 0 or (vtk_to_numpy(grid.GetCellTypesArray()) != VTK_TETRA).any():
        raise MeshingError(f"{file}: other cells or none found, tetrahedra of four points alone expected", 1)

    def found(data: Any, name: str) -> Any:
        values = data.GetAbstractArray(name)
        if values is None:
            raise MeshingError(f"{file}: no array {name}, expected tetrahedra that surgicalmesher wrote", 1)
        return values

    def array(data: Any, name: str) -> Any:
        return vtk_to_numpy(found(data, name)).copy()

    cells, texts = grid.GetCellData(), grid.GetFieldData()
    ids = [int(label) for label in array(texts, "TissueIds")]
    names = found(texts, "TissueNames")
    colors = array(texts, "TissueColors")
    return Mesh(
        points=vtk_to_numpy(grid.GetPoints().GetData()).astype(np.float64),
        tetrahedra=vtk_to_numpy(grid.GetCells().GetConnectivityArray()).astype(np.int64).reshape(-1, 4),
        tissue_labels=array(cells, "TissueLabel"),
        sub_mesh=array(cells, "SubMesh"),
        constitutive=array(cells, "Constitutive"),
        target_edge_length=array(grid.GetPointData(), "TargetEdgeLength"),
        tissue_names={label: names.GetValue(n) for n, label in enumerate(ids)},
        tissue_colors={label: tuple(colors[n]) for n, label in enumerate(ids)},
        vtu=content)
