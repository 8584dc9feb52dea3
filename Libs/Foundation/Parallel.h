#pragma once
/// Tasks of different kinds, run side by side.

#include <vtkSMPTools.h>

#include <functional>
#include <vector>

namespace surgicalmesher
{

/// Runs all of them on VTK's threads, in no particular order but begun in theirs. They must not throw.
inline void runInParallel(const std::vector<std::function<void()>>& tasks)
{
  vtkSMPTools::For(0, vtkIdType(tasks.size()), 1,
                   [&](vtkIdType begin, vtkIdType end)
                   {
                     for (vtkIdType i = begin; i < end; ++i) tasks[i]();
                   });
}

} // namespace surgicalmesher
