// SPDX-License-Identifier: Apache-2.0
#pragma once
/// XDMF with HDF5 (.xdmf, .h5), as FEniCSx, ParaView and meshio read it.

#include "Export.h"

namespace surgicalmesher
{

/// Writes x.xdmf and x.h5, the grid "mesh" of elements with the cell attributes TissueLabel, SubMesh, Constitutive and
/// the point attribute TargetEdgeLength; x_facets.xdmf and x_facets.h5, the grid "facets" of their faces on the same
/// points with the attribute FacetTag (the tags of pieces, see SetTags.h); and, if there are curves, x_curves.xdmf and
/// x_curves.h5, the grid "curves" with the attributes CurveTag and Radius. FEniCSx requires an .h5 with the name of
/// each .xdmf, and its older versions read only the first attribute of a grid; meshio requires one grid per file.
void writeXdmf(const FiniteElementModel& model, const std::string& file, const Destination& destination);

} // namespace surgicalmesher
