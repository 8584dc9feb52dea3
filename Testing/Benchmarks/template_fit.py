#!/usr/bin/python3
"""Fits templates of hexahedra to known persons and prints tables. usage: template_fit.py BIN FACE ICT OUTDIR [TABLE]...

FACE is a folder with newface.node, newface.elem and badinface_adjusted.node (ArtiSynth's face and its adaptation to a
second person), ICT one with neutral.obj.gz and identity003.obj.gz (ICT-FaceKit). TABLE is face, robust, ict, warps,
volumes, muscles, baselines or face_baselines; without any, all tables are printed, each row as soon as it is known.
Seconds are processor seconds of all threads together.
"""
import gzip
import json
import os
import resource
import shutil
import subprocess
import sys

import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
sys.path[:0] = [os.path.join(ROOT, "workflow", "hexahedra")]
import face_shape  # noqa: E402

LANDMARKS = 48
ICT_SHELLS = (0.3, 1.0, 2.0)  # mm
ICT_SKIN = 11248  # number of the vertices of face, head and neck, which come before those of mouth, eyes and teeth
# The vertices (from 0) that are landmarks of ICT's faces, the same in both persons.
ICT_LANDMARKS = [int(word) for word in """
1225 1888 1052 367 1719 1722 2199 1447 966 3661 4390 3927 3924 2608 3272 4088 3443 268 493 1914 2044 1401 3615 4240 4114
2734 2509 978 4527 4942 4857 1140 2075 1147 4269 3360 1507 1542 1537 1528 1518 1511 3742 3751 3756 3721 3725 3732 5708
5695 2081 0 4275 6200 6213 6346 6461 5518 5957 5841 5702 5711 5533 6216 6207 6470 5517 5966""".split()]


# ---- files

def read_nodes(file):
    """Reads an ANSYS file of nodes and maps their ids to positions. Fields are separated by tabs or lie in columns of
    width 8 and 20; missing coordinates are 0."""
    nodes = {}
    with open(file, encoding="ascii") as stream:
        for line in stream:
            words = line.rstrip("\n").split("\t") if "\t" in line else [line[:8], *(line[8 + 20 * i:28 + 20 * i]
                                                                                    for i in range(3))]
            if words[0].strip():
                numbers = [float(word) if word.strip() else 0.0 for word in words[1:4]]
                nodes[int(words[0])] = numbers + [0.0] * (3 - len(numbers))
    return nodes


def read_cells(file, number):
    with open(file, encoding="ascii") as stream:
        rows = [[number[int(line[6 * i:6 * i + 6])] for i in range(8)] for line in stream if line.strip()]
    return [row if len(set(row)) == 8 else [row[i] for i in (0, 1, 2, 4, 5, 6)] for row in rows]


def write_grid(file, points, cells):
    grid = vtk.vtkUnstructuredGrid()
    grid.SetPoints(vtk.vtkPoints())
    grid.GetPoints().SetData(numpy_to_vtk(np.ascontiguousarray(points, float), deep=True))
    kinds = {8: vtk.VTK_HEXAHEDRON, 6: vtk.VTK_WEDGE}
    for cell in cells:
        ids = cell if len(cell) == 8 else [cell[i] for i in (0, 2, 1, 3, 5, 4)]  # VTK's order of a wedge's nodes
        grid.InsertNextCell(kinds[len(cell)], len(cell), ids)
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetFileName(file)
    writer.Write()


def read_points(file):
    reader = vtk.vtkXMLUnstructuredGridReader() if file.endswith(".vtu") else vtk.vtkXMLPolyDataReader()
    reader.SetFileName(file)
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPoints().GetData()).astype(float)


def write_landmarks(file, points):
    face_shape.write_landmarks(file, {f"L{i}": point for i, point in enumerate(points)})


# ---- meshes

HEXAHEDRON = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
WEDGE = [(0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)]


def outer_triangles(cells):
    faces = {}
    for cell in cells:
        for side in HEXAHEDRON if len(cell) == 8 else WEDGE:
            face = [cell[i] for i in side]
            faces.setdefault(tuple(sorted(face)), []).append(face)
    single = [found[0] for found in faces.values() if len(found) == 1]
    return np.array([[face[0], face[i - 1], face[i]] for face in single for i in range(2, len(face))])


def farthest(points, candidates, first, count):
    chosen = [first]
    distance = np.full(len(candidates), np.inf)
    while len(chosen) < count:
        distance = np.minimum(distance, np.linalg.norm(points[candidates] - points[chosen[-1]], axis=1))
        chosen.append(candidates[distance.argmax()])
    return np.array(chosen)


class Face:
    """ArtiSynth's face and its adaptation to a second person (mm), with nodes that serve as landmarks."""

    def __init__(self, folder):
        first = read_nodes(os.path.join(folder, "newface.node"))
        second = read_nodes(os.path.join(folder, "badinface_adjusted.node"))
        self.cells = read_cells(os.path.join(folder, "newface.elem"), {node: i for i, node in enumerate(first)})
        self.points = np.array(list(first.values()))
        self.other = 1000 * np.array([second[node] for node in first])
        self.triangles = outer_triangles(self.cells)
        surface = np.unique(self.triangles)
        self.landmarks = farthest(self.points, surface, surface[0], LANDMARKS)


# ---- runs

def fit(folder, name, template, target, pairs, *options):
    """Runs TemplateFitCLI with `pairs` (landmarks of the template, of the target). Returns its report, processor
    seconds and the name of the fitted file or, if it fails, None, processor seconds and the error message."""
    at = lambda suffix: os.path.join(folder, name + suffix)  # noqa: E731
    write_landmarks(at(".a.fcsv"), pairs[0])
    write_landmarks(at(".b.fcsv"), pairs[1])
    fitted = at(".fitted" + os.path.splitext(template)[1].replace(".obj", ".vtp"))
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([os.path.join(BIN, "TemplateFitCLI"), "--landmarks", at(".a.fcsv"), "--landmarks",
                           at(".b.fcsv"), "--report", at(".json"), *options, template, target, fitted],
                          stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    if done.returncode:
        return None, seconds, done.stderr.strip()
    with open(at(".json"), encoding="utf-8") as report:
        return json.load(report), seconds, fitted


def line_of(report, stage="fitted"):
    """Returns a line with numbers of invalid elements, smallest and mean scaled Jacobians, and distances."""
    shapes, distances = report["quality"][stage], report["distances"][stage]
    worst = "/".join("%.3f" % shape["minimumScaledJacobian"] for shape in shapes.values())
    invalid = "/".join(str(shape["invalid"]) for shape in shapes.values())
    mean = "/".join("%.3f" % shape["meanScaledJacobian"] for shape in list(shapes.values())[:1])
    there, back = distances["fittedToTarget"], distances["targetToFitted"]
    return (f"{invalid:8}{worst:14}{mean:7}{there['mean']:6.3f}/{there['percentile95']:5.3f}"
            f"{back['mean']:7.3f}/{back['percentile95']:5.3f}")


HEAD = f"{'':26}{'invalid':8}{'min SJ':14}{'mean':7}{'to target':13}{'from target':13}landmarks  others  seconds"


def print_row(name, result, truth, others):
    report, seconds, fitted = result
    if report is None:
        print(f"{name:26}{fitted}", flush=True)
        return
    largest = max(landmark["residual"] for landmark in report["landmarks"])
    error = np.linalg.norm(read_points(fitted) - truth, axis=1)[others]
    print(f"{name:26}{line_of(report)}  {largest:7.3f}{error.mean():9.3f}{seconds:8.1f}", flush=True)


def face_table(folder, face):
    print("\nThe face to its second person, and back\n" + HEAD)
    others = np.setdiff1d(np.arange(len(face.points)), face.landmarks)
    write_grid(os.path.join(folder, "first.vtu"), face.points, face.cells)
    write_grid(os.path.join(folder, "second.vtu"), face.other, face.cells)
    ways = (("forth", "first.vtu", "second.vtu", face.points, face.other),
            ("back", "second.vtu", "first.vtu", face.other, face.points))
    for name, template, target, source, truth in ways:
        result = fit(folder, name, os.path.join(folder, template), os.path.join(folder, target),
                     (source[face.landmarks], truth[face.landmarks]))
        print_row(name, result, truth, others)
        if result[0]:
            print(f"{'  the spline alone':26}{line_of(result[0], 'spline')}", flush=True)


def robust_table(folder, face):
    for way, source, truth in (("Forth", face.points, face.other), ("Back", face.other, face.points)):
        print(f"\n{way}, with less to go by\n" + HEAD)
        robust_rows(folder, face, source, truth)


def robust_rows(folder, face, source, truth):
    others = np.setdiff1d(np.arange(len(source)), face.landmarks)
    template, whole = os.path.join(folder, "template.vtu"), os.path.join(folder, "whole.vtp")
    write_grid(template, source, face.cells)
    face_shape.write_surface(whole, truth, face.triangles)
    height = face.points[face.triangles].mean(axis=1)[:, 2]
    cut = os.path.join(folder, "cut.vtp")
    face_shape.write_surface(cut, truth, face.triangles[height < np.percentile(height, 85)])
    random = np.random.default_rng(1)
    turned = face.triangles.copy()
    chosen = random.random(len(turned)) < 1 / 3
    turned[chosen] = turned[chosen][:, ::-1]
    face_shape.write_surface(os.path.join(folder, "turned.vtp"), truth, turned)
    nodes = face.landmarks
    noise = random.normal(0, 1 / np.sqrt(3), (len(nodes), 3))
    rows = (("as it is", whole, nodes, 0, ()),
            ("every second landmark", whole, nodes[::2], 0, ()),
            ("1 mm noise on landmarks", whole, nodes, noise, ("--landmarkWeight", "1")),
            ("cut at the hairline", cut, nodes, 0, ()),
            ("a third turned", os.path.join(folder, "turned.vtp"), nodes, 0, ()))
    for name, target, some, error, options in rows:
        pairs = (source[some], truth[some] + error)
        print_row(name, fit(folder, "robust", template, target, pairs, *options), truth, others)


# ---- ICT's faces

def read_obj(file):
    with gzip.open(file, "rt", encoding="ascii") as stream:
        rows = [line.split() for line in stream if line[:2] in ("v ", "f ")]
    points = np.array([[float(word) for word in row[1:4]] for row in rows if row[0] == "v"])
    return points, [[int(word.split("/")[0]) - 1 for word in row[1:]] for row in rows if row[0] == "f"]


def triangle_normals(points, triangles):
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return np.cross(b - a, c - a)


def ict_table(folder, source):
    print("\nICT's neutral face to identity003, 68 landmarks, mm")
    for name in ("neutral", "identity003"):
        with gzip.open(os.path.join(source, name + ".obj.gz")) as packed, open(
                os.path.join(folder, name + ".obj"), "wb") as plain:
            shutil.copyfileobj(packed, plain)
    points, faces = read_obj(os.path.join(source, "neutral.obj.gz"))
    truth, _ = read_obj(os.path.join(source, "identity003.obj.gz"))
    triangles = np.array([[face[0], face[i - 1], face[i]] for face in faces for i in range(2, len(face))])
    at = lambda name: os.path.join(folder, name)  # noqa: E731
    marks, units = points[ICT_LANDMARKS], ("--templateUnit", "cm", "--targetUnit", "cm", "--carry")
    skin = [face for face in faces if max(face) < ICT_SKIN]
    shells = []
    for thickness in ICT_SHELLS:
        shell(at(f"offset{thickness}.vtu"), points[:ICT_SKIN], skin, thickness)
        shells.append(at(f"offset{thickness}.vtu"))
    fit(folder, "itself", at("neutral.obj"), at("neutral.obj"), (marks, marks), "--iterations", "1", *units,
        ",".join(shells))
    for thickness in ICT_SHELLS:
        os.replace(at(f"itself.fitted.offset{thickness}.vtu"), at(f"shell{thickness}.vtu"))
    report, seconds, fitted = fit(folder, "ict", at("neutral.obj"), at("identity003.obj"),
                                  (marks, truth[ICT_LANDMARKS]), *units,
                                  ",".join(at(f"shell{thickness}.vtu") for thickness in ICT_SHELLS))
    if report is None:
        print(fitted)
        return
    result = read_points(fitted)
    for name in ("spline", "fitted"):
        print(f"{name + ' to target, mean':32}{report['distances'][name]['fittedToTarget']['mean']:8.3f}")
    error = 10 * np.linalg.norm(result - truth, axis=1)
    print(f"{'points to their true place':32}{error.mean():8.3f}, 95 % {np.percentile(error, 95):.3f}, "
          f"largest {error.max():.3f}")
    against = lambda a, b: np.count_nonzero((triangle_normals(a, triangles)  # noqa: E731
                                             * triangle_normals(b, triangles)).sum(axis=1) <= 0)
    print(f"{'triangles turned against truth':32}{against(result, truth):8d}")
    print(f"{'the truth against the source':32}{against(truth, points):8d}")
    for thickness in ICT_SHELLS:
        for name, file in ((f"shell of {thickness} mm, as offset", f"offset{thickness}.vtu"),
                           ("  made valid where it lies", f"shell{thickness}.vtu"),
                           ("  carried to identity003", f"ict.fitted.shell{thickness}.vtu")):
            invalid = invalid_hexahedra(at(file))
            print(f"{name:32}{invalid.sum():8d} invalid of {len(invalid)} hexahedra")
        before, after = (read_points(at(f"{name}{thickness}.vtu")) for name in ("offset", "shell"))
        moved = 10 * np.linalg.norm(after - before, axis=1)
        print(f"{'  moved to be made valid, mm':32}{moved.mean():8.4f}, largest {moved.max():.3f}")
    print(f"{'seconds':32}{seconds:8.1f}", flush=True)


def least_jacobian(points, cells):
    """Returns the least scaled Jacobian over the corners of each hexahedron."""
    corners = [(0, 1, 3, 4), (1, 2, 0, 5), (2, 3, 1, 6), (3, 0, 2, 7),
               (4, 7, 5, 0), (5, 4, 6, 1), (6, 5, 7, 2), (7, 6, 4, 3)]
    least = np.ones(len(cells))
    for node, *ends in corners:
        edges = [points[cells[:, end]] - points[cells[:, node]] for end in ends]
        edges = [edge / np.maximum(np.linalg.norm(edge, axis=1, keepdims=True), 1e-30) for edge in edges]
        least = np.minimum(least, (np.cross(edges[0], edges[1]) * edges[2]).sum(axis=1))
    return least


def directions(points, quads):
    """Returns a unit vector for each point that makes an acute angle with the normals of all corners around the point,
    if there is such a vector, and the least cosine of these angles."""
    normals = []
    for i in range(4):
        a, b, c = points[quads[:, i]], points[quads[:, (i + 1) % 4]], points[quads[:, i - 1]]
        normal = np.cross(b - a, c - a)
        normals.append(normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-30))
    normals, weights = np.stack(normals, axis=1), np.ones(quads.shape)
    for _ in range(60):
        result = np.zeros_like(points)
        for i in range(4):
            np.add.at(result, quads[:, i], weights[:, i, None] * normals[:, i])
        result /= np.maximum(np.linalg.norm(result, axis=1, keepdims=True), 1e-12)
        seen = (normals * result[quads]).sum(axis=2)
        weights *= np.exp(1 - seen)  # normals at large angles gain weight
        weights /= weights.max()
    least = np.ones(len(points))
    np.minimum.at(least, quads.ravel(), seen.ravel())
    return result, least


def shell(file, points, faces, thickness):
    """Writes a shell that has one hexahedron inside each face of the skin, and is thinner where the skin bends too
    sharply. `points` are in cm, `thickness` is in mm."""
    quads, points = np.array(faces), 10 * points
    normals, seen = directions(points, quads)
    edges = np.concatenate([quads[:, [i, (i + 1) % 4]] for i in range(4)])
    depth = np.full(len(points), thickness)
    cells = np.concatenate([quads, quads + len(points)], axis=1)
    for _ in range(12):
        both = np.concatenate([points - depth[:, None] * normals, points])
        bad = np.unique(quads[least_jacobian(both, cells) < 0.1])
        depth[bad] = np.maximum(depth[bad] / 2, np.where(seen[bad] > 0, 0.02, 0.1))  # thinning cannot repair a fold
        for _ in range(8):  # neighbouring points differ in depth by a factor of at most 1.5
            limit = depth.copy()
            np.minimum.at(limit, edges[:, 0], 1.5 * depth[edges[:, 1]])
            np.minimum.at(limit, edges[:, 1], 1.5 * depth[edges[:, 0]])
            depth = limit
    write_grid(file, both / 10, cells.tolist())


def invalid_hexahedra(file):
    """Returns for each hexahedron whether it is invalid. Wedges are left out, because VTK has no measure for them."""
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(file)
    quality = vtk.vtkMeshQuality()
    quality.SetInputConnection(reader.GetOutputPort())
    quality.SetHexQualityMeasureToScaledJacobian()
    quality.Update()
    data = quality.GetOutput()
    kinds = np.array([data.GetCellType(i) for i in range(data.GetNumberOfCells())])
    values = vtk_to_numpy(data.GetCellData().GetArray("Quality"))[kinds == vtk.VTK_HEXAHEDRON]
    return values <= 0


# ---- known warps

def smooth_warp(random, size, points):
    """Returns a map, the sum of a few Gaussians with a width of 40 mm, whose largest displacement of `points` is `size`
    mm."""
    low, high = points.min(axis=0), points.max(axis=0)
    centres, turns = random.uniform(low, high, (6, 3)), random.normal(size=(6, 3))

    def displacement(at):
        weight = np.exp(-((at[:, None] - centres) ** 2).sum(axis=2) / (2 * 40 ** 2))
        return weight @ turns
    scale = size / np.linalg.norm(displacement(points), axis=1).max()
    return lambda at: at + scale * displacement(at)


def folding_warp(random, points, landmarks):
    """Returns a smooth warp of 20 mm with waves, 12 mm wide, around three random landmarks, which nearly fold."""
    smooth = smooth_warp(random, 20, points)
    centres = points[random.choice(landmarks, 3, replace=False)]

    def warp(at):
        moved = smooth(at)
        for centre in centres:
            offset = at - centre
            near = np.exp(-(offset ** 2).sum(axis=1) / (2 * 12 ** 2))
            moved[:, 2] += 0.8 * 12 * near * np.sin(offset[:, 2] / 12)
        return moved
    return warp


def warps_table(folder, face):
    print("\nKnown warps of the face, landmarks with 1 mm noise\n" + HEAD)
    template = os.path.join(folder, "first.vtu")
    write_grid(template, face.points, face.cells)
    found = {"smooth, 5 to 15 mm": [], "20 mm, folds": []}
    for i in range(40):
        random = np.random.default_rng(100 + i)
        size = 5 + 10 * i / 29
        warp = smooth_warp(random, size, face.points) if i < 30 else folding_warp(random, face.points, face.landmarks)
        truth = warp(face.points)
        target = os.path.join(folder, "warped.vtp")
        face_shape.write_surface(target, truth, face.triangles)
        noisy = truth[face.landmarks] + random.normal(0, 1 / np.sqrt(3), (LANDMARKS, 3))
        result = fit(folder, "warp", template, target, (face.points[face.landmarks], noisy), "--landmarkWeight", "1")
        print_row(f"{min(size, 20):.1f} mm" if i < 30 else "20 mm, folds", result, truth, slice(None))
        if result[0]:
            print(f"{'  the spline alone':26}{line_of(result[0], 'spline')}", flush=True)
            error = np.linalg.norm(read_points(result[2]) - truth, axis=1).mean()
            found[list(found)[i >= 30]].append((result[0], error))
    for (name, rows), count in zip(found.items(), (30, 10)):
        print_summary(name, rows, count)


def print_summary(name, rows, count):
    """Prints a row of the page's table: numbers of runs, of refused runs, and of runs with an invalid element (fitted,
    spline alone); least scaled Jacobian; error against the truth (least, mean, largest, mm) and how often it is above
    0.9 mm; distance (fitted, spline, mm)."""
    if not rows:
        return
    reports, errors = [row[0] for row in rows], np.array([row[1] for row in rows])
    invalid = {stage: sum(any(shape["invalid"] for shape in report["quality"][stage].values()) for report in reports)
               for stage in ("spline", "fitted")}
    least = min(shape["minimumScaledJacobian"] for report in reports for shape in report["quality"]["fitted"].values())
    there = {stage: np.mean([report["distances"][stage]["fittedToTarget"]["mean"] for report in reports])
             for stage in ("spline", "fitted")}
    print(f"| {name} | {count} | {count - len(rows)} | {invalid['fitted']}, {invalid['spline']} | {least:.3f} | "
          f"{errors.min():.3f}, {errors.mean():.3f}, {errors.max():.3f} | {np.sum(errors > 0.9)} | "
          f"{there['fitted']:.3f}, {there['spline']:.3f} |", flush=True)


# ---- hexahedra by volumetric parameterisation

DIVISIONS = ("48,5,48", "78,8,78", "118,8,116")


def opposite_sides(cell):
    """Maps each side of an element to the opposite side, as indices into HEXAHEDRON or WEDGE. The quadrilaterals of a
    wedge have no opposite side."""
    return {0: 1, 1: 0, 2: 4, 4: 2, 3: 5, 5: 3} if len(cell) == 8 else {0: 1, 1: 0}


def depths(cells):
    """Yields, for each outer face, the face and the number of elements from there through the slab to the other side,
    or 0 if the way ends at a quadrilateral of a wedge."""
    sides = [[tuple(cell[i] for i in side) for side in (HEXAHEDRON if len(cell) == 8 else WEDGE)] for cell in cells]
    at = {}
    for element, faces in enumerate(sides):
        for number, face in enumerate(faces):
            at.setdefault(frozenset(face), []).append((element, number))
    for key, found in at.items():
        if len(found) > 1:
            continue
        (element, number), = found
        first, depth = sides[element][number], 1
        while depth and depth < 500:
            across = opposite_sides(cells[element]).get(number)
            if across is None:
                depth = 0
                break
            beyond = [next_ for next_ in at[frozenset(sides[element][across])] if next_[0] != element]
            if not beyond:
                break
            (element, number), = beyond
            depth += 1
        yield first, depth


def connected(faces):
    """Returns the faces in groups that are connected by common nodes."""
    parent = {}

    def root(node):
        while parent.setdefault(node, node) != node:
            node = parent[node]
        return node
    for face in faces:
        for node in face[1:]:
            parent[root(node)] = root(face[0])
    groups = {}
    for face in faces:
        groups.setdefault(root(face[0]), []).append(face)
    return list(groups.values())


def painted_sides(face):
    """Returns the triangles of the boundary and the Side of each (see face_shape). Skin and inner side are those faces
    that are three elements apart; the other sides follow from the coordinates of newface."""
    outer = list(depths(face.cells))
    sheets = connected([nodes for nodes, depth in outer if depth == 3])
    skin = max(sheets, key=lambda sheet: np.mean([face.points[list(nodes)].mean(axis=0)[1] for nodes in sheet]))
    skin = set(skin)
    walls = connected([nodes for nodes, depth in outer if depth != 3])
    rim = set(max(walls, key=len))
    triangles, sides = [], []
    for nodes, depth in outer:
        x, _, z = face.points[list(nodes)].mean(axis=0)
        around = 6 if z > -3 else 5 if z < -104 else 3 if x < 0 else 4
        side = (1 if nodes in skin else 2) if depth == 3 else around if nodes in rim else 0
        for i in range(2, len(nodes)):
            triangles.append([nodes[0], nodes[i - 1], nodes[i]])
            sides.append(side)
    return np.array(triangles), np.array(sides)


def volumes_table(folder, face):
    print("\nHexahedra of both faces' volumes by VolumetricHexCLI; distances are means, mm"
          f"\n{'':8}{'divisions':12}{'elements':>9}{'invalid':>8}{'min SJ':>8}{'mean':>7}{'skew':>7}{'to skin':>9}"
          f"{'from skin':>10}{'seconds':>9}")
    triangles, sides = painted_sides(face)
    for name, points in (("first", face.points), ("second", face.other)):
        surface, made = os.path.join(folder, name + ".sides.vtp"), os.path.join(folder, name)
        face_shape.write_surface(surface, points, triangles, sides)
        for divisions in DIVISIONS:
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            done = subprocess.run([os.path.join(BIN, "VolumetricHexCLI"), "--divisions", divisions, "--report",
                                   made + ".json", surface, surface, f"{made}.{divisions}.vtu"],
                                  stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            if done.returncode:
                print(f"{name:8}{divisions:12}{done.stderr.strip()}")
                continue
            with open(made + ".json", encoding="utf-8") as file:
                report = json.load(file)
            seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
            print(f"{name:8}{divisions:12}{report['elements']:9d}{report['invalid']:8d}"
                  f"{report['minimumScaledJacobian']:8.3f}{report['meanScaledJacobian']:7.3f}"
                  f"{report['meanShapeSkew']:7.3f}{report['meshToSkin']['mean']:9.3f}"
                  f"{report['skinToMesh']['mean']:10.3f}{seconds:9.1f}", flush=True)


# ---- muscles

def inside(points, surface):
    data = vtk.vtkPolyData()
    data.SetPoints(vtk.vtkPoints())
    data.GetPoints().SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    select = vtk.vtkSelectEnclosedPoints()
    select.SetInputData(data)
    select.SetSurfaceData(surface)
    select.Update()
    return vtk_to_numpy(select.GetOutput().GetPointData().GetArray("SelectedPoints")) != 0


def surface_of(points, triangles):
    data = vtk.vtkPolyData()
    data.SetPoints(vtk.vtkPoints())
    data.GetPoints().SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    cells = vtk.vtkCellArray()
    for triangle in triangles:
        cells.InsertNextCell(3, [int(i) for i in triangle])
    data.SetPolys(cells)
    return data


def samples_of(file):
    """Returns eight points in each hexahedron, the volume that each of its points stands for, and the labels of the
    hexahedra."""
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(file)
    reader.Update()
    grid = reader.GetOutput()
    corners = vtk_to_numpy(grid.GetPoints().GetData())[
        vtk_to_numpy(grid.GetCells().GetConnectivityArray()).reshape(-1, 8)]
    places = np.array([[x, y, z] for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))])
    at = 0.25 + 0.5 * places
    weight = np.where(places[None] == 1, at[:, None], 1 - at[:, None]).prod(axis=2)
    size = vtk.vtkCellSizeFilter()
    size.SetInputData(grid)
    size.Update()
    volume = np.abs(vtk_to_numpy(size.GetOutput().GetCellData().GetArray("Volume")))
    return weight @ corners, volume / 8, vtk_to_numpy(grid.GetCellData().GetArray("TissueLabel"))


def muscles_table(folder):
    print("\nThe project's own face, muscles carried to known warps (5 to 15 mm, landmarks with 1 mm noise), and hexahedra"
          "\nof the new volume classified by them, against the true muscles")
    print(f"{'':16}{'divisions':12}{'invalid':>8}{'mean SJ':>9}{'skew':>7}{'to skin':>9}{'recall':>8}{'precision':>10}")
    points, triangles, sides = face_shape.envelope()
    at = lambda name: os.path.join(folder, name)  # noqa: E731
    template = os.path.join(ROOT, "TemplateHexMesher", "Template", "face.vtu")
    marks = np.array(list(face_shape.landmarks().values()))
    muscles = face_shape.muscles()
    face_shape.write_surface(at("sides.vtp"), points, triangles, sides)
    for name, surface in muscles.items():
        face_shape.write_surface(at(name + ".vtp"), *surface)
    for i, size in enumerate((5, 10, 15)):
        random = np.random.default_rng(200 + i)
        warp = smooth_warp(random, size, points)
        face_shape.write_surface(at("person.vtp"), warp(points), triangles)
        carry = [word for name in ("sides", *muscles) for word in ("--carry", at(name + ".vtp"))]
        noisy = warp(marks) + random.normal(0, 1 / np.sqrt(3), marks.shape)
        report, _, fitted = fit(folder, "muscles", template, at("person.vtp"), (marks, noisy), "--landmarkWeight", "1",
                                *carry)
        if report is None:
            print(f"{size:2d} mm           {fitted}")
            continue
        for divisions in DIVISIONS:
            parts = [word for name in muscles for word in ("--parts", at(f"muscles.fitted.{name}.vtu"))]
            done = subprocess.run([os.path.join(BIN, "VolumetricHexCLI"), "--divisions", divisions, *parts, "--report",
                                   at("hex.json"), at("person.vtp"), at("muscles.fitted.sides.vtu"), at("hex.vtu")],
                                  stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, check=False)
            if done.returncode:
                print(f"{size:2d} mm{'':11}{divisions:12}{done.stderr.strip()}")
                continue
            with open(at("hex.json"), encoding="utf-8") as file:
                made = json.load(file)
            places, volume, labels = samples_of(at("hex.vtu"))
            true = np.zeros(places.shape[:2], bool)
            for muscle in muscles.values():
                true |= inside(places.reshape(-1, 3), surface_of(warp(muscle[0]), muscle[1])).reshape(true.shape)
            both = (volume * true.sum(axis=1))[labels > 1].sum()
            recall, precision = both / (volume * true.sum(axis=1)).sum(), both / (8 * volume[labels > 1]).sum()
            print(f"{size:2d} mm{'':11}{divisions:12}{made['invalid']:8d}{made['meanScaledJacobian']:9.3f}"
                  f"{made['meanShapeSkew']:7.3f}{made['meshToSkin']['mean']:9.3f}{recall:8.3f}{precision:10.3f}",
                  flush=True)


BASELINES_HEAD = "| warp | divisions | method | hexahedra | invalid | minimum, mean scaled Jacobian | | shape skew |"


def baseline_rows(folder, name, template, marks, options):
    """Prints the rows of HexahedraBaselines (TemplateHexMesher/Testing) for person.vtp. sides.vtp is the envelope of
    the template."""
    at = lambda file: os.path.join(folder, file)  # noqa: E731
    report, _, fitted = fit(folder, "base", template, at("person.vtp"), marks, *options, "--carry", at("sides.vtp"))
    if report is None:
        print(f"| {name} | {fitted}")
        return
    done = subprocess.run([os.path.join(BIN, "HexahedraBaselines"), at("sides.vtp"), at("base.fitted.sides.vtu"),
                           at("person.vtp"), at("base.a.fcsv"), at("base.b.fcsv"), *DIVISIONS],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    for line in (done.stdout + done.stderr).splitlines():
        print(f"| {name} {line}", flush=True)


def baselines_table(folder):
    print("\nHexahedra of known warps of the project's own face, landmarks with 1 mm noise, by several methods\n"
          + BASELINES_HEAD)
    points, triangles, sides = face_shape.envelope()
    marks = np.array(list(face_shape.landmarks().values()))
    face_shape.write_surface(os.path.join(folder, "sides.vtp"), points, triangles, sides)
    near = [np.linalg.norm(points - mark, axis=1).argmin() for mark in marks]
    for name, size in (("10 mm", 10), ("20 mm, folds", 20)):
        random = np.random.default_rng(300 + size)
        warp = smooth_warp(random, size, points) if size < 20 else folding_warp(random, points, near)
        face_shape.write_surface(os.path.join(folder, "person.vtp"), warp(points), triangles)
        noisy = warp(marks) + random.normal(0, 1 / np.sqrt(3), marks.shape)
        baseline_rows(folder, name, os.path.join(ROOT, "TemplateHexMesher", "Template", "face.vtu"), (marks, noisy),
                      ("--landmarkWeight", "1"))


def face_baselines_table(folder, face):
    print("\nHexahedra of each face's volume by several methods, the other one being the template\n" + BASELINES_HEAD)
    triangles, sides = painted_sides(face)
    for name, source, person in (("forth", face.points, face.other), ("back", face.other, face.points)):
        face_shape.write_surface(os.path.join(folder, "sides.vtp"), source, triangles, sides)
        face_shape.write_surface(os.path.join(folder, "person.vtp"), person, triangles)
        write_grid(os.path.join(folder, "base.vtu"), source, face.cells)
        baseline_rows(folder, name, os.path.join(folder, "base.vtu"), (source[face.landmarks], person[face.landmarks]),
                      ())


def main():
    global BIN
    if len(sys.argv) < 5:
        sys.exit(__doc__.split("\n\n")[0])
    BIN, face_folder, ict_folder, folder = map(os.path.abspath, sys.argv[1:5])
    os.makedirs(folder, exist_ok=True)
    tables = {"face": lambda: face_table(folder, Face(face_folder)),
              "robust": lambda: robust_table(folder, Face(face_folder)),
              "ict": lambda: ict_table(folder, ict_folder), "warps": lambda: warps_table(folder, Face(face_folder)),
              "volumes": lambda: volumes_table(folder, Face(face_folder)),
              "muscles": lambda: muscles_table(folder), "baselines": lambda: baselines_table(folder),
              "face_baselines": lambda: face_baselines_table(folder, Face(face_folder))}
    for table in sys.argv[5:] or tables:
        tables[table]()


if __name__ == "__main__":
    main()
