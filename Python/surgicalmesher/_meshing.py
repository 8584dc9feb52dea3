# SPDX-License-Identifier: Apache-2.0
"""From labels to a mesh."""
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


# Flags that make a program describe itself, or report in another way than `run` reads.
QUESTIONS = {"help", "version", "xml", "echo", "progress"}


def _plain(value: Any) -> Any:
    """An array without axes is the number in it."""
    return value[()] if isinstance(value, np.ndarray) and value.ndim == 0 else value


def _to_read_again(value: Any) -> Any:
    """What gives its values once only, as a generator, becomes a list of them, in a list or tuple, too."""
    if hasattr(value, "__next__") or isinstance(value, (list, tuple)):
        return [_to_read_again(part) for part in value]
    return value


def _word(value: Any) -> str:
    """A value as the programs read it; a point as x,y,z."""
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
    """`--name=value` of every option that is not None; a sequence repeats its flag, but where one value is several
    numbers; True is a flag alone. Raises ValueError for what is a question, and no option of the command."""
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
    """Of files of markups, or of points."""
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
    """Whether one of an output's names has no folder of its own. Commas are part of a name to `surgicalmesher mesh`."""
    if isinstance(value, (str, os.PathLike)):
        return not os.path.dirname(value)
    value = _plain(value)
    return hasattr(value, "__iter__") and any(map(_lies_in_results, value))


def _require_kept(options: Mapping[str, Any]) -> None:
    """Raises ValueError for outputs that would go with a temporary folder."""
    names = [name for name, value in options.items() if _lies_in_results(value)]
    outputs = output_flags() if names else ()
    for name in names:
        if name in outputs:
            raise ValueError(f"{name}: {options[name]!r} would lie in the folder of the results, expected with folder=, "
                             "or with a folder of its own")


def _is_source(image: Any, file: str) -> bool:
    """Whether nibabel has read the image from that file, perhaps not all of it yet."""
    source = image.get_filename() if hasattr(image, "get_filename") else None
    return source is not None and os.path.exists(file) and os.path.samefile(source, file)


def _is_at_work(process: int) -> bool:
    """Whether it may be another that meshes."""
    if process == os.getpid():  # a number that was another's
        return False
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):  # another user's
        pass
    return True


def _tidy(file: str) -> None:
    """What calls that were killed have set aside of the file comes back, and what they had begun goes."""
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
    with contextlib.suppress(FileNotFoundError):  # two names of one file are left as they are
        os.remove(aside)


@contextlib.contextmanager
def _as_before(file: str, write: Optional[Callable[[str], None]] = None) -> Iterator[None]:
    """The file is replaced, by what `write` writes or later on. What was there before comes back if what is done with
    it fails, by the next call if this one is killed. A link stays one."""
    folder, name = os.path.split(os.path.realpath(file))
    _tidy(os.path.join(folder, name))
    own = f".{os.getpid()}."
    file, aside, new = (os.path.join(folder, begin + name) for begin in ("", own, own + "new."))
    was_there = os.path.isfile(file)
    try:
        if was_there:
            try:
                os.link(file, aside)
            except OSError:  # not on every file system
                shutil.copy2(file, new)
                os.replace(new, aside)  # never a part of it
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
    """The map's file: its own, or one that is written into the folder, and stays there if the run succeeds."""
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
        with _as_before(os.path.join(folder, "run.toml")):  # its options are those of a run with the map
            with _as_before(file, lambda new: write_map(content, labels, new)):
                yield file
    except BaseException:
        if made:
            with contextlib.suppress(OSError):  # stages that were complete stay in it
                os.rmdir(folder)
        raise


def _arguments(command: str, targets: Any, path: Any, options: Mapping[str, Any]) -> List[str]:
    return [*_place_arguments("targets", "targetPoint", targets), *_place_arguments("path", "pathPoint", path),
            *option_arguments(command, options)]


def mesh(labels: Any, *, spacing: Optional[Sequence[float]] = None, origin: Optional[Sequence[float]] = None,
         directions: Any = None, targets: Any = None, path: Any = None, preset: Optional[str] = None,
         scaleSpacing: Optional[float] = None, folder: "str | os.PathLike[str] | None" = None,
         progress: Optional[Progress] = None, **options: Any) -> Mesh:
    """Tetrahedra of all tissues of a label map, fine around targets and paths, as `surgicalmesher mesh` makes them.

    labels        numpy array of labels [i, j, k] (0 is background), nibabel, SimpleITK, VTK or pyvista image, or a file
    spacing       of an array: mm between voxels along i, j, k; 1 without
    origin        of an array: centre of the first voxel (mm, LPS)
    directions    of an array: 3 x 3, whose columns are the axes i, j, k in LPS
    targets       points (mm, LPS), or files of markups
    path          points from entry to target (mm, LPS), or files of markups
    preset        draft, default, fine or simulation
    scaleSpacing  mm between voxels of the scale volume, the program's --spacing
    folder        where the files and the report of the run stay; without it they go with a temporary folder, and
                  outputs asked for need one of their own: export="models/head.inp"
    progress      called with the share done, from 0 to 1, and the name of the stage; what it raises cancels the run
    options       those of `surgicalmesher mesh --help`, by name: minimumEdgeLength=0.5, threads=1, ...

    VTK's and pyvista's images are taken as LPS. Ctrl-C ends the run; without `folder`, nothing stays of it. Raises
    MeshingError with the program's sentence, ValueError for what is no map; warns by MeshingWarning.
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
    """What `mesh` with the same arguments will take: the figures of `surgicalmesher estimate --estimate`, `triangles`,
    `tetrahedra`, `memoryBytes` and `processorSeconds`. Options are those of `surgicalmesher estimate --help`, which
    set lengths. Raises as `mesh` does."""
    with tempfile.TemporaryDirectory(prefix="surgicalmesher-") as scratch:
        figures = os.path.join(scratch, "estimate.json")
        words = _arguments("estimate", targets, path, {"preset": preset, "spacing": scaleSpacing, **options})
        with _map_file(labels, (spacing, origin, directions), scratch) as file:
            run("estimate", [*words, f"--estimate={figures}", file])
        with open(figures, encoding="utf-8") as stream:
            return dict(json.load(stream))
