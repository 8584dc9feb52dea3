// SPDX-License-Identifier: Apache-2.0
#include "TemplateFit.h"

#include "Carrying.h"
#include "ElementQuality.h"
#include "Errors.h"
#include "FitEnergy.h"
#include "Repair.h"
#include "Slab.h"
#include "SurfaceDistance.h"
#include "ThinPlateSpline.h"
#include "Validity.h"

#include <gtest/gtest.h>
#include <vtkSMPTools.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

std::size_t invalidIn(const ElementMesh& mesh, const Points& points)
{
  const ElementMesh moved{ points, mesh.elements };
  return summaryOf(moved, elementQuality(moved), ElementShape::Hexahedron).invalid;
}

double distanceTo(const ElementMesh& mesh, const Points& points, const TriangleSurface& target)
{
  return distanceBetween(outerSurface({ points, mesh.elements }), TargetSurface(target)).mean;
}

void expectRefused(const LandmarkPairs& pairs, const std::string& expected)
{
  try
  {
    requireUsable(pairs, "template.fcsv", "patient.fcsv");
    FAIL() << "accepted, expected: " << expected;
  }
  catch (const InputError& error)
  {
    EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
  }
}

/// The outer faces as elements, with all points, those that no face uses too.
ElementMesh sheetOf(const ElementMesh& mesh)
{
  ElementMesh sheet{ mesh.points, {} };
  for (const Face& face : outerFaces(mesh.elements))
    sheet.elements.push_back({ ElementShape::Quad, { face.nodes[0], face.nodes[1], face.nodes[2], face.nodes[3] } });
  return sheet;
}

Pull pullTo(std::int32_t node, const Eigen::Vector3d& goal)
{
  Pull pull;
  pull.nodes[0] = node;
  pull.weights[0] = 1;
  pull.goal = goal;
  pull.all = 1;
  return pull;
}

/// Bent, and sheared so that no element keeps its corners.
Points folded(const Points& points)
{
  Points moved = bent(points);
  for (Eigen::Index i = 0; i < moved.cols(); ++i) moved(0, i) += 12 * std::sin(moved(1, i) / 8);
  return moved;
}

} // namespace

TEST(ThinPlateSpline, TakesCentresToGoalsAndKeepsAffineMaps)
{
  const Points points = slab().points;
  const LandmarkPairs pairs = everyNth(points, bent(points), 17);
  const ThinPlateSpline spline(pairs.source, pairs.target);
  EXPECT_LT((spline(pairs.source) - pairs.target).cwiseAbs().maxCoeff(), 1e-8);
  const Eigen::Affine3d map =
    Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()) * Eigen::Scaling(1., 2., 3.);
  const ThinPlateSpline affine(pairs.source, map * pairs.source);
  EXPECT_LT((affine(points) - map * points).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(ThinPlateSpline, FarthestPointsAreDifferentAndSpread)
{
  const Points points = slab().points;
  const std::vector<std::int32_t> chosen = farthestPoints(points, 20);
  ASSERT_EQ(chosen.size(), 20u);
  for (std::size_t i = 0; i < chosen.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j) EXPECT_GT((points.col(chosen[i]) - points.col(chosen[j])).norm(), 10);
  }
  EXPECT_EQ(farthestPoints(points, 100000).size(), std::size_t(points.cols()));
}

TEST(Landmarks, AreMatchedByNameInAnyOrder)
{
  NamedPoints a{ "a.fcsv", { "chin", "nose" }, Points(3, 2) }, b{ "b.fcsv", { "nose", "chin" }, Points(3, 2) };
  a.points << 1, 2, 0, 0, 0, 0;
  b.points << 20, 10, 0, 0, 0, 0;
  const LandmarkPairs pairs = pairedByName(a, b);
  EXPECT_EQ(pairs.target(0, 0), 10);
  EXPECT_EQ(pairs.target(0, 1), 20);
  b.names[1] = "ear";
  EXPECT_THROW(pairedByName(a, b), InputError);
  b.names = { "nose", "nose" };
  EXPECT_THROW(pairedByName(a, b), InputError);
}

TEST(Landmarks, RefusesWhatASplineCanNotUse)
{
  const Points points = slab().points;
  const LandmarkPairs good = everyNth(points, bent(points), 17);
  EXPECT_NO_THROW(requireUsable(good, "template.fcsv", "patient.fcsv"));
  LandmarkPairs pairs = everyNth(points, bent(points), 120);
  expectRefused(pairs, "at least four");
  pairs = good;
  pairs.target.row(0) *= -1;
  expectRefused(pairs, "mirror");
  pairs = good;
  pairs.target *= 0.001;
  expectRefused(pairs, "units");
  pairs = good;
  for (Eigen::Index i = 0; i < pairs.source.cols(); ++i) pairs.source.col(i) = Eigen::Vector3d(1, 2, 3) * double(i);
  expectRefused(pairs, "template.fcsv: all landmarks lie in one line");
  pairs = good;
  pairs.target.row(2) = pairs.target.row(0) + 2 * pairs.target.row(1);
  expectRefused(pairs, "patient.fcsv: all landmarks lie in one plane");
  pairs = good;
  pairs.target.col(3) = pairs.target.col(4);
  expectRefused(pairs, "one place");
}

TEST(FitEnergy, GradientIsThatOfTheEnergy)
{
  ElementMesh mesh = slab(3, 2, 1);
  const ElementMesh outside = sheetOf(mesh);
  mesh.elements.insert(mesh.elements.end(), outside.elements.begin(), outside.elements.end());
  FitEnergy energy(mesh);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> noise(-6, 6); // enough to turn elements over
  Points points = mesh.points;
  for (Eigen::Index i = 0; i < points.size(); ++i) points.data()[i] += noise(random);
  energy.pulls = { { { 0, 1, 2, 0 }, { 0.5, 0.25, 0.25, 0 }, { 1, 2, 3 }, { 0.6, 0.8, 0 }, 1, 0.02 },
                   { { 7, 0, 0, 0 }, { 1, 0, 0, 0 }, { 0, 0, 0 }, { 0, 0, 1 }, -0.3, 0.3 } };
  energy.weights = { 1.5, 10, 0.4, 0.2 };
  Points gradient, unused;
  energy.evaluate(points, gradient);
  for (Eigen::Index i = 0; i < points.size(); ++i)
  {
    const double h = 1e-5;
    Points forward = points, backward = points;
    forward.data()[i] += h;
    backward.data()[i] -= h;
    const double slope = (energy.evaluate(forward, unused) - energy.evaluate(backward, unused)) / (2 * h);
    EXPECT_NEAR(gradient.data()[i], slope, 1e-5 * (1 + std::abs(slope)));
  }
}

TEST(FitEnergy, UntanglesElementsThatAreTurnedOver)
{
  const ElementMesh mesh = slab();
  FitEnergy energy(mesh);
  Points points = mesh.points;
  const int inner = 5 + 11 * (4 + 9);
  points.col(inner) += Eigen::Vector3d(18, 12, 0); // past its neighbours
  ASSERT_GT(invalidIn(mesh, points), 0u);
  energy.weights = { 0.01, 10, 0.4, 0.2 };
  energy.reference = points; // smoothness alone would keep it there
  for (Eigen::Index i = 0; i < points.cols(); ++i)
  {
    if (i != inner) energy.pulls.push_back(pullTo(std::int32_t(i), mesh.points.col(i)));
  }
  minimise(energy, points, 100);
  EXPECT_EQ(invalidIn(mesh, points), 0u);
}

TEST(FitEnergy, UnfoldsFacetsThatAreTurnedOver)
{
  const ElementMesh mesh = sheetOf(slab());
  FitEnergy energy(mesh);
  EXPECT_EQ(energy.turnedFacets(mesh.points), 0u);
  Points points = mesh.points;
  const int inside = 5 + 11 * (4 + 9 * 2); // of the outermost layer
  points.col(inside) += Eigen::Vector3d(18, 12, 0);
  ASSERT_GT(energy.turnedFacets(points), 0u);
  energy.weights = { 0.01, 10, 0.25, 0 };
  energy.reference = points;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
  {
    if (i != inside) energy.pulls.push_back(pullTo(std::int32_t(i), mesh.points.col(i)));
  }
  minimise(energy, points, 100);
  EXPECT_EQ(energy.turnedFacets(points), 0u);
}

TEST(TemplateFit, FollowsABentTargetWithValidElements)
{
  const ElementMesh mesh = slab();
  const Points truth = bent(mesh.points);
  const TriangleSurface target = outerSurface({ truth, mesh.elements });
  const LandmarkPairs pairs = everyNth(mesh.points, truth, 23);
  const FitResult fit = fitTemplate(mesh, pairs, TargetSurface(target));
  EXPECT_EQ(fit.points.cols(), mesh.points.cols());
  EXPECT_EQ(invalidIn(mesh, fit.points), 0u);
  EXPECT_LT(distanceTo(mesh, fit.points, target), 0.3);
  EXPECT_LT(distanceTo(mesh, fit.points, target), distanceTo(mesh, fit.spline, target) / 2);
  EXPECT_LT((fit.landmarks - pairs.target).colwise().norm().maxCoeff(), 0.3);
}

TEST(TemplateFit, DoesNotCareHowTheTargetIsWound)
{
  const ElementMesh mesh = slab();
  const TriangleSurface target = outerSurface({ bent(mesh.points), mesh.elements });
  const LandmarkPairs pairs = everyNth(mesh.points, bent(mesh.points), 23);
  const Points expected = fitTemplate(mesh, pairs, TargetSurface(target)).points;
  TriangleSurface turned = target;
  for (std::size_t t = 0; t < turned.triangles.size(); t += 3)
    std::swap(turned.triangles[t][0], turned.triangles[t][1]);
  const Points points = fitTemplate(mesh, pairs, TargetSurface(turned)).points;
  EXPECT_LT((points - expected).cwiseAbs().maxCoeff(), 0.05);
}

TEST(TemplateFit, IsNotPulledOverTheBorderOfASmallerTarget)
{
  const ElementMesh mesh = slab();
  const Points truth = bent(mesh.points);
  TriangleSurface target = outerSurface({ truth, mesh.elements });
  const auto isCutOff = [&](const Triangle& t) { return target.points.row(1)(t[0]) > 20; };
  target.triangles.erase(std::remove_if(target.triangles.begin(), target.triangles.end(), isCutOff),
                         target.triangles.end());
  const TriangleSurface cut = compacted(target.points, target.triangles);
  const FitResult fit = fitTemplate(mesh, everyNth(mesh.points, truth, 23), TargetSurface(cut));
  EXPECT_EQ(invalidIn(mesh, fit.points), 0u);
  EXPECT_LT((fit.points - truth).colwise().norm().maxCoeff(), 5);
}

TEST(TemplateFit, LeavesNoInvalidElementWhereTheSplineDoes)
{
  const ElementMesh mesh = slab();
  Points truth = bent(mesh.points);
  LandmarkPairs pairs = everyNth(mesh.points, truth, 13);
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 4);
  for (Eigen::Index i = 0; i < pairs.target.size(); ++i) pairs.target.data()[i] += noise(random);
  ASSERT_GT(invalidIn(mesh, ThinPlateSpline(pairs.source, pairs.target)(mesh.points)), 0u);
  FitOptions options;
  options.landmarkWeight = 1;
  const FitResult fit = fitTemplate(mesh, pairs, TargetSurface(outerSurface({ truth, mesh.elements })), options);
  EXPECT_EQ(invalidIn(mesh, fit.points), 0u);
}

TEST(TemplateFit, RepairsWhatIsWorseThanAskedFor)
{
  const ElementMesh mesh = slab();
  const Points truth = folded(mesh.points);
  const TargetSurface target(outerSurface({ truth, mesh.elements }));
  const LandmarkPairs pairs = everyNth(mesh.points, truth, 13);
  FitOptions options;
  options.minimumScaledJacobian = 0;
  const FitResult valid = fitTemplate(mesh, pairs, target, options);
  const double least = validityOf(mesh.elements, valid.points).minimum;
  EXPECT_EQ(valid.repairRounds, 0);
  options.minimumScaledJacobian = least + 0.01;
  const FitResult better = fitTemplate(mesh, pairs, target, options);
  EXPECT_GT(better.repairRounds, 0);
  EXPECT_GT(validityOf(mesh.elements, better.points).minimum, least);
  options.minimumScaledJacobian = 1;
  EXPECT_LT(fitTemplate(mesh, pairs, target, options).repairRounds, options.repairRounds);
}

TEST(TemplateFit, FitsASurfaceWithoutElementsInside)
{
  const ElementMesh whole = slab();
  const ElementMesh sheet = sheetOf(whole);
  const TriangleSurface target = outerSurface({ bent(whole.points), whole.elements });
  const FitResult fit = fitTemplate(sheet, everyNth(whole.points, bent(whole.points), 23), TargetSurface(target));
  EXPECT_LT(distanceTo(sheet, fit.points, target), 0.3);
  EXPECT_EQ(fit.turnedFacets, 0u);
}

TEST(TemplateFit, DoesNotDrawASheetToWhatTheOneBesideItFits)
{
  ElementMesh both = sheetOf(slab());
  const auto isInner = [](const Element& element)
  { return *std::min_element(&element.nodes[0], &element.nodes[4]) < 198; };
  both.elements.erase(std::remove_if(both.elements.begin(), both.elements.end(), isInner), both.elements.end());
  const auto count = std::int32_t(both.points.cols());
  const TriangleSurface target = outerSurface({ bent(both.points), both.elements });
  const LandmarkPairs pairs = everyNth(both.points, bent(both.points), 23);
  for (const Element& element : std::vector<Element>(both.elements))
  {
    Element beside = element;
    for (int i = 0; i < 4; ++i) beside.nodes[i] += count;
    both.elements.push_back(beside);
  }
  const Points alone = both.points;
  both.points.resize(3, 2 * count);
  both.points << alone, alone.colwise() + Eigen::Vector3d(0, 0, 10);
  const FitResult fit = fitTemplate(both, pairs, TargetSurface(target));
  const Points between = fit.points.rightCols(count) - fit.points.leftCols(count);
  for (const Element& element : both.elements) EXPECT_GT(between.col(element.nodes[0] % count).norm(), 3);
}

TEST(TemplateFit, GivesTheSameBytesWhateverTheThreads)
{
  const ElementMesh mesh = slab();
  const TargetSurface target(outerSurface({ bent(mesh.points), mesh.elements }));
  const LandmarkPairs pairs = everyNth(mesh.points, bent(mesh.points), 23);
  vtkSMPTools::Initialize(1);
  const Points one = fitTemplate(mesh, pairs, target).points;
  vtkSMPTools::Initialize(3);
  const Points three = fitTemplate(mesh, pairs, target).points;
  vtkSMPTools::Initialize(0);
  EXPECT_EQ(one, three);
}

TEST(TemplateFit, CanBeCancelledAtEveryReport)
{
  const ElementMesh mesh = slab(4, 4, 1);
  const TargetSurface target(outerSurface({ bent(mesh.points), mesh.elements }));
  const LandmarkPairs pairs = everyNth(mesh.points, bent(mesh.points), 7);
  int reports = 0;
  fitTemplate(mesh, pairs, target, {}, [&](double, const std::string&) { ++reports; });
  ASSERT_GT(reports, 5);
  for (int stop = 0; stop < reports; ++stop)
  {
    int count = 0;
    const auto cancel = [&](double, const std::string&)
    {
      if (count++ == stop) throw std::runtime_error("cancelled");
    };
    EXPECT_THROW(fitTemplate(mesh, pairs, target, {}, cancel), std::runtime_error);
  }
}

TEST(Carrying, TakesPointsWhereTheNodesGo)
{
  const ElementMesh mesh = slab();
  const Points truth = bent(mesh.points);
  EXPECT_LT((carried(mesh.points, mesh.points, truth, 50) - truth).cwiseAbs().maxCoeff(), 1e-6);
  const ElementMesh fine = slab(37, 29, 5);
  EXPECT_LT((carried(fine.points, mesh.points, truth) - bent(fine.points)).colwise().norm().maxCoeff(), 1.5);
}

TEST(ThinPlateSpline, LeavesEachCentreOutForItsError)
{
  const ElementMesh mesh = slab();
  LandmarkPairs pairs = everyNth(mesh.points, bent(mesh.points), 31);
  pairs.target.col(4) += Eigen::Vector3d(0, 6, 0); // a mistake
  const std::vector<double> errors = leftOutErrors(pairs.source, pairs.target);
  ASSERT_EQ(Eigen::Index(errors.size()), pairs.source.cols());
  for (Eigen::Index i = 0; i < pairs.source.cols(); ++i)
  {
    std::vector<Eigen::Index> others;
    for (Eigen::Index j = 0; j < pairs.source.cols(); ++j)
    {
      if (j != i) others.push_back(j);
    }
    const ThinPlateSpline spline(pairs.source(Eigen::all, others), pairs.target(Eigen::all, others));
    const double expected = (spline(pairs.source.col(i)) - pairs.target.col(i)).norm();
    EXPECT_NEAR(errors[std::size_t(i)], expected, 1e-6 * (1 + expected)) << i;
  }
  EXPECT_EQ(std::max_element(errors.begin(), errors.end()) - errors.begin(), 4);
}

TEST(ThinPlateSpline, LeavesACentreThatTheOthersNeedUnknown)
{
  Points centres(3, 5); // four in a plane
  centres << 0, 1, 0, 1, 0.3, 0, 0, 1, 1, 0.4, 0, 0, 0, 0, 1;
  const std::vector<double> errors = leftOutErrors(centres, 2 * centres);
  EXPECT_TRUE(std::isinf(errors[4]));
  EXPECT_LT(errors[0], 1e-9);
}

TEST(Repair, MakesElementsValidAndLeavesTheOthersNearTheirPlace)
{
  const ElementMesh mesh = slab();
  EXPECT_EQ(repaired(mesh), mesh.points);
  ElementMesh tangled = mesh;
  const int node = 5 + 11 * (4 + 9);
  tangled.points.col(node) += Eigen::Vector3d(18, 12, 0);
  ASSERT_GT(invalidIn(mesh, tangled.points), 0u);
  const Points points = repaired(tangled);
  EXPECT_EQ(invalidIn(mesh, points), 0u);
  EXPECT_LT((points - tangled.points).col(0).norm(), 0.1); // a corner of the slab
}

/// A sheet 0.3 mm thin whose columns are `width` mm wide in the middle and many times that at the ends.
ElementMesh gradedSheet(double width)
{
  ElementMesh mesh = slab(16, 8, 1);
  for (Eigen::Index i = 0; i < mesh.points.cols(); ++i)
  {
    const double column = double(i % 17) - 8, row = double(i / 17 % 9) - 4;
    mesh.points.col(i) = Eigen::Vector3d(width * std::sinh(0.8 * column), 0.5 * row, i >= 17 * 9 ? 0.3 : 0);
  }
  return mesh;
}

/// Nodes of both sides pushed over their neighbours, as at the corner of an eye, where the skin itself is folded:
/// elements are wholly inside out, and their scaled Jacobians, at -1, have no slope.
TEST(Repair, UnfoldsWhatIsWhollyInsideOut)
{
  for (const double width : { 0.05, 0.01 })
  {
    const ElementMesh mesh = gradedSheet(width);
    for (const auto& [push, rows] :
         { std::pair{ 0.2, 1 }, std::pair{ 0.2, 2 }, std::pair{ 1.0, 1 }, std::pair{ 2.0, 4 } })
    {
      ElementMesh folded = mesh;
      for (int k = 0; k < rows; ++k)
      {
        for (const int layer : { 0, 1 }) folded.points(0, 8 + 17 * (3 + k + 9 * layer)) += push;
      }
      ASSERT_LT(validityOf(folded.elements, folded.points).minimum, -0.99);
      const Points points = repaired(folded);
      EXPECT_EQ(invalidIn(mesh, points), 0u) << width << " " << push << " " << rows;
      const Eigen::RowVectorXd distance = (points - folded.points).colwise().norm();
      EXPECT_LT(distance.maxCoeff(), push + 0.5);
      EXPECT_EQ(distance[0], 0); // far from all that
    }
  }
}

/// Two elements of the same nodes, one of them inside out, can't both be valid; what lies elsewhere is mended.
TEST(Repair, MendsWhatItCan)
{
  ElementMesh mesh = slab(20, 6, 1);
  Element turned = mesh.elements[0];
  for (int i = 0; i < 4; ++i) std::swap(turned.nodes[i], turned.nodes[i + 4]);
  mesh.elements.push_back(turned);
  ElementMesh tangled = mesh;
  tangled.points.col(17 + 21 * (3 + 7)) += Eigen::Vector3d(8, 12, 0);
  ASSERT_GT(invalidIn(mesh, tangled.points), 1u);
  EXPECT_EQ(invalidIn(mesh, repaired(tangled)), 1u);
}
