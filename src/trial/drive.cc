#include "trial/drive.h"

#include <limits>
#include <string>
#include <utility>

#include "navigation/stuck_reaction.h"
#include "perception/tracked_feature.h"
#include "terrain/arena.h"
#include "trial/goal_designation.h"
#include "trial/layout.h"
#include "trial/make_estimator.h"
#include "trial/onboard_calibration.h"
#include "trial/route_planner.h"
#include "trial/tick_guard.h"

namespace rockyard::trial {
namespace {

using messages::MotionKind;

Underside UndersideOf(const rover::RoverGeometryParams& rover) {
  return {0.0, 0.5 * rover.belly_length_m, 0.5 * rover.belly_width_m, rover.belly_clearance_m};
}

// Open fields go on; every other arena ends where its layout ends.
std::optional<ArenaBounds> Bounds(const terrain::ArenaParams& arena) {
  if (arena.kind == terrain::ArenaKind::kOpen) return std::nullopt;
  const terrain::Rectangle bounds = terrain::DrivableBounds(arena);
  return ArenaBounds{bounds.x_min_m, bounds.x_max_m};
}

std::unique_ptr<navigation::Navigator> MakePathSelection(const DriveParams& drive,
                                                         const terrain::Terrain& terrain,
                                                         const messages::Goal& goal) {
  const navigation::NavigatorKind& chosen = drive.navigation.navigators.chosen();
  navigation::NavigatorSetup setup{.goal = goal, .judges_hazards = drive.perception.hazard.enabled};
  if (chosen.traits().follows_route) setup.route = PlanRoute(drive, terrain, goal);
  return chosen.Make(setup);
}

bool LooksForStuck(const DriveParams& drive) {
  return drive.navigation.on_board_stuck.reaction != navigation::StuckResponse::kOff;
}

std::unique_ptr<navigation::Navigator> MakeNavigator(const DriveParams& drive,
                                                     const terrain::Terrain& terrain,
                                                     const messages::Goal& goal) {
  std::unique_ptr<navigation::Navigator> navigator = MakePathSelection(drive, terrain, goal);
  if (!LooksForStuck(drive)) return navigator;
  return std::make_unique<navigation::StuckReaction>(drive.navigation.on_board_stuck,
                                                     std::move(navigator));
}

std::string Describe(perception::StuckSign sign) {
  return sign == perception::StuckSign::kNoTurn ? "stuck: no turn" : "stuck: strained motors";
}

std::unique_ptr<rover::Rover> MakeTrialRover(const DriveParams& drive, terrain::Terrain& terrain) {
  const terrain::RockFieldParams& rocks = drive.terrain.rocks;
  if (rocks.mobility == terrain::RockMobility::kFixed) {
    return rover::MakeRover(drive.rover, terrain);
  }
  return rover::MakeRover(drive.rover, rocks.holding, terrain);
}

// Where a navigator reads no report, hazards can neither be met nor missed.
double WatchedHeight(const DriveParams& drive) {
  return drive.navigation.navigators.chosen().traits().reads ==
                 navigation::LookReading::kHazardReport
             ? drive.referee.hazard_height_m
             : std::numeric_limits<double>::infinity();
}

Activity ActivityOf(const messages::MotionCommand& motion, bool steering) {
  if (steering) return Activity::kSteering;
  return motion.kind == MotionKind::kTurnInPlace ? Activity::kTurning : Activity::kDriving;
}

}  // namespace

Drive::Drive(const DriveParams& drive, core::TrialKey key, truth::Trace* trace,
             const ScanWatcher& scan_watcher, StepWatcher step_watcher)
    : params_(drive),
      key_(key),
      designated_goals_(DesignatedGoals(drive.course, key)),
      trace_(trace),
      field_(
          terrain::BuildField(drive.terrain, LayoutKey(drive, key), TerrainCourse(drive.course))),
      rover_(MakeTrialRover(drive, field_.terrain)),
      tick_(WholeSteps(1.0 / drive.clock.control_rate_hz, rover_->step_s())),
      stop_(WholeSteps(rover_->ramp_s() + drive.clock.stop_time_s, rover_->step_s())),
      terrain_sensing_(drive, key, scan_watcher),
      guard_(drive, key),
      navigator_(designated_goals_,
                 MakeNavigator(drive, field_.terrain, designated_goals_.front())),
      follower_(drive.rover.drive.speed_m_s, rover_->ramp_s()),
      wheel_driver_(OnboardDriveCalibration(drive.rover, drive.perception.calibration.drive),
                    drive.navigation.wheel_driver),
      ledger_(MakePowerBudget(drive), drive.energy.battery_wh),
      monitor_(UndersideOf(drive.rover.geometry), field_.terrain),
      watch_(KindOf(drive.sensors.terrain_sensor).reported_zone(drive), drive.rover.geometry,
             WatchedHeight(drive), field_.terrain),
      referee_(drive.referee, drive.course, designated_goals_.front(), Bounds(drive.terrain.arena),
               drive.rover.geometry.wheel_radius_m),
      step_watcher_(std::move(step_watcher)) {
  if (drive.terrain.arena.kind == terrain::ArenaKind::kVirtualReflected) {
    mirror_.emplace(drive.terrain.arena.MirrorLine());
  }
  if (trace_ != nullptr) RecordRocks();
  rover_->Place(drive.course.Start());
  motion_sensors_.emplace(drive.sensors.gyro, drive.sensors.encoders,
                          drive.rover.geometry.wheel_radius_m, key, rover_->state());
  if (LooksForStuck(drive)) {
    stuck_detector_.emplace(
        drive.perception.stuck_detector,
        OnboardDriveCalibration(drive.rover, drive.perception.calibration.drive));
  }
  if (drive.course.tracking.enabled) feature_tracker_.emplace(drive.course.tracking, key);
  monitor_.Restart(rover_->state());
  start_z_m_ = rover_->state().X_WR.translation().z();
  estimator_ = MakeEstimator(drive, *rover_);
  RecordRest({});
  Rest(Activity::kComputing, StartUpTime(drive));
}

DriveResult Drive::Run() {
  TickGuard guard(params_.referee.time_limit_s, tick_.duration_s);
  std::optional<Verdict> verdict;
  while (!verdict) {
    guard.Observe(ledger_.time_s());
    verdict = Tick();
  }
  return Finish(*verdict);
}

std::optional<Verdict> Drive::Tick() {
  TrackGoal();
  const std::size_t reached = navigator_.reached();
  const navigation::NavigatorDecision decision =
      navigator_.Decide({.time_s = ledger_.time_s(),
                         .estimate = pose(),
                         .attitude = estimator_->estimate().attitude,
                         .report = percept_.report ? &*percept_.report : nullptr,
                         .cloud = percept_.cloud ? &*percept_.cloud : nullptr,
                         .vehicle_hazard = guard_.hazard(),
                         .touches_behind = guard_.touches_behind(),
                         .notices_stuck = notices_stuck_});
  if (navigator_.reached() != reached) OnWaypoints(reached);
  if (!decision.looks()) ShowStep();
  percept_ = {};
  if (decision.status != navigation::NavigatorStatus::kDriving) {
    return referee_.OnNavigatorStop(decision.status, rover_->state(), ledger_.time_s());
  }
  if (decision.look) return Look(*decision.look);
  turns_.Observe(decision.motion);
  if (moves_.Observe(decision.motion)) SpendOverhead();
  return Follow(decision.motion);
}

std::optional<Verdict> Drive::Follow(const messages::MotionCommand& told) {
  const messages::MotionCommand motion =
      follower_.Follow(told, pose().distance_m, tick_.duration_s);
  if (motion.kind != MotionKind::kStop) return Move(motion, tick_);
  RestBetweenMoves(tick_.duration_s);
  return AskReferee(Activity::kOverhead, 0, tick_.duration_s);
}

void Drive::TrackGoal() {
  if (!feature_tracker_ || !navigator_.IsOnLastLeg()) return;
  const double time_s = ledger_.time_s();
  const auto number = static_cast<std::int64_t>(time_s / params_.course.tracking.period_s);
  if (number < next_sighting_) return;
  next_sighting_ = number + 1;
  const messages::Goal target = params_.course.GoalAt(time_s);
  const auto sighting = feature_tracker_->Observe(math::ToPose2(rover_->state().X_WR), target.x_m,
                                                  target.y_m, number);
  if (sighting.has_value() != sees_goal_) {
    Record("tracker", sighting ? "goal in view" : "goal out of view");
  }
  sees_goal_ = sighting.has_value();
  if (!sighting) return;
  const messages::Goal goal = perception::PlaceOf(*sighting, pose());
  navigator_.SetGoal(goal, navigation::GoalChange::kMoved);
  referee_.OnGoalMoved(goal);
}

void Drive::OnWaypoints(std::size_t first) {
  for (std::size_t i = first; i < navigator_.reached(); ++i) RecordWaypoint(i);
  referee_.OnNextGoal(navigator_.goal(), Observed(Activity::kDriving, 0, 0.0), ledger_.time_s());
}

std::optional<Verdict> Drive::Look(messages::LookDirection direction) {
  moves_.OnLook();
  if (auto verdict = Move({}, stop_)) return verdict;
  terrain_sensing_.Begin();
  do {
    percept_ = terrain_sensing_.Look(direction, field_.terrain, rover_->state().X_WR,
                                     estimator_->estimate().attitude);
    Rest(Activity::kScanning, percept_.time.scanning_s);
    Rest(Activity::kImaging, percept_.time.imaging_s);
    Rest(Activity::kComputing, percept_.time.computing_s);
    if (params_.sensors.gyro.accumulates_at_rest) UpdateEstimate(percept_.time.total_s(), false);
  } while (percept_.look_again);
  RecordLook(direction);
  const bool believed = percept_.report && percept_.report->any();
  hazards_.Observe(believed);
  if (believed) watch_.OnBelieved(rover_->state().X_WR);
  return AskReferee(Activity::kScanning, 0, percept_.time.total_s());
}

void Drive::SpendOverhead() {
  const double overhead_s = params_.clock.compute.move_overhead_s;
  if (overhead_s > 0.0) RestBetweenMoves(overhead_s);
}

void Drive::RestBetweenMoves(double duration_s) {
  // A rover that comes from another move brakes first.
  if (rolling_) Move({}, stop_);
  stops_.Observe(false);
  Rest(Activity::kOverhead, duration_s);
  if (params_.sensors.gyro.accumulates_at_rest) UpdateEstimate(duration_s, false);
}

std::optional<Verdict> Drive::Move(const messages::MotionCommand& motion, const Stretch& stretch) {
  const messages::WheelCommand command = wheel_driver_.Tick(motion, stretch.duration_s);
  const Activity activity = ActivityOf(motion, wheel_driver_.steering());
  const bool moving = motion.kind != MotionKind::kStop && !wheel_driver_.steering();
  rolling_ = moving;
  has_rolled_ = has_rolled_ || moving;
  stops_.Observe(moving);
  ApplyCommand(command, stretch.steps);
  const messages::MotionMeasurement measured = UpdateEstimate(stretch.duration_s, moving);
  ledger_.Spend(activity, stretch.duration_s);
  for (const auto& hazard : guard_.Feel(rover_->state(), command, measured)) {
    Record("felt", Describe(hazard));
  }
  NoticeStuck(command, measured);
  estimator_->Feel(guard_.measured(), stretch.duration_s);
  monitor_.Observe(rover_->state(), activity == Activity::kTurning);
  ObserveErrors();
  watch_.Observe(rover_->state().X_WR);
  Sample(activity);
  // Operators turn a rover whose position reaches the line; one that turns in place stays its own
  // master, also beyond the line.
  if (motion.kind == MotionKind::kArc) ReflectAtMirrorLine(motion.direction);
  if (motion.kind == MotionKind::kStop) return std::nullopt;
  return AskReferee(activity, motion.direction, stretch.duration_s);
}

void Drive::ApplyCommand(const messages::WheelCommand& command, std::int64_t steps) {
  const double step_s = rover_->step_s();
  for (std::int64_t i = 0; i < steps; ++i) {
    rover_->Step(command);
    guard_.Observe(rover_->state());
    const std::int64_t before = motion_sensors_->scrapes().episodes();
    motion_sensors_->Observe(rover_->state(),
                             ledger_.time_s() + static_cast<double>(i + 1) * step_s);
    if (motion_sensors_->scrapes().episodes() == before) continue;
    if (!first_scrape_m_) first_scrape_m_ = monitor_.distance_m();
    Record("scrape", "");
  }
}

messages::MotionMeasurement Drive::UpdateEstimate(double duration_s, bool moving) {
  const messages::MotionMeasurement motion =
      motion_sensors_->Measure(rover_->state(), duration_s, moving);
  estimator_->Propagate(motion);
  return motion;
}

void Drive::NoticeStuck(const messages::WheelCommand& command,
                        const messages::MotionMeasurement& motion) {
  if (!stuck_detector_) return;
  const auto sign = stuck_detector_->Observe(command, motion, guard_.measured());
  notices_stuck_ = sign.has_value();
  if (!sign) return;
  ++stuck_noticed_;
  Record("felt", Describe(*sign));
}

void Drive::ObserveErrors() {
  const messages::PoseEstimate& estimate = pose();
  const double heading_rad = math::Heading(rover_->state().X_WR);
  const double distance_m = monitor_.distance_m();
  heading_growth_.Observe(distance_m,
                          math::RadToDeg(math::WrapAngle(estimate.heading_rad - heading_rad)));
  distance_growth_.Observe(distance_m, estimate.distance_m - distance_m);
}

void Drive::ReflectAtMirrorLine(int direction) {
  if (!mirror_ || !has_rolled_ || !mirror_->Reaches(rover_->state().X_WR.translation().y())) return;
  const messages::PoseEstimate before = pose();
  const auto reflection = mirror_->Reflect(math::ToPose2(rover_->state().X_WR), direction, before);
  if (!reflection) return;
  has_rolled_ = false;
  ++reflections_;
  Record("reflection", "");
  rover_->Place(reflection->pose);
  wheel_driver_.Straighten();
  estimator_->Place(reflection->update);
  motion_sensors_->Restart(rover_->state());
  guard_.Restart(rover_->state());
  if (stuck_detector_) stuck_detector_->Restart();
  notices_stuck_ = false;
  monitor_.Restart(rover_->state());
  referee_.OnReflection(rover_->state(), reflection->line_m);
  navigator_.OnPoseUpdate(before, pose());
  RecordRest({}, true);
}

Observation Drive::Observed(Activity activity, int direction, double duration_s) const {
  return {activity,
          direction,
          duration_s,
          rover_->state(),
          pose(),
          monitor_.distance_m(),
          monitor_.turned_in_place_rad()};
}

std::optional<Verdict> Drive::AskReferee(Activity activity, int direction, double duration_s) {
  return referee_.Observe(Observed(activity, direction, duration_s), ledger_);
}

void Drive::Strand() {
  stall_ = ledger_.StallUntilEmpty();
  if (params_.referee.stuck_rover == StuckRover::kEnd) return RecordRest({});
  ledger_.Spend(Activity::kStalled, stall_.time_s);
  RecordRest(Activity::kStalled);
}

DriveResult Drive::Finish(const Verdict& verdict) {
  if (truth::IsStuck(verdict.outcome)) {
    Strand();
  } else {
    RecordRest({});
  }
  Record("end", verdict.detail);

  DriveResult result{verdict.outcome, verdict.detail, {}};
  monitor_.Report(result.record);
  if (truth::DeclaredSuccess(verdict.outcome) && result.record.displacement_m > 0.0) {
    result.record.path_ratio = result.record.true_distance_m / result.record.displacement_m;
  }
  ReportGoals(result.record);
  ReportPoses(result.record);
  ReportErrors(result.record);
  ReportLedger(result.record);
  ReportCounts(result.record);
  ReportHazards(result.record);
  return result;
}

DriveResult RunTrial(const DriveParams& drive, core::TrialKey key, truth::Trace* trace,
                     const ScanWatcher& scan_watcher, const StepWatcher& step_watcher) {
  return Drive(drive, key, trace, scan_watcher, step_watcher).Run();
}

}  // namespace rockyard::trial
