#!/usr/bin/python3
"""Measures the fitness of meshes for registration, after Chernikov et al.: ours, CGAL Mesh_3's, and TetGen's in CGAL's
surface.

usage: fitness.py OUTDIR [--build BUILD | --bin BIN] [--map FILE] [--scales F,F,...] [--reuse] [--document]

Meshes the map (default: jhu189) by all three meshers with target edge lengths from F to 8 F mm around a target, for
every F (default: 1,1.5,2,3,4), and by the others also at 0.8 of the least F. Measures every mesh; Docs/Fitness.md
describes the measures. Writes fitness.json, fitness.csv, fitness.md (two tables) and fitness.png to OUTDIR. Without
--bin, the programs are first built in BUILD (default: build). --reuse uses meshes that are already in OUTDIR.
--document puts the tables and the picture into Docs/.
"""
import argparse
import csv
import json
import os
import subprocess
import sys
import time
from types import SimpleNamespace

import matplotlib
matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator
from scipy import ndimage, sparse
from scipy.sparse.csgraph import connected_components

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, "workflow", "example"), os.path.join(ROOT, "Testing", "Python")]
from elasticity import Cholesky, stiffness, unknowns, weight  # noqa: E402
from fidelity import around, boundary_of_map, boundary_of_mesh, hausdorff, hausdorff_by_tissue  # noqa: E402
from measures import TETRAHEDRON_FACES, dihedral_angles, euler_numbers_of_map, euler_numbers_of_mesh  # noqa: E402
from meshfiles import interpolated, read_mesh, read_nrrd  # noqa: E402
from registration import condition_numbers, conjugate_gradients, registered, system  # noqa: E402

PROGRAMS = ["SurgicalPathScaleCLI", "SimplexMesherCLI", "FuchsTetrahedralizerCLI", "Mesh3Driver", "TetGenDriver"]
MESHERS = {"SurgicalMesher": ("#c8553d", "o"), "CGAL Mesh_3": ("#4c78a8", "s"),
           "CGAL surface + TetGen": ("#5a9367", "^")}
TARGET = "0,0,-10"
FINER = 0.8  # times the least F: so that some meshes of the others are as near to the map as our finest
ISLAND = 30  # mm^3
# The registration: the weights are 1 N/mm per point. With this modulus, the first solution follows deformations that
# vary over the distance of a few points, and the repetitions also those between the points.
YOUNGS_MODULUS, POISSONS_RATIO = 0.1, 0.45  # MPa
REGISTRATION_POINTS, CHECK_POINTS = 2000, 5000
LATTICE = 5  # mm; spacing of the lattice of the synthetic deformation
LARGEST_DISPLACEMENT = 10  # mm


# ---- meshes

class Runner:
    """Runs the programs and adds up the processor time they take."""

    def __init__(self, folder, programs, reuse):
        self.folder, self.programs, self.reuse = folder, programs, reuse

    def path(self, name):
        return os.path.join(self.folder, name)

    def run(self, program, *arguments):
        """Runs a program and returns its processor seconds. Raises CalledProcessError."""
        before = os.times()
        subprocess.run([os.path.join(self.programs, program), *map(str, arguments)], check=True, cwd=self.folder,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        after = os.times()
        return after.children_user + after.children_system - before.children_user - before.children_system

    def mesh(self, name, steps):
        """Makes a mesh by `steps` of (program, arguments...), and returns it and the processor seconds, which are kept
        for a later --reuse."""
        record = self.path(name + ".json")
        if not (self.reuse and os.path.exists(record)):
            seconds = sum(self.run(*step) for step in steps)
            with open(record, "w", encoding="utf-8") as file:
                json.dump(seconds, file)
        with open(record, encoding="utf-8") as file:
            return read_mesh(self.path(name + ".vtu")), json.load(file)


def steps_of(label_map, factor):
    """Returns for each mesher the name of its mesh and the steps that make it."""
    scale, f = f"scale-{factor:g}.nrrd", f"{factor:g}"
    ours, mesh3, surface, tetgen = (f"{name}-{f}" for name in ("ours", "mesh3", "surface", "tetgen"))
    return {
        "SurgicalMesher": (ours, [
            ("SimplexMesherCLI", "--scale", scale, "--minimumIslandVolume", ISLAND, "--preparedLabelMap",
             "prepared.nrrd", "--ambient", f"ambient-{f}.vtu", label_map, f"surface-{f}.vtp"),
            ("FuchsTetrahedralizerCLI", "--scale", scale, "--ambient", f"ambient-{f}.vtu", f"surface-{f}.vtp",
             ours + ".vtu")]),
        "CGAL Mesh_3": (mesh3, [
            ("Mesh3Driver", "prepared.nrrd", scale, mesh3 + ".vtu", "--perturb", "--exude", "--facetDistance", f)]),
        "CGAL surface + TetGen": (tetgen, [
            ("Mesh3Driver", "prepared.nrrd", scale, surface + ".vtu", "--facetDistance", f),
            ("TetGenDriver", surface + ".vtu", scale, tetgen + ".vtu")]),
    }


def largest_body(mesh):
    """Returns the largest set of tetrahedra that are connected by faces, with its points renumbered."""
    faces = np.sort(mesh.tetrahedra[:, TETRAHEDRON_FACES].reshape(-1, 3), axis=1)
    owner = np.repeat(np.arange(len(mesh.tetrahedra)), 4)
    order = np.lexsort(faces.T)
    same = np.all(faces[order][1:] == faces[order][:-1], axis=1)
    pairs = owner[order][:-1][same], owner[order][1:][same]
    graph = sparse.coo_matrix((np.ones(len(pairs[0])), pairs), (len(mesh.tetrahedra),) * 2)
    body = connected_components(graph, directed=False)[1]
    kept = body == np.argmax(np.bincount(body))
    used, tetrahedra = np.unique(mesh.tetrahedra[kept], return_inverse=True)
    return SimpleNamespace(points=mesh.points[used], tetrahedra=tetrahedra.reshape(-1, 4), tissue=mesh.tissue[kept])


# ---- a deformation that is known everywhere

def cubes_to_tetrahedra(filled):
    """Returns the indices [i, j, k] of all lattice points, and six positively oriented tetrahedra around the diagonal
    of each filled cube."""
    size = np.array(filled.shape) + 1
    first = np.argwhere(filled)
    tetrahedra = []
    for axes in ((0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2)):
        corners = [first]
        for axis in axes:
            corners.append(corners[-1] + np.eye(3, dtype=int)[axis])
        ids = np.stack([np.ravel_multi_index(corner.T, size) for corner in corners], axis=1)
        even = (axes[0] + 1) % 3 == axes[1]
        tetrahedra.append(ids if even else ids[:, [0, 2, 1, 3]])
    return np.argwhere(np.ones(size, bool)), np.concatenate(tetrahedra)


def synthetic_deformation(labels, affine):
    """Computes displacements (mm) as the weight of the brain would cause them, on a lattice of its own, which no mesher
    is given.

    Returns the displacements at the lattice points, the affine of the lattice, and which of its cubes are filled.
    """
    step = np.maximum(1, np.rint(LATTICE / np.linalg.norm(affine[:3, :3], axis=0))).astype(int)
    lattice = affine @ np.diag([*step, 1.0])
    lattice[:3, 3] = affine[:3, 3] - affine[:3, :3] @ [0.5, 0.5, 0.5]
    padded = np.pad(labels > 0, [(0, -size % s) for size, s in zip(labels.shape, step)])
    blocks = padded.reshape(np.ravel([(n // s, s) for n, s in zip(padded.shape, step)])).mean(axis=(1, 3, 5))
    pieces, _ = ndimage.label(blocks >= 0.5)
    filled = pieces == 1 + np.argmax(np.bincount(pieces.ravel())[1:])
    indices, tetrahedra = cubes_to_tetrahedra(filled)
    points = indices @ lattice[:3, :3].T + lattice[:3, 3]
    if np.linalg.det(lattice[:3, :3]) < 0:
        tetrahedra = tetrahedra[:, [0, 2, 1, 3]]
    used = np.unique(tetrahedra)
    held = points[:, 2] <= np.quantile(points[used, 2], 0.2)  # by the base of the skull
    free = unknowns(used[~held[used]]).ravel()
    force = weight(points, tetrahedra, (0.0, 1.0, 0.0))  # the patient lies on the back
    displacement = np.zeros(3 * len(points))
    displacement[free] = Cholesky(stiffness(points, tetrahedra, 1.0, POISSONS_RATIO)[free][:, free]).solve(force[free])
    displacement *= LARGEST_DISPLACEMENT / np.linalg.norm(displacement.reshape(-1, 3), axis=1).max()
    return displacement.reshape(*(np.array(filled.shape) + 1), 3), lattice, filled


def registration_data(labels, affine):
    """Returns points inside tissue with their displacements: some for the registration, and others to check it."""
    displacement, lattice, filled = synthetic_deformation(labels, affine)
    voxels = np.argwhere(labels > 0)
    positions = voxels @ affine[:3, :3].T + affine[:3, 3]
    cubes = np.floor((positions - lattice[:3, 3]) @ np.linalg.inv(lattice[:3, :3]).T + 1e-9).astype(int)
    positions = positions[filled[tuple(cubes.T)]]
    chosen = np.random.default_rng(0).choice(len(positions), REGISTRATION_POINTS + CHECK_POINTS, replace=False)
    positions = positions[chosen]
    moved = np.stack([interpolated(displacement[..., axis], lattice, positions) for axis in range(3)], axis=1)
    n = REGISTRATION_POINTS
    return SimpleNamespace(points=positions[:n], displacements=moved[:n], check_points=positions[n:],
                           check_displacements=moved[n:])


# ---- measures

def root_mean_square(vectors):
    return float(np.sqrt(np.mean(np.sum(vectors**2, axis=-1))))


def fidelity_of(mesh, reference):
    boundary = boundary_of_mesh(mesh, 0.5)
    outside = around(reference.boundary, 0), around(boundary, 0)
    by_tissue = hausdorff_by_tissue(reference.boundary, boundary, reference.tissues)
    there = [distance for distance in by_tissue.values() if np.isfinite(distance)]
    euler = euler_numbers_of_mesh(mesh)
    euler = np.pad(euler, (0, max(0, len(reference.euler) - len(euler))))[:len(reference.euler)]
    return {
        "hausdorff": float(hausdorff(*outside)),
        "hausdorff95": float(hausdorff(*outside, 0.95)),
        "hausdorffTissuesMean": float(np.mean(there)),
        "hausdorffTissuesWorst": float(np.max(there)),
        "tissuesMissing": len(by_tissue) - len(there),
        "tissuesOfWrongTopology": int(np.sum(euler[reference.tissues] != reference.euler[reference.tissues])),
    }


def registration_of(mesh, data):
    body = largest_body(mesh)
    start = time.process_time()
    equations = system(body, data.points, YOUNGS_MODULUS, POISSONS_RATIO)
    assembled = time.process_time()
    _, iterations = conjugate_gradients(equations.A, equations.H.T @ data.displacements.ravel())
    solved = time.process_time()
    factor = Cholesky(equations.A)
    condition, scaled_condition = condition_numbers(equations.A, factor)
    nodes = registered(equations, factor, data.displacements)
    check = system(body, data.check_points, YOUNGS_MODULUS, POISSONS_RATIO).H
    return {
        "unknowns": equations.A.shape[0],
        "tetrahedraApart": len(mesh.tetrahedra) - len(body.tetrahedra),
        "assemblySeconds": assembled - start,
        "solveSeconds": solved - assembled,
        "iterations": iterations,
        "condition": float(condition),
        "scaledCondition": float(scaled_condition),
        "error": root_mean_square((equations.H @ nodes).reshape(-1, 3) - data.displacements),
        "checkError": root_mean_square((check @ nodes).reshape(-1, 3) - data.check_displacements),
    }


def measured(mesh, seconds, reference):
    smallest = dihedral_angles(mesh).min(axis=1)
    return {"tetrahedra": len(mesh.tetrahedra), "points": len(mesh.points), "meshingSeconds": seconds,
            "smallestDihedral": float(smallest.min()), "meanSmallestDihedral": float(smallest.mean()),
            **fidelity_of(mesh, reference), **registration_of(mesh, reference.registration)}


def compare(runner, label_map, factors):
    """Returns the rows of the table: one per mesher and size, and for the other meshers one more at FINER. A mesher
    that fails has a row without measures."""
    rows, reference = [], None
    for factor in [*factors, FINER * min(factors)]:
        runner.run("SurgicalPathScaleCLI", "--targetPoint", TARGET, "--minimumEdgeLength", factor,
                   "--maximumEdgeLength", 8 * factor, label_map, f"scale-{factor:g}.nrrd")
        for mesher, (name, steps) in steps_of(label_map, factor).items():
            if factor < min(factors) and mesher == "SurgicalMesher":
                continue
            row = {"mesher": mesher, "minimumEdgeLength": factor}
            try:
                mesh, seconds = runner.mesh(name, steps)
                reference = reference or reference_of(runner.path("prepared.nrrd"))
                row.update(measured(mesh, seconds, reference))
            except subprocess.CalledProcessError as failure:
                row["failed"] = f"{os.path.basename(failure.cmd[0])} ended with {failure.returncode}"
            rows.append(row)
            print(json.dumps(row), flush=True)
    return rows


def reference_of(prepared):
    labels, affine = read_nrrd(prepared)
    return SimpleNamespace(boundary=boundary_of_map(labels, affine), tissues=np.setdiff1d(labels, [0]),
                           euler=euler_numbers_of_map(labels), registration=registration_data(labels, affine))


# ---- table and picture

COLUMNS = (
    ("L (mm)", lambda row: f"{row['minimumEdgeLength']:g}..{8 * row['minimumEdgeLength']:g}"),
    ("tetrahedra", lambda row: f"{row['tetrahedra']:,}"),
    ("meshing (s)", lambda row: f"{row['meshingSeconds']:.2g}"),
    ("D_H outside / 95 % of it (mm)", lambda row: f"{row['hausdorff']:.1f} / {row['hausdorff95']:.2f}"),
    ("D_H tissues mean / worst (mm)",
     lambda row: f"{row['hausdorffTissuesMean']:.1f} / {row['hausdorffTissuesWorst']:.1f}"),
    ("tissues missing / wrong", lambda row: f"{row['tissuesMissing']} / {row['tissuesOfWrongTopology']}"),
    ("dihedral min / mean min (°)", lambda row: f"{row['smallestDihedral']:.1f} / {row['meanSmallestDihedral']:.1f}"),
    ("condition / scaled", lambda row: f"{row['condition']:.1e} / {row['scaledCondition']:.1e}"),
    ("assembly (s)", lambda row: f"{row['assemblySeconds']:.2g}"),
    ("solve (s) / iterations", lambda row: f"{row['solveSeconds']:.2g} / {row['iterations']}"),
    ("error given / elsewhere (mm)", lambda row: f"{row['error']:.3f} / {row['checkError']:.3f}"),
)


def table_of(rows):
    lines = ["| mesher | " + " | ".join(title for title, _ in COLUMNS) + " |", "|---" * (1 + len(COLUMNS)) + "|"]
    for mesher in MESHERS:
        for row in sorted(rows, key=lambda row: row["minimumEdgeLength"]):
            if row["mesher"] != mesher:
                continue
            cells = [COLUMNS[0][1](row), row["failed"]] if "failed" in row else [cell(row) for _, cell in COLUMNS]
            lines.append("| " + " | ".join([mesher, *cells]) + " |")
    return "\n".join(lines) + "\n"


# The distances to the map at which meshes of different meshers are compared.
DISTANCES = {"hausdorff95": "95 % of the outer boundary", "hausdorffTissuesMean": "mean over tissues"}


def at_distance(rows, distance, key, wanted):
    """Returns the value of `key` for a mesh at the distance `wanted` (mm), interpolated between `rows` by a power law;
    NaN if all rows are nearer or all are farther."""
    known = sorted((row[distance], row[key]) for row in rows if key in row)
    if len(known) < 2 or not known[0][0] <= wanted <= known[-1][0]:
        return float("nan")
    return float(np.exp(np.interp(np.log(wanted), *np.log(np.transpose(known)))))


def table_at_equal_distance(rows, other="CGAL Mesh_3"):
    """Returns a table of the iterations and condition numbers of our meshes over those that the other mesher's meshes
    would have at the same distance from the map."""
    others = [row for row in rows if row["mesher"] == other]
    titles = [f"D_H, {title} (mm) | iterations | scaled condition number" for title in DISTANCES.values()]
    lines = ["| L (mm) | " + " | ".join(titles) + " |", "|---" * (1 + 3 * len(DISTANCES)) + "|"]
    for row in rows:
        if row["mesher"] != "SurgicalMesher" or "failed" in row:
            continue
        cells = [COLUMNS[0][1](row)]
        for distance in DISTANCES:
            cells.append(f"{row[distance]:.2f}")
            for key in ("iterations", "scaledCondition"):
                there = at_distance(others, distance, key, row[distance])
                cells.append(f"{row[key] / there:.2f}" if there > 0 else "-")
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


PANELS = (
    ("tetrahedra", "tetrahedra", "log"),
    ("hausdorff", "D_H of the outer boundary (mm)", "linear"),
    ("smallestDihedral", "smallest dihedral angle (°)", "linear"),
    ("meanSmallestDihedral", "mean smallest dihedral angle (°)", "linear"),
    ("scaledCondition", "condition, scaled", "log"),
    ("solveSeconds", "solution (s)", "log"),
    ("checkError", "registration error (mm)", "linear"),
    ("meshingSeconds", "meshing (s)", "log"),
)


def draw(rows, file):
    figure, axes = plt.subplots(2, 4, figsize=(13, 6.4), dpi=80)
    for axis, (key, title, scale) in zip(axes.flat, PANELS):
        for mesher, (color, marker) in MESHERS.items():
            done = sorted((row["hausdorffTissuesMean"], row[key]) for row in rows
                          if row["mesher"] == mesher and key in row)
            axis.plot(*np.transpose(done), color=color, marker=marker, label=mesher, linewidth=1.5, clip_on=False)
        axis.set_title(title, fontsize=11, pad=10)
        axis.set_yscale(scale)
        if scale == "linear":
            axis.set_ylim(bottom=0)
        else:
            axis.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
            axis.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:,g}"))
        axis.minorticks_off()
        axis.grid(alpha=0.3)
        axis.spines[["top", "right"]].set_visible(False)
    for axis in axes[1]:
        axis.set_xlabel("mean over tissues of D_H (mm)")
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="upper center", ncol=3, frameon=False)
    figure.tight_layout(rect=(0, 0, 1, 0.94))
    figure.savefig(file)


def write_document(tables, picture):
    """Writes each table between the two marks of its name in Docs/Fitness.md, and copies the picture to Docs/images."""
    page = os.path.join(ROOT, "Docs", "Fitness.md")
    with open(page, encoding="utf-8") as file:
        text = file.read()
    for name, table in tables.items():
        before, _, rest = text.partition(f"<!-- {name} -->\n")
        _, _, after = rest.partition(f"<!-- end of {name} -->\n")
        text = f"{before}<!-- {name} -->\n{table}<!-- end of {name} -->\n{after}"
    with open(page, "w", encoding="utf-8") as file:
        file.write(text)
    with open(picture, "rb") as source, open(os.path.join(ROOT, "Docs", "images", "fitness.png"), "wb") as copy:
        copy.write(source.read())


def write_results(folder, rows):
    with open(os.path.join(folder, "fitness.json"), "w", encoding="utf-8") as file:
        json.dump(rows, file, indent=2)
        file.write("\n")
    with open(os.path.join(folder, "fitness.csv"), "w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, list(dict.fromkeys(key for row in rows for key in row)))
        writer.writeheader()
        writer.writerows(rows)
    with open(os.path.join(folder, "fitness.md"), "w", encoding="utf-8") as file:
        file.write(table_of(rows) + "\n" + table_at_equal_distance(rows))
    draw(rows, os.path.join(folder, "fitness.png"))


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("folder")
    parser.add_argument("--build", default=os.path.join(ROOT, "build"))
    parser.add_argument("--bin")
    parser.add_argument("--map", default="/usr/share/mricron/templates/jhu189.nii.gz")
    parser.add_argument("--scales", default="1,1.5,2,3,4")
    parser.add_argument("--reuse", action="store_true")
    parser.add_argument("--document", action="store_true")
    options = parser.parse_args()
    if not options.bin:
        subprocess.run(["cmake", "--build", options.build, "--target", *PROGRAMS], check=True)
    os.makedirs(options.folder, exist_ok=True)
    programs = os.path.abspath(options.bin or os.path.join(options.build, "bin"))
    runner = Runner(os.path.abspath(options.folder), programs, options.reuse)
    rows = compare(runner, os.path.abspath(options.map), list(map(float, options.scales.split(","))))
    write_results(options.folder, rows)
    print(table_of(rows))
    print(table_at_equal_distance(rows))
    if options.document:
        write_document({"table": table_of(rows), "table at equal distance": table_at_equal_distance(rows)},
                       os.path.join(options.folder, "fitness.png"))


if __name__ == "__main__":
    main()
