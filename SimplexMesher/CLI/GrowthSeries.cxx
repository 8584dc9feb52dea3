// SPDX-License-Identifier: Apache-2.0
#include "GrowthSeries.h"

#include "Text.h"
#include "TextFile.h"

#include <filesystem>
#include <sstream>
#include <utility>

namespace surgicalmesher
{

GrowthSeries::GrowthSeries(CommandLine& line) : m_Line(line)
{
  for (const std::string& index : line.outputNames("growth"))
  {
    const std::filesystem::path name = index;
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

void GrowthSeries::writeIndex()
{
  if (m_Stem.empty()) return;
  std::ostringstream out;
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (const int motion : m_Motions)
    out << "    <DataSet timestep=\"" << motion << "\" file=\"" << text::xmlEscaped(fileAfter(motion)) << "\"/>\n";
  out << "  </Collection>\n</VTKFile>\n";
  writeBytes(out.str(), m_Line.outputFile("growth"));
}

std::string GrowthSeries::fileAfter(int motion) const { return m_Stem + "-" + std::to_string(motion) + ".vtp"; }

} // namespace surgicalmesher
