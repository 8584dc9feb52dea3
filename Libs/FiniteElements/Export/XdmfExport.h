// SPDX-License-Identifier: Apache-2.0
#pragma once
/// XDMF with HDF5 beside it (.xdmf, .h5), as FEniCSx, ParaView and meshio read them.

#include "Export.h"

namespace surgicalmesher
{

/// Writes four files: x.xdmf and x.h5, the grid "mesh" of elements with the cell attributes TissueLabel, SubMesh,
/// Constitutive and the point attribute TargetEdgeLength; x_facets.xdmf and x_facets.h5, the grid "facets" of their
/// faces on the same points with the attribute FacetTag (the tags of pieces, see SetTags.h). FEniCSx wants an .h5 by the name
/// of each .xdmf, and its older versions read a grid's first attribute alone; meshio wants one grid per file.
void writeXdmf(const FiniteElementModel& model, const std::string& file, const Destination& destination);

} // namespace surgicalmesher
