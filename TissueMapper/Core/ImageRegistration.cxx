// SPDX-License-Identifier: Apache-2.0
#include "ImageRegistration.h"

#include "Errors.h"
#include "MutualInformation.h"
#include "Sampling.h"

#include <itkImageMomentsCalculator.h>
#include <itkImageToHistogramFilter.h>
#include <itkLandmarkBasedTransformInitializer.h>
#include <itkOtsuThresholdCalculator.h>
#include <itkShrinkImageFilter.h>
#include <itkSmoothingRecursiveGaussianImageFilter.h>
#include <itkVersor.h>
#include <itkVersorRigid3DTransform.h>
#include <vtkSMPTools.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace surgicalmesher
{

namespace
{

using Samples = MutualInformation::Samples;
using Matrix = itk::Matrix<double, 3, 3>;

constexpr double pi = 3.14159265358979323846;

/// The same numbers on any machine, which the standard's distributions don't promise.
class Random
{
public:
  double uniform() { return (double(m_Engine()) + 0.5) / 4294967296.0; }
  double normal()
  {
    const double radius = std::sqrt(-2 * std::log(uniform()));
    return radius * std::cos(2 * pi * uniform());
  }

private:
  std::mt19937 m_Engine{ 20 };
};

template <typename Point>
Point toItk(const Vec3& p)
{
  Point result;
  for (int axis = 0; axis < 3; ++axis) result[axis] = p[axis];
  return result;
}

LinearMap mapOf(const LinearParameters& parameters, const Vec3& centre)
{
  LinearMap map;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column) map.rows[row][column] = parameters[std::size_t(3 * row + column)];
    map.offset[row] = centre[row] + parameters[std::size_t(9 + row)] - dot(map.rows[row], centre);
  }
  return map;
}

/// The image without its extremes, which would leave the tissues few of the histogram's bins.
ItkImage::Pointer withoutExtremes(const ScalarImage& image, const char* which)
{
  std::vector<float> some;
  const std::size_t stride = std::max<std::size_t>(1, image.values.size() / 500000);
  for (std::size_t n = 0; n < image.values.size(); n += stride) some.push_back(image.values[n]);
  const auto quantile = [&](double share)
  {
    const auto place = some.begin() + std::ptrdiff_t(share * double(some.size() - 1));
    std::nth_element(some.begin(), place, some.end());
    return *place;
  };
  const float low = quantile(0.002);
  const float high = quantile(0.998);
  if (!(low < high)) throw InputError(std::string("the ") + which + " image has one value nearly everywhere");
  for (const int size : image.grid.size)
  {
    if (size < 8) throw InputError(std::string("the ") + which + " image has fewer than eight voxels along an axis");
  }
  std::vector<float> values = image.values;
  for (float& value : values) value = std::clamp(value, low, high);
  return asItkImage<ItkImage>(image.grid, values);
}

/// The image in voxels of about `spacing` (mm), blurred as they ask; itself if its own are as large.
ItkImage::Pointer coarser(const ItkImage::Pointer& image, double spacing)
{
  using Blur = itk::SmoothingRecursiveGaussianImageFilter<ItkImage, ItkImage>;
  using Shrink = itk::ShrinkImageFilter<ItkImage, ItkImage>;
  const auto shrink = Shrink::New();
  double largest = 0;
  for (unsigned axis = 0; axis < 3; ++axis)
  {
    const double own = image->GetSpacing()[axis];
    const int most = int(image->GetBufferedRegion().GetSize(axis)) / 4;
    shrink->SetShrinkFactor(axis, unsigned(std::clamp(int(spacing / own + 0.1), 1, most)));
    largest = std::max(largest, own);
  }
  if (largest >= spacing) return image;
  const auto blur = Blur::New();
  blur->SetInput(image);
  blur->SetSigma(0.6 * spacing);
  shrink->SetInput(blur->GetOutput());
  shrink->Update();
  const ItkImage::Pointer result = shrink->GetOutput();
  result->DisconnectPipeline();
  return result;
}

class SampleList
{
public:
  SampleList(const Grid& grid, const std::vector<bool>& mask) : m_Grid(grid), m_Mask(mask) {}

  /// Whether it counts: not off the voxel centres' box, where nothing can be interpolated, or outside the mask.
  bool add(const Vec3& inGrid)
  {
    const Vec3 index = toIndex(m_Grid, inGrid);
    for (int axis = 0; axis < 3; ++axis)
    {
      if (!(index[axis] >= 0 && index[axis] <= m_Grid.size[axis] - 1)) return false;
    }
    const std::array<int, 3> v = nearestVoxel(m_Grid, inGrid);
    if (!m_Mask.empty() && !m_Mask[m_Grid.index(v[0], v[1], v[2])]) return false;
    m_Points.push_back(m_Grid.gridToWorld(inGrid));
    return true;
  }

  const std::vector<Vec3>& points() const { return m_Points; }

  Samples::Pointer result() const
  {
    const auto samples = Samples::New();
    for (std::size_t n = 0; n < m_Points.size(); ++n) samples->SetPoint(n, toItk<Samples::PointType>(m_Points[n]));
    return samples;
  }

private:
  const Grid& m_Grid;
  const std::vector<bool>& m_Mask;
  std::vector<Vec3> m_Points;
};

/// Calls draw(random) until `count` of its places count; throws if hardly one in a thousand does.
template <typename Draw>
SampleList drawSamples(const Grid& grid, const std::vector<bool>& mask, int count, const char* where, Draw draw)
{
  SampleList samples(grid, mask);
  Random random;
  for (long tries = 0; int(samples.points().size()) < count; ++tries)
  {
    samples.add(draw(random));
    if (tries > 1000L * count) throw InputError(std::string("hardly a voxel of the fixed image lies ") + where);
  }
  return samples;
}

SampleList samplesEverywhere(const Grid& grid, const std::vector<bool>& mask, int count)
{
  return drawSamples(grid, mask, count, "in the mask",
                     [&](Random& random)
                     {
                       Vec3 p;
                       for (int axis = 0; axis < 3; ++axis)
                         p[axis] = random.uniform() * (grid.size[axis] - 1) * grid.spacing[axis];
                       return p;
                     });
}

SampleList samplesAround(const Grid& grid, const std::vector<bool>& mask, const Sphere& target, int count)
{
  const Vec3 centre = grid.worldToGrid(target.centre);
  return drawSamples(grid, mask, count, "around the target",
                     [&](Random& random)
                     {
                       Vec3 p = centre;
                       for (int axis = 0; axis < 3; ++axis) p[axis] += 0.5 * target.radius * random.normal();
                       return p;
                     });
}

/// Where the samples are, and how far they scatter: what a turn or a stretch moves them by.
struct Extent
{
  Vec3 centre;
  double radius = 0; ///< root mean square distance, mm
};

Extent extentOf(const std::vector<Vec3>& points)
{
  Extent extent;
  for (const Vec3& p : points) extent.centre += p / double(points.size());
  for (const Vec3& p : points) extent.radius += squaredNorm(p - extent.centre) / double(points.size());
  extent.radius = std::sqrt(extent.radius);
  return extent;
}

/// What is brighter than the background: its centre and principal axes (rows), which are a rotation.
struct Body
{
  Vec3 centre;
  Matrix axes;
};

Body bodyOf(const ItkImage::Pointer& image)
{
  using Histograms = itk::Statistics::ImageToHistogramFilter<ItkImage>;
  const auto histograms = Histograms::New();
  histograms->SetInput(image);
  Histograms::HistogramSizeType bins(1);
  bins.Fill(128);
  histograms->SetHistogramSize(bins);
  histograms->SetAutoMinimumMaximum(true);
  histograms->Update();
  const auto otsu = itk::OtsuThresholdCalculator<Histograms::HistogramType>::New();
  otsu->SetInput(histograms->GetOutput());
  otsu->Update();
  const auto threshold = float(otsu->GetThreshold());

  const auto bright = ItkImage::New();
  bright->CopyInformation(image);
  bright->SetRegions(image->GetBufferedRegion());
  bright->Allocate();
  const float* values = image->GetBufferPointer();
  std::transform(values, values + image->GetBufferedRegion().GetNumberOfPixels(), bright->GetBufferPointer(),
                 [&](float value) { return value > threshold ? 1.f : 0.f; });
  const auto moments = itk::ImageMomentsCalculator<ItkImage>::New();
  moments->SetImage(bright);
  moments->Compute();
  Body body;
  for (int axis = 0; axis < 3; ++axis) body.centre[axis] = moments->GetCenterOfGravity()[axis];
  body.axes = Matrix(moments->GetPrincipalAxes().GetVnlMatrix());
  return body;
}

/// The rotation by the length (radians) of a vector about it.
Matrix rotationBy(const Vec3& vector)
{
  itk::Versor<double> versor;
  const double angle = norm(vector);
  if (angle > 0) versor.Set(toItk<itk::Versor<double>::VectorType>(vector), angle);
  return versor.GetMatrix();
}

Matrix turned(int axis, double angle)
{
  Vec3 vector;
  vector[axis] = angle;
  return rotationBy(vector);
}

LinearParameters withMatrix(const Matrix& matrix, const Vec3& shift)
{
  LinearParameters parameters;
  for (unsigned n = 0; n < 9; ++n) parameters[n] = matrix(n / 3, n % 3);
  for (int axis = 0; axis < 3; ++axis) parameters[std::size_t(9 + axis)] = shift[axis];
  return parameters;
}

Matrix matrixOf(const LinearParameters& parameters)
{
  Matrix matrix;
  for (unsigned n = 0; n < 9; ++n) matrix(n / 3, n % 3) = parameters[n];
  return matrix;
}

double scaleOf(const LinearParameters& parameters)
{
  const std::array<Vec3, 3> rows = mapOf(parameters, {}).rows;
  return std::cbrt(dot(cross(rows[0], rows[1]), rows[2]));
}

/// Turns, shifts and one scale from a map on: seven steps. `radius`: the lever of turns and of the scale, mm.
LinearChart similaritiesFrom(const LinearParameters& start, double radius)
{
  return [=](const std::vector<double>& steps)
  {
    const Matrix turn = rotationBy(Vec3{ steps[0], steps[1], steps[2] } / radius);
    const Vec3 shift{ start[9] + steps[3], start[10] + steps[4], start[11] + steps[5] };
    return withMatrix((turn * matrixOf(start)) * std::exp(steps[6] / radius), shift);
  };
}

/// All linear maps: twelve steps.
LinearChart linearMapsFrom(const LinearParameters& start, double radius)
{
  return [=](const std::vector<double>& steps)
  {
    LinearParameters parameters = start;
    for (std::size_t n = 0; n < 12; ++n) parameters[n] += n < 9 ? steps[n] * std::sqrt(3.0) / radius : steps[n];
    return parameters;
  };
}

/// Root mean square distance between what two maps make of points that scatter as the extent says, mm.
double distanceBetween(const LinearMap& a, const LinearMap& b, const Extent& extent)
{
  double sum = squaredNorm(a(extent.centre) - b(extent.centre));
  for (int row = 0; row < 3; ++row) sum += squaredNorm(a.rows[row] - b.rows[row]) * extent.radius * extent.radius / 3;
  return std::sqrt(sum);
}

/// Images and samples at one coarseness.
struct Level
{
  ItkImage::Pointer fixed;
  ItkImage::Pointer moving;
  Samples::Pointer samples;

  MutualInformation information(const Vec3& centre) const { return { fixed, moving, samples, centre }; }
};

/// Calls run(n) for every n below count, in a fixed number of blocks.
template <typename Run>
void inParallel(std::size_t count, Run run)
{
  vtkSMPTools::For(0, vtkIdType(count), 1,
                   [&](vtkIdType begin, vtkIdType end)
                   {
                     for (vtkIdType n = begin; n < end; ++n) run(std::size_t(n));
                   });
}

/// A pose and how good it is. Information is weighed by overlap: of a few samples at a corner it is always large.
struct Pose
{
  LinearParameters parameters{};
  double information = 0;
};

/// The search for the pose among many, on the coarsest images.
class PoseSearch
{
public:
  PoseSearch(Level level, const Extent& extent) : m_Level(std::move(level)), m_Extent(extent) {}

  void measure(std::vector<Pose>& poses) const
  {
    constexpr std::size_t blocks = 16; // a metric reads both images when it is made
    inParallel(blocks,
               [&](std::size_t block)
               {
                 MutualInformation information = m_Level.information(m_Extent.centre);
                 for (std::size_t n = block; n < poses.size(); n += blocks)
                 {
                   poses[n].information = information.at(poses[n].parameters);
                   poses[n].information *= information.overlap();
                 }
               });
  }

  /// Each pose's nearest maximum.
  void follow(std::vector<Pose>& poses) const
  {
    inParallel(poses.size(),
               [&](std::size_t n)
               {
                 MutualInformation information = m_Level.information(m_Extent.centre);
                 poses[n].parameters = information.maximise(similaritiesFrom(poses[n].parameters, m_Extent.radius), 7);
                 poses[n].information = information.at(poses[n].parameters);
                 poses[n].information *= information.overlap();
               });
  }

  double distance(const LinearParameters& a, const LinearParameters& b) const
  {
    return distanceBetween(mapOf(a, m_Extent.centre), mapOf(b, m_Extent.centre), m_Extent);
  }

  /// The best poses, no two within `apart` (mm).
  std::vector<Pose> best(std::vector<Pose> poses, std::size_t count, double apart) const
  {
    std::stable_sort(poses.begin(), poses.end(),
                     [](const Pose& a, const Pose& b) { return a.information > b.information; });
    std::vector<Pose> chosen;
    for (const Pose& pose : poses)
    {
      const bool isNew =
        std::all_of(chosen.begin(), chosen.end(),
                    [&](const Pose& other) { return distance(pose.parameters, other.parameters) >= apart; });
      if (isNew) chosen.push_back(pose);
      if (chosen.size() == count) break;
    }
    return chosen;
  }

  /// A pose turned by `angle` about an axis, and moved.
  Pose beside(const Pose& pose, int axis, double angle, const Vec3& shift) const
  {
    const LinearParameters& from = pose.parameters;
    return { withMatrix(turned(axis, angle) * matrixOf(from), Vec3{ from[9], from[10], from[11] } + shift), 0 };
  }

  const Level& level() const { return m_Level; }
  const Extent& extent() const { return m_Extent; }

private:
  Level m_Level;
  Extent m_Extent;
};

std::vector<Matrix> firstRotations(RegistrationStart start, const Body& fixed, const Body& moving)
{
  Matrix identity;
  identity.SetIdentity();
  std::vector<Matrix> rotations{ identity };
  for (int axis = 0; axis < 3; ++axis) rotations.push_back(turned(axis, pi));
  if (start != RegistrationStart::PrincipalAxes) return rotations;
  for (Matrix& rotation : rotations)
    rotation = Matrix((moving.axes.GetTranspose() * rotation.GetVnlMatrix().as_ref() * fixed.axes.GetVnlMatrix()));
  return rotations;
}

/// Poses that bring the two bodies together, give or take 40 mm.
std::vector<Pose> posesOfBodies(RegistrationStart start, const Level& level, const Extent& extent)
{
  const Body fixed = bodyOf(level.fixed);
  const Body moving = bodyOf(level.moving);
  std::vector<Pose> poses;
  for (const Matrix& rotation : firstRotations(start, fixed, moving))
  {
    const Vec3 image = moving.centre + mapOf(withMatrix(rotation, {}), {})(extent.centre - fixed.centre);
    for (int step = 0; step < 125; ++step)
    {
      const Vec3 shift{ 20.0 * (step % 5 - 2), 20.0 * (step / 5 % 5 - 2), 20.0 * (step / 25 - 2) };
      poses.push_back({ withMatrix(rotation, image + shift - extent.centre), 0 });
    }
  }
  return poses;
}

Pose poseOfLandmarks(const RegistrationOptions& options, const Vec3& centre)
{
  using Rigid = itk::VersorRigid3DTransform<double>;
  using Initializer = itk::LandmarkBasedTransformInitializer<Rigid, ItkImage, ItkImage>;
  Initializer::LandmarkPointContainer fixed, moving;
  for (const Vec3& p : options.fixedLandmarks) fixed.push_back(toItk<Initializer::LandmarkPointType>(p));
  for (const Vec3& p : options.movingLandmarks) moving.push_back(toItk<Initializer::LandmarkPointType>(p));
  const auto transform = Rigid::New();
  const auto initializer = Initializer::New();
  initializer->SetFixedLandmarks(fixed);
  initializer->SetMovingLandmarks(moving);
  initializer->SetTransform(transform);
  initializer->InitializeTransform();
  const auto image = transform->TransformPoint(toItk<Rigid::InputPointType>(centre));
  return { withMatrix(transform->GetMatrix(), Vec3{ image[0], image[1], image[2] } - centre), 0 };
}

/// The best few poses to start from.
std::vector<Pose> startingPoses(const RegistrationOptions& options, const PoseSearch& search)
{
  constexpr double angle = 12 * pi / 180;
  std::vector<Pose> poses;
  if (options.start == RegistrationStart::Landmarks) poses.push_back(poseOfLandmarks(options, search.extent().centre));
  else
  {
    poses = posesOfBodies(options.start, search.level(), search.extent());
    search.measure(poses);
    poses = search.best(poses, 12, 15);
  }
  const std::size_t count = poses.size();
  for (std::size_t n = 0; n < count; ++n)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      for (const int side : { -1, 1 }) poses.push_back(search.beside(poses[n], axis, side * angle, {}));
    }
  }
  search.measure(poses);
  return search.best(poses, 6, 5);
}

[[noreturn]] void failToConverge(const std::string& reason)
{
  throw InputError("the registration does not converge: " + reason +
                   "; landmarks (--initial landmarks) or another image may help");
}

/// Starts that lead to the best pose.
struct Agreement
{
  int count = 0;
  int of = 0;
};

/// That other starts, and poses 6 mm and 6 degrees beside it, lead to the pose, and to no other place nearly as good.
Agreement requireThatItConverges(const PoseSearch& search, const Pose& found, const std::vector<Pose>& others)
{
  constexpr double near = 3; // mm, in voxels of 5
  for (const Pose& other : others)
  {
    if (search.distance(found.parameters, other.parameters) < 3 * near) continue;
    if (other.information > 0.97 * found.information)
      failToConverge("two poses, " + std::to_string(std::lround(search.distance(found.parameters, other.parameters))) +
                     " mm apart, are as good as each other");
  }
  std::vector<Pose> back;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const int side : { -1, 1 })
    {
      Vec3 shift;
      shift[(axis + 1) % 3] = 6.0 * side;
      back.push_back(search.beside(found, axis, 6 * side * pi / 180, shift));
    }
  }
  search.follow(back);
  back.insert(back.end(), others.begin(), others.end());
  const auto agreeing =
    std::count_if(back.begin(), back.end(),
                  [&](const Pose& pose) { return search.distance(pose.parameters, found.parameters) < near; });
  const Agreement agreement{ int(agreeing) - 1, int(back.size()) - 1 }; // the best is one of them itself
  if (agreement.count < 4)
  {
    failToConverge("of " + std::to_string(agreement.of) + " other starts, six of them beside the best pose, " +
                   std::to_string(agreement.count) + " lead to it");
  }
  return agreement;
}

/// Rotation and scale as found on coarse images, made sharper on finer ones.
void refineGlobally(const std::vector<Level>& levels, const PoseSearch& search, LinearParameters pose,
                    Registration& result)
{
  const Extent& extent = search.extent();
  const LinearParameters first = pose;
  double overlap = 0;
  for (const Level& level : levels)
  {
    MutualInformation information = level.information(extent.centre);
    pose = information.maximise(similaritiesFrom(pose, extent.radius), 7);
    result.globalInformation = information.at(pose);
    overlap = information.overlap();
  }
  if (overlap < 0.2)
    failToConverge(std::to_string(std::lround(100 * overlap)) + " % of the fixed image meets the moving one");
  const double moved = search.distance(first, pose);
  if (moved > 10)
    failToConverge("fine images lead " + std::to_string(std::lround(moved)) + " mm away from coarse ones");
  result.scale = scaleOf(pose);
  if (result.scale < 0.75 || result.scale > 1.33) failToConverge("the scale is " + std::to_string(result.scale));
  result.global = mapOf(pose, extent.centre);
}

/// All twelve parameters, by what lies around the target.
void refineAround(const std::vector<Level>& levels, const Extent& extent, Registration& result)
{
  Matrix matrix;
  for (unsigned n = 0; n < 9; ++n) matrix(n / 3, n % 3) = result.global.rows[n / 3][int(n % 3)];
  const LinearParameters start = withMatrix(matrix, result.global(extent.centre) - extent.centre);
  LinearParameters parameters = start;
  for (const Level& level : levels)
  {
    MutualInformation information = level.information(extent.centre);
    result.targetInformationBefore = information.at(start);
    parameters = information.maximise(linearMapsFrom(parameters, extent.radius), 12);
    result.targetInformation = information.at(parameters);
  }
  result.local = mapOf(parameters, extent.centre);
  const double moved = distanceBetween(result.global, *result.local, extent);
  if (moved > 15)
    failToConverge("around the target it leads " + std::to_string(std::lround(moved)) +
                   " mm away from the pose of all");
}

} // namespace

Registration registerImages(const ScalarImage& fixed, const ScalarImage& moving, const RegistrationOptions& options,
                            const Progress& progress)
{
  const SingleThread oneOfItk;
  report(progress, 0, "coarse images");
  const ItkImage::Pointer fineFixed = withoutExtremes(fixed, "fixed");
  const ItkImage::Pointer fineMoving = withoutExtremes(moving, "moving");
  const auto level = [&](double spacing, const SampleList& samples) {
    return Level{ coarser(fineFixed, spacing), coarser(fineMoving, spacing), samples.result() };
  };
  const SampleList few = samplesEverywhere(fixed.grid, options.mask, 4000);
  const PoseSearch search(level(5, few), extentOf(few.points()));

  report(progress, 0.1, "starts");
  std::vector<Pose> poses = startingPoses(options, search);
  Registration result;
  result.startInformation = poses.front().information;
  search.follow(poses);
  const Pose found = search.best(poses, 1, 0).front();
  report(progress, 0.3, "convergence");
  const Agreement agreement = requireThatItConverges(search, found, poses);
  result.agreeingStarts = agreement.count;
  result.otherStarts = agreement.of;

  report(progress, 0.5, "all");
  const SampleList more = samplesEverywhere(fixed.grid, options.mask, 40000);
  refineGlobally({ level(2, more), level(1, more) }, search, found.parameters, result);
  if (!options.target) return result;
  report(progress, 0.75, "around the target");
  const SampleList around = samplesAround(fixed.grid, options.mask, *options.target, 40000);
  refineAround({ level(2, around), level(1, around) }, extentOf(around.points()), result);
  return result;
}

ScalarImage resampled(const ScalarImage& moving, const LinearMap& map, const Grid& grid)
{
  ScalarImage result;
  result.grid = grid;
  result.values.assign(grid.voxelCount(), *std::min_element(moving.values.begin(), moving.values.end()));
  inParallel(std::size_t(grid.size[2]),
             [&](std::size_t k)
             {
               for (int j = 0; j < grid.size[1]; ++j)
                 for (int i = 0; i < grid.size[0]; ++i)
                 {
                   const Vec3 p = moving.grid.worldToGrid(map(grid.gridToWorld(grid.position(i, j, int(k)))));
                   if (isInVolume(moving.grid, p))
                     result.values[grid.index(i, j, int(k))] = float(linearValue(moving.grid, moving.values, p));
                 }
             });
  return result;
}

} // namespace surgicalmesher
