// What another view does to a small surface.
#pragma once

#include <Eigen/Core>

namespace rockyard::vision {

// How one view of a plane follows from another, about a point: what the one shows at the offset o
// (px) from it, the other has at the offset by_offset o / (1 + by_distance . o).
struct ViewChange {
  Eigen::Matrix2d by_offset = Eigen::Matrix2d::Identity();
  Eigen::Vector2d by_distance = Eigen::Vector2d::Zero();  // 1/px
};

}  // namespace rockyard::vision
