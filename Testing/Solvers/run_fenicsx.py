#!/usr/bin/python3
"""FEniCSx: a head sags under its weight in its fluid. usage: run_fenicsx.py mesh.xdmf CLAMPED_SURFACE..."""
import sys

import numpy as np
import ufl
from dolfinx import fem, io
from dolfinx.fem.petsc import LinearProblem
from mpi4py import MPI
from petsc4py import PETSc

from sidecar import GRAVITY, Sidecar, lame

file, surfaces = sys.argv[1], sys.argv[2:]
sidecar = Sidecar(file)
with io.XDMFFile(MPI.COMM_WORLD, file, "r") as xdmf:
    mesh = xdmf.read_mesh(name="mesh")
    tissues = xdmf.read_meshtags(mesh, name="mesh")  # TissueLabel, the first attribute
mesh.topology.create_connectivity(mesh.topology.dim - 1, mesh.topology.dim)
with io.XDMFFile(MPI.COMM_WORLD, file.replace(".xdmf", "_facets.xdmf"), "r") as xdmf:
    facets = xdmf.read_meshtags(mesh, name="facets")  # FacetTag

constant_per_cell = fem.FunctionSpace(mesh, ("DG", 0))
first, shear, density = (fem.Function(constant_per_cell) for _ in range(3))
for label, material in sidecar.material_of_tissues().items():
    cells = tissues.find(label)
    first.x.array[cells], shear.x.array[cells] = lame(material)
    density.x.array[cells] = material["density"]

space = fem.VectorFunctionSpace(mesh, ("CG", 1))
u, v = ufl.TrialFunction(space), ufl.TestFunction(space)
strain = ufl.sym(ufl.grad(u))
stress = first * ufl.tr(strain) * ufl.Identity(3) + 2 * shear * strain
weight = fem.Constant(mesh, PETSc.ScalarType((0, 0, -GRAVITY)))
clamped = np.concatenate([facets.find(tag) for tag in sidecar.face_tags(surfaces)])
still = fem.dirichletbc(np.zeros(3, PETSc.ScalarType), fem.locate_dofs_topological(space, 2, clamped), space)
problem = LinearProblem(ufl.inner(stress, ufl.sym(ufl.grad(v))) * ufl.dx, density * ufl.inner(weight, v) * ufl.dx,
                        [still], petsc_options={"ksp_type": "cg", "pc_type": "gamg", "ksp_rtol": 1e-8})
displacement = problem.solve().x.array.reshape(-1, 3)
print("converged", problem.solver.getConvergedReason())
print("nodes", len(displacement))
print("elements", len(tissues.values))
print("tissues", len(np.unique(tissues.values)))
print("displacement", np.linalg.norm(displacement, axis=1).max())
