// SPDX-License-Identifier: Apache-2.0
#pragma once
/// Linear maps as registration varies them: twelve parameters about a centre, and charts of few steps.

#include "LinearMap.h"
#include "Vec3.h"

#include <itkMatrix.h>

#include <array>
#include <functional>
#include <vector>

namespace surgicalmesher
{

using Matrix3 = itk::Matrix<double, 3, 3>;

/// Twelve parameters of a linear map about a centre: the matrix, row by row, and where the centre goes, less the centre.
using LinearParameters = std::array<double, 12>;

/// Linear maps as a function of a few steps, each of which moves points of interest by about its length (mm).
using LinearChart = std::function<LinearParameters(const std::vector<double>&)>;

LinearParameters withMatrix(const Matrix3& matrix, const Vec3& shift);
Matrix3 matrixOf(const LinearParameters& parameters);
LinearMap mapOf(const LinearParameters& parameters, const Vec3& centre);
double scaleOf(const LinearParameters& parameters);

/// The rotation by an angle (radians) about an axis of the world.
Matrix3 turned(int axis, double angle);

/// Turns, shifts and one scale from a map on: seven steps. `radius`: the lever of turns and of the scale, mm.
LinearChart similaritiesFrom(const LinearParameters& start, double radius);

/// All linear maps: twelve steps.
LinearChart linearMapsFrom(const LinearParameters& start, double radius);

} // namespace surgicalmesher
