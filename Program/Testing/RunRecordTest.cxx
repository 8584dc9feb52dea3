// SPDX-License-Identifier: Apache-2.0
// Which files decide whether a stage is run again.
#include "RunRecord.h"
#include "HeaderData.h"
#include "Platform.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace fs = std::filesystem;
using namespace surgicalmesher;

namespace
{

using Files = std::vector<std::string>;

class RunRecordTest : public testing::Test
{
protected:
  void SetUp() override
  {
    folder = fs::temp_directory_path() / ("RunRecordTest-" + std::to_string(processId()));
    fs::remove_all(folder);
    fs::create_directories(folder / "in");
    fs::create_directories(folder / "out");
  }
  void TearDown() override { fs::remove_all(folder); }

  std::string file(const std::string& name, const std::string& text) const
  {
    std::ofstream(folder / name) << text;
    return (folder / name).string();
  }
  std::string path(const std::string& name) const { return (folder / name).string(); }

  fs::path folder;
};

} // namespace

TEST_F(RunRecordTest, dataOfAHeaderAreWhatItNames)
{
  const std::string nrrd = "NRRD0005\ntype: uchar\n";
  EXPECT_EQ(dataFilesOf(file("in/a.nhdr", nrrd + "Data File: labels.raw\n")), Files{ path("in/labels.raw") });
  EXPECT_EQ(dataFilesOf(file("in/a.nhdr", nrrd + "datafile: /v/b c.raw\r\nencoding: raw\n")), Files{ "/v/b c.raw" });
  EXPECT_EQ(dataFilesOf(file("in/a.nhdr", nrrd + "data file: LIST\nx.raw\n../y.raw\n")),
            (Files{ path("in/x.raw"), path("y.raw") }));
  EXPECT_EQ(dataFilesOf(file("in/a.nhdr", nrrd + "data file: s%03d.raw 9 11 1\n")),
            (Files{ path("in/s009.raw"), path("in/s010.raw"), path("in/s011.raw") }));
  EXPECT_EQ(dataFilesOf(file("in/a.nhdr", nrrd + "data file: s%d 4 0 -2\n")),
            (Files{ path("in/s4"), path("in/s2"), path("in/s0") }));
  EXPECT_EQ(dataFilesOf(file("in/a.nrrd", nrrd + "\ndata file: not.a.field\n")), Files{});
  EXPECT_EQ(dataFilesOf(file("in/a.mhd", "NDims = 3\nElementDataFile = data/v.raw\n")), Files{ path("in/data/v.raw") });
  EXPECT_EQ(dataFilesOf(file("in/a.mhd", "NDims = 3\n\nElementDataFile: v.raw\n")), Files{ path("in/v.raw") });
  EXPECT_EQ(dataFilesOf(file("in/a.mha", "NDims = 3\nElementDataFile = LOCAL\nElementDataFile = x\n")), Files{});
  EXPECT_EQ(dataFilesOf(file("in/a.nii", "data file: x\n")), Files{});
  EXPECT_EQ(dataFilesOf(path("in/none.nhdr")), Files{});
}

TEST_F(RunRecordTest, otherDataMeanAnotherInput)
{
  for (const char* place : { "in", "out" })
  {
    const std::string map = file(std::string(place) + "/map.nhdr", "NRRD0005\ndata file: labels.raw\n");
    const Stage stage{ "scale", "program", { map }, { map }, {}, 1 };
    file(std::string(place) + "/labels.raw", "1");
    const StageRecord before = recordOf(stage, "program", path("out"));
    file(std::string(place) + "/labels.raw", "2");
    EXPECT_NE(recordOf(stage, "program", path("out")).inputs, before.inputs) << place;
  }
}

TEST_F(RunRecordTest, onlyFilesInTheFolderAreRecordedByTheirNames)
{
  const std::string out = path("out");
  const Stage stage{
    "scale", "program", { "--a=" + out + "/x", "--b=/mnt" + out + "/x", "--c=\"" + out + "/x,y\"", out + "/z" },
    {},      {},        1
  };
  EXPECT_EQ(recordOf(stage, "program", out).arguments, (Files{ "--a=x", "--b=/mnt" + out + "/x", "--c=\"x,y\"", "z" }));
}
