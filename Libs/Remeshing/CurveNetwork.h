// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Vessels, nerves and tracts thinner than any element, as curves that a mesh is to have along its edges: the
/// curvilinear elements of Audette et al. (MICCAI 2003 workshop paper). Lengths in mm, in one frame of the caller's.

#include "SizingFunction.h"
#include "Vec3.h"

#include <array>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// A polyline as given; closed if its last point is its first.
struct Curve
{
  std::string name;          ///< for sets
  std::string source;        ///< for messages: its file
  std::vector<Vec3> points;  ///< two or more
  std::vector<double> radii; ///< per point, mm; empty: none given
};

/// A piece of a curve between two nodes, by arc length s.
struct CurveArc
{
  std::size_t curve = 0;       ///< which one it is of
  std::array<int, 2> nodes{};  ///< at its ends
  std::vector<Vec3> points;    ///< at most a quarter of the target length apart
  std::vector<double> s;       ///< of each point, ascending from 0
  std::vector<double> lengths; ///< target length at each point
  std::vector<double> radii;   ///< at each point; 0: none given
  std::vector<Vec3> aims;      ///< where the chain of edges is led through for each point, near it

  double length() const { return s.back(); }
  /// Values at arc length `at`, linear between points.
  Vec3 pointAt(double at) const { return valueAt(points, at); }
  Vec3 aimAt(double at) const { return valueAt(aims, at); }
  double lengthAt(double at) const { return valueAt(lengths, at); }
  double radiusAt(double at) const { return valueAt(radii, at); }
  /// Arc length, from `from` to `to`, of the place nearest to p.
  double nearest(const Vec3& p, double from, double to) const;
  /// Whether the arc from `from` to `to` and the segment ab are within `tolerance` target lengths of one another.
  bool isFollowed(double from, const Vec3& a, double to, const Vec3& b, double tolerance) const;

private:
  std::size_t pieceAt(double at) const;
  template <class Value>
  Value valueAt(const std::vector<Value>& values, double at) const
  {
    const std::size_t k = pieceAt(at);
    const double share = (at - s[k]) / (s[k + 1] - s[k]);
    return values[k] + share * (values[k + 1] - values[k]);
  }
};

/// Curves cut where others end on them.
struct CurveNetwork
{
  std::vector<std::string> names, sources; ///< of the curves
  std::vector<Vec3> nodes;                 ///< ends and branchings
  std::vector<CurveArc> arcs;              ///< by curve, along it
};

constexpr double curveJoint = 0.1;      ///< target lengths: an end no farther from another curve is joined to it
constexpr double curveSeparation = 0.2; ///< target lengths: the least distance of curves away from joints

/// Throws InputError, with the curve's source and the place, for a curve of less than two points or shorter than half a
/// target length, one that comes back to itself, and curves that cross or nearly touch elsewhere than at their ends.
CurveNetwork curveNetwork(const std::vector<Curve>& curves, const SizingFunction& length);

} // namespace surgicalmesher
