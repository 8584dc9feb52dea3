// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Tissues of a head from MR images, a CT, or both, and a few training points a class (Audette et al., section 2.2:
/// structure-preserving classification).

#include "HeadCompartments.h"
#include "TissueMap.h"

#include <string>
#include <vector>

namespace surgicalmesher
{

/// Where a class may be.
enum class Admission
{
  Anywhere, ///< in soft tissue
  Intracranial,
  Extracranial, ///< in orbits or not
  Intraorbital,
  Bone ///< the class that the skull is made of
};

struct TissueClass
{
  std::string name;
  Label label = 1;
  Admission admission = Admission::Anywhere;
  bool isContiguous = false; ///< only where it is joined to one of its training points by voxels of its own
  double limit = 0;          ///< mm: largest way from the training points through its own voxels; 0: none
  std::vector<Vec3> points;  ///< training points, world frame
};

/// Each of the paper's constraints can be left out.
struct ClassificationOptions
{
  bool useCompartments = true;
  bool useContiguity = true; ///< contiguity and spatial limit
  bool useProximity = true;  ///< to what is certain, where these take a voxel from its class
  bool correctBias = false;
  bool denoise = false;
  bool withProbabilities = false;
};

/// What a head is usually made of: skull and bone are bone; CSF, grey and white matter lie within the skull; eyes, optic
/// nerves and what has orbit, orbital, ocular or rectus in its name within the orbits; fat, muscle, skin and connective
/// tissue outside the skull. Anywhere for other names.
Admission usualAdmission(const std::string& name);

struct Classification
{
  TissueMap map; ///< labels and names of the classes; 0 outside the head
  std::vector<Compartment> compartments;
  float boneThreshold = 0;
  std::vector<std::size_t> invalidated; ///< by class: voxels that contiguity took away
  /// If asked for, by class and voxel: by brightness, among the classes that its compartment admits.
  std::vector<std::vector<float>> probabilities;
};

/// Compartments as tissues: label (their number), name and colour.
TissueTable compartmentTable();

/// Bone is told by the CT, or else by the first image, an MR in which bone is dark. Throws InputError for fewer than two
/// classes, a class without points, a point outside the image, no class or several of bone, bone that isn't darker than
/// the rest (denser in a CT), compartments without training points on both sides, and a compartment in which no class
/// may be. The same bytes whatever the number of threads.
Classification classifyTissues(HeadImages images, const std::vector<TissueClass>& classes,
                               const ClassificationOptions& options, const Progress& progress = {});

} // namespace surgicalmesher
