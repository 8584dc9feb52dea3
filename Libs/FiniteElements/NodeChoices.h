// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Node sets chosen by their place, parsed from user input.

#include "FiniteElementModel.h"

namespace surgicalmesher
{

/// Parses texts of the form NAME: SHAPE with coordinates in mm, LPS: "box X Y Z X Y Z" by two corners, "sphere X Y Z
/// RADIUS", or "plane X Y Z NX NY NZ", the side of the plane that its normal points to. Throws UsageError for any other
/// text.
std::vector<NodeChoice> nodeChoices(const std::vector<std::string>& texts);

/// Reads the set that is named after a markups file: the nearest node of each of its points, the side of a plane that
/// its normal points to, or the nodes within an ROI. Throws InputError for other markups.
std::vector<NodeChoice> nodeChoicesOfMarkups(const std::string& file);

/// Returns the choices of texts and of markups files, in this order.
std::vector<NodeChoice> nodeChoices(const std::vector<std::string>& texts, const std::vector<std::string>& markups);

/// Returns the indices of the points within or on the shapes (to a millionth of a mm) by set name, ascending; shapes
/// with the same name are joined. Throws InputError for a set without a point, and for a nearest-node choice farther
/// from the mesh than the mesh is large.
std::map<std::string, std::vector<std::int32_t>> chosenNodes(const std::vector<NodeChoice>& choices,
                                                             const std::vector<Vec3>& points);

} // namespace surgicalmesher
