// SPDX-License-Identifier: Apache-2.0
#include "RegistrationPoses.h"

#include "Errors.h"

#include <itkImageMomentsCalculator.h>
#include <itkImageToHistogramFilter.h>
#include <itkLandmarkBasedTransformInitializer.h>
#include <itkMath.h>
#include <itkOtsuThresholdCalculator.h>
#include <itkVersorRigid3DTransform.h>
#include <vtkSMPTools.h>

#include <algorithm>
#include <cmath>

namespace surgicalmesher
{

namespace
{

constexpr double pi = itk::Math::pi;

template <typename Point>
Point toItk(const Vec3& p)
{
  Point result;
  for (int axis = 0; axis < 3; ++axis) result[axis] = p[axis];
  return result;
}

/// The region brighter than the background: its centroid and its principal axes (rows), which form a rotation.
struct Body
{
  Vec3 centre;
  Matrix3 axes;
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
  body.axes = Matrix3(moments->GetPrincipalAxes().GetVnlMatrix());
  return body;
}

/// Returns a pose rotated by `angle` about a world axis and shifted.
Pose beside(const Pose& pose, int axis, double angle, const Vec3& shift)
{
  const LinearParameters& from = pose.parameters;
  return { withMatrix(turned(axis, angle) * matrixOf(from), Vec3{ from[9], from[10], from[11] } + shift), 0 };
}

/// Calls run(n) for every n below `count`, in parallel.
template <typename Run>
void inParallel(std::size_t count, Run run)
{
  vtkSMPTools::For(0, vtkIdType(count), 1,
                   [&](vtkIdType begin, vtkIdType end)
                   {
                     for (vtkIdType n = begin; n < end; ++n) run(std::size_t(n));
                   });
}

std::vector<Matrix3> firstRotations(RegistrationStart start, const Body& fixed, const Body& moving)
{
  Matrix3 identity;
  identity.SetIdentity();
  std::vector<Matrix3> rotations{ identity };
  for (int axis = 0; axis < 3; ++axis) rotations.push_back(turned(axis, pi));
  if (start != RegistrationStart::PrincipalAxes) return rotations;
  for (Matrix3& rotation : rotations)
    rotation = Matrix3((moving.axes.GetTranspose() * rotation.GetVnlMatrix().as_ref() * fixed.axes.GetVnlMatrix()));
  return rotations;
}

/// Poses that align the two bodies, with shifts of up to 40 mm along each axis.
std::vector<Pose> posesOfBodies(RegistrationStart start, const Level& level, const Extent& extent)
{
  const Body fixed = bodyOf(level.fixed);
  const Body moving = bodyOf(level.moving);
  std::vector<Pose> poses;
  for (const Matrix3& rotation : firstRotations(start, fixed, moving))
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

} // namespace

void PoseSearch::measure(std::vector<Pose>& poses) const
{
  constexpr std::size_t blocks = 16; // one metric per block, not per pose: its construction reads both images
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

void PoseSearch::follow(std::vector<Pose>& poses) const
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

double PoseSearch::distance(const LinearParameters& a, const LinearParameters& b) const
{
  return distanceBetween(mapOf(a, m_Extent.centre), mapOf(b, m_Extent.centre), m_Extent);
}

std::vector<Pose> PoseSearch::best(std::vector<Pose> poses, std::size_t count, double apart) const
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
      for (const int side : { -1, 1 }) poses.push_back(beside(poses[n], axis, side * angle, {}));
    }
  }
  search.measure(poses);
  return search.best(poses, 6, 5);
}

Agreement requireThatItConverges(const PoseSearch& search, const Pose& found, const std::vector<Pose>& others)
{
  constexpr double near = 3; // mm, on images with voxels of 5 mm
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
      back.push_back(beside(found, axis, 6 * side * pi / 180, shift));
    }
  }
  search.follow(back);
  back.insert(back.end(), others.begin(), others.end());
  const auto agreeing =
    std::count_if(back.begin(), back.end(),
                  [&](const Pose& pose) { return search.distance(pose.parameters, found.parameters) < near; });
  const Agreement agreement{ int(agreeing) - 1, int(back.size()) - 1 }; // `found` is one of `others`
  if (agreement.count < 4)
  {
    failToConverge("of " + std::to_string(agreement.of) + " other starts, six of them beside the best pose, " +
                   std::to_string(agreement.count) + " lead to it");
  }
  return agreement;
}

void failToConverge(const std::string& reason)
{
  throw InputError("the registration does not converge: " + reason +
                   "; landmarks (--initial landmarks) or another image may help");
}

} // namespace surgicalmesher
