// SPDX-License-Identifier: Apache-2.0
// Prints how tissues classified from a few points agree with a known map.
//   TissueClassificationBenchmark TRUTH DRAWS POINTS [--correctBias] [--denoise] [--noCompartments] IMAGE...
// TRUTH has BrainWeb's labels of Colin27 (1 CSF ... 9 connective tissue) on the grid of the images. Every draw takes POINTS
// random voxels of each class as training points. Glial matter (8) is left out of the classes: no brightness of its
// own.

#include "TissueClassification.h"
#include "TissueMapIO.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <random>

using namespace surgicalmesher;

namespace
{

struct Score
{
  double right = 0; ///< share of the head's voxels
  std::vector<double> dice;
  double meanDice = 0;
};

const std::vector<std::pair<Label, std::string>> names{ { 1, "CSF" },          { 2, "grey matter" },
                                                        { 3, "white matter" }, { 4, "fat" },
                                                        { 5, "muscle" },       { 6, "skin" },
                                                        { 7, "skull" },        { 9, "connective tissue" } };

std::vector<TissueClass> drawClasses(const TissueMap& truth, int points, unsigned draw)
{
  std::mt19937 random(draw);
  std::vector<TissueClass> classes;
  for (const auto& [label, name] : names)
  {
    std::vector<std::size_t> voxels;
    for (std::size_t n = 0; n < truth.labels.size(); ++n)
    {
      if (truth.labels[n] == label) voxels.push_back(n);
    }
    TissueClass tissue;
    tissue.name = name;
    tissue.label = label;
    tissue.admission = usualAdmission(name);
    for (int n = 0; n < points; ++n)
    {
      const std::size_t voxel = voxels[random() % voxels.size()];
      const Grid& grid = truth.grid;
      const int i = int(voxel % grid.size[0]);
      const int j = int(voxel / grid.size[0] % grid.size[1]);
      const int k = int(voxel / (std::size_t(grid.size[0]) * grid.size[1]));
      tissue.points.push_back(grid.gridToWorld({ i * grid.spacing.x, j * grid.spacing.y, k * grid.spacing.z }));
    }
    classes.push_back(tissue);
  }
  return classes;
}

Score scoreOf(const TissueMap& found, const TissueMap& truth)
{
  Score score;
  std::size_t head = 0;
  std::size_t right = 0;
  for (std::size_t n = 0; n < truth.labels.size(); ++n)
  {
    head += truth.labels[n] != 0;
    right += truth.labels[n] != 0 && truth.labels[n] == found.labels[n];
  }
  score.right = double(right) / double(head);
  for (const auto& entry : names)
  {
    std::size_t a = 0, b = 0, both = 0;
    for (std::size_t n = 0; n < truth.labels.size(); ++n)
    {
      const bool isTrue = truth.labels[n] == entry.first;
      const bool isFound = found.labels[n] == entry.first;
      a += isTrue;
      b += isFound;
      both += isTrue && isFound;
    }
    score.dice.push_back(2.0 * double(both) / double(a + b));
    score.meanDice += score.dice.back() / double(names.size());
  }
  return score;
}

void run(const std::vector<std::string>& arguments)
{
  const TissueMap truth = readTissueMap(arguments.at(0));
  const int draws = std::stoi(arguments.at(1)), points = std::stoi(arguments.at(2));
  ClassificationOptions options;
  std::vector<ScalarImage> channels;
  for (std::size_t n = 3; n < arguments.size(); ++n)
  {
    if (arguments[n] == "--correctBias") options.correctBias = true;
    else if (arguments[n] == "--denoise") options.denoise = true;
    else if (arguments[n] == "--noCompartments") options.useCompartments = false;
    else channels.push_back(readImage(arguments[n]));
  }
  const HeadImages images = headImages(channels);
  for (int draw = 0; draw < draws; ++draw)
  {
    const auto begin = std::chrono::steady_clock::now();
    const Classification found = classifyTissues(images, drawClasses(truth, points, 101 + draw), options);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const Score score = scoreOf(found.map, truth);
    std::printf("draw %2d  right %.3f  mean Dice %.3f  (", draw + 1, score.right, score.meanDice);
    for (const double dice : score.dice) std::printf(" %.3f", dice);
    std::printf(" )  threshold of bone %.1f  %.0f s\n", found.boneThreshold, seconds);
    std::fflush(stdout);
  }
}

} // namespace

int main(int argc, char** argv)
{
  if (argc < 5)
    return std::fprintf(stderr, "TissueClassificationBenchmark TRUTH DRAWS POINTS [OPTION]... IMAGE...\n"), 2;
  try
  {
    run({ argv + 1, argv + argc });
  }
  catch (const std::exception& error)
  {
    return std::fprintf(stderr, "%s\n", error.what()), 1;
  }
  return 0;
}
