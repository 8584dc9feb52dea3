#!/usr/bin/python3
"""Draws the critical tissues on the brain, like figure 7 of Audette et al. (Computer Aided Surgery 12(1), 2007).

usage: critical_tissues.py FOLDER, with what head-phantom.sh makes: mesh.vtu, nerves.vtp, sheaths.vtp, scale.json.
Writes critical_tissues.png to FOLDER: the part of the brain that may move, seen from below and in front, with the optic
nerves on it, and an enlarged view in which the sheaths of the nerves are drawn as lines, so that their axes show. Needs
a display: run it by ../example/display.py.
"""
import json
import os
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402
import vtk  # noqa: E402
from PIL import Image  # noqa: E402

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "example"))
from meshfiles import cell_array, read_dataset  # noqa: E402
from views import (FOCUS_COLOR, INK, View, actor_of, cell_centers, extracted, lines_of, mark, put,  # noqa: E402
                   save_image)

BRAIN = (2, 3, 8)  # grey, white and glial matter of the phantom
BRAIN_COLOR, SHEATH_COLOR, AXIS_COLOR = (0.88, 0.79, 0.74), (0.96, 0.80, 0.22), (0.70, 0.10, 0.12)
FROM_BELOW = (0.25, 0.75, 1)  # viewing direction, LPS
SIZE, NEAR = (660, 640), 22   # size of a view (pixels); what the enlarged view adds to the nerves' extent (mm)
DPI = 100


def wires_of(surface):
    actor = lines_of(surface, 1)
    actor.GetProperty().SetRepresentationToWireframe()
    return actor


def axes_of(lines):
    tubes = vtk.vtkTubeFilter()
    tubes.SetInputData(lines)
    tubes.SetRadius(0.4)
    tubes.SetNumberOfSides(12)
    tubes.Update()
    return actor_of(tubes.GetOutput(), color=AXIS_COLOR)


def main(folder):
    mesh = read_dataset(os.path.join(folder, "mesh.vtu"))
    sheaths, axes = (read_dataset(os.path.join(folder, file)) for file in ("sheaths.vtp", "nerves.vtp"))
    with open(os.path.join(folder, "scale.json"), encoding="utf-8") as file:
        report = json.load(file)
    target, path = np.array(report["targets"][0]), np.array(report["paths"][0]["points"])
    is_brain = np.isin(cell_array(mesh, "TissueLabel"), BRAIN)
    brain = actor_of(extracted(mesh, is_brain), 0.4, BRAIN_COLOR)
    centers = cell_centers(mesh)
    low, high = np.reshape(sheaths.GetBounds(), (3, 2)).T
    is_near = np.all((centers > low - NEAR / 2) & (centers < high + NEAR / 2), axis=1)
    near = actor_of(extracted(mesh, is_brain & is_near), 0.6, BRAIN_COLOR)
    whole = View([brain, actor_of(sheaths, 0.5, SHEATH_COLOR)], FROM_BELOW, SIZE)
    detail = View([near, wires_of(sheaths), axes_of(axes)], FROM_BELOW, SIZE)
    figure = plt.figure(figsize=(2 * SIZE[0] / DPI, (SIZE[1] + 40) / DPI), dpi=DPI)
    for n, (view, title) in enumerate(((whole, "Brain, and the sheaths of the optic nerves as shells"),
                                       (detail, "Nearer: the axes of the nerves as beams"))):
        panel = put(figure, view, n * SIZE[0], 0)
        panel.plot(*view.pixels(path).T, color=FOCUS_COLOR, linewidth=1.5, linestyle=(0, (4, 3)))
        mark(panel, view, target)
        figure.text((n + 0.5) / 2, 1 - 22 / (SIZE[1] + 40), title, ha="center", fontsize=14, color=INK)
    figure.canvas.draw()
    image = Image.fromarray(np.asarray(figure.canvas.buffer_rgba()))
    save_image(image, os.path.join(folder, "critical_tissues.png"), palette=True)


if __name__ == "__main__":
    main(sys.argv[1])
