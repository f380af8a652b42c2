#include "trial/belief.h"

#include <Eigen/Cholesky>
#include <array>
#include <cmath>

#include "core/distributions.h"
#include "math/angles.h"

namespace rockyard::trial {
namespace {

std::optional<Belief> Judge(const messages::PoseEstimate& pose,
                            const messages::PoseCovariance& covariance, const math::Pose2& truth) {
  using messages::PoseCoordinate;
  const std::array planar{messages::Index(PoseCoordinate::kX), messages::Index(PoseCoordinate::kY),
                          messages::Index(PoseCoordinate::kHeading)};
  const Eigen::Matrix3d P = covariance(planar, planar);
  const Eigen::LLT<Eigen::Matrix3d> factors(P);
  if (factors.info() != Eigen::Success) return std::nullopt;
  const Eigen::Vector3d error(truth.x_m - pose.x_m, truth.y_m - pose.y_m,
                              math::WrapAngle(truth.heading_rad - pose.heading_rad));
  Belief belief;
  belief.position_sd_m = std::sqrt(P(0, 0) + P(1, 1));
  belief.heading_sd_rad = std::sqrt(P(2, 2));
  belief.nees = error.dot(factors.solve(error));
  belief.inside_95 = belief.nees <= core::ChiSquaredQuantile(0.95, 3);
  return belief;
}

}  // namespace

const messages::PoseEstimate& WorldPose(const messages::LocalizationEstimate& estimate) {
  return estimate.world ? estimate.world->pose : estimate.pose;
}

std::optional<Belief> BeliefOf(const messages::LocalizationEstimate& estimate,
                               const math::Pose2& truth_W) {
  if (!estimate.world) return GoalFrameBeliefOf(estimate, truth_W);
  return Judge(estimate.world->pose, estimate.world->covariance, truth_W);
}

std::optional<Belief> GoalFrameBeliefOf(const messages::LocalizationEstimate& estimate,
                                        const math::Pose2& truth) {
  if (!estimate.covariance) return std::nullopt;
  return Judge(estimate.pose, *estimate.covariance, truth);
}

}  // namespace rockyard::trial
