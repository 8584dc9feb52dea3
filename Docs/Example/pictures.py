#!/usr/bin/python3
"""Draws the example's pictures. usage: pictures.py FOLDER X Y Z

Reads scale.nrrd, prepared.nrrd, surface.vtp, mesh.vtu and mesh.json in FOLDER and writes surface.png, tetrahedra.png,
scale.png and histograms.png beside them. X Y Z is the target (LPS, mm). Needs a display: on a machine without one, run
it by xvfb-run.
"""
import colorsys
import json
import os
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from meshfiles import cell_array, interpolated, read_dataset, read_nrrd

SIZE = (1400, 1050)
HEADER = 120  # pixels kept for the title
CHILD_COLOR = (0.91, 0.33, 0.24)


def tissue_colors(dataset):
    """(labels + 1, 3) bytes by label: the file's own colours, or well-spread hues if it has none."""
    fields = dataset.GetFieldData()
    ids, colors = vtk_to_numpy(fields.GetArray("TissueIds")), vtk_to_numpy(fields.GetArray("TissueColors"))
    if len(ids) > 1 and np.all(colors == colors[0]):
        golden = 0.618034
        colors = np.array([colorsys.hls_to_rgb(golden * n % 1, 0.45 + 0.12 * (n % 3), 0.6) for n in ids])
    elif colors.max() > 1:
        colors = colors / 255
    table = np.full((ids.max() + 1, 3), 200, np.uint8)
    table[ids] = np.rint(255 * colors)
    return table


def paint(dataset, colors):
    array = numpy_to_vtk(np.ascontiguousarray(colors), deep=True)
    dataset.GetCellData().SetScalars(array)


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


def actor_of(dataset, edges=False, color=None):
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
    look.SetAmbient(0.3)
    look.SetDiffuse(0.75)
    if color:
        look.SetColor(color)
    if edges:
        look.EdgeVisibilityOn()
        look.SetEdgeColor(0.15, 0.15, 0.15)
        look.SetLineWidth(1)
    return actor


def marker(position, radius):
    sphere = vtk.vtkSphereSource()
    sphere.SetCenter(position)
    sphere.SetRadius(radius)
    sphere.SetThetaResolution(32)
    sphere.SetPhiResolution(32)
    sphere.Update()
    return actor_of(sphere.GetOutput(), color=(0.1, 0.1, 0.1))


def caption(text, x, y, size):
    actor = vtk.vtkTextActor()
    actor.SetInput(text)
    style = actor.GetTextProperty()
    style.SetFontSize(size)
    style.SetColor(0.1, 0.1, 0.1)
    actor.SetPosition(x, y)
    return actor


def camera_view(renderer, direction, width, height, header):
    """Looks along `direction`, cranial side up, in parallel; all actors fit below `header` pixels at the top."""
    direction = np.asarray(direction, float) / np.linalg.norm(direction)
    right = np.cross(direction, (0, 0, 1))
    right /= np.linalg.norm(right)
    up = np.cross(right, direction)
    corners = []
    for actor in renderer.GetActors():
        points = vtk_to_numpy(actor.GetMapper().GetInput().GetPoints().GetData())
        corners.append(points @ np.stack([right, up, direction]).T)
    corners = np.concatenate(corners)
    low, high = corners.min(axis=0), corners.max(axis=0)
    margin = 30
    mm_per_pixel = max((high - low)[:2] / (width - 2 * margin, height - header - 2 * margin))
    middle = (low + high) / 2
    middle[1] += header / 2 * mm_per_pixel
    focus = middle @ np.stack([right, up, direction])
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(focus)
    camera.SetPosition(focus - 1000 * direction)
    camera.SetViewUp(up)
    camera.SetParallelScale(mm_per_pixel * height / 2)
    renderer.ResetCameraClippingRange()


def save(renderers, file):
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(SIZE)
    for renderer in renderers:
        renderer.SetBackground(1, 1, 1)
        window.AddRenderer(renderer)
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(file)
    writer.SetInputConnection(grab.GetOutputPort())
    writer.Write()


def in_front(points, target):
    """Which points lie in the part that the cuts take away: anterior of the target and left of it."""
    offset = points - target
    return (offset[:, 1] < 0) & (offset[:, 0] > 0)


def draw_surface(folder, target):
    surface = read_dataset(os.path.join(folder, "surface.vtp"))
    labels = cell_array(surface, "BoundaryLabels")
    colors = tissue_colors(surface)
    shown = np.where(labels[:, 0] != 0, labels[:, 0], labels[:, 1])
    paint(surface, colors[shown])
    kept = extracted(surface, ~in_front(cell_centers(surface), target))
    renderer = vtk.vtkRenderer()
    renderer.AddActor(actor_of(kept, edges=True))
    renderer.AddActor(marker(target, 1.5))
    camera_view(renderer, (-0.75, 1, -0.45), *SIZE, HEADER)
    tissues = len(np.setdiff1d(labels, [0]))
    renderer.AddActor2D(caption(f"Surface: {tissues} tissues, {len(labels):,} triangles", 30, SIZE[1] - 55, 32))
    renderer.AddActor2D(caption("cut open at the target (black)", 30, SIZE[1] - 95, 24))
    save([renderer], os.path.join(folder, "surface.png"))


def draw_tetrahedra(folder, target):
    mesh = read_dataset(os.path.join(folder, "mesh.vtu"))
    child = cell_array(mesh, "SubMesh") > 0
    behind = cell_centers(mesh)[:, 1] > target[1]
    paint(mesh, tissue_colors(mesh)[cell_array(mesh, "TissueLabel")])

    share = 0.64  # of the width, for the whole mesh
    view = (-0.25, 1, -0.2)
    whole = vtk.vtkRenderer()
    whole.SetViewport(0, 0, share, 1)
    whole.AddActor(actor_of(extracted(mesh, behind & ~child), edges=True))
    whole.AddActor(actor_of(extracted(mesh, behind & child), edges=True, color=CHILD_COLOR))
    camera_view(whole, view, share * SIZE[0], SIZE[1], HEADER)
    title = f"Tetrahedra behind a plane through the target\n{len(child):,} in all"
    whole.AddActor2D(caption(title, 30, SIZE[1] - 95, 28))

    apart = vtk.vtkRenderer()
    apart.SetViewport(share, 0, 1, 1)
    apart.AddActor(actor_of(extracted(mesh, behind & child), edges=True, color=CHILD_COLOR))
    camera_view(apart, view, (1 - share) * SIZE[0], SIZE[1], HEADER)
    apart.AddActor2D(caption(f"Child mesh, same cut, enlarged\n{child.sum():,} tetrahedra", 20, SIZE[1] - 95, 28))
    save([whole, apart], os.path.join(folder, "tetrahedra.png"))


def draw_scale(folder, target):
    scale, scale_affine = read_nrrd(os.path.join(folder, "scale.nrrd"))
    labels, affine = read_nrrd(os.path.join(folder, "prepared.nrrd"))
    slice_at = int(np.rint(np.linalg.solve(affine, [*target, 1])[2]))
    slice_at = min(max(slice_at, 0), labels.shape[2] - 1)
    i, j = np.meshgrid(np.arange(labels.shape[0]), np.arange(labels.shape[1]), indexing="ij")
    voxels = np.stack([i, j, np.full_like(i, slice_at), np.ones_like(i)], axis=-1)
    world = voxels @ affine.T
    lengths = interpolated(scale, scale_affine, world[..., :3])

    figure, axes = plt.subplots(figsize=(11, 11.5), dpi=100)
    shown = axes.pcolormesh(world[..., 0], world[..., 1], lengths, cmap="viridis", shading="nearest")
    here = labels[:, :, slice_at]
    edge_i, edge_j = here[1:, :] != here[:-1, :], here[:, 1:] != here[:, :-1]
    step_i, step_j = affine[:2, 0] / 2, affine[:2, 1] / 2
    lines = []
    for border, step, across in ((edge_i, step_i, step_j), (edge_j, step_j, step_i)):
        at = world[:border.shape[0], :border.shape[1], :2][border] + step
        lines.append(np.stack([at - across, at + across], axis=1))
    axes.add_collection(matplotlib.collections.LineCollection(np.concatenate(lines), colors="white", linewidths=0.6))
    axes.plot(*target[:2], "+", color="red", markersize=16, markeredgewidth=2.5, label="target")
    axes.set_aspect("equal")
    axes.invert_yaxis()
    axes.set_xlabel("L (mm), patient's left to the right")
    axes.set_ylabel("P (mm), anterior at the top")
    axes.set_title(f"Target edge length and tissue boundaries, slice S = {world[0, 0, 2]:.0f} mm", fontsize=16, pad=14)
    axes.legend(loc="upper right", fontsize=13)
    figure.colorbar(shown, ax=axes, label="target edge length (mm)", shrink=0.8)
    figure.tight_layout()
    figure.savefig(os.path.join(folder, "scale.png"))
    plt.close(figure)


def draw_histograms(folder):
    """The three histograms of Audette et al. 2007, figure 10, from the mesh's report."""
    with open(os.path.join(folder, "mesh.json"), encoding="utf-8") as file:
        quality = json.load(file)["quality"]
    whole, histograms = quality["whole"], quality["histograms"]
    angles, valence = whole["dihedral"], whole["valence"]
    panels = [
        ("dihedral", "Dihedral angles", "degrees", (60, 90), f"{angles['minimum']:.1f} to {angles['maximum']:.1f}"),
        ("edgeOverTarget", "Edge length over target", "ratio", (1,),
         f"{100 * whole['edgesNearTarget']:.1f} % within 0.7 to 1.4"),
        ("valence", "Tetrahedra per vertex", "tetrahedra at a vertex inside a tissue", (24,),
         f"median {valence['median']:.0f}"),
    ]
    figure, columns = plt.subplots(1, 3, figsize=(18, 6), dpi=100)
    for axes, (name, title, unit, ideals, note) in zip(columns, panels):
        counts = histograms[name]["counts"]
        edges = np.linspace(histograms[name]["low"], histograms[name]["high"], len(counts) + 1)
        axes.bar(edges[:-1], counts, np.diff(edges), align="edge", color="#4c78a8", edgecolor="white", linewidth=0.4)
        for ideal in ideals:
            line = axes.axvline(ideal, color="#e45756", linestyle="--", linewidth=1.5)
        line.set_label("canonical tetrahedron")
        axes.set_title(f"{title}\n{note}", fontsize=15)
        axes.set_xlabel(unit, fontsize=13)
        axes.set_ylabel("count", fontsize=13)
        axes.legend(loc="upper right", fontsize=11)
    figure.suptitle(f"Quality of {whole['tetrahedra']:,} tetrahedra", fontsize=18)
    figure.tight_layout()
    figure.savefig(os.path.join(folder, "histograms.png"))
    plt.close(figure)


def main():
    if len(sys.argv) != 5:
        sys.exit("usage: pictures.py FOLDER X Y Z")
    folder, target = sys.argv[1], np.array(sys.argv[2:], float)
    draw_scale(folder, target)
    draw_histograms(folder)
    draw_surface(folder, target)
    draw_tetrahedra(folder, target)


if __name__ == "__main__":
    main()
