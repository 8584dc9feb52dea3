#!/usr/bin/python3
"""Draws the example's pictures. usage: pictures.py FOLDER

Reads scale.nrrd, prepared.nrrd, surface.vtp, mesh.vtu and the three stages' reports in FOLDER and writes surface.png,
tetrahedra.png, scale.png, evolution.png and histograms.png beside them. Cuts are made at the first target or, without
targets, at the end of the first path; if that point is not in tissue, the pictures say so. Needs a display: run it by
display.py. If a picture cannot be drawn, one line on stderr gives the reason, the other pictures are still drawn, and
the exit status is 1.
"""
import json
import os
import sys
from types import SimpleNamespace

try:
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
    import vtk
    from matplotlib.collections import LineCollection
    from matplotlib.patches import Patch, Rectangle
    from PIL import Image
    from vtk.util.numpy_support import vtk_to_numpy
except ImportError as error:
    sys.exit(f"pictures: {error}, expected the packages that CMake/debian-packages.txt has for the example")

from focus import label_at, nearest, points_of_interest, sentence
from meshfiles import cell_array, interpolated, read_dataset, read_nrrd
from palette import tissue_colors, tissue_names
from views import (FOCUS_COLOR, INK, View, actor_of, cell_centers, extracted, lines_of, mark, paint, put, save_image,
                   unit)

DPI = 100
CHILD_COLOR = (0.84, 0.10, 0.16)
BAR_COLOR, IDEAL_COLOR = "#4c78a8", "#d1495b"
SLICE_SAMPLES = 500
NAMES_SHOWN, NAME_LENGTH = 8, 24


# ---- what is drawn

def read_json(file):
    with open(file, encoding="utf-8") as stream:
        return json.load(stream)


def case_of(files):
    """Reads what the pictures show. `files` maps scale, prepared, surface, mesh and scaleReport to paths."""
    report = read_json(files["scaleReport"])
    labels, affine = read_nrrd(files["prepared"])
    surface = read_dataset(files["surface"])
    points = vtk_to_numpy(surface.GetPoints().GetData())
    what, target = points_of_interest(report)[0]
    label = label_at(labels, affine, target)
    return SimpleNamespace(
        labels=labels, affine=affine, surface=surface, files=files, target=target,
        paths=[np.array(path["points"], float) for path in report["paths"]],
        oddity=sentence(what, target, labels, affine, points),
        anchor=target if label else nearest(points, target)[0],
        colors=tissue_colors(surface, cell_array(surface, "BoundaryLabels")))


def shown_target(case):
    """Returns the target or, if it is too far from the tissue for a picture, a point on the way to it."""
    low, high = (f(vtk_to_numpy(case.surface.GetPoints().GetData()), axis=0) for f in (np.min, np.max))
    way, farthest = case.target - case.anchor, 0.6 * np.linalg.norm(high - low)
    distance = np.linalg.norm(way)
    return case.target if distance <= farthest else case.anchor + way * farthest / distance


def also_shown(case):
    return [shown_target(case)] if case.oddity else []


def mark_target(axes, view, case):
    """Marks the target. If it does not lie in tissue, a line leads to the point at which the tissue is cut."""
    mark(axes, view, shown_target(case), toward=case.anchor if case.oddity else None)


def lying_ahead(dataset, case):
    """Returns a mask of the cells behind a coronal plane through the anchor, or of all cells if none are behind it."""
    behind = cell_centers(dataset)[:, 1] > case.anchor[1]
    return behind if behind.any() else np.ones(len(behind), bool)


# ---- figures

def new_figure(width, height):
    return plt.figure(figsize=(width / DPI, height / DPI), dpi=DPI)


def save(figure, file, palette=False):
    figure.canvas.draw()
    save_image(Image.fromarray(np.asarray(figure.canvas.buffer_rgba())[..., :3]), file, palette)
    plt.close(figure)


def headline(figure, x, title, remark, oddity=None):
    """Writes a title at the top of a figure, `x` pixels from the left, a remark below it, and below that `oddity` in
    red."""
    width, height = figure.get_size_inches() * DPI
    figure.text(x / width, 1 - 42 / height, title, fontsize=18, color=INK)
    figure.text(x / width, 1 - 70 / height, remark, fontsize=13, color="#5a6170")
    if oddity:
        figure.text(x / width, 1 - 94 / height, oddity, fontsize=12, color=FOCUS_COLOR)


def cut_open(anchor):
    """Returns an implicit function that is negative in the part that is cut away, which lies anterior and left of the
    anchor."""
    quarter = vtk.vtkImplicitBoolean()
    quarter.SetOperationTypeToIntersection()
    for normal in ((0, 1, 0), (-1, 0, 0)):
        plane = vtk.vtkPlane()
        plane.SetOrigin(anchor)
        plane.SetNormal(normal)
        quarter.AddFunction(plane)
    return quarter


def seen_labels(surface, direction):
    """Returns, for each triangle, the tissue on the viewer's side or, if that side is outside, the tissue on the other
    side. `direction` is the viewing direction."""
    labels = cell_array(surface, "BoundaryLabels")
    corners = vtk_to_numpy(surface.GetPoints().GetData())[
        vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    towards_us = (normals @ direction < 0).astype(int)
    near, far = labels[np.arange(len(labels)), towards_us], labels[np.arange(len(labels)), 1 - towards_us]
    return np.where(near != 0, near, far)


def draw_surface(case, file):
    surface = case.surface
    view = unit((-0.75, 1, -0.42))
    paint(surface, case.colors[seen_labels(surface, view)])
    clip, rim = vtk.vtkClipPolyData(), vtk.vtkCutter()
    clip.SetClipFunction(cut_open(case.anchor))
    rim.SetCutFunction(cut_open(case.anchor))
    for cut in (clip, rim):
        cut.SetInputData(surface)
        cut.Update()
    open_ = clip.GetOutput() if clip.GetOutput().GetNumberOfCells() else surface
    actors = [actor_of(open_, edge_width=0.5), lines_of(rim.GetOutput(), 1.4)]
    view = View(actors, view, (1160, 870), also_shown(case))
    figure = new_figure(1200, 1000)
    mark_target(put(figure, view, 20, 15), view, case)
    labels = cell_array(surface, "BoundaryLabels")
    headline(figure, 30, f"The surface: {len(labels):,} triangles bound {len(np.setdiff1d(labels, [0]))} tissues",
             "a quarter cut away at the target (+); walls in the colour of the tissue that one looks into", case.oddity)
    save(figure, file, palette=True)


def put_names(figure, x, y, mesh, labels, colors):
    """Draws a legend of the tissues that have most tetrahedra, from pixel (x, y) downwards. `labels` are the labels of
    the tetrahedra."""
    found, counts = np.unique(labels, return_counts=True)
    names = tissue_names(mesh)
    patches = []
    for label in found[np.argsort(-counts, kind="stable")][:NAMES_SHOWN]:
        name = names.get(int(label), f"tissue {label}")
        name = name if len(name) <= NAME_LENGTH else name[:NAME_LENGTH - 1] + "…"
        patches.append(Patch(facecolor=colors[label] / 255, edgecolor=INK, linewidth=0.5, label=name))
    width, height = figure.get_size_inches() * DPI
    figure.legend(handles=patches, loc="upper left", bbox_to_anchor=(x / width, y / height), ncol=2, frameon=False,
                  fontsize=12, handlelength=1.2, borderaxespad=0, columnspacing=1.5)


def frame_of(view, dataset, margin=4):
    """Returns the rectangle (x, y, width, height) around a data set in a view, in pixels of the view."""
    seen = view.pixels(vtk_to_numpy(dataset.GetPoints().GetData()))
    low, high = seen.min(axis=0) - margin, seen.max(axis=0) + margin
    return (*low, *(high - low))


def put_child(figure, whole_axes, whole, mesh, child, case):
    """Draws the child mesh on its own and enlarged, a frame around it in the picture of the whole mesh, and lines that
    connect the two."""
    part = extracted(mesh, child)
    view = View([actor_of(part, edge_width=0.7)], whole.frame[2], (530, 500))
    axes = put(figure, view, 955, 220)
    x, y, width, height = frame_of(whole, part)
    whole_axes.add_patch(Rectangle((x, y), width, height, fill=False, edgecolor=INK, linewidth=1.6))
    for corner, at in (((x + width, y + height), (955, 720)), ((x + width, y), (955, 220))):
        ends = whole_axes.transData.inverted().transform(at)
        whole_axes.plot(*np.transpose([corner, ends]), color=INK, linewidth=0.7, clip_on=False)
    axes.add_patch(Rectangle((0, 0), 1, 1, transform=axes.transAxes, fill=False, edgecolor=INK, linewidth=1.6,
                             clip_on=False))
    put_names(figure, 955, 195, mesh, cell_array(mesh, "TissueLabel")[child], case.colors)


def draw_tetrahedra(case, file):
    mesh = read_dataset(case.files["mesh"])
    children = cell_array(mesh, "SubMesh") > 0
    behind = lying_ahead(mesh, case)
    child = behind & children
    paint(mesh, case.colors[cell_array(mesh, "TissueLabel")])
    actors = [actor_of(extracted(mesh, behind & ~children), edge_width=0.5)] if np.any(behind & ~children) else []
    if child.any():
        actors.append(actor_of(extracted(mesh, child), color=CHILD_COLOR))
    whole = View(actors, (-0.25, 1, -0.2), (910, 760), also_shown(case))
    figure = new_figure(1500, 900)
    axes = put(figure, whole, 15, 15)
    remark = "behind a coronal plane through the target, coloured by tissue"
    if child.any():
        remark += "; the child mesh in red"
    headline(figure, 30, f"The mesh: {len(children):,} tetrahedra", remark, case.oddity)
    if child.any():
        headline(figure, 955, f"The child mesh: {children.sum():,} of them", "same cut, enlarged, coloured by tissue")
        put_child(figure, axes, whole, mesh, child, case)
    else:
        headline(figure, 955, "No child mesh" + (" behind the plane" if children.any() else ""),
                 "" if children.any() else "no part of it is much finer than the rest")
        put_names(figure, 955, 700, mesh, cell_array(mesh, "TissueLabel"), case.colors)
    if case.oddity or not child.any():
        mark_target(axes, whole, case)
    save(figure, file, palette=True)


def slice_positions(case, normal):
    """Returns positions (n, m, 3) in LPS mm on a regular grid in the plane through the target that is perpendicular to
    LPS axis `normal`, and the spacing of the grid (mm). The grid covers the map and the target."""
    corners = np.array([[*corner, 1] for corner in np.ndindex(2, 2, 2)], float)
    corners[:, :3] = corners[:, :3] * case.labels.shape - 0.5
    corners = (corners @ case.affine.T)[:, :3]
    beyond = [shown_target(case) + step * 0.05 * np.ptp(corners, axis=0) for step in (-1, 1)] if case.oddity else []
    corners = np.vstack([corners, *beyond])
    low, high = corners.min(axis=0), corners.max(axis=0)
    u, v = [axis for axis in range(3) if axis != normal]
    spacing = max((high - low)[[u, v]].max() / SLICE_SAMPLES, 1e-6)
    positions = np.meshgrid(*(np.arange(low[a] + spacing / 2, high[a], spacing) for a in (u, v)), indexing="ij")
    world = np.empty(positions[0].shape + (3,))
    world[..., u], world[..., v] = positions
    world[..., normal] = plane_through(case)[normal]
    return world, spacing


def plane_through(case):
    """Returns the target or, if it lies outside the map, the centre of the voxel at the point of tissue next to it."""
    if label_at(case.labels, case.affine, case.target) is not None:
        return case.target
    index = np.rint(np.linalg.solve(case.affine, [*case.anchor, 1])[:3])
    return (case.affine @ [*np.clip(index, 0, np.array(case.labels.shape) - 1), 1])[:3]


def labels_on(case, world):
    """Returns the label of the voxel at each position, and -1 outside the map."""
    index = np.rint((world - case.affine[:3, 3]) @ np.linalg.inv(case.affine[:3, :3]).T).astype(int)
    last = np.array(case.labels.shape) - 1
    at = np.clip(index, 0, last)
    found = case.labels[at[..., 0], at[..., 1], at[..., 2]].astype(int)
    return np.where(np.all(index == at, axis=-1), found, -1)


def borders_of(found, x, y, spacing):
    """Returns line segments (n, 2, 2) between neighbouring grid positions that have different labels."""
    segments = []
    for axis in (0, 1):
        differs = np.diff(found, axis=axis) != 0
        middles = np.stack([x, y], axis=-1)[:differs.shape[0], :differs.shape[1]][differs]
        ahead, across = np.eye(2)[axis] * spacing / 2, np.eye(2)[1 - axis] * spacing / 2
        segments.append(np.stack([middles + ahead - across, middles + ahead + across], axis=1))
    return np.concatenate(segments)


def draw_slice(axes, case, scale, normal):
    """Draws target edge lengths and tissue boundaries on the plane through the target that is perpendicular to LPS axis
    `normal`."""
    world, spacing = slice_positions(case, normal)
    u, v = [axis for axis in range(3) if axis != normal]
    lengths, found = interpolated(*scale, world), labels_on(case, world)
    inside = found >= 0 if np.any(found >= 0) else np.ones(found.shape, bool)
    lengths = np.where(inside, lengths, np.nan)
    low, high = lengths[inside].min(), lengths[inside].max()
    varies = high - low > 1e-3 * high
    x, y = world[..., u], world[..., v]
    extent = (x.min() - spacing / 2, x.max() + spacing / 2, y.min() - spacing / 2, y.max() + spacing / 2)
    shown = axes.imshow(lengths.T, extent=extent, origin="lower", cmap="viridis", interpolation="nearest",
                        vmin=low if varies else 0.9 * low, vmax=high if varies else 1.1 * high)
    axes.add_collection(LineCollection(borders_of(found, x, y, spacing), colors="white", linewidths=0.5, alpha=0.8))
    levels = np.arange(np.floor(low) + 1, np.ceil(high))
    levels = levels[(levels > low + 1e-3) & (levels < high - 1e-3)]  # no contours of the noise in constant regions
    if varies and len(levels) and min(lengths.shape) > 1:
        contours = axes.contour(x, y, lengths, levels=levels, colors=INK, linewidths=1.1)
        axes.clabel(contours, levels=levels[len(levels) // 2:], fmt="%g mm", fontsize=9)  # the inner ones would overlap
    for path in case.paths:
        axes.plot(path[:, u], path[:, v], color=CHILD_COLOR, linewidth=2)
    at = shown_target(case)
    axes.plot(at[u], at[v], "+", color=CHILD_COLOR, markersize=15, markeredgewidth=2.5)
    axes.set(aspect="equal", xlim=extent[:2], ylim=extent[2:])
    axes.set_xlabel(("right <  L (mm)  > left", "anterior <  P (mm)  > posterior")[u])
    axes.set_ylabel(("", "anterior <  P (mm)  > posterior", "S (mm)")[v])
    return shown


def draw_scale(case, file):
    scale = read_nrrd(case.files["scale"])
    figure = new_figure(1500, 830)
    axial = figure.add_axes((0.05, 0.08, 0.37, 0.78))
    sagittal = figure.add_axes((0.48, 0.08, 0.42, 0.78))
    for axes, normal in ((axial, 2), (sagittal, 0)):
        axes.set_facecolor("#d9d9d9")  # outside the map
        shown = draw_slice(axes, case, scale, normal)
    axial.invert_yaxis()
    axial.set_ylabel("posterior <  P (mm)  > anterior")
    figure.colorbar(shown, cax=figure.add_axes((0.925, 0.15, 0.013, 0.66)), label="target edge length (mm)")
    around = "the target (+) and along the path" if case.paths else "the target (+)"
    headline(figure, 30, f"The scale: target edge length around {around}",
             "axial slice, anterior at the top; sagittal slice, anterior to the left; tissue boundaries in white",
             case.oddity)
    save(figure, file)


def share_within(histogram, low, high):
    """Returns the share (%) of a histogram's counts in bars whose middles lie between `low` and `high`."""
    counts = np.array(histogram["counts"], float)
    edges = np.linspace(histogram["low"], histogram["high"], len(counts) + 1)
    middles = (edges[1:] + edges[:-1]) / 2
    return 100 * counts[(middles >= low) & (middles <= high)].sum() / max(counts.sum(), 1)


def histogram_notes(whole, histograms):
    """Returns, for each histogram, a text on what it shows and a text on how that differs from the ideal."""
    angles, ratio, valence = whole["dihedral"], whole["edgeOverTarget"], whole["valence"]
    at60, at90 = (share_within(histograms["dihedral"], mode - 2, mode + 2) for mode in (60, 90))
    short, long_ = (share_within(histograms["edgeOverTarget"], *bounds) for bounds in ((0, 0.7), (1.4, np.inf)))
    usual = share_within(histograms["valence"], 18, 30)
    return {
        "dihedral": (f"{angles['minimum']:.1f} to {angles['maximum']:.1f} degrees",
                     f"ideal: 4 of 6 at 60, 2 at 90; here {at60:.0f} % in 58..62, {at90:.0f} % in 88..92"),
        "edgeOverTarget": (f"{100 * whole['edgesNearTarget']:.1f} % within 0.7 to 1.4",
                           f"ideal: 1; here the median is {ratio['median']:.2f}, {short:.0f} % shorter, "
                           f"{long_:.0f} % longer"),
        "valence": (f"median {valence['median']:.0f}",
                    f"ideal: 24; here {usual:.0f} % have 18 to 30") if sum(histograms["valence"]["counts"]) else
                   ("no such vertex", "ideal: 24"),
    }


def draw_histograms(report, file):
    """Draws the three histograms of Audette et al. 2007, figure 10, from the mesh's report."""
    whole, histograms = report["quality"]["whole"], report["quality"]["histograms"]
    notes = histogram_notes(whole, histograms)
    panels = [("dihedral", "Dihedral angle (degrees)", (60, 90)),
              ("edgeOverTarget", "Edge length over target", (1,)),
              ("valence", "Tetrahedra at a vertex inside a tissue", (24,))]
    figure = new_figure(1500, 600)
    for n, (name, title, ideals) in enumerate(panels):
        axes = figure.add_axes((0.05 + 0.325 * n, 0.11, 0.28, 0.60))
        counts, low, high = (histograms[name][key] for key in ("counts", "low", "high"))
        if name == "valence":  # always even, so that two counts become one bar, centred on the even number
            counts, low, high = np.reshape(counts, (-1, 2)).sum(axis=1), low - 1, high - 1
        edges = np.linspace(low, high, len(counts) + 1)
        axes.bar(edges[:-1], 100 * np.array(counts) / max(sum(counts), 1), np.diff(edges), align="edge",
                 color=BAR_COLOR, edgecolor="white", linewidth=0.4)
        for ideal in ideals:
            axes.axvline(ideal, color=IDEAL_COLOR, linestyle="--", linewidth=1.3)
        figure.text(0.05 + 0.325 * n, 0.785, notes[name][0], fontsize=14, color=INK)
        figure.text(0.05 + 0.325 * n, 0.74, notes[name][1], fontsize=11, color="#5a6170")
        axes.set_xlabel(title, fontsize=12)
        axes.set_ylabel("share (%)", fontsize=11)
        axes.spines[["top", "right"]].set_visible(False)
    headline(figure, 30, f"The quality of {whole['tetrahedra']:,} tetrahedra",
             "dashed: the ideal, a lattice of canonical tetrahedra, edges as long as their target; tissue boundaries "
             "and changing lengths keep from it")
    save(figure, file)


def draw_evolution(report, file):
    """Draws the size, the distance to the map and the operations of each step of the surface stage, from its report."""
    steps = report["evolution"]
    number = np.arange(len(steps))
    figure = new_figure(1500, 600)
    panels = [figure.add_axes((0.05 + 0.325 * n, 0.11, 0.28, 0.62)) for n in range(3)]
    size, distance, operations = panels
    size.bar(number, [step["faces"] / 1000 for step in steps], color=BAR_COLOR, edgecolor="white", linewidth=0.4)
    size.set_ylabel("faces between tissues (thousands)", fontsize=11)
    distance.plot(number, [step["maximumDistance"] for step in steps], color=IDEAL_COLOR, marker="o", label="maximum")
    distance.plot(number, [step["meanDistance"] for step in steps], color=BAR_COLOR, marker="o", label="mean")
    distance.set_ylabel("from the map's boundary to the surface (mm)", fontsize=11)
    distance.set_ylim(bottom=0)
    for name, kind, color in (("edges collapsed (T1)", "T1", BAR_COLOR), ("edges split (T2)", "T2", INK),
                              ("edges flipped (T7)", "T7", IDEAL_COLOR),
                              ("tetrahedra relabelled", "relabels", "#54a24b")):
        operations.plot(number, [step[kind] for step in steps], color=color, marker="o", label=name)
    operations.set_yscale("symlog", linthresh=1)
    operations.set_ylim(bottom=0)
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
             f"steps 1 to {first - 1} coarsen, the others improve; T1, T2 and T7 are the names of these operations on "
             "the dual simplex mesh")
    save(figure, file)


def draw_all(folder):
    """Yields, for each picture, its name and a function that draws it to a file. The data that several pictures share
    are read once, when they are first needed."""
    inside = lambda name: os.path.join(folder, name)
    files = {"scale": inside("scale.nrrd"), "prepared": inside("prepared.nrrd"), "surface": inside("surface.vtp"),
             "mesh": inside("mesh.vtu"), "scaleReport": inside("scale.json")}
    case = []

    def of_case(draw):
        if not case:
            case.append(case_of(files))
        return lambda file: draw(case[0], file)

    yield "scale.png", lambda file: of_case(draw_scale)(file)
    yield "evolution.png", lambda file: draw_evolution(read_json(inside("surface.json")), file)
    yield "histograms.png", lambda file: draw_histograms(read_json(inside("mesh.json")), file)
    yield "surface.png", lambda file: of_case(draw_surface)(file)
    yield "tetrahedra.png", lambda file: of_case(draw_tetrahedra)(file)


def drawn(name, draw, file):
    """Draws a picture and returns whether that succeeded. If not, a line on stderr gives the reason: no error in a
    picture may end the run."""
    try:
        draw(file)
        return True
    except Exception as error:  # pylint: disable=broad-except
        print(f"pictures: {name} cannot be drawn: {type(error).__name__}: {' '.join(str(error).split())}",
              file=sys.stderr)
        return False


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: pictures.py FOLDER")
    folder = sys.argv[1]
    done = [drawn(name, draw, os.path.join(folder, name)) for name, draw in draw_all(folder)]
    sys.exit(not all(done))


if __name__ == "__main__":
    main()
