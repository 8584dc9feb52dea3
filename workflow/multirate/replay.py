#!/usr/bin/python3
"""Simulates a tool that pulls tissue aside in the child of a mesh. usage: replay.py PARENT.vtu CHILD.vtu OUTDIR

The tool takes hold of the child near its middle, pulls 8 mm to the left and up within a second, waits, and moves back.
Writes to OUTDIR tool.csv, forces.csv, motion.pvd with its files, report.json, the picture multirate.png and the
animation multirate.gif. MultirateSolverCLI has to be on the PATH; pictures need a display: run it by
../example/display.py.
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
EVERY = 2  # exchanges between parent and child per frame of the animation
GAP = 24  # pixels between the views of two instants


def arrays_of(dataset):
    from vtk.util.numpy_support import vtk_to_numpy
    data = dataset.GetPointData()
    return vtk_to_numpy(dataset.GetPoints().GetData()), lambda name: vtk_to_numpy(data.GetArray(name))


def replay(parent, child):
    """Runs MultirateSolverCLI, whose outputs go to the working folder, and returns the point at which the tool takes
    hold (LPS, mm)."""
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
    """Returns the child's tetrahedra behind the coronal plane through the tip, in their displaced positions, and the
    mean displacement (mm) of each."""
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


def forces():
    """Returns the times (s) of all steps and the force on the tool (mN) at each."""
    with open("forces.csv", encoding="ascii") as table:
        rows = list(csv.DictReader(table))
    newton = [np.linalg.norm([float(row["force" + axis]) for axis in "XYZ"]) for row in rows]
    return np.array([float(row["seconds"]) for row in rows]), 1e3 * np.array(newton)


def put_forces(figure, place, rate):
    seconds, millinewton = forces()
    axes = figure.add_axes(place)
    axes.plot(seconds, millinewton, color="#c8102e")
    axes.set_xlabel("s")
    axes.set_ylabel("force on the tool, mN")
    axes.set_title(f"{len(seconds)} steps, at most {rate:,.0f} Hz")
    axes.spines[["top", "right"]].set_visible(False)


def views_of(instants, tip, size):
    """Returns a view for each instant (s), all with the same position, scale and colours, and the largest displacement
    (mm)."""
    import matplotlib
    from views import View, actor_of, paint
    halves = [displaced_half(round(seconds * PARENT_RATE), tip) for seconds in instants]
    largest = max(sizes.max() for _, sizes in halves)
    reached = np.concatenate([arrays_of(half)[0] for half, _ in halves])
    views = []
    for half, sizes in halves:
        paint(half, (255 * matplotlib.colormaps["viridis"](sizes / largest)[:, :3]).astype(np.uint8))
        views.append(View([actor_of(half, 0.5)], (0, 1, 0), size, also=reached))
    return views, largest


def draw(tip, rate):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    from PIL import Image
    from views import put, save_image
    size = (400, 380)
    views, largest = views_of(SHOWN, tip, size)
    pictures = len(views) * (size[0] + GAP)
    width = pictures + size[0] + 80
    figure = plt.figure(figsize=(width / 100, (size[1] + 60) / 100), dpi=100)
    for i, (view, seconds) in enumerate(zip(views, SHOWN)):
        axes = put(figure, view, i * (size[0] + GAP), 10)
        axes.text(size[0] / 2, size[1] + 8, f"{seconds:g} s", ha="center", va="bottom", fontsize=13, clip_on=False)
    scale = plt.cm.ScalarMappable(plt.Normalize(0, largest), "viridis")
    bar = figure.add_axes((pictures / width, 0.2, 10 / width, 0.6))
    figure.colorbar(scale, cax=bar, label="displacement, mm")
    put_forces(figure, ((pictures + 150) / width, 0.2, 300 / width, 0.6), rate)
    figure.canvas.draw()
    save_image(Image.fromarray(np.asarray(figure.canvas.buffer_rgba())), "multirate.png")


def animate(tip):
    """Draws the animation: a frame for every other exchange, with the tip of the tool in red."""
    from matplotlib.font_manager import findfont
    from PIL import Image, ImageDraw, ImageFont
    font = ImageFont.truetype(findfont("DejaVu Sans"), 15)
    instants = np.arange(0, round(SECONDS[-1] * PARENT_RATE) + 1, EVERY) / PARENT_RATE
    newton = np.interp(instants, *forces())
    images = []
    for view, seconds, force in zip(views_of(instants, tip, (300, 284))[0], instants, newton):
        image = view.image.convert("RGB")
        x, y = view.pixels(tip + np.interp(seconds, SECONDS, REACHES) * MOTION)[0]
        pen = ImageDraw.Draw(image)
        pen.ellipse((x - 5, image.height - y - 5, x + 5, image.height - y + 5), fill="#c8102e", outline="white")
        pen.text((8, 6), f"{seconds:.2f} s   {force:.0f} mN", fill="#22262e", font=font)
        images.append(image)
    palette = Image.fromarray(np.vstack(images)).quantize(64, Image.Quantize.MAXCOVERAGE)
    images = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
    images[0].save("multirate.gif", save_all=True, append_images=images[1:], duration=1000 * EVERY // PARENT_RATE, loop=0)


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
    animate(tip)


if __name__ == "__main__":
    main()
