// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Parametrisations of linear maps for registration: twelve parameters about a centre, and charts with fewer
/// parameters.

#include "LinearMap.h"
#include "Vec3.h"

#include <itkMatrix.h>

#include <array>
#include <functional>
#include <vector>

namespace surgicalmesher
{

using Matrix3 = itk::Matrix<double, 3, 3>;

/// Twelve parameters of a linear map about a centre: the matrix, row by row, and the displacement of the centre (mm).
using LinearParameters = std::array<double, 12>;

/// A local parametrisation of linear maps by a few steps, each of which moves points of interest by about its length
/// (mm).
using LinearChart = std::function<LinearParameters(const std::vector<double>&)>;

LinearParameters withMatrix(const Matrix3& matrix, const Vec3& shift);
Matrix3 matrixOf(const LinearParameters& parameters);
LinearMap mapOf(const LinearParameters& parameters, const Vec3& centre);
double scaleOf(const LinearParameters& parameters);

/// The rotation by an angle (radians) about an axis of the world.
Matrix3 turned(int axis, double angle);

/// Similarities about `start`: three rotations, three shifts and one scale, seven steps in all. `radius` (mm) is the
/// distance from the centre at which a step of rotation or scale moves a point by its length.
LinearChart similaritiesFrom(const LinearParameters& start, double radius);

/// All linear maps about `start`: twelve steps.
LinearChart linearMapsFrom(const LinearParameters& start, double radius);

} // namespace surgicalmesher
