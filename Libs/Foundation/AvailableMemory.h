// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How much memory a process may still take before the system ends it.

#include <cstdint>
#include <optional>
#include <string>

namespace surgicalmesher
{

/// Returns the number of bytes that can be allocated without swapping, reclaimable caches of the kernel included: the
/// minimum of what the machine has available and what the process's control groups (version 1 or 2) leave, as
/// containers and batch systems set them. Empty where the system does not report it (any system but Linux). `root` is
/// the folder that holds proc and sys.
std::optional<std::uint64_t> availableMemory(const std::string& root = "/");

/// Throws std::bad_alloc unless that many bytes can be allocated now: a limit on the process's own memory does not
/// appear in availableMemory(). Where a library fails in its own ways when it runs out of memory, this call
/// distinguishes lack of memory from bad input.
void requireMemory(std::uint64_t bytes);

} // namespace surgicalmesher
