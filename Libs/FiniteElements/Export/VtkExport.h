// SPDX-License-Identifier: Apache-2.0
#pragma once
/// VTK's own formats (.vtu, legacy .vtk): volume elements alone, as SOFA and SlicerSOFA read them.

#include "Export.h"

namespace surgicalmesher
{

/// The arrays of writeMesh(), without texts; sets are in the cell arrays TissueLabel, SubMesh and Constitutive;
/// those of kind Named are arrays of 0 and 1 of their own.
void writeVtk(const FiniteElementModel& model, const std::string& file, const Destination& destination);

/// The shells as a .vtp: triangles whose point array VolumePointId says which point of the mesh each of theirs is; cell
/// arrays TissueLabel and Thickness (mm); field data as in writeMesh().
void writeShells(const FiniteElementModel& model, const std::string& file);

} // namespace surgicalmesher
