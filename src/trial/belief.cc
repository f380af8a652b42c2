#include "trial/belief.h"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

#include "core/distributions.h"
#include "math/angles.h"

namespace rockyard::trial {

std::optional<Belief> BeliefOf(const messages::LocalizationEstimate& estimate,
                               const math::Pose2& truth) {
  if (!estimate.covariance) return std::nullopt;
  using messages::PoseCoordinate;
  const std::array planar{messages::Index(PoseCoordinate::kX), messages::Index(PoseCoordinate::kY),
                          messages::Index(PoseCoordinate::kHeading)};
  const Eigen::Matrix3d P = (*estimate.covariance)(planar, planar);
  const Eigen::LLT<Eigen::Matrix3d> factors(P);
  if (factors.info() != Eigen::Success) return std::nullopt;
  const Eigen::Vector3d error(truth.x_m - estimate.pose.x_m, truth.y_m - estimate.pose.y_m,
                              math::WrapAngle(truth.heading_rad - estimate.pose.heading_rad));
  Belief belief;
  belief.position_sd_m = std::sqrt(P(0, 0) + P(1, 1));
  belief.heading_sd_rad = std::sqrt(P(2, 2));
  belief.nees = error.dot(factors.solve(error));
  belief.inside_95 = belief.nees <= core::ChiSquaredQuantile(0.95, 3);
  return belief;
}

}  // namespace rockyard::trial
