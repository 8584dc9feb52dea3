#!/usr/bin/python3
"""Makes and measures tetrahedra of a cube and a brain, and draws them like figures 9 and 10 of Audette et al. 2007.

usage: tetrahedra.py OUTDIR [--bin BIN] [--reuse] [--document]

Meshes the cube with four openings and the brain as one tissue (the JHU atlas at 2 mm), each three times: with Fuchs's
lattice as it is, with the vertices that are not whole (--placement) adjusted by the penalty functional, and with all
vertices adjusted. Writes tetrahedra-histograms.png (figure 10, with inner and boundary vertices in separate
histograms), tetrahedra-child-parent.png (figure 9) and tetrahedra.md (a table) to OUTDIR. BIN (default: build/bin)
holds the programs. --reuse uses meshes that are already in OUTDIR; --document copies the pictures to Docs/images and
the table into Docs/FuchsTetrahedralizer.md. Needs a display: run it by workflow/example/display.py.
"""
import argparse
import json
import os
import shutil
import subprocess
import sys
from types import SimpleNamespace

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, *parts) for parts in (("workflow", "example"), ("Testing", "Python"),
                                                         ("Testing", "Benchmarks"))]
from inputs import resampled  # noqa: E402
from maps import cut_out, write_nrrd  # noqa: E402
from measures import dihedral_angles  # noqa: E402
from meshfiles import cell_array, read_dataset, read_mesh  # noqa: E402
from views import View, actor_of, cell_centers, extracted, paint, save_image  # noqa: E402

PLACEMENTS = (("lattice", "#c8553d"), ("not whole", "#4c78a8"), ("all", "#5a9367"))
PINK, TURQUOISE = (0.93, 0.47, 0.66), (0.30, 0.78, 0.78)
INK = "#22262e"


def cube():
    """Returns a hollow cube with four openings and a hemisphere under its inner ceiling, as in SimplexExperiments."""
    x, y, z = np.meshgrid(*[np.arange(64) - 31.5] * 3, indexing="ij", sparse=True)
    outer = np.maximum(np.maximum(np.abs(x), np.abs(y)), np.abs(z))
    gland = (z < 16) & (x**2 + y**2 + (z - 16)**2 < 64)
    opening = z**2 + np.minimum(x**2, y**2) < 49
    return (gland | ((outer < 24) & (outer > 16) & ~opening)).astype(np.uint16), np.eye(4)


def brain():
    labels, affine = cut_out(np.s_[0:, 0:, 0:])
    return resampled((np.squeeze(labels) > 0).astype(np.uint16), affine, 2.0)


CASES = (
    SimpleNamespace(name="cube", make=cube, lengths="1..4",
                    scale="--targetPoint 31.5,31.5,43.5 --minimumEdgeLength 1 --maximumEdgeLength 4 --childRadius 10 "
                          "--decayLength 20"),
    SimpleNamespace(name="brain", make=brain, lengths="2..8",
                    scale="--targetPoint 0,0,-10 --minimumEdgeLength 2 --maximumEdgeLength 8 --childRadius 10 "
                          "--decayLength 25"),
)


# ---- meshes

def mesh_all(case, programs, folder, reuse):
    """Makes the meshes of a case. Maps each placement to the common name of its mesh (.vtu) and report (.json)."""
    def path(name):
        return os.path.join(folder, f"{case.name}-{name}")

    def run(program, *arguments):
        subprocess.run([os.path.join(programs, program), *arguments], check=True, stdout=subprocess.DEVNULL)

    files = {placement: path(placement.replace(" ", "-")) for placement, _ in PLACEMENTS}
    if reuse and all(os.path.exists(file + ".json") for file in files.values()):
        return files
    write_nrrd(path("map.nrrd"), *case.make())
    run("SurgicalPathScaleCLI", *case.scale.split(), path("map.nrrd"), path("scale.nrrd"))
    run("SimplexMesherCLI", "--scale", path("scale.nrrd"), "--ambient", path("ambient.vtu"), path("map.nrrd"),
        path("surface.vtp"))
    for placement, file in files.items():
        run("FuchsTetrahedralizerCLI", "--scale", path("scale.nrrd"), "--ambient", path("ambient.vtu"), "--placement",
            placement, "--report", file + ".json", path("surface.vtp"), file + ".vtu")
    return files


def report_of(file):
    with open(file + ".json", encoding="utf-8") as stream:
        return json.load(stream)["quality"]


# ---- table

def share_near(angles, mode):
    return np.mean(np.abs(angles - mode) <= 2)


def share_of(histogram, value):
    counts = np.array(histogram["counts"])
    return counts[value] / max(counts.sum(), 1)


def rows_of(case, files):
    for placement, _ in PLACEMENTS:
        quality, mesh = report_of(files[placement]), read_mesh(files[placement] + ".vtu")
        child = cell_array(read_dataset(files[placement] + ".vtu"), "SubMesh") > 0
        angles = dihedral_angles(mesh)
        near = [f"{share_near(part, 60):.3f} / {share_near(part, 90):.3f}"
                for part in (angles, angles[child], angles[~child])]
        whole, histograms = quality["whole"], quality["histograms"]
        yield (f"{case.name}, L {case.lengths}", placement, f"{whole['tetrahedra']:,}", *near,
               f"{share_of(histograms['valence'], 24):.3f}", str(int(np.argmax(histograms["boundaryValence"]["counts"]))),
               f"{whole['edgesNearTarget']:.3f}", f"{whole['minimumDihedral']['mean']:.1f}, "
               f"{whole['dihedral']['minimum']:.1f}", f"{whole['height']['minimum']:.2f}")


TITLES = ("mesh", "vertices adjusted", "tetrahedra", "within 58..62 / 88..92", "child", "parent",
          "inner vertices with 24", "mode at the boundary", "edges 0.7..1.4", "mean smallest, smallest angle",
          "least height, mm")


def table_of(rows):
    lines = ["| " + " | ".join(TITLES) + " |", "|---" * len(TITLES) + "|"]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def write_table(table):
    """Writes the table between the two marks in Docs/FuchsTetrahedralizer.md."""
    page = os.path.join(ROOT, "Docs", "FuchsTetrahedralizer.md")
    with open(page, encoding="utf-8") as file:
        before, _, rest = file.read().partition("<!-- placements -->\n")
        _, _, after = rest.partition("<!-- end of placements -->\n")
    with open(page, "w", encoding="utf-8") as file:
        file.write(f"{before}<!-- placements -->\n{table}<!-- end of placements -->\n{after}")


# ---- pictures

PANELS = (("dihedral", "dihedral angle (degrees)", (60, 90), (0, 180)),
          ("edgeOverTarget", "edge length over target", (1,), (0.3, 2)),
          ("valence", "tetrahedra at an inner vertex", (24,), (6, 44)),
          ("boundaryValence", "tetrahedra of a tissue at a boundary vertex", (12,), (0, 30)))


def draw_histogram(axes, name, ideals, limits, reports):
    for placement, color in PLACEMENTS:
        histogram = reports[placement]["histograms"][name]
        counts, low, high = (histogram[key] for key in ("counts", "low", "high"))
        if name == "valence":  # always even, so that two counts become one bar, centred on the even number
            counts, low, high = np.reshape(counts, (-1, 2)).sum(axis=1), low - 1, high - 1
        if name == "boundaryValence":
            low, high = low - 0.5, high - 0.5
        edges, shares = np.linspace(low, high, len(counts) + 1), 100 * np.array(counts) / max(sum(counts), 1)
        axes.stairs(shares, edges, color=color, linewidth=1.5, label=placement, fill=placement == "lattice",
                    alpha=0.35 if placement == "lattice" else 1)
    for ideal in ideals:
        axes.axvline(ideal, color=INK, linestyle="--", linewidth=0.9)
    axes.set_xlim(limits)
    axes.spines[["top", "right"]].set_visible(False)


def draw_histograms(reports, file):
    figure, axes = plt.subplots(len(CASES), len(PANELS), figsize=(16, 7.6), dpi=80)
    for row, case in zip(axes, CASES):
        for panel, (name, title, ideals, limits) in zip(row, PANELS):
            draw_histogram(panel, name, ideals, limits, reports[case.name])
            panel.set_xlabel(title)
        row[0].set_ylabel(f"{case.name}, L {case.lengths} mm: share (%)")
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="upper center", ncol=3, frameon=False,
                  title="vertices adjusted: none (lattice), those not whole, all; dashed: the ideal")
    figure.tight_layout(rect=(0, 0, 1, 0.92))
    save(figure, file)


def save(figure, file):
    figure.canvas.draw()
    save_image(Image.fromarray(np.asarray(figure.canvas.buffer_rgba())[..., :3]), file, palette=True)
    plt.close(figure)


def view_of(file, size):
    """Returns a view of the tetrahedra behind a sagittal plane through the middle, uncut; those of the child are pink,
    those of the parent turquoise."""
    mesh = read_dataset(file + ".vtu")
    child = cell_array(mesh, "SubMesh") > 0
    paint(mesh, np.uint8(255 * np.where(child[:, None], PINK, TURQUOISE)))
    centers = cell_centers(mesh)
    middle = 0.5 * (centers[:, 0].min() + centers[:, 0].max())
    return View([actor_of(extracted(mesh, centers[:, 0] > middle), edge_width=0.5)], (1, 0.35, -0.3), size)


def draw_child_and_parent(files, file):
    figure, axes = plt.subplots(1, len(CASES), figsize=(15, 7.5), dpi=80)
    for panel, case in zip(axes, CASES):
        panel.imshow(view_of(files[case.name]["lattice"], (620, 560)).image)
        panel.set_title(f"{case.name}, L {case.lengths} mm: child pink, parent turquoise", fontsize=13, color=INK)
        panel.axis("off")
    figure.tight_layout()
    save(figure, file)


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("folder")
    parser.add_argument("--bin", default=os.path.join(ROOT, "build", "bin"))
    parser.add_argument("--reuse", action="store_true")
    parser.add_argument("--document", action="store_true")
    options = parser.parse_args()
    os.makedirs(options.folder, exist_ok=True)
    files = {case.name: mesh_all(case, options.bin, options.folder, options.reuse) for case in CASES}
    reports = {name: {placement: report_of(file) for placement, file in of.items()} for name, of in files.items()}
    table = table_of([row for case in CASES for row in rows_of(case, files[case.name])])
    with open(os.path.join(options.folder, "tetrahedra.md"), "w", encoding="utf-8") as file:
        file.write(table)
    print(table)
    pictures = [os.path.join(options.folder, f"tetrahedra-{name}.png") for name in ("histograms", "child-parent")]
    draw_histograms(reports, pictures[0])
    draw_child_and_parent(files, pictures[1])
    if options.document:
        write_table(table)
        for picture in pictures:
            shutil.copy(picture, os.path.join(ROOT, "Docs", "images"))


if __name__ == "__main__":
    main()
