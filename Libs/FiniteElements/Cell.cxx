// SPDX-License-Identifier: Apache-2.0
#include "Cell.h"

#include "FaceAdjacency.h"

#include <utility>

namespace surgicalmesher
{
namespace
{

constexpr int kNone = -1; ///< in place of the fourth corner of a triangle

constexpr int kWedgeFaces[5][4] = {
  { 0, 2, 1, kNone }, { 3, 4, 5, kNone }, { 0, 1, 4, 3 }, { 1, 2, 5, 4 }, { 2, 0, 3, 5 }
};
constexpr int kHexahedronFaces[6][4] = { { 0, 3, 2, 1 }, { 4, 5, 6, 7 }, { 0, 1, 5, 4 },
                                         { 1, 2, 6, 5 }, { 2, 3, 7, 6 }, { 3, 0, 4, 7 } };

std::vector<std::int32_t> sortedUnique(std::vector<std::int32_t> ids)
{
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

} // namespace

int faceCount(const Cell& element) { return element.size() == 4 ? 4 : element.size() == 6 ? 5 : 6; }

Cell faceOf(const Cell& element, int face)
{
  Cell result;
  if (element.size() == 4)
  {
    for (const int corner : kFaceCorners[face]) result.append(element[corner]);
    return result;
  }
  for (const int corner : element.size() == 6 ? kWedgeFaces[face] : kHexahedronFaces[face])
  {
    if (corner != kNone) result.append(element[corner]);
  }
  return result;
}

Cell turnedRound(const Cell& face)
{
  Cell result = face;
  std::reverse(result.begin() + 1, result.end());
  return result;
}

Cell inOrderOfVtk(const Cell& cell)
{
  if (cell.size() != 6) return cell;
  return { cell[0], cell[2], cell[1], cell[3], cell[5], cell[4] };
}

Cell sorted(Cell cell)
{
  std::sort(cell.begin(), cell.end());
  return cell;
}

std::vector<std::int32_t> nodesOf(const std::vector<Cell>& cells)
{
  std::vector<std::int32_t> ids;
  for (const Cell& cell : cells) ids.insert(ids.end(), cell.begin(), cell.end());
  return sortedUnique(std::move(ids));
}

std::vector<std::int32_t> nodesOfSeveral(const std::vector<Cell>& cells, std::size_t count,
                                         const std::vector<std::int32_t>& group)
{
  std::vector<std::int32_t> first(count, -1), result;
  for (std::size_t c = 0; c < group.size(); ++c)
  {
    for (const std::int32_t id : cells[c])
    {
      if (first[id] < 0) first[id] = group[c];
      else if (first[id] != group[c]) result.push_back(id);
    }
  }
  return sortedUnique(std::move(result));
}

} // namespace surgicalmesher
