// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Preserves the volume of every tissue: smoothing and least-squares fits cut corners, so convex shapes lose volume.

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
  /// `volumes`: to preserve, mm^3. `most`: mm, bound on the sum of the steps of apply() for each tissue, and on each
  /// offset that offsets() returns.
  VolumeBalance(std::map<Label, double> volumes, double most) : m_Most(most), m_Volumes(std::move(volumes)) {}

  /// Moves the boundary samples of every tissue that has gained or lost volume along the normals of its boundary;
  /// samples between two tissues by the difference of both steps. `gain`: factor on the distance that would restore the
  /// volume; above 1 where angles keep vertices from following the samples. `background.neighbours` must be filled.
  void apply(BackgroundMesh& background, double gain);

  /// Returns the offsets (mm) of all tissues' boundaries that restore their volumes, 1.3 times as large as needed, as
  /// not all vertices can follow. Tissues whose error is below `leastShare` of their volume get no offset of their own:
  /// only their boundaries with other tissues move. The neighbours must be known.
  TissueOffsets offsets(const BackgroundMesh& background, double leastShare = 0) const;
  TissueOffsets offsets(const TetComplex& complex, double leastShare = 0) const;

private:
  /// The tetrahedra of a mesh or of a complex.
  struct Tetrahedra
  {
    const std::vector<Vec3>& points;
    const std::vector<std::array<std::int32_t, 4>>& corners; ///< the first corner is -1 for a deleted tetrahedron
    const AcrossFaces& neighbours;
    const std::vector<Label>& labels;
  };
  /// Volumes that are missing, and the areas between labels.
  struct Lack
  {
    std::vector<double> volumes;                     ///< mm^3, by label; negative: too large
    std::map<std::pair<Label, Label>, double> areas; ///< mm^2, by pair of labels, the smaller one first
  };
  static Tetrahedra tetrahedraOf(const BackgroundMesh& background);
  Lack lackOf(const Tetrahedra& tetrahedra) const;
  TissueOffsets offsetsFor(const Lack& lack, double leastShare) const;
  double stepOf(Label label, double wanted);

  double m_Most;
  std::map<Label, double> m_Volumes, m_Moved;
};

} // namespace surgicalmesher
