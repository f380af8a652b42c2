#include "perception/slip_check.h"

#include <cmath>

namespace rockyard::perception {

std::optional<MeasuredSlip> SlipOf(const Eigen::Vector2d& rolled_F,
                                   const messages::RelativeMotion& seen,
                                   const SlipCheckParams& params) {
  const double rolled_m = rolled_F.norm();
  if (!(rolled_m >= params.min_way_m)) return std::nullopt;
  const Eigen::Vector2d along = rolled_F / rolled_m;
  MeasuredSlip measured;
  measured.slip = 1.0 - seen.motion_F.head<2>().dot(along) / rolled_m;
  measured.sd = std::sqrt(along.dot(seen.covariance.topLeftCorner<2, 2>() * along)) / rolled_m;
  measured.exceeded = measured.slip - params.sigma * measured.sd > params.limit;
  return measured;
}

Eigen::Vector2d RolledWay(const messages::PoseEstimate& from, const messages::PoseEstimate& to) {
  const double c = std::cos(from.heading_rad);
  const double s = std::sin(from.heading_rad);
  const double dx_m = to.x_m - from.x_m;
  const double dy_m = to.y_m - from.y_m;
  return {c * dx_m + s * dy_m, -s * dx_m + c * dy_m};
}

}  // namespace rockyard::perception
