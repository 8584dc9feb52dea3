"""Reads exported files for tests as other programs do, without any of the project's own readers.

All formats are returned in one form: points (n, 3), tetrahedra (m, 4) and, by the name of the set, `cells` (ids of
tetrahedra), `nodes` (ids of points) and `faces` (triangles (k, 3) of point ids), as far as the format has them. For
formats that have only numbers, the names come from the sidecar.
"""
import contextlib
import io
import re
import xml.etree.ElementTree as xml
from types import SimpleNamespace

import meshio
import numpy as np
from scipy.io import netcdf_file

from sidecar import Sidecar

# By the manual of Exodus, the sides 1, 2, 3 and 4 have the corners 1-2-4, 2-3-4, 1-4-3 and 1-3-2. Their normals point
# out of the tetrahedron.
EXODUS_FACES = np.array([[0, 1, 3], [1, 2, 3], [0, 3, 2], [0, 2, 1]])
# By the manual of CalculiX, the faces S1, S2, S3 and S4 have the corners 1-2-3, 1-4-2, 2-4-3 and 3-4-1. Here they are
# ordered so that their normals point out of the tetrahedron.
ABAQUS_FACES = {"S1": [0, 2, 1], "S2": [0, 1, 3], "S3": [1, 2, 3], "S4": [0, 3, 2]}


def meshio_read(file, **options):
    with contextlib.redirect_stdout(io.StringIO()), np.errstate(all="ignore"):
        return meshio.read(file, **options)


def blocks(mesh, kind, arrays):
    """Returns the cells of one kind in all blocks of a meshio mesh, and their values of `arrays`, which has one array
    per block."""
    chosen = [i for i, block in enumerate(mesh.cells) if block.type == kind]
    return (np.concatenate([mesh.cells[i].data for i in chosen]).astype(int),
            np.concatenate([arrays[i] for i in chosen]).astype(int))


def by_number(numbers):
    return {number: np.flatnonzero(numbers == number) for number in np.unique(numbers)}


def tissues_by_name(sidecar, labels):
    cells = by_number(labels)
    return {name: cells[entry["ids"][0]] for name, entry in sidecar.sets.items() if entry["kind"] == "tissue"}


def faces_by_name(sidecar, triangles, tags):
    """Returns surfaces and shells as unions of pieces. Of the two sides of an interface, only the one with the winding
    of the triangles is returned."""
    pieces = by_number(tags)
    sets = [entry for entry in sidecar.sets.values() if "faceTags" in entry and not is_second_side(entry)]
    return {entry["name"]: triangles[np.concatenate([pieces[tag] for tag in entry["faceTags"]])] for entry in sets}


def is_second_side(entry):
    return entry["kind"] in ("tissueInterface", "subMeshInterface") and entry["ids"][0] < entry["ids"][1]


def read_inp(file):
    mesh = meshio_read(file)
    result = SimpleNamespace(points=mesh.points, tetrahedra=mesh.cells[0].data, nodes=mesh.point_sets, faces={})
    result.cells = {name: ids[0] for name, ids in mesh.cell_sets.items()}
    with open(file, encoding="ascii") as stream:
        sections = re.split(r"^\*", stream.read(), flags=re.M)
    for section in sections:
        name = re.match(r"SURFACE, NAME=(\w+), TYPE=ELEMENT\n", section)
        if not name:
            continue
        rows = [row.split(", ") for row in section.splitlines()[1:]]
        result.faces[name.group(1)] = np.array([result.tetrahedra[int(element) - 1][ABAQUS_FACES[face]]
                                                for element, face in rows])
    return result


def read_feb(file):
    """Reads a file by its published structure: febio_spec 4.0, Mesh with Nodes, Elements, NodeSet, Surface and
    ElementSet."""
    def ids(text):
        return np.array(text.replace(",", " ").split(), int) - 1

    root = xml.parse(file).getroot()
    assert root.tag == "febio_spec" and root.get("version") == "4.0"
    mesh = root.find("Mesh")
    points = np.array([[float(x) for x in node.text.split(",")] for node in mesh.find("Nodes")])
    parts = [part for part in mesh.iterfind("Elements") if part.get("type") == "tet4"]
    order = np.concatenate([[int(element.get("id")) - 1 for element in part] for part in parts])
    tetrahedra = np.empty((len(order), 4), int)
    tetrahedra[order] = np.concatenate([[ids(element.text) for element in part] for part in parts])
    domains = {domain.get("name") for domain in root.iterfind("MeshDomains/SolidDomain")}
    assert domains == {part.get("name") for part in parts}
    cells = {part.get("name"): np.array([int(element.get("id")) - 1 for element in part]) for part in parts}
    cells.update({group.get("name"): ids(group.text) for group in mesh.iterfind("ElementSet")})
    return SimpleNamespace(
        points=points, tetrahedra=tetrahedra, cells=cells,
        nodes={group.get("name"): ids(group.text) for group in mesh.iterfind("NodeSet")},
        faces={group.get("name"): np.array([ids(face.text) for face in group]) for group in mesh.iterfind("Surface")})


def read_msh(file):
    """Reads version 4.1, in which nodes are grouped by entity, so that the points have another order than in the
    mesh."""
    mesh = meshio_read(file)
    kinds = [block.type for block in mesh.cells]
    starts = {kind: np.cumsum([0] + [len(b.data) * (b.type == kind) for b in mesh.cells]) for kind in set(kinds)}
    result = SimpleNamespace(points=mesh.points, cells={}, nodes={}, faces={})
    data = {kind: np.concatenate([b.data for b in mesh.cells if b.type == kind]) for kind in set(kinds)}
    result.tetrahedra = data["tetra"]
    for name, (_, dimension) in mesh.field_data.items():
        kind = {0: "vertex", 2: "triangle", 3: "tetra"}[dimension]
        ids = np.concatenate([starts[kind][i] + members for i, members in enumerate(mesh.cell_sets[name])
                              if kinds[i] == kind]).astype(int)
        if dimension == 3:
            result.cells[name] = ids
        elif dimension == 2:
            result.faces[name] = data[kind][ids]
        else:
            result.nodes[name] = data[kind][ids][:, 0]
    return result


def read_msh2(file):
    """Reads version 2.2, in which faces have the names of their pieces. The sets come from the sidecar, and the names
    in the file are compared with those in the sidecar."""
    sidecar = Sidecar(file)
    mesh = meshio_read(file, file_format="gmsh")
    tetrahedra, labels = blocks(mesh, "tetra", mesh.cell_data["gmsh:physical"])
    triangles, tags = blocks(mesh, "triangle", mesh.cell_data["gmsh:physical"])
    for name, (tag, dimension) in mesh.field_data.items():
        if dimension == 3:
            assert sidecar.sets[name]["tag"] == tag, name
        else:
            assert all(tag in sidecar.sets[part]["faceTags"] for part in name.split("__")), name
    return SimpleNamespace(points=mesh.points, tetrahedra=tetrahedra, cells=tissues_by_name(sidecar, labels), nodes={},
                           faces=faces_by_name(sidecar, triangles, tags))


def read_medit(file):
    sidecar = Sidecar(file)
    mesh = meshio_read(file)
    tetrahedra, labels = blocks(mesh, "tetra", mesh.cell_data["medit:ref"])
    triangles, tags = blocks(mesh, "triangle", mesh.cell_data["medit:ref"])
    return SimpleNamespace(points=mesh.points, tetrahedra=tetrahedra, cells=tissues_by_name(sidecar, labels), nodes={},
                           faces=faces_by_name(sidecar, triangles, tags))


def with_arrays(sidecar, mesh):
    """Returns the mesh of a file that holds only tetrahedra, with their sets in cell arrays."""
    tetrahedra, labels = blocks(mesh, "tetra", mesh.cell_data["TissueLabel"])
    cells = tissues_by_name(sidecar, labels)
    for kind, array in (("subMesh", "SubMesh"), ("constitutive", "Constitutive")):
        members = by_number(mesh.cell_data[array][0])
        cells.update({entry["name"]: members[entry["ids"][0]] for entry in sidecar.sets.values()
                      if entry["kind"] == kind})
    return SimpleNamespace(points=mesh.points, tetrahedra=tetrahedra, cells=cells, nodes={}, faces={})


def read_vtk(file):
    return with_arrays(Sidecar(file), meshio_read(file))


def read_xdmf(file):
    sidecar = Sidecar(file)
    result = with_arrays(sidecar, meshio_read(file))
    facets = meshio_read(file.replace(".xdmf", "_facets.xdmf"))
    np.testing.assert_array_equal(facets.points, result.points)
    triangles, tags = blocks(facets, "triangle", facets.cell_data["FacetTag"])
    result.faces = faces_by_name(sidecar, triangles, tags)
    return result


def read_bdf(file):
    """Reads Nastran's format. The property of an element is the number of its section; the numbers of shells follow
    those of the sections."""
    sidecar = Sidecar(file)
    mesh = meshio_read(file)
    tetrahedra, properties = blocks(mesh, "tetra", mesh.cell_data["nastran:ref"])
    parts, cells = by_number(properties), {}
    for number, section in enumerate(sidecar.sections, 1):
        entry = sidecar.sets[section["elements"]]
        name = next(name for name, other in sidecar.sets.items()
                    if other["kind"] == "tissue" and other["ids"] == entry["ids"][:1])
        cells[name] = np.union1d(cells.get(name, []), parts[number]).astype(int)
    shells = [name for name, entry in sidecar.sets.items() if entry["type"] == "shell"]
    faces = {}
    if shells:
        triangles, properties = blocks(mesh, "triangle", mesh.cell_data["nastran:ref"])
        parts = by_number(properties)
        faces = {name: triangles[parts[number]] for number, name in enumerate(shells, len(sidecar.sections) + 1)}
    return SimpleNamespace(points=mesh.points, tetrahedra=tetrahedra, cells=cells, nodes={}, faces=faces)


def columns(line, *widths):
    """Returns the fields of a line with these widths; the last width is repeated up to the end of the line."""
    fields, at = [], 0
    for width in widths + widths[-1:] * len(line):
        if at >= len(line.rstrip()):
            return fields
        fields.append(line[at:at + width].strip())
        at += width


def cards(file):
    """Returns (keyword, data lines) for each card of a keyword file, by the manual of LS-DYNA."""
    with open(file, encoding="ascii") as stream:
        lines = [line.rstrip("\n") for line in stream if not line.startswith("$")]
    starts = [i for i, line in enumerate(lines) if line.startswith("*")]
    assert lines[0] == "*KEYWORD" and lines[-1] == "*END"
    return [(lines[i][1:], lines[i + 1:j]) for i, j in zip(starts, starts[1:])]


def read_k_mesh(file):
    """Returns the points, the part of each solid, the nodes of each solid (from 0), and all cards. Tetrahedra that are
    written as hexahedra have four nodes."""
    found = cards(file)
    nodes = [columns(line, 8, 16, 16, 16) for line in next(lines for name, lines in found if name == "NODE")]
    assert [int(row[0]) for row in nodes] == list(range(1, len(nodes) + 1))
    solids, pending = [], None
    for line in next(lines for name, lines in found if name == "ELEMENT_SOLID"):
        row = [int(field) for field in columns(line, 8)]
        if len(row) == 2:  # the nodes of the element are in the next line
            pending = row
        else:
            solids.append(pending + row if pending else row)
            pending = None
    solids = np.array(solids)
    np.testing.assert_array_equal(solids[:, 0], np.arange(1, len(solids) + 1))
    if solids.shape[1] == 10:
        assert (solids[:, 5:] == solids[:, 5:6]).all()  # a tetrahedron is a hexahedron with one point as upper corners
        solids = solids[:, :6]
    return np.array([row[1:] for row in nodes], float), solids[:, 1], solids[:, 2:] - 1, found


def read_k(file):
    points, parts, tetrahedra, found = read_k_mesh(file)
    result = SimpleNamespace(points=points, tetrahedra=tetrahedra, cells={}, nodes={}, faces={})
    for keyword, lines in found:
        if keyword.startswith("SET_"):
            rows = [[int(field) - 1 for field in columns(line, 10)] for line in lines[2:]]
            kind = {"SET_SOLID_TITLE": result.cells, "SET_NODE_LIST_TITLE": result.nodes,
                    "SET_SEGMENT_TITLE": result.faces}[keyword]
            kind[lines[0]] = np.array(rows)[:, :3] if kind is result.faces else np.concatenate(rows)
    titles = {int(columns(lines[1], 10)[0]): lines[0] for keyword, lines in found if keyword == "PART"}
    shells = [[int(field) for field in columns(line, 8)]
              for line in next((lines for keyword, lines in found if keyword == "ELEMENT_SHELL"), [])]
    for number, name in titles.items():
        if number in parts:
            np.testing.assert_array_equal(np.flatnonzero(parts == number), result.cells[name])
        else:
            result.faces[name] = np.array([row[2:5] for row in shells if row[1] == number]) - 1
    return result


def read_cdb_mesh(file):
    """Reads an archive by Ansys's description. Returns the points, the element types by number, the rows of EBLOCK (19
    fields), and the components of elements and of nodes by name."""
    with open(file, encoding="ascii") as stream:
        text = stream.read()
    block = re.search(r"^NBLOCK,6,SOLID,(\d+),(\d+)\n\(3i9,6e21\.13e3\)\n(.*?)^N,R5\.3,LOC, +-1,$", text, re.M | re.S)
    rows = [columns(line, 9, 9, 9, 21) for line in block.group(3).splitlines()]
    assert [int(row[0]) for row in rows] == list(range(1, int(block.group(2)) + 1))
    assert all("." in number for row in rows for number in row[3:])
    points = np.array([row[3:] for row in rows], float)
    block = re.search(r"^EBLOCK,19,SOLID,(\d+),(\d+)\n\(19i9\)\n(.*?)^ +-1$", text, re.M | re.S)
    elements = []
    for line in block.group(3).splitlines():
        row = [int(field) for field in columns(line, 9)]
        if elements and len(elements[-1]) < 11 + elements[-1][8]:
            elements[-1] += row
        else:
            elements.append(row)
    assert [row[10] for row in elements] == list(range(1, int(block.group(2)) + 1))
    sets = re.findall(r"^CMBLOCK,(\w+),(NODE|ELEM), *(\d+)\n\(8i10\)\n([ \d\n]+)", text, re.M)
    sets = {kind: {name: (int(count), np.array(ids.split(), int) - 1) for name, other, count, ids in sets if other == kind}
            for kind in ("ELEM", "NODE")}
    assert all(count == len(ids) and len(name) <= 32 for some in sets.values() for name, (count, ids) in some.items())
    types = {int(a): int(b) for a, b in re.findall(r"^ET,(\d+),(\d+)$", text, re.M)}
    return points, types, elements, {kind: {name: ids for name, (_, ids) in some.items()} for kind, some in sets.items()}


def read_cdb(file):
    points, types, elements, sets = read_cdb_mesh(file)
    tetrahedra = np.array([row[11:] for row in elements if types[row[1]] == 285]) - 1
    return SimpleNamespace(points=points, tetrahedra=tetrahedra, cells=sets["ELEM"], nodes=sets["NODE"], faces={})


def read_exo_mesh(file):
    """Reads a file by the manual of Exodus II. Returns the points, the blocks (name, type, nodes), the numbers of the
    elements, the names, and all variables of the file."""
    with netcdf_file(file, mmap=False) as content:
        found = {name: np.array(variable.data) for name, variable in content.variables.items()}
        types = [content.variables[f"connect{i + 1}"].elem_type.decode() for i in range(content.dimensions["num_el_blk"])]
    names = {name[:-6]: [b"".join(row).split(b"\0")[0].decode() for row in rows]
             for name, rows in found.items() if name.endswith("_names")}
    blocks = [(name, kind, found[f"connect{i}"] - 1) for i, (name, kind) in enumerate(zip(names["eb"], types), 1)]
    return np.column_stack([found["coord" + axis] for axis in "xyz"]), blocks, found["elem_num_map"] - 1, names, found


def read_exo(file):
    points, blocks, numbers, names, found = read_exo_mesh(file)
    kinds = np.repeat([kind == "TETRA" for _, kind, _ in blocks], [len(nodes) for _, _, nodes in blocks])
    tetrahedra = np.empty((np.count_nonzero(kinds), 4), int)
    tetrahedra[numbers[kinds]] = np.concatenate([nodes for _, kind, nodes in blocks if kind == "TETRA"])
    result = SimpleNamespace(points=points, tetrahedra=tetrahedra, faces={})
    result.cells = {name: numbers[found[f"elem_els{i}"] - 1] for i, name in enumerate(names["els"], 1)}
    result.nodes = {name: found[f"node_ns{i}"] - 1 for i, name in enumerate(names["ns"], 1)}
    for i, name in enumerate(names["ss"], 1):
        owners = tetrahedra[numbers[found[f"elem_ss{i}"] - 1]]
        result.faces[name] = np.take_along_axis(owners, EXODUS_FACES[found[f"side_ss{i}"] - 1], axis=1)
    for name, kind, nodes in blocks:
        if kind == "TETRA":
            np.testing.assert_array_equal(np.sort(tetrahedra[result.cells[name]], axis=0), np.sort(nodes, axis=0))
        else:
            result.faces[name] = nodes
    return result


READERS = {"bdf": read_bdf, "cdb": read_cdb, "exo": read_exo, "feb": read_feb, "inp": read_inp, "k": read_k, "mesh": read_medit,
           "msh": read_msh, "msh2": read_msh2, "vtk": read_vtk, "vtu": read_vtk, "xdmf": read_xdmf}
