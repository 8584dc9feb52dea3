// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Pictures of triangles without a display or a graphics library: parallel projection, z-buffer, flat shading by a
/// light at the viewer, edges drawn in, anti-aliased by averaging nine samples a pixel.

#include "Vec3.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace surgicalmesher
{

using Color = std::array<double, 3>; ///< RGB in [0, 1]

struct Facet
{
  std::array<Vec3, 3> corners; ///< mm
  Color color;
};

/// Pixels, from the top left row by row, red, green, blue and opacity.
struct Image
{
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

/// A view along -towards; x to the right, y upwards in the picture.
struct Camera
{
  Vec3 right, up, towards; ///< unit; towards the viewer
  Vec3 centre;             ///< mm; in the middle of the picture
  double mmPerPixel = 1;
  int width = 0, height = 0;

  /// x to the right and y down from the top left corner, in pixels, and the depth towards the viewer in mm.
  Vec3 pixel(const Vec3& point) const;
};

/// A view from the direction `towards` in LPS, cranial side up as far as it can be, in which all facets just fit.
Camera cameraOn(const std::vector<Facet>& facets, const Vec3& towards, int width, int height);

/// The facets before a transparent background.
Image drawn(const std::vector<Facet>& facets, const Camera& camera, bool withEdges = true);

/// What is written over a picture.
struct Annotations
{
  double barLength = 0;    ///< mm; a round number, about a fifth of the width
  double barPixels = 0;    ///< the same in the picture
  std::string left, right; ///< the patient's sides at these sides of the picture: L, R, A, P
};

Annotations annotationsOf(const Camera& camera);

/// Before white, with scale bar and sides drawn into it.
Image annotated(const Image& image, const Camera& camera);

/// The bytes of a PNG file. Throws EngineError if there is no memory for it.
std::string pngOf(const Image& image);

} // namespace surgicalmesher
