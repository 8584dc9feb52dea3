#!/usr/bin/python3
"""Draws the surface experiments. usage: pictures.py FOLDER

Reads what SimplexExperiments left in FOLDER and writes simplex-cube.png, simplex-brain.png, simplex-tubes.png and
simplex-path.png beside it, and table.md. Needs a display: on a machine without one, run it by xvfb-run.
"""
import csv
import os
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

INK = "#22262e"
PANEL = 620
FARTHEST = 3.0  # mm, full red


def read(path):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def triangles_of(surface):
    return vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def half(surface, keep, centres, origin, normal):
    """Those cells to keep whose centres lie on the far side of a plane, if there is one, whole."""
    if origin is not None:
        keep = keep & ((centres - origin) @ np.asarray(normal, float) > 0)
    ids = numpy_to_vtk(np.flatnonzero(keep).astype(np.int64), deep=True, array_type=vtk.VTK_ID_TYPE)
    node, selection, extract = vtk.vtkSelectionNode(), vtk.vtkSelection(), vtk.vtkExtractSelection()
    node.SetFieldType(vtk.vtkSelectionNode.CELL)
    node.SetContentType(vtk.vtkSelectionNode.INDICES)
    node.SetSelectionList(ids)
    selection.AddNode(node)
    extract.SetInputData(0, surface)
    extract.SetInputData(1, selection)
    geometry = vtk.vtkGeometryFilter()
    geometry.SetInputConnection(extract.GetOutputPort())
    geometry.Update()
    return geometry.GetOutput()


def centres_of(surface):
    filter_ = vtk.vtkCellCenters()
    filter_.SetInputData(surface)
    filter_.Update()
    return vtk_to_numpy(filter_.GetOutput().GetPoints().GetData())


def with_distance(simplex, surface):
    """Simplex vertices with the distance of their triangle to the boundary: vertex i belongs to triangle i."""
    distance = vtk_to_numpy(surface.GetPointData().GetArray("BoundaryDistance"))[triangles_of(surface)].mean(axis=1)
    array = numpy_to_vtk(distance, deep=True)
    array.SetName("Distance")
    simplex.GetPointData().SetScalars(array)
    return simplex


def lower_label(pairs):
    """Of the two labels of each triangle, the lower one that is tissue."""
    return np.where(pairs.min(axis=1) > 0, pairs.min(axis=1), pairs.max(axis=1))


def each_once(simplex, surface):
    """Whether each polygon is that of the lower label: on a sheet between two tissues there are two at the same place."""
    label = vtk_to_numpy(simplex.GetCellData().GetArray("TissueLabel"))
    lower = lower_label(vtk_to_numpy(surface.GetCellData().GetArray("BoundaryLabels")))
    cells = simplex.GetPolys()
    vertices, offsets = (vtk_to_numpy(a()) for a in (cells.GetConnectivityArray, cells.GetOffsetsArray))
    return np.array([np.any(lower[vertices[begin:end]] == own)
                     for begin, end, own in zip(offsets[:-1], offsets[1:], label)])


def white_to_red():
    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(64)
    table.SetRange(0, FARTHEST)
    table.Build()
    for i in range(64):
        table.SetTableValue(i, 1, 1 - i / 63, 1 - i / 63, 1)
    return table


def actors_for(surface, by_distance, colors):
    mapper, actor = vtk.vtkPolyDataMapper(), vtk.vtkActor()
    mapper.SetInputData(surface)
    actor.SetMapper(mapper)
    mapper.ScalarVisibilityOff()
    actor.GetProperty().SetAmbient(0.12)
    actor.GetProperty().SetColor(0.36, 0.42, 0.50) if by_distance else actor.GetProperty().SetColor(0.84, 0.84, 0.81)
    if colors is not None:
        label = surface.GetCellData().GetArray("BoundaryLabels") or surface.GetCellData().GetArray("TissueLabel")
        values = vtk_to_numpy(label)
        values = lower_label(values) if values.ndim > 1 else values
        rgb = np.array([colors[int(v)] for v in values], np.uint8)
        surface.GetCellData().SetScalars(numpy_to_vtk(rgb, deep=True))
        mapper.SetScalarModeToUseCellData()
        mapper.ScalarVisibilityOn()
    extract, edges, lines = vtk.vtkExtractEdges(), vtk.vtkPolyDataMapper(), vtk.vtkActor()
    extract.SetInputData(surface)
    edges.SetInputConnection(extract.GetOutputPort())
    edges.SetScalarVisibility(bool(by_distance))
    if by_distance:
        edges.SetScalarModeToUsePointData()
        edges.SetLookupTable(white_to_red())
        edges.UseLookupTableScalarRangeOn()
    edges.SetResolveCoincidentTopologyToPolygonOffset()
    edges.SetRelativeCoincidentTopologyLineOffsetParameters(0, -4)
    lines.SetMapper(edges)
    lines.GetProperty().SetColor(0.13, 0.15, 0.18)
    lines.GetProperty().SetLineWidth(2.4 if by_distance else 1.4)
    return actor, lines


def picture(surface, direction, up, zoom=1.0, focus=None, by_distance=False, colors=None):
    renderer, window = vtk.vtkRenderer(), vtk.vtkRenderWindow()
    renderer.SetBackground(1, 1, 1)
    for actor in actors_for(surface, by_distance, colors):
        renderer.AddActor(actor)
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(2 * PANEL, 2 * PANEL)
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    centre = np.asarray(surface.GetCenter() if focus is None else focus, float)
    camera.SetFocalPoint(*surface.GetCenter())
    camera.SetPosition(*(np.asarray(surface.GetCenter()) - np.asarray(direction, float)))
    camera.SetViewUp(*up)
    renderer.ResetCamera()
    shift = centre - np.asarray(surface.GetCenter())
    camera.SetFocalPoint(*(np.asarray(camera.GetFocalPoint()) + shift))
    camera.SetPosition(*(np.asarray(camera.GetPosition()) + shift))
    camera.Zoom(1.02 * zoom)
    renderer.ResetCameraClippingRange()
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    image = grab.GetOutput()
    width, height, _ = image.GetDimensions()
    pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, 3)[::-1]
    return cropped(pixels.reshape(PANEL, 2, PANEL, 2, 3).mean(axis=(1, 3)).astype(np.uint8))


def cropped(pixels, margin=6):
    rows, columns = np.nonzero((pixels < 250).any(axis=2))
    low, left = max(0, rows.min() - margin), max(0, columns.min() - margin)
    return pixels[low:rows.max() + margin, left:columns.max() + margin]


def sheet(panels, path, columns, curves=None):
    """Panels (title, pixels), and below them, if any, the two curves of figure 6d."""
    rows = -(-len(panels) // columns)
    figure = plt.figure(figsize=(3.1 * columns, 3.65 * rows + (2.6 if curves else 0)), dpi=100)
    grid = figure.add_gridspec(rows + (1 if curves else 0), columns * 2,
                               height_ratios=[3.65] * rows + ([2.3] if curves else []))
    for n, (title, pixels) in enumerate(panels):
        row, column = divmod(n, columns)
        axes = figure.add_subplot(grid[row, 2 * column:2 * column + 2])
        axes.imshow(pixels)
        axes.axis("off")
        axes.set_title(title, fontsize=9, color=INK)
    if curves:
        steps, data = curves
        for axes, key, label in ((figure.add_subplot(grid[rows, :columns]), "faces", "simplex faces"),
                                 (figure.add_subplot(grid[rows, columns:]), "meanDistance", "mean distance (mm)")):
            axes.plot(steps, data[key], color="#4c78a8", marker=".", markersize=4)
            axes.set_xlabel("iteration", fontsize=8, color=INK)
            axes.set_title(label, fontsize=9, color=INK)
            axes.tick_params(labelsize=8)
            axes.grid(alpha=0.3)
            axes.set_ylim(bottom=0)
    figure.tight_layout(pad=0.9, rect=(0, 0, 1, 0.995))
    figure.savefig(path, pil_kwargs={"optimize": True})
    plt.close(figure)
    quantize(path)


def quantize(path):
    from PIL import Image
    Image.open(path).convert("RGB").quantize(160, dither=Image.Dither.NONE).save(path, optimize=True)


def evolution(folder, name):
    with open(os.path.join(folder, name + "-evolution.csv"), encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return [int(row["iteration"]) for row in rows], {key: [float(row[key]) for row in rows] for key in rows[0]}


def panels_of(folder, name, wanted, view, plane=(None, None), colors=None, zoom=1.0, focus=None):
    rows = {}
    with open(os.path.join(folder, "table.csv"), encoding="utf-8") as file:
        for row in csv.DictReader(file):
            rows[row["experiment"], row["surface"]] = row
    panels = []
    for title, key, file in wanted:
        surface = read(os.path.join(folder, f"{name}-{file.replace('-simplex', '')}.vtp"))
        shown, by_distance = surface, file.endswith("-simplex")
        if by_distance:
            shown = with_distance(read(os.path.join(folder, f"{name}-{file}.vtp")), surface)
        keep = each_once(shown, surface) if by_distance else np.ones(surface.GetNumberOfCells(), bool)
        shown = half(shown, keep, centres_of(shown), *plane)
        faces = rows[name, key]["faces"]
        panels.append((f"{title}\n{faces} faces",
                       picture(shown, *view, zoom=zoom, focus=focus, by_distance=by_distance, colors=colors)))
    return panels


def table(folder):
    """The table as Markdown."""
    columns = [("experiment", "experiment"), ("surface", "surface"), ("faces", "faces"), ("outMaximum", "to boundary, max"),
               ("backMean", "from boundary, mean"), ("backMaximum", "max"), ("childMaximum", "max near target"),
               ("angleMinimum", "smallest angle"), ("anglePercentile1", "1 %"), ("edgesNearTarget", "edges near L"),
               ("wrongTissues", "wrong tissues"), ("crossings", "crossings"), ("volumeError", "volume error"),
               ("seconds", "s")]
    with open(os.path.join(folder, "table.csv"), encoding="utf-8") as file:
        rows = list(csv.DictReader(file))

    def text(key, row):
        value = row[key]
        if key in ("experiment", "surface", "faces", "wrongTissues", "crossings"):
            return value
        if key in ("edgesNearTarget", "volumeError"):
            return f"{100 * float(value):.1f} %"
        return f"{float(value):.1f}" if key.startswith(("angle", "seconds")) else f"{float(value):.2f}"

    lines = ["| " + " | ".join(title for _, title in columns) + " |", "|" + "---|" * len(columns)]
    lines += ["| " + " | ".join(text(key, row) for key, _ in columns) + " |" for row in rows]
    with open(os.path.join(folder, "table.md"), "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")
    print("\n".join(lines))


def main(folder):
    path = lambda name: os.path.join(folder, name)
    front = ((0.5, 1, -0.35), (0, 0, 1))
    sheet(panels_of(folder, "cube", [("dense boundary", "dense", "dense"), ("vtkDecimatePro", "vtkDecimatePro", "decimated"),
                                     ("simplex mesh", "simplex", "after-simplex"), ("its dual", "simplex", "after")],
                    front, plane=((31.5, 31.5, 31.5), (0, 1, 0))),
          path("simplex-cube.png"), 4)
    below = ((0.5, 1, 0.45), (0, 0, 1))
    sheet(panels_of(folder, "brain", [("to begin with", "to begin with", "before"),
                                      ("simplex mesh", "simplex", "after-simplex"), ("its dual", "simplex", "after")], below),
          path("simplex-brain.png"), 3, curves=evolution(folder, "brain"))
    red, yellow, blue = (205, 92, 82), (228, 196, 98), (122, 152, 190)
    sheet(panels_of(folder, "tubes", [("dense boundary", "dense", "dense"), ("simplex mesh", "simplex", "after-simplex"),
                                      ("its dual", "simplex", "after")], ((0.3, 1, -0.25), (0, 0, 1)),
                    colors=[(0, 0, 0), red, yellow]), path("simplex-tubes.png"), 3)
    surface = read(path("path-after.vtp"))
    middle = np.asarray(surface.GetCenter())
    sheet(panels_of(folder, "path", [("dense boundary", "dense", "dense"), ("simplex mesh", "simplex", "after-simplex"),
                                     ("its dual", "simplex", "after")], ((-1, 0.15, -0.1), (0, 0, 1)),
                    plane=(middle, (-1, 0, 0)), colors=[(0, 0, 0), yellow, blue, (222, 150, 92)]),
          path("simplex-path.png"), 3)
    table(folder)


if __name__ == "__main__":
    main(sys.argv[1])
