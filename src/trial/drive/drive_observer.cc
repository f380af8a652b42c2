#include "trial/drive/drive_observer.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/check.h"
#include "math/angles.h"
#include "math/functions.h"
#include "rover/rover_layout_params.h"
#include "trial/counters/drive_monitor.h"

namespace rockyard::trial {
namespace {

Underside UndersideOf(const rover::RoverGeometryParams& rover) {
  return {0.0, 0.5 * rover.belly_length_m, 0.5 * rover.belly_width_m, rover.belly_clearance_m};
}

// Returns the height from which rocks are watched; none is where the navigator reads no report, as
// hazards can then neither be met nor missed.
double WatchedHeight(const DriveParams& drive) {
  return drive.navigation.navigators.chosen().traits().reads ==
                 navigation::LookReading::kHazardReport
             ? drive.referee.hazard_height_m
             : std::numeric_limits<double>::infinity();
}

}  // namespace

SightWatchers WithTruth(const Watchers& watchers, const World& world) {
  SightWatchers on_board;
  if (watchers.scan) {
    on_board.scan = [watch = watchers.scan, &world](const messages::StripeScan& scan) {
      watch({world.params(), world.field().terrain, world.state().X_WR, world.key(), scan});
    };
  }
  if (watchers.stereo) {
    on_board.stereo = [watch = watchers.stereo, &world](const StereoSightView& seen) {
      watch({world.state().X_WR, seen.sight, seen.pair, seen.matching, seen.cloud});
    };
  }
  return on_board;
}

DriveObserver::DriveObserver(const World& world, const Onboard& onboard, const Ledger& ledger,
                             std::vector<messages::Goal> told)
    : world_(world),
      onboard_(onboard),
      ledger_(ledger),
      params_(world.params()),
      told_places_(std::move(told)),
      goal_rock_(GoalRockOf(params_, world.field().terrain)),
      monitor_(UndersideOf(params_.rover.geometry), world.field().terrain),
      watch_(params_.sensors.terrain_sensors.chosen().reported_zone(params_),
             params_.rover.geometry, WatchedHeight(params_), world.field().terrain),
      steering_(rover::MakeRoverGeometry(params_.rover.geometry).steered),
      slip_onset_(params_.perception.visual_odometry.slip_check) {}

void DriveObserver::OnPlaced() {
  monitor_.Restart(world_.state());
  steering_.Restart(world_.state().steer_rad);
  slip_onset_.Restart();
  seen_at_ = onboard_.estimate().pose;
}

bool DriveObserver::OnMotion(const messages::MotionCommand& motion) {
  turns_.Observe(motion);
  return moves_.Observe(motion);
}

math::Transform DriveObserver::LookedFrom(std::int64_t look) {
  const auto found = looked_from_X_WR_.find(look);
  EXPECT(found != looked_from_X_WR_.end());
  looked_from_X_WR_.erase(looked_from_X_WR_.begin(), found);
  return found->second;
}

void DriveObserver::OnReport(bool hazard, std::int64_t look) {
  hazards_.Observe(hazard);
  const math::Transform X_WR = LookedFrom(look);
  if (!hazard) return;
  watch_.OnBelieved(X_WR);
  if (goal_rock_) goal_rock_->OnBelieved(X_WR);
}

bool DriveObserver::FoundRock() {
  if (!goal_rock_) return false;
  goal_rock_->Observe(world_.state());
  return goal_rock_->found();
}

Observation DriveObserver::Observed(Activity activity, int direction, double duration_s) const {
  return {activity,
          direction,
          duration_s,
          world_.state(),
          onboard_.estimate().pose,
          monitor_.distance_m(),
          monitor_.turned_in_place_rad()};
}

void DriveObserver::OnScrape() {
  if (!first_scrape_m_) first_scrape_m_ = monitor_.distance_m();
}

void DriveObserver::OnTick(bool turning_in_place) {
  monitor_.Observe(world_.state(), turning_in_place);
  steering_.Observe(world_.state().steer_rad);
  ObserveErrors();
  watch_.Observe(world_.state().X_WR);
  slip_onset_.Observe(onboard_.estimate().odometry, math::ToPose2(world_.state().X_WR),
                      monitor_.distance_m());
}

void DriveObserver::OnMotionSeen(const VisualStep& step) {
  slip_onset_.OnLook(step.number, math::ToPose2(world_.state().X_WR));
}

void DriveObserver::OnSlip(const SlipReading& slip) {
  largest_slip_ = std::max(largest_slip_.value_or(slip.seen.slip), slip.seen.slip);
  if (!slip.seen.exceeded) return;
  ++slip_alarms_;
  if (!slip_onset_.TrulyExceeded(slip)) ++false_slip_alarms_;
  if (!first_slip_m_) first_slip_m_ = monitor_.distance_m();
}

void DriveObserver::OnSeenMotion() {
  const messages::PoseEstimate& now = onboard_.estimate().pose;
  seen_distance_m_ =
      seen_distance_m_.value_or(0.0) + math::Hypot(now.x_m - seen_at_.x_m, now.y_m - seen_at_.y_m);
  seen_at_ = now;
}

DriveEnd DriveObserver::End() const {
  DriveEnd end{.X_WR = world_.state().X_WR,
               .memory = {},  // asked for while a failure can still end the drive
               .battery_wh = ledger_.battery_drawn_wh()};
  for (std::size_t i = 0; i < kActivityCount; ++i) {
    end.energy_wh[i] = ledger_.energy_wh(static_cast<Activity>(i));
  }
  return end;
}

void DriveObserver::ObserveErrors() {
  const messages::PoseEstimate& estimate = WorldPose(onboard_.estimate());
  const double heading_rad = math::Heading(world_.state().X_WR);
  const double distance_m = monitor_.distance_m();
  heading_growth_.Observe(distance_m,
                          math::RadToDeg(math::WrapAngle(estimate.heading_rad - heading_rad)));
  distance_growth_.Observe(distance_m, estimate.distance_m - distance_m);
}

}  // namespace rockyard::trial
