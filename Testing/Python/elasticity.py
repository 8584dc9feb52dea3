"""Linear elasticity on tetrahedra, and direct solutions of its equations.

Lengths in mm, moduli in MPa, forces in N. Unknown 3 p + i is the displacement of point p along axis i.
"""
import cvxopt
import cvxopt.amd
import cvxopt.cholmod
import numpy as np
from scipy import sparse


def shape_gradients(points, tetrahedra):
    """Of the four linear shape functions, per mm: (m, 4, 3); and the volumes, mm^3: (m,)."""
    corners = points[tetrahedra]
    edges = corners[:, 1:] - corners[:, :1]
    inner = np.moveaxis(np.linalg.inv(edges), 1, 2)
    return np.concatenate([-inner.sum(axis=1, keepdims=True), inner], axis=1), np.linalg.det(edges) / 6


def unknowns(points):
    """Of points (...): the numbers of their three unknowns, (..., 3)."""
    return 3 * np.asarray(points)[..., None] + np.arange(3)


def stiffness(points, tetrahedra, youngs_modulus, poissons_ratio):
    """The stiffness matrix (N/mm) of isotropic linear tetrahedra, sparse and symmetric."""
    gradients, volumes = shape_gradients(points, tetrahedra)
    lame = youngs_modulus * poissons_ratio / ((1 + poissons_ratio) * (1 - 2 * poissons_ratio))
    shear = youngs_modulus / (2 * (1 + poissons_ratio))
    blocks = np.einsum("t,tai,tbj->taibj", lame * volumes, gradients, gradients)
    blocks += np.einsum("t,taj,tbi->taibj", shear * volumes, gradients, gradients)
    blocks += np.einsum("t,tak,tbk,ij->taibj", shear * volumes, gradients, gradients, np.eye(3))
    local = unknowns(tetrahedra).reshape(-1, 12)
    rows, columns = np.repeat(local, 12, axis=1), np.tile(local, (1, 12))
    return sparse.coo_matrix((blocks.ravel(), (rows.ravel(), columns.ravel())), (3 * len(points),) * 2).tocsr()


def weight(points, tetrahedra, force_per_volume):
    """Forces (N) on all unknowns of a uniform force per volume (N/mm^3, three components)."""
    _, volumes = shape_gradients(points, tetrahedra)
    share = np.bincount(tetrahedra.ravel(), np.repeat(volumes / 4, 4), len(points))
    return np.outer(share, force_per_volume).ravel()


class Cholesky:
    """The factor L of a sparse symmetric positive definite matrix: L L' = P A P'.

    P reduces fill, but keeps the unknowns `last` to the end, in their order: then the end of L is the factor of the
    matrix condensed onto them.
    """

    def __init__(self, matrix, last=()):
        last = np.asarray(last, int)
        first = np.setdiff1d(np.arange(matrix.shape[0]), last)
        inner = np.array(cvxopt.amd.order(_lower(matrix[first][:, first])), int).ravel()
        order = np.concatenate([first[inner], last])
        # Zeros that count as entries keep CHOLMOD's postordering from taking others between or behind the last: all
        # others are eliminated before the first of them, and each of them before the next.
        after = np.r_[np.repeat(last[:1], len(first)), last[1:]]
        before = np.r_[first, last][:len(after)]
        zeros = np.zeros(2 * len(after))
        chain = sparse.coo_matrix((zeros, (np.r_[before, after], np.r_[after, before])), matrix.shape)
        lower = _lower(matrix, chain)
        cvxopt.cholmod.options.update(supernodal=2, nmethods=1)  # 1: the order given, and no other
        self._factor = cvxopt.cholmod.symbolic(lower, cvxopt.matrix(order.tolist(), tc="i"))
        cvxopt.cholmod.numeric(lower, self._factor)
        self._last = last

    def solve(self, right_side):
        """The solution for one right side (n,) or several (n, k)."""
        result = cvxopt.matrix(np.asarray(right_side, float))
        cvxopt.cholmod.solve(self._factor, result)
        return np.array(result).reshape(np.shape(right_side))

    def condensed(self):
        """The matrix condensed onto `last` (its Schur complement), dense. Ends this object: it solves no more."""
        factor = cvxopt.cholmod.getfactor(self._factor)
        self._factor = None
        n, m = factor.size[0], len(self._last)
        corner = np.array(cvxopt.matrix(factor[n - m:, n - m:]))
        return corner @ corner.T


def _lower(*summands):
    """The lower triangle of a sum as CHOLMOD takes it, zeros that are stored included."""
    parts = [sparse.tril(summand, format="csc").tocoo() for summand in summands]
    values, rows, columns = (np.concatenate([getattr(part, name) for part in parts]) for name in ("data", "row", "col"))
    return cvxopt.spmatrix(values, rows.astype(int), columns.astype(int), summands[0].shape)
