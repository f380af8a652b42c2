// What an aligned pair measures of a point: column, row and disparity, with their derivative.
//
//   column = H . d / A . d    row = V . d / A . d    disparity = H . b / A . d
//
// with d = p - C_left and b = C_right - C_left (cahv.h, Triangulate, whose inverse it is).
#pragma once

#include <Eigen/Core>
#include <optional>

#include "math/pose.h"
#include "vision/cameras/rectification.h"

namespace rockyard::vision {

// Column and row in the left image and disparity, px.
using PairPixel = Eigen::Vector3d;

class PairProjection {
 public:
  explicit PairProjection(const RectifiedPair& pair)
      : C_(pair.left.C),
        A_(pair.left.A),
        H_(pair.left.H),
        V_(pair.left.V),
        depth_disparity_(pair.left.H.dot(pair.right.C - pair.left.C)) {}

  // Nothing where p_A (m, in the cameras' outer frame) is not in front of them. Into `jacobian`,
  // where there is one, the derivative by p_A, px/m.
  std::optional<PairPixel> operator()(const math::Vector3& p_A,
                                      Eigen::Matrix3d* jacobian = nullptr) const {
    constexpr double kNearest_m = 1e-6;
    const math::Vector3 d = p_A - C_;
    const double depth = A_.dot(d);
    if (!(depth > kNearest_m)) return std::nullopt;
    const PairPixel pixel(H_.dot(d) / depth, V_.dot(d) / depth, depth_disparity_ / depth);
    if (jacobian != nullptr) {
      jacobian->row(0) = (H_ - pixel.x() * A_).transpose() / depth;
      jacobian->row(1) = (V_ - pixel.y() * A_).transpose() / depth;
      jacobian->row(2) = -pixel.z() * A_.transpose() / depth;
    }
    return pixel;
  }

  // Of a point along the cameras' axis, m.
  double Depth(const math::Vector3& p_A) const { return A_.dot(p_A - C_); }

 private:
  math::Vector3 C_;
  math::Vector3 A_;
  math::Vector3 H_;
  math::Vector3 V_;
  double depth_disparity_;  // depth times disparity, m px
};

}  // namespace rockyard::vision
