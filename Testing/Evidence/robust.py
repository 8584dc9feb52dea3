"""Registration of matched blocks with rejection of outliers, after Clatz et al. (IEEE TMI 24(11), 2005).

This is the registration of registration.py, but after each of the first outer steps, a share of all points is rejected:
those whose displacement contradicts the mechanics most. Step i solves (K + H'SH) U_i = H'SD + F_(i-1), where S keeps
the points that are left. F_i = 0 while points are rejected, and F_i = K U_i afterwards.
"""
import time
from types import SimpleNamespace

import numpy as np
from scipy import sparse

from registration import conjugate_gradients, system

# The weights are 1 N/mm per point.
YOUNGS_MODULUS, POISSONS_RATIO = 0.01, 0.45  # MPa
STEPS = 10
REJECTED = 0.025  # share of all points that each outer step rejects
TOLERANCE = 1e-6  # of the residual of the conjugate gradients


def register(mesh, points, displacements, youngs_modulus=YOUNGS_MODULUS, steps=STEPS, rejected=REJECTED,
             refined=STEPS):
    """Returns the displacements of the nodes (n, 3), which points were kept, the iterations and processor seconds of
    the solver, and its last matrix.

    Each of the first `steps` outer steps rejects the share `rejected` of the points; `refined` further steps with the
    points that are left bring HU closer to D.
    """
    equations = system(mesh, points, youngs_modulus, POISSONS_RATIO)
    kept = np.ones(len(points), bool)
    moved = force = np.zeros(equations.K.shape[0])
    iterations, seconds = 0, 0.0
    for step in range(steps + refined):
        weights = sparse.diags(np.repeat(kept.astype(float), 3))
        transposed = (equations.H.T @ weights).tocsr()
        matrix = (equations.K + transposed @ equations.H).tocsr()
        start = time.process_time()
        moved, count = conjugate_gradients(matrix, transposed @ displacements.ravel() + force, TOLERANCE)
        seconds += time.process_time() - start
        iterations += count
        if step < steps:
            errors = np.linalg.norm((equations.H @ moved).reshape(-1, 3) - displacements, axis=1)
            errors[~kept] = -1
            kept[np.argsort(-errors, kind="stable")[:int(round(rejected * len(points)))]] = False
        else:
            force = equations.K @ moved
    return SimpleNamespace(nodes=moved.reshape(-1, 3), kept=kept, iterations=iterations, seconds=seconds, matrix=matrix)


def with_outliers(displacements, share, smallest, largest, seed=0):
    """Returns the displacements with outliers, and a mask of these. A random `share` of the displacements is changed by
    between `smallest` and `largest` in a random direction."""
    random = np.random.default_rng(seed)
    planted = np.zeros(len(displacements), bool)
    planted[random.choice(len(displacements), int(round(share * len(displacements))), replace=False)] = True
    directions = random.standard_normal((np.count_nonzero(planted), 3))
    directions *= (random.uniform(smallest, largest, len(directions)) / np.linalg.norm(directions, axis=1))[:, None]
    result = displacements.copy()
    result[planted] += directions
    return result, planted
