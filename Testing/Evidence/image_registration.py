#!/usr/bin/python3
"""Measures the fitness of meshes for registration, after Chernikov et al., from a T1 to the error at every brain voxel.

usage: image_registration.py BIN OUTDIR [--shifts MM,MM,..] [--cleaver PROGRAM] [--document]

BIN holds SimplexMesherCLI, FuchsTetrahedralizerCLI, Mesh3Driver and TetGenDriver; CalculiX (ccx) has to be on the PATH.
PROGRAM is Cleaver's cleaver-cli, without which its meshes are left out. Docs/Evidence.md describes the experiment.
Every finished part stays in OUTDIR and is not made again; use an empty folder to start afresh. Writes registration.md
(tables), registration.json, registration.png and registration-meshes.png; --document puts tables and pictures into
Docs/.
"""
import argparse
import os
import subprocess
import sys
from types import SimpleNamespace

import numpy as np

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, *folder) for folder in (("workflow", "example"), ("Testing", "Python"),
                                                           ("Testing", "Benchmarks"), ("Testing", "Evidence"))]
import cleaver  # noqa: E402
import hidden_truth  # noqa: E402
import matching  # noqa: E402
import robust  # noqa: E402
from brain import brain, positions_of  # noqa: E402
from brain_meshes import MESHERS, Programs, body_of, mesh_by, shape_of  # noqa: E402
from elasticity import Cholesky, shape_gradients  # noqa: E402
from fitness import largest_body  # noqa: E402
from parts import Parts  # noqa: E402
from registration import condition_numbers, interpolation, nearest_tetrahedra, system  # noqa: E402

BINS = ((15, 16.5), (14, 15.5), (13, 14.5), (8.5, 9.5), (7, 8))  # the paper's intervals of Hausdorff distance, voxels
SHIFTS = (5, 10, 14)  # mm
NOISE = 0.04  # of the brightest voxel
PLANTED, PLANTED_DISTANCE = 0.1, (5, 15)  # share of planted outliers; by how much (mm) they change the displacement
REPETITIONS = 15  # of a registration, to measure the solver's time
# For every mesher, the range of settings extends beyond the settings that are chosen.
LENGTHS = (24, 26, 28, 30, 32, 36, 40, 45, 50, 55, 60, 65, 70, 75, 80)  # mm
OURS = [(side, length) for side in range(3, 13) for length in (*LENGTHS, 34, 38, 42) if 4 <= length / side <= 15]
CGAL = [(share * length, length) for length in LENGTHS for share in (0.1, 0.12, 0.15, 0.17, 0.2, 0.22, 0.25, 0.3, 0.35, 0.4)
        if 3 <= share * length <= 18]
LATTICE = [(side, weight) for side in (16, 18, 20, 22, 24, 27, 30, 33, 36, 40) for weight in (1, 5, 25)]
CLEAVER = [(rate, features) for rate in (0.05, 0.07, 0.1) for features in (0.5, 0.6, 0.7, 0.8, 0.9, 1, 1.2, 1.5, 2)]
SETTINGS = dict(zip(MESHERS, (OURS, OURS, CGAL, CGAL, LATTICE, CLEAVER)))


# ---- images and matches

def shifted(parts, scene, shift):
    """Returns the true displacements at all voxels (mm) for a shift, and the displacements (mm) of the features that
    block matching finds in the deformed image."""
    displacement = hidden_truth.at_all_voxels(scene.hexahedra, scene.shifts[str(shift)], scene.body.shape, scene.affine)
    def make():
        during = hidden_truth.deformed(scene.t1, scene.body, scene.cavity, displacement, scene.affine, NOISE)
        found = matching.match(scene.t1 * scene.body, during, scene.features)
        return {"matched": found @ scene.affine[:3, :3].T}
    return SimpleNamespace(displacement=displacement, matched=parts.arrays(f"matches-{shift}", make)["matched"])


def scene_of(parts, shifts, make_brain=brain):
    scene = SimpleNamespace(**parts.arrays("brain", lambda: vars(make_brain())))
    scene.cavity = hidden_truth.cavity_of(scene.body, scene.affine)
    scene.hexahedra = hidden_truth.hexahedra(scene.body, scene.cavity, scene.affine)
    def truth():
        states = hidden_truth.brain_shifts(parts.folder, scene.hexahedra, shifts)
        return {str(shift): state for shift, state in states.items()}
    scene.shifts = parts.arrays("truth", truth)
    scene.features = parts.arrays("features", lambda: {
        "voxels": matching.features(scene.t1 * scene.body, scene.mask)})["voxels"]
    scene.points = positions_of(scene.features, scene.affine)
    return scene


def matching_quality(scene, shift, during):
    """Returns statistics of the errors (mm) of the matches, without features that were cut out with the cavity."""
    there = ~scene.cavity[tuple(scene.features.T)]
    errors = np.linalg.norm(during.matched - during.displacement[tuple(scene.features.T)], axis=1)[there]
    return {"shift": shift, "points": int(len(there)), "removed": int(np.count_nonzero(~there)),
            "withinVoxel": float(np.mean(errors <= 1)), "median": float(np.median(errors)),
            "quantile95": float(np.quantile(errors, 0.95))}


# ---- meshes and their errors

def tetrahedra_at(points, tetrahedra, voxels, shape, affine):
    """Returns, for each voxel, the tetrahedron that contains its centre or, outside the mesh, the nearest one."""
    at = np.full(shape, -1, np.int32)
    indices = (points - affine[:3, 3]) @ np.linalg.inv(affine[:3, :3]).T
    gradients, _ = shape_gradients(indices, tetrahedra)
    for t, corners in enumerate(indices[tetrahedra]):
        low = np.maximum(np.ceil(corners.min(axis=0)), 0).astype(int)
        high = np.minimum(np.floor(corners.max(axis=0)) + 1, shape).astype(int)
        box = tuple(slice(*ends) for ends in zip(low, high))
        i, j, k = np.ogrid[box]
        inside = True
        for corner, (x, y, z) in enumerate(gradients[t]):
            share = x * (i - corners[0, 0]) + y * (j - corners[0, 1]) + z * (k - corners[0, 2]) + (corner == 0)
            inside = inside & (share >= -1e-9)
        at[box][inside] = t
    result = at[tuple(voxels.T)]
    outside = result < 0
    result[outside] = nearest_tetrahedra(points, tetrahedra, positions_of(voxels[outside], affine))
    return result


def errors_at(mesh, nodes, voxels, at, truth, affine):
    """Returns the distance (mm) between the interpolated and the true displacement at every voxel."""
    gradients, _ = shape_gradients(mesh.points, mesh.tetrahedra)
    result = np.empty(len(voxels))
    for some in np.array_split(np.arange(len(voxels)), 1 + len(voxels) // 200000):
        corners = mesh.tetrahedra[at[some]]
        positions = positions_of(voxels[some], affine)
        shares = np.einsum("pai,pi->pa", gradients[at[some]], positions - mesh.points[corners[:, 0]])
        shares[:, 0] += 1
        found = np.einsum("pa,pai->pi", shares, nodes[corners])
        result[some] = np.linalg.norm(found - truth[tuple(voxels[some].T)], axis=1)
    return result


def brain_voxels(scene, every=1):
    """Returns every `every`-th voxel of the brain that is not in the cavity."""
    return np.argwhere(scene.mask & ~scene.cavity)[::every]


def middle_of(values):
    values = list(values)
    return values[len(values) // 2]


def measured(scene, mesher, setting, run, body, durings):
    """Makes one mesh and returns its shape, its conditioning, the mean errors for each shift (at every 50th voxel), and
    the solver's figures and the error for the middle shift."""
    mesh, seconds = mesh_by(run, mesher, body, setting)
    mesh = largest_body(mesh)
    equations = system(mesh, scene.points, robust.YOUNGS_MODULUS, robust.POISSONS_RATIO)
    condition, scaled = condition_numbers(equations.A, Cholesky(equations.A))
    voxels = brain_voxels(scene, 50)
    h = interpolation(mesh.points, mesh.tetrahedra, positions_of(voxels, scene.affine))
    results = {shift: robust.register(mesh, scene.points, during.matched) for shift, during in durings.items()}
    errors = {str(shift): float(np.linalg.norm((h @ results[shift].nodes.ravel()).reshape(-1, 3)
                                               - during.displacement[tuple(voxels.T)], axis=1).mean())
              for shift, during in durings.items()}
    middle = middle_of(results.values())
    return {"mesher": mesher, "setting": list(setting), "mesherSeconds": seconds, **shape_of(mesh, body),
            "condition": float(condition), "scaledCondition": float(scaled), "iterations": middle.iterations,
            "solverSeconds": middle.seconds, "errors": errors, "error": middle_of(errors.values())}


def name_of(mesher, setting):
    return "mesh-" + "-".join(word.strip(",+") for word in mesher.split()) + "-" + "-".join(f"{x:g}" for x in setting)


def swept(parts, scene, run, body, durings, settings):
    """Returns the records of all settings. If a mesher fails, its record gives the reason."""
    rows = []
    for mesher, each in settings.items():
        for setting in each:
            def make(mesher=mesher, setting=setting):
                try:
                    return measured(scene, mesher, setting, run, body, durings)
                except (subprocess.CalledProcessError, RuntimeError) as failure:
                    return {"mesher": mesher, "setting": list(setting), "failed": str(failure)[-200:]}
            rows.append(parts.record(name_of(mesher, setting), make))
            print({key: value for key, value in rows[-1].items()}, flush=True)
    return rows


def mean_over_shifts(errors):
    return sum(errors.values()) / len(errors)


def chosen(rows, mesher, interval):
    """Chooses a mesher's typical mesh in an interval of Hausdorff distance, as in the paper's second experiment.

    It is the mesh whose mean error over the shifts is the median (the lower of two) of all meshes there. Returns its
    record with the mean errors of all these meshes, in ascending order, or None if there is no mesh."""
    there = [row for row in rows if row["mesher"] == mesher and "failed" not in row
             and interval[0] <= row["hausdorff"] <= interval[1]]
    if not there:
        return None
    ascending = sorted(there, key=lambda row: mean_over_shifts(row["errors"]))
    return {**ascending[(len(there) - 1) // 2], "errorsThere": [mean_over_shifts(row["errors"]) for row in ascending]}


def dense(scene, row, run, body, durings):
    """Makes the chosen mesh again and returns, for each shift, the errors at all brain voxels and the share of planted
    outliers that were rejected."""
    mesh = largest_body(mesh_by(run, row["mesher"], body, row["setting"])[0])
    voxels = brain_voxels(scene)
    at = tetrahedra_at(mesh.points, mesh.tetrahedra, voxels, scene.body.shape, scene.affine)
    results = {}
    for shift, during in durings.items():
        found = robust.register(mesh, scene.points, during.matched)
        errors = errors_at(mesh, found.nodes, voxels, at, during.displacement, scene.affine)
        spoilt, planted = robust.with_outliers(during.matched, PLANTED, *PLANTED_DISTANCE)
        kept = robust.register(mesh, scene.points, spoilt).kept
        results[str(shift)] = {
            "mean": float(errors.mean()), "rootMeanSquare": float(np.sqrt(np.mean(errors**2))),
            "quantile95": float(np.quantile(errors, 0.95)), "largest": float(errors.max()),
            "iterations": found.iterations, "plantedRejected": float(1 - kept[planted].mean())}
    return results


def solver_seconds(meshes, scene, matched):
    """Maps each mesh's name to the median of the solver's processor seconds. The meshes take turns, because the speed
    of the machine varies."""
    seconds = {name: [] for name in meshes}
    for _ in range(REPETITIONS):
        for name, mesh in meshes.items():
            seconds[name].append(robust.register(mesh, scene.points, matched).seconds)
    return {name: float(np.median(each)) for name, each in seconds.items()}


def compared(parts, scene, run, body, durings, rows, bins=BINS):
    """Maps (interval, mesher) to the record of the chosen mesh with the results of `dense` and `solver_seconds`, or to
    None."""
    table = {}
    for interval in bins:
        for mesher in dict.fromkeys(row["mesher"] for row in rows):
            row = chosen(rows, mesher, interval)
            if row:
                def make(row=row):
                    return dense(scene, row, run, body, durings)
                row = {**row, "dense": parts.record("dense-" + name_of(mesher, row["setting"]), make)}
            table[interval, mesher] = row
    def times():
        meshes = {name_of(row["mesher"], row["setting"]): largest_body(mesh_by(run, row["mesher"], body, row["setting"])[0])
                  for row in table.values() if row}
        return solver_seconds(meshes, scene, middle_of(durings.values()).matched)
    seconds = parts.record("solver", times)
    for row in filter(None, table.values()):
        row["solverSeconds"] = seconds[name_of(row["mesher"], row["setting"])]
    return table


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("programs")
    parser.add_argument("folder")
    parser.add_argument("--shifts", default=",".join(map(str, SHIFTS)))
    parser.add_argument("--cleaver")
    parser.add_argument("--document", action="store_true")
    options = parser.parse_args()
    import registration_page  # pylint: disable=import-outside-toplevel  # only this function needs matplotlib
    shifts = [float(word) if "." in word else int(word) for word in options.shifts.split(",")]
    parts = Parts(options.folder)
    scene = scene_of(parts, shifts)
    durings = {shift: shifted(parts, scene, shift) for shift in shifts}
    matches = [matching_quality(scene, shift, during) for shift, during in durings.items()]
    body, run = body_of(scene.body, scene.affine), Programs(options.programs, parts.folder, options.cleaver)
    settings = {mesher: each for mesher, each in SETTINGS.items() if run.cleaver or mesher != cleaver.NAME}
    rows = swept(parts, scene, run, body, durings, settings)
    table = compared(parts, scene, run, body, durings, rows)
    registration_page.write(parts, matches, rows, table, options.document,
                            lambda row: mesh_by(run, row["mesher"], body, row["setting"])[0])


if __name__ == "__main__":
    main()
