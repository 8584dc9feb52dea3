// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Conversion of a template, fitted or generated, for the finite-element exports.

#include "ElementMeshIO.h"
#include "FiniteElementModel.h"

namespace surgicalmesher
{

/// Returns the volume elements of `content` with other coordinates (mm, a column per point), and the points they use.
/// Tissue labels and names come from the cell array TissueLabel and the field data; without TissueLabel there is one
/// tissue, "template". Sets come from cell and point arrays of bytes 0 and 1; the cell array Layer gives layer_0,
/// layer_1, ... Throws InputError with `file` if there is no volume element, or if a TissueLabel is not an integer from
/// 1 to 65535.
SolidMesh solidMeshOf(const ElementMeshFile& content, const Points& points, const std::string& file);

} // namespace surgicalmesher
