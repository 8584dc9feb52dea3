// SPDX-License-Identifier: Apache-2.0
#include "Landmarks.h"

#include "Errors.h"

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace surgicalmesher
{
namespace
{

std::map<std::string, Eigen::Index> byName(const NamedPoints& points)
{
  std::map<std::string, Eigen::Index> indices;
  for (std::size_t i = 0; i < points.names.size(); ++i)
  {
    if (!indices.emplace(points.names[i], Eigen::Index(i)).second)
      throw InputError(points.file + ": two landmarks \"" + points.names[i] + "\", expected different names");
  }
  return indices;
}

void requireNamesOf(const NamedPoints& these, const NamedPoints& in, const std::map<std::string, Eigen::Index>& present)
{
  for (const std::string& name : these.names)
  {
    if (present.count(name)) continue;
    throw InputError(in.file + ": no landmark \"" + name + "\" of " + these.file + ", expected the same names in both");
  }
}

double fitErrorOf(const Points& source, const Points& target)
{
  const Eigen::Affine3d fit(Eigen::umeyama(source, target, true));
  return std::sqrt((fit * source - target).colwise().squaredNorm().mean());
}

void requireSpread(const Points& points, const std::string& file)
{
  for (Eigen::Index i = 0; i < points.cols(); ++i)
  {
    for (Eigen::Index j = 0; j < i; ++j)
    {
      if (points.col(i) == points.col(j))
        throw InputError(file + ": two landmarks at one place, expected different places");
    }
  }
  const Points centred = points.colwise() - points.rowwise().mean();
  const Eigen::Vector3d sizes = Eigen::JacobiSVD<Eigen::MatrixXd>(centred).singularValues();
  const char* shape = sizes[1] < 0.01 * sizes[0] ? "line" : sizes[2] < 0.01 * sizes[0] ? "plane" : nullptr;
  if (!shape) return;
  throw InputError(file + ": all landmarks lie in one " + shape + ", expected four that don't lie in a plane");
}

} // namespace

LandmarkPairs pairedByName(const NamedPoints& source, const NamedPoints& target)
{
  const auto inSource = byName(source), inTarget = byName(target);
  requireNamesOf(source, target, inTarget);
  requireNamesOf(target, source, inSource);
  LandmarkPairs pairs{ source.names, source.points, Points(3, source.points.cols()) };
  for (std::size_t i = 0; i < pairs.names.size(); ++i)
    pairs.target.col(Eigen::Index(i)) = target.points.col(inTarget.at(pairs.names[i]));
  return pairs;
}

Eigen::Affine3d similarityOf(const LandmarkPairs& pairs)
{
  return Eigen::Affine3d(Eigen::umeyama(pairs.source, pairs.target, true));
}

void requireUsable(const LandmarkPairs& pairs, const std::string& sourceFile, const std::string& targetFile)
{
  const std::string files = sourceFile + " and " + targetFile + ": ";
  if (pairs.source.cols() < 4)
    throw InputError(files + std::to_string(pairs.source.cols()) + " pairs of landmarks, expected at least four");
  requireSpread(pairs.source, sourceFile);
  requireSpread(pairs.target, targetFile);
  const Points mirrored = Eigen::Vector3d(-1, 1, 1).asDiagonal() * pairs.source;
  const double error = fitErrorOf(pairs.source, pairs.target);
  const double size =
    std::sqrt((pairs.target.colwise() - pairs.target.rowwise().mean()).colwise().squaredNorm().mean());
  if (error > 0.05 * size && 2 * fitErrorOf(mirrored, pairs.target) < error)
    throw InputError(files + "the landmarks are mirror images of each other, expected left on the left in both");
  const double scale = std::cbrt(similarityOf(pairs).linear().determinant());
  if (scale >= 0.25 && scale <= 4) return;
  std::ostringstream text;
  text.precision(3);
  text << files << "the patient's landmarks are " << scale
       << " times as large as the template's, expected about the same size, or the units of both";
  throw InputError(text.str());
}

void requireNear(const NamedPoints& landmarks, const Points& mesh, const std::string& meshFile)
{
  const Eigen::Vector3d low = mesh.rowwise().minCoeff(), high = mesh.rowwise().maxCoeff();
  for (Eigen::Index i = 0; i < landmarks.points.cols(); ++i)
  {
    const Eigen::Vector3d p = landmarks.points.col(i);
    const double distance = (p - p.cwiseMax(low).cwiseMin(high)).norm();
    if (distance <= 0.5 * (high - low).norm()) continue;
    std::ostringstream text;
    text.precision(3);
    text << landmarks.file << ": landmark \"" << landmarks.names[std::size_t(i)] << "\" is " << distance << " mm from "
         << meshFile << ", which is " << (high - low).norm()
         << " mm large, expected landmarks on it: the template's file first, then the patient's";
    throw InputError(text.str());
  }
}

} // namespace surgicalmesher
