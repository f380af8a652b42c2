// The columns of a finished drive's record (truth/drive_record.h), filled by DriveObserver::Report.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "math/angles.h"
#include "math/functions.h"
#include "rover/rover_layout_params.h"
#include "sensing/tracker.h"
#include "trial/counters/drive_monitor.h"
#include "trial/course/layout.h"
#include "trial/drive/drive_observer.h"

namespace rockyard::trial {

truth::DriveRecord DriveObserver::Report(bool declared_success, const Stall& stall,
                                         const Referee& referee) const {
  truth::DriveRecord record;
  monitor_.Report(record);
  if (declared_success && record.displacement_m > 0.0) {
    record.path_ratio = record.true_distance_m / record.displacement_m;
  }
  ReportGoals(record);
  ReportPoses(record);
  ReportErrors(record);
  ReportBelief(record);
  ReportVision(record);
  ReportLedger(record, stall);
  ReportCounts(record, referee);
  ReportHazards(record);
  ReportGoalRock(record);
  ReportPlans(record);
  return record;
}

void DriveObserver::ReportGoals(truth::DriveRecord& record) const {
  const CourseParams& course = params_.course;
  const messages::PoseEstimate& estimate = onboard_.estimate().pose;
  record.straight_distance_m =
      math::Hypot(course.goal_x_m - course.start_x_m, course.goal_y_m - course.start_y_m);
  const messages::Goal& told = told_places_.back();
  record.told_goal_x_m = told.x_m;
  record.told_goal_y_m = told.y_m;
  record.designation_error_m = math::Hypot(told.x_m - course.goal_x_m, told.y_m - course.goal_y_m);
  const messages::Goal& believed = onboard_.navigator().last_goal();
  record.believed_goal_distance_m =
      math::Hypot(believed.x_m - estimate.x_m, believed.y_m - estimate.y_m);
  const std::size_t waypoints = told_places_.size() - 1;
  record.waypoints_reached =
      static_cast<double>(std::min(onboard_.navigator().reached(), waypoints));
}

void DriveObserver::ReportPoses(truth::DriveRecord& record) const {
  const math::Pose2 truth = math::ToPose2(world_.state().X_WR);
  const messages::PoseEstimate& estimate = onboard_.estimate().pose;
  const messages::Goal goal = params_.course.GoalAt(ledger_.time_s());
  record.true_goal_distance_m = math::Hypot(goal.x_m - truth.x_m, goal.y_m - truth.y_m);
  record.final_x_m = truth.x_m;
  record.final_y_m = truth.y_m;
  record.final_heading_rad = truth.heading_rad;
  record.believed_x_m = estimate.x_m;
  record.believed_y_m = estimate.y_m;
  record.believed_heading_rad = estimate.heading_rad;
}

void DriveObserver::ReportErrors(truth::DriveRecord& record) const {
  const math::Pose2 truth = math::ToPose2(world_.state().X_WR);
  const sensing::TrackerParams& tracker = params_.sensors.tracker;
  const math::Pose2 reference =
      tracker.enabled ? sensing::Tracker(tracker, world_.key()).Observe(truth, 0) : truth;
  const messages::PoseEstimate& estimate = WorldPose(onboard_.estimate());
  record.dead_reckoned_distance_m = estimate.distance_m;
  if (record.true_distance_m > 0.0) {
    record.distance_error_percent =
        100.0 * (estimate.distance_m - record.true_distance_m) / record.true_distance_m;
  }
  record.heading_error_deg =
      math::RadToDeg(std::abs(math::WrapAngle(estimate.heading_rad - reference.heading_rad)));
  record.position_error_m = math::Hypot(estimate.x_m - reference.x_m, estimate.y_m - reference.y_m);
  record.heading_growth_deg2_per_m = heading_growth_.per_m();
  record.distance_growth_m2_per_m = distance_growth_.per_m();
  if (onboard_.navigator().view() != nullptr) {
    record.height_error_m = onboard_.estimate().attitude.z_m -
                            (world_.state().X_WR.translation().z() - world_.start_z_m());
  }
}

void DriveObserver::ReportBelief(truth::DriveRecord& record) const {
  const AidCounts& aids = onboard_.aids().counts();
  record.aids_used = static_cast<double>(aids.used);
  record.aids_in_doubt = static_cast<double>(aids.in_doubt);
  record.aids_gated_out = static_cast<double>(aids.gated_out);
  record.aids_unanswered = static_cast<double>(aids.unanswered);
  const std::optional<Belief> belief =
      BeliefOf(onboard_.estimate(), math::ToPose2(world_.state().X_WR));
  if (!belief) return;
  record.believed_position_sd_m = belief->position_sd_m;
  record.believed_heading_sd_deg = math::RadToDeg(belief->heading_sd_rad);
  record.pose_nees = belief->nees;
  record.inside_95 = belief->inside_95 ? 1.0 : 0.0;
}

void DriveObserver::ReportVision(truth::DriveRecord& record) const {
  const VisualCounts& vision = onboard_.vision().counts();
  record.visual_steps = static_cast<double>(vision.steps);
  record.visual_failures = static_cast<double>(vision.failures);
  record.visual_keyframes = static_cast<double>(vision.keyframes);
  record.visual_gated_out = static_cast<double>(vision.gated_out);
  record.slip_alarms = static_cast<double>(slip_alarms_);
  record.false_slip_alarms = static_cast<double>(false_slip_alarms_);
  if (largest_slip_) record.largest_slip = *largest_slip_;
  if (first_slip_m_) record.first_slip_alarm_m = *first_slip_m_;
  if (slip_onset_.path_m()) record.slip_onset_m = *slip_onset_.path_m();
  if (seen_distance_m_) record.visual_distance_m = *seen_distance_m_;
}

void DriveObserver::ReportLedger(truth::DriveRecord& record, const Stall& stall) const {
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
  record.move_time_s = record.drive_time_s + record.turn_time_s +
                       ledger_.time_alone_s(Activity::kSteering) + record.move_overhead_time_s;
  record.stall_time_s = stall.time_s;
  record.stall_energy_wh = stall.energy_wh;
  record.active_time_s = ledger_.time_s() - ledger_.time_s(Activity::kStalled);
  record.active_energy_wh = ledger_.energy_wh() - ledger_.energy_wh(Activity::kStalled);
  if (ledger_.time_s() <= 0.0) return;
  const double again_s = static_cast<double>(onboard_.terrain_sensing().rescans()) *
                         onboard_.terrain_sensing().look_time().total_s();
  record.net_rate_m_s = record.true_distance_m / ledger_.time_s();
  record.single_scan_rate_m_s = record.true_distance_m / (ledger_.time_s() - again_s);
}

void DriveObserver::ReportCounts(truth::DriveRecord& record, const Referee& referee) const {
  record.scans = static_cast<double>(onboard_.terrain_sensing().scans());
  record.rescans = static_cast<double>(onboard_.terrain_sensing().rescans());
  record.image_sets = static_cast<double>(onboard_.terrain_sensing().image_sets());
  record.rear_image_sets = static_cast<double>(onboard_.terrain_sensing().rear_image_sets());
  record.moves = static_cast<double>(moves_.moves());
  record.point_turns = static_cast<double>(moves_.point_turns());
  record.reversals = static_cast<double>(moves_.reversals());
  record.hazards_believed = static_cast<double>(hazards_.believed());
  record.hazards_begun = static_cast<double>(hazards_.begun());
  record.turns_in_place = static_cast<double>(turns_.turns());
  record.scrapes = static_cast<double>(world_.scrapes().episodes());
  record.stops = static_cast<double>(stops_.stops());
  record.steer_turned_rad = steering_.mean_rad();
  record.steer_turned_max_rad = steering_.max_rad();
  record.first_scrape_distance_m = first_scrape_m_.value_or(record.true_distance_m);
  record.scrape_heading_rad = world_.scrapes().total_jump_rad();
  record.reflections = static_cast<double>(reflections_);
  record.stuck_noticed = static_cast<double>(stuck_noticed_);
  record.beyond_soil_law =
      monitor_.max_sinkage_m() > rover::LargestLawfulSinkage(params_.rover.geometry) ? 1.0 : 0.0;
  record.unconverged_balances = static_cast<double>(world_.rover().unconverged_balances());
  record.no_progress_distance_m = referee.no_progress_distance_m();
  record.no_progress_turn_deg = math::RadToDeg(referee.no_progress_turn_rad());
  record.layout = static_cast<double>(LayoutKey(params_, world_.key()).trial);
  record.rocks = static_cast<double>(world_.field().terrain.rocks().size());
  record.rock_cover = world_.field().audit.outline_cover;
}

void DriveObserver::ReportGoalRock(truth::DriveRecord& record) const {
  if (!goal_rock_) return;
  record.goal_rock_found = goal_rock_->found() ? 1.0 : 0.0;
  record.goal_rock_distance_m = goal_rock_->Distance_m(world_.state().X_WR);
  record.goal_rock_sign = static_cast<double>(goal_rock_->sign());
  record.goal_rock_recognized = recognized_ ? 1.0 : 0.0;
  const std::size_t reached = onboard_.navigator().reached();
  const std::size_t waypoints = told_places_.size() - 1;
  record.search_places_reached =
      reached > waypoints ? static_cast<double>(reached - waypoints) : 0.0;
}

void DriveObserver::ReportPlans(truth::DriveRecord& record) const {
  const navigation::PlanCounts counts = onboard_.navigator().plan_counts();
  record.plans_on_the_move = static_cast<double>(counts.plans);
  record.unsafe_plans = static_cast<double>(counts.unsafe);
  record.late_plans = static_cast<double>(counts.late);
  if (counts.started == 0) return;
  record.plan_start_error_m =
      std::sqrt(counts.start_error_squared_m2 / static_cast<double>(counts.started));
}

void DriveObserver::ReportHazards(truth::DriveRecord& record) const {
  using messages::VehicleHazardKind;
  record.hazards_met = static_cast<double>(watch_.met());
  record.hazards_missed = static_cast<double>(watch_.missed());
  record.contact_hazards = static_cast<double>(onboard_.guard().count(VehicleHazardKind::kContact));
  record.tilt_hazards = static_cast<double>(onboard_.guard().count(VehicleHazardKind::kTilt));
  record.articulation_hazards =
      static_cast<double>(onboard_.guard().count(VehicleHazardKind::kArticulation));
  record.safeguard_stops = static_cast<double>(onboard_.guard().stops());
  record.current_hazards =
      static_cast<double>(onboard_.guard().count(VehicleHazardKind::kMotorCurrent));
}

}  // namespace rockyard::trial
