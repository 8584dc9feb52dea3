"""Makes the tables and pictures of image_registration.py."""
import json
import os

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import to_rgb
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

import document
from fidelity import boundary_triangles

COLORS = {"ours, ambient": ("#c8553d", "o"), "ours, surface alone": ("#e0a458", "v"), "CGAL Mesh_3": ("#4c78a8", "s"),
          "CGAL surface + TetGen": ("#5a9367", "^"), "compressed lattice": ("#8a6fa8", "D"),
          "Cleaver 2": ("#7f7f7f", "P")}
PANELS = (("tetrahedra", "tetrahedra", "log"), ("smallestDihedral", "smallest dihedral angle (°)", "linear"),
          ("meanSmallestDihedral", "mean smallest dihedral angle (°)", "linear"),
          ("condition", "condition number of K + H'H", "log"), ("iterations", "iterations, twenty steps", "linear"),
          ("error", "mean error at the brain's voxels (mm)", "linear"))
LIGHT = np.array([-2, -1, 2]) / 3


def interval_text(interval):
    return f"{interval[0]:g} to {interval[1]:g}"


def matching_table(matches):
    return document.table(
        ["shift (mm)", "points", "of these cut out", "within a voxel", "median error (mm)", "95 % (mm)"],
        [[row["shift"], f"{row['points']:,}", row["removed"], f"{100 * row['withinVoxel']:.1f} %", f"{row['median']:.2f}",
          f"{row['quantile95']:.2f}"] for row in matches])


def least_median_largest(ascending):
    """Returns the least, the median (the lower of two, as in image_registration.chosen) and the largest value."""
    return ascending[0], ascending[(len(ascending) - 1) // 2], ascending[-1]


def distance_rows(table):
    for (interval, mesher), row in table.items():
        if row is None:
            yield [interval_text(interval), mesher, "no mesh there"] + [""] * 9
            continue
        shifts = list(row["dense"].values())
        middle = shifts[len(shifts) // 2]
        yield [interval_text(interval), mesher, len(row["errorsThere"]), f"{row['hausdorff']:.1f}",
               f"{row['tetrahedra']:,}",
               f"{row['smallestDihedral']:.1f} / {row['meanSmallestDihedral']:.1f}", f"{row['condition']:.0f}",
               f"{row['mesherSeconds']:.2f}", f"{1000 * row['solverSeconds']:.1f} / {middle['iterations']}",
               " / ".join(f"{result['mean']:.2f}" for result in shifts),
               " / ".join(f"{error:.2f}" for error in least_median_largest(row["errorsThere"])),
               " / ".join(f"{100 * result['plantedRejected']:.0f}" for result in shifts)]


def distance_table(table):
    return document.table(
        ["D_H (voxels)", "mesher", "meshes there", "D_H of the typical one", "tetrahedra",
         "dihedral min / mean min (°)", "condition", "mesher (s)", "solver (ms) / iterations", "mean error by shift (mm)",
         "mean over the shifts, least / median / largest of the meshes there (mm)",
         "planted outliers rejected by shift (%)"],
        distance_rows(table))


def error_rows(table):
    for (interval, mesher), row in table.items():
        if row:
            yield [interval_text(interval), mesher] + [
                " / ".join([*(f"{result[key]:.2f}" for key in ("mean", "rootMeanSquare", "quantile95")),
                            f"{result['largest']:.1f}"]) for result in row["dense"].values()]


def error_table(table, shifts):
    return document.table(["D_H (voxels)", "mesher"] + [f"{shift} mm: mean / rms / 95 % / largest (mm)"
                                                        for shift in shifts], error_rows(table))


def draw_measures(rows, file):
    figure, axes = plt.subplots(2, 3, figsize=(13, 7.4), dpi=80)
    for axis, (key, title, scale) in zip(axes.flat, PANELS):
        for mesher, (color, marker) in COLORS.items():
            points = [(row["hausdorff"], row[key]) for row in rows if row["mesher"] == mesher and key in row]
            if points:
                axis.plot(*np.transpose(points), color=color, marker=marker, label=mesher, linestyle="", markersize=5)
        axis.set_title(title, fontsize=11, pad=10)
        axis.set_yscale(scale)
        axis.set_xlim(0, 25)
        if scale == "linear":
            axis.set_ylim(bottom=0)
        axis.grid(alpha=0.3)
        axis.spines[["top", "right"]].set_visible(False)
    for axis in axes[1]:
        axis.set_xlabel("D_H (voxels)")
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="upper center", ncol=6, frameon=False)
    figure.tight_layout(rect=(0.01, 0.01, 0.99, 0.94))
    figure.savefig(file)
    plt.close(figure)


def draw_mesh(axis, mesh, color):
    triangles = mesh.points[boundary_triangles(mesh)[0]]
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    light = 0.45 + 0.55 * np.abs(normals @ LIGHT)
    axis.add_collection3d(Poly3DCollection(triangles, facecolors=np.outer(light, to_rgb(color)), edgecolors="#333333",
                                           linewidths=0.4))
    low, high = triangles.min(axis=(0, 1)), triangles.max(axis=(0, 1))
    axis.set_xlim(low[0], high[0])
    axis.set_ylim(low[1], high[1])
    axis.set_zlim(low[2], high[2])
    axis.set_box_aspect(high - low, zoom=1.35)
    axis.view_init(15, -150)
    axis.set_axis_off()


def draw_meshes(table, mesh_of, file):
    """Draws, like the paper's figure 5, the mesh of every mesher in the first interval of Hausdorff distance, above,
    and in the last, below."""
    bins = list(dict.fromkeys(interval for interval, _ in table))
    meshers = list(dict.fromkeys(mesher for _, mesher in table))
    figure = plt.figure(figsize=(3 * len(meshers), 6.4), dpi=80)
    for line, interval in enumerate((bins[0], bins[-1])):
        for column, mesher in enumerate(meshers):
            axis = figure.add_subplot(2, len(meshers), line * len(meshers) + column + 1, projection="3d")
            row = table[interval, mesher]
            axis.set_title(f"{mesher}\n" + (f"D_H {row['hausdorff']:.1f}, {row['tetrahedra']:,} tetrahedra" if row
                                           else f"none at {interval_text(interval)}"), fontsize=10)
            if row:
                draw_mesh(axis, mesh_of(row), COLORS[mesher][0])
            else:
                axis.set_axis_off()
    figure.tight_layout(rect=(0.01, 0.02, 0.99, 0.98))
    figure.savefig(file)
    plt.close(figure)


def tables_of(matches, table):
    return {"block matching": matching_table(matches), "equal distance": distance_table(table),
            "dense errors": error_table(table, [row["shift"] for row in matches])}


def write(parts, matches, rows, table, documented, mesh_of):
    tables = tables_of(matches, table)
    with open(parts.path("registration.md"), "w", encoding="utf-8") as file:
        file.write("\n".join(tables.values()))
    with open(parts.path("registration.json"), "w", encoding="utf-8") as file:
        json.dump({"matches": matches, "meshes": rows, "chosen": [row for row in table.values() if row]}, file, indent=1)
    folder = document.IMAGES if documented else parts.folder
    draw_measures(rows, os.path.join(folder, "registration.png"))
    draw_meshes(table, mesh_of, os.path.join(folder, "registration-meshes.png"))
    if documented:
        document.put(tables)
    print("\n".join(tables.values()))
