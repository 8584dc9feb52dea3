// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace surgicalmesher
{

/// What LocalRegistrationCLI reports of a registration.
struct FoundRegistration
{
  int agreeingStarts = 0; ///< of the other starts, how many lead to the same pose
  int otherStarts = 0;
  double scale = 1; ///< from the fixed image to the moving one
};

} // namespace surgicalmesher
