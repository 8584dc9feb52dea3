// SPDX-License-Identifier: Apache-2.0
// Outputs appear whole or not at all, and leave no trace of an attempt.
#include "OutputFiles.h"
#include "Errors.h"
#include "Platform.h"

#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <set>
#ifndef _WIN32
#include <sys/resource.h>
#endif

namespace fs = std::filesystem;
using namespace surgicalmesher;

namespace
{

void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

std::string read(const fs::path& file)
{
  std::ifstream stream(file);
  return { std::istreambuf_iterator<char>(stream), {} };
}

class OutputFilesTest : public testing::Test
{
protected:
  void SetUp() override
  {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder =
      fs::temp_directory_path() / ("OutputFilesTest-" + std::string(test->name()) + "-" + std::to_string(processId()));
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  std::set<std::string> content() const
  {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
    return names;
  }

  fs::path folder;
};

using Names = std::set<std::string>;

} // namespace

TEST_F(OutputFilesTest, extensionsMayBeCompound)
{
  EXPECT_EQ(fullExtension("a.vtp"), ".vtp");
  EXPECT_EQ(fullExtension("/x.y/a.b.vtp"), ".vtp");
  EXPECT_EQ(fullExtension("a.nii.gz"), ".nii.gz");
  EXPECT_EQ(fullExtension("a.seg.nrrd"), ".seg.nrrd");
  EXPECT_EQ(fullExtension("a.mrk.json"), ".mrk.json");
  EXPECT_EQ(fullExtension("a"), "");
}

TEST_F(OutputFilesTest, areRenamedTogether)
{
  OutputFiles outputs;
  const fs::path first = outputs.temporary((folder / "a.nii.gz").string());
  const fs::path second = outputs.temporary((folder / "b").string());
  EXPECT_EQ(first.parent_path(), folder);
  EXPECT_EQ(fullExtension(first.string()), ".nii.gz");
  EXPECT_EQ(outputs.temporary((folder / "a.nii.gz").string()), first);
  write(first, "1");
  write(second, "2");
  EXPECT_FALSE(fs::exists(folder / "a.nii.gz"));
  outputs.commit();
  EXPECT_EQ(content(), (Names{ "a.nii.gz", "b" }));
  EXPECT_EQ(read(folder / "a.nii.gz"), "1");
}

TEST_F(OutputFilesTest, oneMayComeWithoutTheOthersOrNotAtAll)
{
  {
    OutputFiles outputs;
    const fs::path fault = outputs.temporary((folder / "fault").string());
    outputs.temporary((folder / "result").string());
    write(fault, "why");
    outputs.commit((folder / "fault").string());
    outputs.commit((folder / "neverAskedFor").string());
    EXPECT_THROW(outputs.commit((folder / "result").string()), EngineError) << "it was not written";
  }
  EXPECT_EQ(content(), Names{ "fault" });
  EXPECT_EQ(read(folder / "fault"), "why");
  OutputFiles outputs;
  write(outputs.temporary((folder / "result").string()), "all");
  outputs.temporary((folder / "fault").string());
  outputs.discard((folder / "fault").string());
  outputs.discard((folder / "neverAskedFor").string());
  outputs.commit();
  EXPECT_EQ(content(), (Names{ "fault", "result" }));
  EXPECT_EQ(read(folder / "fault"), "why") << "as it was";
}

#ifndef _WIN32
TEST_F(OutputFilesTest, oneThatIsInPlaceStaysWhenASignalEndsTheProcess)
{
  const auto endHalfWay = [&]
  {
    installSignalHandlers("program");
    OutputFiles outputs;
    const std::string early = (folder / "early.vtp").string();
    write(outputs.temporary(early), "x");
    write(outputs.temporary((folder / "late.vtp").string()), "x");
    outputs.commit(early);
    std::raise(SIGTERM);
  };
  EXPECT_EXIT(endHalfWay(), testing::KilledBySignal(SIGTERM), "^program: told to end, outputs that were complete stay");
  EXPECT_EQ(content(), Names{ "early.vtp" });
}
#endif

TEST_F(OutputFilesTest, leaveNothingWithoutCommit)
{
  {
    OutputFiles outputs;
    write(outputs.temporary((folder / "a.vtp").string()), "half");
  }
  EXPECT_EQ(content(), Names{});
}

TEST_F(OutputFilesTest, replaceAnOlderFileOnlyAtTheEnd)
{
  write(folder / "a.vtp", "old");
  {
    OutputFiles outputs;
    write(outputs.temporary((folder / "a.vtp").string()), "new");
    EXPECT_EQ(read(folder / "a.vtp"), "old");
  }
  EXPECT_EQ(read(folder / "a.vtp"), "old");
  OutputFiles outputs;
  write(outputs.temporary((folder / "a.vtp").string()), "new");
  outputs.commit();
  EXPECT_EQ(read(folder / "a.vtp"), "new");
}

TEST_F(OutputFilesTest, oneThatWasNotWrittenKeepsAllBack)
{
  {
    OutputFiles outputs;
    write(outputs.temporary((folder / "a.vtp").string()), "1");
    outputs.temporary((folder / "b.vtp").string());
    EXPECT_THROW(outputs.commit(), EngineError);
  }
  EXPECT_EQ(content(), Names{});
}

TEST_F(OutputFilesTest, oneThatCanNotBeRenamedTakesTheOthersBack)
{
  {
    OutputFiles outputs;
    write(outputs.temporary((folder / "a.vtp").string()), "1");
    write(outputs.temporary((folder / "b.vtp").string()), "2");
    fs::create_directories(folder / "b.vtp" / "in the way");
    EXPECT_THROW(outputs.commit(), InputError);
  }
  EXPECT_EQ(content(), Names{ "b.vtp" });
}

TEST_F(OutputFilesTest, oneThatCanNotBeRenamedLetsTheEarlierOnesComeBack)
{
  write(folder / "a.vtp", "old");
  {
    OutputFiles outputs;
    write(outputs.temporary((folder / "a.vtp").string()), "new");
    write(outputs.temporary((folder / "b.vtp").string()), "new");
    fs::create_directories(folder / "b.vtp" / "in the way");
    EXPECT_THROW(outputs.commit(), InputError);
  }
  EXPECT_EQ(content(), (Names{ "a.vtp", "b.vtp" }));
  EXPECT_EQ(read(folder / "a.vtp"), "old");
}

TEST_F(OutputFilesTest, severalReplaceEarlierOnesAndLeaveNoneOfThem)
{
  for (const char* text : { "old", "new" })
  {
    OutputFiles outputs;
    for (const char* name : { "a.vtp", "b.nii.gz" }) write(outputs.temporary((folder / name).string()), text);
    outputs.commit();
    EXPECT_EQ(content(), (Names{ "a.vtp", "b.nii.gz" }));
    EXPECT_EQ(read(folder / "a.vtp"), text);
  }
}

#ifndef _WIN32
TEST_F(OutputFilesTest, aFileThatCanNotBeWrittenIsCalledByItsName)
{
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit little{ 10, before.rlim_max };
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &little);
  std::string message;
  try
  {
    writeWhole(std::string(100, 'x'), (folder / "run.toml").string());
  }
  catch (const InputError& error)
  {
    message = error.what();
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(message.find((folder / "run.toml").string() + ": can't be written"), 0u) << message;
  EXPECT_EQ(content(), Names{});
}
#endif

TEST_F(OutputFilesTest, refuseImpossiblePlaces)
{
  OutputFiles outputs;
  EXPECT_THROW(outputs.temporary(folder.string()), InputError);
  EXPECT_THROW(outputs.temporary((folder / "missing" / "a.vtp").string()), InputError);
  write(folder / "file", "x");
  EXPECT_THROW(outputs.temporary((folder / "file" / "a.vtp").string()), InputError);
  EXPECT_EQ(content(), Names{ "file" });
}

#ifndef _WIN32
TEST_F(OutputFilesTest, refuseDevicesAndFoldersThatNobodyCanWriteTo)
{
  OutputFiles outputs;
  EXPECT_THROW(outputs.temporary("/dev/null"), InputError);
  EXPECT_THROW(outputs.temporary("/proc/a.vtp"), InputError);
}

TEST_F(OutputFilesTest, goThroughSymbolicLinks)
{
  fs::create_directories(folder / "elsewhere");
  fs::create_symlink(folder / "elsewhere" / "a.vtp", folder / "a.vtp");
  OutputFiles outputs;
  write(outputs.temporary((folder / "a.vtp").string()), "1");
  outputs.commit();
  EXPECT_TRUE(fs::is_symlink(folder / "a.vtp"));
  EXPECT_EQ(read(folder / "elsewhere" / "a.vtp"), "1");
}
#endif

TEST_F(OutputFilesTest, removeWhatKilledRunsLeftInTheFolderAndNothingElse)
{
  // No process can have this id: it is beyond what any kernel hands out.
  const std::string dead = hostName() + "-2147483646", alive = hostName() + "-" + std::to_string(processId());
  const Names kept{ ".a.vtp." + alive + ".partial.vtp.bak",
                    ".a.vtp.elsewhere-2147483646.partial.vtp",
                    ".a.vtp." + hostName() + "1-2147483646.partial.vtp", // of another namespace of processes
                    "b.vtp." + dead + ".partial.vtp",
                    ".a.vtp." + hostName() + "-1.partial.vtp",
                    ".a.vtp." + dead + ".partial.vtu" };
  for (const std::string& name : kept) write(folder / name, "x");
  write(folder / (".a.vtp." + dead + ".partial.vtp"), "x");
  write(folder / (".b.nii.gz." + dead + ".partial.nii.gz"), "x");
  {
    OutputFiles outputs;
    outputs.temporary((folder / "a.vtp").string());
  }
  EXPECT_EQ(content(), kept);
}
