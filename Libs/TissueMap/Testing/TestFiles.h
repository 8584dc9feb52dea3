// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Files for tests: a folder that goes away, and images written byte by byte, independently of the project's writers.

#include "Errors.h"
#include "Grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace surgicalmesher::test
{

/// A new folder, removed with everything in it.
class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    static int count = 0;
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    const std::string name =
      std::string("surgicalmesher-") + info->test_suite_name() + "-" + info->name() + "-" +
      std::to_string(std::hash<std::string>()(testing::TempDir() + std::to_string(++count)) % 100000);
    std::string safe = name;
    for (char& c : safe) c = c == '/' ? '-' : c;
    m_Path = std::filesystem::temp_directory_path() / safe;
    std::filesystem::remove_all(m_Path);
    std::filesystem::create_directories(m_Path);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(m_Path); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  void operator=(const TemporaryFolder&) = delete;

  std::string file(const std::string& name) const { return (m_Path / name).string(); }
  std::string write(const std::string& name, const std::string& content) const
  {
    std::ofstream(file(name), std::ios::binary) << content;
    return file(name);
  }
  /// Names of all files in it, hidden ones too, in order.
  std::vector<std::string> files() const
  {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(m_Path))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

private:
  std::filesystem::path m_Path;
};

inline std::string readBytes(const std::string& file)
{
  std::ifstream stream(file, std::ios::binary);
  return { std::istreambuf_iterator<char>(stream), {} };
}

template <typename T>
std::string bytes(const std::vector<T>& values)
{
  return { reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T) };
}

/// Header lines of an NRRD in LPS for this grid, whose axes may be left-handed.
inline std::string nrrdGeometry(const Grid& grid)
{
  std::ostringstream header;
  header.precision(17);
  const auto vector = [&](const Vec3& v) { header << "(" << v.x << "," << v.y << "," << v.z << ")"; };
  header << "dimension: 3\nspace: left-posterior-superior\nsizes: " << grid.size[0] << " " << grid.size[1] << " "
         << grid.size[2] << "\nspace directions:";
  for (int axis = 0; axis < 3; ++axis)
  {
    header << " ";
    vector(grid.spacing[axis] * grid.axes[axis]);
  }
  header << "\nspace origin: ";
  vector(grid.origin);
  header << "\n";
  return header.str();
}

/// An NRRD file with raw data; `type` is NRRD's name of T, `geometry` the header's lines on the grid, `more` other
/// ones.
template <typename T>
std::string nrrd(const std::string& type, const std::string& geometry, const std::vector<T>& values,
                 const std::string& more = "")
{
  return "NRRD0005\ntype: " + type + "\n" + geometry + "endian: little\nencoding: raw\n" + more + "\n" + bytes(values);
}

inline std::string cubeGeometry(int side)
{
  Grid grid;
  grid.size = { side, side, side };
  return nrrdGeometry(grid);
}

/// That `action` throws InputError with one line that begins with the file's name and holds `expected`.
template <typename Action>
void expectInputError(Action action, const std::string& file, const std::string& expected)
{
  try
  {
    action();
    ADD_FAILURE() << file << " is accepted";
  }
  catch (const InputError& error)
  {
    const std::string message = error.what();
    EXPECT_EQ(message.find(file), 0u) << message;
    EXPECT_NE(message.find(expected), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

} // namespace surgicalmesher::test
