// The terms and types of all camera models of this folder and of what takes them: calibration,
// rectification, visual odometry, the finders of the cylinder, rendering.
//
// A: the outer frame of a camera, the one in which its vectors are given (the rover's, say); both
// cameras of a pair share it. A is also the name of a vector of CAHV cameras (cahv.h).
// Pixels: (column, row), columns to the right, rows downwards. The centre of the upper left pixel
// is (0, 0), so that an image of c columns covers columns from -0.5 to c - 0.5.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <optional>

#include "math/pose.h"

namespace rockyard::vision {

// Column and row.
using Pixel = Eigen::Vector2d;

struct ImageSize {
  int columns = 0;
  int rows = 0;

  bool operator==(const ImageSize&) const = default;
};

// The line of sight of a pixel, in frame A. `origin` is where the line meets the optical axis: the
// camera's centre, except where the entrance pupil moves with the angle (CAHVORE).
struct Ray {
  math::Vector3 origin = math::Vector3::Zero();     // m
  math::Vector3 direction = math::Vector3::Zero();  // of unit length
};

// Returns `ray`, or nothing where a number of it is not finite.
inline std::optional<Ray> Finite(const Ray& ray) {
  if (!ray.origin.allFinite() || !ray.direction.allFinite()) return std::nullopt;
  return ray;
}

// The derivative of a pixel by the point that is imaged there, pixels per metre.
using PixelJacobian = Eigen::Matrix<double, 2, 3>;

// The derivative of a ray by its pixel, metres and radians per pixel.
struct RayJacobian {
  Eigen::Matrix<double, 3, 2> origin = Eigen::Matrix<double, 3, 2>::Zero();
  Eigen::Matrix<double, 3, 2> direction = Eigen::Matrix<double, 3, 2>::Zero();
};

// Returns the derivative of a ray's direction by its pixel, where the origin does not move.
// `pixel_by_point` is J, the derivative of Project at a point one metre along the ray. As J d = 0
// for the direction d, the result is the pseudo-inverse J^T (J J^T)^-1: across the ray, and taken
// back to the pixel by J.
inline Eigen::Matrix<double, 3, 2> DirectionByPixel(const PixelJacobian& pixel_by_point) {
  const Eigen::Matrix2d gram = pixel_by_point * pixel_by_point.transpose();
  return pixel_by_point.transpose() * gram.inverse();
}

// A change of pixel coordinates: scale * pixel + shift.
struct PixelMap {
  double scale = 1.0;  // > 0
  Pixel shift = Pixel::Zero();

  Pixel operator()(const Pixel& pixel) const { return scale * pixel + shift; }
};

}  // namespace rockyard::vision
