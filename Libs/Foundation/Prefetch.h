// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Hints for the processor's caches.

namespace surgicalmesher
{

/// Begins to fetch what will be read soon. Pays where addresses are known some steps before, but the loads that follow
/// depend on one another or on branches that are hard to foresee.
inline void prefetch([[maybe_unused]] const void* address)
{
#if defined(__GNUC__)
  __builtin_prefetch(address);
#endif
}

} // namespace surgicalmesher
