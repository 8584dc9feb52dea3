// SPDX-License-Identifier: Apache-2.0
#include "EdgeSwaps.h"

#include "FaceAdjacency.h"

namespace surgicalmesher
{

namespace
{

class EdgeSwaps
{
public:
  EdgeSwaps(GuardedOperations& operations, const SwapOptions& options)
    : m_Operations(operations),
      m_Complex(operations.complex()), m_Goal{ sine2OfDegrees(options.goodAngle), usualSine, options.smoothness,
                                               leastGain, options.sparesWhole },
      m_Refusals(m_Complex.tets.size())
  {
  }

  void run()
  {
    const double mediocre = sine2OfDegrees(44); // around better tetrahedra there is little to gain
    for (std::int32_t t = 0; t < std::int32_t(m_Complex.tets.size()); ++t)
    {
      if (m_Complex.alive(t) && m_Operations.quality(t) < mediocre) swapEdgesOf(t);
      if (m_Complex.alive(t) && m_Complex.mayHaveInterface(t) && m_Goal.smoothness > 0) flipSheetsOf(t);
    }
  }

private:
  static constexpr double usualSine = 0.75; // 49 degrees; makes fewer tetrahedra count as a gain, like better ones
  static constexpr double leastGain = 0.03;

  bool swap(std::int32_t t, std::int32_t a, std::int32_t b)
  {
    return !(m_Complex.locked[a] && m_Complex.locked[b]) && m_Operations.swapEdge(a, b, t, m_Goal, &m_Refusals);
  }

  void swapEdgesOf(std::int32_t t)
  {
    const auto x = m_Complex.tets[t];
    for (const auto& e : kEdgeCorners)
      if (swap(t, x[e[0]], x[e[1]])) return;
  }

  void flipSheetsOf(std::int32_t t)
  {
    const auto x = m_Complex.tets[t];
    for (int i = 0; i < 4; ++i)
      if (m_Complex.isInterface(t, i) && m_Complex.labels[t] > m_Complex.labels[m_Complex.neighbours[t][i]])
        for (int k = 1; k < 4; ++k)
          if (swap(t, x[(i + k) & 3], x[(i + k % 3 + 1) & 3])) return;
  }

  GuardedOperations& m_Operations;
  const TetComplex& m_Complex;
  const GuardedOperations::SwapGoal m_Goal;
  SwapRefusals m_Refusals;
};

} // namespace

void swapEdgesOfBlock(GuardedOperations& operations, const SwapOptions& options)
{
  EdgeSwaps(operations, options).run();
}

} // namespace surgicalmesher
