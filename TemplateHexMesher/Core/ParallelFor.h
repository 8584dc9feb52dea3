// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A loop whose turns are independent, on VTK's threads.

#include <vtkSMPTools.h>

#include <cstddef>

namespace surgicalmesher
{

/// Calls turn(i) once for each i in [0, count), in no particular order. `turn` must not throw.
template <typename Turn>
void parallelFor(std::size_t count, const Turn& turn)
{
  vtkSMPTools::For(0, vtkIdType(count),
                   [&](vtkIdType begin, vtkIdType end)
                   {
                     for (vtkIdType i = begin; i < end; ++i) turn(std::size_t(i));
                   });
}

} // namespace surgicalmesher
