// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Renders triangles without a display or a graphics library: parallel projection, z-buffer, flat shading by a light at
/// the viewer, edges, and anti-aliasing with nine samples per pixel.

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

/// Pixels row by row from the top left; four bytes each: red, green, blue, opacity.
struct Image
{
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;
};

/// A view along -towards; x to the right, y upwards in the picture.
struct Camera
{
  Vec3 right, up, towards; ///< unit vectors; `towards` points to the viewer
  Vec3 centre;             ///< mm; in the middle of the picture
  double mmPerPixel = 1;
  int width = 0, height = 0;

  /// x to the right and y down from the top left corner, in pixels, and the depth towards the viewer in mm.
  Vec3 pixel(const Vec3& point) const;
};

/// Returns a view from the direction `towards` (LPS) that just fits all facets, with the cranial direction as far up as
/// possible.
Camera cameraOn(const std::vector<Facet>& facets, const Vec3& towards, int width, int height);

/// Renders the facets on a transparent background.
Image drawn(const std::vector<Facet>& facets, const Camera& camera, bool withEdges = true);

/// Annotations of a picture.
struct Annotations
{
  double barLength = 0;    ///< mm; a round number, at most a fifth of the width
  double barPixels = 0;    ///< length of the bar in pixels
  std::string left, right; ///< the patient's sides at the left and right of the picture: L, R, A, P
};

Annotations annotationsOf(const Camera& camera);

/// Returns the image on a white background, with scale bar and sides.
Image annotated(const Image& image, const Camera& camera);

/// Returns the bytes of a PNG file. Throws EngineError if it cannot be encoded.
std::string pngOf(const Image& image);

} // namespace surgicalmesher
