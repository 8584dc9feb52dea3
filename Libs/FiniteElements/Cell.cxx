// SPDX-License-Identifier: Apache-2.0
#include "Cell.h"

#include "FaceAdjacency.h"

namespace surgicalmesher
{
namespace
{

constexpr int kNone = -1; ///< in place of a triangle's fourth corner

constexpr int kWedgeFaces[5][4] = {
  { 0, 2, 1, kNone }, { 3, 4, 5, kNone }, { 0, 1, 4, 3 }, { 1, 2, 5, 4 }, { 2, 0, 3, 5 }
};
constexpr int kHexahedronFaces[6][4] = { { 0, 3, 2, 1 }, { 4, 5, 6, 7 }, { 0, 1, 5, 4 },
                                         { 1, 2, 6, 5 }, { 2, 3, 7, 6 }, { 3, 0, 4, 7 } };

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

} // namespace surgicalmesher
