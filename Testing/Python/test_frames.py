"""Copies of a map with other axes, and targets in every form, give the same mesh. usage: test_frames.py BIN OUTDIR

The maps are cut out of a real one and written by other code than the project's.
"""
import json
import os
import shutil
import subprocess
import sys
import unittest
from types import SimpleNamespace

import nibabel
import numpy as np
from vtk.util.numpy_support import vtk_to_numpy

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "workflow", "example"))
from maps import LPS_FROM_RAS, cut_out, write_nrrd  # noqa: E402
from measures import signed_volumes  # noqa: E402
from meshfiles import read_dataset, read_mesh  # noqa: E402

BIN, OUTDIR = sys.argv[1:3]
BOX = np.s_[64:90, 92:116, 32:56]
TARGET = np.array([0.0, 8.0, -8.0])  # LPS
ROUNDING = 1e-3  # mm


def turned(labels, affine, axes, flips):
    """The same voxels at the same places, stored along other axes, some of them the other way round."""
    index = np.eye(4)  # from the new indices to the old
    index[:3, :3] = np.eye(3)[:, axes]
    labels = np.transpose(labels, axes)
    for axis in flips:
        index = index @ np.array([[-1.0 if r == c == axis else float(r == c) for c in range(4)] for r in range(4)])
        index[:3, 3] += np.eye(3)[:, axes][:, axis] * (labels.shape[axis] - 1)
        labels = np.flip(labels, axis)
    return labels, affine @ index


def rotation():
    """About 41 degrees around a skew axis."""
    w, x, y, z = np.array([0.93, 0.21, -0.17, 0.25]) / np.linalg.norm([0.93, 0.21, -0.17, 0.25])
    result = np.eye(4)
    result[:3, :3] = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                      [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                      [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    result[:3, 3] = [13, -7, 21]
    return result


def write_nifti(file, labels, affine):
    nibabel.save(nibabel.Nifti1Image(np.ascontiguousarray(labels), LPS_FROM_RAS @ affine), file)


def write_markups(file, point, system):
    if system == "RAS":
        point = LPS_FROM_RAS[:3, :3] @ point
    if file.endswith(".fcsv"):
        line = "p,%.17g,%.17g,%.17g,0,0,0,1,1,1,0,target,,\n" % tuple(point)
        with open(file, "w") as out:
            out.write("# Markups fiducial file version = 4.11\n# CoordinateSystem = %s\n" % system + line)
        return
    with open(file, "w") as out:
        json.dump({"markups": [{"type": "Fiducial", "coordinateSystem": system,
                                "controlPoints": [{"position": list(point)}]}]}, out)


def run(module, *arguments):
    subprocess.run([os.path.join(BIN, module), *arguments], check=True, stdout=subprocess.DEVNULL)


def mesh_of(labels_file, targets_file):
    name = labels_file.split(".")[0]
    scale, surface, ambient, mesh = (name + end for end in ("-scale.nrrd", ".vtp", "-ambient.vtu", ".vtu"))
    run("SurgicalPathScaleCLI", "--targets", targets_file, "--minimumEdgeLength", "1.2", "--maximumEdgeLength", "6",
        "--childRadius", "4", "--decayLength", "10", labels_file, scale)
    run("SimplexMesherCLI", "--scale", scale, "--ambient", ambient, labels_file, surface)
    run("FuchsTetrahedralizerCLI", "--scale", scale, "--ambient", ambient, surface, mesh)
    return read_mesh(mesh)


def surface_of(name):
    surface = read_dataset(name + ".vtp")
    return SimpleNamespace(points=vtk_to_numpy(surface.GetPoints().GetData()).astype(float),
                           triangles=vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3))


def volumes_of(mesh):
    volumes = signed_volumes(mesh)
    return {tissue: volumes[mesh.tissue == tissue].sum() for tissue in np.unique(mesh.tissue)}


class FramesTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(OUTDIR, ignore_errors=True)
        os.makedirs(OUTDIR)
        os.chdir(OUTDIR)
        cls.labels, cls.affine = cut_out(BOX)
        write_nrrd("reference.nrrd", cls.labels, cls.affine)
        write_markups("target.mrk.json", TARGET, "LPS")
        cls.reference = mesh_of("reference.nrrd", "target.mrk.json")

    def assert_same(self, mesh, back=np.eye(4)):
        np.testing.assert_array_equal(mesh.tetrahedra, self.reference.tetrahedra)
        np.testing.assert_array_equal(mesh.tissue, self.reference.tissue)
        points = mesh.points @ back[:3, :3].T + back[:3, 3]
        np.testing.assert_allclose(points, self.reference.points, rtol=0, atol=ROUNDING)

    def test_is_a_mesh_of_many_tissues(self):
        np.testing.assert_array_equal(np.unique(self.reference.tissue), np.setdiff1d(self.labels, [0]))
        self.assertGreater(len(np.unique(self.reference.tissue)), 10)

    def test_storage_order_does_not_matter(self):
        for number, (axes, flips) in enumerate([((2, 0, 1), ()), ((0, 1, 2), (0, 2))]):
            with self.subTest(axes=axes, flips=flips):
                labels, affine = turned(self.labels, self.affine, axes, flips)
                write_nrrd("turned%d.nrrd" % number, labels, affine)
                self.assert_same(mesh_of("turned%d.nrrd" % number, "target.mrk.json"))

    def test_the_frame_of_the_file_does_not_matter(self):
        write_nrrd("ras.nrrd", *turned(self.labels, self.affine, (1, 0, 2), (1,)), "right-anterior-superior")
        self.assert_same(mesh_of("ras.nrrd", "target.mrk.json"))
        write_nifti("nifti.nii.gz", *turned(self.labels, self.affine, (1, 2, 0), (2,)))
        self.assert_same(mesh_of("nifti.nii.gz", "target.mrk.json"))

    def test_a_rotated_map_gives_the_rotated_surface(self):
        # The lattice inside tissues keeps the axes of space, so that inside the tetrahedra are others.
        there = rotation()
        write_markups("rotated.mrk.json", (there @ [*TARGET, 1])[:3], "LPS")
        write_nrrd("rotated.nrrd", self.labels, there @ self.affine)
        write_nrrd("both.nrrd", *turned(self.labels, there @ self.affine, (2, 1, 0), (0, 1)))
        reference = surface_of("reference")
        for name in ("rotated", "both"):
            with self.subTest(name):
                mesh = mesh_of(name + ".nrrd", "rotated.mrk.json")
                surface = surface_of(name)
                back = np.linalg.inv(there)
                np.testing.assert_array_equal(surface.triangles, reference.triangles)
                np.testing.assert_allclose(surface.points @ back[:3, :3].T + back[:3, 3], reference.points, rtol=0,
                                           atol=ROUNDING)
                self.assertEqual(volumes_of(mesh).keys(), volumes_of(self.reference).keys())
                for tissue, volume in volumes_of(self.reference).items():
                    # Of the smallest, 4 and 12 mm^3, all points are the surface's, which gives way where angles and stiff
                    # pairs of vertices ask for it.
                    self.assertAlmostEqual(volumes_of(mesh)[tissue], volume, delta=max(0.02 * volume, 0.7))

    def test_targets_may_come_in_any_form(self):
        for name, system in (("ras.mrk.json", "RAS"), ("lps.fcsv", "LPS"), ("ras.fcsv", "RAS"), ("number.fcsv", "0")):
            with self.subTest(name):
                write_markups(name, LPS_FROM_RAS[:3, :3] @ TARGET if system == "0" else TARGET, system)
                scale = name + ".scale.nrrd"
                run("SurgicalPathScaleCLI", "--targets", name, "--minimumEdgeLength", "1.2", "--maximumEdgeLength", "6",
                    "--childRadius", "4", "--decayLength", "10", "reference.nrrd", scale)
                with open(scale, "rb") as a, open("reference-scale.nrrd", "rb") as b:
                    self.assertEqual(a.read(), b.read())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
