// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Letting the host go on with its work while a test or the tutorial waits.

#include <functional>

namespace surgicalmesher::test
{

/// Handles events (timers, queued signals, results of runs) until the condition holds. False if it does not within so
/// many seconds.
bool waitUntil(const std::function<bool()>& condition, double seconds = 120);

/// Handles events for so many seconds.
void waitFor(double seconds);

} // namespace surgicalmesher::test
