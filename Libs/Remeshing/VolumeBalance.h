// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Keeps the volume of every tissue: smoothing and least squares cut corners, which takes from whatever is convex.

#include "BackgroundMesh.h"
#include "TetComplex.h"
#include "VolumeOffsets.h"

#include <map>
#include <utility>

namespace surgicalmesher
{

class VolumeBalance
{
public:
  /// The volumes to keep, mm^3, and how far (mm) samples may go for that in all.
  VolumeBalance(std::map<Label, double> volumes, double most) : m_Most(most), m_Volumes(std::move(volumes)) {}

  /// Moves the boundary samples of every tissue that has gained or lost volume along its boundary's normals; twice the
  /// most between two tissues. `gain`: how much of the way that would make up for the volume, above 1 where angles hold
  /// vertices back from where the samples go. The mesh must know its neighbours.
  void apply(BackgroundMesh& background, double gain);

  /// How far (mm) the boundaries themselves should go, of all tissues at once, no farther than the most each time; some
  /// more than is missing, as not all vertices can follow. Of tissues that are off by less than
  /// `leastShare` of their volume, only the boundaries to the others move. The mesh must know its neighbours.
  TissueOffsets offsets(const BackgroundMesh& background, double leastShare = 0) const;
  TissueOffsets offsets(const TetComplex& complex, double leastShare = 0) const;

private:
  /// Of a mesh or a complex.
  struct Tetrahedra
  {
    const std::vector<Vec3>& points;
    const std::vector<std::array<std::int32_t, 4>>& corners; ///< the first one is -1: no tetrahedron
    const AcrossFaces& neighbours;
    const std::vector<Label>& labels;
  };
  struct Lack
  {
    std::vector<double> volumes;                     ///< mm^3, by label
    std::map<std::pair<Label, Label>, double> areas; ///< mm^2, by the labels on both sides, each pair once
  };
  static Tetrahedra tetrahedraOf(const BackgroundMesh& background);
  Lack lackOf(const Tetrahedra& tetrahedra) const;
  TissueOffsets offsetsFor(const Lack& lack, double leastShare) const;
  double stepOf(Label label, double wanted);

  double m_Most;
  std::map<Label, double> m_Volumes, m_Moved;
};

} // namespace surgicalmesher
