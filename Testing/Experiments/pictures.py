#!/usr/bin/python3
"""Draws the surface experiments. usage: pictures.py FOLDER

Reads what SimplexExperiments has written to FOLDER, and writes simplex-cube.png, simplex-brain.png, simplex-tubes.png,
simplex-path.png and table.md beside it. Needs a display: run it by workflow/example/display.py.
"""
import csv
import os
import sys

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
import vtk
from matplotlib.colorbar import ColorbarBase
from matplotlib.colors import LinearSegmentedColormap, Normalize
from PIL import Image
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "workflow", "example"))
from views import save_image  # noqa: E402

INK = "#22262e"
PANEL = 620
FARTHEST = 2.0  # mm; distance that is drawn in full red
WHITE_TO_RED = ((1, 1, 1), (1, 0.85, 0.3), (0.85, 0, 0.05))
NEAR_TARGET = (0.93, 0.55, 0.45)
PATH = ((84, 6, 66), (84, 92, 84))  # mm; from nose to gland, the same as in SimplexExperiments


def read(path):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def triangles_of(surface):
    return vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def those(surface, keep):
    """Returns the cells for which `keep` is true."""
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


def near_target(surface):
    """Returns for each triangle whether it lies around the target, where the scale is constant."""
    length = vtk_to_numpy(surface.GetPointData().GetArray("TargetEdgeLength"))
    return length[triangles_of(surface)].mean(axis=1) <= 1.02 * length.min()


def with_distance(simplex, surface):
    """Gives each vertex of the simplex mesh the distance of its triangle to the boundary. Vertex i belongs to triangle
    i."""
    distance = vtk_to_numpy(surface.GetPointData().GetArray("BoundaryDistance"))[triangles_of(surface)].mean(axis=1)
    array = numpy_to_vtk(distance, deep=True)
    array.SetName("Distance")
    simplex.GetPointData().SetScalars(array)
    return simplex


def lower_label(pairs):
    """Returns, for each triangle, the lower of its two labels or, if that is background, the other one."""
    return np.where(pairs.min(axis=1) > 0, pairs.min(axis=1), pairs.max(axis=1))


def each_once(simplex, surface):
    """Returns for each polygon whether it belongs to the lower label. Between two tissues there are two polygons at the
    same place, of which one is enough for a picture."""
    label = vtk_to_numpy(simplex.GetCellData().GetArray("TissueLabel"))
    lower = lower_label(vtk_to_numpy(surface.GetCellData().GetArray("BoundaryLabels")))
    cells = simplex.GetPolys()
    vertices, offsets = (vtk_to_numpy(a()) for a in (cells.GetConnectivityArray, cells.GetOffsetsArray))
    return np.array([np.any(lower[vertices[begin:end]] == own)
                     for begin, end, own in zip(offsets[:-1], offsets[1:], label)])


def white_to_red():
    colors = LinearSegmentedColormap.from_list("distance", WHITE_TO_RED)
    table = vtk.vtkLookupTable()
    table.SetNumberOfTableValues(64)
    table.SetRange(0, FARTHEST)
    table.Build()
    for i in range(64):
        table.SetTableValue(i, *colors(i / 63)[:3], 1)
    return colors, table


def mapper_of_edges(surface, by_distance):
    extract, edges = vtk.vtkExtractEdges(), vtk.vtkPolyDataMapper()
    extract.SetInputData(surface)
    edges.SetInputConnection(extract.GetOutputPort())
    edges.SetScalarVisibility(bool(by_distance))
    if by_distance:
        edges.SetScalarModeToUsePointData()
        edges.SetLookupTable(white_to_red()[1])
        edges.UseLookupTableScalarRangeOn()
    edges.SetResolveCoincidentTopologyToPolygonOffset()
    edges.SetRelativeCoincidentTopologyLineOffsetParameters(0, -4)
    return edges


def actors_for(surface, by_distance, colors, plane):
    """Returns the actors of faces and edges, cut along `plane` (origin, normal) unless its origin is None."""
    mapper, actor, lines = vtk.vtkPolyDataMapper(), vtk.vtkActor(), vtk.vtkActor()
    mapper.SetInputData(surface)
    mapper.ScalarVisibilityOff()
    actor.SetMapper(mapper)
    actor.GetProperty().SetAmbient(0.25)
    actor.GetProperty().SetColor(0.36, 0.42, 0.50)
    if colors is not None:
        surface.GetCellData().SetScalars(numpy_to_vtk(np.ascontiguousarray(colors), deep=True))
        mapper.SetScalarModeToUseCellData()
        mapper.ScalarVisibilityOn()
    edges = mapper_of_edges(surface, by_distance)
    lines.SetMapper(edges)
    lines.GetProperty().SetColor(0.13, 0.15, 0.18)
    lines.GetProperty().SetLineWidth(3.0 if by_distance else 1.4)
    lines.GetProperty().SetLighting(not by_distance)
    for mapped in (mapper, edges) if plane[0] is not None else ():
        cut = vtk.vtkPlane()
        cut.SetOrigin(*plane[0])
        cut.SetNormal(*plane[1])
        mapped.AddClippingPlane(cut)
    return actor, lines


def path_actors(path):
    """Yields the actors of a path: a tube from its first point to its last, and a ball at the end."""
    line, tube, ball = vtk.vtkLineSource(), vtk.vtkTubeFilter(), vtk.vtkSphereSource()
    line.SetPoint1(*path[0])
    line.SetPoint2(*path[1])
    tube.SetInputConnection(line.GetOutputPort())
    tube.SetRadius(1.2)
    tube.SetNumberOfSides(16)
    ball.SetCenter(*path[1])
    ball.SetRadius(4)
    ball.SetThetaResolution(32)
    ball.SetPhiResolution(32)
    for source in (tube, ball):
        mapper, actor = vtk.vtkPolyDataMapper(), vtk.vtkActor()
        mapper.SetInputConnection(source.GetOutputPort())
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(0.78, 0.06, 0.18)
        actor.GetProperty().SetAmbient(0.4)
        yield actor


def picture(surface, direction, up, by_distance=False, colors=None, plane=(None, None), path=None):
    renderer, window = vtk.vtkRenderer(), vtk.vtkRenderWindow()
    renderer.SetBackground(1, 1, 1)
    for actor in (*actors_for(surface, by_distance, colors, plane), *(path_actors(path) if path else ())):
        renderer.AddActor(actor)
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(2 * PANEL, 2 * PANEL)
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(*surface.GetCenter())
    camera.SetPosition(*(np.asarray(surface.GetCenter()) - np.asarray(direction, float)))
    camera.SetViewUp(*up)
    renderer.ResetCamera()
    camera.Zoom(1.02)
    renderer.ResetCameraClippingRange()
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    width, height, _ = grab.GetOutput().GetDimensions()
    pixels = vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars()).reshape(height, width, 3)[::-1]
    return cropped(pixels.reshape(PANEL, 2, PANEL, 2, 3).mean(axis=(1, 3)).astype(np.uint8))


def cropped(pixels, margin=6):
    rows, columns = np.nonzero((pixels < 250).any(axis=2))
    low, left = max(0, rows.min() - margin), max(0, columns.min() - margin)
    return pixels[low:rows.max() + margin, left:columns.max() + margin]


def sheet(panels, path, note, curves=None):
    """Draws panels (title, pixels) side by side under a note and, if `curves` are given, the two curves of figure 6d
    below them. All lengths are in inches."""
    width, tall = 3.6 * len(panels), 3.5
    height = tall + 1.05 + (2.6 if curves else 0)
    figure = plt.figure(figsize=(width, height), dpi=100)
    figure.text(0.15 / width, 1 - 0.3 / height, note, fontsize=10, color="#5a6170")
    for n, (title, pixels) in enumerate(panels):
        axes = figure.add_axes(((3.6 * n + 0.1) / width, (height - 1.0 - tall) / height, 3.4 / width, tall / height))
        axes.imshow(pixels)
        axes.set_anchor("N")
        axes.axis("off")
        figure.text((3.6 * n + 1.8) / width, 1 - 0.85 / height, title, fontsize=11, color=INK, ha="center")
    add_color_bar(figure, (width - 2.6) / width, 1 - 0.42 / height, 2.3 / width, 0.12 / height)
    if curves:
        steps, data = curves
        for n, (key, label) in enumerate((("faces", "simplex faces"), ("meanDistance", "mean distance (mm)"))):
            left = 0.6 + n * width / 2
            axes = figure.add_axes((left / width, 0.5 / height, (width / 2 - 0.9) / width, 1.9 / height))
            axes.plot(steps, data[key], color="#4c78a8", marker=".", markersize=4)
            axes.set_xlabel("iteration", fontsize=9, color=INK)
            axes.set_title(label, fontsize=10, color=INK)
            axes.tick_params(labelsize=8)
            axes.xaxis.get_major_locator().set_params(integer=True)
            axes.grid(alpha=0.3)
            axes.set_ylim(bottom=0)
    figure.canvas.draw()
    save_image(Image.fromarray(np.asarray(figure.canvas.buffer_rgba())[..., :3]), path)
    plt.close(figure)


def add_color_bar(figure, left, bottom, width, height):
    """Adds the colour bar of the distances by which the edges of simplex meshes are coloured."""
    bar = ColorbarBase(figure.add_axes((left, bottom, width, height)), cmap=white_to_red()[0],
                       norm=Normalize(0, FARTHEST), orientation="horizontal", extend="max", ticks=[0, FARTHEST / 2, FARTHEST])
    bar.ax.tick_params(labelsize=8, length=2, pad=1)
    bar.ax.set_title("edges of simplex mesh: distance to boundary (mm)", fontsize=8, color=INK, pad=3)


def evolution(folder, name):
    with open(os.path.join(folder, name + "-evolution.csv"), encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return [int(row["iteration"]) for row in rows], {key: [float(row[key]) for row in rows] for key in rows[0]}


def face_colors(shown, surface, kept, palette):
    """Returns the colours (n, 3) of the faces in bytes: those of their tissues if there is a palette, else red near the
    target and grey elsewhere. Returns None for simplex meshes without a palette, which have a uniform colour."""
    if palette is not None:
        label = shown.GetCellData().GetArray("BoundaryLabels") or shown.GetCellData().GetArray("TissueLabel")
        values = vtk_to_numpy(label)
        values = lower_label(values) if values.ndim > 1 else values
        return np.array([palette[int(v)] for v in values], np.uint8)
    if shown.GetCellData().GetArray("BoundaryLabels") is None:
        return None
    near = near_target(surface)[kept]
    return np.rint(255 * np.where(near[:, None], NEAR_TARGET, (0.84, 0.84, 0.81))).astype(np.uint8)


def panels_of(folder, name, wanted, view, plane=(None, None), palette=None, path=None):
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
        shown = those(shown, keep)
        colors = face_colors(shown, surface, keep, palette)
        panels.append((f"{title}, {int(rows[name, key]['faces']):,} faces",
                       picture(shown, *view, by_distance=by_distance, colors=colors, plane=plane, path=path)))
    return panels


def table(folder):
    """Writes table.csv as a Markdown table, table.md, and prints it."""
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
    def path(name):
        return os.path.join(folder, name)

    mesh_and_dual = [("simplex mesh", "simplex", "after-simplex"), ("its dual", "simplex", "after")]
    front, below = ((0.5, 1, -0.35), (0, 0, 1)), ((0.3, 0.25, 1), (0, 1, 0))
    sheet(panels_of(folder, "cube", [("dense boundary", "dense", "dense"),
                                     ("vtkDecimatePro", "vtkDecimatePro", "decimated"), *mesh_and_dual],
                    front, plane=((31.5, 31.5, 31.5), (0, 1, 0))),
          path("simplex-cube.png"), "Half cut away. Red faces: around the gland, where the scale is constant")
    sheet(panels_of(folder, "brain", [("to begin with", "to begin with", "before"), *mesh_and_dual], below),
          path("simplex-brain.png"), "Seen from below. Red faces: around the target, where the scale is constant",
          curves=evolution(folder, "brain"))
    red, yellow, blue, orange = (205, 92, 82), (228, 196, 98), (122, 152, 190), (222, 150, 92)
    dense = [("dense boundary", "dense", "dense"), *mesh_and_dual]
    sheet(panels_of(folder, "tubes", dense, ((0.3, 1, -0.25), (0, 0, 1)), palette=[(0, 0, 0), red, yellow]),
          path("simplex-tubes.png"), "Two tubes, red and yellow")
    middle = np.asarray(read(path("path-after.vtp")).GetCenter())
    sheet(panels_of(folder, "path", dense, ((-1, 0.15, -0.1), (0, 0, 1)), plane=(middle, (-1, 0, 0)),
                    palette=[(0, 0, 0), yellow, blue, orange], path=PATH),
          path("simplex-path.png"), "Half cut away. Red: path to the gland. Blue: brain. Yellow: near the path. "
                                    "Orange: held still")
    table(folder)


if __name__ == "__main__":
    main(sys.argv[1])
