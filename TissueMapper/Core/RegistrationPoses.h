// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The pose that brings two images together, by a search among many on coarse images.

#include "ImageRegistration.h"
#include "LinearParameters.h"
#include "RegistrationSamples.h"

#include <string>
#include <vector>

namespace surgicalmesher
{

/// A pose and how good it is. Information is weighed by overlap: of a few samples at a corner it is always large.
struct Pose
{
  LinearParameters parameters{};
  double information = 0;
};

class PoseSearch
{
public:
  PoseSearch(Level level, const Extent& extent) : m_Level(std::move(level)), m_Extent(extent) {}

  void measure(std::vector<Pose>& poses) const;
  /// Each pose's nearest maximum.
  void follow(std::vector<Pose>& poses) const;
  /// The best poses, no two within `apart` (mm).
  std::vector<Pose> best(std::vector<Pose> poses, std::size_t count, double apart) const;
  double distance(const LinearParameters& a, const LinearParameters& b) const;

  const Level& level() const { return m_Level; }
  const Extent& extent() const { return m_Extent; }

private:
  Level m_Level;
  Extent m_Extent;
};

/// The best few poses to start from.
std::vector<Pose> startingPoses(const RegistrationOptions& options, const PoseSearch& search);

/// Starts that lead to the best pose.
struct Agreement
{
  int count = 0;
  int of = 0;
};

/// That other starts, and poses 6 mm and 6 degrees beside it, lead to the pose, and to no other place nearly as good.
/// Throws InputError otherwise.
Agreement requireThatItConverges(const PoseSearch& search, const Pose& found, const std::vector<Pose>& others);

/// Throws InputError with the reason.
[[noreturn]] void failToConverge(const std::string& reason);

} // namespace surgicalmesher
