"""A face built in code: its soft tissue as a closed slab with holes for mouth and eyes, the bodies of five muscles,
landmarks, and a map to a second person. All in LPS and mm; the face looks to the front, -y."""
import numpy as np
import vtk
from vtk.util.numpy_support import numpy_to_vtk

COLUMNS, ROWS, DEPTHS = 72, 72, 4
LOW, HIGH = np.array([-62.0, -66.0]), np.array([62.0, 60.0])  # x from right to left, z from bottom to top
HOLES = {"mouth": ((0, -30), (21, 5.5)), "right_eye": ((-27, 22), (12, 6.5)), "left_eye": ((27, 22), (12, 6.5))}
OUTER, INNER, RIGHT, LEFT, BOTTOM, TOP, HOLE = 1, 2, 3, 4, 5, 6, 0  # the cell array Side of VolumetricHexCLI


def tissue(x, z, depth):
    """Returns the points (..., 3) of the slab at positions x, z; depth 0 is on the skin, 1 on mucosa and bone."""
    back = x ** 2 / 95 + z ** 2 / 300
    nose = 14 * np.exp(-(x / 13) ** 2 - ((z - 2) / 17) ** 2)
    lips = 4 * np.exp(-(x / 24) ** 2 - ((z + 30) / 12) ** 2)
    chin = 5 * np.exp(-(x / 20) ** 2 - ((z + 60) / 12) ** 2)
    skin = np.stack([x, back - nose - lips - chin, z], axis=-1)
    bone = np.stack([0.9 * x, back + 10 - 0.55 * nose - 0.6 * chin, 0.95 * z], axis=-1)
    return skin + np.asarray(depth)[..., None] * (bone - skin)


def second_person(points):
    """Returns the same points on the second person: a smooth map without folds, which moves them by up to 12 mm."""
    x, y, z = np.moveaxis(np.asarray(points, float), -1, 0)
    wide = 1.08 * x + 2 * np.sin(z / 30)
    deep = 1.05 * y - 4 * np.exp(-(x / 14) ** 2 - ((z - 4) / 18) ** 2) + 2.5 * np.sin(x / 32)
    tall = 0.93 * z - 5 + 3 * np.cos(x / 40) * np.sin(z / 45)
    return np.stack([wide, deep, tall], axis=-1)


def grid():
    """Returns the nodes (i, k, [x, z]) of a plane grid, and which of its squares exist. A rectangle of squares is left
    out for each hole, its border is moved to the hole's ellipse, and the other nodes follow by harmonic
    displacements."""
    x, z = (np.linspace(LOW[a], HIGH[a], n + 1) for a, n in enumerate((COLUMNS, ROWS)))
    nodes = np.stack(np.meshgrid(x, z, indexing="ij"), axis=-1)
    kept = np.ones((COLUMNS, ROWS), bool)
    moved = np.zeros_like(nodes)
    fixed = np.zeros(nodes.shape[:2], bool)
    fixed[[0, -1]] = fixed[:, [0, -1]] = True
    step = (HIGH - LOW) / (COLUMNS, ROWS)
    for centre, radii in HOLES.values():
        half = np.array(radii) * (0.85, 0.53)
        (i, k), (i1, k1) = (np.rint((centre + sign * half - LOW) / step).astype(int) for sign in (-1, 1))
        kept[i:i1, k:k1] = False
        border = np.zeros_like(fixed)
        border[i:i1 + 1, k:k1 + 1] = True
        border[i + 1:i1, k + 1:k1] = False
        offset = (nodes[border] - centre) / radii
        moved[border] = centre + radii * offset / np.linalg.norm(offset, axis=-1, keepdims=True) - nodes[border]
        fixed[i:i1 + 1, k:k1 + 1] = True
    for _ in range(500):
        middles = (moved[:-2, 1:-1] + moved[2:, 1:-1] + moved[1:-1, :-2] + moved[1:-1, 2:]) / 4
        moved[1:-1, 1:-1] = np.where(fixed[1:-1, 1:-1, None], moved[1:-1, 1:-1], middles)
    return nodes + moved, kept


def envelope():
    """Returns the closed surface of the slab: points, triangles with outward normals, and the side of each."""
    nodes, kept = grid()
    depth = np.linspace(0, 1, DEPTHS + 1)
    points = tissue(nodes[:, :, None, 0], nodes[:, :, None, 1], np.broadcast_to(depth, (*nodes.shape[:2], DEPTHS + 1)))
    number = np.arange(points[..., 0].size).reshape(points.shape[:3])
    quads, sides = [], []

    def add(corners, side, inside):
        """Adds a quadrilateral, which is turned if its normal does not point outwards; `inside` are the nodes of the
        cell behind it."""
        p = points.reshape(-1, 3)[corners]
        area = np.cross(p[2] - p[0], p[3] - p[1])
        turned = area @ (p.mean(axis=0) - points.reshape(-1, 3)[inside].mean(axis=0)) < 0
        quads.append(corners[::-1] if turned else corners)
        sides.append(side)

    for i, k in np.argwhere(kept):
        cell = number[i:i + 2, k:k + 2]
        for level, side in ((0, OUTER), (DEPTHS, INNER)):
            add([cell[0, 0, level], cell[1, 0, level], cell[1, 1, level], cell[0, 1, level]], side, cell.ravel())
        for di, dk, ends, edge in ((-1, 0, ((0, 0), (0, 1)), RIGHT), (1, 0, ((1, 0), (1, 1)), LEFT),
                                   (0, -1, ((0, 0), (1, 0)), BOTTOM), (0, 1, ((0, 1), (1, 1)), TOP)):
            there = (i + di, k + dk)
            outside = not (0 <= there[0] < COLUMNS and 0 <= there[1] < ROWS)
            if not outside and kept[there]:
                continue
            a, b = (cell[end] for end in ends)
            for level in range(DEPTHS):
                add([a[level], b[level], b[level + 1], a[level + 1]], edge if outside else HOLE, cell.ravel())
    return compact(points.reshape(-1, 3), *triangles_of(quads, sides))


def triangles_of(quads, sides=None):
    quads = np.asarray(quads)
    triangles = quads[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3)
    return (triangles, np.repeat(sides, 2)) if sides is not None else triangles


def compact(points, triangles, *arrays):
    used, renumbered = np.unique(triangles, return_inverse=True)
    return (points[used], renumbered.reshape(triangles.shape), *arrays)


def tube(place, closed, along=48, around=16):
    """Returns the surface (points, triangles) of the tube place(t, angle), t in [0, 1]: a ring if `closed`, else a tube
    with two caps."""
    t = np.arange(along) / along if closed else np.linspace(0, 1, along)
    angle = 2 * np.pi * np.arange(around) / around
    rings = place(t[:, None], angle[None, :])
    number = np.arange(along * around).reshape(along, around)
    following = np.roll(number, -1, axis=0) if closed else number[1:]
    begin = number if closed else number[:-1]
    quads = np.stack([begin, np.roll(begin, -1, axis=1), np.roll(following, -1, axis=1), following], axis=-1)
    points, triangles = rings.reshape(-1, 3), triangles_of(quads.reshape(-1, 4))
    if closed:
        return points, triangles
    caps = [rings[0].mean(axis=0), rings[-1].mean(axis=0)]
    first, last = len(points), len(points) + 1
    ends = [np.stack([np.full(around, first), np.roll(number[0], -1), number[0]], axis=-1),
            np.stack([np.full(around, last), number[-1], np.roll(number[-1], -1)], axis=-1)]
    return np.concatenate([points, caps]), np.concatenate([triangles, *ends])


def strip(start, end, width, low, high):
    """Returns the surface of a flat muscle from `start` to `end` (x, z) between two depths."""
    start, end = np.array(start, float), np.array(end, float)
    across = np.array([-(end - start)[1], (end - start)[0]]) / np.linalg.norm(end - start)

    def place(t, angle):
        middle = start + (end - start) * t[..., None]
        at = middle + width / 2 * np.cos(angle)[..., None] * across
        return tissue(at[..., 0], at[..., 1], (low + high) / 2 + (high - low) / 2 * np.sin(angle) + 0 * t)
    return tube(place, closed=False)


def ring(centre, radii, width, low, high):
    """Returns the surface of a flat muscle around a hole between two depths."""
    def place(t, angle):
        turn, reach = 2 * np.pi * t, width / 2 * np.cos(angle)
        x = centre[0] + (radii[0] + reach) * np.cos(turn)
        z = centre[1] + (radii[1] + reach) * np.sin(turn)
        return tissue(x, z, (low + high) / 2 + (high - low) / 2 * np.sin(angle) + 0 * t)
    return tube(place, closed=True, along=96)


def muscles():
    """Maps the name of each muscle to the points and triangles of its surface."""
    result = {"orbicularis_oris": ring((0, -30), (28.5, 13.5), 12, 0.25, 0.75)}
    for side, sign in (("right", -1), ("left", 1)):
        result[side + "_masseter"] = strip((sign * 50, -44), (sign * 50, 4), 14, 0.3, 0.8)
        result[side + "_zygomaticus"] = strip((sign * 30, -18), (sign * 46, 10), 10, 0.2, 0.7)
    return result


def landmarks():
    """Maps the name of each landmark to its point on the skin or, for names that end in _deep, on mucosa or bone."""
    places = {}
    for name, (centre, radii) in HOLES.items():
        for corner, direction in (("right", (-1, 0)), ("left", (1, 0)), ("lower", (0, -1)), ("upper", (0, 1))):
            places[f"{name}_{corner}"] = np.array(centre) + np.array(radii) * direction
    places.update({"nose_tip": (0, 2), "nose_root": (0, 32), "subnasal": (0, -16), "chin": (0, -60)})
    places.update({f"rim_{x}_{z}": (62 * x, -3 + 63 * z) for x in (-1, 0, 1) for z in (-1, 0, 1) if x or z})
    places.update({"right_cheek": (-40, -8), "left_cheek": (40, -8), "right_jaw": (-34, -50), "left_jaw": (34, -50)})
    result = {}
    for name, (x, z) in places.items():
        result[name] = tissue(np.array(x, float), np.array(z, float), 0.0)
        result[name + "_deep"] = tissue(np.array(x, float), np.array(z, float), 1.0)
    return result


def write_surface(file, points, triangles, sides=None):
    cells = vtk.vtkCellArray()
    for triangle in triangles:
        cells.InsertNextCell(3, [int(i) for i in triangle])
    data = vtk.vtkPolyData()
    data.SetPoints(vtk.vtkPoints())
    data.GetPoints().SetDataTypeToDouble()
    data.GetPoints().SetData(numpy_to_vtk(np.ascontiguousarray(points, float), deep=True))
    data.SetPolys(cells)
    if sides is not None:
        array = numpy_to_vtk(np.asarray(sides, np.int32), deep=True)
        array.SetName("Side")
        data.GetCellData().AddArray(array)
    writer = vtk.vtkXMLPolyDataWriter()
    writer.SetInputData(data)
    writer.SetFileName(file)
    if not writer.Write():
        raise OSError(f"{file}: can't be written")


def write_landmarks(file, points):
    with open(file, "w", encoding="ascii") as stream:
        stream.write("# CoordinateSystem = LPS\n# columns = label,x,y,z\n")
        for name, point in points.items():
            stream.write("%s,%.6f,%.6f,%.6f\n" % (name, *point))
