// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A template, fitted or made, as the finite-element exports want it.

#include "ElementMeshIO.h"
#include "FiniteElementModel.h"

namespace surgicalmesher
{

/// The volume elements of `content` with other coordinates (mm, a column per point) and the points that they use.
/// Labels and names are those of TissueLabel and its field data, without them one tissue "template". Sets are the cell
/// arrays and point arrays of bytes 0 and 1, and layer_0, layer_1 ... by the cell array Layer. Throws InputError,
/// naming `file`, if there is no volume element, or a TissueLabel is none of 1 to 65535.
SolidMesh solidMeshOf(const ElementMeshFile& content, const Points& points, const std::string& file);

} // namespace surgicalmesher
