// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Error for a surface that cannot be meshed, with the triangles at fault.

#include "Errors.h"
#include "TetMesh.h"

namespace surgicalmesher
{

class SurfaceRefused : public InputError
{
public:
  /// `offending` are indices of triangles of `surface`; duplicates are ignored.
  SurfaceRefused(const std::string& message, const SurfaceComplex& surface, std::vector<std::int32_t> offending);

  /// Returns the triangles at fault, with the points of the surface that they use.
  const SurfaceComplex& offending() const { return m_Offending; }

private:
  SurfaceComplex m_Offending;
};

} // namespace surgicalmesher
