#!/usr/bin/python3
"""A tool that draws tissue aside in the child of a mesh. usage: replay.py PARENT.vtu CHILD.vtu OUTDIR

The tool takes hold of the child next to its middle, draws 8 mm to the left and up within a second, waits, and lets back.
Leaves in OUTDIR tool.csv, forces.csv, motion.pvd with its files, report.json and multirate.png. MultirateSolverCLI has to
be on the PATH; the picture needs a display: run it by ../example/display.py.
"""
import csv
import json
import os
import subprocess
import sys

import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "example"))
from meshfiles import read_dataset  # noqa: E402

MOTION = np.array([7.0, 0, 4])  # mm, LPS
SECONDS, REACHES = (0, 1, 1.4, 2.4), (0, 1, 1, 0)
SHOWN = (0, 0.5, 1.2)
PARENT_RATE = 25


def arrays_of(dataset):
    from vtk.util.numpy_support import vtk_to_numpy
    data = dataset.GetPointData()
    return vtk_to_numpy(dataset.GetPoints().GetData()), lambda name: vtk_to_numpy(data.GetArray(name))


def replay(parent, child):
    """Leaves what the program writes in the working folder."""
    points, array = arrays_of(read_dataset(child))
    inner = points[array("InterfaceId") < 0]
    tip = inner[np.argmin(np.linalg.norm(inner - points.mean(axis=0), axis=1))]
    with open("tool.csv", "w", encoding="ascii") as table:
        table.write("seconds,x,y,z\n")
        for seconds, reach in zip(SECONDS, REACHES):
            table.write("%g,%r,%r,%r\n" % (seconds, *(tip + reach * MOTION).tolist()))
    subprocess.run(["MultirateSolverCLI", "--tool", "tool.csv", "--parentRate", str(PARENT_RATE), "--forces",
                    "forces.csv", "--motion", "motion.pvd", "--report", "report.json", parent, child, "child.vtu"],
                   check=True, stdout=subprocess.DEVNULL)
    return tip


def displaced_half(frame, tip):
    """The child's tetrahedra behind the coronal plane through the tip, where they are now; displacements (mm) of each."""
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

    from views import cell_centers, extracted
    grid = read_dataset(f"motion_{frame:04d}.vtu")
    half = extracted(grid, cell_centers(grid)[:, 1] > tip[1])
    points, array = arrays_of(half)
    sizes = np.linalg.norm(array("Displacement"), axis=1)
    corners = vtk_to_numpy(half.GetCells().GetConnectivityArray()).reshape(-1, 4)
    moved = vtk.vtkPoints()
    moved.SetData(numpy_to_vtk(points + array("Displacement"), deep=True))
    half.SetPoints(moved)
    return half, sizes[corners].mean(axis=1)


def put_forces(figure, place, rate):
    with open("forces.csv", encoding="ascii") as table:
        rows = list(csv.DictReader(table))
    seconds = [float(row["seconds"]) for row in rows]
    newton = [np.linalg.norm([float(row["force" + axis]) for axis in "XYZ"]) for row in rows]
    axes = figure.add_axes(place)
    axes.plot(seconds, 1e3 * np.array(newton), color="#c8102e")
    axes.set_xlabel("s")
    axes.set_ylabel("force on the tool, mN")
    axes.set_title(f"{len(rows)} steps, at most {rate:,.0f} Hz")
    axes.spines[["top", "right"]].set_visible(False)


def draw(tip, rate):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    from PIL import Image
    from views import View, actor_of, paint, put, save_image
    frames = [displaced_half(round(seconds * PARENT_RATE), tip) for seconds in SHOWN]
    largest = max(sizes.max() for _, sizes in frames)
    size = (400, 380)
    figure = plt.figure(figsize=(((len(frames) + 1) * size[0] + 80) / 100, (size[1] + 60) / 100), dpi=100)
    reached = np.concatenate([arrays_of(half)[0] for half, _ in frames])
    for i, ((half, sizes), seconds) in enumerate(zip(frames, SHOWN)):
        paint(half, (255 * plt.get_cmap("viridis")(sizes / largest)[:, :3]).astype(np.uint8))
        axes = put(figure, View([actor_of(half, 0.5)], (0, 1, 0), size, also=reached), i * size[0], 10)
        axes.text(size[0] / 2, size[1] + 8, f"{seconds:g} s", ha="center", va="bottom", fontsize=13, clip_on=False)
    width = figure.get_figwidth() * 100
    scale = plt.cm.ScalarMappable(plt.Normalize(0, largest), "viridis")
    bar = figure.add_axes((3 * size[0] / width, 0.2, 10 / width, 0.6))
    figure.colorbar(scale, cax=bar, label="displacement, mm")
    put_forces(figure, ((3 * size[0] + 150) / width, 0.2, 300 / width, 0.6), rate)
    figure.canvas.draw()
    save_image(Image.fromarray(np.asarray(figure.canvas.buffer_rgba())), "multirate.png")


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__.split("\n\n", maxsplit=1)[0])
    parent, child = (os.path.abspath(file) for file in sys.argv[1:3])
    os.makedirs(sys.argv[3], exist_ok=True)
    os.chdir(sys.argv[3])
    tip = replay(parent, child)
    with open("report.json", encoding="utf-8") as file:
        report = json.load(file)
    rate = 1 / report["medianStepSeconds"]
    print(f"{report['steps']} steps, {1e3 * report['medianStepSeconds']:.2f} ms each ({rate:,.0f} Hz), "
          f"{1e3 * report['medianExchangeSeconds']:.0f} ms an exchange")
    draw(tip, rate)


if __name__ == "__main__":
    main()
