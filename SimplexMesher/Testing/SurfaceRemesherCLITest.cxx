// SPDX-License-Identifier: Apache-2.0
#include "ExecutableTest.h"
#include "MeshChecks.h"
#include "MeshIO.h"
#include "Shapes.h"

#include <rapidjson/document.h>

#include <algorithm>

using namespace surgicalmesher;
using namespace surgicalmesher::test;

namespace
{

class SurfaceRemesherCLI : public ExecutableTest
{
protected:
  SurfaceRemesherCLI() : ExecutableTest(SURFACEREMESHERCLI) {}

  void SetUp() override
  {
    SurfaceFile content;
    content.surface = sphere({ 4, -2, 9 }, 8, 3, 7);
    content.tissues[7].name = "ball";
    writeSurface(content, folder.file("ball.vtp"));
  }

  std::string writeObj(const std::string& name, const SurfaceComplex& surface) const
  {
    std::string text;
    for (const Vec3& p : surface.points)
      text += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
    for (const auto& [a, b, c] : surface.triangles)
      text += "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " + std::to_string(c + 1) + "\n";
    folder.write(name, text);
    return name;
  }
};

} // namespace

TEST_F(SurfaceRemesherCLI, WritesSurfaceAndReport)
{
  expectDone("--edgeLength 3 --report r.json ball.vtp s.vtp");
  const SurfaceFile result = readSurface(folder.file("s.vtp"));
  EXPECT_EQ(result.tissues.at(7).name, "ball");
  EXPECT_EQ(result.surface.labels.at(0), (std::array<Label, 2>{ 7, 0 }));
  EXPECT_EQ(result.targetEdgeLength.size(), result.surface.points.size());
  EXPECT_LT(result.surface.triangles.size(), 400u);
  for (const Vec3& p : result.surface.points) EXPECT_NEAR(norm(p - Vec3{ 4, -2, 9 }), 8, 0.5);
  rapidjson::Document report;
  report.Parse(readBytes(folder.file("r.json")).c_str());
  ASSERT_TRUE(report.IsObject());
  EXPECT_EQ(report["remeshed"]["triangles"].GetUint64(), result.surface.triangles.size());
  EXPECT_GE(report["remeshed"]["smallestAngle"].GetDouble(), 20);
  EXPECT_LE(report["toOriginal"]["maximum"].GetDouble(), 0.6);
  EXPECT_EQ(report["tissues"][0]["euler"].GetInt(), 2);
  EXPECT_NEAR(report["tissues"][0]["volume"].GetDouble() / report["tissues"][0]["volumeBefore"].GetDouble(), 1, 0.01);

  expectDone("s.vtp again.vtp"); // by its own TargetEdgeLength
  const std::size_t triangles = readSurface(folder.file("again.vtp")).surface.triangles.size();
  EXPECT_NEAR(double(triangles) / double(result.surface.triangles.size()), 1, 0.3);
}

TEST_F(SurfaceRemesherCLI, MakesTissuesOfTheShellsOfAnObj)
{
  SurfaceComplex shells = sphere({}, 10, 3);
  append(shells, sphere({ 1, 0, 0 }, 5, 3));
  writeObj("shells.obj", shells);
  expectDone("--chordError 0.2 --threads 1 shells.obj a.vtp");
  expectDone("--chordError 0.2 --threads 3 shells.obj b.vtp");
  EXPECT_EQ(readBytes(folder.file("a.vtp")), readBytes(folder.file("b.vtp")));
  const auto tissues = checkSurface(readSurface(folder.file("a.vtp")).surface);
  ASSERT_EQ(tissues.size(), 2u);
  for (const auto& [label, tissue] : tissues) EXPECT_TRUE(tissue.manifold()) << label;
}

TEST_F(SurfaceRemesherCLI, GivesTheSameBytesWithAnyNumberOfThreads)
{
  expectDone("--edgeLength 3 --threads 1 ball.vtp a.vtp");
  expectDone("--edgeLength 3 --threads 3 ball.vtp b.vtp");
  EXPECT_EQ(readBytes(folder.file("a.vtp")), readBytes(folder.file("b.vtp")));
}

TEST_F(SurfaceRemesherCLI, RefusesWhatIsNoClosedSurface)
{
  SurfaceComplex open = sphere({}, 8, 2);
  open.triangles.pop_back();
  expectRefused("--edgeLength 2 " + writeObj("open.obj", open) + " s.vtp", 1, "open.obj");
  SurfaceComplex thrice = sphere({}, 8, 2);
  thrice.points.push_back({ 20, 0, 0 });
  const auto [a, b, c] = thrice.triangles[0];
  thrice.triangles.push_back({ a, b, std::int32_t(thrice.points.size()) - 1 });
  expectRefused("--edgeLength 2 " + writeObj("thrice.obj", thrice) + " s.vtp", 1, "thrice.obj");
  SurfaceComplex crossing = sphere({}, 8, 2);
  append(crossing, sphere({ 6, 0, 0 }, 8, 2));
  expectRefused("--edgeLength 2 " + writeObj("crossing.obj", crossing) + " s.vtp", 1, "crossing.obj");
  folder.write("words.obj", "hello\n");
  expectRefused("--edgeLength 2 words.obj s.vtp", 1, "words.obj");
  expectRefused("--edgeLength 2 none.obj s.vtp", 1, "none.obj");
}

TEST_F(SurfaceRemesherCLI, RefusesLengthsThatAreNone)
{
  expectRefused("ball.vtp s.vtp", 2, "no --scale, neither --edgeLength nor --chordError above 0");
  expectRefused("--chordError 0 ball.vtp s.vtp", 2, "neither --edgeLength nor --chordError above 0");
  expectRefused("--chordError -1 ball.vtp s.vtp", 2, "chordError");
  expectRefused("--edgeLength 2 --scale scale.nrrd ball.vtp s.vtp", 2, "--scale and --edgeLength are both given");
  expectRefused("--edgeLength 2 ball.vtp s.stl", 2, "s.stl");
}
