// SPDX-License-Identifier: Apache-2.0
#pragma once
/// For code that ends the process when it fails, or never ends: failed assertions, exit() and crashes then end another
/// one.

#include <functional>
#include <optional>
#include <string>

namespace surgicalmesher
{

/// What `work` returns, or nothing if its process did not come to that: it crashed, aborted, exited, or `work` threw.
/// So it is if it takes more than `mostSeconds` of processor time or ten times as long by the clock (0: no limit).
/// `work` sees this process's memory as it is now; what it changes there, and what it prints, is lost. Its loops run on
/// one thread.
/// Where processes can't be forked (Windows) it runs in this one, unprotected.
std::optional<std::string> runInSeparateProcess(const std::function<std::string()>& work, int mostSeconds = 0);

} // namespace surgicalmesher
