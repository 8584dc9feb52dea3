#pragma once
/// The tetrahedra at a vertex, laid out so that several are measured at once wherever the vertex is put: guarded operations
/// spend more time on this than on anything else.

#include "TetComplex.h"

#include <array>
#include <vector>

namespace surgicalmesher
{

constexpr double backgroundLeniency = 20; ///< worst angles of 32 degrees inside weigh as 6.8 degrees outside

class StarQuality
{
public:
  /// `star`: the tetrahedra at v. Stays true until another vertex than v moves, or the star changes.
  void gather(const TetComplex& complex, std::int32_t v, const std::vector<std::int32_t>& star);

  /// The worst quality (see GuardedOperations) with the vertex at p, or some value below `atLeast` if it is less than that.
  /// Tetrahedra that contain the vertex `without` do not count.
  double worst(const Vec3& p, double atLeast, std::int32_t without = -1) const;

  /// The quality of each tetrahedron, in the order of the star, with the vertex at p. The result lives until the next call.
  const std::vector<double>& each(const Vec3& p);

  std::size_t size() const { return m_Size; }
  bool isBackground(std::size_t i) const { return m_Groups[i / lanes].weight[i % lanes] != 1; }

private:
  static constexpr std::size_t lanes = 4;
  struct Group
  {
    double corners[3][3][lanes]; ///< by corner and axis: with the vertex, a positively wound tetrahedron
    double ids[3][lanes];        ///< of the corners; as doubles they are compared in the same registers
    double weight[lanes];
  };
  static void measure(const Group& group, const Vec3& p, double* quality);

  std::vector<Group> m_Groups; ///< the last one filled up with its first tetrahedron
  std::vector<double> m_Each;
  std::size_t m_Size = 0;
};

} // namespace surgicalmesher
