// The "virtual" arena as operators ran it (Matthies 1995 sec. 7): whenever the rover's position
// reaches a mirror line, it is turned in place to the mirror-image heading, and its own estimate is
// reflected about the line.
#pragma once

#include <cmath>
#include <optional>

#include "math/pose.h"
#include "messages/estimates.h"

namespace rockyard::trial {

struct Reflection {
  math::Pose2 pose;             // true pose after the operators turned the rover
  messages::PoseUpdate update;  // estimate after its reflection
  double line_m = 0.0;          // y of the mirror line
};

class MirrorArena {
 public:
  // Mirror lines at y = +-half_width_m.
  explicit MirrorArena(double half_width_m) : half_width_m_(half_width_m) {}

  // True on or beyond a line, where Reflect may have something to do.
  bool Reaches(double y_m) const { return std::abs(y_m) >= half_width_m_; }

  // The reflection that is due at this pose: on or beyond a line and driving outward, forwards
  // (direction +1) or backwards (-1). It turns the rover to the mirror-image heading, with which
  // the same drive leads inward.
  std::optional<Reflection> Reflect(const math::Pose2& pose, int direction,
                                    const messages::PoseEstimate& estimate) const;

 private:
  double half_width_m_;
};

inline std::optional<Reflection> MirrorArena::Reflect(
    const math::Pose2& pose, int direction, const messages::PoseEstimate& estimate) const {
  const double line_m = std::copysign(half_width_m_, pose.y_m);
  const bool outward = direction * std::sin(pose.heading_rad) * line_m > 0.0;
  if (!Reaches(pose.y_m) || !outward) return std::nullopt;
  return Reflection{{pose.x_m, pose.y_m, -pose.heading_rad},
                    {estimate.x_m, 2.0 * line_m - estimate.y_m, -estimate.heading_rad, true},
                    line_m};
}

}  // namespace rockyard::trial
