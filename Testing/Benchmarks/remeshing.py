#!/usr/bin/python3
"""Measures SurfaceRemesherCLI on surfaces of voxel maps, remeshed to given shares of their triangles.

usage: remeshing.py OUTDIR [--bin BIN] [--image FILE.inr.gz] [--shares 20 10 5]

Contours an image in INRIMAGE format, smoothed by 0.7 voxel (liver.inr.gz of CGAL, in Debian's package libcgal-demo:
tar xzf /usr/share/doc/libcgal-dev/data.tar.gz data/images/liver.inr.gz), or else meshes ten large regions of the JHU
atlas with edges of 0.75 voxel. Remeshes this surface at the edge length for each share (percent), and prints a row of a
table: triangles, angles, variation of edge lengths, distances in both directions in voxels (the cube root of a voxel's
volume), and change of volume.
"""
import argparse
import gzip
import json
import os
import re
import subprocess
import sys

import numpy as np
import vtk
from scipy import ndimage
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path.insert(0, os.path.join(ROOT, "Testing", "Python"))
from maps import cut_out, write_nrrd  # noqa: E402

RANKS = slice(-14, -4)  # of the atlas's regions in ascending order of size: ten large ones, but not the largest four
EDGE_OVER_LENGTH = 0.835  # mean edge length of a remeshed surface over L


def read_inr(file):
    """Reads an INRIMAGE file and returns its voxels [i, j, k] and their sides (mm)."""
    with gzip.open(file, "rb") as stream:
        header = stream.read(256).decode("latin1")
        data = stream.read()
    field = {key: float(value) for key, value in re.findall(r"(\w+)=([\d.]+)", header)}
    size = [int(field[key]) for key in ("XDIM", "YDIM", "ZDIM")]
    return np.frombuffer(data, np.uint8).reshape(size, order="F"), np.array([field[key] for key in ("VX", "VY", "VZ")])


def contour(voxels, sides, file):
    """Writes the largest closed surface between voxels of 0 and others, after smoothing by 0.7 voxel."""
    inside = ndimage.gaussian_filter(np.pad(voxels > 0, 3).astype(np.float32), 0.7)
    image = vtk.vtkImageData()
    image.SetDimensions(inside.shape)
    image.SetSpacing(*sides)
    image.GetPointData().SetScalars(numpy_to_vtk(inside.ravel(order="F"), deep=True))
    edges = vtk.vtkFlyingEdges3D()
    edges.SetInputData(image)
    edges.SetValue(0, 0.5)
    edges.ComputeNormalsOff()
    largest = vtk.vtkPolyDataConnectivityFilter()
    largest.SetInputConnection(edges.GetOutputPort())
    largest.SetExtractionModeToLargestRegion()
    writer = vtk.vtkSTLWriter()
    writer.SetFileTypeToBinary()
    writer.SetInputConnection(largest.GetOutputPort())
    writer.SetFileName(file)
    writer.Write()


def mesh_regions(options, file):
    labels, affine = cut_out(np.s_[0:157, 0:189, 0:136])
    counts = np.bincount(labels.ravel())
    counts[0] = 0
    labels[~np.isin(labels, np.argsort(counts, kind="stable")[RANKS])] = 0
    write_nrrd(os.path.join(options.outdir, "regions.nrrd"), labels, affine)
    subprocess.run([os.path.join(options.bin, "SimplexMesherCLI"), "--quiet", "--edgeLength", "0.75",
                    "--minimumIslandVolume", "30", "--minimumCavityVolume", "30",
                    os.path.join(options.outdir, "regions.nrrd"), file], check=True)


def length_for(file, share):
    """Returns the L (mm) at which a surface of equilateral triangles has `share` percent of the file's triangles."""
    reader = vtk.vtkSTLReader() if file.endswith(".stl") else vtk.vtkXMLPolyDataReader()
    reader.SetFileName(file)
    reader.Update()
    points = vtk_to_numpy(reader.GetOutput().GetPoints().GetData()).astype(float)
    a, b, c = points[vtk_to_numpy(reader.GetOutput().GetPolys().GetConnectivityArray()).reshape(-1, 3)].swapaxes(0, 1)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1).mean() / 2
    return np.sqrt(4 / np.sqrt(3) * area * 100 / share) / EDGE_OVER_LENGTH


def remesh(options, surface, length):
    report = os.path.join(options.outdir, "remeshed.json")
    subprocess.run([os.path.join(options.bin, "SurfaceRemesherCLI"), "--quiet", "--edgeLength", "%.3f" % length,
                    "--report", report, surface, os.path.join(options.outdir, "remeshed-%.2f.vtp" % length)],
                   check=True)
    with open(report) as file:
        return json.load(file)


def row(length, report, voxel):
    before, after = report["original"]["triangles"], report["remeshed"]
    ways = report["toOriginal"], report["fromOriginal"]
    tissues = report["tissues"]
    volumes = max(abs(t["volume"] / t["volumeBefore"] - 1) for t in tissues)
    return "| %.2f | %d | %.1f %% | %.1f | %.1f | %.2f | %.2f, %.2f | %.4f %% |" % (
        length, after["triangles"], 100 * after["triangles"] / before, after["smallestAngle"],
        after["meanSmallestAngle"], after["edgeVariation"], max(way["maximum"] for way in ways) / voxel,
        max(way["mean"] for way in ways) / voxel, 100 * volumes)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("outdir")
    parser.add_argument("--bin", default=os.path.join(ROOT, "build", "bin"))
    parser.add_argument("--image")
    parser.add_argument("--shares", type=float, nargs="+", default=(20, 10, 5))
    options = parser.parse_args()
    os.makedirs(options.outdir, exist_ok=True)
    if options.image:
        surface = os.path.join(options.outdir, "contour.stl")
        voxels, sides = read_inr(options.image)
        contour(voxels, sides, surface)
    else:
        surface, sides = os.path.join(options.outdir, "regions.vtp"), np.ones(3)
        mesh_regions(options, surface)
    print("| L, mm | triangles | of them | angles: least | mean of the least | edges: variation | farthest, mean | volume |")
    print("|---|---|---|---|---|---|---|---|")
    for share in options.shares:
        length = length_for(surface, share)
        print(row(length, remesh(options, surface, length), np.cbrt(np.prod(sides))), flush=True)


if __name__ == "__main__":
    main()
