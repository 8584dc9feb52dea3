#!/usr/bin/python3
"""Compares ways to make interfaces that neighbouring tissues share, after the paper on meshes of the Virtual Family.

usage: compatible_interfaces.py BIN OUTDIR [--map FILE --groups LABEL=L,L,.. LABEL=..] [--box I:I,J:J,K:K]
           [--edgeLength MM] [--cleaver PROGRAM] [--document]

BIN holds SimplexMesherCLI, FuchsTetrahedralizerCLI, SurfaceRemesherCLI, Mesh3Driver, TetGenDriver and BooleanDriver;
PROGRAM is Cleaver's cleaver-cli, without which its row is left out. The map is jhu189, or FILE (.nii.gz). --groups
joins each group of labels L to one LABEL and drops all other labels; --box takes only a box of the voxels.
Docs/Evidence.md describes the comparison. The results of every finished way stay in OUTDIR and are not made again.
Writes interfaces.md and interfaces.json; --document puts the table into Docs/Evidence.md.
"""
import argparse
import json
import os
import signal
import subprocess
import sys
import time
from types import SimpleNamespace

import nibabel
import numpy as np
import vtk
from scipy import ndimage
from scipy.spatial import cKDTree
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, *folder) for folder in (("workflow", "example"), ("Testing", "Python"),
                                                           ("Testing", "Evidence"))]
import cleaver  # noqa: E402
import document  # noqa: E402
from brain_meshes import Programs, write_uniform_scale  # noqa: E402
from fidelity import boundary_of_map, boundary_of_mesh, boundary_triangles, hausdorff_by_tissue  # noqa: E402
from lattice import lattice_tetrahedra  # noqa: E402
from maps import ATLAS, LPS_FROM_RAS, write_nrrd  # noqa: E402
from measures import (TETRAHEDRON_EDGES, TETRAHEDRON_FACES, components_of_mesh, dihedral_angles,  # noqa: E402
                      euler_numbers_of_map, euler_numbers_of_mesh, signed_volumes)
from meshfiles import cell_array, interpolated, read_dataset, read_mesh, read_nrrd  # noqa: E402
from parts import Parts  # noqa: E402

ISLAND = 30  # mm^3
SMOOTHING = 1.5  # voxels; width of the Gaussian by which `smoothed` smooths a map
PASS_BAND, ITERATIONS = 0.1, 20  # of the windowed sinc filter
OFFSET = 0.2  # voxels by which surfaces are moved outwards so that they overlap
SPIKE = 2  # voxels; a surface point farther than this from the map's boundary counts as a spike
MARGIN = 4  # voxels of background around the tissues


# ---- the ways; each function returns a mesh or raises one of FAILURES

class NoMesh(Exception):
    """The surface that a way made could not be filled with tetrahedra."""


FAILURES = (subprocess.CalledProcessError, NoMesh)


def label_transfer(run, given):
    """Makes a uniform lattice in which each tetrahedron has the label at its centroid."""
    corners = np.array(list(np.ndindex(2, 2, 2))) * (np.array(given.labels.shape) - 1)
    corners = corners @ given.affine[:3, :3].T + given.affine[:3, 3]
    points, tetrahedra = lattice_tetrahedra(corners.min(axis=0), corners.max(axis=0), given.length)
    voxels = np.rint((points[tetrahedra].mean(axis=1) - given.affine[:3, 3]) @ np.linalg.inv(given.affine[:3, :3]).T)
    inside = np.all((voxels >= 0) & (voxels < given.labels.shape), axis=1)
    tissue = np.zeros(len(tetrahedra), int)
    tissue[inside] = given.labels[tuple(voxels[inside].astype(int).T)]
    used, kept = np.unique(tetrahedra[tissue > 0], return_inverse=True)
    return SimpleNamespace(points=points[used], tetrahedra=kept.reshape(-1, 4), tissue=tissue[tissue > 0])


def mesh3(run, given):
    run("Mesh3Driver", "prepared.nrrd", "scale.nrrd", "mesh3.vtu", "--perturb", "--exude")
    return read_mesh(run.path("mesh3.vtu"))


def coated(labels):
    """Returns the map with label 0 in every voxel that touches, across a face, an edge or a corner, a tissue with a
    smaller label, so that no two tissues touch."""
    smallest = ndimage.minimum_filter(np.where(labels > 0, labels, labels.max() + 1), 3)
    return np.where(smallest < labels, 0, labels)


def without(mesh, label):
    others = mesh.tissue != label
    used, kept = np.unique(mesh.tetrahedra[others], return_inverse=True)
    return SimpleNamespace(points=mesh.points[used], tetrahedra=kept.reshape(-1, 4), tissue=mesh.tissue[others])


def background_with_tetgen(run, given):
    """Meshes by Mesh_3 the surface of a background material that coats every tissue, fills this material and the
    tissues by TetGen, and removes the material."""
    surroundings = given.labels.max() + 1
    coat = coated(given.labels)
    write_nrrd(run.path("coat.nrrd"), np.where(coat == 0, surroundings, coat).astype(np.uint16), given.affine)
    run("Mesh3Driver", "coat.nrrd", "scale.nrrd", "coat-complex.vtu")
    run("TetGenDriver", "coat-complex.vtu", "scale.nrrd", "coat-tetgen.vtu")
    return without(read_mesh(run.path("coat-tetgen.vtu")), surroundings)


def background_ours(run, given):
    """Meshes the map with the same background material by our programs with --background."""
    surroundings = int(given.labels.max()) + 1
    write_nrrd(run.path("coat-tissues.nrrd"), coated(given.labels).astype(np.uint16), given.affine)
    run("SimplexMesherCLI", "--edgeLength", given.length, "--minimumIslandVolume", ISLAND, "--background", surroundings,
        "--ambient", "coat-ambient.vtu", "coat-tissues.nrrd", "coat.vtp")
    run("FuchsTetrahedralizerCLI", "--edgeLength", given.length, "--ambient", "coat-ambient.vtu", "coat.vtp", "coat.vtu")
    return without(read_mesh(run.path("coat.vtu")), surroundings)


def smoothed(labels, scale=SMOOTHING):
    """Returns a map in which each voxel has the label, which may be background, with the largest share of its Gaussian
    neighbourhood."""
    best, result = np.zeros(labels.shape, np.float32), np.zeros_like(labels)
    for label in np.unique(labels):
        share = ndimage.gaussian_filter((labels == label).astype(np.float32), scale)
        result[share > best] = label
        best = np.maximum(best, share)
    return result


def marching_cubes(labels, affine):
    """Runs discrete marching cubes on every label and smooths the surface by a windowed sinc filter. Returns corners
    (mm), triangles, and the labels on both sides of each triangle (n, 2); the second is 0 if only one tissue has it."""
    padded = np.pad(labels, 1)
    image = vtk.vtkImageData()
    image.SetDimensions(padded.shape)
    image.SetOrigin(-1, -1, -1)
    image.GetPointData().SetScalars(numpy_to_vtk(padded.astype(np.int32).ravel(order="F"), deep=True))
    cubes = vtk.vtkDiscreteMarchingCubes()
    cubes.SetInputData(image)
    for n, label in enumerate(np.setdiff1d(labels, [0])):
        cubes.SetValue(n, int(label))
    merged = vtk.vtkCleanPolyData()
    merged.SetInputConnection(cubes.GetOutputPort())
    sinc = vtk.vtkWindowedSincPolyDataFilter()
    sinc.SetInputConnection(merged.GetOutputPort())
    sinc.SetNumberOfIterations(ITERATIONS)
    sinc.SetPassBand(PASS_BAND)
    sinc.BoundarySmoothingOn()
    sinc.NonManifoldSmoothingOn()
    sinc.NormalizeCoordinatesOn()
    sinc.Update()
    surface = sinc.GetOutput()
    triangles = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    owner = vtk_to_numpy(surface.GetCellData().GetScalars()).astype(int)
    corners = vtk_to_numpy(surface.GetPoints().GetData()).astype(float) @ affine[:3, :3].T + affine[:3, 3]
    a, b, c = np.moveaxis(corners[triangles], 1, 0)
    if np.sum(np.cross(b, c) * a) < 0:
        triangles = triangles[:, ::-1]  # normals point out of the triangle's first tissue
    keys = np.sort(triangles, axis=1)
    order = np.lexsort(keys.T)
    keys, owner, triangles = keys[order], owner[order], triangles[order]
    same = np.r_[np.all(keys[1:] == keys[:-1], axis=1), False]
    first = ~np.r_[False, same[:-1]]
    return corners, triangles[first], np.column_stack([owner, np.where(same, np.roll(owner, -1), 0)])[first]


def write_surface(file, corners, triangles, sides):
    surface, points, cells = vtk.vtkPolyData(), vtk.vtkPoints(), vtk.vtkCellArray()
    points.SetDataTypeToDouble()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(corners), deep=True))
    for triangle in triangles:
        cells.InsertNextCell(3, triangle.tolist())
    surface.SetPoints(points)
    surface.SetPolys(cells)
    labels = numpy_to_vtk(np.ascontiguousarray(sides, np.int32), deep=True)
    labels.SetName("BoundaryLabels")
    surface.GetCellData().AddArray(labels)
    writer = vtk.vtkXMLPolyDataWriter()
    writer.SetInputData(surface)
    writer.SetFileName(file)
    writer.Write()


def cubes_and_sinc(run, given, labels, name):
    start = time.process_time()
    corners, triangles, sides = marching_cubes(labels, given.raw_affine)
    run.seconds += time.process_time() - start
    given.surfaces[name] = corners, triangles, sides
    write_surface(run.path(name + ".vtp"), corners, triangles, sides)
    run("TetGenDriver", name + ".vtp", "scale.nrrd", name + ".vtu")
    mesh = read_mesh(run.path(name + ".vtu"))
    if not np.all(np.isin(np.setdiff1d(labels, [0]), mesh.tissue)):
        raise NoMesh("TetGen's regions lack tissues")
    return mesh


def cubes_raw(run, given):
    return cubes_and_sinc(run, given, given.raw, "cubes-raw")


def cubes_smoothed(run, given):
    return cubes_and_sinc(run, given, smoothed(given.raw), "cubes-smoothed")


def contour(labels, affine, label, offset, length, file):
    """Writes the closed surface of one tissue: smoothed, about `offset` voxels outside its boundary, and decimated to
    edges of about `length` (voxels) without a change of topology."""
    inside = ndimage.gaussian_filter((np.pad(labels, 3) == label).astype(np.float32), 1)
    image, edges, fewer = vtk.vtkImageData(), vtk.vtkFlyingEdges3D(), vtk.vtkDecimatePro()
    image.SetDimensions(inside.shape)
    image.SetOrigin(-3, -3, -3)
    image.GetPointData().SetScalars(numpy_to_vtk(inside.ravel(order="F"), deep=True))
    edges.SetInputData(image)
    edges.SetValue(0, 0.5 - 0.4 * offset)  # at a plane, the blurred mask falls by 0.4 per voxel
    edges.ComputeNormalsOff()
    fewer.SetInputConnection(edges.GetOutputPort())
    fewer.PreserveTopologyOn()
    fewer.SetTargetReduction(max(0, 1 - 1 / length**2))  # the contour's edges are about a voxel long
    place, moved, writer = vtk.vtkTransform(), vtk.vtkTransformPolyDataFilter(), vtk.vtkSTLWriter()
    place.SetMatrix(affine.ravel().tolist())
    moved.SetInputConnection(fewer.GetOutputPort())
    moved.SetTransform(place)
    writer.SetFileTypeToBinary()
    writer.SetInputConnection(moved.GetOutputPort())
    writer.SetFileName(file)
    writer.Write()


def booleans(run, given):
    """Makes each tissue's decimated surface, a little outside its boundary, joins the surfaces by corefinement,
    remeshes the union between its curves, and fills it by TetGen."""
    bodies = []
    for label in given.tissues:
        contour(given.labels, given.affine, label, OFFSET, given.length / given.voxel, run.path(f"body-{label}.stl"))
        bodies.append(f"{label}=body-{label}.stl")
    run("BooleanDriver", "union.vtp", *bodies)
    given.surfaces["booleans"] = read_surface(run.path("union.vtp"))
    run("SurfaceRemesherCLI", "--edgeLength", given.length, "union.vtp", "union-remeshed.vtp")
    run("TetGenDriver", "union-remeshed.vtp", "scale.nrrd", "union.vtu")
    return read_mesh(run.path("union.vtu"))


def read_surface(file):
    surface = read_dataset(file)
    return (vtk_to_numpy(surface.GetPoints().GetData()).astype(float),
            vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3), cell_array(surface, "BoundaryLabels"))


def by_cleaver(run, given):
    return cleaver.uniform_mesh_of(run, given.labels, given.affine, given.length)


def ours(run, given):
    run("SimplexMesherCLI", "--edgeLength", given.length, "--minimumIslandVolume", ISLAND, "--ambient", "ambient.vtu",
        "map.nrrd", "surface.vtp")
    run("FuchsTetrahedralizerCLI", "--edgeLength", given.length, "--ambient", "ambient.vtu", "surface.vtp", "mesh.vtu")
    return read_mesh(run.path("mesh.vtu"))


# For each way: its function, and the number of parameters that have to be chosen for it.
WAYS = {"label transfer": (label_transfer, 1), "CGAL Mesh_3": (mesh3, 4),
        "background material, Mesh_3 and TetGen": (background_with_tetgen, 4),
        "background material, ours": (background_ours, 2),
        "marching cubes and sinc, raw map": (cubes_raw, 3), "marching cubes and sinc, smoothed map": (cubes_smoothed, 4),
        "offset and booleans": (booleans, 4), cleaver.NAME: (by_cleaver, 2), "ours": (ours, 1)}


def ways_of(run):
    """Returns the names of the ways whose programs are at hand."""
    return [name for name in WAYS if run.cleaver or name != cleaver.NAME]


# ---- measures

def faces_of(mesh):
    """Returns the sorted corners of every tetrahedron's faces, and the tetrahedron of each. A face that two tetrahedra
    share comes twice in succession."""
    faces = np.sort(mesh.tetrahedra[:, TETRAHEDRON_FACES].reshape(-1, 3), axis=1)
    order = np.lexsort(faces.T)
    return faces[order], np.repeat(np.arange(len(mesh.tetrahedra)), 4)[order]


def orthogonality(mesh):
    """Returns, for each inner face, the angle (degrees) between its normal and the line between the centroids of its
    two tetrahedra."""
    faces, owner = faces_of(mesh)
    first = np.flatnonzero(np.all(faces[1:] == faces[:-1], axis=1))
    a, b, c = np.moveaxis(mesh.points[faces[first]], 1, 0)
    normals = np.cross(b - a, c - a)
    middles = mesh.points[mesh.tetrahedra].mean(axis=1)
    lines = middles[owner[first + 1]] - middles[owner[first]]
    cosines = np.abs(np.sum(normals * lines, axis=1)) / np.linalg.norm(normals, axis=1) / np.linalg.norm(lines, axis=1)
    return np.degrees(np.arccos(np.clip(cosines, 0, 1)))


def radius_ratios(mesh):
    """Returns three times the inscribed radius over the circumscribed radius: 1 for a regular tetrahedron."""
    corners = mesh.points[mesh.tetrahedra]
    lengths = np.linalg.norm(corners[:, TETRAHEDRON_EDGES[:, 0]] - corners[:, TETRAHEDRON_EDGES[:, 1]], axis=2)
    p, q, r = (lengths[:, i] * lengths[:, 5 - i] for i in range(3))
    volume = np.abs(signed_volumes(mesh))
    area = sum(np.linalg.norm(np.cross(corners[:, b] - corners[:, a], corners[:, c] - corners[:, a]), axis=1) / 2
               for a, b, c in TETRAHEDRON_FACES)
    circumradius = np.sqrt(np.maximum((p + q + r) * (p + q - r) * (p - q + r) * (q + r - p), 0)) / (24 * volume)
    return 9 * volume / area / np.maximum(circumradius, 1e-300)


def jiggle(corners, triangles, sides):
    """Returns the root mean square angle (degrees) between the normals of neighbouring triangles that separate the same
    two labels."""
    a, b, c = np.moveaxis(corners[triangles], 1, 0)
    normals = np.cross(b - a, c - a)
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    edges = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    owner = np.repeat(np.arange(len(triangles)), 3)
    low, high = np.sort(sides, axis=1).T
    keys = np.column_stack([edges, low[owner], high[owner]])
    order = np.lexsort(keys.T)
    same = np.flatnonzero(np.all(keys[order][1:] == keys[order][:-1], axis=1))
    first, second = owner[order][same], owner[order][same + 1]
    # Two triangles have consistent normals if they pass through their shared edge in opposite directions.
    def forward(triangle, edge):
        at = np.argmax(triangles[triangle] == edge[:, :1], axis=1)
        return triangles[triangle, (at + 1) % 3] == edge[:, 1]
    edge = edges[order][same]
    sign = np.where(forward(first, edge) != forward(second, edge), 1, -1)
    cosines = np.clip(sign * np.sum(normals[first] * normals[second], axis=1), -1, 1)
    return float(np.sqrt(np.mean(np.degrees(np.arccos(cosines)) ** 2)))


def shared_once(triangles, centres, sides, given):
    """Returns the share of triangles that have a tissue on both sides, among those farther than a voxel from the
    outside."""
    within = interpolated(given.depth, given.affine, centres) > 1.5
    return float(np.mean(np.all(sides[within] > 0, axis=1))) if np.any(within) else 1.0


def surface_measures(corners, triangles, sides, given):
    used = np.unique(triangles)
    away = given.tree.query(corners[used], distance_upper_bound=SPIKE * given.voxel)[0]
    return {"triangles": len(triangles), "jiggle": jiggle(corners, triangles, sides),
            "sharedOnce": shared_once(triangles, corners[triangles].mean(axis=1), sides, given),
            "spikes": int(np.count_nonzero(~np.isfinite(away)))}


def volume_measures(mesh, given):
    volumes = np.bincount(mesh.tissue, signed_volumes(mesh), given.labels.max() + 1)
    wanted = np.bincount(given.labels.ravel()) * given.voxel**3
    errors = np.abs(volumes / np.maximum(wanted, 1) - 1)[given.tissues]
    distances = hausdorff_by_tissue(given.boundary, boundary_of_mesh(mesh, 1.0), given.tissues)
    euler, pieces = euler_numbers_of_mesh(mesh), components_of_mesh(mesh)
    wrong = [int(label) for label in given.tissues
             if label >= len(euler) or euler[label] != given.euler[label] or pieces[label] != given.pieces[label]]
    smallest, angles = dihedral_angles(mesh).min(axis=1), orthogonality(mesh)
    return {"tetrahedra": len(mesh.tetrahedra), "smallestDihedral": float(smallest.min()),
            "meanSmallestDihedral": float(smallest.mean()), "radiusRatio": float(radius_ratios(mesh).mean()),
            "volumeMedian": float(np.median(errors)), "volumeWorst": float(errors.max()),
            "hausdorffMean": float(np.mean(list(distances.values()))), "hausdorffWorst": float(max(distances.values())),
            "wrong": wrong, "orthogonalityMean": float(angles.mean()),
            "orthogonality99": float(np.quantile(angles, 0.99))}


def sentence(failure):
    if isinstance(failure, NoMesh):
        return str(failure)
    program = os.path.basename(failure.cmd[0])
    if failure.returncode == -signal.SIGXCPU:
        return f"{program} does not finish in {cleaver.MOST} s"
    return f"{program} ended with {failure.returncode}"


def measured(name, run, given):
    """Returns the row of one way. If the way fails but has left a surface, the row has the measures of that surface."""
    make, parameters = WAYS[name]
    run.seconds, before = 0.0, time.process_time()
    row = {"way": name, "parameters": parameters}
    try:
        mesh = make(run, given)
        row["seconds"] = run.seconds if run.seconds else time.process_time() - before
        triangles, sides = boundary_triangles(mesh)
        row.update(surface_measures(mesh.points, triangles, sides, given), **volume_measures(mesh, given))
    except FAILURES as failure:
        row.update(seconds=run.seconds, failed=sentence(failure))
        left = [surface for key, surface in given.surfaces.items() if key.split("-")[-1] in name]
        if left:
            row.update(surface_measures(*left[0], given))
    return row


# ---- input and output

def tissues_of(options):
    """Returns the raw map, cut to the tissues and a margin, and its affine."""
    image = nibabel.load(options.map)
    labels = np.rint(np.asanyarray(image.dataobj)).astype(int)
    low = np.zeros(3, int)
    if options.box:
        box = tuple(slice(*map(int, ends.split(":"))) for ends in options.box.split(","))
        labels, low = labels[box], np.array([part.start for part in box])
    if options.groups:
        joined = np.zeros_like(labels)
        for group in options.groups:
            name, members = group.split("=")
            joined[np.isin(labels, [int(word) for word in members.split(",")])] = int(name)
        labels = joined
    labels = np.pad(labels, MARGIN)
    first, last = (end(np.argwhere(labels), axis=0) for end in (np.min, np.max))
    affine = LPS_FROM_RAS @ image.affine
    affine[:3, 3] += affine[:3, :3] @ (low + first - 2 * MARGIN)
    return labels[tuple(slice(a - MARGIN, b + MARGIN + 1) for a, b in zip(first, last))], affine


def given_to(run, raw, affine, length):
    """Returns the inputs of all ways and what their results are compared with: the prepared map, and the raw map for
    marching cubes."""
    write_nrrd(run.path("map.nrrd"), raw.astype(np.uint16), affine)
    write_uniform_scale(run.path("scale.nrrd"), length)
    if not os.path.exists(run.path("prepared.nrrd")):
        run("SimplexMesherCLI", "--edgeLength", length, "--minimumIslandVolume", ISLAND, "--preparedLabelMap",
            "prepared.nrrd", "map.nrrd", "unused.vtp")
    raw_affine = affine  # the axes of the prepared map may differ
    labels, affine = read_nrrd(run.path("prepared.nrrd"))
    labels = labels.astype(int)
    boundary, tissues = boundary_of_map(labels, affine), np.setdiff1d(labels, [0])
    pieces = np.zeros(labels.max() + 1, int)
    pieces[tissues] = [ndimage.label(labels == label)[1] for label in tissues]
    return SimpleNamespace(raw=raw, raw_affine=raw_affine, labels=labels, affine=affine, length=length,
                           boundary=boundary, tissues=tissues, tree=cKDTree(boundary.points),
                           depth=ndimage.distance_transform_edt(labels > 0),
                           voxel=abs(np.linalg.det(affine[:3, :3])) ** (1 / 3), pieces=pieces,
                           euler=euler_numbers_of_map(labels), surfaces={})


def cells_of(row):
    def of(key, text):
        return format(row[key], text) if key in row else "-"
    return [row["way"], "no: " + row["failed"] if "failed" in row else "yes", of("tetrahedra", ","),
            f"{of('smallestDihedral', '.1f')} / {of('meanSmallestDihedral', '.1f')}", of("radiusRatio", ".3f"),
            of("sharedOnce", ".1%"), of("jiggle", ".1f"), of("spikes", ","),
            f"{of('hausdorffMean', '.1f')} / {of('hausdorffWorst', '.1f')}",
            f"{of('volumeMedian', '.1%')} / {of('volumeWorst', '.1%')}", len(row["wrong"]) if "wrong" in row else "-",
            f"{of('orthogonalityMean', '.1f')} / {of('orthogonality99', '.1f')}", f"{row['seconds']:.1f}",
            row["parameters"]]


def table_of(rows):
    return document.table(
        ["way", "meshes", "tetrahedra", "dihedral min / mean min (°)", "radius ratio", "faces shared", "jiggle (°)",
         "spikes", "D_H mean / worst (mm)", "volume median / worst", "wrong tissues", "orthogonality mean / 99 % (°)",
         "processor s", "parameters"], [cells_of(row) for row in rows])


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("programs")
    parser.add_argument("folder")
    parser.add_argument("--map", default=ATLAS)
    parser.add_argument("--groups", nargs="+")
    parser.add_argument("--box")
    parser.add_argument("--edgeLength", type=float, default=3)
    parser.add_argument("--cleaver")
    parser.add_argument("--document", action="store_true")
    options = parser.parse_args()
    parts = Parts(options.folder)
    run = Programs(options.programs, parts.folder, options.cleaver)
    given = given_to(run, *tissues_of(options), options.edgeLength)
    rows = []
    for name in ways_of(run):
        file = "way-" + name.replace(" ", "-").replace(",", "")
        rows.append(parts.record(file, lambda name=name: measured(name, run, given)))
        print(rows[-1], flush=True)
    with open(parts.path("interfaces.json"), "w", encoding="utf-8") as file:
        json.dump(rows, file, indent=1)
    with open(parts.path("interfaces.md"), "w", encoding="utf-8") as file:
        file.write(table_of(rows))
    if options.document:
        document.put({"six ways": table_of(rows)})
    print(table_of(rows))


if __name__ == "__main__":
    main()
