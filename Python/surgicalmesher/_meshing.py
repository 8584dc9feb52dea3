# SPDX-License-Identifier: Apache-2.0
"""The functions `mesh` and `estimate`, which translate their arguments into a command line and files and run it."""
import contextlib
import json
import os
import re
import shutil
import tempfile
from typing import Any, Callable, Dict, Iterable, Iterator, List, Mapping, Optional, Sequence

import numpy as np

from ._label_map import ARRAYS_ONLY, file_name, label_map, write_map
from ._programs import Progress, output_flags, run, vector_flags
from ._tetrahedra import Mesh, read_mesh


# Flags that make a program describe itself, or report in a form that `run` does not read.
QUESTIONS = {"help", "version", "xml", "echo", "progress"}


def _plain(value: Any) -> Any:
    """Returns the number in a zero-dimensional array, and any other value as it is."""
    return value[()] if isinstance(value, np.ndarray) and value.ndim == 0 else value


def _to_read_again(value: Any) -> Any:
    """Returns the value in a form that can be read more than once: iterators, such as generators, become lists, also
    inside lists and tuples."""
    if hasattr(value, "__next__") or isinstance(value, (list, tuple)):
        return [_to_read_again(part) for part in value]
    return value


def _word(value: Any) -> str:
    """Returns the value as the programs read it; a point becomes x,y,z."""
    value = _plain(value)
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        digits = repr(float(value))
        return digits[:-2] if digits.endswith(".0") else digits
    return ",".join(_word(part) for part in value)


def _is_sequence(value: Any) -> bool:
    return not isinstance(value, (str, os.PathLike)) and hasattr(value, "__iter__")


def _repeated(name: str, values: Iterable[Any]) -> List[str]:
    return [f"--{name}={_word(value)}" for value in values]


def option_arguments(command: str, options: Mapping[str, Any]) -> List[str]:
    """Returns `--name=value` for every option that is neither None nor False, and the flag alone for True.

    A sequence repeats its flag, except where one value of the flag consists of several numbers. Raises ValueError for
    the flags in QUESTIONS; all others are left to the program to check."""
    words: List[str] = []
    plain = {name: _plain(value) for name, value in options.items()}
    vectors = vector_flags(command) if any(map(_is_sequence, plain.values())) else set()
    for name, value in plain.items():
        if name in QUESTIONS:
            raise ValueError(f"{name}: no option of this function, expected those of `surgicalmesher {command} --help`")
        if isinstance(value, (bool, np.bool_)):
            words += [f"--{name}"] if value else []
        elif value is not None:
            words += _repeated(name, value if _is_sequence(value) and name not in vectors else [value])
    return words


def _place_arguments(flag: str, point_flag: str, places: Any) -> List[str]:
    """Returns the arguments for `places`: markups files by `--flag`, or points (mm, LPS) by `--point_flag`. Raises
    ValueError for anything else."""
    if places is None:
        return []
    places = _to_read_again(places)
    if isinstance(places, (str, os.PathLike)):
        places = [places]
    if len(places) and all(isinstance(place, (str, os.PathLike)) for place in places):
        return _repeated(flag, places)
    points = np.asarray(places, dtype=float)
    if points.ndim == 0 or points.size == 0 or points.shape[-1] != 3 or points.ndim > 2:
        raise ValueError(f"{flag}: points of three numbers (mm, LPS) or files expected, found {places!r}")
    return _repeated(point_flag, points.reshape(-1, 3))


def _lies_in_results(value: Any) -> bool:
    """Returns whether the name of an output, or one of several, has no folder of its own. As for
    `surgicalmesher mesh`, a comma is part of a name."""
    if isinstance(value, (str, os.PathLike)):
        return not os.path.dirname(value)
    value = _plain(value)
    return hasattr(value, "__iter__") and any(map(_lies_in_results, value))


def _require_kept(options: Mapping[str, Any]) -> None:
    """Raises ValueError if an output would be deleted together with the temporary folder."""
    names = [name for name, value in options.items() if _lies_in_results(value)]
    outputs = output_flags() if names else ()
    for name in names:
        if name in outputs:
            raise ValueError(f"{name}: {options[name]!r} would lie in the folder of the results, expected with folder=, "
                             "or with a folder of its own")


def _is_source(image: Any, file: str) -> bool:
    """Returns whether nibabel opened the image from this file, and so may still have to read its voxels from it."""
    source = image.get_filename() if hasattr(image, "get_filename") else None
    return source is not None and os.path.exists(file) and os.path.samefile(source, file)


def _is_at_work(process: int) -> bool:
    """Returns whether the process with this number may be another one that is meshing."""
    if process == os.getpid():  # the number belonged to an earlier process
        return False
    try:
        os.kill(process, 0)
    except (ProcessLookupError, OverflowError):  # no number of a process, if too large
        return False
    except OSError:  # another user's process
        pass
    return True


def _tidy(file: str) -> None:
    """Restores the copy of the file that a killed call had set aside, and deletes new versions that it had begun."""
    folder, name = os.path.split(file)
    for found in os.listdir(folder):
        left = re.fullmatch(rf"\.([0-9]+)\.(new\.)?{re.escape(name)}", found)
        if not left or _is_at_work(int(left[1])):
            continue
        if left[2]:
            os.remove(os.path.join(folder, found))
        else:
            _bring_back(os.path.join(folder, found), file)


def _bring_back(aside: str, file: str) -> None:
    os.replace(aside, file)
    with contextlib.suppress(FileNotFoundError):  # `replace` leaves both names in place if they are links to one file
        os.remove(aside)


@contextlib.contextmanager
def _as_before(file: str, write: Optional[Callable[[str], None]] = None) -> Iterator[None]:
    """Restores the file if the body of the `with` statement fails.

    With `write`, which is called with the name of a file to write, the file is replaced before the body runs; without
    it, the body may replace the file. If this process is killed, the next call restores the file. If the file is a
    symbolic link, the file that it points to is replaced, and the link stays."""
    folder, name = os.path.split(os.path.realpath(file))
    _tidy(os.path.join(folder, name))
    own = f".{os.getpid()}."
    file, aside, new = (os.path.join(folder, begin + name) for begin in ("", own, own + "new."))
    was_there = os.path.isfile(file)
    try:
        if was_there:
            try:
                os.link(file, aside)
            except OSError:  # the file system may not support hard links
                shutil.copy2(file, new)
                os.replace(new, aside)  # so that `aside` is never an incomplete copy
        if write:
            write(new)
            os.replace(new, file)
        yield
    except BaseException:
        if os.path.exists(new):
            os.remove(new)
        if os.path.exists(aside):
            _bring_back(aside, file)
        elif not was_there and os.path.isfile(file):
            os.remove(file)
        raise
    if was_there:
        os.remove(aside)


@contextlib.contextmanager
def _map_file(labels: Any, grid: Sequence[Any], folder: str) -> Iterator[str]:
    """Yields the path of the label map's file: the file that was given, or one written to the folder, which stays there
    only if the body of the `with` statement succeeds. `grid` is (spacing, origin, directions)."""
    if isinstance(labels, (str, os.PathLike)):
        if any(value is not None for value in grid):
            raise ValueError(f"spacing, origin and directions are the file's own, {ARRAYS_ONLY}")
        yield os.path.abspath(labels)
        return
    file = os.path.join(folder, file_name(labels))
    content = label_map(labels, *grid)
    if _is_source(labels, file):
        raise ValueError(f"{file}: the image's own file would be overwritten, expected another folder")
    made = not os.path.isdir(folder)
    os.makedirs(folder, exist_ok=True)
    try:
        with _as_before(os.path.join(folder, "run.toml")):  # the run's options, which belong to the map
            with _as_before(file, lambda new: write_map(content, labels, new)):
                yield file
    except BaseException:
        if made:
            with contextlib.suppress(OSError):  # the folder is not empty if stages were complete; they stay
                os.rmdir(folder)
        raise


def _arguments(command: str, targets: Any, path: Any, options: Mapping[str, Any]) -> List[str]:
    return [*_place_arguments("targets", "targetPoint", targets), *_place_arguments("path", "pathPoint", path),
            *option_arguments(command, options)]


def mesh(labels: Any, *, spacing: Optional[Sequence[float]] = None, origin: Optional[Sequence[float]] = None,
         directions: Any = None, targets: Any = None, path: Any = None, preset: Optional[str] = None,
         scaleSpacing: Optional[float] = None, folder: "str | os.PathLike[str] | None" = None,
         progress: Optional[Progress] = None, **options: Any) -> Mesh:
    """Meshes all tissues of a label map with tetrahedra, fine around targets and paths, and returns the Mesh.

    labels        label map: a numpy array [i, j, k] of integers from 0 (background) to 65535; an image of nibabel,
                  SimpleITK, VTK or pyvista; or the name of a file
    spacing       for an array only: distances between voxels along i, j, k (mm); by default 1
    origin        for an array only: centre of the first voxel (mm, LPS); by default (0, 0, 0)
    directions    for an array only: 3 x 3 matrix whose columns are the directions of i, j, k in LPS; by default the
                  identity
    targets       point or points (mm, LPS) around which the mesh is fine, or the names of markups files
    path          points of a surgical path from entry to target (mm, LPS), along which the mesh is fine, or the names
                  of markups files
    preset        draft, default, fine or simulation: default values of the options
    scaleSpacing  distance between voxels of the scale volume (mm): the program's option --spacing
    folder        folder that keeps the files and the report of the run, and from which a later run continues; without
                  it, all files are deleted, and further outputs must name a folder: export="models/head.inp"
    progress      function that is called with the completed share, from 0 to 1, and the name of the stage; an exception
                  that it raises ends the run
    options       options of `surgicalmesher mesh --help` by name: minimumEdgeLength=0.5, threads=1, ...

    The mesh is the one that the command `surgicalmesher mesh` makes. Images of VTK and pyvista are taken to be in LPS.
    Ctrl-C ends the run; without `folder`, no files are left. Raises MeshingError with the program's message if the run
    fails, and ValueError for arguments that are not a label map, a grid or points. Issues the program's warnings as
    MeshingWarning.
    """
    options = {name: _to_read_again(value) for name, value in options.items()}
    if folder is None:
        _require_kept(options)
    elif not os.fspath(folder):
        raise ValueError("folder: '' found, a folder expected")
    with tempfile.TemporaryDirectory(prefix="surgicalmesher-") as scratch:
        results = os.path.join(scratch, "results") if folder is None else os.path.abspath(folder)
        words = _arguments("mesh", targets, path, {"preset": preset, "spacing": scaleSpacing, **options})
        with _map_file(labels, (spacing, origin, directions), results) as file:
            run("mesh", [*words, file, results], progress)
        return read_mesh(os.path.join(results, "mesh.vtu"))


def estimate(labels: Any, *, spacing: Optional[Sequence[float]] = None, origin: Optional[Sequence[float]] = None,
             directions: Any = None, targets: Any = None, path: Any = None, preset: Optional[str] = None,
             scaleSpacing: Optional[float] = None, **options: Any) -> Dict[str, Any]:
    """Predicts the size, memory and time of a mesh before it is made.

    Returns a dictionary of `triangles`, `tetrahedra`, `memoryBytes` and `processorSeconds`, the figures of
    `surgicalmesher estimate`. The arguments mean the same as those of `mesh`; `options` are those of
    `surgicalmesher estimate --help`. Raises the same exceptions as `mesh`."""
    with tempfile.TemporaryDirectory(prefix="surgicalmesher-") as scratch:
        figures = os.path.join(scratch, "estimate.json")
        words = _arguments("estimate", targets, path, {"preset": preset, "spacing": scaleSpacing, **options})
        with _map_file(labels, (spacing, origin, directions), scratch) as file:
            run("estimate", [*words, f"--estimate={figures}", file])
        with open(figures, encoding="utf-8") as stream:
            return dict(json.load(stream))
