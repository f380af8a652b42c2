#include "trial/drive/drive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "localization/dead_reckoning.h"
#include "terrain/arena.h"
#include "trial/clock/compute_profile.h"
#include "trial/course/goal_designation.h"
#include "trial/drive/make_estimator.h"
#include "trial/drive/make_navigator.h"
#include "trial/drive/overlay_teller.h"
#include "trial/drive/tick_guard.h"

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

// Returns where the arena ends; nothing for an open field, which goes on.
std::optional<ArenaBounds> Bounds(const terrain::ArenaParams& arena) {
  if (arena.kind == terrain::ArenaKind::kOpen) return std::nullopt;
  const terrain::Rectangle bounds = terrain::DrivableBounds(arena);
  return ArenaBounds{bounds.x_min_m, bounds.x_max_m};
}

truth::EndCause CauseOf(navigation::FaultKind kind) {
  using enum navigation::FaultKind;
  switch (kind) {
    case kThrew:
      return truth::EndCause::kNavigatorThrew;
    case kNonsense:
      return truth::EndCause::kNavigatorNonsense;
    case kMessage:
      return truth::EndCause::kNavigatorMessage;
    case kEnded:
      return truth::EndCause::kNavigatorEnded;
    case kCpuTime:
      return truth::EndCause::kNavigatorCpuTime;
    case kMemory:
      return truth::EndCause::kNavigatorMemory;
    case kSilent:
      return truth::EndCause::kNavigatorSilent;
  }
  return truth::EndCause::kNavigatorThrew;
}

}  // namespace

Stretch WholeSteps(double asked_s, double step_s) {
  const std::int64_t steps = std::max<std::int64_t>(1, std::llround(asked_s / step_s));
  return {steps, static_cast<double>(steps) * step_s};
}

Drive::Drive(const DriveParams& drive, core::TrialKey key, truth::Trace* trace,
             const Watchers& watchers, const DriveStart* start)
    : params_(drive),
      world_(drive, key, start != nullptr ? &start->field : nullptr),
      tick_(WholeSteps(1.0 / drive.clock.control_rate_hz, world_.step_s())),
      stop_(WholeSteps(world_.ramp_s() + drive.clock.stop_time_s, world_.step_s())),
      told_places_(ToldPlaces(drive, world_.field().terrain, key)),
      onboard_(drive, key, told_places_,
               MakeNavigator(drive, world_.field().terrain, key, told_places_, tick_.duration_s,
                             TellsOverlays(watchers.overlay, world_),
                             watchers.navigator_use
                                 ? std::bind_front(watchers.navigator_use, key)
                                 : std::function<void(const messages::NavigatorUse&)>()),
               world_.ramp_s(), WithTruth(watchers, world_)),
      ledger_(MakePowerBudget(drive), drive.energy.battery_wh,
              start != nullptr ? start->sun : std::nullopt),
      timeline_(drive.clock.overlap, ledger_),
      operators_(world_, onboard_),
      referee_(drive.referee, drive.course, told_places_.front(), Bounds(drive.terrain.arena),
               drive.rover.geometry.wheel_radius_m),
      observer_(world_, onboard_, ledger_, told_places_),
      tracer_(world_, onboard_, ledger_, told_places_, trace),
      step_watcher_(watchers.step) {
  world_.Begin();
  const localization::EstimatorMemory* memory = start != nullptr ? &start->memory : nullptr;
  try {
    onboard_.Begin(MakeEstimator(drive, world_.rover(), memory));
  } catch (const navigation::NavigatorFault&) {
    // There is no drive yet that could end by it. The record needs a belief.
    failed_start_ = std::current_exception();
    onboard_.Begin(
        std::make_unique<localization::DeadReckoningEstimator>(EstimatorSetupOf(drive, memory)));
  }
  observer_.OnPlaced();
  tracer_.Rest({});
  Rest(Activity::kComputing, StartUpTime(drive));
}

std::optional<Verdict> Drive::Step() {
  if (failed_start_) std::rethrow_exception(failed_start_);
  if (onboard_.EndsBySlip()) return Verdict{truth::EndCause::kExcessiveSlip};
  if (onboard_.SeesMotionNow(time_s())) return SeeMotion();
  TrackGoal();
  if (!seen_) seen_ = timeline_.TakeReady();
  const Decided decided = onboard_.Decide(time_s(), seen_.get());
  const navigation::NavigatorDecision& decision = decided.decision;
  if (decided.passed > 0) OnWaypoints(decided.passed);
  if (!decision.stops_to_look()) ShowStep();
  seen_.reset();
  if (decision.status != navigation::NavigatorStatus::kDriving) {
    // If the navigator gives up because of a slip alarm, the cause is slip.
    const bool arrived = decision.status == navigation::NavigatorStatus::kArrived;
    if (decided.told_slip && !arrived) return Verdict{truth::EndCause::kExcessiveSlip};
    return referee_.OnNavigatorStop(decision.status, world_.state(), time_s());
  }
  if (auto verdict = SpendOnDecision(decision.work_ops)) return verdict;
  if (decision.looks()) {
    if (!LooksOnTheMove(decision)) return Look(*decision.look);
    if (auto verdict = LookOnTheMove(*decision.look)) return verdict;
  }
  if (observer_.OnMotion(decision.motion)) SpendOverhead();
  return Follow(decision.motion);
}

std::optional<Verdict> Drive::SpendOnDecision(double work_ops) {
  const double rate_per_s = params_.clock.compute.operations_per_s;
  if (work_ops <= 0.0 || rate_per_s <= 0.0) return std::nullopt;
  const double time_s = work_ops / rate_per_s;
  if (params_.clock.overlap.computing) {
    ledger_.SpendBeside(Activity::kComputing, time_s);
    return std::nullopt;
  }
  return RestFor({Activity::kComputing, time_s});
}

std::optional<Verdict> Drive::Follow(const messages::MotionCommand& told) {
  if (const auto rest = timeline_.MustRest()) return RestFor(*rest);
  const messages::MotionCommand motion = onboard_.Follow(told, tick_.duration_s);
  if (motion.kind != MotionKind::kStop) return Move(motion, tick_);
  RestBetweenMoves(tick_.duration_s);
  return AskReferee(Activity::kOverhead, 0, tick_.duration_s);
}

void Drive::TrackGoal() {
  const bool rock = params_.course.goal_rock.enabled;
  if (!world_.tracks_goal() || (!rock && !onboard_.navigator().IsOnLastLeg())) return;
  const std::optional<GoalLook> look = world_.LookForGoal(time_s());
  if (!look) return;
  const bool sees = look->sighting.has_value();
  if (rock && sees && !sees_goal_) {
    tracer_.Event("tracker", "goal rock recognized");
    observer_.OnRecognized();
  }
  if (!rock && sees != sees_goal_) {
    tracer_.Event("tracker", sees ? "goal in view" : "goal out of view");
  }
  sees_goal_ = sees || (rock && sees_goal_);
  if (sees) referee_.OnGoalMoved(onboard_.TakeSighting(*look->sighting, rock));
}

void Drive::OnWaypoints(std::size_t passed) {
  const std::size_t reached = onboard_.navigator().reached();
  for (std::size_t i = reached - passed; i < reached; ++i) tracer_.Waypoint(i);
  referee_.OnNextGoal(onboard_.navigator().goal(), observer_.Observed(Activity::kDriving, 0, 0.0),
                      time_s());
}

void Drive::Rest(Activity activity, double duration_s) {
  timeline_.Pass(activity, duration_s);
  if (duration_s > 0.0) tracer_.Rest(activity);
}

void Drive::SpendOverhead() {
  const double overhead_s = params_.clock.compute.move_overhead_s;
  if (overhead_s > 0.0) RestBetweenMoves(overhead_s);
}

void Drive::RestBetweenMoves(double duration_s) {
  // A rover that comes from another move brakes first.
  if (rolling_) Move({}, stop_);
  Rest(Activity::kOverhead, duration_s);
  PropagateAtRest(duration_s);
}

std::optional<Verdict> Drive::Move(const messages::MotionCommand& motion, const Stretch& stretch) {
  const messages::WheelCommand command = onboard_.Drive(motion, stretch.duration_s);
  const bool steering = onboard_.wheel_driver().steering();
  const Activity activity = ActivityOf(motion, steering);
  rolling_ = motion.kind != MotionKind::kStop && !steering;
  operators_.OnWheels(rolling_);
  observer_.OnWheels(rolling_);
  ApplyCommand(command, stretch.steps);
  const messages::MotionMeasurement measured = Propagate(stretch.duration_s, rolling_);
  timeline_.Pass(activity, stretch.duration_s);
  if (params_.clock.overlap.steering) {
    ledger_.SpendBeside(Activity::kSteering, onboard_.wheel_driver().steered_s());
  }
  const messages::VehicleState felt = world_.Feel(command, measured.duration_s);
  for (const auto& hazard : onboard_.Feel(felt, command, measured)) {
    tracer_.Event("felt", Describe(hazard));
  }
  if (const auto sign = onboard_.NoticeStuck(command, measured)) {
    observer_.OnStuckNoticed();
    tracer_.Event("felt", Describe(*sign));
  }
  onboard_.FeelStance(stretch.duration_s);
  UseAids();
  observer_.OnTick(activity == Activity::kTurning);
  tracer_.Sample(activity);
  // Operators turn a rover whose position reaches a mirror line, but not a rover that turns in
  // place, also beyond the line.
  if (motion.kind == MotionKind::kArc) ReflectAtMirrorLine(motion.direction);
  if (motion.kind == MotionKind::kStop) return std::nullopt;
  return AskReferee(activity, motion.direction, stretch.duration_s);
}

void Drive::ApplyCommand(const messages::WheelCommand& command, std::int64_t steps) {
  for (std::int64_t i = 0; i < steps; ++i) {
    const double end_s = time_s() + static_cast<double>(i + 1) * world_.step_s();
    if (!world_.Step(command, end_s)) continue;
    observer_.OnScrape();
    tracer_.Event("scrape", "");
  }
}

messages::MotionMeasurement Drive::Propagate(double duration_s, bool moving) {
  const messages::MotionMeasurement motion = world_.MeasureMotion(duration_s, moving);
  onboard_.Propagate(motion);
  return motion;
}

void Drive::PropagateAtRest(double duration_s) {
  if (params_.sensors.gyro.accumulates_at_rest) Propagate(duration_s, false);
}

void Drive::UseAids() {
  const AidRequest request = onboard_.DueAids(time_s());
  const AidNews news = onboard_.TakeAids(request, world_.AskAids(request, time_s()), time_s());
  if (news.saw_motion) observer_.OnSeenMotion();
  if (!news.slip) return;
  observer_.OnSlip(*news.slip);
  const perception::MeasuredSlip& seen = news.slip->seen;
  if (!seen.exceeded) return;
  world_.RenewEyes();
  tracer_.Event("slip",
                fmt::format("{:.0f} % +- {:.0f} % of the way", 100.0 * seen.slip, 100.0 * seen.sd));
}

void Drive::ReflectAtMirrorLine(int direction) {
  const auto reflection = operators_.Reflect(direction);
  if (!reflection) return;
  // Looks under way show what lay around a rover that stood elsewhere.
  timeline_.Drop();
  observer_.OnReflection();
  tracer_.Event("reflection", "");
  world_.Place(reflection->pose);
  onboard_.Place(reflection->update);
  observer_.OnPlaced();
  referee_.OnReflection(world_.state(), reflection->line_m);
  tracer_.Rest({}, true);
}

std::optional<Verdict> Drive::AskReferee(Activity activity, int direction, double duration_s) {
  if (observer_.FoundRock()) return Verdict{truth::EndCause::kFoundRock};
  return referee_.Observe(observer_.Observed(activity, direction, duration_s), ledger_);
}

void Drive::Strand() {
  stall_ = ledger_.StallUntilEmpty();
  if (params_.referee.stuck_rover == StuckRover::kEnd) return tracer_.Rest({});
  ledger_.Spend(Activity::kStalled, stall_.time_s);
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
  return {end.outcome,
          std::string(end.sentence),
          {},
          observer_.Report(truth::DeclaredSuccess(end.outcome), stall_, referee_),
          observer_.End()};
}

DriveResult Drive::Finish(const navigation::NavigatorFault& fault) {
  DriveResult result = Finish(Verdict{CauseOf(fault.kind())});
  result.detail += fmt::format(": {}", fault.what());
  tracer_.Event("end", fault.what());
  return result;
}

namespace {

DriveResult RunToEnd(Drive& drive, const DriveParams& params, bool last_attempt) {
  TickGuard guard(params.referee.time_limit_s, drive.tick_s());
  std::optional<Verdict> verdict;
  OnboardEnd end;
  try {
    while (!verdict) {
      guard.Observe(drive.time_s());
      verdict = drive.Step();
    }
    end = drive.AtEnd();
  } catch (const navigation::NavigatorFault& fault) {
    if (fault.may_be_the_machine() && !last_attempt) throw;
    return drive.Finish(fault);
  } catch (const DriveWithoutEnd& fault) {
    if (!params.navigation.navigators.chosen().foreign()) throw;
    return drive.Finish(navigation::NavigatorFault(navigation::FaultKind::kNonsense, fault.what()));
  }
  DriveResult result = drive.Finish(*verdict);
  result.own_values = std::move(end.own_values);
  result.end.memory = end.memory;
  return result;
}

// Drives, and once more where the machine may be to blame for what a navigator or estimator did.
// `make(attempt)` returns a drive at its start.
template <typename Make>
DriveResult RunTwiceAtMost(const DriveParams& params, const Make& make) {
  try {
    return RunToEnd(*make(), params, false);
  } catch (const navigation::NavigatorFault&) {
    return RunToEnd(*make(), params, true);
  }
}

}  // namespace

DriveParams ShareTables(DriveParams drive) {
  drive.rover.made_wheel = std::make_shared<rover::WheelOnSoil>(
      rover::MakeWheelOnSoil(drive.rover, drive.terrain.ground.soil));
  return drive;
}

DriveResult RunTrial(const DriveParams& params, core::TrialKey key, truth::Trace* trace,
                     const Watchers& watchers) {
  return RunTwiceAtMost(params, [&] {
    if (trace != nullptr) *trace = {};
    if (watchers.begin) watchers.begin();
    return std::make_unique<Drive>(params, key, trace, watchers);
  });
}

DriveResult RunTrial(const DriveParams& params, core::TrialKey key, const DriveStart& start) {
  return RunTwiceAtMost(
      params, [&] { return std::make_unique<Drive>(params, key, nullptr, Watchers{}, &start); });
}

}  // namespace rockyard::trial
