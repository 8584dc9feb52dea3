// SPDX-License-Identifier: Apache-2.0
#pragma once
/// How many threads the libraries beneath may use.

namespace surgicalmesher
{

/// Of VTK and of ITK; 0 for all processors.
void setThreadCount(int count);

/// While it lives, ITK's filters begin with one part of their work: what they sum up depends on how many there are. For
/// filters that make others, which their own number of work units does not reach.
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
