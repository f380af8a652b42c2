// A CAHVOR camera as 18 numbers in the order of flight calibrations: C, A, H, V, O, R. A Cahv is
// one with O = A and R = 0.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "vision/cameras/cahvor.h"

namespace rockyard::vision {

inline constexpr int kCameraNumbers = 18;
enum ParameterBlock {
  kBlockC = 0,
  kBlockA = 3,
  kBlockH = 6,
  kBlockV = 9,
  kBlockO = 12,
  kBlockR = 15
};

using CameraVector = Eigen::Matrix<double, kCameraNumbers, 1>;
using NumbersJacobian = Eigen::Matrix<double, 2, kCameraNumbers>;

CameraVector NumbersOf(const Cahvor& camera);
Cahvor CameraOfNumbers(const CameraVector& numbers);

// Project(camera, p_A) with its derivatives by the 18 numbers and by p_A. Of O only what is across
// it counts, as Project divides its length out: the derivative is that for |O| = 1, at which it
// must be given. Nothing where Project gives nothing.
std::optional<Pixel> ProjectByNumbers(const Cahvor& camera, const math::Vector3& p_A,
                                      NumbersJacobian& by_numbers, PixelJacobian& by_point);

// What is estimated of a camera.
enum class EstimatedLens {
  kCahv,   // C, A, H, V
  kCahvor  // and O, R1, R2; R0 stays 0: with O near A it does what a focal length does
};

// In which frame.
enum class EstimatedPlace {
  kFree,   // where the targets say
  kOrigin  // the camera makes the frame: C = 0, A = z, H has no y
};

// The columns span the ways in which the numbers may change: A and O stay of unit length to first
// order, what is not estimated stands still. Between 5 (a Cahv that makes the frame) and 15.
Eigen::Matrix<double, kCameraNumbers, Eigen::Dynamic> TangentBasis(const Cahvor& camera,
                                                                   EstimatedLens lens,
                                                                   EstimatedPlace place);

// The camera moved by basis * step, with A and O of unit length; with `lens` kCahv O is A.
Cahvor Stepped(const Cahvor& camera, const CameraVector& change, EstimatedLens lens);

}  // namespace rockyard::vision
