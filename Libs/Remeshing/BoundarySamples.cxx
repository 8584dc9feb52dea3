// SPDX-License-Identifier: Apache-2.0
#include "BoundarySamples.h"

#include "Prefetch.h"

#include <limits>

namespace surgicalmesher
{

SheetFace sheetFace(const TetComplex& complex, std::int32_t t, int face)
{
  const auto& v = complex.tets[t];
  return { t,
           face,
           labelPair(complex.labels[t], complex.labels[complex.neighbours[t][face]]),
           { v[(face + 1) & 3], v[(face + 2) & 3], v[(face + 3) & 3] },
           complex.holder(t, face) };
}

void Sheet::clear()
{
  faces.clear();
  samples.clear();
}

void Sheet::addFace(const TetComplex& complex, std::int32_t t, int face)
{
  faces.push_back(sheetFace(complex, t, face));
  prefetch(&complex.sampleHeads[faces.back().holder.first]);
}

void Sheet::prefetchSamples(const TetComplex& complex, std::size_t k) const
{
  const auto [t, face] = faces[k].holder;
  if (const std::int32_t e = complex.sampleHeads[t][face]; e >= 0) prefetch(&complex.samples[e]);
}

void Sheet::addSamples(const TetComplex& complex, std::size_t k)
{
  const auto [t, face] = faces[k].holder;
  const auto* all = complex.samples.data();
  for (std::int32_t e = complex.sampleHeads[t][face]; e >= 0; e = all[e].next)
  {
    SheetSample& sample = samples.emplace_back(); // in place: a copy costs 2 % of the surface stage
    sample.position = all[e].position;
    sample.tolerance = all[e].tolerance;
    sample.id = e;
    sample.from = std::int32_t(k);
  }
}

void gatherSheet(const TetComplex& complex, const std::vector<TetComplex::FaceOfTet>& faces, Sheet& sheet)
{
  sheet.clear();
  for (const auto& [t, i] : faces) sheet.addFace(complex, t, i);
  for (std::size_t k = 0; k < sheet.faces.size(); ++k) sheet.prefetchSamples(complex, k);
  for (std::size_t k = 0; k < sheet.faces.size(); ++k) sheet.addSamples(complex, k);
}

std::pair<const SheetSample*, double> nearestSample(const Sheet& sheet, const Vec3& p)
{
  std::pair<const SheetSample*, double> result{ nullptr, std::numeric_limits<double>::max() };
  for (const SheetSample& sample : sheet.samples)
    if (const double d2 = squaredNorm(sample.position - p); d2 < result.second) result = { &sample, d2 };
  return result;
}

} // namespace surgicalmesher
