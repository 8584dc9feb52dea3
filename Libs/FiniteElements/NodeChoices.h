// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Which nodes become sets by their place, from what a user typed.

#include "FiniteElementModel.h"

namespace surgicalmesher
{

/// Each text is NAME: and a shape in mm, LPS: "box X Y Z X Y Z" by two corners, "sphere X Y Z RADIUS", or
/// "plane X Y Z NX NY NZ", the side of the plane that its normal points to. Throws UsageError for anything else.
std::vector<NodeChoice> nodeChoices(const std::vector<std::string>& texts);

/// The set that has a markups file's name: of each of its points the nearest node, of a plane the side that its normal
/// points to, of an ROI the nodes within. Throws InputError for other markups.
std::vector<NodeChoice> nodeChoicesOfMarkups(const std::string& file);

/// Both: texts and files of markups, in this order.
std::vector<NodeChoice> nodeChoices(const std::vector<std::string>& texts, const std::vector<std::string>& markups);

/// Points within the shapes or on them (to a millionth of a mm), by name, ascending; shapes of one name are joined.
/// Throws InputError for a name without a point.
std::map<std::string, std::vector<std::int32_t>> chosenNodes(const std::vector<NodeChoice>& choices,
                                                             const std::vector<Vec3>& points);

} // namespace surgicalmesher
