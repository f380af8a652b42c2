#include "trial/counters/drive_monitor.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/random.h"
#include "math/angles.h"
#include "math/functions.h"

namespace rockyard::trial {

namespace {

std::array<math::Vector3, 9> BellyPoints(const Underside& underside) {
  std::array<math::Vector3, 9> points;
  auto* point = points.data();
  for (const double x : {-1.0, 0.0, 1.0}) {
    for (const double y : {-1.0, 0.0, 1.0}) {
      *point++ = {underside.centre_x_m + x * underside.half_length_m, y * underside.half_width_m,
                  underside.height_m};
    }
  }
  return points;
}

}  // namespace

DriveMonitor::DriveMonitor(const Underside& underside, const terrain::Terrain& terrain)
    : belly_R_(BellyPoints(underside)),
      terrain_(terrain),
      min_clearance_m_(std::numeric_limits<double>::infinity()) {}

void DriveMonitor::Restart(const truth::RoverState& state) {
  // The path counts up to where the rover was taken away, however little is left of the chord.
  distance_m_ += OpenChord();
  last_X_WR_ = state.X_WR;
  chord_x_m_ = state.X_WR.translation().x();
  chord_y_m_ = state.X_WR.translation().y();
  if (!start_m_) start_m_ = {chord_x_m_, chord_y_m_};
  ObserveClearance(state.X_WR);
}

double DriveMonitor::OpenChord() const {
  const auto p = last_X_WR_.translation();
  return math::Hypot(p.x() - chord_x_m_, p.y() - chord_y_m_);
}

void DriveMonitor::Observe(const truth::RoverState& state, bool turning) {
  if (turning) {
    turned_rad_ += std::abs(math::WrapAngle(math::Heading(state.X_WR) - math::Heading(last_X_WR_)));
  }
  // A rover that stands, to look or to steer, keeps its clearance.
  if (state.X_WR.matrix() != last_X_WR_.matrix()) ObserveClearance(state.X_WR);
  last_X_WR_ = state.X_WR;
  const double chord_m = OpenChord();
  if (chord_m >= kChord_m) {
    distance_m_ += chord_m;
    chord_x_m_ = last_X_WR_.translation().x();
    chord_y_m_ = last_X_WR_.translation().y();
  }
  min_tilt_cosine_ = std::min(min_tilt_cosine_, state.X_WR.linear()(2, 2));
  max_bogie_rad_ =
      std::max({max_bogie_rad_, std::abs(state.left_bogie_rad), std::abs(state.right_bogie_rad)});
  max_rocker_rad_ = std::max(
      {max_rocker_rad_, std::abs(state.left_rocker_rad), std::abs(state.right_rocker_rad)});
  max_pitch_sine_ = std::max(max_pitch_sine_, std::abs(state.X_WR.linear()(2, 0)));
  max_roll_sine_ = std::max(max_roll_sine_, std::abs(state.X_WR.linear()(2, 1)));
  for (const double sinkage_m : state.wheel_sinkage_m) {
    max_sinkage_m_ = std::max(max_sinkage_m_, sinkage_m);
  }
}

void DriveMonitor::ObserveClearance(const math::Transform& X_WR) {
  for (const math::Vector3& p_R : belly_R_) {
    const math::Vector3 p_W = X_WR * p_R;
    min_clearance_m_ = std::min(min_clearance_m_, p_W.z() - terrain_.Height(p_W.x(), p_W.y()));
  }
}

void DriveMonitor::Report(truth::DriveRecord& record) const {
  record.true_distance_m = distance_m_ + OpenChord();
  // The displacement never exceeds the path, whose chords lead from start to end: operators at a
  // mirror line turn the rover and leave it where it is.
  const auto end = last_X_WR_.translation();
  const auto [start_x_m, start_y_m] = start_m_.value_or(std::pair(end.x(), end.y()));
  record.displacement_m = math::Hypot(end.x() - start_x_m, end.y() - start_y_m);
  record.turned_in_place_rad = turned_rad_;
  record.max_tilt_deg = math::RadToDeg(math::Acos(std::max(-1.0, min_tilt_cosine_)));
  record.max_bogie_deg = math::RadToDeg(max_bogie_rad_);
  record.max_rocker_deg = math::RadToDeg(max_rocker_rad_);
  record.max_roll_deg = math::RadToDeg(math::Asin(std::min(1.0, max_roll_sine_)));
  record.max_pitch_deg = math::RadToDeg(math::Asin(std::min(1.0, max_pitch_sine_)));
  record.min_clearance_m = min_clearance_m_;
  record.max_sinkage_m = max_sinkage_m_;
}

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
