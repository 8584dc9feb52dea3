#!/usr/bin/python3
"""Makes the project's template of a face by VolumetricHexCLI. usage: make_template.py FOLDER

Writes to FOLDER face.vtu (hexahedra with muscles, layers and sides), face.landmarks.fcsv, the report face.json, and the
inputs, envelope.vtp and the muscles. VolumetricHexCLI has to be on the PATH. The shape is built by face_shape.py.
"""
import os
import subprocess
import sys

import face_shape

DIVISIONS = "28,4,28"


def make(folder, *more):
    """Makes the template in `folder`; `more` are further options of VolumetricHexCLI."""
    os.makedirs(folder, exist_ok=True)
    at = lambda name: os.path.join(folder, name)  # noqa: E731
    face_shape.write_surface(at("envelope.vtp"), *face_shape.envelope())
    options = ["--divisions", DIVISIONS, "--report", at("face.json")]
    for name, (points, triangles) in face_shape.muscles().items():
        face_shape.write_surface(at(name + ".vtp"), points, triangles)
        options += ["--parts", at(name + ".vtp")]
    face_shape.write_landmarks(at("face.landmarks.fcsv"), face_shape.landmarks())
    subprocess.run(["VolumetricHexCLI", *options, *more, at("envelope.vtp"), at("envelope.vtp"), at("face.vtu")], check=True,
                   stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__.split("\n\n")[0])
    make(sys.argv[1])
