# SPDX-License-Identifier: Apache-2.0
"""Graded finite element meshes of all tissues of a label map.

    import surgicalmesher
    mesh = surgicalmesher.mesh(labels, spacing=(1, 1, 1.5), origin=(-90, -126, -72), targets=[(0, 0, -10)])

Lengths are in mm, points in LPS (x to the patient's left, y to the back, z to the head), as in all of the project's
files.
"""
from ._meshing import estimate, mesh
from ._programs import MeshingError, MeshingWarning
from ._tetrahedra import Mesh, read_mesh

__all__ = ["Mesh", "MeshingError", "MeshingWarning", "estimate", "mesh", "read_mesh"]
