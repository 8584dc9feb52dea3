// SPDX-License-Identifier: Apache-2.0
#include "Portions.h"

#include <map>

namespace surgicalmesher
{
namespace
{

const std::map<std::size_t, std::string> kShapes{ { 4, "tet4" }, { 6, "penta6" }, { 8, "hex8" }, { 10, "tet10" } };

} // namespace

std::vector<Portion> portionsOf(const FiniteElementModel& model, const ElementSet& set)
{
  std::map<std::string, std::vector<std::int32_t>> byShape;
  for (const std::int32_t e : set.elements) byShape[kShapes.at(model.elements[e].size())].push_back(e);
  std::vector<Portion> portions;
  for (const auto& [shape, elements] : byShape)
    portions.push_back({ set.name + (byShape.size() == 1 ? "" : "_" + shape), shape, elements });
  return portions;
}

} // namespace surgicalmesher
