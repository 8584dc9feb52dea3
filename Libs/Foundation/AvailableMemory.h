// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How much memory a process may still take before the system ends it.

#include <cstdint>
#include <optional>
#include <string>

namespace surgicalmesher
{

/// Bytes that can be had without swapping, counting caches that the kernel would give up: the least of what the machine
/// has and what the process's control groups (version 1 or 2) leave, as containers and batch systems set them. Empty
/// where the system does not tell (anywhere but on Linux). `root` is the folder that holds proc and sys.
std::optional<std::uint64_t> availableMemory(const std::string& root = "/");

/// Throws std::bad_alloc unless that many bytes can be allocated now: a limit on the process's memory does not show in
/// what is available. Where a library that lacks memory fails in ways of its own, this tells it from bad input.
void requireMemory(std::uint64_t bytes);

} // namespace surgicalmesher
