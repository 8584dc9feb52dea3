// SPDX-License-Identifier: Apache-2.0
#include "Picture.h"

#include "Errors.h"
#include "Text.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace surgicalmesher
{

namespace
{

constexpr int samples = 3;        ///< along each side of a pixel
constexpr double edgeWidth = 1.1; ///< in samples, of the half of an edge that each of its two triangles draws
constexpr double margin = 0.05;   ///< share of the picture's width and height left empty on each side
constexpr double ambient = 0.4, diffuse = 0.6, edgeShade = 0.45;

Vec3 unit(const Vec3& v) { return v / norm(v); }

/// The samples of a picture.
struct Samples
{
  int width, height;
  std::vector<float> depth;                        ///< towards the viewer; lowest where there is nothing
  std::vector<std::array<std::uint8_t, 3>> colors; ///< where there is something
};

double sideOf(const Vec3& a, const Vec3& b, double x, double y)
{
  return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

/// A facet in the coordinates of samples, oriented so that its area is positive.
struct Projection
{
  std::array<Vec3, 3> corners;
  double area = 0;                ///< twice the area
  std::array<double, 3> length{}; ///< of the side opposite each corner
};

Projection projected(const Facet& facet, const Camera& camera)
{
  Projection seen;
  for (int i = 0; i < 3; ++i)
  {
    const Vec3 p = camera.pixel(facet.corners[i]);
    seen.corners[i] = { p.x * samples, p.y * samples, p.z };
  }
  seen.area = sideOf(seen.corners[0], seen.corners[1], seen.corners[2].x, seen.corners[2].y);
  if (seen.area < 0)
  {
    std::swap(seen.corners[1], seen.corners[2]);
    seen.area = -seen.area;
  }
  for (int i = 0; i < 3; ++i)
  {
    const Vec3 &a = seen.corners[(i + 1) % 3], &b = seen.corners[(i + 2) % 3];
    seen.length[i] = std::hypot(b.x - a.x, b.y - a.y);
  }
  return seen;
}

double brightness(const Facet& facet, const Camera& camera)
{
  const Vec3 normal = cross(facet.corners[1] - facet.corners[0], facet.corners[2] - facet.corners[0]);
  const double size = norm(normal);
  return ambient + (size > 0 ? diffuse * std::abs(dot(normal, camera.towards)) / size : 0);
}

std::array<std::uint8_t, 3> bytesOf(const Color& color, double shade)
{
  std::array<std::uint8_t, 3> bytes;
  for (int i = 0; i < 3; ++i) bytes[i] = std::uint8_t(std::lround(255 * std::clamp(color[i] * shade, 0.0, 1.0)));
  return bytes;
}

void drawFacet(Samples& picture, const Facet& facet, const Camera& camera, bool withEdges)
{
  const Projection seen = projected(facet, camera);
  if (!(seen.area > 0)) return;
  const auto& [a, b, c] = seen.corners;
  const double shade = brightness(facet, camera);
  const auto inner = bytesOf(facet.color, shade), edge = bytesOf(facet.color, shade * edgeShade);
  const int left = std::max(0, int(std::floor(std::min({ a.x, b.x, c.x })))),
            right = std::min(picture.width - 1, int(std::ceil(std::max({ a.x, b.x, c.x })))),
            top = std::max(0, int(std::floor(std::min({ a.y, b.y, c.y })))),
            bottom = std::min(picture.height - 1, int(std::ceil(std::max({ a.y, b.y, c.y }))));
  for (int row = top; row <= bottom; ++row)
  {
    for (int column = left; column <= right; ++column)
    {
      const double x = column + 0.5, y = row + 0.5;
      const std::array<double, 3> sides{ sideOf(b, c, x, y), sideOf(c, a, x, y), sideOf(a, b, x, y) };
      if (sides[0] < 0 || sides[1] < 0 || sides[2] < 0) continue;
      const auto depth = float((sides[0] * a.z + sides[1] * b.z + sides[2] * c.z) / seen.area);
      const std::size_t n = std::size_t(row) * picture.width + column;
      if (depth <= picture.depth[n]) continue;
      bool isEdge = false;
      for (int i = 0; i < 3; ++i) isEdge = isEdge || sides[i] < edgeWidth * seen.length[i];
      picture.depth[n] = depth;
      picture.colors[n] = withEdges && isEdge ? edge : inner;
    }
  }
}

/// Returns a pixel: the mean colour of the samples that show something, and their share as opacity.
std::array<std::uint8_t, 4> averaged(const Samples& picture, int x, int y)
{
  std::array<int, 3> sum{};
  int count = 0;
  for (int row = y * samples; row < (y + 1) * samples; ++row)
  {
    for (int column = x * samples; column < (x + 1) * samples; ++column)
    {
      const std::size_t n = std::size_t(row) * picture.width + column;
      if (picture.depth[n] == std::numeric_limits<float>::lowest()) continue;
      for (int i = 0; i < 3; ++i) sum[i] += picture.colors[n][i];
      ++count;
    }
  }
  if (count == 0) return {};
  constexpr int all = samples * samples;
  return { std::uint8_t(sum[0] / count), std::uint8_t(sum[1] / count), std::uint8_t(sum[2] / count),
           std::uint8_t(255 * count / all) };
}

/// Letters as polylines on a grid of 4 by 6, y down.
using Strokes = std::vector<std::vector<std::array<double, 2>>>;

const std::map<char, Strokes>& strokes()
{
  static const std::map<char, Strokes> letters{
    { '0', { { { 0, 0 }, { 4, 0 }, { 4, 6 }, { 0, 6 }, { 0, 0 } } } },
    { '1', { { { 1, 1 }, { 2, 0 }, { 2, 6 } } } },
    { '2', { { { 0, 0 }, { 4, 0 }, { 4, 3 }, { 0, 3 }, { 0, 6 }, { 4, 6 } } } },
    { '5', { { { 4, 0 }, { 0, 0 }, { 0, 3 }, { 4, 3 }, { 4, 6 }, { 0, 6 } } } },
    { '.', { { { 1, 6 }, { 1.2, 6 } } } },
    { 'm', { { { 0, 6 }, { 0, 2 }, { 4, 2 }, { 4, 6 } }, { { 2, 2 }, { 2, 6 } } } },
    { 'L', { { { 0, 0 }, { 0, 6 }, { 4, 6 } } } },
    { 'R', { { { 0, 6 }, { 0, 0 }, { 4, 0 }, { 4, 3 }, { 0, 3 }, { 4, 6 } } } },
    { 'A', { { { 0, 6 }, { 2, 0 }, { 4, 6 } }, { { 0.8, 4 }, { 3.2, 4 } } } },
    { 'P', { { { 0, 6 }, { 0, 0 }, { 4, 0 }, { 4, 3 }, { 0, 3 } } } },
  };
  return letters;
}

void drawLine(Image& image, std::array<double, 2> from, std::array<double, 2> to, double width)
{
  const double dx = to[0] - from[0], dy = to[1] - from[1], length2 = std::max(dx * dx + dy * dy, 1e-9);
  const int left = std::max(0, int(std::min(from[0], to[0]) - width)),
            right = std::min(image.width - 1, int(std::max(from[0], to[0]) + width)),
            top = std::max(0, int(std::min(from[1], to[1]) - width)),
            bottom = std::min(image.height - 1, int(std::max(from[1], to[1]) + width));
  for (int y = top; y <= bottom; ++y)
  {
    for (int x = left; x <= right; ++x)
    {
      const double px = x + 0.5 - from[0], py = y + 0.5 - from[1];
      const double along = std::clamp((px * dx + py * dy) / length2, 0.0, 1.0);
      const double distance = std::hypot(px - along * dx, py - along * dy);
      const double cover = std::clamp(width / 2 + 0.5 - distance, 0.0, 1.0);
      std::uint8_t* pixel = &image.rgba[4 * (std::size_t(y) * image.width + x)];
      for (int i = 0; i < 3; ++i) pixel[i] = std::uint8_t(pixel[i] * (1 - cover) + 34 * cover);
    }
  }
}

/// Draws a text; `unit` is the size in pixels of a grid step of the letters, x and y the upper left corner.
void drawText(Image& image, const std::string& text, double x, double y, double unit)
{
  for (const char letter : text)
  {
    const auto found = strokes().find(letter);
    if (found != strokes().end())
    {
      for (const auto& line : found->second)
        for (std::size_t i = 1; i < line.size(); ++i)
          drawLine(image, { x + line[i - 1][0] * unit, y + line[i - 1][1] * unit },
                   { x + line[i][0] * unit, y + line[i][1] * unit }, unit);
    }
    x += (letter == '.' || letter == ' ' ? 3.0 : 6.0) * unit;
  }
}

/// Returns the largest number of the form 1, 2 or 5 times a power of ten that is at most `length`.
double roundLength(double length)
{
  const double power = std::pow(10.0, std::floor(std::log10(length)));
  double best = power;
  for (const double factor : { 2.0, 5.0 })
  {
    if (factor * power <= length * (1 + 1e-9)) best = factor * power;
  }
  return best;
}

} // namespace

Vec3 Camera::pixel(const Vec3& point) const
{
  const Vec3 d = point - centre;
  return { width / 2.0 + dot(d, right) / mmPerPixel, height / 2.0 - dot(d, up) / mmPerPixel, dot(d, towards) };
}

Camera cameraOn(const std::vector<Facet>& facets, const Vec3& towards, int width, int height)
{
  Camera camera;
  camera.towards = unit(towards);
  const bool isVertical = std::abs(camera.towards.z) > 0.999;
  camera.right = unit(cross(isVertical ? Vec3{ 0, -1, 0 } : Vec3{ 0, 0, 1 }, camera.towards));
  camera.up = cross(camera.towards, camera.right);
  camera.width = width;
  camera.height = height;
  const std::array<Vec3, 3> axes{ camera.right, camera.up, camera.towards };
  constexpr double huge = std::numeric_limits<double>::max();
  std::array<double, 3> low{ huge, huge, huge }, high{ -huge, -huge, -huge };
  for (const Facet& facet : facets)
  {
    for (const Vec3& corner : facet.corners)
    {
      for (int i = 0; i < 3; ++i)
      {
        low[i] = std::min(low[i], dot(corner, axes[i]));
        high[i] = std::max(high[i], dot(corner, axes[i]));
      }
    }
  }
  if (facets.empty()) return camera;
  for (int i = 0; i < 3; ++i) camera.centre += axes[i] * ((low[i] + high[i]) / 2);
  const double room = 1 - 2 * margin;
  camera.mmPerPixel = std::max({ (high[0] - low[0]) / (width * room), (high[1] - low[1]) / (height * room), 1e-9 });
  return camera;
}

Image drawn(const std::vector<Facet>& facets, const Camera& camera, bool withEdges)
{
  Samples picture{ camera.width * samples, camera.height * samples, {}, {} };
  const std::size_t count = std::size_t(picture.width) * picture.height;
  picture.depth.assign(count, std::numeric_limits<float>::lowest());
  picture.colors.resize(count);
  for (const Facet& facet : facets) drawFacet(picture, facet, camera, withEdges);
  Image image{ camera.width, camera.height, {} };
  for (int y = 0; y < image.height; ++y)
  {
    for (int x = 0; x < image.width; ++x)
    {
      const auto pixel = averaged(picture, x, y);
      image.rgba.insert(image.rgba.end(), pixel.begin(), pixel.end());
    }
  }
  return image;
}

Annotations annotationsOf(const Camera& camera)
{
  Annotations notes;
  notes.barLength = roundLength(camera.mmPerPixel * camera.width / 5);
  notes.barPixels = notes.barLength / camera.mmPerPixel;
  const bool isSideways = std::abs(camera.right.x) >= std::abs(camera.right.y);
  notes.left = isSideways ? "R" : "A";
  notes.right = isSideways ? "L" : "P"; // LPS: x runs to the left, y to the back
  if ((isSideways ? camera.right.x : camera.right.y) < 0) std::swap(notes.left, notes.right);
  return notes;
}

Image annotated(const Image& image, const Camera& camera)
{
  Image result = image;
  for (std::size_t n = 0; n < result.rgba.size(); n += 4)
  {
    const int opacity = result.rgba[n + 3];
    for (int i = 0; i < 3; ++i)
      result.rgba[n + i] = std::uint8_t((result.rgba[n + i] * opacity + 255 * (255 - opacity)) / 255);
    result.rgba[n + 3] = 255;
  }
  const Annotations notes = annotationsOf(camera);
  const double unit = std::max(1.0, image.width / 400.0);
  const double right = image.width - 6 * unit, bottom = image.height - 6 * unit;
  drawLine(result, { right - notes.barPixels, bottom }, { right, bottom }, 2 * unit);
  const std::string length = text::rounded(notes.barLength, 3) + " mm";
  drawText(result, length, right - notes.barPixels, bottom - 10 * unit, unit);
  drawText(result, notes.left, 6 * unit, 6 * unit, 1.5 * unit);
  drawText(result, notes.right, image.width - 12 * unit, 6 * unit, 1.5 * unit);
  return result;
}

std::string pngOf(const Image& image)
{
  vtkNew<vtkImageData> pixels;
  pixels->SetDimensions(image.width, image.height, 1);
  pixels->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  auto* bytes = static_cast<std::uint8_t*>(pixels->GetScalarPointer());
  const std::size_t row = std::size_t(image.width) * 4;
  for (int y = 0; y < image.height; ++y) // VTK stores rows from bottom to top
    std::copy_n(image.rgba.begin() + std::ptrdiff_t(y * row), row, bytes + (image.height - 1 - y) * row);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(pixels);
  writer->SetCompressionLevel(9);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* result = writer->GetResult();
  if (!result || result->GetNumberOfValues() == 0) throw EngineError("picture: the PNG can't be made");
  return { reinterpret_cast<const char*>(result->GetPointer(0)), std::size_t(result->GetNumberOfValues()) };
}

} // namespace surgicalmesher
