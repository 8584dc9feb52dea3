// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Two coordinates on the skin and on the inner surface of a slab of soft tissue, by which points of the one have
/// partners on the other.

#include "HarmonicField.h"
#include "Progress.h"

#include <string>
#include <vector>

namespace surgicalmesher
{

/// What part of a slab's closed surface a triangle belongs to.
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

/// A slab's closed surface, each triangle with its side.
struct Envelope
{
  TriangleSurface surface;
  std::vector<Side> sides;
};

/// A triangle takes the side of the triangle of `painted` that is next to its middle and faces alike. `painted` need not
/// be the same surface, nor closed. Throws InputError, naming `sidesFile`, if a side but Hole ends without a triangle.
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
  Envelope envelope; ///< with edges divided, triangles wound outwards
};

/// The inside of an envelope as tetrahedra.
struct FilledEnvelope
{
  Envelope envelope; ///< with edges divided, triangles wound outwards
  Tetrahedra mesh;
  std::vector<std::int32_t> ids; ///< of the envelope's points among those of `mesh`
};

/// Of edge length about `edgeLength` (mm). Throws SurfaceRefused (an InputError), naming `name`, unless the envelope is
/// one closed surface without self-intersections.
FilledEnvelope filledEnvelope(const Envelope& envelope, double edgeLength, const std::string& name);

/// The harmonic field that is 0 on one side, 1 on the other.
Eigen::VectorXd harmonicBetween(const FilledEnvelope& filled, Side zero, Side one);

/// Tetrahedra of edge length about `edgeLength` (mm) fill the envelope; w is harmonic on them, 0 on the bottom and 1 on
/// the top; u is harmonic, 0 on the right and 1 on the left, made orthogonal to w and restored from its gradient. After
/// Kim et al. 2018, section 3.2.1. Walls of holes are left free: the fields flow around them. Throws as
/// filledEnvelope() does.
SlabParameterisation parameterise(const Envelope& envelope, double edgeLength, const std::string& name,
                                  const Progress& progress = {});

} // namespace surgicalmesher
