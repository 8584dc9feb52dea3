// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Loops and tasks on VTK's threads.

#include <vtkSMPTools.h>

#include <cstddef>
#include <exception>
#include <functional>
#include <vector>

namespace surgicalmesher
{

/// Calls f(i) for every i in [0, count), in no particular order; consecutive i mostly run on the same thread. f must
/// not throw.
template <class F>
void parallelFor(std::size_t count, F&& f)
{
  vtkSMPTools::For(0, vtkIdType(count),
                   [&](vtkIdType begin, vtkIdType end)
                   {
                     for (vtkIdType i = begin; i < end; ++i) f(std::size_t(i));
                   });
}

/// The same, but one call after the other if called from within another of these loops, whose threads are busy already.
/// parallelForEach() with a single item does not count as such a loop.
template <class F>
void parallelForIfIdle(std::size_t count, F&& f)
{
  if (!vtkSMPTools::IsParallelScope()) return parallelFor(count, f);
  for (std::size_t i = 0; i < count; ++i) f(i);
}

/// parallelFor() for few, long calls: the threads take them one at a time.
template <class F>
void parallelForEach(std::size_t count, F&& f)
{
  if (count == 1) return f(std::size_t(0));
  vtkSMPTools::For(0, vtkIdType(count), 1,
                   [&](vtkIdType begin, vtkIdType end)
                   {
                     for (vtkIdType i = begin; i < end; ++i) f(std::size_t(i));
                   });
}

/// Runs all tasks in parallel, starting them in their order. Once all have ended, rethrows the exception of the first
/// task that failed, by their order.
inline void runInParallel(const std::vector<std::function<void()>>& tasks)
{
  std::vector<std::exception_ptr> failures(tasks.size()); // an exception must not leave a worker thread
  parallelForEach(tasks.size(),
                  [&](std::size_t i)
                  {
                    try
                    {
                      tasks[i]();
                    }
                    catch (...)
                    {
                      failures[i] = std::current_exception();
                    }
                  });
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

} // namespace surgicalmesher
