# SPDX-License-Identifier: Apache-2.0
"""Runs the program surgicalmesher and reads its progress, warnings and errors."""
import json
import os
import subprocess
import tempfile
import warnings
import xml.etree.ElementTree as xml
from typing import Callable, Dict, List, Optional, Sequence, Set

Progress = Callable[[float, str], None]
STAGES = ("SurgicalPathScaleCLI", "SimplexMesherCLI", "FuchsTetrahedralizerCLI", "TissueMapperCLI")


class MeshingError(RuntimeError):
    """The error message of a program.

    `status` is the program's exit status: 1 for an error in the input, 2 for one in the options, 3 for a failure of the
    program itself, and minus the number of the signal if a signal ended the program."""

    def __init__(self, reason: str, status: int) -> None:
        super().__init__(reason)
        self.status = status


class MeshingWarning(UserWarning):
    """A warning of a program, for example about a target outside the map."""


def program() -> str:
    """Returns the path of the program: in the folder that the environment variable SURGICALMESHER_PROGRAMS names, or in
    the package."""
    package = os.path.join(os.path.dirname(os.path.abspath(__file__)), "bin")
    return os.path.join(os.environ.get("SURGICALMESHER_PROGRAMS", package), "surgicalmesher")


def _missing(path: str, error: OSError) -> MeshingError:
    return MeshingError(f"{path}: {error.strerror}, expected the program {os.path.basename(path)}", 3)


def _reason_in(errors: bytes, prefix: str) -> str:
    """Returns the last line of `errors` that is not a warning, without `prefix`, the program's name."""
    lines = [line for line in errors.decode(errors="replace").splitlines() if line and ": warning: " not in line]
    reason = lines[-1] if lines else ""
    return reason[len(prefix):] if reason.startswith(prefix) else reason


def _failed(name: str, status: int, reason: str) -> MeshingError:
    return MeshingError(reason or f"{name} ended with status {status}", status)


def _parameters(*words: str) -> List[xml.Element]:
    """Returns the parameters that have a flag, from the description that the program `words` prints with --xml."""
    try:
        done = subprocess.run([*words, "--xml"], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, check=False)
    except OSError as error:
        raise _missing(words[0], error) from None
    if done.returncode:
        raise _failed(" ".join(words), done.returncode, _reason_in(done.stderr, f"{os.path.basename(words[0])}: "))
    try:
        described = xml.fromstring(done.stdout)
    except xml.ParseError as error:
        raise MeshingError(f"{words[0]}: no XML ({error}), expected a program of surgicalmesher", 3) from None
    return [found for found in described.iterfind("parameters/*") if found.findtext("longflag")]


def output_flags() -> Set[str]:
    """Returns the flags that name output files of `surgicalmesher mesh`.

    They are taken from the descriptions of its stages, because its own description declares them as plain strings. If
    several stages have a flag, the first one decides, so a file that it reads is not an output."""
    folder = os.path.dirname(os.path.realpath(program()))
    channels: Dict[str, Optional[str]] = {}
    for stage in STAGES:
        for parameter in _parameters(os.path.join(folder, stage)):
            channels.setdefault(str(parameter.findtext("longflag")), parameter.findtext("channel"))
    return {flag for flag, channel in channels.items() if channel == "output"}


def vector_flags(command: str) -> Set[str]:
    """Returns the flags of `surgicalmesher command` for which one value consists of several numbers."""
    return {str(parameter.findtext("longflag")) for parameter in _parameters(program(), command)
            if parameter.tag.endswith("-vector")}


def _hand_on(line: bytes, progress: Optional[Progress]) -> None:
    """Passes one line of `--progress=json` on: progress to `progress`, and a warning as MeshingWarning. File names in
    the line may contain bytes that are not UTF-8."""
    event = json.loads(line.decode(errors="replace"))
    if progress is not None and "progress" in event:
        progress(event["progress"], event["stage"])
    if "warning" in event:
        warnings.warn(event["warning"], MeshingWarning, stacklevel=4)  # the line that called the package's function


def run(command: str, arguments: Sequence[str], progress: Optional[Progress] = None) -> None:
    """Runs `surgicalmesher command arguments...` to its end.

    Ctrl-C or an exception that `progress` raises ends the program, which then deletes its unfinished files. Raises
    MeshingError if the program is not found or fails."""
    words = [program(), command, "--progress=json", *arguments]
    with tempfile.TemporaryFile() as errors:
        try:
            child = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=errors)
        except OSError as error:
            raise _missing(words[0], error) from None
        with child:
            try:
                assert child.stdout is not None
                for line in child.stdout:
                    _hand_on(line, progress)
            except BaseException:
                child.terminate()
                child.communicate()  # lets the program delete its files and print what it still has to
                raise
        errors.seek(0)
        reason = _reason_in(errors.read(), f"surgicalmesher {command}: ")
    if child.returncode:
        raise _failed(" ".join(words[:2]), child.returncode, reason)
