"""Meshes one body by several meshers, at settings that range from near the surface to far from it."""
import os
import resource
import subprocess
from types import SimpleNamespace

import numpy as np
import vtk
from scipy import ndimage
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray

import cleaver
from brain import blocks_of
from fidelity import boundary_of_map, boundary_of_mesh, boundary_triangles
from lattice import compressed
from maps import write_nrrd
from measures import dihedral_angles
from meshfiles import interpolated, read_mesh

MESHERS = ("ours, ambient", "ours, surface alone", "CGAL Mesh_3", "CGAL surface + TetGen", "compressed lattice",
           cleaver.NAME)


def write_uniform_scale(file, length):
    """Writes a scale volume that has the value `length` (mm) everywhere."""
    header = ("NRRD0005\ntype: float\ndimension: 3\nspace: left-posterior-superior\nsizes: 2 2 2\n"
              "space directions: (1000,0,0) (0,1000,0) (0,0,1000)\nspace origin: (-500,-500,-500)\n"
              "endian: little\nencoding: raw\n\n")
    with open(file, "wb") as stream:
        stream.write(header.encode() + np.full(8, length, "<f4").tobytes())


class Programs:
    """Runs the meshers' programs in a folder and adds up the processor seconds that they take. `cleaver` is the path of
    Cleaver's program, or None."""

    def __init__(self, programs, folder, cleaver_program=None):
        self.programs, self.folder, self.seconds = os.path.abspath(programs), folder, 0.0
        self.cleaver = cleaver_program and os.path.abspath(cleaver_program)

    def path(self, name):
        return os.path.join(self.folder, name)

    def __call__(self, program, *arguments, most=None):
        """Runs a program of the meshers; after `most` processor seconds, SIGXCPU ends it."""
        def limited():
            resource.setrlimit(resource.RLIMIT_CPU, (most, most + 1))
        before = os.times()
        subprocess.run([os.path.join(self.programs, program), *map(str, arguments)], check=True, cwd=self.folder,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, preexec_fn=most and limited)
        after = os.times()
        self.seconds += after.children_user + after.children_system - before.children_user - before.children_system


def ours(run, body, setting, ambient):
    """Meshes the body by our programs. `setting` is (voxel side, edge length) in mm; the surface is made from the body
    on these larger voxels."""
    side, length = setting
    blocks, coarse = blocks_of(body.mask, body.affine, side)
    write_nrrd(run.path("coarse.nrrd"), blocks.astype(np.uint16), coarse)
    beside = ("--ambient", "ambient.vtu") if ambient else ()
    run("SimplexMesherCLI", "--edgeLength", length, *beside, "coarse.nrrd", "surface.vtp")
    run("FuchsTetrahedralizerCLI", "--edgeLength", length, *beside, "surface.vtp", "mesh.vtu")
    return read_mesh(run.path("mesh.vtu"))


def mesh3(run, setting, refined, out):
    """Meshes the body by CGAL Mesh_3. `setting` is (facet distance, edge length) in mm; a mesh that TetGen will refine
    is not improved here."""
    distance, length = setting
    write_uniform_scale(run.path("scale.nrrd"), length)
    run("Mesh3Driver", "body.nrrd", "scale.nrrd", out, *(() if refined else ("--perturb", "--exude")),
        "--facetDistance", distance)


def mesh_by(run, mesher, body, setting):
    """Returns the mesh and its processor seconds. Raises CalledProcessError if the mesher fails."""
    write_nrrd(run.path("body.nrrd"), body.mask.astype(np.uint16), body.affine)
    run.seconds = 0.0
    if mesher.startswith("ours"):
        mesh = ours(run, body, setting, mesher == "ours, ambient")
    elif mesher == "compressed lattice":
        before = os.times()
        side, weight = setting
        mesh = compressed(body.mask, body.affine, body.surface, side, weight)
        after = os.times()
        run.seconds = after.user + after.system - before.user - before.system
    elif mesher == cleaver.NAME:
        rate, features = setting
        mesh = cleaver.mesh_of(run, body.mask.astype(int), body.affine, "-R", rate, "-F", features)
    elif mesher == "CGAL Mesh_3":
        mesh3(run, setting, False, "mesh.vtu")
        mesh = read_mesh(run.path("mesh.vtu"))
    else:
        mesh3(run, setting, True, "complex.vtu")
        run("TetGenDriver", "complex.vtu", "scale.nrrd", "mesh.vtu")
        mesh = read_mesh(run.path("mesh.vtu"))
    return SimpleNamespace(points=mesh.points, tetrahedra=mesh.tetrahedra, tissue=mesh.tissue), run.seconds


def body_of(mask, affine):
    """Returns the body with what distances are measured from: the points of its surface (mm), and the distance of each
    voxel's centre from the surface (voxels, which are 1 mm)."""
    inner, outer = (ndimage.distance_transform_edt(part) for part in (mask, ~mask))
    return SimpleNamespace(mask=mask, affine=affine, surface=boundary_of_map(mask.astype(int), affine).points,
                           distance=np.abs(np.where(mask, 0.5 - inner, outer - 0.5)))


def distances_to_triangles(points, corners, triangles):
    cells, vtk_points, surface = vtk.vtkCellArray(), vtk.vtkPoints(), vtk.vtkPolyData()
    vtk_points.SetData(numpy_to_vtk(np.ascontiguousarray(corners), deep=True))
    cells.SetData(numpy_to_vtkIdTypeArray(np.arange(0, 3 * len(triangles) + 1, 3, dtype=np.int64), deep=True),
                  numpy_to_vtkIdTypeArray(np.ascontiguousarray(triangles, np.int64).ravel(), deep=True))
    surface.SetPoints(vtk_points)
    surface.SetPolys(cells)
    locator = vtk.vtkStaticCellLocator()
    locator.SetDataSet(surface)
    locator.BuildLocator()
    nearest, cell, sub, squared = [0.0] * 3, vtk.reference(0), vtk.reference(0), vtk.reference(0.0)
    result = np.empty(len(points))
    for i, point in enumerate(points):
        locator.FindClosestPoint(point, nearest, cell, sub, squared)
        result[i] = np.sqrt(squared.get())
    return result


def shape_of(mesh, body):
    """Returns sizes, dihedral angles, and the Hausdorff distance (mm) between the surfaces of mesh and body, measured
    from all voxel faces of the body and from points 1 mm apart on the surface of the mesh."""
    smallest = dihedral_angles(mesh).min(axis=1)
    there = interpolated(body.distance, body.affine, boundary_of_mesh(mesh, 1.0).points)
    back = distances_to_triangles(body.surface, mesh.points, boundary_triangles(mesh)[0])
    return {"tetrahedra": len(mesh.tetrahedra), "points": len(mesh.points),
            "hausdorff": float(max(there.max(), back.max())),
            "hausdorff95": float(max(np.quantile(there, 0.95), np.quantile(back, 0.95))),
            "smallestDihedral": float(smallest.min()), "meanSmallestDihedral": float(smallest.mean())}
