// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Hints for the processor's caches.

namespace surgicalmesher
{

/// Starts to load the cache line at an address that will be read soon. Pays off where addresses are known some steps
/// ahead, but the loads depend on one another or on branches that are hard to predict.
inline void prefetch([[maybe_unused]] const void* address)
{
#if defined(__GNUC__)
  __builtin_prefetch(address);
#endif
}

} // namespace surgicalmesher
