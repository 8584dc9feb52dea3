// SPDX-License-Identifier: Apache-2.0
#pragma once
/// A surface that can't be meshed, and the triangles to look at.

#include "Errors.h"
#include "TetMesh.h"

namespace surgicalmesher
{

class SurfaceRefused : public InputError
{
public:
  /// `offending` are indices of triangles of `surface`; repeated ones count once.
  SurfaceRefused(const std::string& message, const SurfaceComplex& surface, std::vector<std::int32_t> offending);

  /// The triangles at fault, with the points of the surface they use.
  const SurfaceComplex& offending() const { return m_Offending; }

private:
  SurfaceComplex m_Offending;
};

} // namespace surgicalmesher
