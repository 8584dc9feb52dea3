// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Elements and their faces as lists of node ids.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

namespace surgicalmesher
{

/// Node ids of an element or a face. An element of four nodes is a tetrahedron, of six a wedge, of eight a hexahedron:
/// the base counter-clockwise as seen from inside, then the opposite side (or corner) in the same order, as in Abaqus.
/// Ten nodes are a tetrahedron of second order (see SecondOrder.h). A face of three or four nodes is counter-clockwise
/// as seen from outside; six nodes are a triangle of second order.
class Cell
{
public:
  Cell() = default;
  Cell(std::initializer_list<std::int32_t> ids) : m_Size(ids.size())
  {
    std::copy(ids.begin(), ids.end(), m_Ids.begin());
  }
  template <std::size_t N>
  Cell(const std::array<std::int32_t, N>& ids) : m_Size(N)
  {
    static_assert(N <= kMost);
    std::copy(ids.begin(), ids.end(), m_Ids.begin());
  }

  std::size_t size() const { return m_Size; }
  std::int32_t operator[](std::size_t i) const { return m_Ids[i]; }
  std::int32_t* begin() { return m_Ids.data(); }
  std::int32_t* end() { return m_Ids.data() + m_Size; }
  const std::int32_t* begin() const { return m_Ids.data(); }
  const std::int32_t* end() const { return m_Ids.data() + m_Size; }

  void append(std::int32_t id) { m_Ids[m_Size++] = id; }

  friend bool operator==(const Cell& a, const Cell& b) { return a.m_Size == b.m_Size && a.m_Ids == b.m_Ids; }
  friend bool operator<(const Cell& a, const Cell& b) { return a.m_Ids < b.m_Ids; }

private:
  static constexpr std::size_t kMost = 10;
  std::array<std::int32_t, kMost> m_Ids{}; ///< 0 beyond the size
  std::size_t m_Size = 0;
};

/// A face of an element. For a tetrahedron, `face` is the number of the opposite corner (see kFaceCorners); for wedges
/// and hexahedra, it is 0 to 4 or 5 in the order of Abaqus (S1 and up).
struct ElementFace
{
  std::int32_t element;
  std::int32_t face;
};

/// Elements of ten nodes have four faces of six.
int faceCount(const Cell& element);
Cell faceOf(const Cell& element, int face);

/// Returns the same face, of three or four nodes, with the opposite orientation and the same first node.
Cell turnedRound(const Cell& face);

/// Returns the cell with VTK's node numbering, in which the triangles of a wedge have the opposite orientation; other
/// cells are unchanged.
Cell inOrderOfVtk(const Cell& cell);

/// Returns the cell with its ids ascending, a key that is independent of the orientation.
Cell sorted(Cell cell);

/// Returns the nodes of the cells, ascending.
std::vector<std::int32_t> nodesOf(const std::vector<Cell>& cells);

/// Returns the nodes, out of `count`, at which cells of several groups meet, ascending. `group` holds the group of each
/// cell.
std::vector<std::int32_t> nodesOfSeveral(const std::vector<Cell>& cells, std::size_t count,
                                         const std::vector<std::int32_t>& group);

} // namespace surgicalmesher
