"""Non-rigid registration by finite elements after Clatz et al. (IEEE TMI 24(11), 2005), of displacements at points.

U minimizes (H U - D)' (H U - D) + U' K U, where H interpolates the nodes' displacements at the registration points, D
are the displacements found there, and K is the mesh's stiffness. What the stiffness held back is given back as a force,
(K + H'H) U_i = H'D + F_(i-1), F_i = K U_i, so that H U approaches D.
"""
from types import SimpleNamespace

import numpy as np
import vtk
from scipy import sparse
from scipy.sparse.linalg import LinearOperator, eigsh
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray

from elasticity import Cholesky, shape_gradients, stiffness, unknowns


def grid_of(points, tetrahedra):
    grid, vtk_points, cells = vtk.vtkUnstructuredGrid(), vtk.vtkPoints(), vtk.vtkCellArray()
    vtk_points.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    offsets = np.arange(0, 4 * len(tetrahedra) + 1, 4, dtype=np.int64)
    cells.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True),
                  numpy_to_vtkIdTypeArray(np.ascontiguousarray(tetrahedra, np.int64).ravel(), deep=True))
    grid.SetPoints(vtk_points)
    grid.SetCells(vtk.VTK_TETRA, cells)
    return grid


def nearest_tetrahedra(points, tetrahedra, positions):
    """The tetrahedron that each position is in or, outside the mesh, nearest to."""
    locator = vtk.vtkStaticCellLocator()
    locator.SetDataSet(grid_of(points, tetrahedra))
    locator.BuildLocator()
    nearest, cell, sub, distance = [0.0] * 3, vtk.reference(0), vtk.reference(0), vtk.reference(0.0)
    result = np.empty(len(positions), int)
    for i, position in enumerate(positions):
        locator.FindClosestPoint(position, nearest, cell, sub, distance)
        result[i] = cell.get()
    return result


def interpolation(points, tetrahedra, positions):
    """H: from the nodes' unknowns to those at `positions`; outside the mesh, the nearest tetrahedron is continued."""
    at = nearest_tetrahedra(points, tetrahedra, positions)
    gradients, _ = shape_gradients(points, tetrahedra[at])
    shares = np.einsum("pai,pi->pa", gradients, positions - points[tetrahedra[at, 0]])
    shares[:, 0] += 1
    rows = np.repeat(unknowns(np.arange(len(positions)))[:, None], 4, axis=1)
    values = np.repeat(shares[:, :, None], 3, axis=2)
    return sparse.csr_matrix((values.ravel(), (rows.ravel(), unknowns(tetrahedra[at]).ravel())),
                             (3 * len(positions), 3 * len(points)))


def system(mesh, positions, youngs_modulus, poissons_ratio):
    """K, H and A = K + H'H."""
    k = stiffness(mesh.points, mesh.tetrahedra, youngs_modulus, poissons_ratio)
    h = interpolation(mesh.points, mesh.tetrahedra, positions)
    return SimpleNamespace(K=k, H=h, A=(k + h.T @ h).tocsr())


def registered(equations, factor, displacements, iterations=10):
    """U after some iterations; `factor` solves with A."""
    pull, force = equations.H.T @ displacements.ravel(), 0
    for _ in range(iterations):
        moved = factor.solve(pull + force)
        force = equations.K @ moved
    return moved


def condition_numbers(matrix, factor):
    """Ratio of the extreme eigenvalues (to a percent) of the matrix, and of the matrix scaled to a diagonal of ones."""
    root = np.sqrt(matrix.diagonal())

    def largest(multiply):
        operator = LinearOperator(matrix.shape, multiply, dtype=float)
        start = np.random.default_rng(0).standard_normal(matrix.shape[0])
        return eigsh(operator, 1, which="LM", tol=1e-2, v0=start, return_eigenvectors=False)[0]

    plain = largest(lambda x: matrix @ x) * largest(factor.solve)
    scaled = largest(lambda x: (matrix @ (x.ravel() / root)) / root) * largest(
        lambda x: root * factor.solve(root * x.ravel()))
    return plain, scaled


def conjugate_gradients(matrix, right_side, tolerance=1e-8, most=20000):
    """Solution with the diagonal as preconditioner, and the number of iterations to the relative residual asked for."""
    diagonal = matrix.diagonal()
    x, residual = np.zeros_like(right_side), right_side.copy()
    direction, fall = np.zeros_like(right_side), 1.0
    for iteration in range(most):
        if np.linalg.norm(residual) <= tolerance * np.linalg.norm(right_side):
            return x, iteration
        z = residual / diagonal
        previous, fall = fall, residual @ z
        direction = z + (fall / previous if iteration else 0) * direction
        image = matrix @ direction
        step = fall / (direction @ image)
        x += step * direction
        residual -= step * image
    return x, most
