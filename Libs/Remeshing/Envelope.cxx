// SPDX-License-Identifier: Apache-2.0
#include "Envelope.h"

#include "TetQuality.h"
#include "Triangle.h"

#include <algorithm>
#include <limits>

namespace surgicalmesher
{

namespace
{

/// Distances of faces from the samples of a sheet.
struct FacesToSamples
{
  double area = 0;
  double sum = 0; ///< over faces, of area times squared distance of the centroid to the nearest sample, in tolerances

  void add(const Sheet& sheet, const Vec3& a, const Vec3& b, const Vec3& c)
  {
    const Vec3 centre = (a + b + c) / 3.0;
    double least = std::numeric_limits<double>::max();
    for (const SheetSample& sample : sheet.samples)
      least = std::min(least, squaredNorm(sample.position - centre) / sample.squaredTolerance());
    const double own = 0.5 * norm(cross(b - a, c - a));
    area += own;
    sum += own * least;
  }
};

/// The plane of a sample with a normal, and the radius within which the boundary is nearly plane.
struct Plane
{
  Vec3 origin, normal;
  double squaredRadius = 0; ///< mm^2; 0: the sample has no normal

  bool reaches(const Vec3& p) const { return squaredNorm(p - origin) < squaredRadius; }
  double heightOf(const Vec3& p) const { return std::abs(dot(normal, p - origin)); }
};

Plane planeOf(const TetComplex& complex, const SheetSample& sample)
{
  const auto n = complex.sampleNormal(sample.id);
  const Vec3 perRadius{ n[0], n[1], n[2] };
  const double perRadius2 = squaredNorm(perRadius);
  if (perRadius2 == 0) return { sample.position, {} };
  return { sample.position, perRadius / std::sqrt(perRadius2), 1 / perRadius2 };
}

} // namespace

Envelope::Envelope(TetComplex& complex, const EnvelopeBounds& bounds)
  : m_Complex(complex), m_Held(bounds.interfaceHeld), m_MeanSquareLimit(bounds.rmsLimit * bounds.rmsLimit),
    m_SquaredToleranceFactor(bounds.toleranceFactor * bounds.toleranceFactor), m_TriangleWeight(bounds.triangleWeight),
    m_VertexDistance(bounds.vertexDistance), m_PlaneDistance(bounds.planeDistance),
    m_SquaredSpacing(bounds.sampleSpacing * bounds.sampleSpacing),
    m_SquaredSeparatedFactor(bounds.separatedFactor * bounds.separatedFactor), m_Sides(bounds.featureAngle)
{
}

// --- old faces and new ones -----------------------------------------------------------------------------------------

void Envelope::clear()
{
  m_Old.clear();
  m_NewFaces.clear();
}

void Envelope::addOldFace(std::int32_t t, int face)
{
  const auto holder = m_Complex.holder(t, face);
  const auto& known = m_Old.faces;
  if (std::none_of(known.begin(), known.end(), [&](const SheetFace& f) { return f.holder == holder; }))
    m_Old.addFace(m_Complex, t, face);
}

void Envelope::addNewFace(const Vec3& a, const Vec3& b, const Vec3& c, const std::array<std::int32_t, 3>& ids,
                          LabelPair labels, std::int32_t tet, int face, bool changes)
{
  const Vec3 n = cross(b - a, c - a);
  const double area2 = squaredNorm(n); // positive, as the tetrahedra on both sides are
  const Vec3 slopes[3]{ cross(n, c - b) / area2, cross(n, a - c) / area2, cross(n, b - a) / area2 };
  Face& f = m_NewFaces.emplace_back(); // in place: a copy waits for what has just been written
  f.corners = { a, b, c };
  f.labels = labels;
  f.vertices = ids;
  f.normal = n / std::sqrt(area2);
  for (int k = 0; k < 3; ++k)
  {
    f.slopes[k] = slopes[k];
    f.heights[k] = 1 / squaredNorm(slopes[k]);
  }
  f.tet = tet;
  f.face = face;
  f.changes = changes;
}

bool Envelope::trianglesReach(double minimumQuality) const
{
  const auto isGood = [&](const Face& f)
  {
    const auto& [a, b, c] = f.corners;
    return !f.changes || m_TriangleWeight * smallestSine2(a, b, c) >= minimumQuality;
  };
  return m_TriangleWeight == 0 || std::all_of(m_NewFaces.begin(), m_NewFaces.end(), isGood);
}

bool Envelope::featuresStay() { return featuresStay(m_Old); }

bool Envelope::featuresStay(const Sheet& sheet)
{
  if (!m_Sides.areWatched()) return true;
  m_Sides.find(m_Complex, sheet.faces);
  return std::all_of(m_NewFaces.begin(), m_NewFaces.end(),
                     [&](const Face& f) { return !f.changes || m_Sides.allow(f.normal, f.labels); });
}

// --- distances of samples -------------------------------------------------------------------------------------------

double Envelope::squaredDistanceNow(const Sheet& sheet, const SheetSample& sample)
{
  double& distance2 = m_Complex.samples[sample.id].distance2;
  if (distance2 >= 0) return distance2;
  const auto corner = [&](int k) { return m_Complex.points[sheet.faces[sample.from].vertices[k]]; };
  return distance2 = squaredDistanceToTriangle(sample.position, corner(0), corner(1), corner(2));
}

/// Finds the new face of its labels nearest to a sample. Returns false if there is none.
///
/// Two shortcuts spare most faces the full test: the search begins with the face that replaces the sample's own, if
/// there is one; and beyond the line of a side, the distance to that line is a lower bound of the distance to the face.
/// A sample whose projection falls into the first face, at half its tolerance or less, stays with that face: a nearer
/// face would be a fold of the same sheet.
bool Envelope::findNearestFace(const Sheet& sheet, SheetSample& sample) const
{
  sample.to = -1;
  sample.distance2 = std::numeric_limits<double>::max();
  constexpr double settled = 0.25; // of the squared tolerance
  const double settled2 = settled * sample.squaredTolerance();
  const LabelPair labels = sheet.faces[sample.from].labels;
  const std::size_t count = m_NewFaces.size();
  std::size_t k = std::size_t(sample.from) < count ? std::size_t(sample.from) : 0;
  for (std::size_t n = 0; n < count; ++n, k = k + 1 < count ? k + 1 : 0)
  {
    const Face& f = m_NewFaces[k];
    if (f.labels != labels) continue;
    const Vec3 d = sample.position - f.corners[0];
    const double height = dot(f.normal, d);
    double d2 = height * height;
    if (d2 >= sample.distance2) continue;
    const double second = dot(f.slopes[1], d), third = dot(f.slopes[2], d), first = 1 - second - third;
    double beyond = 0;
    if (first < 0) beyond = std::max(beyond, first * first * f.heights[0]);
    if (second < 0) beyond = std::max(beyond, second * second * f.heights[1]);
    if (third < 0) beyond = std::max(beyond, third * third * f.heights[2]);
    if (d2 + beyond >= sample.distance2) continue;
    if (beyond > 0) d2 = squaredDistanceToTriangle(sample.position, f.corners[0], f.corners[1], f.corners[2]);
    if (d2 < sample.distance2) sample.distance2 = d2, sample.to = std::int32_t(k);
    if (n == 0 && beyond == 0 && d2 <= settled2) break;
  }
  return sample.to >= 0;
}

/// Returns the greater one of the squared distances from a sample to the new boundaries of its two labels. The boundary
/// of background that has vanished counts as distance 0.
double Envelope::squaredDistanceToBoth(const Sheet& sheet, const SheetSample& sample) const
{
  constexpr double none = std::numeric_limits<double>::max();
  const auto toBoundary = [&](Label label)
  {
    double least = none;
    for (const Face& f : m_NewFaces)
      if (hasLabel(f.labels, label))
        least = std::min(least, squaredDistanceToTriangle(sample.position, f.corners[0], f.corners[1], f.corners[2]));
    return least == none && label == 0 ? 0 : least;
  };
  const LabelPair labels = sheet.faces[sample.from].labels;
  return std::max(toBoundary(Label(labels)), toBoundary(Label(labels >> 16)));
}

/// Whether squaredDistanceToBoth() is at most `most2`; faster, because one near face of each label suffices.
bool Envelope::isNearBoth(const Sheet& sheet, const SheetSample& sample, double most2) const
{
  const auto isNear = [&](Label label)
  {
    bool isGone = true;
    for (const Face& f : m_NewFaces)
    {
      if (!hasLabel(f.labels, label)) continue;
      isGone = false;
      const auto& [a, b, c] = f.corners;
      const double height = dot(f.normal, sample.position - a);
      if (height * height <= most2 * (1 + 1e-9) && squaredDistanceToTriangle(sample.position, a, b, c) <= most2)
        return true;
    }
    return isGone && label == 0;
  };
  const LabelPair labels = sheet.faces[sample.from].labels;
  return isNear(Label(labels)) && isNear(Label(labels >> 16));
}

/// Assigns a sample to the nearest new face of its labels. Returns false if it would lie beyond its tolerance and
/// farther than it does now. For labels that other labels separate, see separatedFactor; where two labels cease to
/// touch, their samples are given up if the boundaries of both labels stay within tolerance.
bool Envelope::sampleStays(const Sheet& sheet, SheetSample& sample)
{
  const double tolerance2 = m_SquaredToleranceFactor * sample.squaredTolerance();
  const bool hasFace = findNearestFace(sheet, sample);
  if (sample.distance2 <= std::max(tolerance2, m_LeastTolerance2)) return true;
  if (hasFace && sample.distance2 <= squaredDistanceNow(sheet, sample) * (1 + 1e-9)) return true;
  if (hasFace && sample.distance2 > m_SquaredSeparatedFactor * tolerance2) return false;
  return isNearBoth(sheet, sample, tolerance2);
}

/// Whether the mean square of the samples' distances, each in units of its tolerance and at most 1, is within the limit
/// or does not grow.
bool Envelope::meanSquareStays(const Sheet& sheet)
{
  double sum = 0;
  for (const SheetSample& sample : sheet.samples)
    sum += std::min(1.0, sample.distance2 / (m_SquaredToleranceFactor * sample.squaredTolerance()));
  if (sum <= m_MeanSquareLimit * double(sheet.samples.size())) return true;
  double before = 0;
  for (const SheetSample& sample : sheet.samples)
    before += std::min(1.0, squaredDistanceNow(sheet, sample) / (m_SquaredToleranceFactor * sample.squaredTolerance()));
  return sum <= before * (1 + 1e-9);
}

/// Fetches the samples face by face as they are needed, because most refusals come early.
bool Envelope::samplesStay()
{
  for (std::size_t k = 0; k < m_Old.faces.size(); ++k)
  {
    std::size_t i = m_Old.samples.size();
    m_Old.addSamples(m_Complex, k);
    if (k + 1 < m_Old.faces.size()) m_Old.prefetchSamples(m_Complex, k + 1);
    for (; i < m_Old.samples.size(); ++i)
      if (!sampleStays(m_Old, m_Old.samples[i])) return false;
  }
  return meanSquareStays(m_Old);
}

bool Envelope::comesNearer(double mostLeft)
{
  const Sheet& sheet = m_Old;
  if (sheet.samples.empty()) return false;
  double before = 0, after = 0;
  for (const SheetSample& sample : sheet.samples)
  {
    before += squaredDistanceNow(sheet, sample) / sample.squaredTolerance();
    after += (sample.to < 0 ? squaredDistanceToBoth(sheet, sample) : sample.distance2) / sample.squaredTolerance();
  }
  FacesToSamples now, then;
  for (const SheetFace& f : sheet.faces)
  {
    const auto corner = [&](int k) { return m_Complex.points[f.vertices[k]]; };
    now.add(sheet, corner(0), corner(1), corner(2));
  }
  for (const Face& f : m_NewFaces) then.add(sheet, f.corners[0], f.corners[1], f.corners[2]);
  const double samplesPerArea = double(sheet.samples.size()) / std::max(now.area, then.area);
  return after + samplesPerArea * then.sum < mostLeft * (before + samplesPerArea * now.sum);
}

// --- distances of vertices and edges --------------------------------------------------------------------------------

bool Envelope::growsSpike(const Vec3& p) const
{
  if (m_VertexDistance == 0) return false;
  const auto [sample, distance2] = nearestSample(m_Sheet, p);
  if (sample && leavesPlane(*sample, p)) return true;
  return sample && isBeyond(*sample, distance2, m_VertexDistance) &&
         distance2 > nearestSample(m_Sheet, m_Complex.points[m_SheetVertex]).second;
}

/// Whether the vertex of the sheet, at p, is farther than planeDistance from the sample's plane, and farther than now.
bool Envelope::leavesPlane(const SheetSample& sample, const Vec3& p) const
{
  if (m_PlaneDistance == 0) return false;
  const Plane plane = planeOf(m_Complex, sample);
  if (!plane.reaches(p)) return false;
  const double most2 = m_PlaneDistance * m_PlaneDistance * sample.squaredTolerance(), height = plane.heightOf(p);
  return height * height > most2 && height > plane.heightOf(m_Complex.points[m_SheetVertex]);
}

double Envelope::squaredDistanceBy(const SheetSample& nearest, const Vec3& p) const
{
  const Plane plane = planeOf(m_Complex, nearest);
  if (!plane.reaches(p)) return squaredNorm(p - nearest.position);
  const double height = plane.heightOf(p);
  return height * height;
}

bool Envelope::spansGap(const Sheet& sheet, std::int32_t v, const Vec3& from) const
{
  if (m_VertexDistance == 0) return false;
  for (const Face& f : m_NewFaces)
    for (int k = 0; k < 3; ++k)
    {
      const std::int32_t x = f.vertices[(k + 1) % 3];
      if (f.vertices[k] != v && x != v) continue;
      const Vec3 &a = f.corners[k], &b = f.corners[(k + 1) % 3];
      const double target = m_Complex.targetLength(f.vertices[k], x);
      if (squaredNorm(b - a) <= target * target) continue;
      const auto [sample, distance2] = nearestSample(sheet, 0.5 * (a + b));
      if (!sample || !isBeyond(*sample, distance2, m_VertexDistance)) continue;
      const Vec3 other = f.vertices[k] == v ? b : a;
      if (distance2 > nearestSample(sheet, 0.5 * (from + other)).second) return true;
    }
  return false;
}

bool Envelope::laysBare(std::int32_t t) const
{
  if (m_VertexDistance == 0) return false;
  for (const std::int32_t v : m_Complex.tets[t])
  {
    if (m_Complex.onInterface[v]) continue;
    const auto [sample, distance2] = nearestSample(m_Old, m_Complex.points[v]);
    if (!sample || isBeyond(*sample, distance2, m_VertexDistance)) return true;
  }
  return false;
}

// --- samples to their new faces -------------------------------------------------------------------------------------

void Envelope::detach() { detach(m_Old); }

void Envelope::detach(const Sheet& sheet)
{
  for (const SheetFace& f : sheet.faces) m_Complex.sampleHeads[f.holder.first][f.holder.second] = -1;
}

/// Goes backwards, because samples are inserted at the head: lists then keep their order if nothing else changes.
void Envelope::attach(const std::vector<SheetSample>& samples, const std::vector<TetComplex::FaceOfTet>& holders)
{
  for (auto sample = samples.rbegin(); sample != samples.rend(); ++sample)
  {
    if (sample->to < 0) continue;
    const auto [t, i] = holders[sample->to];
    m_Complex.samples[sample->id].distance2 = sample->distance2;
    m_Complex.samples[sample->id].next = m_Complex.sampleHeads[t][i];
    m_Complex.sampleHeads[t][i] = sample->id;
  }
}

void Envelope::attach(const std::vector<std::int32_t>& around)
{
  if (m_Old.samples.empty()) return;
  m_Holders.assign(m_NewFaces.size(), { -1, 0 });
  for (std::size_t k = 0; k < m_NewFaces.size(); ++k)
    if (m_NewFaces[k].tet >= 0) m_Holders[k] = m_Complex.holder(m_NewFaces[k].tet, m_NewFaces[k].face);
  for (std::int32_t t : around)
  {
    if (!m_Complex.alive(t)) continue;
    for (int i = 0; i < 4; ++i)
    {
      if (!m_Complex.isInterface(t, i)) continue;
      for (std::size_t k = 0; k < m_NewFaces.size(); ++k)
      {
        if (m_Holders[k].first >= 0) continue;
        const auto& ids = m_NewFaces[k].vertices;
        const auto& v = m_Complex.tets[t];
        if (v[i] == ids[0] || v[i] == ids[1] || v[i] == ids[2]) continue;
        if (m_Complex.contains(t, ids[0]) && m_Complex.contains(t, ids[1]) && m_Complex.contains(t, ids[2]))
          m_Holders[k] = m_Complex.holder(t, i);
      }
    }
  }
  attach(m_Old.samples, m_Holders);
}

// --- moves of one vertex --------------------------------------------------------------------------------------------

const Sheet& Envelope::gatherSheetOf(std::int32_t v, const std::vector<TetComplex::FaceOfTet>& faces)
{
  gatherSheet(m_Complex, faces, m_Sheet);
  m_SheetVertex = v;
  return m_Sheet;
}

Vec3 Envelope::alongFeatures(const Vec3& step)
{
  if (!watchesFeatures()) return step;
  m_Sides.find(m_Complex, m_Sheet.faces);
  return m_Sides.along(step);
}

/// Makes the new faces those of the sheet with its vertex at p.
void Envelope::addMovedFaces(const Vec3& p)
{
  m_NewFaces.clear();
  for (const SheetFace& f : m_Sheet.faces)
  {
    const auto at = [&](int k) { return f.vertices[k] == m_SheetVertex ? p : m_Complex.points[f.vertices[k]]; };
    addNewFace(at(0), at(1), at(2), f.vertices, f.labels, f.tet, f.face);
  }
}

/// Whether all samples of the sheet allow the new faces. Begins with the sample that refused the previous position,
/// because two in three refuse the next one, too.
bool Envelope::sheetStays()
{
  auto& samples = m_Sheet.samples;
  const std::size_t first = m_LastRefusing < samples.size() ? m_LastRefusing : 0;
  for (std::size_t n = 0, at = first; n < samples.size(); ++n, at = at + 1 < samples.size() ? at + 1 : 0)
  {
    if (sampleStays(m_Sheet, samples[at])) continue;
    m_LastRefusing = at;
    return false;
  }
  return true;
}

bool Envelope::allowsSheetAt(const Vec3& p)
{
  if (growsSpike(p)) return false;
  addMovedFaces(p);
  return featuresStay(m_Sheet) && sheetStays() && meanSquareStays(m_Sheet) &&
         !spansGap(m_Sheet, m_SheetVertex, m_Complex.points[m_SheetVertex]);
}

void Envelope::handToNearest(const Vec3& p)
{
  addMovedFaces(p);
  for (SheetSample& sample : m_Sheet.samples) findNearestFace(m_Sheet, sample);
  handOn();
}

void Envelope::handOn()
{
  auto& [faces, samples] = m_Sheet;
  if (std::all_of(samples.begin(), samples.end(), [](const SheetSample& sample) { return sample.to == sample.from; }))
  {
    for (const SheetSample& sample : samples) m_Complex.samples[sample.id].distance2 = sample.distance2;
    return;
  }
  detach(m_Sheet);
  m_Holders.clear();
  for (const SheetFace& f : faces) m_Holders.push_back(f.holder);
  attach(samples, m_Holders);
  for (SheetSample& sample : samples) sample.from = sample.to;
  std::stable_sort(samples.begin(), samples.end(),
                   [](const SheetSample& a, const SheetSample& b) { return a.from < b.from; });
}

bool Envelope::hasSampleBeyondTolerance()
{
  const auto isBeyond = [&](const SheetSample& sample)
  { return squaredDistanceNow(m_Sheet, sample) > m_SquaredToleranceFactor * sample.squaredTolerance(); };
  return std::any_of(m_Sheet.samples.begin(), m_Sheet.samples.end(), isBeyond);
}

// --- bounds lifted --------------------------------------------------------------------------------------------------

Envelope::Lifted::Lifted(Envelope& envelope)
  : m_Envelope(envelope), m_LeastTolerance2(envelope.m_LeastTolerance2), m_MeanSquareLimit(envelope.m_MeanSquareLimit),
    m_VertexDistance(envelope.m_VertexDistance), m_Sides(envelope.m_Sides)
{
  envelope.m_Sides = FeatureSides(0);
  envelope.m_LeastTolerance2 = envelope.m_MeanSquareLimit = std::numeric_limits<double>::max();
  envelope.m_VertexDistance = 0;
}

Envelope::Lifted::~Lifted()
{
  m_Envelope.m_LeastTolerance2 = m_LeastTolerance2;
  m_Envelope.m_MeanSquareLimit = m_MeanSquareLimit;
  m_Envelope.m_VertexDistance = m_VertexDistance;
  m_Envelope.m_Sides = m_Sides;
}

} // namespace surgicalmesher
