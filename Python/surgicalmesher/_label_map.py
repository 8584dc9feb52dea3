# SPDX-License-Identifier: Apache-2.0
"""Converts label maps of other packages to arrays and to files.

A package is imported only after one of its objects has been passed in."""
from dataclasses import dataclass
from typing import Any, Optional, Sequence

import numpy as np
import numpy.typing as npt

LPS_FROM_RAS = np.diag([-1.0, -1.0, 1.0, 1.0])
ARRAYS_ONLY = "expected with numpy arrays only (the voxels of the scale volume have scaleSpacing)"
# The fields of a NIfTI-1 or NIfTI-2 header that give the positions of the voxels.
NIFTI_PLACEMENT = ("pixdim", "xyzt_units", "qform_code", "quatern_b", "quatern_c", "quatern_d", "qoffset_x",
                   "qoffset_y", "qoffset_z", "sform_code", "srow_x", "srow_y", "srow_z")


@dataclass(frozen=True)
class LabelMap:
    """Labels indexed by voxel [i, j, k], and the 4 x 4 matrix that maps (i, j, k, 1) to LPS coordinates in mm."""

    labels: npt.NDArray[np.uint16]
    affine: npt.NDArray[np.float64]


def _is_nibabel(image: Any) -> bool:
    return hasattr(image, "dataobj") and hasattr(image, "affine")


def _is_nifti(image: Any) -> bool:
    return _is_nibabel(image) and hasattr(image.header, "get_xyzt_units")


def _is_simpleitk(image: Any) -> bool:
    return hasattr(image, "GetPixelIDTypeAsString") and hasattr(image, "TransformContinuousIndexToPhysicalPoint")


def _is_vtk(image: Any) -> bool:
    return hasattr(image, "GetIndexToPhysicalMatrix") and hasattr(image, "GetPointData")


def _finite(name: str, values: Any) -> npt.NDArray[np.float64]:
    numbers = np.asarray(values, float)
    if not np.isfinite(numbers).all():
        raise ValueError(f"{name}: {numbers.tolist()} found, finite numbers expected")
    return numbers


def _affine(spacing: Any, origin: Any, directions: Any) -> npt.NDArray[np.float64]:
    affine = np.eye(4)
    affine[:3, :3] = _finite("directions", directions).reshape(3, 3) * _finite("spacing", spacing).reshape(3)
    affine[:3, 3] = _finite("origin", origin).reshape(3)
    return affine


def _shift(offset: Any) -> npt.NDArray[np.float64]:
    return _affine((1, 1, 1), offset, np.eye(3))


def _from_simpleitk(image: Any) -> "tuple[Any, npt.NDArray[np.float64]]":
    import SimpleITK

    labels = SimpleITK.GetArrayViewFromImage(image).T
    return labels, _affine(image.GetSpacing(), image.GetOrigin(), image.GetDirection())


def _from_vtk(image: Any) -> "tuple[Any, npt.NDArray[np.float64]]":
    from vtkmodules.util.numpy_support import vtk_to_numpy

    at_points, in_cells = image.GetPointData().GetScalars(), image.GetCellData().GetScalars()
    if (at_points is None) == (in_cells is None):
        raise ValueError("labels: an image with one active scalar array, of points or of cells, expected")
    matrix = image.GetIndexToPhysicalMatrix()
    affine = _finite("labels: affine", [[matrix.GetElement(row, column) for column in range(4)] for row in range(4)])
    first, sizes = np.array(image.GetExtent()[::2], float), np.array(image.GetDimensions())
    if at_points is None:
        first, sizes = first + 0.5, np.maximum(sizes - 1, 1)
    values = vtk_to_numpy(in_cells if at_points is None else at_points)
    if values.ndim != 1:
        raise ValueError("labels: one number per voxel expected")
    return values.reshape(sizes, order="F"), affine @ _shift(first)


def _as_labels(values: Any) -> npt.NDArray[np.uint16]:
    values = np.asanyarray(values)
    if isinstance(values, np.ma.MaskedArray):
        values = values.filled(0)  # masked voxels are background
    if values.ndim == 4 and values.shape[3] == 1:
        values = values[..., 0]
    if values.ndim != 3:
        raise ValueError(f"labels: three dimensions expected, found {values.ndim}")
    labels = values.astype(np.uint16)
    if not np.array_equal(labels, values):
        raise ValueError("labels: integers from 0 to 65535 expected")
    return labels


def label_map(image: Any, spacing: Optional[Sequence[float]], origin: Optional[Sequence[float]],
              directions: Any) -> LabelMap:
    """Returns the label map of a numpy array, or of an image of nibabel, SimpleITK, VTK or pyvista.

    The other arguments are the grid of an array, in mm and LPS; by default, the spacing is 1 mm, the origin is
    (0, 0, 0), and i, j, k point along the axes of LPS. An image has its own grid. Raises ValueError if `image` is not a
    label map, if the grid is not finite, or if a grid is given for an image."""
    given = [name for name, value in (("spacing", spacing), ("origin", origin), ("directions", directions))
             if value is not None]
    if not (_is_nibabel(image) or _is_simpleitk(image) or _is_vtk(image)):
        return LabelMap(_as_labels(image), _affine((1, 1, 1) if spacing is None else spacing,
                                                   (0, 0, 0) if origin is None else origin,
                                                   np.eye(3) if directions is None else directions))
    if given:
        raise ValueError(f"{given[0]}: the image has its own, {ARRAYS_ONLY}")
    if _is_nibabel(image):
        affine = image.header.get_best_affine() if image.affine is None else image.affine
        return LabelMap(_as_labels(image.dataobj), LPS_FROM_RAS @ _finite("labels: affine", affine))
    values, affine = _from_simpleitk(image) if _is_simpleitk(image) else _from_vtk(image)
    return LabelMap(_as_labels(values), affine)


def _write_nrrd(map_: LabelMap, file: str) -> None:
    """Writes an uncompressed NRRD file, with all digits of the affine. No library is needed for that."""
    vectors = ["(%s)" % ",".join("%.17g" % x for x in map_.affine[:3, column]) for column in range(4)]
    header = ("NRRD0005\ntype: uint16\ndimension: 3\nspace: left-posterior-superior\nsizes: %d %d %d\n"
              "space directions: %s %s %s\nspace origin: %s\nendian: little\nencoding: raw\n\n")
    with open(file, "wb") as stream:
        stream.write((header % (*map_.labels.shape, *vectors)).encode("ascii"))
        stream.write(map_.labels.astype("<u2", copy=False).tobytes(order="F"))


def _write_nifti(map_: LabelMap, image: Any, file: str) -> None:
    import nibabel

    header = nibabel.Nifti1Header()
    header.set_data_dtype(np.uint16)
    for field in NIFTI_PLACEMENT:
        header[field] = image.header[field]
    nibabel.Nifti1Image(map_.labels, image.affine, header).to_filename(file)


def file_name(image: Any) -> str:
    """Returns the name of the file that `write_map` should write for the image: its extension selects the format."""
    return "map.nii" if _is_nifti(image) else "map.nrrd"


def write_map(map_: LabelMap, image: Any, file: str) -> None:
    """Writes the labels of `image`, converted to `map_`, to a file. The units, qform and sform of a NIfTI image are
    copied unchanged, so that the program reads them as it would from the image's own file."""
    if _is_nifti(image):
        _write_nifti(map_, image, file)
    else:
        _write_nrrd(map_, file)
