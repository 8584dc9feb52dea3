// SPDX-License-Identifier: Apache-2.0
#include "AvailableMemory.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <new>

namespace fs = std::filesystem;
using surgicalmesher::availableMemory;

namespace
{

constexpr std::uint64_t MiB = 1024 * 1024;

/// A folder with the files that a system of the given state would show.
class AvailableMemory : public testing::Test
{
protected:
  AvailableMemory()
    : m_Root(fs::temp_directory_path() /
             ("memory-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name())))
  {
    fs::remove_all(m_Root);
    fs::create_directories(m_Root);
  }
  ~AvailableMemory() override { fs::remove_all(m_Root); }

  void write(const std::string& file, const std::string& text)
  {
    fs::create_directories((m_Root / file).parent_path());
    std::ofstream(m_Root / file) << text;
  }
  void writeMachine(std::uint64_t mebibytes)
  {
    write("proc/meminfo", "MemTotal:       99999999 kB\nMemFree:        1 kB\nMemAvailable:   " +
                            std::to_string(mebibytes * 1024) + " kB\nBuffers:        2 kB\n");
  }
  void writeGroup(const std::string& folder, const std::string& limit, std::uint64_t used, std::uint64_t inactive)
  {
    write("sys/fs/cgroup" + folder + "/memory.max", limit + "\n");
    write("sys/fs/cgroup" + folder + "/memory.current", std::to_string(used) + "\n");
    write("sys/fs/cgroup" + folder + "/memory.stat",
          "anon 5\ninactive_file " + std::to_string(inactive) + "\nslab 7\n");
  }
  std::optional<std::uint64_t> available() const { return availableMemory(m_Root.string()); }

private:
  fs::path m_Root;
};

TEST_F(AvailableMemory, IsUnknownWhereNothingTells) { EXPECT_FALSE(available()); }

TEST_F(AvailableMemory, IsThatOfTheMachineWithoutGroups)
{
  writeMachine(800);
  EXPECT_EQ(available(), 800 * MiB);
}

TEST_F(AvailableMemory, IsWhatTheGroupLeavesWithItsCaches)
{
  writeMachine(800);
  write("proc/self/cgroup", "0::/batch/job_7\n");
  writeGroup("/batch/job_7", std::to_string(500 * MiB), 300 * MiB, 50 * MiB);
  EXPECT_EQ(available(), 250 * MiB);
}

TEST_F(AvailableMemory, IsBoundedByEveryGroupAbove)
{
  writeMachine(800);
  write("proc/self/cgroup", "0::/batch/job_7\n");
  writeGroup("/batch/job_7", "max", 1, 0);
  writeGroup("/batch", std::to_string(100 * MiB), 40 * MiB, 0);
  EXPECT_EQ(available(), 60 * MiB);
}

TEST_F(AvailableMemory, IsFoundInAContainerThatDoesNotSeeItsPath)
{
  writeMachine(800);
  write("proc/self/cgroup", "0::/docker/0123\n");
  writeGroup("", std::to_string(200 * MiB), 20 * MiB, 0);
  EXPECT_EQ(available(), 180 * MiB);
}

TEST_F(AvailableMemory, IsReadFromGroupsOfVersionOne)
{
  writeMachine(800);
  write("proc/self/cgroup", "12:cpu,cpuacct:/x\n5:memory:/user\n");
  write("sys/fs/cgroup/memory/user/memory.limit_in_bytes", std::to_string(90 * MiB));
  write("sys/fs/cgroup/memory/user/memory.usage_in_bytes", std::to_string(30 * MiB));
  EXPECT_EQ(available(), 60 * MiB);
}

TEST_F(AvailableMemory, IsNothingInAGroupOverItsLimit)
{
  writeMachine(800);
  write("proc/self/cgroup", "0::/full\n");
  writeGroup("/full", std::to_string(10 * MiB), 11 * MiB, 0);
  EXPECT_EQ(available(), 0);
}

TEST(ThisMachine, HasMemoryIfItTells) { EXPECT_GT(availableMemory().value_or(std::uint64_t(1) << 40), 10 * MiB); }

} // namespace

TEST(RequiredMemory, whatCannotBeAllocatedIsAFailureOfItsOwn)
{
  EXPECT_NO_THROW(surgicalmesher::requireMemory(MiB));
#ifndef __SANITIZE_ADDRESS__ // which ends the process
  EXPECT_THROW(surgicalmesher::requireMemory(std::uint64_t(1) << 62), std::bad_alloc);
#endif
}
