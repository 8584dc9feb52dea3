// SPDX-License-Identifier: Apache-2.0
#include "Units.h"

#include "LabelledBlocks.h"

#include <gtest/gtest.h>

#include <cmath>

namespace surgicalmesher
{
namespace
{

/// Quantities that have a length, and one that has a time: the speed of waves in a bar.
std::vector<double> lengthsOf(const FiniteElementModel& model)
{
  std::vector<double> lengths = model.content.targetEdgeLength;
  for (const Vec3& p : model.content.mesh.points) lengths.insert(lengths.end(), { p.x, p.y, p.z });
  for (const Shell& shell : model.shells) lengths.push_back(shell.thickness);
  for (const Beam& beam : model.beams) lengths.push_back(beam.radius);
  for (const Material& material : model.materials)
    lengths.push_back(std::sqrt(material.youngsModulus / material.density));
  return lengths;
}

FiniteElementModel modelOfAllKinds()
{
  MeshFile content = test::randomBlocks(3);
  content.targetEdgeLength.assign(content.mesh.points.size(), 1.5);
  const auto& first = content.mesh.tetrahedra.front();
  content.curves = { { "nerve", { first[0], first[1] }, { 0.5, 0.5 } } };
  FiniteElementOptions options;
  options.materials[1] = { MaterialLaw::NeoHookean, 0.004, 0.4, 1.1e-9 };
  options.shells = { { 1, -1, 0.5 } };
  return finiteElementModel(content, options);
}

TEST(Units, SILengthsAreAThousandth)
{
  const FiniteElementModel millimetres = modelOfAllKinds();
  ASSERT_FALSE(millimetres.shells.empty() || millimetres.beams.empty());
  const FiniteElementModel metres = inUnits(millimetres, Units::SI);
  const std::vector<double> before = lengthsOf(millimetres), after = lengthsOf(metres);
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_DOUBLE_EQ(after[i] * 1000, before[i]);
  for (std::size_t m = 0; m < metres.materials.size(); ++m)
  {
    EXPECT_DOUBLE_EQ(metres.materials[m].youngsModulus, millimetres.materials[m].youngsModulus * 1e6); // Pa
    EXPECT_EQ(metres.materials[m].poissonsRatio, millimetres.materials[m].poissonsRatio);
  }
}

TEST(Units, AreNamedInTheSidecar)
{
  const FiniteElementModel model = modelOfAllKinds();
  const std::string millimetres = setNamesJSON(inUnits(model, unitsNamed("mm")));
  EXPECT_EQ(millimetres, setNamesJSON(model));
  const std::string metres = setNamesJSON(inUnits(model, unitsNamed("si")));
  for (const char* unit : { "\"length\": \"m\"", "\"stress\": \"Pa\"", "\"density\": \"kg/m^3\"" })
    EXPECT_NE(metres.find(unit), std::string::npos) << unit;
  EXPECT_EQ(metres.find("tonne"), std::string::npos);
}

} // namespace
} // namespace surgicalmesher
