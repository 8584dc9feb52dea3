// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Vessels, nerves and tracts thinner than any element, as curves that a mesh is to follow with its edges: the
/// curvilinear elements of Audette et al. (MICCAI 2003 workshop paper). Coordinates in mm, in the frame of the mesh.

#include "SizingFunction.h"
#include "Vec3.h"

#include <array>
#include <string>
#include <vector>

namespace surgicalmesher
{

/// An input polyline; closed if its last point equals its first.
struct Curve
{
  std::string name;          ///< names the chain of the curve, and so its sets in exports
  std::string source;        ///< names the curve in error messages: its file
  std::vector<Vec3> points;  ///< two or more
  std::vector<double> radii; ///< per point, mm; empty: none given
};

/// A piece of a curve between two nodes, parametrized by arc length s (mm).
struct CurveArc
{
  std::size_t curve = 0;       ///< index of its curve
  std::array<int, 2> nodes{};  ///< indices of the nodes at its ends
  std::vector<Vec3> points;    ///< about a quarter of the target length apart at most
  std::vector<double> s;       ///< arc length of each point, ascending from 0
  std::vector<double> lengths; ///< target length at each point, mm
  std::vector<double> radii;   ///< at each point, mm; 0: none given
  std::vector<Vec3> aims;      ///< for each point, a place near it that the chain of edges is to pass through

  double length() const { return s.back(); }
  /// Values at arc length `at`, interpolated linearly between points.
  Vec3 pointAt(double at) const { return valueAt(points, at); }
  Vec3 aimAt(double at) const { return valueAt(aims, at); }
  double lengthAt(double at) const { return valueAt(lengths, at); }
  double radiusAt(double at) const { return valueAt(radii, at); }
  /// Returns the arc length, between `from` and `to`, of the place nearest to p.
  double nearest(const Vec3& p, double from, double to) const;
  /// Whether the arc between arc lengths `from` and `to` and the segment ab are within `tolerance` target lengths of
  /// each other.
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

/// Curves, cut into arcs where other curves end on them.
struct CurveNetwork
{
  std::vector<std::string> names, sources; ///< of each curve
  std::vector<Vec3> nodes;                 ///< ends and branchings of the curves
  std::vector<CurveArc> arcs;              ///< grouped by curve, in order along it
};

constexpr double curveJoint = 0.1;      ///< target lengths; a curve's end this near to another curve is joined to it
constexpr double curveSeparation = 0.2; ///< target lengths; least distance between curves away from joints

/// Joins curves at their ends and cuts them into arcs. Throws InputError, with the curve's source and the place, for a
/// curve shorter than half a target length, a curve that crosses or nearly touches itself, and curves that cross or
/// nearly touch each other elsewhere than at their ends; with the source alone for a curve of fewer than two points.
CurveNetwork curveNetwork(const std::vector<Curve>& curves, const SizingFunction& length);

} // namespace surgicalmesher
