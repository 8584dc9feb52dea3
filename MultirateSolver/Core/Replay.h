// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Replay of recorded tools in a coupled mesh: children step at their own rate, and parent and children exchange Norton
/// equivalents at a lower rate (Audette et al., Computer Aided Surgery 12(1), 2007, after Astley and Hayward).

#include "CoupledParts.h"
#include "Progress.h"
#include "ToolPath.h"

namespace surgicalmesher
{

enum class ChildLaw
{
  Linear,
  NeoHookean
};

struct ReplayOptions
{
  ChildLaw law = ChildLaw::Linear;
  double childRate = 500;     ///< steps per second
  double parentRate = 25;     ///< exchanges per second; childRate must be a multiple of it
  double toolRadius = 2;      ///< mm: the tool holds the points of the child at rest this near to its first position
  double toolStiffness = 0.1; ///< N/mm, of all springs of a tool together
  double reach = 5;           ///< mm: largest distance of the nearest point at rest from the tool's first position
  /// N/mm^3, LPS. Default: a brain in cerebrospinal fluid, which it exceeds by 40 kg/m^3.
  Vec3 weight{ 0, 0, -4e-7 };
  double tolerance = 1e-6; ///< of the neo-Hookean child's equilibrium, relative to its largest force
};

/// One step of one child with a tool.
struct ReplayStep
{
  double seconds = 0;
  std::int32_t child = 1;
  Vec3 tip;                       ///< mm
  Vec3 force;                     ///< N, of the tool on the child
  double largestDisplacement = 0; ///< mm, of the child's points
  int iterations = 0;             ///< of Newton's method; 0 for a linear child
};

/// Wall times (s), to tell whether the machine keeps up; not part of the result.
struct ReplayTimes
{
  double preparation = 0;
  std::vector<double> steps, exchanges;
};

struct ReplaySizes
{
  std::int64_t wholeUnknowns = 0;
  struct Child
  {
    std::int64_t unknowns = 0, interfaceUnknowns = 0, heldUnknowns = 0, factorEntries = 0;
  };
  std::vector<Child> children;
};

struct ReplayResult
{
  std::vector<ReplayStep> steps;
  std::vector<Vec3> displacements; ///< mm, per point of the whole mesh, at the end
  ReplaySizes sizes;
  ReplayTimes times;
};

/// Called at every exchange with the displacements (mm) of all points of the whole mesh.
using FrameObserver = std::function<void(double seconds, const std::vector<Vec3>& displacements)>;

/// Replays the tools from the first time of any path to the last time of all. Throws InputError, with the number of the
/// tool from 1, if a tool is out of reach of every child or is the second one at a child; as Surroundings does; if
/// there are more than ten million steps; and if memory does not suffice for the dense matrix of an interface. Throws
/// UsageError for options out of range.
ReplayResult replay(const CoupledMesh& mesh, const std::vector<ToolPath>& tools, const ReplayOptions& options,
                    const FrameObserver& observer = {}, const Progress& progress = {});

} // namespace surgicalmesher
