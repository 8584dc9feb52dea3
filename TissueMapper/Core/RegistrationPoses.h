// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Search for the pose that aligns two coarse images.

#include "ImageRegistration.h"
#include "LinearParameters.h"
#include "RegistrationSamples.h"

#include <string>
#include <vector>

namespace surgicalmesher
{

/// A pose and its quality: mutual information (nats) times overlap. Unweighted, the information of a few samples in a
/// corner would always be large.
struct Pose
{
  LinearParameters parameters{};
  double information = 0;
};

class PoseSearch
{
public:
  PoseSearch(Level level, const Extent& extent) : m_Level(std::move(level)), m_Extent(extent) {}

  /// Sets the quality of each pose.
  void measure(std::vector<Pose>& poses) const;
  /// Moves each pose to its nearest maximum and sets its quality.
  void follow(std::vector<Pose>& poses) const;
  /// Returns the best poses, up to `count`, no two closer than `apart` (mm).
  std::vector<Pose> best(std::vector<Pose> poses, std::size_t count, double apart) const;
  /// Root mean square distance (mm) between the two poses of the search's extent.
  double distance(const LinearParameters& a, const LinearParameters& b) const;

  const Level& level() const { return m_Level; }
  const Extent& extent() const { return m_Extent; }

private:
  Level m_Level;
  Extent m_Extent;
};

/// Returns the best initial poses, up to six.
std::vector<Pose> startingPoses(const RegistrationOptions& options, const PoseSearch& search);

/// How many of the other starts lead to the best pose.
struct Agreement
{
  int count = 0;
  int of = 0;
};

/// Checks that other starts, and poses 6 mm and 6 degrees beside `found`, converge to `found`, and that no distant pose
/// is nearly as good. `others` are the converged starts, with `found` among them. Throws InputError otherwise.
Agreement requireThatItConverges(const PoseSearch& search, const Pose& found, const std::vector<Pose>& others);

/// Throws InputError with the reason.
[[noreturn]] void failToConverge(const std::string& reason);

} // namespace surgicalmesher
