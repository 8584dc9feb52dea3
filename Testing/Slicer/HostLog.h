// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What the host complains of.

#include <string>

namespace surgicalmesher::test
{

class HostLog
{
public:
  /// The warnings and errors in the host's log since the last call, one per line; empty if there are none. Of those
  /// from before the first call, which the host's start may bring, only the ones that name a module or class of ours.
  std::string complaints();

private:
  int m_EntriesSeen = 0;
};

} // namespace surgicalmesher::test
