// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A recorded tool drawn through a coupled mesh: children step at their own rate, parent and children exchange Norton
/// equivalents at a slower one (Audette et al., Computer Aided Surgery 12(1), 2007, after Astley and Hayward).

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
  double parentRate = 25;     ///< exchanges per second; the child's rate is a multiple of it
  double toolRadius = 2;      ///< mm: the tool takes hold of the child's points so near to its first place
  double toolStiffness = 0.1; ///< N/mm
  double reach = 5;           ///< mm: the nearest point may be so far away
  Vec3 weight{ 0, 0, -4e-7 }; ///< N/mm^3; a brain in cerebrospinal fluid, 40 kg/m^3 more than that, LPS
  double tolerance = 1e-6;    ///< of the neo-Hookean child's largest force
};

/// One step of one child with a tool.
struct ReplayStep
{
  double seconds = 0;
  std::int32_t child = 1;
  Vec3 tip;                       ///< mm
  Vec3 force;                     ///< N, of the tool on the child
  double largestDisplacement = 0; ///< mm, of the child's points
  int iterations = 0;             ///< of Newton's method
};

/// Wall time, s: what a machine can keep up with, and no part of the result.
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
  std::vector<Vec3> displacements; ///< mm, per point of the whole, at the end
  ReplaySizes sizes;
  ReplayTimes times;
};

/// Is told, at every exchange, the displacements of all points of the whole.
using FrameObserver = std::function<void(double seconds, const std::vector<Vec3>& displacements)>;

/// From the first time of any path to the last of all. Throws InputError, naming the tool by its number from 1, if it is
/// out of every child's reach, or two take hold of one child; as Surroundings does; if memory does not suffice for the
/// interface's dense matrix. UsageError if the options are out of their ranges.
ReplayResult replay(const CoupledMesh& mesh, const std::vector<ToolPath>& tools, const ReplayOptions& options,
                    const FrameObserver& observer = {}, const Progress& progress = {});

} // namespace surgicalmesher
