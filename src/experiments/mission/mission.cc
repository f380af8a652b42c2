#include "experiments/mission/mission.h"

#include <algorithm>
#include <memory>
#include <numbers>
#include <utility>

#include "core/check.h"
#include "experiments/mission/sol.h"
#include "localization/estimator.h"
#include "math/angles.h"
#include "math/functions.h"
#include "math/sun_position.h"
#include "terrain/arena.h"
#include "trial/clock/power.h"
#include "trial/counters/drive_monitor.h"
#include "trial/course/goal_designation.h"
#include "trial/course/layout.h"
#include "trial/drive/make_estimator.h"
#include "truth/end_cause.h"

namespace rockyard::experiments {
namespace {

constexpr double kSecondsPerSolarHour = math::kSolOfMars_s / 24.0;
constexpr double kNoon_h = 12.0;
// A window in which the sun alone has to carry the drive ends so far from the moments at which the
// sun just does.
constexpr double kSunMargin_s = 1.0;
// Most times that operators tell a filter the same fix: more than any gate's patience that makes
// sense.
constexpr int kInsistence = 100;

// Returns the true solar time at which the window opens.
double WindowOpening_h(const MissionDayParams& day) {
  return kNoon_h - 0.5 * day.Window_s() / kSecondsPerSolarHour;
}

// Returns the most that an activity of a drive draws, W.
double LargestLoad_W(const trial::DriveParams& drive) {
  const trial::PowerBudget budget = trial::MakePowerBudget(drive);
  double largest_W = 0.0;
  for (std::size_t i = 0; i < trial::kActivityCount; ++i) {
    largest_W = std::max(largest_W, budget.Power(static_cast<trial::Activity>(i)));
  }
  return largest_W;
}

// Returns the course of all sols: rocks keep clear of the start and of every goal.
terrain::Course CourseOf(const trial::DriveParams& drive,
                         const std::vector<messages::Goal>& goals) {
  terrain::Course course{.start_x_m = drive.course.start_x_m,
                         .start_y_m = drive.course.start_y_m,
                         .goal_x_m = goals.back().x_m,
                         .goal_y_m = goals.back().y_m};
  for (std::size_t i = 0; i + 1 < goals.size(); ++i) {
    course.waypoints.push_back({goals[i].x_m, goals[i].y_m});
  }
  return course;
}

sensing::LanderFix LanderOf(const MissionParams& params, const trial::DriveParams& drive,
                            double pan_error_rad, core::TrialKey key) {
  const sensing::LanderFixParams& fix = drive.sensors.aids.lander_fix;
  return {fix,
          {.x_m = params.lander_x_m,
           .y_m = params.lander_y_m,
           .pan_error_rad = fix.shares_pan_error ? pan_error_rad : 0.0},
          key};
}

double Distance_m(const math::Pose2& pose, const messages::Goal& place) {
  return math::Hypot(place.x_m - pose.x_m, place.y_m - pose.y_m);
}

bool IsStop(SolEnd end) { return end != SolEnd::kTime && end != SolEnd::kEnergy; }

}  // namespace

Mission::Mission(const MissionParams& params, const trial::DriveParams& drive, core::TrialKey key)
    : params_(params),
      drive_(drive),
      key_(key),
      goals_(params.goals.Places()),
      field_(terrain::BuildField(drive.terrain, trial::LayoutKey(drive, key),
                                 CourseOf(drive, goals_))),
      pan_error_rad_(trial::PanError_rad(drive.course.designation, key)),
      lander_(LanderOf(params, drive, pan_error_rad_, key)),
      truth_(drive.course.Start()),
      battery_wh_(params.power.battery_wh) {
  memory_.pose = truth_;
}

MissionCourse Mission::Run() {
  MissionCourse course;
  for (std::int64_t number = 0; number < params_.sols; ++number) {
    const std::optional<Window> window = WindowOf(number);
    if (!window) {
      course.end = MissionEnd::kNoPower;
      return course;
    }
    const std::size_t goal = goal_;
    messages::Goal told = goals_[goal];
    course.sols.push_back(RunSol(number, *window, told));
    Sol& sol = course.sols.back();
    sol.goal = static_cast<std::int64_t>(goal);
    if (sol.end != SolEnd::kNoCommand) JudgeGoal(told, sol, course);
    if (const auto end = EndAfter(sol)) {
      course.end = *end;
      return course;
    }
  }
  return course;
}

trial::SolarSupply Mission::SunFrom(std::int64_t sol, double start_s) const {
  const sensing::SunSensorParams& sky = drive_.sensors.aids.sun;
  const double kept = math::Pow(1.0 - params_.power.dust_loss_per_sol, static_cast<double>(sol));
  return {params_.power.noon_W * kept, sky.latitude_rad,
          math::SunDeclination(sky.areocentric_longitude_rad),
          WindowOpening_h(params_.day) + start_s / kSecondsPerSolarHour};
}

std::optional<Mission::Window> Mission::WindowOf(std::int64_t sol) const {
  const double half_s = 0.5 * params_.day.Window_s();
  if (battery_wh_ > 0.0) return Window{0.0, 2.0 * half_s};
  const double carried_s = SunFrom(sol, 0.0).Carries_s(LargestLoad_W(drive_)) - kSunMargin_s;
  if (carried_s <= 0.0) return std::nullopt;
  const double half_carried_s = std::min(half_s, carried_s);
  return Window{half_s - half_carried_s, 2.0 * half_carried_s};
}

trial::DriveParams Mission::DriveOf(const Window& window) const {
  trial::DriveParams drive = drive_;
  trial::CourseParams& course = drive.course;
  course.start_x_m = truth_.x_m;
  course.start_y_m = truth_.y_m;
  course.start_heading_rad = truth_.heading_rad;
  course.goal_x_m = goals_[goal_].x_m;
  course.goal_y_m = goals_[goal_].y_m;
  // The lander stands where it stands, along and beside the line from start to goal.
  const double straight_m = Distance_m(truth_, goals_[goal_]);
  EXPECT(straight_m > 0.0);
  const double along_x = (course.goal_x_m - truth_.x_m) / straight_m;
  const double along_y = (course.goal_y_m - truth_.y_m) / straight_m;
  const double dx_m = params_.lander_x_m - truth_.x_m;
  const double dy_m = params_.lander_y_m - truth_.y_m;
  course.designation.lander_ahead_m = dx_m * along_x + dy_m * along_y;
  course.designation.lander_left_m = dy_m * along_x - dx_m * along_y;
  // The mast is wrong by one angle in all the mission, which the rover does not know.
  course.designation.stated_pan_sd_rad = drive_.course.designation.PanSd_rad();
  course.designation.pan_kind = trial::PanError::kFixed;
  course.designation.pan_error_rad = pan_error_rad_;
  drive.energy.battery_wh = battery_wh_;
  drive.referee.time_limit_s = window.length_s;
  drive.sensors.aids.sun.start_solar_time_h =
      WindowOpening_h(params_.day) + window.begin_s / kSecondsPerSolarHour;
  if (params_.lander_update == LanderUpdate::kNoon) {
    sensing::AidScheduleParams& schedule = drive.sensors.aids.lander_fix.schedule;
    schedule.enabled = true;
    schedule.every_m = 0.0;
    schedule.every_s = 0.5 * window.length_s;
  }
  return drive;
}

Sol Mission::RunSol(std::int64_t number, const Window& window, messages::Goal& told) {
  Sol sol;
  SolBooks books(SunFrom(number, 0.0), battery_wh_);
  double asleep_from_s = 0.0;
  // Must book loads in the order of time: each finds the batteries as earlier ones left them.
  if (number % SolsPerCommand(params_.day) == 0) {
    books.AddLoad(params_.power.sleep_W, 0.0, window.begin_s, books.energy().sleep_wh);
    books.AddDrive(DriveOn(number, window, sol, told));
    const double rests_from_s = window.begin_s + sol.drive_time_s;
    const double sends_from_s = std::max(rests_from_s, params_.day.Window_s());
    books.AddLoad(params_.power.idle_W, rests_from_s, sends_from_s, books.energy().idle_wh);
    asleep_from_s = sends_from_s + params_.day.TransmitTime_s();
    books.AddLoad(params_.power.idle_W + params_.power.modem_W, sends_from_s, asleep_from_s,
                  books.energy().transmit_wh);
  }
  books.AddLoad(params_.power.sleep_W, asleep_from_s, math::kSolOfMars_s, books.energy().sleep_wh);
  sol.energy = books.energy();
  battery_wh_ = sol.battery_left_wh = books.battery_wh();
  sol.truth = truth_;
  TellBelief(sol);
  return sol;
}

trial::DriveEnd Mission::DriveOn(std::int64_t number, const Window& window, Sol& sol,
                                 messages::Goal& told) {
  const trial::DriveParams drive = DriveOf(window);
  const trial::DriveResult result =
      trial::RunTrial(drive, SolKey(key_, number),
                      {.memory = memory_, .field = field_, .sun = SunFrom(number, window.begin_s)});
  sol.end = SolEndOf(result.outcome, truth::CauseOf(result.outcome, result.detail));
  sol.distance_m = result.record.true_distance_m;
  sol.drive_time_s = result.record.sim_time_s;
  told = {result.record.told_goal_x_m, result.record.told_goal_y_m};
  truth_ = math::ToPose2(result.end.X_WR);
  memory_ = result.end.memory;
  const math::Pose2 believed = BelievedInWorld();
  sol.unaided_error_m = math::Hypot(believed.x_m - truth_.x_m, believed.y_m - truth_.y_m);
  const bool noon = params_.lander_update == LanderUpdate::kNoon;
  if (noon && sol.drive_time_s >= 0.5 * window.length_s) {
    sol.sight = LanderSight::kOnTheWay;
  } else if (params_.lander_update != LanderUpdate::kNone) {
    sol.sight = UpdateByLander(number, result.end.X_WR);
  }
  return result.end;
}

LanderSight Mission::UpdateByLander(std::int64_t number, const math::Transform& X_WR) {
  const auto fix = lander_.Observe(X_WR, field_.terrain, number);
  if (!fix) return LanderSight::kUnseen;
  Believe(*fix);
  return LanderSight::kFound;
}

void Mission::Believe(const messages::PoseFix& fix) {
  if (!drive_.localization.estimators.chosen().takes_fixes()) {
    constexpr auto kX = messages::Index(messages::PoseCoordinate::kX);
    constexpr auto kY = messages::Index(messages::PoseCoordinate::kY);
    constexpr auto kHeading = messages::Index(messages::PoseCoordinate::kHeading);
    memory_.pose = {fix.pose[kX], fix.pose[kY], fix.pose[kHeading]};
    return;
  }
  const auto estimator = Awake();
  estimator->Capture(fix.capture);
  // A filter that turns a fix away doubts itself after a few: operators who saw the rover insist.
  for (int i = 0; i < kInsistence; ++i) {
    if (estimator->Update(fix) != localization::AidUse::kGatedOut) break;
  }
  estimator->Forget(fix.capture);
  memory_ = estimator->Remember();
}

std::unique_ptr<localization::Estimator> Mission::Awake() const {
  localization::EstimatorSetup setup = trial::EstimatorSetupOf(drive_, &memory_);
  if (setup.lander) {
    setup.lander->x_m = params_.lander_x_m;
    setup.lander->y_m = params_.lander_y_m;
  }
  return drive_.localization.estimators.chosen().Make(setup);
}

math::Pose2 Mission::BelievedInWorld() const {
  return math::TurnedAbout(memory_.pose, params_.lander_x_m, params_.lander_y_m, -memory_.pan_rad);
}

void Mission::TellBelief(Sol& sol) const {
  sol.believed = BelievedInWorld();
  const math::Pose2 truth =
      math::TurnedAbout(truth_, params_.lander_x_m, params_.lander_y_m, pan_error_rad_);
  sol.goal_frame_error_m = math::Hypot(memory_.pose.x_m - truth.x_m, memory_.pose.y_m - truth.y_m);
  if (!memory_.covariance) return;
  const auto estimator = Awake();
  if (const auto belief = trial::BeliefOf(estimator->estimate(), truth_)) {
    sol.position_sd_m = belief->position_sd_m;
    sol.inside_95 = belief->inside_95;
  }
  if (const auto belief = trial::GoalFrameBeliefOf(estimator->estimate(), truth)) {
    sol.goal_frame_inside_95 = belief->inside_95;
  }
}

void Mission::JudgeGoal(const messages::Goal& told, Sol& sol, MissionCourse& course) {
  const double radius_m = drive_.course.goal_radius_m;
  // Operators compare in the frame in which goals are told, which both the belief and the told
  // place are in.
  sol.believed_reached = Distance_m(memory_.pose, told) <= radius_m;
  sol.truly_reached = Distance_m(truth_, goals_[goal_]) <= radius_m;
  if (!sol.believed_reached) {
    if (IsStop(sol.end)) ++attempts_;
    if (attempts_ < params_.goals.attempts) return;
    ++course.goals_given_up;
  }
  if (sol.truly_reached) ++course.goals_reached;
  if (sol.believed_reached) {
    ++course.goals_believed;
    if (!sol.truly_reached) ++course.wrong_beliefs;
  }
  ++goal_;
  attempts_ = 0;
}

std::optional<MissionEnd> Mission::EndAfter(const Sol& sol) {
  stuck_sols_ = sol.end == SolEnd::kStuck ? stuck_sols_ + 1 : 0;
  // Must stay in this order: where several reasons hold, the first is told.
  if (sol.end == SolEnd::kTipped) return MissionEnd::kTipped;
  if (Distance_m(truth_, {params_.lander_x_m, params_.lander_y_m}) > params_.radio_range_m) {
    return MissionEnd::kLost;
  }
  if (!terrain::LayoutBounds(drive_.terrain).Contains(truth_.x_m, truth_.y_m)) {
    return MissionEnd::kLeftField;
  }
  if (stuck_sols_ >= params_.stuck_sols) return MissionEnd::kStuck;
  if (goal_ == goals_.size()) return MissionEnd::kGoalsDone;
  return std::nullopt;
}

}  // namespace rockyard::experiments
