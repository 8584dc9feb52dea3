// SPDX-License-Identifier: Apache-2.0
#include "LinearParameters.h"

#include <itkVersor.h>

#include <cmath>

namespace surgicalmesher
{

namespace
{

/// Rotation about a vector by the vector's length (radians).
Matrix3 rotationBy(const Vec3& vector)
{
  itk::Versor<double> versor;
  const double angle = norm(vector);
  if (angle > 0) versor.Set(itk::Versor<double>::VectorType(&vector.x), angle);
  return versor.GetMatrix();
}

} // namespace

LinearMap mapOf(const LinearParameters& parameters, const Vec3& centre)
{
  LinearMap map;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column) map.rows[row][column] = parameters[std::size_t(3 * row + column)];
    map.offset[row] = centre[row] + parameters[std::size_t(9 + row)] - dot(map.rows[row], centre);
  }
  return map;
}

Matrix3 turned(int axis, double angle)
{
  Vec3 vector;
  vector[axis] = angle;
  return rotationBy(vector);
}

LinearParameters withMatrix(const Matrix3& matrix, const Vec3& shift)
{
  LinearParameters parameters;
  for (unsigned n = 0; n < 9; ++n) parameters[n] = matrix(n / 3, n % 3);
  for (int axis = 0; axis < 3; ++axis) parameters[std::size_t(9 + axis)] = shift[axis];
  return parameters;
}

Matrix3 matrixOf(const LinearParameters& parameters)
{
  Matrix3 matrix;
  for (unsigned n = 0; n < 9; ++n) matrix(n / 3, n % 3) = parameters[n];
  return matrix;
}

double scaleOf(const LinearParameters& parameters)
{
  const std::array<Vec3, 3> rows = mapOf(parameters, {}).rows;
  return std::cbrt(dot(cross(rows[0], rows[1]), rows[2]));
}

LinearChart similaritiesFrom(const LinearParameters& start, double radius)
{
  return [=](const std::vector<double>& steps)
  {
    const Matrix3 turn = rotationBy(Vec3{ steps[0], steps[1], steps[2] } / radius);
    const Vec3 shift{ start[9] + steps[3], start[10] + steps[4], start[11] + steps[5] };
    return withMatrix((turn * matrixOf(start)) * std::exp(steps[6] / radius), shift);
  };
}

LinearChart linearMapsFrom(const LinearParameters& start, double radius)
{
  return [=](const std::vector<double>& steps)
  {
    LinearParameters parameters = start;
    for (std::size_t n = 0; n < 12; ++n) parameters[n] += n < 9 ? steps[n] * std::sqrt(3.0) / radius : steps[n];
    return parameters;
  };
}

} // namespace surgicalmesher
