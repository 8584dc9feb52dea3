# SPDX-License-Identifier: Apache-2.0
"""Runs the program surgicalmesher: the command `surgicalmesher` of an environment, and `python -m surgicalmesher`."""
import os
import sys

from ._programs import program


def main() -> None:
    path = program()  # the full path, because the program looks for the other programs in its own folder
    os.execv(path, [path, *sys.argv[1:]])


if __name__ == "__main__":
    main()
