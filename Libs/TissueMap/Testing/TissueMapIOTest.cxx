// SPDX-License-Identifier: Apache-2.0
#include "TissueMapIO.h"
#include "ImageData.h"
#include "TestFiles.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <random>

#ifdef __unix__
#include <csignal>
#include <sys/resource.h>
#endif

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

constexpr char jhu189[] = "/usr/share/mricron/templates/jhu189.nii.gz";

/// An anisotropic map of random labels, no two layers alike.
TissueMap noisyMap()
{
  TissueMap map;
  map.grid.size = { 4, 5, 6 };
  map.grid.spacing = { 1, 1.5, 2.5 };
  map.grid.origin = { -20, 7, 3 };
  std::mt19937 random(7);
  for (std::size_t n = 0; n < map.grid.voxelCount(); ++n) map.labels.push_back(Label(random() % 9));
  return map;
}

/// Too large for one buffer of a library.
TissueMap largeMap()
{
  TissueMap map;
  map.grid.size = { 64, 64, 64 };
  std::mt19937 random(11);
  for (std::size_t n = 0; n < map.grid.voxelCount(); ++n) map.labels.push_back(Label(random() % 9));
  return map;
}

Vec3 rotated(const Vec3& v, const Vec3& unitAxis, double angle)
{
  return std::cos(angle) * v + std::sin(angle) * cross(unitAxis, v) +
         (1 - std::cos(angle)) * dot(unitAxis, v) * unitAxis;
}

Grid rotated(Grid grid, const Vec3& axis, double angle)
{
  const Vec3 unit = axis / norm(axis);
  for (Vec3& a : grid.axes) a = rotated(a, unit, angle);
  grid.origin = rotated(grid.origin, unit, angle);
  return grid;
}

/// The same voxels in space, stored with axis a of the file running along (or, flipped, against) axis source[a].
std::string stored(const TissueMap& map, const std::array<int, 3>& source, int flips)
{
  Grid grid;
  grid.origin = map.grid.origin;
  for (int a = 0; a < 3; ++a)
  {
    const int s = source[a];
    const bool isFlipped = flips >> a & 1;
    grid.size[a] = map.grid.size[s];
    grid.spacing[a] = map.grid.spacing[s];
    grid.axes[a] = (isFlipped ? -1.0 : 1.0) * map.grid.axes[s];
    if (isFlipped) grid.origin += (map.grid.size[s] - 1) * map.grid.spacing[s] * map.grid.axes[s];
  }
  std::vector<Label> labels;
  for (int k = 0; k < grid.size[2]; ++k)
  {
    for (int j = 0; j < grid.size[1]; ++j)
    {
      for (int i = 0; i < grid.size[0]; ++i)
      {
        const int position[3] = { i, j, k };
        std::array<int, 3> voxel;
        for (int a = 0; a < 3; ++a) voxel[source[a]] = flips >> a & 1 ? grid.size[a] - 1 - position[a] : position[a];
        labels.push_back(map.labels[map.grid.index(voxel[0], voxel[1], voxel[2])]);
      }
    }
  }
  return nrrd("uint16", nrrdGeometry(grid), labels);
}

/// All 48 ways to store a map.
void forEachCopy(const TissueMap& map, const std::function<void(const std::string& content)>& visit)
{
  std::array<int, 3> source{ 0, 1, 2 };
  do {
    for (int flips = 0; flips < 8; ++flips) visit(stored(map, source, flips));
  } while (std::next_permutation(source.begin(), source.end()));
}

void expectNear(const Vec3& a, const Vec3& b, double tolerance) { EXPECT_LT(norm(a - b), tolerance); }

void expectSameGrid(const Grid& a, const Grid& b, double tolerance = 1e-9)
{
  EXPECT_EQ(a.size, b.size);
  expectNear(a.spacing, b.spacing, tolerance);
  expectNear(a.origin, b.origin, tolerance);
  for (int axis = 0; axis < 3; ++axis) expectNear(a.axes[axis], b.axes[axis], tolerance);
}

template <typename T>
void expectSameLabelsAs(const TissueMap& map, const std::string& type)
{
  const TemporaryFolder folder;
  const std::vector<T> values(map.labels.begin(), map.labels.end());
  const std::string file = folder.write("map.nrrd", nrrd(type, nrrdGeometry(map.grid), values));
  EXPECT_EQ(readTissueMap(file).labels, map.labels) << type;
}

template <typename T>
void expectRefused(const std::string& type, T bad, const std::string& expected)
{
  const TemporaryFolder folder;
  std::vector<T> values(8, T(1));
  values[5] = bad;
  const std::string file = folder.write("map.nrrd", nrrd(type, cubeGeometry(2), values));
  expectInputError([&] { readTissueMap(file); }, file, expected);
}

void expectFileRefused(const std::string& name, const std::string& content, const std::string& expected)
{
  const TemporaryFolder folder;
  const std::string file = folder.write(name, content);
  expectInputError([&] { readTissueMap(file); }, file, expected);
}

/// A NIfTI-1 file of bytes; sform and qform may each be absent (code 0).
struct Nifti
{
  std::array<short, 8> dim{ 3, 2, 3, 4, 1, 1, 1, 1 };
  std::array<float, 3> pixdim{ 1, 1, 1 };
  short qformCode = 0;
  short sformCode = 0;
  std::array<float, 6> qform{}; ///< b, c, d of the quaternion, offset
  std::array<float, 12> srow{};
  float slope = 0;
  float intercept = 0;
  char units = 2;            // mm
  const char* magic = "n+1"; ///< "ni1": the header of a pair

  std::string content(std::size_t voxelBytes) const
  {
    std::string file(352, '\0');
    const auto put = [&](std::size_t at, const auto& value) { std::memcpy(&file[at], &value, sizeof(value)); };
    put(0, std::int32_t(348));
    put(40, dim);
    put(70, short(2)); // unsigned 8 bit
    put(72, short(8));
    put(76, 1.f);
    put(80, pixdim);
    put(108, 352.f);
    put(112, slope);
    put(116, intercept);
    put(123, units);
    put(252, qformCode);
    put(254, sformCode);
    put(256, qform);
    put(280, srow);
    std::memcpy(&file[344], magic, std::strlen(magic));
    for (std::size_t n = 0; n < voxelBytes; ++n) file += char(n % 3);
    return file;
  }
};

/// The header of a MetaImage of 2 x 2 x 2 voxels.
std::string metaImage(const std::string& type, const std::string& more, const std::string& dataFile)
{
  return "ObjectType = Image\nNDims = 3\n" + more + "ElementSpacing = 1 1 1\nDimSize = 2 2 2\nElementType = " + type +
         "\nElementDataFile = " + dataFile + "\n";
}

std::string replaced(std::string text, const std::string& from, const std::string& to)
{
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << text;
  return text.replace(std::min(at, text.size()), from.size(), to);
}

class EveryFormat : public testing::TestWithParam<const char*>
{
};

} // namespace

TEST(ReadTissueMap, BringsEveryStorageOrderToTheSameMap)
{
  const TissueMap map = noisyMap();
  const TemporaryFolder folder;
  forEachCopy(map,
              [&](const std::string& content)
              {
                const TissueMap copy = readTissueMap(folder.write("copy.nrrd", content));
                EXPECT_EQ(copy.labels, map.labels);
                expectSameGrid(copy.grid, map.grid);
              });
}

TEST(ReadTissueMap, BringsObliqueCopiesToOneMapEach)
{
  const double pi = std::acos(-1.0);
  const TemporaryFolder folder;
  // 45 degrees and a third of a turn about the diagonal: no axis is nearest, or another one is.
  const std::vector<std::pair<Vec3, double>> rotations{ { { 1, 2, 3 }, 0.3 },    { { 0, 0, 1 }, pi / 4 },
                                                        { { 1, 0, 1 }, pi / 4 }, { { 1, 1, 1 }, 2 * pi / 3 },
                                                        { { 1, 1, 1 }, pi / 3 }, { { 3, -1, 2 }, 2.5 },
                                                        { { 1, 0, 0 }, pi } };
  for (const auto& [axis, angle] : rotations)
  {
    TissueMap map = noisyMap();
    map.grid = rotated(map.grid, axis, angle);
    const TissueMap first = readTissueMap(folder.write("first.nrrd", stored(map, { 0, 1, 2 }, 0)));
    EXPECT_NEAR(dot(cross(first.grid.axes[0], first.grid.axes[1]), first.grid.axes[2]), 1, 1e-12);
    forEachCopy(map,
                [&](const std::string& content)
                {
                  const TissueMap copy = readTissueMap(folder.write("copy.nrrd", content));
                  EXPECT_EQ(copy.labels, first.labels);
                  expectSameGrid(copy.grid, first.grid);
                });
    if (angle == 0.3)
    {
      EXPECT_EQ(first.labels, map.labels); // a small turn keeps the order
    }
  }
}

TEST(ReadTissueMap, AcceptsEveryNumberType)
{
  const TissueMap map = noisyMap();
  expectSameLabelsAs<std::int8_t>(map, "int8");
  expectSameLabelsAs<std::uint8_t>(map, "uint8");
  expectSameLabelsAs<std::int16_t>(map, "int16");
  expectSameLabelsAs<std::uint16_t>(map, "uint16");
  expectSameLabelsAs<std::int32_t>(map, "int32");
  expectSameLabelsAs<std::uint32_t>(map, "uint32");
  expectSameLabelsAs<std::int64_t>(map, "int64");
  expectSameLabelsAs<std::uint64_t>(map, "uint64");
  expectSameLabelsAs<float>(map, "float");
  expectSameLabelsAs<double>(map, "double");
}

TEST(ReadTissueMap, RefusesValuesThatAreNoLabels)
{
  expectRefused<float>("float", 1.5f, "a voxel of value 1.5, expected labels: integers from 0 to 65535");
  expectRefused<double>("double", std::nan(""), "nan");
  expectRefused<float>("float", -HUGE_VALF, "-inf");
  expectRefused<std::int16_t>("int16", -3, "a voxel of value -3");
  expectRefused<std::int32_t>("int32", 65536, "a voxel of value 65536");
  expectRefused<std::uint64_t>("uint64", std::uint64_t(1) << 40, "expected labels");
}

TEST(ReadTissueMap, AcceptsTheLargestLabelAndATissueThatFillsTheGrid)
{
  const TemporaryFolder folder;
  const std::vector<std::uint16_t> full(8, 65535);
  const TissueMap map = readTissueMap(folder.write("map.nrrd", nrrd("uint16", cubeGeometry(2), full)));
  EXPECT_EQ(map.labels, full);
  EXPECT_EQ(presentLabels(map), std::vector<Label>{ 65535 });
}

TEST(ReadTissueMap, RefusesAnEmptyMap)
{
  expectFileRefused("map.nrrd", nrrd("uint8", cubeGeometry(2), std::vector<std::uint8_t>(8, 0)),
                    "no voxel but background");
}

TEST(ReadTissueMap, TakesFourDimensionsOnlyWithALastAxisOfOne)
{
  const std::string three =
    "space dimension: 3\nspace directions: (1,0,0) (0,1,0) (0,0,1) none\nspace origin: (0,0,0)\n";
  const std::vector<std::uint8_t> twice(16, 1);
  const std::string moving = "dimension: 4\nsizes: 2 2 2 2\nkinds: domain domain domain time\n";
  expectFileRefused("map.nrrd", nrrd("uint8", moving, twice), "an image of 4 dimensions (2 x 2 x 2 x 2), expected 3");

  const TemporaryFolder folder;
  Nifti nifti;
  nifti.dim = { 4, 2, 3, 4, 1, 1, 1, 1 };
  const TissueMap map = readTissueMap(folder.write("one.nii", nifti.content(24)));
  EXPECT_EQ(map.grid.size, (std::array<int, 3>{ 2, 3, 4 }));
  nifti.dim = { 4, 2, 3, 4, 2, 1, 1, 1 };
  expectFileRefused("two.nii", nifti.content(48), "dimensions");
}

TEST(ReadTissueMap, RefusesTwoDimensionsAndVectors)
{
  expectFileRefused("map.nrrd", nrrd("uint8", "dimension: 2\nsizes: 2 4\n", std::vector<std::uint8_t>(8, 1)),
                    "of 2 dimensions");
  const std::string vectors = "dimension: 4\nspace: left-posterior-superior\nsizes: 3 2 2 2\n"
                              "kinds: vector domain domain domain\n"
                              "space directions: none (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n";
  expectFileRefused("map.nrrd", nrrd("uint8", vectors, std::vector<std::uint8_t>(24, 1)),
                    "3 values per voxel, expected one label");
}

TEST(ReadTissueMap, RefusesGeometryThatIsNone)
{
  const auto geometry = [](const char* directions, const char* origin)
  {
    return std::string("dimension: 3\nspace: left-posterior-superior\nsizes: 2 2 2\nspace directions: ") + directions +
           "\nspace origin: " + origin + "\n";
  };
  const std::vector<std::uint8_t> ones(8, 1);
  expectFileRefused("map.nrrd", nrrd("uint8", geometry("(1,0,0) (0,0,0) (0,0,1)", "(0,0,0)"), ones), "");
  expectFileRefused("map.nrrd", nrrd("uint8", geometry("(1,0,0) (1,0,0) (0,0,1)", "(0,0,0)"), ones), "perpendicular");
  expectFileRefused("map.nrrd", nrrd("uint8", geometry("(1,0,0) (0.2,1,0) (0,0,1)", "(0,0,0)"), ones), "perpendicular");
  expectFileRefused("map.nrrd", nrrd("uint8", geometry("(1,0,0) (0,1,0) (0,0,1)", "(0,nan,0)"), ones), "");
}

TEST(ReadTissueMap, RefusesGridsThatAreTooLarge)
{
  const std::string sizes = "dimension: 3\nsizes: 2000000 2000000 2000000\n";
  expectFileRefused("map.nrrd", nrrd("uint8", sizes, std::vector<std::uint8_t>(8, 1)), "expected");
  Nifti nifti;
  nifti.dim = { 3, 32767, 32767, 32767, 1, 1, 1, 1 };
  expectFileRefused("map.nii", nifti.content(8), "expected 1 to 2^31 voxels");
  nifti.dim = { 3, 1290, 1290, 1290, 1, 1, 1, 1 };
  expectFileRefused("map.nii", nifti.content(8), "truncated");
}

TEST(ReadTissueMap, RefusesWhatIsNoImage)
{
  const TemporaryFolder folder;
  const std::string missing = folder.file("missing.nrrd");
  expectInputError([&] { readTissueMap(missing); }, missing, "no such file");
  const std::string directory = folder.file("");
  expectInputError([&] { readTissueMap(directory); }, directory, "is a folder");
  for (const char* name : { "text.nrrd", "text.nii", "text.nii.gz", "text.mha", "text.gipl", "text.txt", "text" })
  {
    expectFileRefused(name, "Once upon a time\nthere was a map.\n", "expected NRRD, NIfTI, MetaImage or GIPL");
    expectFileRefused(name, "", "expected NRRD, NIfTI, MetaImage or GIPL");
  }
}

TEST_P(EveryFormat, KeepsLabelsAndGrid)
{
  const TemporaryFolder folder;
  TissueMap map = noisyMap();
  const std::string file = folder.file(GetParam());
  writeTissueMap(map, file);
  const TissueMap copy = readTissueMap(file);
  EXPECT_EQ(copy.labels, map.labels);
  expectSameGrid(copy.grid, map.grid, 1e-5);
}

TEST_P(EveryFormat, RefusesEveryTruncation)
{
  const TemporaryFolder folder;
  TissueMap map = noisyMap();
  const std::string file = folder.file(GetParam());
  writeTissueMap(map, file);
  const std::string whole = readBytes(file);
  for (const std::size_t missing : { std::size_t(1), std::size_t(6), whole.size() / 10, whole.size() / 2 })
  {
    std::ofstream(file, std::ios::binary | std::ios::trunc) << whole.substr(0, whole.size() - missing);
    expectInputError([&] { readTissueMap(file); }, file, "");
  }
}

INSTANTIATE_TEST_SUITE_P(ReadTissueMap, EveryFormat,
                         testing::Values("map.nrrd", "map.nii", "map.nii.gz", "map.mha", "map.gipl", "map.gipl.gz"));

TEST(ReadTissueMap, FindsTheVoxelsOfADetachedHeaderAndMissesThemInTime)
{
  const TemporaryFolder folder;
  const TissueMap map = noisyMap();
  for (const auto& names : { std::pair("map.mhd", "map.zraw"), std::pair("map.nhdr", "map.raw.gz") })
  {
    const char *const header = names.first, *const data = names.second; // lambdas cannot have structured bindings
    writeTissueMap(map, folder.file(header));
    EXPECT_EQ(readTissueMap(folder.file(header)).labels, map.labels);
    const std::string whole = readBytes(folder.file(data));
    std::ofstream(folder.file(data), std::ios::binary | std::ios::trunc) << whole.substr(0, whole.size() / 2);
    expectInputError([&] { readTissueMap(folder.file(header)); }, folder.file(data), "truncated");
    std::filesystem::remove(folder.file(data));
    expectInputError([&] { readTissueMap(folder.file(header)); }, folder.file(header), "");
  }
}

TEST(ReadTissueMap, RefusesCompressedDataWithAWrongCheckSum)
{
  const TemporaryFolder folder;
  const std::string file = folder.file("map.nii.gz");
  writeTissueMap(largeMap(), file);
  std::string content = readBytes(file);
  content[content.size() - 7] = char(~content[content.size() - 7]);
  std::ofstream(file, std::ios::binary | std::ios::trunc) << content;
  expectInputError([&] { readTissueMap(file); }, file, "truncated or damaged");
}

TEST(ReadTissueMap, PlacesNiftiBySformBeforeQform)
{
  const TemporaryFolder folder;
  Nifti nifti;
  nifti.qformCode = 2; // identity, at the origin
  nifti.sformCode = 2;
  nifti.srow = { -2, 0, 0, 10, 0, 2, 0, -20, 0, 0, 2, -30 }; // RAS
  const TissueMap map = readTissueMap(folder.write("map.nii", nifti.content(24)));
  Grid expected;
  expected.size = { 2, 3, 4 };
  expected.spacing = { 2, 2, 2 };
  expected.origin = { -10, 20 - 2 * 2, -30 }; // the second axis runs anterior and is turned
  expectSameGrid(map.grid, expected);

  nifti.sformCode = 0;
  const TissueMap byQform = readTissueMap(folder.write("map.nii", nifti.content(24)));
  expectNear(byQform.grid.spacing, { 1, 1, 1 }, 1e-6);
}

TEST(ReadTissueMap, ReadsNiftiInMicrometres)
{
  const TemporaryFolder folder;
  Nifti nifti;
  nifti.sformCode = 1;
  nifti.srow = { -500, 0, 0, 0, 0, -500, 0, 0, 0, 0, 500, 3000 };
  nifti.pixdim = { 500, 500, 500 };
  nifti.units = 3;
  const TissueMap map = readTissueMap(folder.write("map.nii", nifti.content(24)));
  expectNear(map.grid.spacing, { 0.5, 0.5, 0.5 }, 1e-9);
  expectNear(map.grid.origin, { 0, 0, 3 }, 1e-9);

  nifti.sformCode = 0;
  nifti.qformCode = 1;
  nifti.qform = { 0, 0, 1, 2000, -1000, 3000 }; // RAS, half a turn about S
  const TissueMap byQform = readTissueMap(folder.write("map.nii", nifti.content(24)));
  expectNear(byQform.grid.spacing, { 0.5, 0.5, 0.5 }, 1e-9);
  expectNear(byQform.grid.origin, { -2, 1, 3 }, 1e-9);

  nifti.qformCode = 0; // its offset means nothing
  expectNear(readTissueMap(folder.write("map.nii", nifti.content(24))).grid.spacing, { 0.5, 0.5, 0.5 }, 1e-9);
  nifti.units = 2;
  nifti.pixdim = { 0.5, 0.5, 0.5 };
  const Vec3 inMm = readTissueMap(folder.write("mm.nii", nifti.content(24))).grid.origin;
  expectNear(readTissueMap(folder.file("map.nii")).grid.origin, inMm, 1e-9);
}

TEST(ReadTissueMap, PlacesNiftiByAllDigitsOfItsHeader)
{
  const TemporaryFolder folder;
  Nifti nifti;
  nifti.sformCode = 1;
  nifti.srow = { -1, 0, 0, 123456.78f, 0, -1, 0, 0, 0, 0, 1, 98765.43f };
  const auto origin = [&] { return readTissueMap(folder.write("map.nii", nifti.content(24))).grid.origin; };
  expectNear(origin(), { double(-123456.78f), 0, double(98765.43f) }, 1e-9);

  nifti.sformCode = 0;
  nifti.qformCode = 1;
  nifti.qform = { 0, 0, 1, 123456.78f, 0, 98765.43f }; // half a turn about S
  expectNear(origin(), { double(-123456.78f), 0, double(98765.43f) }, 1e-9);
}

TEST(ReadTissueMap, ReadsNiftiPairs)
{
  const TemporaryFolder folder;
  Nifti nifti;
  nifti.sformCode = 1;
  nifti.srow = { -1, 0, 0, 5, 0, -1, 0, 0, 0, 0, 1, 0 };
  const std::string whole = nifti.content(24);
  nifti.magic = "ni1";
  std::string header = nifti.content(0);
  std::memset(&header[108], 0, 4); // voxels begin with the other file
  folder.write("map.hdr", header.substr(0, 348));
  folder.write("map.img", whole.substr(352));
  const TissueMap expected = readTissueMap(folder.write("map.nii", whole));
  for (const char* name : { "map.hdr", "map.img" })
  {
    const TissueMap map = readTissueMap(folder.file(name));
    EXPECT_EQ(map.labels, expected.labels) << name;
    expectSameGrid(map.grid, expected.grid);
  }
}

TEST(ReadTissueMap, RefusesAnalyze)
{
  const TemporaryFolder folder;
  Nifti nifti;
  nifti.magic = "";
  const std::string header = folder.write("map.hdr", nifti.content(0).substr(0, 348));
  const std::string image = folder.write("map.img", std::string(24, '\1'));
  for (const std::string& file : { header, image })
    expectInputError([&] { readTissueMap(file); }, file, "an Analyze 7.5 image, which does not tell left from right");
}

TEST(ReadTissueMap, IgnoresANiftiHeaderThatAnotherFormatCarriesOn)
{
  const TemporaryFolder folder;
  const TissueMap map = noisyMap();
  const std::string file =
    folder.write("map.nrrd", nrrd("uint16", nrrdGeometry(map.grid), map.labels,
                                  "sform_code:=1\nsrow_x:=7 0 0 1\nsrow_y:=0 7 0 2\nsrow_z:=0 0 7 3\n"
                                  "bitpix:=64\nvox_offset:=352\n"));
  const TissueMap copy = readTissueMap(file);
  EXPECT_EQ(copy.labels, map.labels);
  expectSameGrid(copy.grid, map.grid);
}

TEST(ReadTissueMap, ReadsNrrdTextAndRefusesTruncatedRawAndText)
{
  const TemporaryFolder folder;
  const std::string header = "NRRD0005\ntype: float\n" + cubeGeometry(2) + "encoding: ascii\n\n";
  const std::string file = folder.write("map.nrrd", header + "0 1 2 3\n4 5 6 7\n");
  EXPECT_EQ(readTissueMap(file).labels, (std::vector<Label>{ 0, 1, 2, 3, 4, 5, 6, 7 }));
  expectFileRefused("map.nrrd", header + "0 1 2 3\n4 5 6\n", "");
  const std::string raw = nrrd("uint16", cubeGeometry(2), std::vector<Label>(8, 1));
  for (const std::size_t missing : { 1, 8 }) expectFileRefused("map.nrrd", raw.substr(0, raw.size() - missing), "");
}

TEST(ReadTissueMap, ReadsScaledNifti)
{
  const TemporaryFolder folder;
  Nifti nifti;
  nifti.sformCode = 1;
  nifti.srow = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0 };
  nifti.slope = 100;
  EXPECT_EQ(presentLabels(readTissueMap(folder.write("map.nii", nifti.content(24)))), (std::vector<Label>{ 100, 200 }));
}

TEST(ReadTissueMap, TakesNiftiOfSlopeZeroAsItIs)
{
  const TemporaryFolder folder;
  Nifti nifti;
  nifti.sformCode = 1;
  nifti.srow = { 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0 };
  nifti.intercept = 3;
  EXPECT_EQ(presentLabels(readTissueMap(folder.write("map.nii", nifti.content(24)))), (std::vector<Label>{ 1, 2 }));
  nifti.slope = 1;
  EXPECT_EQ(presentLabels(readTissueMap(folder.write("map.nii", nifti.content(24)))), (std::vector<Label>{ 3, 4, 5 }));
}

TEST(ReadTissueMap, ReadsMetaImagesOfTextWhole)
{
  const TemporaryFolder folder;
  const std::string text = "0 1 2 3\n4 5 6 7";
  for (const char* type : { "MET_UCHAR", "MET_INT", "MET_DOUBLE" })
  {
    for (const char* more : { "\n", "", " ", "\r\n" })
    {
      const std::string file = folder.write("map.mha", metaImage(type, "BinaryData = False\n", "LOCAL") + text + more);
      EXPECT_EQ(readTissueMap(file).labels, (std::vector<Label>{ 0, 1, 2, 3, 4, 5, 6, 7 })) << type;
    }
  }
  folder.write("map.txt", text);
  EXPECT_EQ(
    presentLabels(readTissueMap(folder.write("map.mhd", metaImage("MET_INT", "BinaryData = F\n", "map.txt")))).size(),
    7u);
}

TEST(ReadTissueMap, RefusesTextThatIsNotOneNumberPerVoxel)
{
  const std::string meta = metaImage("MET_UCHAR", "BinaryData = False\n", "LOCAL");
  const std::string nrrd = "NRRD0005\ntype: uint8\n" + cubeGeometry(2) + "encoding: text\n\n";
  for (const auto& header : { std::pair("map.mha", meta), std::pair("map.nrrd", nrrd) })
  {
    const std::string expected = "expected 8 numbers, one per voxel";
    expectFileRefused(header.first, header.second + "0 1 2 3\n4", "5 numbers, truncated, " + expected);
    expectFileRefused(header.first, header.second + "0 1 2 3 4 5 6 7 8", "9 numbers, " + expected);
    expectFileRefused(header.first, header.second + "0 1 x 3 4 5 6 7", "\"x\" among the voxels, " + expected);
    expectFileRefused(header.first, header.second + "0 1 2x 3 4 5 6 7", "\"2x\" among the voxels, " + expected);
    expectFileRefused(header.first, header.second + std::string(5000, '1'), "a word of 60 characters or more");
  }
}

TEST(ReadTissueMap, ReadsNrrdInTextAndHexHoweverSpelled)
{
  const TemporaryFolder folder;
  const std::vector<Label> expected{ 0, 1, 2, 3, 4, 5, 6, 7 };
  const std::string header = "NRRD0005\ntype: uint8\n" + cubeGeometry(2);
  const std::string commas = header + "encoding: ASCII\n\n0, 1, 2 ,3\n4 , 5 , 6 , 7\n";
  EXPECT_EQ(readTissueMap(folder.write("commas.nrrd", commas)).labels, expected);
  const std::string skips = header + "encoding: txt\nlineskip: 1\nbyte skip: 2\n\n9 9 9\n9 0 1 2 3 4 5 6 7\n";
  EXPECT_EQ(readTissueMap(folder.write("skips.nrrd", skips)).labels, expected);
  const std::string hex = header + "encoding: hex\n\n00010203\n04050607";
  EXPECT_EQ(readTissueMap(folder.write("hex.nrrd", hex)).labels, expected);
  expectFileRefused("hex.nrrd", hex.substr(0, hex.size() - 1), "truncated or damaged");
}

TEST(ReadTissueMap, FindsCompressedVoxelsHoweverTheHeaderIsSpelled)
{
  const TemporaryFolder folder;
  const TissueMap map = noisyMap();
  writeTissueMap(map, folder.file("map.nhdr"));
  const std::string header = readBytes(folder.file("map.nhdr")), data = readBytes(folder.file("map.raw.gz"));
  const std::string joined = replaced(header, "data file: map.raw.gz", "datafile: map.raw.gz");
  EXPECT_EQ(readTissueMap(folder.write("joined.nhdr", joined)).labels, map.labels);
  folder.write("line.gz", "a line to skip\n" + data);
  for (const char* key : { "line skip: 1", "lineskip: 1" })
  {
    const std::string skipping = replaced(header, "data file: map.raw.gz", std::string(key) + "\ndatafile: line.gz");
    EXPECT_EQ(readTissueMap(folder.write("line.nhdr", skipping)).labels, map.labels);
  }
  folder.write("line.gz", ("a line to skip\n" + data).substr(0, data.size()));
  expectInputError([&] { readTissueMap(folder.file("line.nhdr")); }, folder.file("line.gz"), "truncated");

  writeTissueMap(map, folder.file("map.mhd"));
  const std::string meta = readBytes(folder.file("map.mhd"));
  const std::string file = "ElementDataFile = map.zraw", yes = "CompressedData = True";
  for (const std::string& content : { replaced(meta, file, "\n" + file), replaced(meta, yes, "CompressedData = T"),
                                      replaced(meta, yes, "CompressedData = 1") })
    EXPECT_EQ(readTissueMap(folder.write("other.mhd", content)).labels, map.labels) << content;
}

TEST(ReadTissueMap, ScalesNrrdAndMetaImageToMm)
{
  TissueMap map = noisyMap();
  const TemporaryFolder folder;
  const auto gridOf = [&](const std::string& unit)
  {
    const std::string units = "space units: \"" + unit + "\" \"" + unit + "\" \"" + unit + "\"\n";
    const std::string content = nrrd("uint16", nrrdGeometry(map.grid), map.labels, units);
    return readTissueMap(folder.write("map.nrrd", content)).grid;
  };
  for (const auto& [unit, length] :
       { std::pair("mm", 1.), std::pair("cm", 10.), std::pair("m", 1000.), std::pair("um", 0.001),
         std::pair("microns", 0.001), std::pair("\xC2\xB5m", 0.001), std::pair("Millimeters", 1.), std::pair("", 1.) })
  {
    Grid expected = map.grid;
    expected.spacing = length * map.grid.spacing;
    expected.origin = length * map.grid.origin;
    expectSameGrid(gridOf(unit), expected);
  }
  const std::string cm = metaImage("MET_UCHAR", "DistanceUnits = cm\nOffset = 1 2 3\n", "LOCAL") + "12345678";
  const Grid grid = readTissueMap(folder.write("map.mha", cm)).grid;
  expectNear(grid.spacing, { 10, 10, 10 }, 1e-9);
  expectNear(grid.origin, { 10, 20, 30 }, 1e-9);
}

TEST(ReadTissueMap, RefusesOtherUnits)
{
  const std::vector<std::uint8_t> ones(8, 1);
  const std::string mixed = "space units: \"mm\" \"mm\" \"cm\"\n", inches = "space units: \"in\" \"in\" \"in\"\n";
  expectFileRefused("map.nrrd", nrrd("uint8", cubeGeometry(2), ones, mixed),
                    "space units is \"mm\" \"mm\" \"cm\", expected mm, cm, m or um, one for all axes");
  expectFileRefused("map.nrrd", nrrd("uint8", cubeGeometry(2), ones, inches), "expected mm, cm, m or um");
  expectFileRefused("map.mha", metaImage("MET_UCHAR", "DistanceUnits = inch\n", "LOCAL") + "12345678",
                    "DistanceUnits is inch, expected mm, cm, m or um");
}

TEST(ReadTissueMap, LaysJhu189IntoItsAtlasSpace)
{
  if (!std::filesystem::exists(jhu189)) GTEST_SKIP() << "mricron-data is not installed";
  const TissueMap map = readTissueMap(jhu189);
  EXPECT_EQ(presentLabels(map).size(), 189u);
  EXPECT_EQ(map.grid.size, (std::array<int, 3>{ 157, 189, 136 }));
  // The anterior commissure is the origin of the atlas: voxels around it are brain.
  const Vec3 index = map.grid.worldToGrid({ 0, 0, -10 });
  EXPECT_TRUE(map.grid.contains(int(index.x), int(index.y), int(index.z)));
}

TEST(Segmentation, KeepsNamesColoursAndLabelsOfASharedLayer)
{
  const TemporaryFolder folder;
  const std::string segments = "Segment0_ID:=Segment_1\nSegment0_Name:=optic nerve\nSegment0_Color:=1 0.5 0\n"
                               "Segment0_LabelValue:=4\nSegment0_Layer:=0\n"
                               "Segment1_ID:=Segment_2\nSegment1_Name:=bone\nSegment1_Color:=0.9 0.9 0.8\n"
                               "Segment1_LabelValue:=2\nSegment1_Layer:=0\n";
  const std::vector<std::uint8_t> values{ 0, 0, 4, 4, 2, 2, 2, 0 };
  const TissueMap map = readTissueMap(folder.write("a.seg.nrrd", nrrd("uint8", cubeGeometry(2), values, segments)));
  EXPECT_EQ(map.labels, std::vector<Label>(values.begin(), values.end()));
  ASSERT_EQ(map.table.size(), 2u);
  EXPECT_EQ(map.table.at(4).name, "optic nerve");
  EXPECT_EQ(map.table.at(4).color, (std::array<double, 3>{ 1, 0.5, 0 }));
  EXPECT_EQ(map.table.at(2).name, "bone");

  writeTissueMap(map, folder.file("b.seg.nrrd"));
  const TissueMap copy = readTissueMap(folder.file("b.seg.nrrd"));
  EXPECT_EQ(copy.labels, map.labels);
  EXPECT_EQ(copy.table.at(4).name, "optic nerve");
  EXPECT_EQ(copy.table.at(2).color, map.table.at(2).color);
}

TEST(Segmentation, MergesLayersAndLetsTheLaterSegmentWin)
{
  const TemporaryFolder folder;
  const std::string geometry =
    "dimension: 4\nspace: left-posterior-superior\nsizes: 2 2 2 1\nkinds: list domain domain domain\n"
    "space directions: none (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n";
  const auto segment = [](int n, int layer, int value)
  {
    const std::string prefix = "Segment" + std::to_string(n);
    return prefix + "_ID:=s" + std::to_string(n) + "\n" + prefix + "_Name:=s" + std::to_string(n) + "\n" + prefix +
           "_Layer:=" + std::to_string(layer) + "\n" + prefix + "_LabelValue:=" + std::to_string(value) + "\n";
  };
  const std::vector<std::uint8_t> layers{ 1, 0, 1, 1, 2, 1, 0, 0 }; // layer 0 and layer 1 of each of four voxels
  const std::string same = segment(0, 0, 1) + segment(1, 1, 1) + segment(2, 0, 2);
  const TissueMap map = readTissueMap(folder.write("a.seg.nrrd", nrrd("uint8", geometry, layers, same)));
  EXPECT_EQ(map.labels, (std::vector<Label>{ 1, 2, 3, 0 })); // value 1 is in both layers: numbered by the header
  EXPECT_EQ(map.table.at(3).name, "s2");

  const std::vector<std::uint8_t> distinct{ 1, 0, 1, 7, 2, 7, 0, 0 };
  const std::string unlike = segment(0, 0, 1) + segment(1, 1, 7) + segment(2, 0, 2);
  EXPECT_EQ(readTissueMap(folder.write("b.seg.nrrd", nrrd("uint8", geometry, distinct, unlike))).labels,
            (std::vector<Label>{ 1, 7, 2, 0 }));

  expectFileRefused("c.seg.nrrd", nrrd("uint8", geometry, distinct, same), "which no segment of the header has");
  expectFileRefused("d.seg.nrrd", nrrd("uint8", geometry, distinct, segment(0, 2, 1)), "Segment0_Layer");
}

TEST(WriteTissueMap, RefusesUnknownExtensionsAndMissingFolders)
{
  const TemporaryFolder folder;
  const TissueMap map = noisyMap();
  expectInputError([&] { writeTissueMap(map, folder.file("map.stl")); }, folder.file("map.stl"),
                   "expected the extension of");
  const std::string lost = folder.file("nowhere/map.nrrd");
  expectInputError([&] { writeTissueMap(map, lost); }, lost, "cannot be written");
}

#ifdef __unix__
TEST(WriteTissueMap, NoticesAFullDisk)
{
  const TemporaryFolder folder;
  rlimit before;
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{ 400, before.rlim_max }; // files may not grow beyond: the libraries see failing writes
  setrlimit(RLIMIT_FSIZE, &small);
  for (const char* name : { "map.nrrd", "map.nii", "map.nii.gz", "map.mha", "map.gipl" })
  {
    expectInputError([&] { writeTissueMap(largeMap(), folder.file(name)); }, folder.file(name), "cannot be written");
  }
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
}
#endif

TEST(Scale, SurvivesWritingAndReading)
{
  const TemporaryFolder folder;
  ScaleField scale;
  scale.grid = rotated(noisyMap().grid, { 1, 2, 3 }, 0.3);
  for (std::size_t n = 0; n < scale.grid.voxelCount(); ++n) scale.lengths.push_back(1 + 0.1f * float(n));
  writeScale(scale, folder.file("scale.nrrd"));
  const ScaleField copy = readScale(folder.file("scale.nrrd"));
  EXPECT_EQ(copy.lengths, scale.lengths);
  expectSameGrid(copy.grid, scale.grid);
}

TEST(Scale, RefusesLengthsThatAreNone)
{
  for (const float bad : { 0.f, -1.f, std::nanf(""), HUGE_VALF })
  {
    const TemporaryFolder folder;
    std::vector<float> lengths(8, 2.f);
    lengths[3] = bad;
    const std::string file = folder.write("scale.nrrd", nrrd("float", cubeGeometry(2), lengths));
    expectInputError([&] { readScale(file); }, file, "expected edge lengths of more than 0 mm");
  }
}

TEST(Scale, HasToCoverTheMap)
{
  ScaleField scale = uniformScale(1);
  scale.grid.size = { 10, 10, 10 };
  Grid map;
  map.size = { 20, 20, 20 };
  map.spacing = { 0.5, 0.5, 0.5 };
  map.origin = { -0.25, -0.25, -0.25 }; // outer faces coincide
  EXPECT_NO_THROW(requireCover(scale, map, "scale.nrrd"));
  map.origin.y = -0.3;
  expectInputError([&] { requireCover(scale, map, "scale.nrrd"); }, "scale.nrrd", "leaves out part of the label map");
  map = rotated(map, { 0, 0, 1 }, 0.5);
  expectInputError([&] { requireCover(scale, map, "scale.nrrd"); }, "scale.nrrd", "leaves out part of the label map");
}

// Trial, 3a: labels that arithmetic had left a little off were refused.
TEST(Trial, 3a_FloatsNearALabelAreThatLabel)
{
  const TemporaryFolder folder;
  const std::vector<float> near{ 0, 1.0000001f, 6.9999995f, 7.00009f, -0.00009f, 0, 0, 65535 };
  const TissueMap map = readTissueMap(folder.write("map.nrrd", nrrd("float", cubeGeometry(2), near)));
  EXPECT_EQ(map.labels, (std::vector<Label>{ 0, 1, 7, 7, 0, 0, 0, 65535 }));
  expectFileRefused("map.nrrd", nrrd("float", cubeGeometry(2), std::vector<float>(8, 6.9995f)),
                    "a voxel of value 6.99");
}

// Trial, 3a: the refusal of an affine registration's sform was ITK's own, without a way out.
TEST(Trial, 3a_ShearedPlacementsAreRefusedWithAWayOut)
{
  Nifti nifti;
  nifti.sformCode = 2;
  nifti.srow = { 1, 0.001f, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0 };
  expectFileRefused("map.nii", nifti.content(24), "not perpendicular to each other (by 0.057 degrees)");
  expectFileRefused("map.nii", nifti.content(24), "expected a grid without shear: resample the map");
  nifti.qformCode = 1;
  nifti.srow[1] = 0.1f;
  const TemporaryFolder folder;
  expectNear(readTissueMap(folder.write("map.nii", nifti.content(24))).grid.spacing, { 1, 1, 1 }, 1e-6); // the qform's
}

TEST(ReadTissueMap, FilesThatCanNotHoldWhatTheyPromiseAreAtFault)
{
  const TemporaryFolder folder;
  const std::string file = folder.write("map.nrrd", nrrd("float", cubeGeometry(2), std::vector<float>(8, 1.F)));
  requirePlausibleData(file, 32);
  expectInputError([&] { requirePlausibleData(file, std::uint64_t(1) << 34); }, file, "truncated");
}

TEST(ReadTissueMap, PlacesSmallVoxelsWhoseAnglesTheLibraryTakesForOblique)
{
  Nifti nifti;
  nifti.sformCode = 2;
  nifti.pixdim = { 0.05f, 0.05f, 0.05f };
  nifti.srow = { 0.04974147f,  -0.00182136f, 0.0047401f,   40,          0.00260684f, 0.04921251f,
                 -0.00844591f, -30,          -0.00435779f, 0.00864937f, 0.04905301f, 20 };
  const TemporaryFolder folder;
  const TissueMap bySform = readTissueMap(folder.write("map.nii", nifti.content(24)));
  expectNear(bySform.grid.spacing, { 0.05, 0.05, 0.05 }, 1e-6);
  nifti.qformCode = 1; // which ITK reads, and fileGrid() does not
  const TissueMap withQform = readTissueMap(folder.write("map.nii", nifti.content(24)));
  EXPECT_EQ(bySform.labels, withQform.labels);
  expectSameGrid(bySform.grid, withQform.grid);
}

TEST(ReadTissueMap, RefusesAnSformOfNoExtent)
{
  Nifti nifti;
  nifti.sformCode = 1;
  expectFileRefused("map.nii", nifti.content(24), "header");
}

TEST(ReadTissueMap, ReadsNiftiInMetresByEitherForm)
{
  Nifti nifti;
  nifti.sformCode = 1;
  nifti.srow = { -0.001f, 0, 0, 0, 0, -0.001f, 0, 0, 0, 0, 0.001f, 3 };
  nifti.pixdim = { 0.001f, 0.001f, 0.001f };
  nifti.units = 1;
  const TemporaryFolder folder;
  const TissueMap bySform = readTissueMap(folder.write("map.nii", nifti.content(24)));
  nifti.sformCode = 0;
  nifti.qformCode = 1;
  nifti.qform = { 0, 0, 1, 0, 0, 3 }; // RAS, half a turn about S
  const TissueMap byQform = readTissueMap(folder.write("map.nii", nifti.content(24)));
  for (const TissueMap* map : { &bySform, &byQform })
  {
    expectNear(map->grid.spacing, { 1, 1, 1 }, 1e-6);
    expectNear(map->grid.origin, { 0, 0, 3000 }, 1e-6);
    EXPECT_EQ(map->labels, bySform.labels);
  }
}

// B1: what is null displacement goes through files as a mark, not as a name.
TEST(Trial, B01_NullDisplacementGoesThroughMaps)
{
  TissueMap map = noisyMap();
  map.table[presentLabels(map).back()] = { "resting", {} };
  map.table[presentLabels(map).back()].isNullDisplacement = true;
  map.table[presentLabels(map).front()] = { "null displacement", {} };
  const TemporaryFolder folder;
  writeTissueMap(map, folder.file("map.nrrd"));
  const TissueMap copy = readTissueMap(folder.file("map.nrrd"));
  for (const auto& [label, tissue] : copy.table)
    EXPECT_EQ(tissue.isNullDisplacement, label == presentLabels(map).back()) << label;
}

// B14, found by CorruptedFilesFuzz: ITK's reader does not come back from such a header.
TEST(Trial, B14_MetaImagesWithoutDimensionsAreRefused)
{
  for (const char* number : { "-1", "0", "2147483648", "x" })
    expectFileRefused(
      "map.mha", std::string("ObjectType = Image\nNDims = ") + number + "\nDimSize = 2 2 2\nElementDataFile = LOCAL\n",
      std::string("NDims is \"") + number + "\", expected 3");
}

// B14, found by CorruptedFilesFuzz: ITK's readers end their process at such headers.
TEST(Trial, B14_HeadersThatCrashTheirReaderAreRefused)
{
  for (const char character : { '<', '{', '0' })
  {
    expectFileRefused("map.mha",
                      "ObjectType = Image\nNDims = 3\nDimSize = 2 2 2\n" + std::string(300, character) +
                        " = 1\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n12345678",
                      "header");
  }
  Nifti nifti;
  nifti.sformCode = 1;
  nifti.srow = { std::nanf(""), 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0 };
  expectFileRefused("map.nii", nifti.content(24), "header");
}

// B14, found by CorruptedFilesFuzz: ITK's reader asks for the memory that the header claims.
TEST(Trial, B14_CompressedSizesBeyondTheFileAreRefused)
{
  const std::string eightVoxels("\x78\x01\x01\x08\x00\xf7\xff"
                                "12345678\x07\x40\x01\xa5",
                                19); // as zlib stores them
  for (const char* size : { "42949672956", "1e308", "-1" })
    expectFileRefused("map.mha",
                      std::string("ObjectType = Image\nNDims = 3\nBinaryData = True\nCompressedData = True\n"
                                  "CompressedDataSize = ") +
                        size + "\nDimSize = 2 2 2\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n" + eightVoxels,
                      std::string("CompressedDataSize is \"") + size + "\", expected no more than");
}

TEST(Images, ComeBackAsTheyWereAndHaveNoHoles)
{
  const TemporaryFolder folder;
  ScalarImage image;
  image.grid = noisyMap().grid;
  for (std::size_t n = 0; n < image.grid.voxelCount(); ++n) image.values.push_back(0.25f * float(n) - 7);
  writeImage(image, folder.file("image.nrrd"));
  const ScalarImage read = readImage(folder.file("image.nrrd"));
  EXPECT_EQ(read.values, image.values);
  EXPECT_EQ(read.grid.size, image.grid.size);
  image.values[3] = std::numeric_limits<float>::infinity();
  folder.write("hole.nrrd", nrrd("float", nrrdGeometry(image.grid), image.values));
  expectInputError([&] { readImage(folder.file("hole.nrrd")); }, folder.file("hole.nrrd"), "a voxel of value inf");
}
