"""Tests tetrahedra of ten nodes as other programs read them, and compares the bending of a bar with beam theory.

usage: test_second_order.py MODULES FOLDER. Without CalculiX or gmsh the status is 77.
"""
import importlib.util
import json
import os
import shutil
import subprocess
import sys
import unittest

import numpy as np
import vtk

from exported import meshio_read, read_cdb_mesh, read_exo_mesh, read_k_mesh
from sidecar import Sidecar, lame

MODULES, FOLDER = sys.argv[1:3]
SKIPPED = 77
LENGTH, SIDE = 60.0, 6.0  # mm
YOUNGS_MODULUS, POISSONS_RATIO = 2.0, 0.3  # MPa
FORCE = 1e-4  # N
FORMATS = ("bdf", "cdb", "exo", "feb", "inp", "k", "msh", "msh2", "vtk", "vtu", "xdmf")
SETS = ("--nodeSet", "root: plane 0 0 0 -1 0 0", "--nodeSet", f"edge: box 20 {-SIDE / 2} {-SIDE / 2} 40 {-SIDE / 2} {-SIDE / 2}",
        "--nodeSet", "ball: sphere 30 0 0 4", "--nodeSet", "ball: sphere 45 0 0 4")
EDGES = np.array([(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)])

DECK = """*INCLUDE, INPUT={mesh}
*BOUNDARY
root, 1, 3
*STEP
*STATIC
*CLOAD
{loads}
*NODE PRINT, NSET=all_nodes
U
*END STEP
"""


def path(name):
    return os.path.join(FOLDER, name)


def box():
    source = vtk.vtkCubeSource()
    source.SetBounds(0, LENGTH, -SIDE / 2, SIDE / 2, -SIDE / 2, SIDE / 2)
    triangles, clean = vtk.vtkTriangleFilter(), vtk.vtkCleanPolyData()
    triangles.SetInputConnection(source.GetOutputPort())
    clean.SetInputConnection(triangles.GetOutputPort())
    writer = vtk.vtkXMLPolyDataWriter()
    writer.SetInputConnection(clean.GetOutputPort())
    writer.SetFileName(path("box.vtp"))
    writer.Write()


def run_module(*arguments):
    return subprocess.run([os.path.join(MODULES, arguments[0]), *arguments[1:]], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, cwd=FOLDER)


def over_the_beams(deflection):
    """Returns a deflection (mm) of the free end over that of a beam that bends and shears."""
    bending = FORCE * LENGTH ** 3 / (3 * YOUNGS_MODULUS * SIDE ** 4 / 12)
    shear = FORCE * LENGTH / (5 / 6 * YOUNGS_MODULUS / (2 + 2 * POISSONS_RATIO) * SIDE ** 2)
    return deflection / (bending + shear)


def calculix(name, millimetre=1.0):
    """Solves the exported bar by CalculiX and returns its deflection over the beam's. `millimetre` is the length of a
    millimetre in the units of the file."""
    points = meshio_read(path(name + ".inp")).points
    tip = np.flatnonzero(points[:, 0] > (LENGTH - 1e-9) * millimetre)
    with open(path(f"load_{name}.inp"), "w", encoding="ascii") as deck:
        deck.write(DECK.format(mesh=name + ".inp", loads="\n".join(f"{i + 1}, 2, {FORCE / len(tip):.8g}" for i in tip)))
    run = subprocess.run(["ccx", "load_" + name], cwd=FOLDER, stdout=subprocess.PIPE, text=True)
    if run.returncode or "*ERROR" in run.stdout:
        raise AssertionError(run.stdout[-3000:])
    with open(path(f"load_{name}.dat"), encoding="ascii") as results:
        rows = [line.split() for line in results]
    moved = {int(row[0]): float(row[2]) for row in rows if len(row) == 4 and row[0].isdigit()}
    return over_the_beams(np.mean([moved[i + 1] for i in tip]) / millimetre)


def in_getfem(order):
    """Returns the same ratio by GetFEM, with GetFEM's own elements of the mesh's order. The load is spread over the
    area of the free end."""
    import getfem

    mesh = getfem.Mesh("import", "gmsh", path(f"bar{order}.msh2"))
    assert f"PK(3,{order})" in mesh.geotrans()[0].char()
    for region, side in ((1001, 0), (1002, LENGTH)):
        at_end = np.flatnonzero(np.abs(mesh.pts()[0] - side) < 1e-9)
        mesh.set_region(region, mesh.faces_from_pid(at_end))
    space, rule = getfem.MeshFem(mesh, 3), getfem.MeshIm(mesh, getfem.Integ("IM_TETRAHEDRON(5)"))
    space.set_fem(getfem.Fem(f"FEM_PK(3,{order})"))
    model = getfem.Model("real")
    model.add_fem_variable("u", space)
    first, shear = lame({"youngsModulus": YOUNGS_MODULUS, "poissonsRatio": POISSONS_RATIO})
    model.add_initialized_data("first", first)
    model.add_initialized_data("shear", shear)
    model.add_isotropic_linearized_elasticity_brick(rule, "u", "first", "shear")
    model.add_linear_term(rule, f"{-FORCE / SIDE ** 2:.17g}*Test_u(2)", 1002)
    model.add_Dirichlet_condition_with_simplification("u", 1001)
    model.solve("lsolver", "mumps")
    return over_the_beams(getfem.asm_generic(rule, 0, "u(2)", 1002, model) / SIDE ** 2)


def read_tetrahedra(extension):
    """Returns the points, the tetrahedra of ten nodes, and the triangles of six nodes or None, from an exported
    file."""
    file = path("bar2." + extension)
    if extension == "feb":
        return read_feb_of_second_order(file)
    if extension == "k":
        points, _, tetrahedra, _ = read_k_mesh(file)
        return points, tetrahedra, None
    if extension == "cdb":
        points, types, elements, _ = read_cdb_mesh(file)
        assert set(types.values()) == {187}
        return points, np.array([row[11:] for row in elements]) - 1, None
    if extension == "exo":
        points, [(_, kind, tetrahedra)], _, _, _ = read_exo_mesh(file)
        assert kind == "TETRA10"
        return points, tetrahedra, None
    mesh = meshio_read(file, **({"file_format": "gmsh"} if extension == "msh2" else {}))
    tetrahedra = np.concatenate([block.data for block in mesh.cells if block.type == "tetra10"])
    triangles = [block.data for block in mesh.cells if block.type == "triangle6"]
    return mesh.points, tetrahedra.astype(int), np.concatenate(triangles).astype(int) if triangles else None


def read_feb_of_second_order(file):
    """Reads a file by its published structure, like read_feb."""
    import xml.etree.ElementTree as xml

    mesh = xml.parse(file).getroot().find("Mesh")
    points = np.array([[float(x) for x in node.text.split(",")] for node in mesh.find("Nodes")])
    parts = [part for part in mesh.iterfind("Elements") if part.get("type") == "tet10"]
    faces = [face.text for face in mesh.iterfind("Surface[@name='outer_boundary']/tri6")]
    rows = [element.text for part in parts for element in part]
    return (points, *(np.array([np.array(row.split(","), int) - 1 for row in some]) for some in (rows, faces)))


class SecondOrder(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        shutil.rmtree(FOLDER, ignore_errors=True)
        os.makedirs(FOLDER)
        box()
        with open(path("materials.csv"), "w", encoding="ascii") as table:
            table.write("tissue, model, youngsModulus, poissonsRatio, density\n"
                        f"1, linear, {1000 * YOUNGS_MODULUS}, {POISSONS_RATIO}, 1000\n")
        for order in (1, 2):
            exports = [word for extension in FORMATS for word in ("--export", f"bar{order}.{extension}")]
            done = run_module("FuchsTetrahedralizerCLI", "--edgeLength", "3", "--elementOrder", str(order), "--materials",
                              "materials.csv", *SETS, *exports, "box.vtp", f"mesh{order}.vtu")
            assert done.returncode == 0, done.stderr

    def expect_bending(self, first, second):
        print("deflection over the beam's", first, second)
        self.assertAlmostEqual(second, 1, delta=0.02)  # not exactly 1, because the held end cannot widen
        self.assertLess(first, 0.95)  # elements of first order are too stiff
        self.assertGreater(first, 0.6)

    def test_a_bar_bends_as_the_beam(self):
        self.expect_bending(calculix("bar1"), calculix("bar2"))

    @unittest.skipUnless(importlib.util.find_spec("getfem"), "getfem is not installed")
    def test_a_bar_bends_in_getfem(self):
        self.expect_bending(in_getfem(1), in_getfem(2))

    def test_a_bar_bends_in_metres(self):
        done = run_module("surgicalmesher", "convert", "--units", "si", "--elementOrder", "2", "--materials", "materials.csv",
                          *SETS, "mesh1.vtu", "metres.inp")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertAlmostEqual(calculix("metres", 1e-3) / calculix("bar2"), 1, delta=1e-4)

    def test_nodes_are_in_the_middle_of_edges(self):
        corners = meshio_read(path("bar1.vtu"))
        for extension in FORMATS:
            points, tetrahedra, triangles = read_tetrahedra(extension)
            np.testing.assert_array_equal(np.unique(tetrahedra), np.arange(len(points)), extension)
            places = points[tetrahedra]
            np.testing.assert_allclose(places[:, 4:], places[:, EDGES].mean(axis=2), atol=1e-8, err_msg=extension)
            if triangles is not None:
                sides = points[triangles]
                middles = (sides[:, :3] + sides[:, [1, 2, 0]]) / 2
                np.testing.assert_allclose(sides[:, 3:], middles, atol=1e-8, err_msg=extension)
            volumes = np.einsum("ij,ij->i", np.cross(places[:, 1] - places[:, 0], places[:, 2] - places[:, 0]),
                                places[:, 3] - places[:, 0]) / 6
            self.assertGreater(volumes.min(), 0)
            self.assertAlmostEqual(volumes.sum() / (LENGTH * SIDE ** 2), 1, delta=1e-9)
            if extension not in ("feb", "msh"):  # these two order the tetrahedra in another way
                np.testing.assert_array_equal(tetrahedra[:, :4], corners.cells[0].data, extension)

    def test_sets_of_nodes_have_those_of_their_edges(self):
        mesh = meshio_read(path("bar2.inp"))
        outside = (np.abs(np.abs(mesh.points[:, 1:]) - SIDE / 2) < 1e-9).any(axis=1)
        outside |= (mesh.points[:, 0] < 1e-9) | (mesh.points[:, 0] > LENGTH - 1e-9)
        np.testing.assert_array_equal(np.sort(mesh.point_sets["outer_boundary_nodes"]), np.flatnonzero(outside))
        x, y, z = mesh.points.T
        np.testing.assert_array_equal(np.sort(mesh.point_sets["root"]), np.flatnonzero(x < 1e-9))
        edge = (x > 20 - 1e-6) & (x < 40 + 1e-6) & (np.abs(y + SIDE / 2) < 1e-6) & (np.abs(z + SIDE / 2) < 1e-6)
        self.assertTrue(set(mesh.point_sets["edge"]) <= set(np.flatnonzero(edge)))
        self.assertGreater(len(mesh.point_sets["edge"]), 6)
        corners = len(meshio_read(path("bar1.inp")).points)
        within = np.minimum(np.hypot(np.hypot(x - 30, y), z), np.hypot(np.hypot(x - 45, y), z)) < 4
        found = mesh.point_sets["ball"]
        np.testing.assert_array_equal(np.sort(found[found < corners]), np.flatnonzero(within[:corners]))
        self.assertTrue((found >= corners).any() and within[found].all())
        sets = Sidecar(path("bar2.inp")).sets
        self.assertEqual((sets["root"]["kind"], sets["root_faces"]["nodes"]), ("named", "root"))
        self.assertEqual(sets["outer_boundary_nodes"]["size"], outside.sum())

    def test_nastran_has_the_numbers_of_the_others(self):
        for order in (1, 2):
            theirs, ours = meshio_read(path(f"bar{order}.bdf")), meshio_read(path(f"bar{order}.vtu"))
            np.testing.assert_allclose(theirs.points, ours.points, rtol=1e-9, atol=1e-9)
            np.testing.assert_array_equal(theirs.cells[0].data, ours.cells[0].data)
            self.assertEqual(set(theirs.cell_data["nastran:ref"][0]), {1})

    def test_getfem_reads_ansys(self):
        """Tests second order only: GetFEM reads SOLID187, but not SOLID285, as which first order is written."""
        import getfem

        mesh, ours = getfem.Mesh("import", "cdb", path("bar2.cdb")), meshio_read(path("bar2.vtu"))
        self.assertEqual(mesh.geotrans()[0].char(), "GT_PK(3,2)")
        self.assertEqual((mesh.nbpts(), mesh.nbcvs()), (len(ours.points), len(ours.cells[0].data)))
        in_order = lambda points: points[np.lexsort(np.round(points, 9).T)]
        np.testing.assert_allclose(in_order(mesh.pts().T), in_order(ours.points), atol=1e-9)
        volume = getfem.asm_generic(getfem.MeshIm(mesh, getfem.Integ("IM_TETRAHEDRON(5)")), 0, "1", -1)
        self.assertAlmostEqual(volume / (LENGTH * SIDE ** 2), 1, delta=1e-9)

    def test_vtk_reads_exodus(self):
        for order, kind in ((1, vtk.VTK_TETRA), (2, vtk.VTK_QUADRATIC_TETRA)):
            reader = vtk.vtkExodusIIReader()
            reader.SetFileName(path(f"bar{order}.exo"))
            reader.Update()
            grid = reader.GetOutput().GetBlock(0).GetBlock(0)
            ours = meshio_read(path(f"bar{order}.vtu"))
            self.assertEqual({grid.GetCellType(i) for i in range(grid.GetNumberOfCells())}, {kind})
            self.assertEqual((grid.GetNumberOfPoints(), grid.GetNumberOfCells()), (len(ours.points), len(ours.cells[0].data)))
            names = [reader.GetObjectName(vtk.vtkExodusIIReader.NODE_SET, i)
                     for i in range(reader.GetNumberOfObjects(vtk.vtkExodusIIReader.NODE_SET))]
            self.assertTrue({"root", "edge", "ball", "outer_boundary_nodes"} <= {name.split(" ")[0] for name in names}, names)

    def test_vtk_reads_its_formats(self):
        for order, kind in ((1, vtk.VTK_TETRA), (2, vtk.VTK_QUADRATIC_TETRA)):
            ours = meshio_read(path(f"bar{order}.vtu"))
            for extension, reader in (("vtk", vtk.vtkUnstructuredGridReader()), ("vtu", vtk.vtkXMLUnstructuredGridReader())):
                reader.SetFileName(path(f"bar{order}.{extension}"))
                reader.Update()
                grid = reader.GetOutput()
                self.assertEqual({grid.GetCellType(i) for i in range(grid.GetNumberOfCells())}, {kind})
                self.assertEqual((grid.GetNumberOfPoints(), grid.GetNumberOfCells()), (len(ours.points), len(ours.cells[0].data)))
                self.assertEqual(grid.GetCellData().GetArray("TissueLabel").GetRange(), (1, 1))

    def test_sets_of_nodes_by_markups(self):
        """Tests files as Slicer 5 writes them, in both frames."""
        turned = np.array([[0.8, -0.6, 0], [0.6, 0.8, 0], [0, 0, 1]])  # columns are axes
        flip = np.diag([-1.0, -1, 1])
        for system, frame in (("LPS", np.eye(3)), ("RAS", flip)):
            roi = {"type": "ROI", "coordinateSystem": system, "roiType": "Box", "center": list(frame @ (30, 0, 0)),
                   "orientation": list((frame @ turned).ravel()), "size": [10, 3, 20], "insideOut": False,
                   "controlPoints": [{"position": list(frame @ (30, 0, 0))}]}
            plane = {"type": "Plane", "coordinateSystem": system, "center": list(frame @ (50, 0, 0)),
                     "normal": list(frame @ (1, 0, 0)), "controlPoints": [{"position": list(frame @ (50, 0, 0))}]}
            pins = {"type": "Fiducial", "coordinateSystem": system,
                    "controlPoints": [{"position": list(frame @ p)} for p in ((-1, -4, -4), (61, 4, 4))]}
            words = []
            for name, markup in (("roi", roi), ("plane", plane), ("pins", pins), ("line", {**pins, "type": "Line"})):
                with open(path(f"{name}.mrk.json"), "w", encoding="ascii") as file:
                    json.dump({"markups": [markup]}, file)
                words += ["--nodeMarkups", f"{name}.mrk.json"]
            done = run_module("surgicalmesher", "convert", *words[:6], "mesh1.vtu", "placed.inp")
            self.assertEqual(done.returncode, 0, done.stderr)
            mesh = meshio_read(path("placed.inp"))
            within = (np.abs((mesh.points - (30, 0, 0)) @ turned) <= (5 + 1e-6, 1.5 + 1e-6, 10)).all(axis=1)
            self.assertGreater(np.count_nonzero(within), 3)
            np.testing.assert_array_equal(np.sort(mesh.point_sets["roi"]), np.flatnonzero(within))
            np.testing.assert_array_equal(np.sort(mesh.point_sets["plane"]), np.flatnonzero(mesh.points[:, 0] > 50 - 1e-6))
            np.testing.assert_allclose(mesh.points[np.sort(mesh.point_sets["pins"])][:, 0] % LENGTH, 0, atol=1e-9)
            self.assertEqual(len(mesh.point_sets["pins"]), 2)
            done = run_module("surgicalmesher", "convert", *words, "mesh1.vtu", "refused.inp")
            self.assertEqual((done.returncode, done.stderr.count("\n")), (1, 1), done.stderr)
            self.assertIn('"Line"', done.stderr)

    def test_gmsh_reads_it(self):
        import gmsh

        gmsh.initialize()
        gmsh.option.setNumber("General.Terminal", 0)
        shutil.copy(path("bar2.msh2"), path("version2.msh"))
        gmsh.open(path("bar1.vtk"))
        self.assertEqual(list(gmsh.model.mesh.getElementTypes(3)), [4])
        for name in ("bar2.bdf", "bar2.msh", "version2.msh", "bar2.vtk"):
            gmsh.open(path(name))
            types = gmsh.model.mesh.getElementTypes(3)
            self.assertEqual([gmsh.model.mesh.getElementProperties(kind)[2] for kind in types], [2], name)
            jacobians = gmsh.model.mesh.getJacobians(types[0], gmsh.model.mesh.getIntegrationPoints(types[0], "Gauss2")[0])
            self.assertGreater(np.min(jacobians[1]), 0, name)
        gmsh.finalize()

    def test_curved_sides_follow_a_ball(self):
        import gmsh

        source, writer = vtk.vtkSphereSource(), vtk.vtkXMLPolyDataWriter()
        source.SetRadius(10)
        source.SetThetaResolution(16)
        source.SetPhiResolution(10)
        writer.SetInputConnection(source.GetOutputPort())
        writer.SetFileName(path("ball.vtp"))
        writer.Write()
        done = run_module("FuchsTetrahedralizerCLI", "--edgeLength", "4", "ball.vtp", "ball.vtu")
        self.assertEqual(done.returncode, 0, done.stderr)
        gmsh.initialize()
        gmsh.option.setNumber("General.Terminal", 0)
        off = {}
        for name, words in (("straight", ()), ("curved", ("--curvedSides",))):
            done = run_module("surgicalmesher", "convert", "--elementOrder", "2", *words, "ball.vtu", name + ".msh2", name + ".inp")
            self.assertEqual(done.returncode, 0, done.stderr)
            shutil.copy(path(name + ".msh2"), path(name + ".msh"))
            gmsh.open(path(name + ".msh"))
            integration = gmsh.model.mesh.getIntegrationPoints(11, "Gauss4")[0]
            self.assertGreater(np.min(gmsh.model.mesh.getJacobians(11, integration)[1]), 0)
            mesh = meshio_read(path(name + ".inp"))
            middles = np.setdiff1d(mesh.point_sets["outer_boundary_nodes"], mesh.cells[0].data[:, :4])
            off[name] = np.abs(np.linalg.norm(mesh.points[middles], axis=1) - 10).mean()
        gmsh.finalize()
        print("middle nodes off the sphere of 10 mm, in the mean", off)
        self.assertLess(off["curved"], 0.4 * off["straight"])

    def test_refused(self):
        for name in ("a.mesh", "a.stl", "a.ply"):
            done = run_module("surgicalmesher", "convert", "--elementOrder", "2", "mesh1.vtu", name)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
            self.assertIn("no elements of second order", done.stderr)
            self.assertFalse(os.path.exists(path(name)))
        done = run_module("surgicalmesher", "convert", "--curvedSides", "mesh1.vtu", "a.inp")
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        for words, status in (("far: sphere 500 0 0 4", 1), ("a: sphere 0 0 0", 2), ("a: box 1 2 3 4 5 x", 2), ("a", 2),
                              ("a: plane 0 0 0 0 0 0", 2), (": box 0 0 0 9 9 9", 2), ("a: cone 0 0 0 1 1 1", 2)):
            done = run_module("surgicalmesher", "convert", "--nodeSet", words, "mesh1.vtu", "a.inp")
            self.assertEqual((done.returncode, done.stderr.count("\n")), (status, 1), done.stderr)
            self.assertIn("--nodeSet", done.stderr)
            self.assertFalse(os.path.exists(path("a.inp")))

    def test_converted_files_are_the_exported_ones(self):
        done = run_module("surgicalmesher", "convert", "--elementOrder", "2", "--materials", "materials.csv", *SETS, "mesh1.vtu",
                          "other.inp", "other.bdf")
        self.assertEqual(done.returncode, 0, done.stderr)
        for extension in ("inp", "bdf", "inp.names.json"):
            with open(path("other." + extension), "rb") as theirs, open(path("bar2." + extension), "rb") as ours:
                self.assertEqual(theirs.read(), ours.read(), extension)


if __name__ == "__main__":
    try:
        import gmsh  # noqa: F401
    except ImportError:
        print("not installed: gmsh")
        sys.exit(SKIPPED)
    if not shutil.which("ccx"):
        print("not installed: ccx")
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1])
