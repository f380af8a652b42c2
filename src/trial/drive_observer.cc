#include "trial/drive_observer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/angles.h"
#include "rover/rover_layout_params.h"
#include "trial/belief.h"

namespace rockyard::trial {
namespace {

Underside UndersideOf(const rover::RoverGeometryParams& rover) {
  return {0.0, 0.5 * rover.belly_length_m, 0.5 * rover.belly_width_m, rover.belly_clearance_m};
}

// Where a navigator reads no report, hazards can neither be met nor missed.
double WatchedHeight(const DriveParams& drive) {
  return drive.navigation.navigators.chosen().traits().reads ==
                 navigation::LookReading::kHazardReport
             ? drive.referee.hazard_height_m
             : std::numeric_limits<double>::infinity();
}

}  // namespace

DriveObserver::DriveObserver(const DriveParts& parts)
    : parts_(parts),
      monitor_(UndersideOf(parts.params.rover.geometry), parts.field.terrain),
      watch_(parts.params.sensors.terrain_sensors.chosen().reported_zone(parts.params),
             parts.params.rover.geometry, WatchedHeight(parts.params), parts.field.terrain),
      steering_(rover::MakeRoverGeometry(parts.params.rover.geometry).steered),
      slip_onset_(parts.params.perception.visual_odometry.slip_check) {}

bool DriveObserver::OnMotion(const messages::MotionCommand& motion) {
  turns_.Observe(motion);
  return moves_.Observe(motion);
}

void DriveObserver::OnReport(bool hazard, const math::Transform& X_WR) {
  hazards_.Observe(hazard);
  if (hazard) watch_.OnBelieved(X_WR);
}

void DriveObserver::OnScrape() {
  if (!first_scrape_m_) first_scrape_m_ = monitor_.distance_m();
}

void DriveObserver::OnTick(bool turning_in_place) {
  monitor_.Observe(parts_.state(), turning_in_place);
  steering_.Observe(parts_.state().steer_rad);
  ObserveErrors();
  watch_.Observe(parts_.state().X_WR);
  slip_onset_.Observe(parts_.estimate().odometry, math::ToPose2(parts_.state().X_WR),
                      monitor_.distance_m());
}

void DriveObserver::OnSlip(const SlipReading& slip) {
  largest_slip_ = std::max(largest_slip_.value_or(slip.seen.slip), slip.seen.slip);
  if (!slip.seen.exceeded) return;
  ++slip_alarms_;
  if (!slip.truly_exceeded) ++false_slip_alarms_;
  if (!first_slip_m_) first_slip_m_ = monitor_.distance_m();
}

void DriveObserver::OnSeenMotion() {
  const messages::PoseEstimate& now = parts_.estimate().pose;
  seen_distance_m_ =
      seen_distance_m_.value_or(0.0) + std::hypot(now.x_m - seen_at_.x_m, now.y_m - seen_at_.y_m);
  seen_at_ = now;
}

void DriveObserver::ObserveErrors() {
  const messages::PoseEstimate& estimate = WorldPose(parts_.estimate());
  const double heading_rad = math::Heading(parts_.state().X_WR);
  const double distance_m = monitor_.distance_m();
  heading_growth_.Observe(distance_m,
                          math::RadToDeg(math::WrapAngle(estimate.heading_rad - heading_rad)));
  distance_growth_.Observe(distance_m, estimate.distance_m - distance_m);
}

}  // namespace rockyard::trial
