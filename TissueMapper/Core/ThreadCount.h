// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How many threads the libraries beneath may use.

namespace surgicalmesher
{

/// Of VTK and of ITK; 0 for all processors.
void setThreadCount(int count);

} // namespace surgicalmesher
