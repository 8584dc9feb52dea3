// SPDX-License-Identifier: Apache-2.0
#include "CoupledParts.h"

#include "ConstitutiveTags.h"
#include "Errors.h"
#include "FaceAdjacency.h"
#include "Place.h"

#include <algorithm>
#include <numeric>

namespace surgicalmesher
{
namespace
{

constexpr double kHeldShare = 0.05;
constexpr double kSamePlace = 1e-4; ///< mm; single precision at a metre from the origin

/// Returns the face-connected component of each tetrahedron, numbered from 1 in descending order of size.
std::vector<std::int32_t> piecesBySize(const TetMesh& mesh, std::int32_t& count)
{
  std::vector<std::int32_t> piece = faceRegions(faceAdjacency(mesh), [](std::int32_t, int) { return true; });
  count = 1 + *std::max_element(piece.begin(), piece.end());
  std::vector<std::int64_t> size(std::size_t(count), 0);
  for (const std::int32_t p : piece) ++size[std::size_t(p)];
  std::vector<std::int32_t> order(static_cast<std::size_t>(count)), rank(order);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return size[std::size_t(a)] > size[std::size_t(b)]; });
  for (std::int32_t r = 0; r < count; ++r) rank[std::size_t(order[std::size_t(r)])] = r + 1;
  for (std::int32_t& p : piece) p = rank[std::size_t(p)];
  return piece;
}

void requireIds(const MeshFile& file, const char* which)
{
  if (file.volumePointId.size() != file.mesh.points.size())
    throw InputError(std::string("the ") + which +
                     "'s points have no VolumePointId, expected a file of "
                     "FuchsTetrahedralizerCLI --" +
                     which + "Mesh");
  std::vector<std::int32_t> ids = file.volumePointId;
  std::sort(ids.begin(), ids.end());
  const auto twice = std::adjacent_find(ids.begin(), ids.end());
  if (twice != ids.end())
    throw InputError("VolumePointId " + std::to_string(*twice) + " stands twice in the " + which +
                     ", expected every id once");
}

std::vector<std::int32_t> allIds(const MeshFile& parent, const MeshFile& child)
{
  std::vector<std::int32_t> ids = parent.volumePointId;
  ids.insert(ids.end(), child.volumePointId.begin(), child.volumePointId.end());
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  if (ids.size() == parent.mesh.points.size() + child.mesh.points.size())
    throw InputError("parent and child share no point, expected the two parts of one mesh");
  return ids;
}

class Joining
{
public:
  explicit Joining(CoupledMesh& result) : m_Result(result), m_IsPlaced(result.volumePointIds.size(), false)
  {
    result.whole.mesh.points.resize(result.volumePointIds.size());
    m_IsHeld.assign(result.volumePointIds.size(), false);
  }

  void add(const MeshFile& file, const std::vector<std::int32_t>& part,
           const std::map<Label, TissueMaterial>& materials)
  {
    const std::vector<std::int32_t> number = place(file);
    TetMesh& mesh = m_Result.whole.mesh;
    for (std::size_t t = 0; t < file.mesh.tetrahedra.size(); ++t)
    {
      std::array<std::int32_t, 4> corners = file.mesh.tetrahedra[t];
      for (std::int32_t& corner : corners) corner = number[std::size_t(corner)];
      const bool isStill = !file.constitutive.empty() && file.constitutive[t] == kNullDisplacement;
      for (const std::int32_t corner : corners)
        m_IsHeld[std::size_t(corner)] = m_IsHeld[std::size_t(corner)] || isStill;
      mesh.tetrahedra.push_back(corners);
      mesh.labels.push_back(file.mesh.labels[t]);
      const auto row = materials.find(file.mesh.labels[t]);
      const TissueMaterial material = row == materials.end() ? TissueMaterial{} : row->second;
      m_Result.whole.lame.push_back(lameConstants(material.youngsModulus, material.poissonsRatio));
    }
    m_Result.part.insert(m_Result.part.end(), part.begin(), part.end());
  }

  void numberFreePoints()
  {
    if (std::find(m_IsHeld.begin(), m_IsHeld.end(), true) == m_IsHeld.end()) holdLowest();
    ElasticBody& whole = m_Result.whole;
    for (const bool isHeld : m_IsHeld) whole.unknowns.push_back(isHeld ? -1 : whole.freePoints++);
  }

private:
  /// Adds the points of the file; returns, for each of them, its number in the whole mesh.
  std::vector<std::int32_t> place(const MeshFile& file)
  {
    std::vector<std::int32_t> number;
    const auto& ids = m_Result.volumePointIds;
    for (std::size_t p = 0; p < file.mesh.points.size(); ++p)
    {
      const auto n = std::size_t(std::lower_bound(ids.begin(), ids.end(), file.volumePointId[p]) - ids.begin());
      Vec3& point = m_Result.whole.mesh.points[n];
      if (m_IsPlaced[n] && norm(point - file.mesh.points[p]) > kSamePlace)
        throw InputError("point " + std::to_string(ids[n]) + " lies at " + surgicalmesher::place(point) +
                         " in the parent and at " + surgicalmesher::place(file.mesh.points[p]) +
                         " in the child, expected the two parts of one mesh");
      point = file.mesh.points[p];
      m_IsPlaced[n] = true;
      number.push_back(std::int32_t(n));
    }
    return number;
  }

  void holdLowest()
  {
    const TetMesh& mesh = m_Result.whole.mesh;
    std::vector<bool> isParents(mesh.points.size(), true);
    for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
      for (const std::int32_t corner : mesh.tetrahedra[t])
        if (m_Result.part[t] > 0) isParents[std::size_t(corner)] = false;
    std::vector<double> heights;
    for (std::size_t p = 0; p < mesh.points.size(); ++p)
      if (isParents[p]) heights.push_back(mesh.points[p].z);
    if (heights.empty())
      throw InputError("the parent has no point of its own, expected some by which the mesh is held");
    std::sort(heights.begin(), heights.end());
    const double level = heights[std::size_t(kHeldShare * double(heights.size() - 1))];
    for (std::size_t p = 0; p < mesh.points.size(); ++p) m_IsHeld[p] = isParents[p] && mesh.points[p].z <= level;
  }

  CoupledMesh& m_Result;
  std::vector<bool> m_IsPlaced, m_IsHeld;
};

} // namespace

CoupledMesh coupledMesh(const MeshFile& parent, const MeshFile& child, const std::map<Label, TissueMaterial>& materials)
{
  requireIds(parent, "parent");
  requireIds(child, "child");
  CoupledMesh result;
  result.volumePointIds = allIds(parent, child);
  Joining joining(result);
  joining.add(parent, std::vector<std::int32_t>(parent.mesh.tetrahedra.size(), 0), materials);
  joining.add(child, piecesBySize(child.mesh, result.children), materials);
  joining.numberFreePoints();
  return result;
}

Part partOf(const CoupledMesh& mesh, const std::vector<bool>& parts)
{
  const ElasticBody& whole = mesh.whole;
  Part result;
  std::vector<std::int32_t> number(whole.mesh.points.size(), -1);
  for (std::size_t t = 0; t < whole.mesh.tetrahedra.size(); ++t)
    for (const std::int32_t corner : whole.mesh.tetrahedra[t])
      if (parts[std::size_t(mesh.part[t])]) number[std::size_t(corner)] = 0;
  for (std::size_t p = 0; p < number.size(); ++p)
  {
    if (number[p] < 0) continue;
    number[p] = std::int32_t(result.points.size());
    result.points.push_back(std::int32_t(p));
    result.body.mesh.points.push_back(whole.mesh.points[p]);
    result.body.unknowns.push_back(whole.unknowns[p] < 0 ? -1 : result.body.freePoints++);
  }
  for (std::size_t t = 0; t < whole.mesh.tetrahedra.size(); ++t)
  {
    if (!parts[std::size_t(mesh.part[t])]) continue;
    std::array<std::int32_t, 4> corners = whole.mesh.tetrahedra[t];
    for (std::int32_t& corner : corners) corner = number[std::size_t(corner)];
    result.body.mesh.tetrahedra.push_back(corners);
    result.body.mesh.labels.push_back(whole.mesh.labels[t]);
    result.body.lame.push_back(whole.lame[t]);
  }
  return result;
}

Interface interfaceOf(const Part& first, const Part& second)
{
  Interface result;
  for (std::size_t a = 0, b = 0; a < first.points.size() && b < second.points.size();)
  {
    if (first.points[a] != second.points[b])
    {
      ++(first.points[a] < second.points[b] ? a : b);
      continue;
    }
    for (std::int32_t i = 0; i < 3 && first.body.unknowns[a] >= 0; ++i)
    {
      result.first.push_back(3 * first.body.unknowns[a] + i);
      result.second.push_back(3 * second.body.unknowns[b] + i);
    }
    ++a;
    ++b;
  }
  return result;
}

} // namespace surgicalmesher
