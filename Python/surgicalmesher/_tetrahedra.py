# SPDX-License-Identifier: Apache-2.0
"""The mesh as arrays."""
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
    """The program takes a name with commas for a list of names, unless there is such a file: an empty one stands in."""
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
        if os.path.exists(file) and os.path.getsize(file) == 0:  # refused, or a format of other files
            os.remove(file)


@dataclass(frozen=True)
class Mesh:
    """Tetrahedra of all tissues, in LPS mm; what the arrays hold is that of the file mesh.vtu."""

    points: npt.NDArray[np.float64]  #: (n, 3)
    tetrahedra: npt.NDArray[np.int64]  #: (m, 4) numbers of points, positively wound
    tissue_labels: npt.NDArray[np.int32]  #: (m,) label in the map
    sub_mesh: npt.NDArray[np.int32]  #: (m,) 0 for the parent, 1, 2, ... for children
    constitutive: npt.NDArray[np.int32]  #: (m,) 0 linear, 1 nonlinear, 2 null displacement
    target_edge_length: npt.NDArray[np.float64]  #: (n,) in mm
    tissue_names: Dict[int, str]
    tissue_colors: Dict[int, Tuple[float, float, float]]  #: red, green, blue from 0 to 1
    vtu: bytes = field(repr=False)  #: the file

    def __repr__(self) -> str:
        tissues = len(np.unique(self.tissue_labels))
        return f"<surgicalmesher.Mesh: {len(self.tetrahedra)} tetrahedra, {len(self.points)} points, {tissues} tissues>"

    def save(self, file: "str | os.PathLike[str]", **options: Any) -> None:
        """Writes the mesh in the format of the file's extension: `.vtu` as the program wrote it, others as
        `surgicalmesher convert` does (.inp, .feb, .msh ...), whose options these are. Raises MeshingError."""
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
        """A meshio.Mesh with the same arrays."""
        import meshio

        return meshio.Mesh(self.points, [("tetra", self.tetrahedra)],
                           point_data={"TargetEdgeLength": self.target_edge_length},
                           cell_data={name: [values] for name, values in self._cell_arrays().items()})

    def to_pyvista(self) -> Any:
        """A pyvista.UnstructuredGrid with the same arrays."""
        import pyvista

        grid = pyvista.UnstructuredGrid({pyvista.CellType.TETRA: self.tetrahedra}, self.points)
        for name, values in self._cell_arrays().items():
            grid.cell_data[name] = values
        grid.point_data["TargetEdgeLength"] = self.target_edge_length
        return grid

    def _cell_arrays(self) -> Dict[str, npt.NDArray[np.int32]]:
        return {"TissueLabel": self.tissue_labels, "SubMesh": self.sub_mesh, "Constitutive": self.constitutive}


def read_mesh(file: "str | os.PathLike[str]") -> Mesh:
    """A mesh.vtu that Fuchs Tetrahedralizer or `surgicalmesher mesh` wrote. Raises MeshingError for others, as
    `convert` writes them: they have no names and colours of tissues."""
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
