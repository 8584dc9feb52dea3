// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Classification of the tissues of a head from MR images, a CT, or both, and a few training points per class (Audette
/// et al., section 2.2: structure-preserving classification).

#include "HeadCompartments.h"
#include "TissueMap.h"

#include <string>
#include <vector>

namespace surgicalmesher
{

/// Where a class is admitted.
enum class Admission
{
  Anywhere, ///< in soft tissue
  Intracranial,
  Extracranial, ///< in orbits or elsewhere outside the skull
  Intraorbital,
  Bone ///< in bone; exactly one class
};

struct TissueClass
{
  std::string name;
  Label label = 1;
  Admission admission = Admission::Anywhere;
  bool isContiguous = false; ///< keep only voxels connected to a training point through voxels of this class
  double limit = 0;          ///< longest path (mm) from a training point through voxels of this class; 0: no limit
  std::vector<Vec3> points;  ///< training points, world frame
};

/// Whether contiguity or a limit holds for a class.
inline bool isBound(const TissueClass& tissue) { return tissue.isContiguous || tissue.limit > 0; }

/// The paper's constraints, each of which can be switched off.
struct ClassificationOptions
{
  bool useCompartments = true;
  bool useContiguity = true; ///< apply contiguity and limit of each class
  bool useProximity = true;  ///< where these take a voxel from its class, prefer classes that are certain nearby
  bool correctBias = false;
  bool denoise = false;
  bool withProbabilities = false;
};

/// Returns the admission implied by a class name: Bone for skull and bone; Intracranial for CSF, grey and white matter
/// and brain; Intraorbital for eyes, optic nerves and names with orbit, ocular or rectus; Extracranial for fat, muscle,
/// skin and connective tissue; Anywhere for other names.
Admission usualAdmission(const std::string& name);

struct Classification
{
  TissueMap map; ///< labels and names of the classes; 0 outside the head
  std::vector<Compartment> compartments;
  float boneThreshold = 0;
  std::vector<std::size_t> invalidated; ///< by class: voxels taken from the class by contiguity or limit
  /// By class: voxels that contiguity or limit forbid the class, and that it keeps as no other class may take them.
  std::vector<std::size_t> unreached;
  /// By class and voxel, if asked for: probability by brightness among the classes that the voxel's compartment admits.
  std::vector<std::vector<float>> probabilities;
};

/// Returns the compartments as a tissue table: label (the number of the compartment), name and colour.
TissueTable compartmentTable();

/// Classifies every voxel of the head. Bone is detected in the CT, or, without a CT, in the first image, an MR image in
/// which bone is dark. Throws InputError for fewer than two classes; a class without points; a point outside the image;
/// no class or several classes of bone; bone with contiguity or a limit; bone that is not darker (in a CT: denser) than
/// the rest; compartments without training points on both sides of the skull; a compartment that admits no class; and
/// images with too few voxels along an axis for the filters asked for. The result is bitwise the same for any number of
/// threads.
Classification classifyTissues(HeadImages images, const std::vector<TissueClass>& classes,
                               const ClassificationOptions& options, const Progress& progress = {});

} // namespace surgicalmesher
