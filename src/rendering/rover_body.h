// The rover's own parts as its cameras see them: what hides a view or casts a shadow. Images, masks
// of images and the sun's shade ask it; sensing/rover_parts.h makes the one of a rover. Records of
// drives by images depend on its bits, and those of the stereo error model where shade drops
// points.
#pragma once

#include <limits>
#include <vector>

#include "math/pose.h"

namespace rockyard::rendering {

// Boxes along the axes of R, and wheels with axles along its y axis. Parts do not move in R, though
// wheels climb and steer.
class RoverBody {
 public:
  static constexpr double kFree = std::numeric_limits<double>::infinity();

  struct Box {
    math::Vector3 low_R;
    math::Vector3 high_R;
  };
  struct Wheel {
    math::Vector3 center_R;
    double radius_m;
    double half_width_m;
  };

  // There has to be a box.
  RoverBody(std::vector<Box> boxes, std::vector<Wheel> wheels);

  // Returns the distance along the unit ray to the first part that it enters from outside; kFree
  // where there is none. A part that holds the origin does not count: what is mounted inside a part
  // looks out of it.
  double Distance(const math::Vector3& origin_R, const math::Vector3& direction_R) const;

  // Returns the outward normal of the part that the ray enters first, or the direction against the
  // ray where it enters none.
  math::Vector3 Normal(const math::Vector3& origin_R, const math::Vector3& direction_R) const;

  // This ball in R holds every part.
  const math::Vector3& center_R() const { return center_R_; }
  double radius_m() const { return radius_m_; }

 private:
  struct Entry {
    double distance_m = kFree;
    math::Vector3 normal_R = math::Vector3::Zero();
  };

  static Entry Enter(const Box& box, const math::Vector3& origin_R,
                     const math::Vector3& direction_R);
  static Entry Enter(const Wheel& wheel, const math::Vector3& origin_R,
                     const math::Vector3& direction_R);
  bool PassesBy(const math::Vector3& origin_R, const math::Vector3& direction_R) const;
  Entry First(const math::Vector3& origin_R, const math::Vector3& direction_R) const;

  std::vector<Box> boxes_;
  std::vector<Wheel> wheels_;
  Box bounds_;  // around every part
  math::Vector3 center_R_ = math::Vector3::Zero();
  double radius_m_ = 0.0;
};

}  // namespace rockyard::rendering
