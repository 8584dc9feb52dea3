// SPDX-License-Identifier: Apache-2.0
#include "GrowthSeries.h"

#include "FileSeries.h"

#include <filesystem>
#include <utility>

namespace surgicalmesher
{

GrowthSeries::GrowthSeries(CommandLine& line, const std::vector<std::string>& index) : m_Line(line)
{
  for (const std::filesystem::path name : index)
  {
    m_Folder = name.parent_path().string();
    m_Stem = name.stem().string();
    line.alsoWritesMany("growth", (name.parent_path() / m_Stem).string() + "-", ".vtp");
  }
}

BalloonWatch GrowthSeries::watch(std::function<SurfaceFile(const SurfaceComplex&)> content)
{
  if (m_Stem.empty()) return {};
  return [this, content = std::move(content)](int motion, const SimplexOperators& membranes)
  {
    constexpr int interval = 10;
    if (motion % interval != 0) return;
    const std::string file = (std::filesystem::path(m_Folder) / fileAfter(motion)).string();
    writeSurface(content(membranes.surface()), m_Line.outputPath(file));
    m_Line.commitPath(file);
    m_Motions.push_back(motion);
  };
}

void GrowthSeries::writeIndex(const std::string& file) const
{
  if (m_Stem.empty()) return;
  std::vector<SeriesFile> files;
  for (const int motion : m_Motions) files.push_back({ std::to_string(motion), fileAfter(motion) });
  writeFileSeries(files, file);
}

std::string GrowthSeries::fileAfter(int motion) const { return m_Stem + "-" + std::to_string(motion) + ".vtp"; }

} // namespace surgicalmesher
