// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace surgicalmesher
{

/// Result of a registration, as reported by LocalRegistrationCLI.
struct FoundRegistration
{
  int agreeingStarts = 0; ///< how many of the other starts lead to the same pose
  int otherStarts = 0;
  double scale = 1; ///< from the fixed image to the moving one
};

} // namespace surgicalmesher
