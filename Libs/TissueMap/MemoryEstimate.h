// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How much memory meshing a map will take, before it is meshed: better refused at once than ended by the system later.

#include "ScaleField.h"
#include "TissueMap.h"

#include <cstdint>
#include <optional>
#include <string>

namespace surgicalmesher
{

/// Expected peak of the surface stage, bytes. The complex begins as cubes of a power of two times the voxel and at most
/// 0.8 L, of voxels where tissues meet; nothing later is as large. With F the voxel faces between labels (those towards
/// the outside included), K the number of these cubes in tissue, and N the voxels,
///
///     bytes = 25 MB + 750 F + 370 K + 40 N
///
/// The constants were fitted to the peaks below and then raised, so that the estimate errs on the safe side. Estimate
/// over measured peak (MB), islands under 30 mm^3 removed:
///
///                                                   measured  estimate
///     box of 60 mm of jhu189, L 0.7 to 8 mm             114      1.14
///     the same, L 1 to 8 mm                             111      1.12
///     the same, L 4 mm                                   99      1.16
///     the same, L 1 mm                                  633      1.04
///     box of 15 mm at 0.5 mm, L 0.5 mm                  526      1.01
///     two balls, one in the other, 1 M voxels, L 2 mm   209      1.19
///     the same, L 8 mm                                  105      1.03
///     jhu189 whole at 1 mm, L 1 to 8 mm                 580      1.00
///     jhu189 whole at 0.5 mm, L 1 to 8 mm              2688      1.04
///     head of 256^3 voxels along a path, L 1 to 10 mm   995      1.17
///
/// They were measured when every cube that a boundary crosses was cut down to voxels. Only its mixed tetrahedra are cut
/// now, and the peak of jhu189 at 1 mm is 352 MB: the estimate is higher than needed by up to two thirds.
std::uint64_t estimateSurfaceMemory(const TissueMap& map, const ScaleField& scale);

/// Throws InputError, with the map's name and both figures, if less than `needed` bytes are available. Does nothing
/// where `available` is unknown (see availableMemory()).
void requireMemory(std::uint64_t needed, const std::optional<std::uint64_t>& available, const std::string& mapFile);

} // namespace surgicalmesher
