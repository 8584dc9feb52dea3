// SPDX-License-Identifier: Apache-2.0
#include "CurveNetwork.h"

#include "Distance.h"
#include "Errors.h"
#include "Place.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

namespace surgicalmesher
{

namespace
{

/// Returns the parameter, from 0 at a to 1 at b, of the point of segment ab nearest to p.
double shareAlong(const Vec3& p, const Vec3& a, const Vec3& b)
{
  const Vec3 ab = b - a;
  const double length2 = squaredNorm(ab);
  return length2 > 0 ? std::clamp(dot(p - a, ab) / length2, 0.0, 1.0) : 0;
}

/// Returns the curve as one arc, without points that repeat the previous one, in steps of about a quarter of the target
/// length at most.
CurveArc subdivided(const Curve& curve, std::size_t number, const SizingFunction& length)
{
  constexpr double step = 0.25;
  if (curve.points.size() < 2) throw InputError(curve.source + ": a curve of one point, expected two points or more");
  const bool hasRadii = !curve.radii.empty();
  CurveArc arc;
  arc.curve = number;
  const auto add = [&](const Vec3& p, double radius)
  {
    const double ds = arc.points.empty() ? 0 : norm(p - arc.points.back());
    if (!arc.points.empty() && !(ds > 0)) return;
    arc.s.push_back(arc.s.empty() ? 0 : arc.s.back() + ds);
    arc.points.push_back(p);
    arc.lengths.push_back(length(p));
    arc.radii.push_back(radius);
  };
  add(curve.points[0], hasRadii ? curve.radii[0] : 0);
  for (std::size_t n = 1; n < curve.points.size(); ++n)
  {
    const Vec3 a = curve.points[n - 1], b = curve.points[n];
    const double atA = hasRadii ? curve.radii[n - 1] : 0, atB = hasRadii ? curve.radii[n] : 0;
    double done = 0;
    for (const double whole = norm(b - a); done < whole;)
    {
      const double share = done / whole, next = done + step * length(a + share * (b - a));
      done = next > whole - 0.1 * (next - done) ? whole : next;
      add(a + (done / whole) * (b - a), atA + (done / whole) * (atB - atA));
    }
  }
  const double shortest = 0.5 * arc.lengths.front();
  if (arc.points.size() < 2 || arc.length() < shortest)
  {
    throw InputError(curve.source + ": a curve that is not half as long as an edge at " + place(arc.points.front()) +
                     " LPS, expected a longer one");
  }
  return arc;
}

/// A node on a curve, where the curve is to be cut.
struct Cut
{
  double s; ///< arc length
  int node;
};

class NetworkBuilder
{
public:
  NetworkBuilder(const std::vector<Curve>& curves, const SizingFunction& length)
  {
    for (const Curve& curve : curves)
    {
      m_Network.names.push_back(curve.name);
      m_Network.sources.push_back(curve.source);
      m_Wholes.push_back(subdivided(curve, m_Wholes.size(), length));
    }
    m_Cuts.resize(m_Wholes.size());
  }

  CurveNetwork build()
  {
    for (std::size_t c = 0; c < m_Wholes.size(); ++c)
      for (const bool atEnd : { false, true }) addEnd(c, atEnd);
    for (std::size_t c = 0; c < m_Wholes.size(); ++c) cutCurve(c);
    requireSeparation();
    return std::move(m_Network);
  }

private:
  /// Arc length at which p joins the host: at an end within reach, else at the nearest place inside it, if that is
  /// within reach. Joining it inside next to an end would join both places to one node, with an arc from it to itself.
  static std::optional<double> jointOn(const CurveArc& host, const Vec3& p, double reach)
  {
    for (const double end : { 0., host.length() })
      if (norm(host.pointAt(end) - p) <= reach) return end;
    const double s = host.nearest(p, reach, std::max(reach, host.length() - reach));
    if (norm(host.pointAt(s) - p) > reach) return std::nullopt;
    return s;
  }

  /// Joins an end of curve c to a node within reach, else to another curve, else makes it a node.
  void addEnd(std::size_t c, bool atEnd)
  {
    const CurveArc& whole = m_Wholes[c];
    const Vec3 p = atEnd ? whole.points.back() : whole.points.front();
    const double reach = curveJoint * (atEnd ? whole.lengths.back() : whole.lengths.front());
    const double at = atEnd ? whole.length() : 0;
    for (std::size_t n = 0; n < m_Network.nodes.size(); ++n)
      if (norm(m_Network.nodes[n] - p) <= reach) return m_Cuts[c].push_back({ at, int(n) });
    const int node = int(m_Network.nodes.size());
    for (std::size_t other = 0; other < m_Wholes.size(); ++other)
    {
      const std::optional<double> s = other == c ? std::nullopt : jointOn(m_Wholes[other], p, reach);
      if (!s) continue;
      m_Network.nodes.push_back(m_Wholes[other].pointAt(*s));
      m_Cuts[other].push_back({ *s, node });
      return m_Cuts[c].push_back({ at, node });
    }
    m_Network.nodes.push_back(p);
    m_Cuts[c].push_back({ at, node });
  }

  void cutCurve(std::size_t c)
  {
    std::vector<Cut>& cuts = m_Cuts[c];
    std::sort(cuts.begin(), cuts.end(),
              [](const Cut& a, const Cut& b) { return std::tie(a.s, a.node) < std::tie(b.s, b.node); });
    for (std::size_t n = 1; n < cuts.size(); ++n)
    {
      if (!(cuts[n].s > cuts[n - 1].s)) continue;
      m_Network.arcs.push_back(piece(m_Wholes[c], cuts[n - 1].s, cuts[n].s));
      m_Network.arcs.back().nodes = { cuts[n - 1].node, cuts[n].node };
    }
  }

  static CurveArc piece(const CurveArc& whole, double from, double to)
  {
    CurveArc arc;
    arc.curve = whole.curve;
    const auto add = [&](double at)
    {
      arc.s.push_back(at - from);
      arc.points.push_back(whole.pointAt(at));
      arc.lengths.push_back(whole.lengthAt(at));
      arc.radii.push_back(whole.radiusAt(at));
    };
    add(from);
    for (const double at : whole.s)
      if (at > from && at < to) add(at);
    add(to);
    arc.aims = arc.points;
    return arc;
  }

  struct Place
  {
    Vec3 point;
    std::size_t arc;
    double s, length;
  };

  /// Returns the distance along the curves between two places on one arc or on two arcs with a common node; else
  /// infinity.
  double wayBetween(const Place& a, const Place& b) const
  {
    const CurveArc &x = m_Network.arcs[a.arc], &y = m_Network.arcs[b.arc];
    double way = a.arc == b.arc ? std::abs(a.s - b.s) : std::numeric_limits<double>::infinity();
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        if (x.nodes[i] == y.nodes[j] && !(a.arc == b.arc && i == j))
          way = std::min(way, (i ? x.length() - a.s : a.s) + (j ? y.length() - b.s : b.s));
    return way;
  }

  void requireSeparation() const
  {
    constexpr double nearWay = 1.5; // target lengths; by then, curves at an angle of 15 degrees have separated
    std::vector<Place> places;
    for (std::size_t n = 0; n < m_Network.arcs.size(); ++n)
    {
      const CurveArc& arc = m_Network.arcs[n];
      const int steps =
        std::max(1, int(std::ceil(arc.length() / (0.1 * *std::min_element(arc.lengths.begin(), arc.lengths.end())))));
      for (int k = 0; k <= steps; ++k)
      {
        const double s = arc.length() * k / steps;
        places.push_back({ arc.pointAt(s), n, s, arc.lengthAt(s) });
      }
    }
    std::stable_sort(places.begin(), places.end(),
                     [](const Place& a, const Place& b) { return a.point.x < b.point.x; });
    for (std::size_t i = 0; i < places.size(); ++i)
      for (std::size_t j = i + 1; j < places.size(); ++j)
      {
        const Place &a = places[i], &b = places[j];
        const double least = curveSeparation * a.length;
        if (b.point.x - a.point.x >= least) break;
        if (squaredNorm(b.point - a.point) < least * least && wayBetween(a, b) > nearWay * a.length) refuse(a, b);
      }
  }

  [[noreturn]] void refuse(const Place& a, const Place& b) const
  {
    const std::size_t ofA = m_Network.arcs[a.arc].curve, ofB = m_Network.arcs[b.arc].curve;
    const std::string &x = m_Network.sources[ofA], &y = m_Network.sources[ofB];
    const std::string where = " near " + surgicalmesher::place(a.point) + " LPS";
    if (ofA == ofB)
      throw InputError(x + ": the curve crosses or touches itself" + where + ", expected one that does not");
    throw InputError(y + ": the curve crosses or touches " + x + where +
                     ", expected curves that meet only where one of them ends");
  }

  CurveNetwork m_Network;
  std::vector<CurveArc> m_Wholes;       ///< each curve as one arc
  std::vector<std::vector<Cut>> m_Cuts; ///< of each curve
};

} // namespace

std::size_t CurveArc::pieceAt(double at) const
{
  const auto above = std::size_t(std::upper_bound(s.begin(), s.end(), at) - s.begin());
  return std::clamp<std::size_t>(above, 1, s.size() - 1) - 1;
}

double CurveArc::nearest(const Vec3& p, double from, double to) const
{
  double best = from, least = std::numeric_limits<double>::infinity();
  for (std::size_t k = pieceAt(from); k + 1 < s.size() && s[k] <= to; ++k)
  {
    const double free = s[k] + shareAlong(p, points[k], points[k + 1]) * (s[k + 1] - s[k]);
    const double at = std::clamp(free, from, to), distance2 = squaredNorm(p - pointAt(at));
    if (distance2 < least) least = distance2, best = at;
  }
  return best;
}

bool CurveArc::isFollowed(double from, const Vec3& a, double to, const Vec3& b, double tolerance) const
{
  if (norm(a - pointAt(from)) > tolerance * lengthAt(from) || norm(b - pointAt(to)) > tolerance * lengthAt(to))
    return false;
  const auto begin = std::size_t(std::upper_bound(s.begin(), s.end(), from) - s.begin());
  for (std::size_t k = begin; k < s.size() && s[k] < to; ++k)
    if (distanceToSegment(points[k], a, b) > tolerance * lengths[k]) return false;
  return true;
}

CurveNetwork curveNetwork(const std::vector<Curve>& curves, const SizingFunction& length)
{
  return NetworkBuilder(curves, length).build();
}

} // namespace surgicalmesher
