// SPDX-License-Identifier: Apache-2.0
#include "SurfaceRefused.h"

#include <algorithm>
#include <map>

namespace surgicalmesher
{

SurfaceRefused::SurfaceRefused(const std::string& message, const SurfaceComplex& surface,
                               std::vector<std::int32_t> offending)
  : InputError(message)
{
  std::sort(offending.begin(), offending.end());
  offending.erase(std::unique(offending.begin(), offending.end()), offending.end());
  std::map<std::int32_t, std::int32_t> newId;
  for (const std::int32_t t : offending)
  {
    std::array<std::int32_t, 3> triangle = surface.triangles[t];
    for (std::int32_t& id : triangle)
    {
      const auto [entry, isNew] = newId.emplace(id, static_cast<std::int32_t>(m_Offending.points.size()));
      if (isNew) m_Offending.points.push_back(surface.points[id]);
      id = entry->second;
    }
    m_Offending.triangles.push_back(triangle);
    if (!surface.labels.empty()) m_Offending.labels.push_back(surface.labels[t]);
  }
}

} // namespace surgicalmesher
