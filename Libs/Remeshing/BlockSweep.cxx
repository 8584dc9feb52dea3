// SPDX-License-Identifier: Apache-2.0
#include "BlockSweep.h"

#include "Compaction.h"
#include "Grouped.h"
#include "Parallel.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <memory>
#include <mutex>
#include <numeric>

namespace surgicalmesher
{

namespace
{

using Centroid = std::array<float, 3>;

/// Returns the axes along which the mesh is cut, rotated differently in each round, so that vertices locked by the cuts
/// of one round are free in the next. With fixed axes, the medians would fall on the same planes again: locked vertices
/// are not coarsened, and so lie densest at the cuts.
std::array<Vec3, 3> frameOfRound(int round)
{
  const auto spread = [&](double step) { return 2 * (round * step - std::floor(round * step)) - 1; };
  const double a = spread(0.8191725), b = spread(0.6710436), c = spread(0.5497005);
  const double n = 1 + a * a + b * b + c * c; // of the quaternion (1, a, b, c)
  return { Vec3{ 1 + a * a - b * b - c * c, 2 * (a * b - c), 2 * (a * c + b) } / n,
           Vec3{ 2 * (a * b + c), 1 - a * a + b * b - c * c, 2 * (b * c - a) } / n,
           Vec3{ 2 * (a * c - b), 2 * (b * c + a), 1 - a * a - b * b + c * c } / n };
}

/// A k-d tree: recursive cuts in halves, each across the longest axis.
class Cuts
{
public:
  /// `sample`: a selection of the centroids, each of which represents a cost of `weight`. `most`: greatest cost of a
  /// block.
  Cuts(std::vector<Centroid> sample, double weight, std::size_t most) : m_Weight(weight), m_Most(most)
  {
    cut(sample.data(), sample.data() + sample.size());
  }

  std::int32_t blockCount() const { return m_Blocks; }

  std::int32_t blockOf(const Centroid& c) const
  {
    std::int32_t n = 0;
    while (m_Nodes[n].axis >= 0) n = c[m_Nodes[n].axis] < m_Nodes[n].at ? n + 1 : m_Nodes[n].next;
    return m_Nodes[n].next;
  }

private:
  struct Node
  {
    std::int32_t axis; ///< of the cut; -1: the node is a block
    float at;          ///< place of the cut; the subtree below it begins at the following node
    std::int32_t next; ///< node at which the subtree above the cut begins; for a block, its number
  };

  void cut(Centroid* begin, Centroid* end)
  {
    const std::size_t n = std::size_t(end - begin);
    const std::size_t node = m_Nodes.size();
    const int axis = n < 2 || m_Weight * double(n) <= double(m_Most) ? -1 : longestAxis(begin, end);
    m_Nodes.push_back({ axis, 0, axis < 0 ? m_Blocks : 0 });
    if (axis < 0)
    {
      ++m_Blocks;
      return;
    }
    Centroid* middle = begin + n / 2;
    std::nth_element(begin, middle, end, [&](const Centroid& a, const Centroid& b) { return a[axis] < b[axis]; });
    m_Nodes[node].at = (*middle)[axis];
    cut(begin, middle);
    m_Nodes[node].next = std::int32_t(m_Nodes.size());
    cut(middle, end);
  }

  static int longestAxis(const Centroid* begin, const Centroid* end)
  {
    Centroid low = *begin, high = low;
    for (const Centroid* c = begin; c != end; ++c)
      for (int k = 0; k < 3; ++k)
      {
        low[k] = std::min(low[k], (*c)[k]);
        high[k] = std::max(high[k], (*c)[k]);
      }
    int axis = 0;
    for (int k = 1; k < 3; ++k)
      if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
    return axis;
  }

  const double m_Weight;
  const std::size_t m_Most;
  std::vector<Node> m_Nodes;
  std::int32_t m_Blocks = 0;
};

/// The result of a block. Vertex ids below BlockedMesh::m_Known are those of the mesh; the block's new vertices follow.
struct BlockResult
{
  struct Moved
  {
    std::int32_t id;
    Vec3 position;
    float length;
  };
  std::vector<std::array<std::int32_t, 4>> tets, neighbours; ///< neighbours by their number in the block
  std::vector<Label> labels;
  std::vector<BackgroundMesh::Sample> samples;
  std::vector<Moved> moved; ///< points of the mesh; applied only when all blocks have succeeded
  std::vector<Vec3> newPoints;
  std::vector<float> newLengths;
};

class BlockedMesh
{
public:
  BlockedMesh(BackgroundMesh& background, int round, std::size_t most) : m_Background(background)
  {
    const auto& mesh = background.mesh;
    const std::array<Vec3, 3> frame = frameOfRound(round);
    std::vector<Centroid> centroids(mesh.tetrahedra.size());
    parallelFor(centroids.size(),
                [&](vtkIdType t)
                {
                  const auto& x = mesh.tetrahedra[t];
                  const Vec3 c = mesh.points[x[0]] + mesh.points[x[1]] + mesh.points[x[2]] + mesh.points[x[3]];
                  centroids[t] = { float(dot(frame[0], c)), float(dot(frame[1], c)), float(dot(frame[2], c)) };
                });
    divide(centroids, most);
    sortSamples();
    m_Results.resize(m_Blocks.groups());
  }

  /// Returns the blocks in the order of decreasing interface, which takes most of the time: a long block at the end
  /// would leave the other threads idle.
  std::vector<std::size_t> longestFirst() const
  {
    std::vector<std::size_t> order(m_Blocks.groups()), size(m_Blocks.groups());
    parallelForEach(size.size(), [&](std::size_t b) { size[b] = interfaceOf(b); });
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return size[a] > size[b]; });
    return order;
  }

  void run(std::size_t b, const std::function<void(TetComplex&)>& work)
  {
    std::vector<std::int32_t> globalIds;
    TetComplex complex = extract(b, globalIds);
    work(complex);
    collect(b, complex, globalIds);
  }

  void merge()
  {
    auto& mesh = m_Background.mesh;
    std::vector<Start> starts(m_Results.size() + 1);
    starts[0].point = mesh.points.size();
    for (std::size_t b = 0; b < m_Results.size(); ++b)
    {
      const BlockResult& r = m_Results[b];
      const Start& s = starts[b];
      starts[b + 1] = { s.point + r.newPoints.size(), s.tetrahedron + r.tets.size(), s.samples + r.samples.size() };
    }
    mesh.points.resize(starts.back().point);
    m_Background.lengths.resize(starts.back().point);
    mesh.tetrahedra.resize(starts.back().tetrahedron);
    mesh.labels.resize(starts.back().tetrahedron);
    m_Background.neighbours.resize(starts.back().tetrahedron);
    m_Background.samples.resize(starts.back().samples);
    parallelForEach(m_Results.size(), [&](vtkIdType b) { place(m_Results[b], starts[b]); });
    if (m_Results.size() > 1) matchOpenFaces(mesh.tetrahedra, mesh.points.size(), m_Background.neighbours);
    const std::vector<std::int32_t> used = compactPointsByUse(mesh.tetrahedra, mesh.points.size());
    mesh.points = valuesAt(mesh.points, used);
    m_Background.lengths = valuesAt(m_Background.lengths, used);
  }

private:
  struct Start ///< indices in the mesh at which the result of a block begins
  {
    std::size_t point = 0, tetrahedron = 0, samples = 0;
  };

  void place(BlockResult& r, const Start& start)
  {
    auto& mesh = m_Background.mesh;
    for (const auto& [id, position, length] : r.moved) // not on the border, so in no other block
    {
      mesh.points[id] = position;
      m_Background.lengths[id] = length;
    }
    std::copy(r.newPoints.begin(), r.newPoints.end(), mesh.points.begin() + start.point);
    std::copy(r.newLengths.begin(), r.newLengths.end(), m_Background.lengths.begin() + start.point);
    std::copy(r.labels.begin(), r.labels.end(), mesh.labels.begin() + start.tetrahedron);
    const std::int32_t shift = std::int32_t(start.point) - m_Known, first = std::int32_t(start.tetrahedron);
    for (std::size_t t = 0; t < r.tets.size(); ++t)
      for (int i = 0; i < 4; ++i)
      {
        const std::int32_t v = r.tets[t][i], n = r.neighbours[t][i];
        mesh.tetrahedra[first + t][i] = v < m_Known ? v : v + shift;
        m_Background.neighbours[first + t][i] = n < 0 ? -1 : n + first;
      }
    for (auto& e : r.samples) e.tetrahedron += first;
    std::copy(r.samples.begin(), r.samples.end(), m_Background.samples.begin() + start.samples);
    r = {};
  }

  /// Returns a measure of the interface in a block: the number of interface faces of every eighth tetrahedron, or the
  /// number of samples as long as neighbours are not known.
  std::size_t interfaceOf(std::size_t b) const
  {
    constexpr std::size_t stride = 8; // enough to tell blocks apart
    if (m_Background.neighbours.empty()) return m_Samples.size(b);
    const std::vector<Label>& labels = m_Background.mesh.labels;
    std::size_t faces = 0;
    for (std::size_t i = 0; i < m_Blocks.size(b); i += stride)
    {
      const std::int32_t t = m_Blocks.begin(b)[i];
      for (const std::int32_t n : m_Background.neighbours[t])
        if (n >= 0 && labels[n] != labels[t]) ++faces;
    }
    return faces;
  }

  void divide(const std::vector<Centroid>& centroids, std::size_t most)
  {
    constexpr std::size_t sampleSize = 100000; // places each cut to within a percent of a block
    const double stride = std::max(1.0, double(centroids.size()) / sampleSize);
    std::vector<Centroid> sample;
    double cost = 0;
    for (std::size_t t = 0; t < centroids.size(); ++t)
    {
      cost += m_Background.mesh.labels[t] == 0 ? backgroundCost : 1;
      if (cost < stride) continue;
      cost -= stride;
      sample.push_back(centroids[t]);
    }
    const Cuts cuts(std::move(sample), stride, most);
    m_BlockOf.resize(centroids.size());
    parallelFor(centroids.size(), [&](vtkIdType t) { m_BlockOf[t] = cuts.blockOf(centroids[t]); });
    const auto forEachOf = [&](std::size_t first, std::size_t last, auto&& visit)
    {
      for (std::size_t t = first; t < last; ++t) visit(std::size_t(m_BlockOf[t]), std::int32_t(t));
    };
    m_Blocks = Grouped<std::int32_t>(std::size_t(cuts.blockCount()), centroids.size(), forEachOf);
    m_LocalTet.resize(centroids.size());
    parallelForEach(m_Blocks.groups(),
                    [&](std::size_t b)
                    {
                      for (std::size_t n = 0; n < m_Blocks.size(b); ++n)
                        m_LocalTet[m_Blocks.begin(b)[n]] = std::int32_t(n);
                    });
  }

  void sortSamples()
  {
    const std::vector<BackgroundMesh::Sample>& samples = m_Background.samples;
    const auto forEachOf = [&](std::size_t first, std::size_t last, auto&& visit)
    {
      for (std::size_t e = first; e < last; ++e) visit(std::size_t(m_BlockOf[samples[e].tetrahedron]), std::int32_t(e));
    };
    m_Samples = Grouped<std::int32_t>(m_Blocks.groups(), samples.size(), forEachOf);
    m_Known = std::int32_t(m_Background.mesh.points.size());
  }

  TetComplex extract(std::size_t b, std::vector<std::int32_t>& globalIds)
  {
    const auto& mesh = m_Background.mesh;
    // Local number of each point of the mesh; all -1 between blocks. One array per thread, because it is as long as the
    // whole mesh has points.
    static thread_local std::vector<std::int32_t> local;
    if (local.size() < std::size_t(m_Known)) local.resize(m_Known, -1);
    const std::size_t size = m_Blocks.size(b);
    const bool knowsNeighbours = !m_Background.neighbours.empty();
    std::vector<TetComplex::Tet> tets, neighbours;
    std::vector<Label> labels;
    tets.reserve(size);
    labels.reserve(size);
    if (knowsNeighbours) neighbours.reserve(size);
    for (const std::int32_t* id = m_Blocks.begin(b); id != m_Blocks.end(b); ++id)
    {
      auto t = mesh.tetrahedra[*id];
      for (auto& v : t)
      {
        if (local[v] < 0)
        {
          local[v] = std::int32_t(globalIds.size());
          globalIds.push_back(v);
        }
        v = local[v];
      }
      tets.push_back(t);
      labels.push_back(mesh.labels[*id]);
      if (!knowsNeighbours) continue;
      auto across = m_Background.neighbours[*id];
      for (auto& n : across) n = n >= 0 && m_BlockOf[n] == std::int32_t(b) ? m_LocalTet[n] : -1;
      neighbours.push_back(across);
    }
    std::vector<Vec3> points;
    std::vector<float> lengths;
    for (std::int32_t v : globalIds)
    {
      points.push_back(mesh.points[v]);
      lengths.push_back(m_Background.lengths[v]);
      local[v] = -1;
    }
    TetComplex complex(std::move(points), std::move(lengths), std::move(tets), std::move(labels),
                       std::move(neighbours));
    complex.samples.reserve(m_Samples.size(b));
    for (const std::int32_t* s = m_Samples.begin(b); s != m_Samples.end(b); ++s)
    {
      const auto& e = m_Background.samples[*s];
      complex.addSample(m_LocalTet[e.tetrahedron], e.face, e.position, e.tolerance, e.normal);
    }
    return complex;
  }

  void collect(std::size_t b, const TetComplex& complex, const std::vector<std::int32_t>& globalIds)
  {
    BlockResult& r = m_Results[b];
    const std::int32_t own = std::int32_t(globalIds.size());
    std::vector<std::int32_t> ids(complex.points.size(), -1);
    std::copy(globalIds.begin(), globalIds.end(), ids.begin());
    for (std::int32_t v = 0; v < std::int32_t(complex.points.size()); ++v)
    {
      if (complex.vertexTet[v] < 0) continue;
      if (v < own)
      {
        if (!(complex.points[v] == m_Background.mesh.points[ids[v]]) ||
            complex.lengths[v] != m_Background.lengths[ids[v]])
          r.moved.push_back({ ids[v], complex.points[v], complex.lengths[v] });
        continue;
      }
      ids[v] = m_Known + std::int32_t(r.newPoints.size());
      r.newPoints.push_back(complex.points[v]);
      r.newLengths.push_back(complex.lengths[v]);
    }
    std::vector<std::int32_t> number(complex.tets.size(), -1);
    std::int32_t count = 0;
    for (std::int32_t t = 0; t < std::int32_t(complex.tets.size()); ++t)
      if (complex.alive(t)) number[t] = count++;
    r.tets.reserve(count);
    r.neighbours.reserve(count);
    r.labels.reserve(count);
    r.samples.reserve(complex.samples.size());
    for (std::int32_t t = 0; t < std::int32_t(complex.tets.size()); ++t)
    {
      if (!complex.alive(t)) continue;
      auto x = complex.tets[t], across = complex.neighbours[t];
      for (auto& v : x) v = ids[v];
      for (auto& n : across) n = n < 0 ? -1 : number[n];
      r.neighbours.push_back(across);
      for (std::int32_t i = 0; i < 4; ++i)
        for (std::int32_t e = complex.sampleHeads[t][i]; e >= 0; e = complex.samples[e].next)
        {
          const ListedSample& sample = complex.samples[e];
          r.samples.push_back({ sample, std::int32_t(r.tets.size()), i, complex.sampleNormal(e) });
        }
      r.tets.push_back(x);
      r.labels.push_back(complex.labels[t]);
    }
  }

  BackgroundMesh& m_Background;
  std::int32_t m_Known = 0;
  std::vector<std::int32_t> m_BlockOf, m_LocalTet; ///< of each tetrahedron: its block, and its number in that block
  Grouped<std::int32_t> m_Blocks;                  ///< tetrahedra, by block
  Grouped<std::int32_t> m_Samples;                 ///< samples, by block
  std::vector<BlockResult> m_Results;
};

} // namespace

std::size_t defaultBlockSize(const TetMesh& mesh)
{
  constexpr std::size_t usual = 65000, small = 16000;
  const auto outside = std::count(mesh.labels.begin(), mesh.labels.end(), 0);
  const double worth = double(mesh.labels.size()) - (1 - backgroundCost) * double(outside);
  return worth > usual ? usual : small;
}

void sweepBlocks(BackgroundMesh& background, int round, std::size_t tetrahedraPerBlock,
                 const std::function<void(TetComplex&)>& work, const Progress& progress)
{
  BlockedMesh blocked(background, round, std::max<std::size_t>(1, tetrahedraPerBlock));
  const std::vector<std::size_t> order = blocked.longestFirst();
  const std::size_t n = order.size();
  std::mutex mutex;
  std::exception_ptr failure; // an exception must not leave a worker thread
  std::atomic<std::size_t> begun{ 0 }, done{ 0 };
  parallelForEach(n,
                  [&](vtkIdType)
                  {
                    try
                    {
                      {
                        const std::lock_guard<std::mutex> lock(mutex);
                        if (failure) return;
                        report(progress, double(done) / double(n), "");
                      }
                      blocked.run(order[begun++], work); // in this order, whichever index the thread gets
                      ++done;
                    }
                    catch (...)
                    {
                      const std::lock_guard<std::mutex> lock(mutex);
                      if (!failure) failure = std::current_exception();
                    }
                  });
  if (failure) std::rethrow_exception(failure);
  blocked.merge();
}

} // namespace surgicalmesher
