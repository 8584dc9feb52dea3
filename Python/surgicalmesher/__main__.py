# SPDX-License-Identifier: Apache-2.0
"""The program surgicalmesher itself: on the path of an environment, or by `python -m surgicalmesher`."""
import os
import sys

from ._programs import program


def main() -> None:
    path = program()  # whole: the others are looked for beside it
    os.execv(path, [path, *sys.argv[1:]])


if __name__ == "__main__":
    main()
