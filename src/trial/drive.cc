#include "trial/drive.h"

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <utility>

#include "perception/tracked_feature.h"
#include "trial/belief.h"
#include "trial/look_time.h"
#include "trial/onboard_calibration.h"
#include "trial/tick_guard.h"

namespace rockyard::trial {
namespace {

using messages::MotionKind;

std::string Describe(perception::StuckSign sign) {
  return sign == perception::StuckSign::kNoTurn ? "stuck: no turn" : "stuck: strained motors";
}

Activity ActivityOf(const messages::MotionCommand& motion, bool steering) {
  if (steering) return Activity::kSteering;
  return motion.kind == MotionKind::kTurnInPlace ? Activity::kTurning : Activity::kDriving;
}

}  // namespace

Drive::Drive(const DriveParams& drive, core::TrialKey key, truth::Trace* trace,
             const Watchers& watchers, const DriveStart* start)
    : parts_(drive, key, watchers, start),
      observer_(parts_),
      tracer_(parts_, trace),
      step_watcher_(watchers.step),
      slip_alarms_(drive.navigation.on_slip) {
  parts_.Begin();
  observer_.OnPlaced();
  tracer_.Rest({});
  Rest(Activity::kComputing, StartUpTime(drive));
}

DriveResult Drive::Run() {
  TickGuard guard(parts_.params.referee.time_limit_s, parts_.tick.duration_s);
  std::optional<Verdict> verdict;
  while (!verdict) {
    guard.Observe(parts_.ledger.time_s());
    verdict = Tick();
  }
  return Finish(*verdict);
}

std::optional<Verdict> Drive::Tick() {
  if (slip_alarms_.EndsDrive()) return Verdict{truth::EndCause::kExcessiveSlip};
  if (parts_.vision.IsDue(parts_.estimate(), parts_.ledger.time_s())) return SeeMotion();
  TrackGoal();
  if (!seen_) seen_ = parts_.timeline.TakeReady();
  const std::size_t reached = parts_.navigator.reached();
  const std::optional<ToldSlip> slip = slip_alarms_.Take();
  const navigation::NavigatorDecision decision = parts_.navigator.Decide(
      {.time_s = parts_.ledger.time_s(),
       .estimate = parts_.estimate().pose,
       .attitude = parts_.estimate().attitude,
       .odometry = parts_.estimate().odometry,
       .report = seen_ ? seen_->report() : nullptr,
       .cloud = seen_ ? seen_->cloud() : nullptr,
       .look = seen_ ? &seen_->moment : nullptr,
       .vehicle_hazard = slip && slip->hazard ? &*slip->hazard : parts_.guard.hazard(),
       .touches_behind = parts_.guard.touches_behind(),
       .notices_stuck = notices_stuck_ || (slip && slip->as_stuck)});
  if (parts_.navigator.reached() != reached) OnWaypoints(reached);
  if (!decision.stops_to_look()) ShowStep();
  seen_.reset();
  if (decision.status != navigation::NavigatorStatus::kDriving) {
    // Who gives up by what it was just told does so for the slip.
    const bool arrived = decision.status == navigation::NavigatorStatus::kArrived;
    if (slip && !arrived) return Verdict{truth::EndCause::kExcessiveSlip};
    return parts_.referee.OnNavigatorStop(decision.status, parts_.state(), parts_.ledger.time_s());
  }
  if (decision.looks()) {
    if (!LooksOnTheMove(decision)) return Look(*decision.look);
    if (auto verdict = LookOnTheMove(*decision.look)) return verdict;
  }
  if (observer_.OnMotion(decision.motion)) SpendOverhead();
  return Follow(decision.motion);
}

std::optional<Verdict> Drive::Follow(const messages::MotionCommand& told) {
  if (const auto rest = parts_.timeline.MustRest()) return RestFor(*rest);
  const messages::MotionCommand motion =
      parts_.follower.Follow(told, parts_.estimate().pose.distance_m, parts_.tick.duration_s);
  if (motion.kind != MotionKind::kStop) return Move(motion, parts_.tick);
  RestBetweenMoves(parts_.tick.duration_s);
  return AskReferee(Activity::kOverhead, 0, parts_.tick.duration_s);
}

std::optional<std::int64_t> Drive::NextSighting() {
  const auto number =
      static_cast<std::int64_t>(parts_.ledger.time_s() / parts_.params.course.tracking.period_s);
  if (number < next_sighting_) return std::nullopt;
  next_sighting_ = number + 1;
  return number;
}

void Drive::TrackGoal() {
  if (!parts_.feature_tracker) return;
  if (parts_.goal_rock) return RecognizeRock();
  if (!parts_.navigator.IsOnLastLeg()) return;
  const auto number = NextSighting();
  if (!number) return;
  const messages::Goal target = parts_.params.course.GoalAt(parts_.ledger.time_s());
  const auto sighting = parts_.feature_tracker->Observe(math::ToPose2(parts_.state().X_WR),
                                                        target.x_m, target.y_m, *number);
  if (sighting.has_value() != sees_goal_) {
    tracer_.Event("tracker", sighting ? "goal in view" : "goal out of view");
  }
  sees_goal_ = sighting.has_value();
  if (!sighting) return;
  const messages::Goal goal = perception::PlaceOf(*sighting, parts_.estimate().pose);
  parts_.navigator.SetGoal(goal, navigation::GoalChange::kMoved);
  parts_.referee.OnGoalMoved(goal);
}

void Drive::RecognizeRock() {
  const auto number = NextSighting();
  if (!number) return;
  const math::Transform& X_WR = parts_.state().X_WR;
  if (parts_.goal_rock->FrontDistance_m(X_WR) > parts_.params.course.goal_rock.recognition_m) {
    return;
  }
  const math::Vector3 center_W = parts_.goal_rock->center_W();
  const auto sighting =
      parts_.feature_tracker->Observe(math::ToPose2(X_WR), center_W.x(), center_W.y(), *number);
  if (!sighting) return;
  if (!recognized_rock_) {
    tracer_.Event("tracker", "goal rock recognized");
    observer_.OnRecognized();
  }
  recognized_rock_ = true;
  const messages::Goal goal = perception::PlaceOf(*sighting, parts_.estimate().pose);
  parts_.navigator.DriveTo(goal);
  parts_.referee.OnGoalMoved(goal);
}

std::optional<Verdict> Drive::FindRock() {
  if (!parts_.goal_rock) return std::nullopt;
  parts_.goal_rock->Observe(parts_.state());
  if (!parts_.goal_rock->found()) return std::nullopt;
  return Verdict{truth::EndCause::kFoundRock};
}

void Drive::OnWaypoints(std::size_t first) {
  for (std::size_t i = first; i < parts_.navigator.reached(); ++i) tracer_.Waypoint(i);
  parts_.referee.OnNextGoal(parts_.navigator.goal(), Observed(Activity::kDriving, 0, 0.0),
                            parts_.ledger.time_s());
}

void Drive::Rest(Activity activity, double duration_s) {
  parts_.timeline.Pass(activity, duration_s);
  if (duration_s > 0.0) tracer_.Rest(activity);
}

void Drive::SpendOverhead() {
  const double overhead_s = parts_.params.clock.compute.move_overhead_s;
  if (overhead_s > 0.0) RestBetweenMoves(overhead_s);
}

void Drive::RestBetweenMoves(double duration_s) {
  // A rover that comes from another move brakes first.
  if (rolling_) Move({}, parts_.stop);
  Rest(Activity::kOverhead, duration_s);
  UpdateEstimateAtRest(duration_s);
}

std::optional<Verdict> Drive::Move(const messages::MotionCommand& motion, const Stretch& stretch) {
  const messages::WheelCommand command = parts_.wheel_driver.Tick(motion, stretch.duration_s);
  const Activity activity = ActivityOf(motion, parts_.wheel_driver.steering());
  const bool moving = motion.kind != MotionKind::kStop && !parts_.wheel_driver.steering();
  rolling_ = moving;
  has_rolled_ = has_rolled_ || moving;
  observer_.OnWheels(moving);
  ApplyCommand(command, stretch.steps);
  const messages::MotionMeasurement measured = UpdateEstimate(stretch.duration_s, moving);
  parts_.timeline.Pass(activity, stretch.duration_s);
  if (parts_.params.clock.overlap.steering) {
    parts_.ledger.SpendBeside(Activity::kSteering, parts_.wheel_driver.steered_s());
  }
  for (const auto& hazard : parts_.guard.Feel(parts_.state(), command, measured)) {
    tracer_.Event("felt", Describe(hazard));
  }
  NoticeStuck(command, measured);
  parts_.estimator->Feel(parts_.guard.measured(), stretch.duration_s);
  UseAids();
  observer_.OnTick(activity == Activity::kTurning);
  tracer_.Sample(activity);
  // Operators turn a rover whose position reaches the line; one that turns in place stays its own
  // master, also beyond the line.
  if (motion.kind == MotionKind::kArc) ReflectAtMirrorLine(motion.direction);
  if (motion.kind == MotionKind::kStop) return std::nullopt;
  return AskReferee(activity, motion.direction, stretch.duration_s);
}

void Drive::ApplyCommand(const messages::WheelCommand& command, std::int64_t steps) {
  const double step_s = parts_.rover->step_s();
  for (std::int64_t i = 0; i < steps; ++i) {
    parts_.rover->Step(command);
    parts_.guard.Observe(parts_.state());
    const std::int64_t before = parts_.motion_sensors->scrapes().episodes();
    parts_.motion_sensors->Observe(parts_.state(),
                                   parts_.ledger.time_s() + static_cast<double>(i + 1) * step_s);
    if (parts_.motion_sensors->scrapes().episodes() == before) continue;
    observer_.OnScrape();
    tracer_.Event("scrape", "");
  }
}

messages::MotionMeasurement Drive::UpdateEstimate(double duration_s, bool moving) {
  const messages::MotionMeasurement motion =
      parts_.motion_sensors->Measure(parts_.state(), duration_s, moving);
  parts_.estimator->Propagate(motion);
  return motion;
}

void Drive::UseAids() {
  const messages::PoseEstimate before = parts_.estimate().pose;
  const bool fixed =
      parts_.aids.Tick(parts_.state().X_WR, parts_.ledger.time_s(), *parts_.estimator);
  const bool seen = parts_.vision.Tick(parts_.ledger.time_s(), *parts_.estimator);
  if (seen) observer_.OnSeenMotion();
  if (fixed || seen) parts_.navigator.OnCorrection(before, parts_.estimate().pose);
  const std::optional<SlipReading> slip = parts_.vision.TakeSlip();
  if (!slip) return;
  observer_.OnSlip(*slip);
  if (!slip->seen.exceeded) return;
  slip_alarms_.Raise();
  parts_.vision.BeginAnew(*parts_.estimator);
  tracer_.Event("slip", fmt::format("{:.0f} % +- {:.0f} % of the way", 100.0 * slip->seen.slip,
                                    100.0 * slip->seen.sd));
}

void Drive::UpdateEstimateAtRest(double duration_s) {
  if (parts_.params.sensors.gyro.accumulates_at_rest) UpdateEstimate(duration_s, false);
}

void Drive::NoticeStuck(const messages::WheelCommand& command,
                        const messages::MotionMeasurement& motion) {
  if (!parts_.stuck_detector) return;
  const auto sign = parts_.stuck_detector->Observe(command, motion, parts_.guard.measured());
  notices_stuck_ = sign.has_value();
  if (!sign) return;
  observer_.OnStuckNoticed();
  tracer_.Event("felt", Describe(*sign));
}

void Drive::ReflectAtMirrorLine(int direction) {
  const double y_m = parts_.state().X_WR.translation().y();
  if (!parts_.mirror || !has_rolled_ || !parts_.mirror->Reaches(y_m)) return;
  const messages::PoseEstimate before = parts_.estimate().pose;
  const auto reflection = parts_.mirror->Reflect(math::ToPose2(parts_.state().X_WR), direction,
                                                 WorldPose(parts_.estimate()));
  if (!reflection) return;
  has_rolled_ = false;
  // What it saw lay around a rover that stood elsewhere.
  parts_.timeline.Drop();
  observer_.OnReflection();
  tracer_.Event("reflection", "");
  parts_.rover->Place(reflection->pose);
  parts_.wheel_driver.Straighten();
  parts_.estimator->Place(reflection->update);
  parts_.aids.OnPlaced();
  parts_.vision.OnPlaced();
  parts_.motion_sensors->Restart(parts_.state());
  parts_.guard.Restart(parts_.state());
  if (parts_.stuck_detector) parts_.stuck_detector->Restart();
  notices_stuck_ = false;
  slip_alarms_.Drop();
  observer_.OnPlaced();
  parts_.referee.OnReflection(parts_.state(), reflection->line_m);
  parts_.navigator.OnPoseUpdate(before, parts_.estimate().pose);
  tracer_.Rest({}, true);
}

Observation Drive::Observed(Activity activity, int direction, double duration_s) const {
  return {activity,
          direction,
          duration_s,
          parts_.state(),
          parts_.estimate().pose,
          observer_.distance_m(),
          observer_.turned_in_place_rad()};
}

std::optional<Verdict> Drive::AskReferee(Activity activity, int direction, double duration_s) {
  if (auto verdict = FindRock()) return verdict;
  return parts_.referee.Observe(Observed(activity, direction, duration_s), parts_.ledger);
}

void Drive::Strand() {
  stall_ = parts_.ledger.StallUntilEmpty();
  if (parts_.params.referee.stuck_rover == StuckRover::kEnd) return tracer_.Rest({});
  parts_.ledger.Spend(Activity::kStalled, stall_.time_s);
  tracer_.Rest(Activity::kStalled);
}

DriveResult Drive::Finish(const Verdict& verdict) {
  if (truth::IsStuck(verdict.outcome())) {
    Strand();
  } else {
    tracer_.Rest({});
  }
  const truth::EndCauseInfo& end = truth::Info(verdict.cause);
  tracer_.Event("end", std::string(end.sentence));
  return {end.outcome, std::string(end.sentence),
          observer_.Report(truth::DeclaredSuccess(end.outcome), stall_), End()};
}

DriveEnd Drive::End() const {
  DriveEnd end{.X_WR = parts_.state().X_WR,
               .memory = parts_.estimator->Remember(),
               .battery_wh = parts_.ledger.battery_drawn_wh()};
  for (std::size_t i = 0; i < kActivityCount; ++i) {
    end.energy_wh[i] = parts_.ledger.energy_wh(static_cast<Activity>(i));
  }
  return end;
}

DriveResult RunTrial(const DriveParams& drive, core::TrialKey key, truth::Trace* trace,
                     const Watchers& watchers) {
  return Drive(drive, key, trace, watchers).Run();
}

DriveResult RunTrial(const DriveParams& drive, core::TrialKey key, const DriveStart& start) {
  return Drive(drive, key, nullptr, {}, &start).Run();
}

}  // namespace rockyard::trial
