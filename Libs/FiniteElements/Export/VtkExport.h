// SPDX-License-Identifier: Apache-2.0
#pragma once
/// VTK formats (.vtu, legacy .vtk) with volume elements only, as SOFA and SlicerSOFA read them.

#include "Export.h"

namespace surgicalmesher
{

/// Writes the arrays of writeMesh() without texts. Sets are stored in the cell arrays TissueLabel, SubMesh and
/// Constitutive; each set of kind Named is an array of 0 and 1.
void writeVtk(const FiniteElementModel& model, const std::string& file, const Destination& destination);

/// Writes the shells as a .vtp file: the point array VolumePointId holds the id of each point in the mesh; cell arrays
/// are TissueLabel and Thickness (mm); field data as in writeMesh().
void writeShells(const FiniteElementModel& model, const std::string& file);

} // namespace surgicalmesher
