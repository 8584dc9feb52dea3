// SPDX-License-Identifier: Apache-2.0
#include "ScaleOption.h"

#include "Errors.h"
#include "TissueMapIO.h"

namespace surgicalmesher
{

ScaleField readScaleOption(const std::string& file, double uniform, const Grid& grid)
{
  if (!file.empty() && uniform > 0) throw UsageError("--scale and --edgeLength are both given, expected one of them");
  if (file.empty() && !(uniform > 0))
    throw UsageError("neither --scale nor --edgeLength is given, expected one of them");
  if (uniform > 0) return uniformScale(uniform);
  ScaleField scale = readScale(file);
  requireCover(scale, grid, file);
  return scale;
}

} // namespace surgicalmesher
