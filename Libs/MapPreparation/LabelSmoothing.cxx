// SPDX-License-Identifier: Apache-2.0
#include "LabelSmoothing.h"

#include "BoundaryFaces.h"
#include "LocalTopology.h"
#include "Parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace surgicalmesher
{
namespace
{

constexpr int reach = 3;                          // of the Gaussian, voxels
constexpr double ofFine = 0.664, ofCoarse = 0.77; // factors of its standard deviation

/// Weights of a Gaussian along one axis, truncated at `reach`.
struct Kernel
{
  explicit Kernel(double sigma)
  {
    double sum = 0;
    for (int i = -reach; i <= reach; ++i) sum += weights[i + reach] = float(std::exp(-0.5 * i * i / (sigma * sigma)));
    for (float& w : weights) w /= float(sum);
  }
  std::array<float, 2 * reach + 1> weights{};
};

/// The smoothed indicators of the labels around a voxel. If there are more than 32 labels, the last ones share an
/// indicator.
class Indicators
{
public:
  Indicators(const PaddedMap& map, std::size_t voxel, const Kernel& kernel)
  {
    const std::ptrdiff_t dj = map.grid.size[0], dk = dj * map.grid.size[1];
    for (int k = -reach; k <= reach; ++k)
      for (int j = -reach; j <= reach; ++j)
        addRow(map.labels.data() + voxel + k * dk + j * dj, kernel,
               kernel.weights[k + reach] * kernel.weights[j + reach]);
  }

  /// The value by which labels compete. Where two tissues meet at the background, a share of a third can make the
  /// background the largest and dig a groove along their seam; so part of the share of all tissues except the largest
  /// is subtracted from its share. Subtracting all of it would leave no groove, but fill more of the map's own grooves
  /// than the tissues could compensate for on their other sides.
  float of(Label label) const
  {
    constexpr float part = 0.3F;
    return label == 0 ? shareOf(0) - part * shareOfLesserTissues() : shareOf(label);
  }

private:
  static constexpr int most = 32;

  void addRow(const Label* row, const Kernel& kernel, float weight)
  {
    for (int i = -reach; i <= reach; ++i)
    {
      if (m_Count == 0 || m_Labels[m_Last] != row[i])
      {
        m_Last = std::min(place(row[i]), most - 1);
        if (m_Last == m_Count) m_Labels[m_Count] = row[i], m_Shares[m_Count++] = 0;
      }
      m_Shares[m_Last] += weight * kernel.weights[i + reach];
    }
  }

  float shareOf(Label label) const
  {
    const int at = place(label);
    return at < m_Count ? m_Shares[at] : 0;
  }

  float shareOfLesserTissues() const
  {
    float sum = 0, largest = 0;
    for (int i = 0; i < m_Count; ++i)
      if (m_Labels[i] != 0) sum += m_Shares[i], largest = std::max(largest, m_Shares[i]);
    return sum - largest;
  }

  int place(Label label) const { return int(std::find(m_Labels, m_Labels + m_Count, label) - m_Labels); }

  Label m_Labels[most];
  float m_Shares[most];
  int m_Count = 0, m_Last = 0;
};

/// A voxel, and the differences between the smoothed indicators of the labels beside it (its rivals) and that of its
/// own label.
struct Candidate
{
  std::size_t voxel;
  Label own;
  std::array<Label, 6> labels{};
  std::array<float, 6> gains{};
  int count = 0;
  bool isRefused = false; ///< changeAlone() failed, and nothing around has changed since

  /// Adds a rival once, unless its gain is so low that no constant should make up for it.
  void add(Label label, float gain)
  {
    constexpr float hopeless = -0.3F;
    if (gain < hopeless || std::find(labels.begin(), labels.begin() + count, label) != labels.begin() + count) return;
    labels[count] = label;
    gains[count++] = gain;
  }
};

/// The data that balancing needs of a candidate with a single rival, as most have; compact, since they are read over
/// and over.
struct Bid
{
  Label own, rival;
  float gain;
};

struct Bidders
{
  std::vector<Bid> bids;
  std::vector<const Candidate*> others; ///< with several rivals
};

class LabelSmoother
{
public:
  LabelSmoother(PaddedMap& map, const ScaleField& scale, const LabelSmoothingOptions& options)
    : m_Map(map), m_Scale(scale), m_Options(options), m_Usual(options.sigma), m_Fine(ofFine * options.sigma),
      m_Coarse(ofCoarse * options.sigma), m_Around(neighbourSteps(map.grid)), m_Gained(largestLabel(map) + 1, 0),
      m_Constants(m_Gained.size(), 0)
  {
  }

  void run()
  {
    findCandidates();
    // Further rounds compensate for changes that topology refused.
    for (int round = 0; round < 3; ++round)
    {
      balance();
      change();
    }
  }

private:
  static std::size_t largestLabel(const PaddedMap& map)
  {
    return *std::max_element(map.labels.begin(), map.labels.end());
  }

  void findCandidates()
  {
    const int margin = m_Map.margin;
    std::vector<std::vector<Candidate>> slices(m_Map.grid.size[2] - 2 * margin);
    parallelForEach(slices.size(), [&](std::size_t k) { findInSlice(int(k) + margin, slices[k]); });
    std::size_t count = 0;
    for (const std::vector<Candidate>& slice : slices) count += slice.size();
    m_Candidates.reserve(count); // otherwise both the old and the grown array would take memory for a while
    for (const std::vector<Candidate>& slice : slices)
      m_Candidates.insert(m_Candidates.end(), slice.begin(), slice.end());
    findSlices();
  }

  void findSlices()
  {
    const std::size_t voxels = std::size_t(m_Map.grid.size[0]) * m_Map.grid.size[1];
    m_SliceBegins.assign(std::size_t(m_Map.grid.size[2]) + 1, 0);
    for (const Candidate& c : m_Candidates) ++m_SliceBegins[c.voxel / voxels + 1];
    std::partial_sum(m_SliceBegins.begin(), m_SliceBegins.end(), m_SliceBegins.begin());
  }

  void findInSlice(int k, std::vector<Candidate>& result) const
  {
    const auto& size = m_Map.grid.size;
    const auto consider = [&](std::size_t voxel)
    {
      if (!mayChange(voxel)) return;
      if (const Candidate c = candidate(voxel); c.count > 0) result.push_back(c);
    };
    for (int j = m_Map.margin; j < size[1] - m_Map.margin; ++j)
      forEachBoundaryVoxel(m_Map, j, k, m_Map.margin, size[0] - m_Map.margin, consider);
  }

  /// A voxel with five face neighbours of its own label is part of a flat wall, and stays.
  bool mayChange(std::size_t voxel) const
  {
    const Label own = m_Map.labels[voxel];
    int others = 0;
    for (const int face : sixNeighbours) others += m_Map.labels[voxel + m_Around[face]] != own;
    return others > 1 && m_Options.protectedLabels.count(own) == 0;
  }

  const Kernel& kernelAt(std::size_t voxel) const
  {
    const double voxels = m_Scale(m_Map.worldAt(voxel)) / m_Map.grid.smallestSpacing();
    return voxels < m_Options.fine ? m_Fine : voxels > m_Options.coarse ? m_Coarse : m_Usual;
  }

  Candidate candidate(std::size_t voxel) const
  {
    const Indicators indicators(m_Map, voxel, kernelAt(voxel));
    Candidate result{ voxel, m_Map.labels[voxel] };
    for (const int face : sixNeighbours)
    {
      const Label label = m_Map.labels[voxel + m_Around[face]];
      if (label == result.own || m_Options.protectedLabels.count(label)) continue;
      result.add(label, indicators.of(label) - indicators.of(result.own));
    }
    return result;
  }

  /// The difference between the smoothed indicators of a rival and of the candidate's own label, constants included.
  float gain(const Candidate& c, int rival) const
  {
    return c.gains[rival] + m_Constants[c.labels[rival]] - m_Constants[c.own];
  }

  /// The index of the rival that a candidate goes to; -1: none.
  int choice(const Candidate& c) const
  {
    int best = -1;
    float most = 0;
    for (int r = 0; r < c.count; ++r)
      if (const float g = gain(c, r); g > most) best = r, most = g;
    return best;
  }

  Bidders bidders() const
  {
    Bidders result;
    for (const Candidate& c : m_Candidates)
      if (c.count == 1) result.bids.push_back({ c.own, c.labels[0], c.gains[0] });
      else result.others.push_back(&c);
    return result;
  }

  /// Adds to `gained` the voxels that labels would gain by the choices of the bidders in part number `part` of `parts`.
  void addChoices(const Bidders& bidders, std::size_t part, std::size_t parts, std::vector<std::int32_t>& gained) const
  {
    const auto begin = [&](const auto& all) { return all.begin() + std::ptrdiff_t(part * all.size() / parts); };
    const auto end = [&](const auto& all) { return all.begin() + std::ptrdiff_t((part + 1) * all.size() / parts); };
    for (auto bid = begin(bidders.bids); bid != end(bidders.bids); ++bid)
      if (bid->gain + m_Constants[bid->rival] - m_Constants[bid->own] > 0) --gained[bid->own], ++gained[bid->rival];
    for (auto c = begin(bidders.others); c != end(bidders.others); ++c)
      if (const int r = choice(**c); r >= 0) --gained[(*c)->own], ++gained[(*c)->labels[r]];
  }

  /// m_Gained as it would be after the present choices of all bidders.
  std::vector<std::int32_t> gainedByChoices(const Bidders& bidders) const
  {
    constexpr std::size_t parts = 16;
    std::vector<std::vector<std::int32_t>> gained(parts, std::vector<std::int32_t>(m_Gained.size(), 0));
    parallelForEach(parts, [&](std::size_t part) { addChoices(bidders, part, parts, gained[part]); });
    std::vector<std::int32_t> sum = m_Gained;
    for (const std::vector<std::int32_t>& part : gained)
      for (std::size_t label = 0; label < sum.size(); ++label) sum[label] += part[label];
    return sum;
  }

  /// Finds the constants with which tissues keep their volumes; that of the background stays 0. Each constant moves by
  /// its own step, which grows while the tissue's error keeps its sign and halves when the sign changes (Riedmiller and
  /// Braun 1993): the number of voxels that a constant moves differs by orders of magnitude between tissues. A strand
  /// one voxel wide cannot gain voxels, as all voxels beside it are in walls; `most` is large enough for the strand not
  /// to lose any to a neighbour with a constant of its own, either.
  void balance()
  {
    constexpr int rounds = 60;
    constexpr float first = 0.05F, longest = 0.1F, most = 1.6F;
    const Bidders all = bidders();
    std::vector<float> steps(m_Constants.size(), first);
    std::vector<std::int32_t> before(m_Constants.size(), 0);
    for (int round = 0; round < rounds; ++round)
    {
      const std::vector<std::int32_t> gained = gainedByChoices(all);
      for (std::size_t label = 1; label < gained.size(); ++label)
      {
        if (gained[label] == 0) continue;
        const bool isLess = gained[label] < 0, wasLess = before[label] < 0;
        if (before[label] != 0)
          steps[label] = isLess == wasLess ? std::min(1.2F * steps[label], longest) : 0.5F * steps[label];
        m_Constants[label] = std::clamp(m_Constants[label] + (isLess ? steps[label] : -steps[label]), -most, most);
        before[label] = gained[label];
      }
    }
  }

  /// Applies the choices one by one, repeatedly, since every change may allow others; if no single change is possible,
  /// a voxel changes together with a neighbour. Afterwards, neither changed nor refused voxels are candidates.
  void change()
  {
    std::vector<Candidate*> left;
    for (Candidate& c : m_Candidates)
    {
      c.isRefused = false; // the constants, and so the candidate's choice, may have changed
      if (choice(c) >= 0) left.push_back(&c);
    }
    for (std::size_t before = 0; left.size() != before;)
    {
      before = left.size();
      const auto drop = [&](auto&& isDone)
      { left.erase(std::remove_if(left.begin(), left.end(), isDone), left.end()); };
      drop([&](Candidate* c) { return isChanged(*c) || (!c->isRefused && changeAlone(*c)); });
      if (left.size() == before) drop([&](const Candidate* c) { return isChanged(*c) || changeWithNeighbour(*c); });
    }
    const auto isSettled = [&](const Candidate& c) { return isChanged(c) || choice(c) >= 0; };
    m_Candidates.erase(std::remove_if(m_Candidates.begin(), m_Candidates.end(), isSettled), m_Candidates.end());
    findSlices();
  }

  void give(const Candidate& c, Label label)
  {
    m_Map.labels[c.voxel] = label;
    --m_Gained[c.own];
    ++m_Gained[label];
    tryAgainAround(c.voxel);
  }

  void tryAgainAround(std::size_t voxel)
  {
    for (std::size_t row = 0; row < m_Around.size(); row += 3) // each row has three voxels along i
    {
      const std::size_t last = voxel + m_Around[row + 2];
      for (auto at = firstFrom(voxel + m_Around[row]); at != m_Candidates.end() && at->voxel <= last; ++at)
        at->isRefused = false;
    }
  }

  bool isChanged(const Candidate& c) const { return m_Map.labels[c.voxel] != c.own; }

  bool changeAlone(Candidate& c)
  {
    const Label label = c.labels[choice(c)];
    c.isRefused = !keepsTopology(around(c.voxel), label);
    if (!c.isRefused) give(c, label);
    return !c.isRefused;
  }

  /// For a change that alone would leave a contact: makes it together with the cheapest change of a neighbour that
  /// removes the contact.
  bool changeWithNeighbour(const Candidate& c)
  {
    const Label label = c.labels[choice(c)];
    if (!isSimple(around(c.voxel), label)) return false;
    m_Map.labels[c.voxel] = label;
    float least = -0.3F; // the least gain allowed: that of moving a wall by a voxel
    const Candidate* partner = nullptr;
    Label to = 0;
    for (const std::ptrdiff_t step : m_Around)
    {
      const Candidate* const other = candidateAt(c.voxel + step);
      if (step == 0 || !other || isChanged(*other)) continue;
      for (int r = 0; r < other->count; ++r)
        if (gain(*other, r) > least && mendsContact(c.voxel, other->voxel, other->labels[r]))
          least = gain(*other, r), partner = other, to = other->labels[r];
    }
    m_Map.labels[c.voxel] = c.own;
    if (!partner) return false;
    give(c, label);
    give(*partner, to);
    return true;
  }

  /// Whether giving `label` to the neighbour is a simple change and leaves no contact at `voxel` and at the neighbour.
  bool mendsContact(std::size_t voxel, std::size_t neighbour, Label label)
  {
    if (!isSimple(around(neighbour), label)) return false;
    const Label before = std::exchange(m_Map.labels[neighbour], label);
    const int contacts = criticalBlocks(around(voxel)) + criticalBlocks(around(neighbour));
    m_Map.labels[neighbour] = before;
    return contacts == 0;
  }

  std::vector<Candidate>::iterator firstFrom(std::size_t voxel)
  {
    const std::size_t slice = voxel / (std::size_t(m_Map.grid.size[0]) * m_Map.grid.size[1]);
    const auto begin = m_Candidates.begin();
    return std::lower_bound(begin + m_SliceBegins[slice], begin + m_SliceBegins[slice + 1], voxel,
                            [](const Candidate& c, std::size_t v) { return c.voxel < v; });
  }

  Candidate* candidateAt(std::size_t voxel)
  {
    const auto at = firstFrom(voxel);
    return at != m_Candidates.end() && at->voxel == voxel ? &*at : nullptr;
  }

  Neighbourhood around(std::size_t voxel) const { return gather(m_Map, voxel, m_Around); }

  PaddedMap& m_Map;
  const ScaleField& m_Scale;
  const LabelSmoothingOptions& m_Options;
  const Kernel m_Usual, m_Fine, m_Coarse;
  const std::array<std::ptrdiff_t, 27> m_Around;
  std::vector<std::int32_t> m_Gained;        ///< number of voxels, by label
  std::vector<float> m_Constants;            ///< by label, added to its smoothed indicator
  std::vector<Candidate> m_Candidates;       ///< by voxel, ascending
  std::vector<std::ptrdiff_t> m_SliceBegins; ///< first candidate of each slice; the last entry is the end
};

} // namespace

SmoothedLabels smoothLabels(const TissueMap& map, const ScaleField& scale, const LabelSmoothingOptions& options)
{
  PaddedMap before, after;
  runInParallel({ [&] { before = padded(map, reach); }, [&] { after = padded(map, reach); } });
  LabelSmoother(after, scale, options).run();
  SmoothedLabels result;
  runInParallel({ [&] { result.changes = mapChanges(before, after); },
                  [&]
                  {
                    result.map = map;
                    copyWithoutMargin(after, result.map);
                  } });
  return result;
}

} // namespace surgicalmesher
