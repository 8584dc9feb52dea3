// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Conversion of a parameter node to the options of the host-independent core.

#include "NullDisplacement.h"
#include "SurgicalScale.h"

class vtkMRMLSurgicalPathScaleNode;

namespace surgicalmesher
{

/// Returns the targets and paths around which the mesh must be fine, in LPS mm.
Focus focusOf(vtkMRMLSurgicalPathScaleNode* parameters);

/// Throws InputError if the table of lengths by tissue cannot be read or does not fit `names`.
SurgicalScaleOptions scaleOptions(vtkMRMLSurgicalPathScaleNode* parameters, const TissueTable& names);

/// Throws InputError for a tissue that is neither a label nor a name, or a name that several tissues have.
NullDisplacementOptions nullDisplacementOptions(vtkMRMLSurgicalPathScaleNode* parameters, const TissueTable& names);

} // namespace surgicalmesher
