// SPDX-License-Identifier: Apache-2.0
// Rates and errors of a coupled mesh. usage: MultirateBenchmark PARENT.vtu CHILD.vtu [--rates]
// For each child: seconds to condense what is around it, milliseconds of a step with a tool at 1, 7 and 32 points and of
// any load; how far tool and weight leave the first child, linear and neo-Hookean, from the whole mesh solved at once,
// which takes a minute and --rates leaves out.

#include "Grasp.h"
#include "Replay.h"
#include "WholeSolution.h"

#include <cstdio>
#include <ctime>
#include <iostream>
#include <string>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

/// Of the processor: on one thread, those of a machine that does nothing else.
template <class F>
double secondsOf(const F& work)
{
  const std::clock_t start = std::clock();
  work();
  return double(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Of many calls.
template <class F>
double medianMilliseconds(const F& work)
{
  std::vector<double> times;
  for (int k = 0; k < 101; ++k) times.push_back(1e3 * secondsOf(work));
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

/// The inner point nearest to the child's centre.
Vec3 middleOf(const Part& child, const std::vector<std::int32_t>& interface)
{
  std::vector<bool> isShared(std::size_t(child.body.freePoints), false);
  for (const std::int32_t u : interface) isShared[std::size_t(u / 3)] = true;
  Vec3 centre{ 0, 0, 0 };
  for (const Vec3& point : child.body.mesh.points) centre += point / double(child.body.mesh.points.size());
  Vec3 best = child.body.mesh.points.front();
  for (std::size_t p = 0; p < child.body.mesh.points.size(); ++p)
  {
    const std::int32_t number = child.body.unknowns[p];
    if (number < 0 || isShared[std::size_t(number)]) continue;
    if (norm(child.body.mesh.points[p] - centre) < norm(best - centre)) best = child.body.mesh.points[p];
  }
  return best;
}

void printRates(const CoupledMesh& mesh, std::int32_t number)
{
  std::vector<bool> isChild(std::size_t(mesh.children) + 1, false), isAround(isChild.size(), true);
  isChild[std::size_t(number)] = true;
  isAround[std::size_t(number)] = false;
  Part child = partOf(mesh, isChild), around = partOf(mesh, isAround);
  const Interface interface = interfaceOf(child, around);
  std::unique_ptr<Surroundings> surroundings;
  std::unique_ptr<LinearChild> linear;
  const double condensing =
    secondsOf([&] { surroundings = std::make_unique<Surroundings>(std::move(around), interface.second); });
  const Eigen::VectorXd weight = weightOf(child.body, ReplayOptions{}.weight);
  const Vec3 middle = middleOf(child, interface.first);
  const double factorizing = secondsOf(
    [&] { linear = std::make_unique<LinearChild>(std::move(child), interface.first, surroundings->norton(), weight); });
  std::printf("child %d: %lld unknowns, %zu of the interface, condensing %.2f s, factor %.2f s\n", number,
              static_cast<long long>(linear->part().body.size()), interface.first.size(), condensing, factorizing);
  for (const std::size_t points : { 1, 7, 32 })
  {
    const Hold hold = holdNear(linear->part(), linear->atRest(), middle, 1e9, 1e9, points);
    const Grasp grasp(*linear, hold, 0.1);
    const double step = medianMilliseconds([&] { grasp.displacement(*linear, grasp.forces(*linear, { 1, 0, 0 })); });
    std::printf("  tool at %2zu points: %.3f ms, %.0f Hz\n", hold.size(), step, 1e3 / step);
  }
  const double any = medianMilliseconds([&] { linear->response(weight); });
  std::printf("  any load: %.2f ms, %.0f Hz\n", any, 1e3 / any);
}

void printErrors(const CoupledMesh& mesh, const Vec3& tip, ChildLaw law)
{
  ReplayOptions options;
  options.law = law;
  options.childRate = options.parentRate = 4;
  options.toolRadius = 0; // one point
  options.tolerance = 1e-9;
  const Vec3 motion{ 2, 1, 1.5 };
  ReplayResult result;
  const double coupled = secondsOf([&] { result = replay(mesh, { { { 0, 1 }, { tip, tip + motion } } }, options); });
  WholeSolution whole(mesh, options.weight, law == ChildLaw::NeoHookean ? 1 : 0);
  double error = 0;
  const double together = secondsOf(
    [&]
    {
      whole.solve({});
      const auto distance = [&](std::size_t p) { return norm(mesh.whole.mesh.points[p] + whole.at(p) - tip); };
      std::int32_t held = 0;
      for (std::size_t p = 0; p < mesh.whole.mesh.points.size(); ++p)
        if (distance(p) < distance(std::size_t(held))) held = std::int32_t(p);
      const Vec3 start = whole.at(std::size_t(held));
      for (const double share : { 0.25, 0.5, 0.75, 1.0 })
        whole.solve({ { held, options.toolStiffness, start + share * motion } });
      error = whole.errorOf(result.displacements, 1);
    });
  int iterations = 0;
  double largest = 0;
  for (const ReplayStep& step : result.steps)
  {
    iterations += step.iterations;
    largest = std::max(largest, step.largestDisplacement);
  }
  std::printf("%s: %zu steps, %d iterations, %.2f s; whole mesh %.2f s; largest displacement %.2f mm, relative "
              "difference %.1e\n",
              law == ChildLaw::Linear ? "linear" : "neo-Hookean", result.steps.size(), iterations, coupled, together,
              largest, error);
}

} // namespace

int main(int argc, char** argv)
{
  const bool onlyRates = argc == 4 && std::string(argv[3]) == "--rates";
  if (argc != 3 && !onlyRates)
  {
    std::cerr << "usage: MultirateBenchmark PARENT.vtu CHILD.vtu [--rates]\n";
    return 2;
  }
  try
  {
    const CoupledMesh mesh = coupledMesh(readMesh(argv[1]), readMesh(argv[2]), {});
    std::printf("whole: %zu tetrahedra, %lld unknowns\n", mesh.whole.mesh.tetrahedra.size(),
                static_cast<long long>(mesh.whole.size()));
    for (std::int32_t child = 1; child <= mesh.children; ++child) printRates(mesh, child);
    if (onlyRates) return 0;
    std::vector<bool> first(std::size_t(mesh.children) + 1, false), others(first.size(), true);
    first[1] = true;
    others[1] = false;
    const Part child = partOf(mesh, first);
    const Vec3 tip = middleOf(child, interfaceOf(child, partOf(mesh, others)).first);
    printErrors(mesh, tip, ChildLaw::Linear);
    printErrors(mesh, tip, ChildLaw::NeoHookean);
  }
  catch (const std::exception& error)
  {
    std::cerr << "MultirateBenchmark: " << error.what() << "\n";
    return 1;
  }
}
