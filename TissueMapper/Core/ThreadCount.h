// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Number of threads of the underlying libraries.

namespace surgicalmesher
{

/// Sets the number of threads of VTK and ITK; 0 leaves both at their defaults, all processors.
void setThreadCount(int count);

/// Limits ITK filters created during its lifetime to one work unit, as their sums depend on the number of work units.
/// Meant for filters that create other filters, to which their own number of work units does not apply.
class OneWorkUnit
{
public:
  OneWorkUnit();
  ~OneWorkUnit();
  OneWorkUnit(const OneWorkUnit&) = delete;
  OneWorkUnit& operator=(const OneWorkUnit&) = delete;

private:
  unsigned int m_Before;
};

} // namespace surgicalmesher
