#include "trial/mirror_arena.h"

#include <cmath>

namespace rockyard::trial {

std::optional<Reflection> MirrorArena::Reflect(const math::Pose2& pose, int direction,
                                               const messages::PoseEstimate& estimate) const {
  const double line_m = std::copysign(half_width_m_, pose.y_m);
  const bool outward = direction * std::sin(pose.heading_rad) * line_m > 0.0;
  if (!Reaches(pose.y_m) || !outward) return std::nullopt;
  return Reflection{{pose.x_m, pose.y_m, -pose.heading_rad},
                    {estimate.x_m, 2.0 * line_m - estimate.y_m, -estimate.heading_rad, true},
                    line_m};
}

}  // namespace rockyard::trial
