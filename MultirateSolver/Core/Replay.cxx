// SPDX-License-Identifier: Apache-2.0
#include "Replay.h"

#include "AvailableMemory.h"
#include "Errors.h"
#include "NeoHookeanChild.h"
#include "Place.h"
#include "Text.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>

namespace surgicalmesher
{
namespace
{

constexpr std::size_t kMostHeldPoints = 32; ///< every step reads their columns of the inverse

class Stopwatch
{
public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - m_Start).count(); }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point m_Start = Clock::now();
};

/// A child, its surroundings, and the tool that holds it.
class Domain
{
public:
  Domain(const CoupledMesh& mesh, std::int32_t number, const ReplayOptions& options)
    : m_Number(number), m_Options(options)
  {
    std::vector<bool> isChild(std::size_t(mesh.children) + 1, false), isAround(isChild.size(), true);
    isChild[std::size_t(number)] = true;
    isAround[std::size_t(number)] = false;
    m_Child = partOf(mesh, isChild);
    Part around = partOf(mesh, isAround);
    const Interface interface = interfaceOf(m_Child, around);
    if (interface.first.empty())
      throw InputError("child " + std::to_string(number) + " shares no free point with what is around it");
    requireMemory(interface.first.size());
    m_Around = std::make_unique<Surroundings>(std::move(around), interface.second);
    m_AroundWeight = weightOf(m_Around->part().body, options.weight);
    m_Around->load(m_AroundWeight);
    const Eigen::VectorXd weight = weightOf(m_Child.body, options.weight);
    m_Interface = interface.first;
    m_Linear = std::make_unique<LinearChild>(m_Child, m_Interface, m_Around->norton(), weight);
    if (options.law == ChildLaw::NeoHookean)
    {
      m_NeoHookean = std::make_unique<NeoHookeanChild>(m_Child, m_Interface, m_Around->norton(), weight);
      m_NeoHookean->settle(options.tolerance);
    }
    m_Displacement = m_NeoHookean ? m_NeoHookean->displacement() : m_Linear->atRest();
  }

  bool hasTool() const { return m_Tool != nullptr; }

  /// As holdNear, in the child as it is now: at rest, when tools take hold.
  Hold holdAt(const Vec3& tip, double radius, double reach, std::size_t most) const
  {
    return holdNear(m_Child, m_Displacement, tip, radius, reach, most);
  }
  Vec3 pointNow(std::int32_t point) const { return displacedPoint(m_Child, m_Displacement, point); }

  void take(const ToolPath& tool, Hold hold)
  {
    m_Tool = &tool;
    m_Hold = std::move(hold);
    m_Start = m_Displacement(unknownsOf(m_Child.body, m_Hold));
    if (!m_NeoHookean) m_Grasp = std::make_unique<Grasp>(*m_Linear, m_Hold, m_Options.toolStiffness);
  }

  ReplayStep step(double seconds)
  {
    ReplayStep result;
    result.seconds = seconds;
    result.child = m_Number;
    result.tip = tipAt(*m_Tool, seconds);
    m_Motion = result.tip - m_Tool->tips.front();
    result.iterations = balance();
    result.force = totalOf(m_ToolForces);
    return result;
  }

  /// Adds the forces of the tools at other children to the load on the surroundings, and finds the child's equilibrium
  /// with it, so that the next child is loaded by the forces of this equilibrium.
  void loadByOthers(const std::vector<Domain>& domains)
  {
    Eigen::VectorXd forces = m_AroundWeight;
    bool isLoaded = false;
    for (const Domain& other : domains)
    {
      if (other.m_Number == m_Number || !other.hasTool() || other.m_ToolForces.size() == 0) continue;
      other.addToolForces(m_Around->part(), forces);
      isLoaded = true;
    }
    if (!isLoaded) return;
    m_Around->load(forces);
    m_Linear->setNortonForce(m_Around->norton().force);
    if (m_NeoHookean) m_NeoHookean->setNortonForce(m_Around->norton().force);
    if (hasTool())
    {
      balance();
      return;
    }
    if (m_NeoHookean) m_NeoHookean->settle(m_Options.tolerance);
    m_Displacement = m_NeoHookean ? m_NeoHookean->displacement() : m_Linear->atRest();
  }

  void addDisplacements(std::vector<Vec3>& whole) const { add(m_Child, m_Displacement, whole); }
  void addDisplacementsAround(std::vector<Vec3>& whole) const
  {
    add(m_Around->part(), m_Around->displacement(m_Displacement(m_Interface)), whole);
  }

  double largestDisplacement() const
  {
    return Eigen::Map<const Eigen::Matrix3Xd>(m_Displacement.data(), 3, m_Displacement.size() / 3)
      .colwise()
      .norm()
      .maxCoeff();
  }

  ReplaySizes::Child sizes() const
  {
    return { m_Child.body.size(), std::int64_t(m_Interface.size()), 3 * std::int64_t(m_Hold.size()),
             std::int64_t(m_Linear->factorEntries()) };
  }

private:
  /// Finds the equilibrium of the child with its tool; returns the iterations of Newton's method.
  int balance()
  {
    if (!m_NeoHookean)
    {
      m_ToolForces = m_Grasp->forces(*m_Linear, m_Motion);
      m_Displacement = m_Grasp->displacement(*m_Linear, m_ToolForces);
      return 0;
    }
    const Eigen::VectorXd pull =
      m_Start + Eigen::Vector3d(m_Motion.x, m_Motion.y, m_Motion.z).replicate(Eigen::Index(m_Hold.size()), 1);
    const int iterations = m_NeoHookean->settle(m_Hold, pull, m_Options.toolStiffness, m_Options.tolerance).iterations;
    m_Displacement = m_NeoHookean->displacement();
    m_ToolForces = m_NeoHookean->springForces(m_Hold, pull, m_Options.toolStiffness);
    return iterations;
  }

  void addToolForces(const Part& around, Eigen::VectorXd& forces) const
  {
    const Interface shared = interfaceOf(m_Child, around);
    Eigen::VectorXd own = Eigen::VectorXd::Zero(m_Child.body.size());
    own(unknownsOf(m_Child.body, m_Hold)) = m_ToolForces;
    forces(shared.second) += own(shared.first);
  }

  static void add(const Part& part, const Eigen::VectorXd& displacement, std::vector<Vec3>& whole)
  {
    for (std::size_t p = 0; p < part.points.size(); ++p)
    {
      const std::int32_t row = part.body.unknowns[p];
      if (row < 0) continue;
      for (int i = 0; i < 3; ++i) whole[std::size_t(part.points[p])][i] = displacement[3 * row + i];
    }
  }

  /// Memory for the dense matrix, its factor, and its entries in the child's matrix.
  static void requireMemory(std::size_t interface)
  {
    const double needed = 60.0 * double(interface) * double(interface);
    const std::optional<std::uint64_t> available = availableMemory();
    if (!available || needed <= double(*available)) return;
    throw InputError("an interface of " + std::to_string(interface) + " unknowns takes " +
                     text::rounded(needed / 1e9, 3) + " GB of memory, found " +
                     text::rounded(double(*available) / 1e9, 3) + " GB available, expected a smaller child");
  }

  std::int32_t m_Number;
  ReplayOptions m_Options;
  Part m_Child;
  std::vector<std::int32_t> m_Interface;
  std::unique_ptr<Surroundings> m_Around;
  Eigen::VectorXd m_AroundWeight;
  std::unique_ptr<LinearChild> m_Linear;
  std::unique_ptr<NeoHookeanChild> m_NeoHookean;
  const ToolPath* m_Tool = nullptr;
  Hold m_Hold;
  std::unique_ptr<Grasp> m_Grasp;
  Vec3 m_Motion{ 0, 0, 0 }; ///< mm, of the tool since it took hold
  Eigen::VectorXd m_Start, m_Displacement, m_ToolForces;
};

void checkOptions(const ReplayOptions& options)
{
  const double ratio = options.childRate / options.parentRate;
  if (!(options.parentRate > 0) || !(ratio >= 1) || std::abs(ratio - std::round(ratio)) > 1e-9 * ratio)
    throw UsageError("rates of " + text::rounded(options.childRate) + " and " + text::rounded(options.parentRate) +
                     " per second, expected the child's to be a multiple of the parent's");
  if (!(options.toolStiffness > 0)) throw UsageError("the tool's stiffness has to be over 0");
}

/// Assigns the tool to the nearest child.
void takeHold(std::vector<Domain>& domains, const ToolPath& tool, std::size_t number, const ReplayOptions& options)
{
  const Vec3& tip = tool.tips.front();
  const std::string name = "tool " + std::to_string(number) + " at " + place(tip);
  Domain* nearest = nullptr;
  Hold best;
  double least = options.reach;
  for (Domain& domain : domains)
  {
    const Hold hold = domain.holdAt(tip, 0, least, 1);
    if (hold.empty()) continue;
    least = norm(domain.pointNow(hold.front()) - tip);
    nearest = &domain;
  }
  if (nearest == nullptr)
    throw InputError(name + " is not within " + text::rounded(options.reach) +
                     " mm of a child's free point, expected a path that begins at one");
  if (nearest->hasTool()) throw InputError(name + " is the second at one child, expected one tool each");
  nearest->take(tool, nearest->holdAt(tip, options.toolRadius, options.reach, kMostHeldPoints));
}

/// Lets the children feel one another's tools. They are treated one after another, each with the newest forces of the
/// others: this is block Gauss-Seidel, which converges from exchange to exchange for every elastic body; with the old
/// forces of all others (block Jacobi), three tools need not. The first child comes after all others that have tools,
/// and those without a tool come last, so that the displacements around the first child fit the newest forces.
void exchange(std::vector<Domain>& domains)
{
  for (const bool hasTool : { true, false })
    for (auto domain = domains.rbegin(); domain != domains.rend(); ++domain)
      if (domain->hasTool() == hasTool) domain->loadByOthers(domains);
}

std::vector<Vec3> displacementsOf(const CoupledMesh& mesh, const std::vector<Domain>& domains)
{
  std::vector<Vec3> whole(mesh.whole.mesh.points.size(), Vec3{ 0, 0, 0 });
  domains.front().addDisplacementsAround(whole);
  // Where children touch, the displacement of a child with a tool takes precedence.
  for (const bool hasTool : { false, true })
    for (const Domain& domain : domains)
      if (domain.hasTool() == hasTool) domain.addDisplacements(whole);
  return whole;
}

/// Returns the times of the first and the last position of any tool: a recorder's clock need not start at 0.
std::array<double, 2> spanOf(const std::vector<ToolPath>& tools)
{
  if (tools.empty()) return {};
  std::array<double, 2> span{ tools.front().seconds.front(), tools.front().seconds.back() };
  for (const ToolPath& tool : tools)
  {
    span[0] = std::min(span[0], tool.seconds.front());
    span[1] = std::max(span[1], tool.seconds.back());
  }
  return span;
}

/// Returns the number of steps after the first one.
std::int64_t stepsIn(const std::array<double, 2>& span, double rate)
{
  constexpr double most = 1e7; // more are a mistake in the unit of time, and would not fit into memory
  const double seconds = span[1] - span[0];
  // Times far from zero have lost their last digits.
  const double lost = 4 * std::numeric_limits<double>::epsilon() * std::max(std::abs(span[0]), std::abs(span[1]));
  const double steps = std::floor((seconds + lost) * rate + 1e-6);
  if (steps <= most) return std::int64_t(steps);
  throw InputError("the tools move for " + text::rounded(seconds) + " s, which is " + text::rounded(steps) +
                   " steps at " + text::rounded(rate) + " Hz, expected at most " + text::rounded(most) +
                   "; are their times in seconds?");
}

} // namespace

ReplayResult replay(const CoupledMesh& mesh, const std::vector<ToolPath>& tools, const ReplayOptions& options,
                    const FrameObserver& observer, const Progress& progress)
{
  checkOptions(options);
  const std::array<double, 2> span = spanOf(tools);
  const std::int64_t steps = stepsIn(span, options.childRate);
  ReplayResult result;
  const Stopwatch preparation;
  std::vector<Domain> domains;
  for (std::int32_t child = 1; child <= mesh.children; ++child)
  {
    report(progress, 0.5 * (child - 1) / mesh.children, "condensing what is around child " + std::to_string(child));
    domains.emplace_back(mesh, child, options);
  }
  for (std::size_t k = 0; k < tools.size(); ++k) takeHold(domains, tools[k], k + 1, options);
  result.times.preparation = preparation.seconds();
  result.sizes.wholeUnknowns = mesh.whole.size();
  for (const Domain& domain : domains) result.sizes.children.push_back(domain.sizes());

  const auto stepsBetween = std::int64_t(std::round(options.childRate / options.parentRate));
  for (std::int64_t k = 0; k <= steps; ++k)
  {
    const double seconds = span[0] + double(k) / options.childRate;
    for (Domain& domain : domains)
    {
      if (!domain.hasTool()) continue;
      const Stopwatch step;
      ReplayStep made = domain.step(seconds);
      result.times.steps.push_back(step.seconds());
      made.largestDisplacement = domain.largestDisplacement();
      result.steps.push_back(made);
    }
    if (k % stepsBetween != 0 && k != steps) continue;
    report(progress, 0.5 + 0.5 * double(k) / double(std::max<std::int64_t>(1, steps)), "stepping");
    const Stopwatch exchanging;
    exchange(domains);
    result.displacements = displacementsOf(mesh, domains);
    result.times.exchanges.push_back(exchanging.seconds());
    if (observer) observer(seconds, result.displacements);
  }
  return result;
}

} // namespace surgicalmesher
