// SPDX-License-Identifier: Apache-2.0
#include "Units.h"

namespace surgicalmesher
{

Units unitsNamed(const std::string& name) { return name == "si" ? Units::SI : Units::Millimetres; }

FiniteElementModel inUnits(FiniteElementModel model, Units units)
{
  if (units == Units::Millimetres) return model;
  constexpr double kMillimetresPerMetre = 1e3, kPascalsPerMegapascal = 1e6, kDensity = 1e12; // kg/m^3 per tonne/mm^3
  model.units = units;
  for (Vec3& p : model.content.mesh.points)
    p = { p.x / kMillimetresPerMetre, p.y / kMillimetresPerMetre, p.z / kMillimetresPerMetre };
  for (double& length : model.content.targetEdgeLength) length /= kMillimetresPerMetre;
  for (Shell& shell : model.shells) shell.thickness /= kMillimetresPerMetre;
  for (Beam& beam : model.beams) beam.radius /= kMillimetresPerMetre;
  for (Material& material : model.materials)
  {
    material.youngsModulus *= kPascalsPerMegapascal;
    material.density *= kDensity;
  }
  return model;
}

std::string frameAndUnits(const FiniteElementModel& model)
{
  return model.units == Units::SI ? "LPS; m, N, Pa, kg, s" : "LPS; mm, N, MPa, tonne, s";
}

} // namespace surgicalmesher
