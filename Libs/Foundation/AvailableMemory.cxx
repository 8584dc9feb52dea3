// SPDX-License-Identifier: Apache-2.0
#include "AvailableMemory.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <new>
#include <sstream>

namespace surgicalmesher
{
namespace
{

using Bytes = std::optional<std::uint64_t>;

/// The first number in a file, if it begins with one ("max" in a control group means none).
Bytes numberIn(const std::string& file)
{
  std::ifstream stream(file);
  std::uint64_t number = 0;
  return stream >> number ? Bytes(number) : Bytes();
}

/// The number on the line that begins with `name`, in a file of lines "name number".
Bytes numberAfter(const std::string& name, const std::string& file)
{
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);)
  {
    std::istringstream words(line);
    std::string word;
    std::uint64_t number = 0;
    if (words >> word && word == name && words >> number) return number;
  }
  return {};
}

Bytes least(const Bytes& a, const Bytes& b) { return !a ? b : !b ? a : std::min(*a, *b); }

std::uint64_t difference(std::uint64_t a, std::uint64_t b) { return a > b ? a - b : 0; }

/// Names of the files in a control group's folder, which depend on the version of control groups.
struct GroupFiles
{
  std::string limit, usage, inactive;
};

Bytes leftInGroup(const std::string& folder, const GroupFiles& files)
{
  const Bytes limit = numberIn(folder + "/" + files.limit);
  const Bytes usage = numberIn(folder + "/" + files.usage);
  if (!limit || !usage) return {};
  const std::uint64_t cached = numberAfter(files.inactive, folder + "/memory.stat").value_or(0);
  return difference(*limit, difference(*usage, cached));
}

/// The minimum of what a group and its ancestors leave. Inside a container, the group's path may be that of the host
/// and not exist; the folders above it then still hold the container's own limits.
Bytes leftInGroups(const std::string& mount, std::string path, const GroupFiles& files)
{
  Bytes result;
  while (!path.empty() && path != "/")
  {
    result = least(result, leftInGroup(mount + path, files));
    path.erase(path.rfind('/'));
  }
  return least(result, leftInGroup(mount, files));
}

/// Reads the lines of /proc/self/cgroup, hierarchy:controllers:path; the line of version 2 names no controllers.
Bytes leftByControlGroups(const std::string& root)
{
  std::ifstream stream(root + "/proc/self/cgroup");
  Bytes result;
  for (std::string line; std::getline(stream, line);)
  {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",",
                      path = line.substr(second + 1);
    if (path.empty() || path[0] != '/') continue;
    if (controllers == ",,")
      result =
        least(result, leftInGroups(root + "/sys/fs/cgroup", path, { "memory.max", "memory.current", "inactive_file" }));
    else if (controllers.find(",memory,") != std::string::npos)
      result = least(result, leftInGroups(root + "/sys/fs/cgroup/memory", path,
                                          { "memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file" }));
  }
  return result;
}

} // namespace

std::optional<std::uint64_t> availableMemory(const std::string& root)
{
  Bytes machine = numberAfter("MemAvailable:", root + "/proc/meminfo");
  if (machine) *machine *= 1024;
  return least(machine, leftByControlGroups(root));
}

void requireMemory(std::uint64_t bytes)
{
  void* volatile attempt = std::malloc(bytes); // volatile: otherwise a compiler may remove the unused allocation
  if (!attempt) throw std::bad_alloc();
  std::free(attempt);
}

} // namespace surgicalmesher
