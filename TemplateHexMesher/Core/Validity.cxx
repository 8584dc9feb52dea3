// SPDX-License-Identifier: Apache-2.0
#include "Validity.h"

#include "ElementQuality.h"
#include "Errors.h"

#include <sstream>

namespace surgicalmesher
{

Validity validityOf(const std::vector<Element>& elements, const Points& points)
{
  Validity validity;
  const std::vector<ElementQuality> quality = elementQuality({ points, elements });
  for (std::size_t e = 0; e < quality.size(); ++e)
  {
    if (!(quality[e].minimum > 0)) ++validity.invalid;
    if (quality[e].minimum >= validity.minimum) continue;
    validity.minimum = quality[e].minimum;
    validity.worst = e;
  }
  return validity;
}

void refuseInvalid(const ElementMesh& mesh, const Validity& validity, int rounds, const std::string& question)
{
  const Element& worst = mesh.elements[validity.worst];
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (int i = 0; i < nodeCount(worst.shape); ++i) middle += mesh.points.col(worst.nodes[i]) / nodeCount(worst.shape);
  std::ostringstream text;
  text.precision(4);
  text << "fit: " << validity.invalid << " elements are still invalid after " << rounds
       << " rounds of repair, the worst (scaled Jacobian " << validity.minimum << ") at (" << middle.x() << ", "
       << middle.y() << ", " << middle.z() << ") mm; " << question;
  throw EngineError(text.str());
}

} // namespace surgicalmesher
