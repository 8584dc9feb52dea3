// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A parameter node in the terms of the host-independent core.

#include "NullDisplacement.h"
#include "SurgicalScale.h"

class vtkMRMLSurgicalPathScaleNode;

namespace surgicalmesher
{

/// Where the mesh has to be fine, in LPS mm.
Focus focusOf(vtkMRMLSurgicalPathScaleNode* parameters);

/// Throws InputError if the table of lengths by tissue cannot be used with the tissues' `names`.
SurgicalScaleOptions scaleOptions(vtkMRMLSurgicalPathScaleNode* parameters, const TissueTable& names);

/// Throws InputError for a tissue that is neither a label nor a name, or a name that several tissues have.
NullDisplacementOptions nullDisplacementOptions(vtkMRMLSurgicalPathScaleNode* parameters, const TissueTable& names);

} // namespace surgicalmesher
