// SPDX-License-Identifier: Apache-2.0
#include "Fairing.h"

#include "TetQuality.h"
#include "VertexSteps.h"
#include "VolumeOffsets.h"

#include <algorithm>
#include <map>

namespace surgicalmesher
{

namespace
{

class Fairing
{
public:
  Fairing(GuardedOperations& operations, const FairingOptions& options)
    : m_Operations(operations), m_Complex(operations.complex()), m_Options(options),
      m_Least(sine2OfDegrees(options.leastAngle)), m_Start(m_Complex.points), m_Volumes(volumes()),
      m_Umbrella(m_Start.size())
  {
    m_Begin.reserve(m_Start.size() + 1);
    for (std::int32_t v = 0; v < std::int32_t(m_Start.size()); ++v)
    {
      m_Begin.push_back(std::int32_t(m_Neighbours.size()));
      if (mayMove(v)) addNeighbours(v);
    }
    m_Begin.push_back(std::int32_t(m_Neighbours.size()));
  }

  void run()
  {
    constexpr int balancingRounds = 2;
    const std::int32_t count = std::int32_t(m_Start.size());
    for (int round = 0; round < m_Options.rounds; ++round)
    {
      for (std::int32_t v = 0; v < count; ++v) m_Umbrella[v] = umbrella(v, m_Complex.points);
      for (std::int32_t v = 0; v < count; ++v)
        if (hasNeighbours(v) && !m_Complex.locked[v]) flatten(v);
    }
    for (int round = 0; round < balancingRounds; ++round) balanceVolumes();
  }

private:
  /// Where more than a seventh of the reach is left: less is not seen.
  bool mayMove(std::int32_t v) const
  {
    constexpr double coarse = 2.6; // fine lengths
    return m_Complex.vertexTet[v] >= 0 && m_Complex.onInterface[v] &&
           m_Complex.lengths[v] < coarse * m_Options.fineLength;
  }

  bool hasNeighbours(std::int32_t v) const { return m_Begin[v] < m_Begin[v + 1]; }

  /// The vertices next to v on its curve if it is on one, on its sheet otherwise; none where curves meet or end.
  void addNeighbours(std::int32_t v)
  {
    const std::vector<SheetFace>& faces = m_Operations.sheet(v).faces;
    facesAtNeighbours(m_Operations.sheet(v), v, m_Faces);
    const auto differs = [&](const SheetFace& f) { return f.labels != faces[0].labels; };
    const bool isOnCurve = std::any_of(faces.begin(), faces.end(), differs);
    const auto isAlong = [](const auto& n) { return n.second > 2; };
    if (std::count_if(m_Faces.begin(), m_Faces.end(), isAlong) != (isOnCurve ? 2 : 0)) return;
    for (const auto& n : m_Faces)
      if (!isOnCurve || isAlong(n)) m_Neighbours.push_back(n.first);
  }

  Vec3 umbrella(std::int32_t v, const std::vector<Vec3>& x) const
  {
    if (!hasNeighbours(v)) return {};
    Vec3 sum;
    for (std::int32_t i = m_Begin[v]; i < m_Begin[v + 1]; ++i) sum += x[m_Neighbours[i]];
    return sum / double(m_Begin[v + 1] - m_Begin[v]) - x[v];
  }

  void flatten(std::int32_t v)
  {
    constexpr double factor = 0.4; // of U(U(p)); stable up to 0.5
    const Vec3 p = m_Complex.points[v];
    step(v, withinReach(v, p - factor * umbrella(v, m_Umbrella)) - p);
  }

  void step(std::int32_t v, const Vec3& way)
  {
    const Vec3 p = m_Complex.points[v];
    const double floor = std::min(m_Least, m_Operations.qualityAt(v));
    for (const double share : { 1.0, 0.5, 0.25 })
      if (m_Operations.move(v, p + share * way, floor)) return;
  }

  // ---- volumes ----

  std::map<Label, double> volumes() const
  {
    std::map<Label, double> result;
    const auto& p = m_Complex.points;
    for (std::size_t t = 0; t < m_Complex.tets.size(); ++t)
    {
      if (!m_Complex.alive(std::int32_t(t))) continue;
      const auto& [a, b, c, d] = m_Complex.tets[t];
      result[m_Complex.labels[t]] += orient(p[a], p[b], p[c], p[d]) / 6;
    }
    return result;
  }

  /// A face at a vertex, seen from one of its labels.
  struct Side
  {
    Label from, to;
    Vec3 area; ///< vector, mm^2, from the one to the other
  };

  Side sideOf(const SheetFace& f) const
  {
    const auto at = [&](int k) { return m_Complex.points[f.vertices[k]]; };
    const Vec3 area = 0.5 * cross(at(1) - at(0), at(2) - at(0));
    const Vec3 inside = m_Complex.points[m_Complex.tets[f.tet][f.face]];
    const Label from = m_Complex.labels[f.tet], to = m_Complex.labels[m_Complex.neighbours[f.tet][f.face]];
    return { from, to, dot(area, inside - at(0)) > 0 ? -1.0 * area : area };
  }

  /// Of the faces at free vertices, mm^2, by the labels on both sides.
  std::map<std::pair<Label, Label>, double> areas()
  {
    std::map<std::pair<Label, Label>, double> result;
    for (std::int32_t v = 0; v < std::int32_t(m_Start.size()); ++v)
    {
      if (!hasNeighbours(v) || m_Complex.locked[v]) continue;
      for (const SheetFace& f : m_Operations.sheet(v).faces)
      {
        const Side side = sideOf(f);
        result[std::minmax(side.from, side.to)] += norm(side.area) / 3;
      }
    }
    return result;
  }

  /// How far (mm) each tissue's boundary has to go outwards for the volume that it had.
  std::map<Label, double> offsets()
  {
    std::map<Label, double> lacking = m_Volumes;
    for (const auto& [label, volume] : volumes()) lacking[label] -= volume;
    return offsetsForVolumes(lacking, areas(), m_Options.farthest);
  }

  /// Where the boundaries of the tissues at v, each offset, meet.
  Vec3 meetingStep(std::int32_t v, const std::map<Label, double>& offset)
  {
    constexpr double spring = 0.05; // where all are nearly one plane
    Quadric quadric;
    for (const SheetFace& f : m_Operations.sheet(v).faces)
    {
      const Side side = sideOf(f);
      const double size = norm(side.area);
      const Vec3 n = side.area / size;
      const double m[6] = { n.x * n.x, n.x * n.y, n.x * n.z, n.y * n.y, n.y * n.z, n.z * n.z };
      for (int i = 0; i < 6; ++i) quadric.m[i] += size * m[i];
      quadric.g += (offset.at(side.from) - offset.at(side.to)) * side.area;
    }
    quadric.addToDiagonal(spring * quadric.trace());
    return quadric.solve(quadric.g);
  }

  void balanceVolumes()
  {
    std::map<Label, double> offset = offsets();
    offset[0] = 0;
    for (std::int32_t v = 0; v < std::int32_t(m_Start.size()); ++v)
    {
      if (!hasNeighbours(v) || m_Complex.locked[v]) continue;
      const Vec3 p = m_Complex.points[v];
      step(v, withinReach(v, p + meetingStep(v, offset)) - p);
    }
  }

  Vec3 withinReach(std::int32_t v, const Vec3& p) const
  {
    const double length = m_Complex.lengths[v], fineness = std::min(1.0, m_Options.fineLength / length);
    const double reach = std::min(0.3 * length, m_Options.farthest * fineness * fineness);
    const Vec3 way = p - m_Start[v];
    const double distance = norm(way);
    return distance > reach ? m_Start[v] + (reach / distance) * way : p;
  }

  GuardedOperations& m_Operations;
  TetComplex& m_Complex;
  const FairingOptions& m_Options;
  const double m_Least;
  const std::vector<Vec3> m_Start;
  const std::map<Label, double> m_Volumes;
  std::vector<Vec3> m_Umbrella;
  std::vector<std::int32_t> m_Begin, m_Neighbours; ///< those of v are m_Neighbours[m_Begin[v]..m_Begin[v + 1])
  FacesAtNeighbours m_Faces;
};

} // namespace

void fairBlock(GuardedOperations& operations, const FairingOptions& options) { Fairing(operations, options).run(); }

} // namespace surgicalmesher
