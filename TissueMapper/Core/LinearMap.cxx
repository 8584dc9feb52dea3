// SPDX-License-Identifier: Apache-2.0
#include "LinearMap.h"

#include "Errors.h"

#include <fstream>

namespace surgicalmesher
{

void writeTransform(const LinearMap& map, const std::string& file)
{
  std::ofstream stream(file.c_str(), std::ios::binary);
  stream.precision(17);
  stream << "#Insight Transform File V1.0\n#Transform 0\nTransform: AffineTransform_double_3_3\nParameters:";
  for (const Vec3& row : map.rows) stream << ' ' << row.x << ' ' << row.y << ' ' << row.z;
  stream << ' ' << map.offset.x << ' ' << map.offset.y << ' ' << map.offset.z << "\nFixedParameters: 0 0 0\n"
         << std::flush;
  if (!stream) throw InputError(file + ": the transform cannot be written whole");
}

} // namespace surgicalmesher
