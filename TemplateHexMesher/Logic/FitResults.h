// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Results reported by TemplateFitCLI, for the panel and as a table in the scene.

#include <cstddef>
#include <map>
#include <string>

class vtkMRMLTableNode;

namespace surgicalmesher
{

/// Of the fitted mesh; lengths in mm.
struct FitSummary
{
  std::size_t elements = 0; ///< hexahedra, wedges and tetrahedra
  std::size_t invalid = 0;
  double minimum = 1; ///< least scaled Jacobian over the corners of these elements
  std::size_t turnedFacets = 0;
  double toTarget = 0;                     ///< mean distance to the target
  std::map<std::string, double> residuals; ///< of landmarks, by name
};

FitSummary readFitSummary(const std::string& reportFile);

/// Fills the table with a row for each element shape of the template, of the spline alone and of the fit.
void fillQualityTable(const std::string& reportFile, vtkMRMLTableNode* table);

} // namespace surgicalmesher
