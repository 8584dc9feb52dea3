// SPDX-License-Identifier: Apache-2.0
#include "FileSeries.h"

#include "Text.h"
#include "TextFile.h"

namespace surgicalmesher
{

void writeFileSeries(const std::vector<SeriesFile>& files, const std::string& collection)
{
  std::string xml = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (const SeriesFile& file : files)
    xml += "    <DataSet timestep=\"" + file.time + "\" file=\"" + text::xmlEscaped(file.name) + "\"/>\n";
  writeBytes(xml + "  </Collection>\n</VTKFile>\n", collection);
}

} // namespace surgicalmesher
