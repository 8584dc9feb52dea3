#!/usr/bin/python3
"""Draws the example's pictures. usage: pictures.py FOLDER

Reads scale.nrrd, prepared.nrrd, surface.vtp, mesh.vtu and the three stages' reports in FOLDER and writes surface.png,
tetrahedra.png, scale.png, evolution.png and histograms.png beside them. Cuts are made at the first target, or where
the first path ends. Needs a display: on a machine without one, run it by xvfb-run.
"""
import json
import os
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import vtk
from matplotlib.collections import LineCollection
from PIL import Image
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from meshfiles import cell_array, interpolated, read_dataset, read_nrrd

DPI = 100
SUPERSAMPLING = 2
INK = "#22262e"
CHILD_COLOR = (0.89, 0.34, 0.26)
BAR_COLOR, IDEAL_COLOR = "#4c78a8", "#d1495b"


# ---- colours

def from_oklch(lightness, chroma, hue):
    """sRGB in 0..1 of OKLCh colours (B. Ottosson, 2020); hue in turns."""
    a, b = chroma * np.cos(2 * np.pi * hue), chroma * np.sin(2 * np.pi * hue)
    lms = np.stack([lightness + 0.3963377774 * a + 0.2158037573 * b,
                    lightness - 0.1055613458 * a - 0.0638541728 * b,
                    lightness - 0.0894841775 * a - 1.2914855480 * b], axis=-1) ** 3
    linear = np.clip(lms @ np.transpose([[4.0767416621, -3.3077115913, 0.2309699292],
                                         [-1.2684380046, 2.6097574011, -0.3413193965],
                                         [-0.0041960863, -0.7034186147, 1.7076147010]]), 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def tissue_colors(dataset):
    """(labels + 1, 3) bytes by label: the file's own colours, or hues of even lightness if it has none."""
    fields = dataset.GetFieldData()
    ids, colors = vtk_to_numpy(fields.GetArray("TissueIds")), vtk_to_numpy(fields.GetArray("TissueColors"))
    if len(ids) > 1 and np.all(colors == colors[0]):
        n = np.arange(len(ids))
        colors = from_oklch(np.array([0.66, 0.77, 0.86])[n % 3], 0.105, 0.618034 * n % 1)
    elif colors.max() > 1:
        colors = colors / 255
    table = np.full((ids.max() + 1, 3), 200, np.uint8)
    table[ids] = np.rint(255 * colors)
    return table


# ---- views of meshes

def paint(dataset, colors):
    dataset.GetCellData().SetScalars(numpy_to_vtk(np.ascontiguousarray(colors), deep=True))


def extracted(dataset, keep):
    """The cells where `keep` is true, whole."""
    ids = vtk.vtkIdList()
    for cell in np.flatnonzero(keep):
        ids.InsertNextId(int(cell))
    extract = vtk.vtkExtractCells()
    extract.SetInputData(dataset)
    extract.SetCellList(ids)
    extract.Update()
    return extract.GetOutput()


def cell_centers(dataset):
    centers = vtk.vtkCellCenters()
    centers.SetInputData(dataset)
    centers.VertexCellsOff()
    centers.Update()
    return vtk_to_numpy(centers.GetOutput().GetPoints().GetData())


def actor_of(dataset, edge_width=0.0, color=None):
    surface = vtk.vtkDataSetSurfaceFilter()
    surface.SetInputData(dataset)
    surface.Update()
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(surface.GetOutput())
    mapper.SetScalarVisibility(color is None)
    mapper.SetColorModeToDirectScalars()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetInterpolationToFlat()
    look.SetAmbient(0.35)
    look.SetDiffuse(0.7)
    if color:
        look.SetColor(color)
    if edge_width:
        look.EdgeVisibilityOn()
        look.SetEdgeColor(0.2, 0.22, 0.26)
        look.SetLineWidth(edge_width * SUPERSAMPLING)
    return actor


def lines_of(dataset, width):
    actor = actor_of(dataset, color=(0.13, 0.15, 0.18))
    actor.GetProperty().SetLineWidth(width * SUPERSAMPLING)
    actor.GetProperty().LightingOff()
    return actor


def marker(position, radius):
    sphere = vtk.vtkSphereSource()
    sphere.SetCenter(position)
    sphere.SetRadius(radius)
    sphere.SetThetaResolution(32)
    sphere.SetPhiResolution(32)
    sphere.Update()
    return actor_of(sphere.GetOutput(), color=CHILD_COLOR)


def place_camera(renderer, direction, size):
    """Looks along `direction`, cranial side up, in parallel, so that all actors just fit."""
    right = np.cross(direction, (0, 0, 1))
    right /= np.linalg.norm(right)
    frame = np.stack([right, np.cross(right, direction), direction])
    corners = np.concatenate([vtk_to_numpy(actor.GetMapper().GetInput().GetPoints().GetData())
                              for actor in renderer.GetActors()]) @ frame.T
    low, high = corners.min(axis=0), corners.max(axis=0)
    margin = 12
    mm_per_pixel = max((high - low)[:2] / (np.array(size) - 2 * margin))
    focus = (low + high) / 2 @ frame
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(focus)
    camera.SetPosition(focus - 1000 * direction)
    camera.SetViewUp(frame[1])
    camera.SetParallelScale(mm_per_pixel * size[1] / 2)
    renderer.ResetCameraClippingRange()


def rendered(actors, direction, size):
    """The actors seen along `direction`, as an image of size (width, height)."""
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for actor in actors:
        renderer.AddActor(actor)
    place_camera(renderer, unit(direction), size)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize([SUPERSAMPLING * n for n in size])
    window.AddRenderer(renderer)
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    width, height, _ = grab.GetOutput().GetDimensions()
    pixels = vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars()).reshape(height, width, 3)[::-1]
    return Image.fromarray(pixels).resize(size, Image.BOX)


def unit(vector):
    return np.asarray(vector, float) / np.linalg.norm(vector)


# ---- figures

def new_figure(width, height):
    return plt.figure(figsize=(width / DPI, height / DPI), dpi=DPI)


def save(figure, file):
    """As a PNG of 256 colours, which is enough here and a fraction of the size."""
    figure.canvas.draw()
    image = Image.fromarray(np.asarray(figure.canvas.buffer_rgba())[..., :3])
    image.quantize(256, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE).save(file, optimize=True)
    plt.close(figure)


def headline(figure, x, title, remark):
    """Title and remark below it, from `x` pixels on, at the top of a figure."""
    width, height = figure.get_size_inches() * DPI
    figure.text(x / width, 1 - 42 / height, title, fontsize=18, color=INK)
    figure.text(x / width, 1 - 70 / height, remark, fontsize=13, color="#5a6170")


def cut_open(target):
    """Implicit function, negative in the part that is taken away: anterior of the target and left of it."""
    quarter = vtk.vtkImplicitBoolean()
    quarter.SetOperationTypeToIntersection()
    for normal in ((0, 1, 0), (-1, 0, 0)):
        plane = vtk.vtkPlane()
        plane.SetOrigin(target)
        plane.SetNormal(normal)
        quarter.AddFunction(plane)
    return quarter


def seen_labels(surface, direction):
    """Per triangle the tissue that one looks through at it; where that is the outside, the tissue behind it."""
    labels = cell_array(surface, "BoundaryLabels")
    corners = vtk_to_numpy(surface.GetPoints().GetData())[
        vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    towards_us = (normals @ direction < 0).astype(int)
    near, far = labels[np.arange(len(labels)), towards_us], labels[np.arange(len(labels)), 1 - towards_us]
    return np.where(near != 0, near, far)


def draw_surface(folder, target):
    surface = read_dataset(os.path.join(folder, "surface.vtp"))
    view = unit((-0.75, 1, -0.42))
    paint(surface, tissue_colors(surface)[seen_labels(surface, view)])
    clip = vtk.vtkClipPolyData()
    clip.SetInputData(surface)
    clip.SetClipFunction(cut_open(target))
    clip.Update()
    rim = vtk.vtkCutter()
    rim.SetInputData(surface)
    rim.SetCutFunction(cut_open(target))
    rim.Update()
    actors = [actor_of(clip.GetOutput(), edge_width=0.5), lines_of(rim.GetOutput(), 1.4), marker(target, 2)]
    figure = new_figure(1200, 1000)
    figure.figimage(rendered(actors, view, (1160, 880)), 20, 15)
    labels = cell_array(surface, "BoundaryLabels")
    headline(figure, 30, f"The surface: {len(labels):,} triangles bound {len(np.setdiff1d(labels, [0]))} tissues",
             "a quarter cut away at the target (red); walls in the colour of the tissue that one looks into")
    save(figure, os.path.join(folder, "surface.png"))


def draw_tetrahedra(folder, target):
    mesh = read_dataset(os.path.join(folder, "mesh.vtu"))
    child = cell_array(mesh, "SubMesh") > 0
    behind = cell_centers(mesh)[:, 1] > target[1]
    paint(mesh, tissue_colors(mesh)[cell_array(mesh, "TissueLabel")])
    view = (-0.25, 1, -0.2)
    whole = [actor_of(extracted(mesh, behind & ~child), edge_width=0.5),
             actor_of(extracted(mesh, behind & child), edge_width=0.25, color=CHILD_COLOR)]
    apart = [actor_of(extracted(mesh, behind & child), edge_width=0.7)]
    figure = new_figure(1500, 900)
    figure.figimage(rendered(whole, view, (920, 790)), 10, 10)
    figure.figimage(rendered(apart, view, (520, 520)), 960, 145)
    headline(figure, 30, f"The mesh: {len(child):,} tetrahedra",
             "behind a coronal plane through the target, coloured by tissue; the child mesh in red")
    headline(figure, 960, f"The child mesh: {child.sum():,} of them", "same cut, enlarged")
    save(figure, os.path.join(folder, "tetrahedra.png"))


def draw_slice(axes, labels, affine, lengths_at, target, paths, normal):
    """Target edge lengths and tissue boundaries on the voxel layer through the target, across grid axis `normal`."""
    at = int(np.rint(np.linalg.solve(affine, [*target, 1])[normal]))
    layer = np.take(labels, min(max(at, 0), labels.shape[normal] - 1), axis=normal)
    u, v = [axis for axis in range(3) if axis != normal]
    index = np.zeros(layer.shape + (4,))
    index[..., u], index[..., v] = np.indices(layer.shape)
    index[..., normal], index[..., 3] = at, 1
    world = (index @ affine.T)[..., :3]
    lengths = lengths_at(world)
    x, y = world[..., u], world[..., v]
    shown = axes.pcolormesh(x, y, lengths, cmap="viridis", shading="gouraud", rasterized=True)
    borders = []
    for axis, other in ((0, 1), (1, 0)):
        ahead, across = (np.array([(affine[u, g], affine[v, g]) for g in (u, v)])[a] / 2 for a in (axis, other))
        differs = np.diff(layer.astype(int), axis=axis) != 0
        middles = np.stack([x, y], axis=-1)[:differs.shape[0], :differs.shape[1]][differs] + ahead
        borders.append(np.stack([middles - across, middles + across], axis=1))
    axes.add_collection(LineCollection(np.concatenate(borders), colors="white", linewidths=0.5, alpha=0.8))
    levels = np.arange(np.floor(lengths.min()) + 1, np.ceil(lengths.max()))
    if len(levels):
        contours = axes.contour(x, y, lengths, levels=levels, colors=INK, linewidths=1.1)
        axes.clabel(contours, levels=levels[len(levels) // 2:], fmt="%g mm", fontsize=9)  # nearer in they would overlap
    for path in paths:
        axes.plot(path[:, u], path[:, v], color=CHILD_COLOR, linewidth=2)
    axes.plot(target[u], target[v], "+", color=CHILD_COLOR, markersize=15, markeredgewidth=2.5)
    axes.set(aspect="equal", xlim=(x.min(), x.max()), ylim=(y.min(), y.max()))
    axes.set_xlabel("LPS"[u] + " (mm)")
    axes.set_ylabel("LPS"[v] + " (mm)")
    return shown


def draw_scale(folder, target, paths):
    scale, scale_affine = read_nrrd(os.path.join(folder, "scale.nrrd"))
    labels, affine = read_nrrd(os.path.join(folder, "prepared.nrrd"))
    figure = new_figure(1500, 830)
    axial = figure.add_axes((0.05, 0.08, 0.37, 0.80))
    sagittal = figure.add_axes((0.47, 0.08, 0.43, 0.80))
    for axes, normal in ((axial, 2), (sagittal, 0)):
        shown = draw_slice(axes, labels, affine, lambda at: interpolated(scale, scale_affine, at), target,
                           paths, normal)
    axial.invert_yaxis()
    figure.colorbar(shown, cax=figure.add_axes((0.925, 0.15, 0.013, 0.66)), label="target edge length (mm)")
    around = "the target (+) and along the path" if paths else "the target (+)"
    headline(figure, 30, f"The scale: target edge length around {around}",
             "axial slice, anterior at the top; sagittal slice, anterior to the left; tissue boundaries in white")
    save(figure, os.path.join(folder, "scale.png"))


def draw_histograms(folder):
    """The three histograms of Audette et al. 2007, figure 10, from the mesh's report."""
    with open(os.path.join(folder, "mesh.json"), encoding="utf-8") as file:
        quality = json.load(file)["quality"]
    whole, histograms = quality["whole"], quality["histograms"]
    angles, valence = whole["dihedral"], whole["valence"]
    panels = [
        ("dihedral", "Dihedral angle (degrees)", (60, 90),
         f"{angles['minimum']:.1f} to {angles['maximum']:.1f} degrees"),
        ("edgeOverTarget", "Edge length over target", (1,),
         f"{100 * whole['edgesNearTarget']:.1f} % within 0.7 to 1.4"),
        ("valence", "Tetrahedra at a vertex inside a tissue", (24,), f"median {valence['median']:.0f}"),
    ]
    figure = new_figure(1500, 560)
    for n, (name, title, ideals, note) in enumerate(panels):
        axes = figure.add_axes((0.05 + 0.325 * n, 0.12, 0.28, 0.63))
        counts, low, high = (histograms[name][key] for key in ("counts", "low", "high"))
        if name == "valence":  # always even: two per bar, centred on the even number
            counts, low, high = np.reshape(counts, (-1, 2)).sum(axis=1), low - 1, high - 1
        edges = np.linspace(low, high, len(counts) + 1)
        axes.bar(edges[:-1], 100 * np.array(counts) / sum(counts), np.diff(edges), align="edge", color=BAR_COLOR,
                 edgecolor="white", linewidth=0.4)
        for ideal in ideals:
            axes.axvline(ideal, color=IDEAL_COLOR, linestyle="--", linewidth=1.3)
        axes.set_title(note, fontsize=13, color=INK)
        axes.set_xlabel(title, fontsize=12)
        axes.set_ylabel("share (%)", fontsize=11)
        axes.spines[["top", "right"]].set_visible(False)
    headline(figure, 30, f"The quality of {whole['tetrahedra']:,} tetrahedra",
             "dashed: the canonical tetrahedron, with which space can be filled (edges: the target)")
    save(figure, os.path.join(folder, "histograms.png"))


def draw_evolution(folder):
    """Size, distance to the map and operations of the surface stage, step by step, from its report."""
    with open(os.path.join(folder, "surface.json"), encoding="utf-8") as file:
        report = json.load(file)
    steps = report["evolution"]
    number = np.arange(len(steps))
    figure = new_figure(1500, 560)
    panels = [figure.add_axes((0.05 + 0.325 * n, 0.12, 0.28, 0.63)) for n in range(3)]
    size, distance, operations = panels
    size.bar(number, [step["faces"] / 1000 for step in steps], color=BAR_COLOR, edgecolor="white", linewidth=0.4)
    size.set_ylabel("faces between tissues (thousands)", fontsize=11)
    distance.plot(number, [step["maximumDistance"] for step in steps], color=IDEAL_COLOR, marker="o", label="maximum")
    distance.plot(number, [step["meanDistance"] for step in steps], color=BAR_COLOR, marker="o", label="mean")
    distance.set_ylabel("distance to the boundary (mm)", fontsize=11)
    distance.set_ylim(bottom=0)
    for name, kind, color in (("T1: collapses", "collapses", BAR_COLOR), ("T2: splits", "splits", INK),
                              ("T7: flips", "flips", IDEAL_COLOR), ("relabels", "relabels", "#54a24b")):
        counts = np.array([step[kind] for step in steps], float)
        operations.plot(number, np.where(counts > 0, counts, np.nan), color=color, marker="o", label=name)
    operations.set_yscale("log")
    operations.set_ylabel("operations in the step", fontsize=11)
    for axes, title in zip(panels, ("Size", "Fidelity", "Operations")):
        axes.set_title(title, fontsize=13, color=INK)
        axes.set_xlabel("step", fontsize=12)
        axes.xaxis.get_major_locator().set_params(integer=True)
        axes.spines[["top", "right"]].set_visible(False)
    for axes in (distance, operations):
        axes.legend(frameon=False)
    first = next((n for n, step in enumerate(steps) if step["stage"] == "improvement"), len(steps))
    headline(figure, 30, f"The evolution of the surface: {report['triangles']:,} triangles in the end",
             f"steps 1 to {first - 1} coarsen, the others improve")
    save(figure, os.path.join(folder, "evolution.png"))


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: pictures.py FOLDER")
    folder = sys.argv[1]
    with open(os.path.join(folder, "scale.json"), encoding="utf-8") as file:
        focus = json.load(file)
    paths = [np.array(path["points"], float) for path in focus["paths"]]
    target = np.array(focus["targets"][0] if focus["targets"] else paths[0][-1], float)
    draw_scale(folder, target, paths)
    draw_evolution(folder)
    draw_histograms(folder)
    draw_surface(folder, target)
    draw_tetrahedra(folder, target)


if __name__ == "__main__":
    main()
