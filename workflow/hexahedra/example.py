#!/usr/bin/python3
"""Fits the project's template of a face to a person and solves an operation on it. usage: example.py OUTDIR

The template, TemplateHexMesher/Template, is fitted to a second person, whose surface and landmarks are built in code
(face_shape.py). CalculiX then moves the bone of the lower jaw 6 mm to the front and holds that of the upper jaw. Writes
to OUTDIR fitted.vtu, fit.json, face.inp (the exported model), operation.inp (the deck), operation.dat (displacements)
and operation.png. TemplateFitCLI and ccx have to be on the PATH; the picture needs a display: run it by
../example/display.py.
"""
import json
import os
import subprocess
import sys

import numpy as np

import face_shape

HERE = os.path.dirname(os.path.abspath(__file__))
TEMPLATE = os.path.join(HERE, "..", "..", "TemplateHexMesher", "Template")
sys.path.insert(0, os.path.join(HERE, "..", "example"))
from meshfiles import cell_array, read_dataset  # noqa: E402

ADVANCE = 6  # mm, to the front
GAP = 4      # mm above and below the corners of the mouth: between these heights no node is on bone
MATERIALS = """tissue, model, youngsModulus, poissonsRatio
filler, linear, 3, 0.45
orbicularis_oris, linear, 6.2, 0.45
right_masseter, linear, 6.2, 0.45
left_masseter, linear, 6.2, 0.45
right_zygomaticus, linear, 6.2, 0.45
left_zygomaticus, linear, 6.2, 0.45
"""
DECK = """*INCLUDE, INPUT=face.inp
*NSET, NSET=lower_jaw
{lower}
*NSET, NSET=upper_jaw
{upper}
*STEP
*STATIC
*BOUNDARY
upper_jaw, 1, 3
lower_jaw, 1, 1
lower_jaw, 2, 2, {advance}
lower_jaw, 3, 3
*NODE PRINT, NSET=all_nodes
U
*END STEP
"""


def fit():
    """Writes the second person's surface and landmarks, the fitted mesh and its model to the working folder. Returns
    the landmarks of the second person by name."""
    points, triangles, _ = face_shape.envelope()
    face_shape.write_surface("person.vtp", face_shape.second_person(points), triangles)
    landmarks = {name: face_shape.second_person(point) for name, point in face_shape.landmarks().items()}
    face_shape.write_landmarks("person.fcsv", landmarks)
    with open("materials.csv", "w", encoding="ascii") as table:
        table.write(MATERIALS)
    subprocess.run(["TemplateFitCLI", "--landmarks", os.path.join(TEMPLATE, "face.landmarks.fcsv"), "--landmarks",
                    "person.fcsv", "--materials", "materials.csv", "--export", "face.inp", "--report", "fit.json",
                    os.path.join(TEMPLATE, "face.vtu"), "person.vtp", "fitted.vtu"], check=True,
                   stdout=subprocess.DEVNULL)
    return landmarks


def points_and_inner(grid):
    from vtk.util.numpy_support import vtk_to_numpy
    points = vtk_to_numpy(grid.GetPoints().GetData()).astype(float)
    return points, vtk_to_numpy(grid.GetPointData().GetArray("inner")) != 0


def solve(landmarks):
    """Solves the operation by CalculiX and returns the displacements (n, 3) of the nodes in mm."""
    points, inner = points_and_inner(read_dataset("fitted.vtu"))
    mouth = (landmarks["mouth_left_deep"] + landmarks["mouth_right_deep"])[2] / 2
    lines = lambda ids: "\n".join("%d," % (i + 1) for i in ids)  # noqa: E731
    with open("operation.inp", "w", encoding="ascii") as deck:
        deck.write(DECK.format(lower=lines(np.flatnonzero(inner & (points[:, 2] < mouth - GAP))),
                               upper=lines(np.flatnonzero(inner & (points[:, 2] > mouth + GAP))), advance=-ADVANCE))
    run = subprocess.run(["ccx", "operation"], stdout=subprocess.PIPE, text=True, check=False)
    if run.returncode or "*ERROR" in run.stdout:
        sys.exit("example: CalculiX: " + run.stdout[-2000:])
    with open("operation.dat", encoding="ascii") as results:
        rows = [line.split() for line in results]
    displacement = np.array([[float(x) for x in row[1:]] for row in rows if len(row) == 4 and row[0].isdigit()])
    if displacement.shape != points.shape or not np.isfinite(displacement).all():
        sys.exit(f"example: operation.dat has {len(displacement)} displacements, expected {len(points)}")
    return displacement


def tissue_colors(grid):
    """Returns the colours (n, 3) of the cells in bytes: one for the tissue around the muscles, and reds for muscles."""
    labels = cell_array(grid, "TissueLabel")
    reds = np.array([[233, 200, 176], [178, 48, 56], [196, 84, 70], [214, 112, 80], [196, 84, 70], [214, 112, 80]])
    return reds[labels - 1].astype(np.uint8)


def draw(displacement):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import vtk
    from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

    from views import View, actor_of, extracted, paint, put, save_image
    template, fitted = read_dataset(os.path.join(TEMPLATE, "face.vtu")), read_dataset("fitted.vtu")
    muscles = extracted(fitted, cell_array(fitted, "TissueLabel") > 1)
    for grid in (template, fitted, muscles):
        paint(grid, tissue_colors(grid))
    after = vtk.vtkUnstructuredGrid()
    after.DeepCopy(fitted)
    moved = vtk_to_numpy(fitted.GetPoints().GetData()) + displacement
    after.GetPoints().SetData(numpy_to_vtk(moved, deep=True))
    shown = np.linalg.norm(displacement, axis=1)
    cells = vtk_to_numpy(after.GetCells().GetConnectivityArray()).reshape(-1, 8)
    colors = plt.get_cmap("viridis")(shown[cells].mean(axis=1) / ADVANCE)[:, :3]
    paint(after, (255 * colors).astype(np.uint8))
    size, front = (420, 430), (0.45, 1, -0.12)
    figure = plt.figure(figsize=(4 * size[0] / 100, (size[1] + 50) / 100), dpi=100)
    panels = (("template", template), ("fitted", fitted), ("its muscles", muscles), ("jaw 6 mm to the front", after))
    for i, (title, grid) in enumerate(panels):
        whole = vtk_to_numpy(fitted.GetPoints().GetData())
        axes = put(figure, View([actor_of(grid, 0.6)], front, size, also=whole), i * size[0], 0)
        axes.text(size[0] / 2, size[1] + 8, title, ha="center", va="bottom", fontsize=15, clip_on=False)
    figure.canvas.draw()
    from PIL import Image
    save_image(Image.fromarray(np.asarray(figure.canvas.buffer_rgba())), "operation.png")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.split("\n\n")[0])
    os.makedirs(sys.argv[1], exist_ok=True)
    os.chdir(sys.argv[1])
    displacement = solve(fit())
    with open("fit.json", encoding="utf-8") as report:
        fitted = json.load(report)
    quality, distance = fitted["quality"]["fitted"]["hexahedra"], fitted["distances"]["fitted"]["fittedToTarget"]
    print(f"{quality['elements']} hexahedra, {quality['invalid']} invalid, {distance['mean']:.2f} mm from the person")
    print(f"largest displacement {np.linalg.norm(displacement, axis=1).max():.2f} mm")
    draw(displacement)


if __name__ == "__main__":
    main()
