// SPDX-License-Identifier: Apache-2.0
#pragma once
/// What TemplateFitCLI reports, for the panel and as a table of the host.

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
  double minimum = 1; ///< scaled Jacobian over their corners
  std::size_t turnedFacets = 0;
  double toTarget = 0;                     ///< mean
  std::map<std::string, double> residuals; ///< of landmarks, by name
};

FitSummary readFitSummary(const std::string& reportFile);

/// A row for each shape of element of the template, of the spline of the landmarks alone and of the fit.
void fillQualityTable(const std::string& reportFile, vtkMRMLTableNode* table);

} // namespace surgicalmesher
