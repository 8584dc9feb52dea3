// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Report of a run as a self-contained HTML page: warnings, figures, pictures, histograms, a table of tissues, the
/// changes to the map, and the run's options.

#include <string>

namespace surgicalmesher
{

/// Returns the report of the results in `folder` (scale.json, surface.json, mesh.json, surface.vtp, mesh.vtu).
/// `configuration` is the text of run.toml. Throws InputError if a file cannot be read.
std::string htmlReport(const std::string& folder, const std::string& configuration);

} // namespace surgicalmesher
