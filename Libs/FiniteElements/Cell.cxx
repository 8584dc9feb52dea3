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

/// Of a tetrahedron of second order: the corners as in kFaceCorners, then the nodes between them.
constexpr int kTenNodeFaces[4][6] = {
  { 1, 2, 3, 5, 9, 8 }, { 0, 3, 2, 7, 9, 6 }, { 0, 1, 3, 4, 8, 7 }, { 0, 2, 1, 6, 5, 4 }
};

template <class Places>
Cell nodesAt(const Places& places, const Cell& element)
{
  Cell result;
  for (const int place : places)
  {
    if (place != kNone) result.append(element[place]);
  }
  return result;
}

std::vector<std::int32_t> sortedUnique(std::vector<std::int32_t> ids)
{
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

} // namespace

int faceCount(const Cell& element) { return element.size() == 6 ? 5 : element.size() == 8 ? 6 : 4; }

Cell faceOf(const Cell& element, int face)
{
  switch (element.size())
  {
  case 6: return nodesAt(kWedgeFaces[face], element);
  case 8: return nodesAt(kHexahedronFaces[face], element);
  case 10: return nodesAt(kTenNodeFaces[face], element);
  default: return nodesAt(kFaceCorners[face], element);
  }
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
