"""Keeps the finished parts of a long measurement in its working folder, so that they are not made again."""
import json
import os

import numpy as np


class Parts:
    def __init__(self, folder):
        self.folder = os.path.abspath(folder)
        os.makedirs(self.folder, exist_ok=True)

    def path(self, name):
        return os.path.join(self.folder, name)

    def record(self, name, make):
        """Returns the value of make(), which is called only if there is no JSON file with the value yet."""
        return self._kept(name + ".json", make, _write_json, _read_json)

    def arrays(self, name, make):
        """Returns the dictionary of arrays of make(), which is called only if there is no .npz file with them yet."""
        return self._kept(name + ".npz", make, _write_arrays, _read_arrays)

    def _kept(self, name, make, write, read):
        file = self.path(name)
        if not os.path.exists(file):
            value = make()
            write(file + ".part", value)  # renamed when complete, so that a file of the final name is never incomplete
            os.replace(file + ".part", file)
        return read(file)


def _write_json(file, value):
    with open(file, "w", encoding="utf-8") as stream:
        json.dump(value, stream, indent=1)


def _read_json(file):
    with open(file, encoding="utf-8") as stream:
        return json.load(stream)


def _write_arrays(file, arrays):
    with open(file, "wb") as stream:
        np.savez_compressed(stream, **arrays)


def _read_arrays(file):
    with np.load(file) as stored:
        return {name: stored[name] for name in stored.files}
