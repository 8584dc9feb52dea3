// SPDX-License-Identifier: Apache-2.0
#include "SubMeshes.h"

#include "FaceAdjacency.h"

#include <algorithm>
#include <cctype>
#include <limits>
#include <map>
#include <numeric>

namespace surgicalmesher
{
namespace
{

std::vector<bool> fineTetrahedra(const TetMesh& mesh, const SizingFunction& edgeLength, double tolerance)
{
  std::vector<double> length(mesh.tetrahedra.size());
  for (std::size_t t = 0; t < length.size(); ++t)
  {
    const auto& [a, b, c, d] = mesh.tetrahedra[t];
    length[t] = edgeLength(0.25 * (mesh.points[a] + mesh.points[b] + mesh.points[c] + mesh.points[d]));
  }
  const double finest = *std::min_element(length.begin(), length.end());
  std::vector<bool> fine(length.size());
  for (std::size_t t = 0; t < length.size(); ++t) fine[t] = length[t] <= finest * (1 + tolerance);
  if (std::find(fine.begin(), fine.end(), false) == fine.end()) fine.assign(fine.size(), false);
  return fine;
}

std::vector<std::int32_t> sizesOf(const std::vector<std::int32_t>& region)
{
  std::vector<std::int32_t> sizes(region.empty() ? 0 : 1 + *std::max_element(region.begin(), region.end()), 0);
  for (const std::int32_t r : region) ++sizes[r];
  return sizes;
}

/// Returns the largest fine regions as children 1..n, everything else as 0.
std::vector<std::int32_t> largeFineRegions(const FaceAdjacency& neighbours, const std::vector<bool>& fine,
                                           double speckFraction)
{
  const std::vector<std::int32_t> region =
    faceRegions(neighbours, [&](std::int32_t t, int f) { return fine[t] == fine[neighbours.across[t][f]]; });
  std::vector<std::int32_t> sizes = sizesOf(region);
  for (std::size_t t = 0; t < region.size(); ++t)
  {
    if (!fine[t]) sizes[region[t]] = 0;
  }
  std::vector<std::int32_t> order(sizes.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) { return sizes[a] > sizes[b]; });
  std::vector<std::int32_t> child(sizes.size(), 0);
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const std::int32_t size = sizes[order[i]];
    if (size > 0 && size >= speckFraction * sizes[order.front()]) child[order[i]] = static_cast<std::int32_t>(i + 1);
  }
  std::vector<std::int32_t> result(region.size());
  for (std::size_t t = 0; t < region.size(); ++t) result[t] = child[region[t]];
  return result;
}

/// Assigns the separated pieces of the parent to the child with which they share most faces, if that child is larger.
void absorbPieces(const FaceAdjacency& neighbours, std::vector<std::int32_t>& subMesh)
{
  const std::vector<std::int32_t> body = faceRegions(neighbours, [](std::int32_t, int) { return true; });
  const std::vector<std::int32_t> piece =
    faceRegions(neighbours, [&](std::int32_t t, int f) { return subMesh[t] == subMesh[neighbours.across[t][f]]; });
  const std::vector<std::int32_t> sizes = sizesOf(piece), childSizes = sizesOf(subMesh);
  std::map<std::int32_t, std::int32_t> mainPiece;                            // by body
  std::map<std::int32_t, std::map<std::int32_t, std::int32_t>> facesToChild; // by piece and child
  for (std::size_t t = 0; t < piece.size(); ++t)
  {
    if (subMesh[t] != 0) continue;
    std::int32_t& main = mainPiece.emplace(body[t], piece[t]).first->second;
    if (sizes[piece[t]] > sizes[main]) main = piece[t];
    for (const std::int32_t beyond : neighbours.across[t])
    {
      if (beyond >= 0 && subMesh[beyond] != 0) ++facesToChild[piece[t]][subMesh[beyond]];
    }
  }
  for (std::size_t t = 0; t < piece.size(); ++t)
  {
    if (subMesh[t] != 0 || piece[t] == mainPiece.at(body[t])) continue;
    const auto& faces = facesToChild.at(piece[t]);
    const auto most =
      std::max_element(faces.begin(), faces.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    if (sizes[piece[t]] < childSizes[most->first]) subMesh[t] = most->first;
  }
}

std::vector<std::int32_t> pointsBetween(const TetMesh& mesh, const std::vector<std::int32_t>& subMesh)
{
  std::vector<std::int32_t> seen(mesh.points.size(), -1);
  std::vector<bool> between(mesh.points.size(), false);
  for (std::size_t t = 0; t < subMesh.size(); ++t)
  {
    for (const std::int32_t id : mesh.tetrahedra[t])
    {
      if (seen[id] >= 0 && seen[id] != subMesh[t]) between[id] = true;
      seen[id] = subMesh[t];
    }
  }
  std::vector<std::int32_t> result;
  for (std::size_t i = 0; i < between.size(); ++i)
  {
    if (between[i]) result.push_back(static_cast<std::int32_t>(i));
  }
  return result;
}

std::vector<std::int32_t> countPieces(const FaceAdjacency& neighbours, const std::vector<std::int32_t>& subMesh,
                                      std::int32_t children)
{
  const std::vector<std::int32_t> piece =
    faceRegions(neighbours, [&](std::int32_t t, int f) { return subMesh[t] == subMesh[neighbours.across[t][f]]; });
  std::vector<std::int32_t> result(children + 1, 0);
  std::int32_t seen = 0;
  for (std::size_t t = 0; t < piece.size(); ++t)
  {
    if (piece[t] < seen) continue;
    ++seen;
    ++result[subMesh[t]];
  }
  return result;
}

} // namespace

SubMeshes divideIntoSubMeshes(const TetMesh& mesh, const SizingFunction& edgeLength, const SubMeshOptions& options)
{
  SubMeshes result;
  if (mesh.tetrahedra.empty()) return result;
  const FaceAdjacency neighbours = faceAdjacency(mesh);
  const std::vector<bool> fine = fineTetrahedra(mesh, edgeLength, options.tolerance);
  result.ofTetrahedron = largeFineRegions(neighbours, fine, options.speckFraction);
  absorbPieces(neighbours, result.ofTetrahedron);
  result.children = *std::max_element(result.ofTetrahedron.begin(), result.ofTetrahedron.end());
  result.interfacePoints = pointsBetween(mesh, result.ofTetrahedron);
  result.pieces = countPieces(neighbours, result.ofTetrahedron, result.children);
  return result;
}

std::vector<std::int32_t> constitutiveModels(const TetMesh& mesh, const std::vector<std::int32_t>& subMesh,
                                             const TissueTable& tissues)
{
  constexpr std::int32_t nonlinear = 1, nullDisplacement = 2;
  std::vector<std::int32_t> result(mesh.tetrahedra.size());
  for (std::size_t t = 0; t < result.size(); ++t) result[t] = subMesh[t] > 0 ? nonlinear : 0;
  for (const auto& [label, tissue] : tissues)
  {
    if (!tissue.isNullDisplacement) continue;
    for (std::size_t t = 0; t < result.size(); ++t)
    {
      if (mesh.labels[t] == label) result[t] = nullDisplacement;
    }
  }
  return result;
}

} // namespace surgicalmesher
