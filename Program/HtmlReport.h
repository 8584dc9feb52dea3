// SPDX-License-Identifier: Apache-2.0
#pragma once
/// The results of a run as one page of HTML that needs no other file: warnings, figures, pictures, histograms, a table
/// of tissues, what was changed in the map, and the run's options.

#include <string>

namespace surgicalmesher
{

/// Of the results in `folder` (scale.json, surface.json, mesh.json, surface.vtp, mesh.vtu); `configuration` is the text
/// of run.toml. Throws InputError if one of them cannot be read.
std::string htmlReport(const std::string& folder, const std::string& configuration);

} // namespace surgicalmesher
