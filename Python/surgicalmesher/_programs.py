# SPDX-License-Identifier: Apache-2.0
"""The program surgicalmesher, run to its end."""
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
    """A program's refusal, in its own sentence; `status` is its exit status: 1 for the input, 2 for options, 3 for a
    failure of the engine."""

    def __init__(self, reason: str, status: int) -> None:
        super().__init__(reason)
        self.status = status


class MeshingWarning(UserWarning):
    """What a program warns of, as a target outside of the map."""


def program() -> str:
    """Path of the program: in the package, or in the folder that SURGICALMESHER_PROGRAMS names."""
    package = os.path.join(os.path.dirname(os.path.abspath(__file__)), "bin")
    return os.path.join(os.environ.get("SURGICALMESHER_PROGRAMS", package), "surgicalmesher")


def _missing(path: str, error: OSError) -> MeshingError:
    return MeshingError(f"{path}: {error.strerror}, expected the program {os.path.basename(path)}", 3)


def _reason_in(errors: bytes, prefix: str) -> str:
    """The last line that is no warning, without the program's name."""
    lines = [line for line in errors.decode(errors="replace").splitlines() if line and ": warning: " not in line]
    reason = lines[-1] if lines else ""
    return reason[len(prefix):] if reason.startswith(prefix) else reason


def _failed(name: str, status: int, reason: str) -> MeshingError:
    return MeshingError(reason or f"{name} ended with status {status}", status)


def _parameters(*words: str) -> List[xml.Element]:
    """Those with a flag, as a program describes itself."""
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
    """Of the stages of `surgicalmesher mesh`, whose own description has them as texts. What an earlier stage reads and
    a later one writes is to be read."""
    folder = os.path.dirname(os.path.realpath(program()))
    channels: Dict[str, Optional[str]] = {}
    for stage in STAGES:
        for parameter in _parameters(os.path.join(folder, stage)):
            channels.setdefault(str(parameter.findtext("longflag")), parameter.findtext("channel"))
    return {flag for flag, channel in channels.items() if channel == "output"}


def vector_flags(command: str) -> Set[str]:
    """Of `surgicalmesher command`: those whose one value is several numbers."""
    return {str(parameter.findtext("longflag")) for parameter in _parameters(program(), command)
            if parameter.tag.endswith("-vector")}


def _hand_on(line: bytes, progress: Optional[Progress]) -> None:
    """A line of --progress json; in names of files, any bytes may be."""
    event = json.loads(line.decode(errors="replace"))
    if progress is not None and "progress" in event:
        progress(event["progress"], event["stage"])
    if "warning" in event:
        warnings.warn(event["warning"], MeshingWarning, stacklevel=4)  # where the package's function was called


def run(command: str, arguments: Sequence[str], progress: Optional[Progress] = None) -> None:
    """Runs `surgicalmesher command arguments...`. Ctrl-C and whatever `progress` raises end the program, which takes
    its half-written files with it. Raises MeshingError."""
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
                child.communicate()  # it still has its files to take away, and a place for its last words
                raise
        errors.seek(0)
        reason = _reason_in(errors.read(), f"surgicalmesher {command}: ")
    if child.returncode:
        raise _failed(" ".join(words[:2]), child.returncode, reason)
