// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Two coordinates on the skin and on the inner surface of a slab of soft tissue, which pair the points of both
/// surfaces.

#include "HarmonicField.h"
#include "Progress.h"

#include <string>
#include <vector>

namespace surgicalmesher
{

/// The part of a slab's closed surface to which a triangle belongs.
enum class Side : std::uint8_t
{
  Hole,  ///< wall of a hole from the outer to the inner surface: mouth, eyes, nostrils
  Outer, ///< skin
  Inner, ///< mucosa and bone
  Right,
  Left,
  Bottom,
  Top
};

constexpr int kSides = 7;
const char* nameOf(Side side);

/// The closed surface of a slab, with the side of each triangle.
struct Envelope
{
  TriangleSurface surface;
  std::vector<Side> sides;
};

/// Returns `surface` with sides: each triangle takes the side of the triangle of `painted` closest to its centre with a
/// similar normal. `painted` may be another surface, and open. Throws InputError with `sidesFile` if a side other than
/// Hole gets no triangle.
Envelope withSides(const TriangleSurface& surface, const TriangleSurface& painted, const std::vector<Side>& sides,
                   const std::string& sidesFile);

/// A part of the envelope with coordinates in [0, 1]: u from right to left, w from bottom to top, a column per point.
struct Chart
{
  TriangleSurface surface;
  Eigen::Matrix2Xd coordinates;
};

struct SlabParameterisation
{
  Chart outer, inner;
  Envelope envelope; ///< refined by edge division, triangles oriented outwards
};

/// The inside of an envelope as tetrahedra.
struct FilledEnvelope
{
  Envelope envelope; ///< refined by edge division, triangles oriented outwards
  Tetrahedra mesh;
  std::vector<std::int32_t> ids; ///< by point of the envelope: its id in `mesh`
};

/// Fills the envelope with tetrahedra of edge length about `edgeLength` (mm). Throws SurfaceRefused (an InputError)
/// with `name` unless the envelope is one closed surface without self-intersections.
FilledEnvelope filledEnvelope(const Envelope& envelope, double edgeLength, const std::string& name);

/// The harmonic field that is 0 on one side, 1 on the other.
Eigen::VectorXd harmonicBetween(const FilledEnvelope& filled, Side zero, Side one);

/// Parameterises a slab after Kim et al. 2018, section 3.2.1. The envelope is filled with tetrahedra of edge length
/// about `edgeLength` (mm). w is the harmonic field that is 0 on the bottom and 1 on the top; u is the harmonic field
/// that is 0 on the right and 1 on the left, with its gradient made orthogonal to that of w and integrated again. Walls
/// of holes are free boundaries: the fields flow around them. Throws as filledEnvelope() does.
SlabParameterisation parameterise(const Envelope& envelope, double edgeLength, const std::string& name,
                                  const Progress& progress = {});

} // namespace surgicalmesher
