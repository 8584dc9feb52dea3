#!/usr/bin/python3
"""GetFEM: a head sags under its weight in its fluid. usage: run_getfem.py mesh.msh2 CLAMPED_SURFACE..."""
import sys

import getfem
import numpy as np

from sidecar import GRAVITY, Sidecar, lame

file, surfaces = sys.argv[1], sys.argv[2:]
sidecar = Sidecar(file)
mesh = getfem.Mesh("import", "gmsh", file)
materials = sidecar.material_of_tissues()

# The mesh has either tetrahedra or hexahedra.
hexahedra = "QK" in mesh.geotrans()[0].char()
family, exact = ("FEM_QK", "IM_GAUSS_PARALLELEPIPED(3,3)") if hexahedra else ("FEM_PK", "IM_TETRAHEDRON(2)")
constant_per_cell = getfem.MeshFem(mesh, 1)
constant_per_cell.set_fem(getfem.Fem(family + "(3,0)"))
first, shear, density = (np.zeros(constant_per_cell.nbdof()) for _ in range(3))
for label, material in materials.items():
    dofs = constant_per_cell.basic_dof_on_region(label)
    first[dofs], shear[dofs] = lame(material)
    density[dofs] = material["density"]

clamped = 1 + max(mesh.regions())
faces = np.concatenate([mesh.region(tag) for tag in sidecar.face_tags(surfaces)], axis=1)
mesh.set_region(clamped, faces)

space = getfem.MeshFem(mesh, 3)
space.set_fem(getfem.Fem(family + "(3,1)"))
rule = getfem.MeshIm(mesh, getfem.Integ(exact))
model = getfem.Model("real")
model.add_fem_variable("u", space)
model.add_initialized_fem_data("first", constant_per_cell, first)
model.add_initialized_fem_data("shear", constant_per_cell, shear)
model.add_initialized_fem_data("density", constant_per_cell, density)
model.add_isotropic_linearized_elasticity_brick(rule, "u", "first", "shear")
model.add_linear_term(rule, "%.17g*density*Test_u(3)" % GRAVITY)
model.add_Dirichlet_condition_with_simplification("u", clamped)
model.solve("lsolver", "mumps")
displacement = model.variable("u").reshape(-1, 3)
print("nodes", mesh.nbpts())
print("elements", mesh.nbcvs())
print("tissues", sum(label in mesh.regions() for label in materials))
print("displacement", np.linalg.norm(displacement, axis=1).max())
