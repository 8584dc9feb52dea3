"""Exported files as other programs read them, in one shape: for tests, with none of the project's own readers.

A file becomes points (n, 3), tetrahedra (m, 4) and, by set name, `cells` (tetrahedra ids), `nodes` (point ids) and
`faces` (triangles (k, 3) of point ids): those that the format has. Formats that know numbers alone get their names from
the sidecar.
"""
import contextlib
import io
import re
import xml.etree.ElementTree as xml
from types import SimpleNamespace

import meshio
import numpy as np

from sidecar import Sidecar

# CalculiX's manual: S1 has corners 1-2-3, S2 1-4-2, S3 2-4-3, S4 3-4-1; here wound out of the tetrahedron.
ABAQUS_FACES = {"S1": [0, 2, 1], "S2": [0, 1, 3], "S3": [1, 2, 3], "S4": [0, 3, 2]}


def meshio_read(file, **options):
    with contextlib.redirect_stdout(io.StringIO()), np.errstate(all="ignore"):
        return meshio.read(file, **options)


def blocks(mesh, kind, arrays):
    """Cells of one kind, and an array of theirs, over all blocks of a meshio mesh."""
    chosen = [i for i, block in enumerate(mesh.cells) if block.type == kind]
    return (np.concatenate([mesh.cells[i].data for i in chosen]).astype(int),
            np.concatenate([arrays[i] for i in chosen]).astype(int))


def by_number(numbers):
    return {number: np.flatnonzero(numbers == number) for number in np.unique(numbers)}


def tissues_by_name(sidecar, labels):
    cells = by_number(labels)
    return {name: cells[entry["ids"][0]] for name, entry in sidecar.sets.items() if entry["kind"] == "tissue"}


def faces_by_name(sidecar, triangles, tags):
    """Surfaces and shells as unions of pieces; of the two sides of an interface, the one whose winding this is."""
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
    """By the published structure: febio_spec 4.0, Mesh with Nodes, Elements, NodeSet, Surface and ElementSet."""
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
    """Version 4.1. Its nodes are grouped by entity, so that points have another order than in the mesh."""
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
    """Version 2.2, in which a face has the name of its piece: sets come from the sidecar, which knows the names too."""
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
    """Tetrahedra alone, whose sets are in cell arrays."""
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
    """An element's property is the number of its section; those of shells follow."""
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


READERS = {"bdf": read_bdf, "feb": read_feb, "inp": read_inp, "mesh": read_medit, "msh": read_msh, "msh2": read_msh2, "vtk": read_vtk,
           "vtu": read_vtk, "xdmf": read_xdmf}
