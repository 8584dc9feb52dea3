// SPDX-License-Identifier: Apache-2.0
#include "Portions.h"

#include <map>

namespace surgicalmesher
{
namespace
{

const std::map<std::size_t, std::string> kShapes{ { 4, "tet4" }, { 6, "penta6" }, { 8, "hex8" }, { 10, "tet10" } };
const std::map<std::size_t, std::string> kFaceShapes{ { 3, "tri3" }, { 4, "quad4" }, { 6, "tri6" } };

std::vector<Portion> named(const std::string& name, const std::map<std::string, std::vector<std::int32_t>>& byShape)
{
  std::vector<Portion> portions;
  for (const auto& [shape, elements] : byShape)
    portions.push_back({ name + (byShape.size() == 1 ? "" : "_" + shape), shape, elements });
  return portions;
}

} // namespace

std::vector<Portion> portionsOf(const FiniteElementModel& model, const ElementSet& set)
{
  std::map<std::string, std::vector<std::int32_t>> byShape;
  for (const std::int32_t e : set.elements) byShape[kShapes.at(model.elements[e].size())].push_back(e);
  return named(set.name, byShape);
}

std::vector<Portion> portionsOf(const Shell& shell)
{
  std::map<std::string, std::vector<std::int32_t>> byShape;
  for (std::size_t i = 0; i < shell.cells.size(); ++i)
    byShape[kFaceShapes.at(shell.cells[i].size())].push_back(static_cast<std::int32_t>(i));
  return named(shell.name, byShape);
}

} // namespace surgicalmesher
