// What a finished drive says of itself: the columns of its record.
#include <cmath>

#include "math/angles.h"
#include "rover/rover_geometry.h"
#include "sensing/tracker.h"
#include "trial/drive.h"
#include "trial/layout.h"

namespace rockyard::trial {

void Drive::ReportGoals(truth::DriveRecord& record) const {
  const CourseParams& course = params_.course;
  const messages::PoseEstimate& estimate = pose();
  record.straight_distance_m =
      std::hypot(course.goal_x_m - course.start_x_m, course.goal_y_m - course.start_y_m);
  const messages::Goal& told = designated_goals_.back();
  record.told_goal_x_m = told.x_m;
  record.told_goal_y_m = told.y_m;
  record.designation_error_m = std::hypot(told.x_m - course.goal_x_m, told.y_m - course.goal_y_m);
  const messages::Goal& believed = navigator_.last_goal();
  record.believed_goal_distance_m =
      std::hypot(believed.x_m - estimate.x_m, believed.y_m - estimate.y_m);
  record.waypoints_reached = static_cast<double>(navigator_.reached());
}

void Drive::ReportPoses(truth::DriveRecord& record) const {
  const math::Pose2 truth = math::ToPose2(rover_->state().X_WR);
  const messages::PoseEstimate& estimate = pose();
  const messages::Goal goal = params_.course.GoalAt(ledger_.time_s());
  record.true_goal_distance_m = std::hypot(goal.x_m - truth.x_m, goal.y_m - truth.y_m);
  record.final_x_m = truth.x_m;
  record.final_y_m = truth.y_m;
  record.final_heading_rad = truth.heading_rad;
  record.believed_x_m = estimate.x_m;
  record.believed_y_m = estimate.y_m;
  record.believed_heading_rad = estimate.heading_rad;
}

void Drive::ReportErrors(truth::DriveRecord& record) const {
  const math::Pose2 truth = math::ToPose2(rover_->state().X_WR);
  const sensing::TrackerParams& tracker = params_.sensors.tracker;
  const math::Pose2 reference =
      tracker.enabled ? sensing::Tracker(tracker, key_).Observe(truth, 0) : truth;
  const messages::PoseEstimate& estimate = pose();
  record.dead_reckoned_distance_m = estimate.distance_m;
  if (record.true_distance_m > 0.0) {
    record.distance_error_percent =
        100.0 * (estimate.distance_m - record.true_distance_m) / record.true_distance_m;
  }
  record.heading_error_deg =
      math::RadToDeg(std::abs(math::WrapAngle(estimate.heading_rad - reference.heading_rad)));
  record.position_error_m = std::hypot(estimate.x_m - reference.x_m, estimate.y_m - reference.y_m);
  record.heading_growth_deg2_per_m = heading_growth_.per_m();
  record.distance_growth_m2_per_m = distance_growth_.per_m();
  if (navigator_.view() != nullptr) {
    record.height_error_m = estimator_->estimate().attitude.z_m -
                            (rover_->state().X_WR.translation().z() - start_z_m_);
  }
}

void Drive::ReportLedger(truth::DriveRecord& record) const {
  record.sim_time_s = ledger_.time_s();
  record.drive_time_s = ledger_.time_s(Activity::kDriving);
  record.turn_time_s = ledger_.time_s(Activity::kTurning);
  record.scan_time_s = ledger_.time_s(Activity::kScanning);
  record.energy_wh = ledger_.energy_wh();
  record.scan_energy_wh = ledger_.energy_wh(Activity::kScanning);
  record.imaging_time_s = ledger_.time_s(Activity::kImaging);
  record.compute_time_s = ledger_.time_s(Activity::kComputing);
  record.imaging_energy_wh = ledger_.energy_wh(Activity::kImaging);
  record.compute_energy_wh = ledger_.energy_wh(Activity::kComputing);
  record.steer_time_s = ledger_.time_s(Activity::kSteering);
  record.move_overhead_time_s = ledger_.time_s(Activity::kOverhead);
  record.move_time_s =
      record.drive_time_s + record.turn_time_s + record.steer_time_s + record.move_overhead_time_s;
  record.stall_time_s = stall_.time_s;
  record.stall_energy_wh = stall_.energy_wh;
  record.active_time_s = ledger_.time_s() - ledger_.time_s(Activity::kStalled);
  record.active_energy_wh = ledger_.energy_wh() - ledger_.energy_wh(Activity::kStalled);
  if (ledger_.time_s() <= 0.0) return;
  const double again_s =
      static_cast<double>(terrain_sensing_.rescans()) * terrain_sensing_.look_time().total_s();
  record.net_rate_m_s = record.true_distance_m / ledger_.time_s();
  record.single_scan_rate_m_s = record.true_distance_m / (ledger_.time_s() - again_s);
}

void Drive::ReportCounts(truth::DriveRecord& record) const {
  record.scans = static_cast<double>(terrain_sensing_.scans());
  record.rescans = static_cast<double>(terrain_sensing_.rescans());
  record.image_sets = static_cast<double>(terrain_sensing_.image_sets());
  record.rear_image_sets = static_cast<double>(terrain_sensing_.rear_image_sets());
  record.moves = static_cast<double>(moves_.moves());
  record.point_turns = static_cast<double>(moves_.point_turns());
  record.reversals = static_cast<double>(moves_.reversals());
  record.hazards_believed = static_cast<double>(hazards_.believed());
  record.hazards_begun = static_cast<double>(hazards_.begun());
  record.turns_in_place = static_cast<double>(turns_.turns());
  record.scrapes = static_cast<double>(motion_sensors_->scrapes().episodes());
  record.stops = static_cast<double>(stops_.stops());
  record.first_scrape_distance_m = first_scrape_m_.value_or(record.true_distance_m);
  record.scrape_heading_rad = motion_sensors_->scrapes().total_jump_rad();
  record.reflections = static_cast<double>(reflections_);
  record.stuck_noticed = static_cast<double>(stuck_noticed_);
  record.beyond_soil_law =
      monitor_.max_sinkage_m() > rover::LargestLawfulSinkage(params_.rover.geometry) ? 1.0 : 0.0;
  record.unconverged_balances = static_cast<double>(rover_->unconverged_balances());
  record.no_progress_distance_m = referee_.no_progress_distance_m();
  record.no_progress_turn_deg = math::RadToDeg(referee_.no_progress_turn_rad());
  record.layout = static_cast<double>(LayoutKey(params_, key_).trial);
  record.rocks = static_cast<double>(field_.terrain.rocks().size());
  record.rock_cover = field_.audit.outline_cover;
}

void Drive::ReportHazards(truth::DriveRecord& record) const {
  using messages::VehicleHazardKind;
  record.hazards_met = static_cast<double>(watch_.met());
  record.hazards_missed = static_cast<double>(watch_.missed());
  record.contact_hazards = static_cast<double>(guard_.count(VehicleHazardKind::kContact));
  record.tilt_hazards = static_cast<double>(guard_.count(VehicleHazardKind::kTilt));
  record.articulation_hazards = static_cast<double>(guard_.count(VehicleHazardKind::kArticulation));
  record.safeguard_stops = static_cast<double>(guard_.stops());
  record.current_hazards = static_cast<double>(guard_.count(VehicleHazardKind::kMotorCurrent));
}

}  // namespace rockyard::trial
