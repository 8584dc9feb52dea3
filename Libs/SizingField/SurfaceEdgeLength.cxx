// SPDX-License-Identifier: Apache-2.0
#include "SurfaceEdgeLength.h"

#include "Errors.h"
#include "Place.h"

#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStaticPointLocator.h>

#include <cmath>

namespace surgicalmesher
{

SizingFunction edgeLengthFromPoints(const std::vector<Vec3>& points, const std::vector<double>& lengths)
{
  const auto vtkpoints = vtkSmartPointer<vtkPoints>::New();
  vtkpoints->SetDataTypeToDouble();
  for (const Vec3& p : points) vtkpoints->InsertNextPoint(p.x, p.y, p.z);
  const auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(vtkpoints);
  const auto locator = vtkSmartPointer<vtkStaticPointLocator>::New();
  locator->SetDataSet(data);
  locator->BuildLocator();
  return [locator, lengths](const Vec3& p) { return lengths[locator->FindClosestPoint(&p.x)]; };
}

void requireCover(const ScaleField& scale, const std::vector<Vec3>& points, const std::string& scaleFile)
{
  for (const Vec3& p : points)
  {
    const Vec3 q = scale.grid.worldToGrid(p);
    const double allowance = 0.5 * scale(p);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double middle = 0.5 * (scale.grid.size[axis] - 1) * scale.grid.spacing[axis];
      const double halfSide = 0.5 * scale.grid.size[axis] * scale.grid.spacing[axis];
      if (std::abs(q[axis] - middle) <= halfSide + allowance) continue;
      throw InputError(scaleFile + ": the scale volume leaves out part of the surface at " + place(p) +
                       ", expected it to cover all of it");
    }
  }
}

} // namespace surgicalmesher
