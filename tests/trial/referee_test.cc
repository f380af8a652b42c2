#include "trial/referee/referee.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace rockyard::trial {
namespace {

using navigation::NavigatorStatus;
using truth::EndCause;
using truth::TrialOutcome;

// Feeds a referee with ticks of 0.05 s.
constexpr PowerBudget kPower{.base_W = 4.57, .driving_W = 8.28};
constexpr messages::Goal kGoal{7.6, 0.0};  // as in CourseParams

constexpr ArenaBounds kArenaEnds{-2.0, 10.0};
constexpr double kWheelRadius_m = 0.065;

// Nothing where there is no verdict.
std::optional<TrialOutcome> OutcomeOf(const std::optional<Verdict>& verdict) {
  return verdict ? std::optional(verdict->outcome()) : std::nullopt;
}

class RefereeTest : public testing::Test {
 protected:
  static constexpr double kTick_s = 0.05;

  std::optional<Verdict> Tick(Activity activity = Activity::kDriving) {
    ledger_.Spend(activity, kTick_s);
    return referee_.Observe(
        {activity, direction_, kTick_s, state_, estimate_, distance_m_, turned_rad_}, ledger_);
  }

  // Repeats `step` and a tick until a verdict or `seconds` are over.
  template <typename Step>
  std::optional<Verdict> Run(double seconds, Step step, Activity activity = Activity::kDriving) {
    for (double t = 0.0; t < seconds; t += kTick_s) {
      step();
      if (auto verdict = Tick(activity)) return verdict;
    }
    return std::nullopt;
  }

  // With the parameters of now.
  void Restart(const messages::Goal& goal = kGoal,
               const std::optional<ArenaBounds>& arena = kArenaEnds) {
    referee_ = Referee(params_, course_, goal, arena, kWheelRadius_m);
    ledger_ = Ledger(kPower, energy_.battery_wh);
  }

  void TurnTo(double heading_rad) {
    state_.X_WR.linear() = Eigen::AngleAxisd(heading_rad, math::Vector3::UnitZ()).matrix();
  }

  void MoveTo(double x_m, double y_m) { state_.X_WR.translation() = math::Vector3(x_m, y_m, 0.0); }

  RefereeParams params_;
  CourseParams course_;
  EnergyParams energy_;
  truth::RoverState state_;
  messages::PoseEstimate estimate_;
  double distance_m_ = 0.0;
  double turned_rad_ = 0.0;
  int direction_ = 1;
  Ledger ledger_{kPower, energy_.battery_wh};
  Referee referee_{params_, course_, kGoal, kArenaEnds, kWheelRadius_m};
};

TEST_F(RefereeTest, SteadyDriveHasNoVerdict) {
  double x = 0.0;
  EXPECT_FALSE(Run(60.0, [&] {
    x += 0.15 * kTick_s;
    MoveTo(x, 0.0);
    estimate_.x_m = x;
    distance_m_ = x;
  }));
}

TEST_F(RefereeTest, TipOver) {
  state_.X_WR.linear() = Eigen::AngleAxisd(math::DegToRad(61.0), math::Vector3::UnitX()).matrix();
  EXPECT_EQ(OutcomeOf(Tick()), TrialOutcome::kTipOver);
}

TEST_F(RefereeTest, LeavingTheArena) {
  MoveTo(-2.01, 0.0);
  EXPECT_EQ(OutcomeOf(Tick()), TrialOutcome::kLeftArena);
}

TEST_F(RefereeTest, StandingWheelsAreAJamAfterTheWindow) {
  EXPECT_FALSE(Run(params_.stall_window_s - 0.2, [] {}));
  EXPECT_EQ(OutcomeOf(Run(1.0, [] {})), TrialOutcome::kJammed);
}

TEST_F(RefereeTest, RockingToAndFroIsNoMotion) {
  double t = 0.0;
  const auto rock = [&] {
    t += kTick_s;
    const double heading_rad = math::DegToRad(6.0) * std::sin(4.0 * t);
    TurnTo(heading_rad);
    MoveTo(3.0 + 0.02 * std::sin(4.0 * t), 0.0);
  };
  EXPECT_EQ(OutcomeOf(Run(10.0 * params_.stall_window_s, rock)), TrialOutcome::kJammed);
}

// Told to turn 10 deg to and fro for ever; the rover turns by `share` of what it is told.
class DitherTest : public RefereeTest {
 protected:
  std::optional<Verdict> Dither(double share) {
    constexpr double kRate_rad_s = 0.4;
    const double swing_rad = math::DegToRad(10.0);
    double told_rad = 0.0;
    double heading_rad = 0.0;
    const auto step = [&] {
      told_rad += direction_ * kRate_rad_s * kTick_s;
      heading_rad += share * direction_ * kRate_rad_s * kTick_s;
      turned_rad_ += share * kRate_rad_s * kTick_s;
      TurnTo(heading_rad);
      if (told_rad * direction_ >= swing_rad) direction_ = -direction_;
    };
    return Run(30.0 * params_.stall_window_s, step, Activity::kTurning);
  }
};

TEST_F(DitherTest, ThatObeysFindsNoPath) {
  EXPECT_EQ(OutcomeOf(Dither(1.0)), TrialOutcome::kNoPath);
  EXPECT_NEAR(turned_rad_, params_.no_path_turn_rad, 0.03);
}

TEST_F(DitherTest, ThatTheRoverDoesNotFollowIsAJam) {
  EXPECT_EQ(OutcomeOf(Dither(0.01)), TrialOutcome::kJammed);
}

TEST_F(RefereeTest, DrivingToAndFroAsToldIsNoPath) {
  double x_m = 3.0;
  const auto verdict = Run(20.0 * params_.stall_window_s, [&] {
    x_m += 0.15 * kTick_s * direction_;
    distance_m_ += 0.15 * kTick_s;
    MoveTo(x_m, 0.0);
    if (std::abs(x_m - 3.0) > 0.05) direction_ = x_m > 3.0 ? -1 : 1;
  });
  EXPECT_EQ(OutcomeOf(verdict), TrialOutcome::kNoPath);
  EXPECT_NEAR(distance_m_, params_.no_path_distance_m, 0.02);
}

TEST_F(RefereeTest, DrivenAgainstTheCommandIsAJam) {
  // Slides down and is pushed back again: the wheels forward all the while.
  double t = 0.0;
  const auto verdict = Run(20.0 * params_.stall_window_s, [&] {
    t += kTick_s;
    MoveTo(3.0 + 0.01 * std::sin(5.0 * t), 0.0);
  });
  EXPECT_EQ(OutcomeOf(verdict), TrialOutcome::kJammed);
}

// Within goal_tolerance_m + no_path_progress_m no progress is left to be seen, and the patience is
// what it is everywhere: for less to gain.
TEST_F(RefereeTest, PatienceNearTheGoalIsThatOfAnyPlace) {
  double x_m = 0.0;
  EXPECT_FALSE(Run(50.0, [&] {
    x_m += 0.15 * kTick_s;
    distance_m_ = x_m;
    MoveTo(x_m, 0.0);
    estimate_.x_m = x_m;
  }));
  ASSERT_GT(x_m, course_.goal_x_m - 0.25);
  const double before_m = distance_m_;
  const auto verdict = Run(100.0, [&] {
    distance_m_ += 0.15 * kTick_s;
    MoveTo(x_m + 0.1 * std::sin(distance_m_), 0.1 * std::cos(distance_m_));
  });
  EXPECT_EQ(OutcomeOf(verdict), TrialOutcome::kNoPath);
  EXPECT_GT(distance_m_ - before_m, params_.no_path_distance_m - params_.no_path_progress_m - 0.01);
}

// A rover that stands at a mirror line, told to drive out over it, and turned by hand every 3 s.
class TurnedByHandTest : public RefereeTest {
 protected:
  std::optional<Verdict> Stand(bool tells) {
    constexpr double kLine_m = 1.1;
    params_.spinning_wheels = SpinningWheels::kDriveOn;
    Restart();
    MoveTo(3.0, kLine_m + 0.01);
    estimate_ = {3.2, 1.4, 0.6};
    double heading_rad = 0.5;
    int ticks = 0;
    return Run(15.0, [&] {
      TurnTo(heading_rad);
      if (++ticks % 60 != 0) return;
      heading_rad = -heading_rad;
      TurnTo(heading_rad);
      estimate_.y_m = 2.0 * kLine_m - estimate_.y_m;
      estimate_.heading_rad = -estimate_.heading_rad;
      if (tells) referee_.OnReflection(state_, kLine_m);
    });
  }
};

TEST_F(TurnedByHandTest, HasNotMovedByItself) {
  EXPECT_EQ(OutcomeOf(Stand(true)), TrialOutcome::kJammed);
}

TEST_F(TurnedByHandTest, AndLooksMovedToARefereeWhoIsNotTold) {
  EXPECT_FALSE(Stand(false).has_value());
}

TEST_F(RefereeTest, ScanningIsNotStandingStill) {
  EXPECT_FALSE(Run(
      600.0, [] {}, Activity::kScanning));
}

TEST_F(RefereeTest, BellyOnARockMakesItHighCentred) {
  state_.contacts = {{truth::BodyPart::kBelly, 3, 40.0, 0.0, 0.9}};
  EXPECT_EQ(OutcomeOf(Run(20.0, [] {})), TrialOutcome::kHighCentred);
}

// The belly lifts off for moments while the wheels dig: a fifth of the time tells.
TEST_F(RefereeTest, TheBellysShareOfTheTimeTellsHighCentredFromJammed) {
  for (const auto& [ticks_of_20, outcome] :
       {std::pair(5, TrialOutcome::kHighCentred), std::pair(3, TrialOutcome::kJammed)}) {
    int tick = 0;
    const auto verdict = Run(20.0, [&, ticks = ticks_of_20] {
      state_.contacts.clear();
      if (tick++ % 20 < ticks) state_.contacts = {{truth::BodyPart::kBelly, 3, 40.0, 0.0, 0.9}};
    });
    EXPECT_EQ(OutcomeOf(verdict), outcome) << ticks_of_20 << " of 20 ticks";
  }
}

TEST_F(RefereeTest, WheelsDeeperThanTheirAxlesAreEmbedded) {
  state_.wheel_sinkage_m.fill(0.99 * kWheelRadius_m);
  EXPECT_FALSE(Run(1.0, [] {}));
  // One wheel in a hole is not all of the rover.
  state_.wheel_sinkage_m.fill(0.0);
  state_.wheel_sinkage_m[2] = 3.0 * kWheelRadius_m;
  EXPECT_FALSE(Run(1.0, [] {}));
  state_.wheel_sinkage_m.fill(1.01 * kWheelRadius_m);
  const auto verdict = Run(1.0, [] {});
  ASSERT_EQ(OutcomeOf(verdict), TrialOutcome::kJammed);
  EXPECT_EQ(verdict->cause, EndCause::kSankIn);
}

TEST_F(RefereeTest, ARockOrWallBeforeTheChassisJamsIt) {
  for (const truth::BodyContact& contact :
       {truth::BodyContact{truth::BodyPart::kBelly, 3, 40.0, 0.0, 0.1},
        truth::BodyContact{truth::BodyPart::kBelly, -1, 40.0, 0.0, 0.0}}) {
    Restart();
    state_.contacts = {contact};
    EXPECT_EQ(OutcomeOf(Run(20.0, [] {})), TrialOutcome::kJammed);
  }
}

TEST_F(RefereeTest, SpinningWheelsAreStuckByDefaultAndDriveOnByChoice) {
  const auto spin = [&] { estimate_.x_m += 0.15 * kTick_s; };
  EXPECT_EQ(OutcomeOf(Run(20.0, spin)), TrialOutcome::kJammed);

  params_.spinning_wheels = SpinningWheels::kDriveOn;
  Restart();
  estimate_ = {};
  EXPECT_FALSE(Run(40.0, spin));
}

TEST_F(RefereeTest, TurningWithoutComingNearerIsNoPath) {
  double heading = 0.0;
  const auto verdict = Run(
      200.0,
      [&] {
        heading += 0.4 * kTick_s;
        turned_rad_ += 0.4 * kTick_s;
        TurnTo(heading);
      },
      Activity::kTurning);
  EXPECT_EQ(OutcomeOf(verdict), TrialOutcome::kNoPath);
  EXPECT_NEAR(turned_rad_, params_.no_path_turn_rad, 0.03);
}

TEST_F(RefereeTest, DrivingInCirclesIsNoPath) {
  double t = 0.0;
  const auto verdict = Run(200.0, [&] {
    t += kTick_s;
    distance_m_ += 0.15 * kTick_s;
    MoveTo(0.5 * std::sin(0.3 * t), 0.5 * std::cos(0.3 * t));
  });
  EXPECT_EQ(OutcomeOf(verdict), TrialOutcome::kNoPath);
  EXPECT_NEAR(distance_m_, params_.no_path_distance_m, 0.02);
}

TEST_F(RefereeTest, ProgressResetsThePatience) {
  double x = 0.0;
  double wander = 0.0;
  // Each metre gained costs three of wandering: slow, but never four without progress.
  EXPECT_FALSE(Run(60.0, [&] {
    x += 0.05 * kTick_s;
    wander += 0.15 * kTick_s;
    MoveTo(x, 0.0);
    estimate_.x_m = x;
    distance_m_ = wander;
  }));
}

// Drives and turns between gains of 0.25 m: the largest of each of these pauses is kept.
TEST_F(RefereeTest, KeepsTheMostWithoutProgress) {
  EXPECT_EQ(referee_.no_progress_distance_m(), 0.0);
  EXPECT_EQ(referee_.no_progress_turn_rad(), 0.0);
  double x_m = 0.0;
  double heading_rad = 0.0;
  const auto pause = [&](double distance_m, double turn_rad) {
    distance_m_ += distance_m;
    turned_rad_ += turn_rad;
    TurnTo(heading_rad += turn_rad);
    ASSERT_FALSE(Tick(Activity::kTurning));
  };
  const auto gain = [&] {
    x_m += 0.25;
    distance_m_ += 10.0;  // a tick that gains counts for neither
    turned_rad_ += 100.0;
    MoveTo(x_m, 0.0);
    estimate_.x_m = x_m;
    ASSERT_FALSE(Tick(Activity::kDriving));
  };
  pause(1.0, 0.5);
  pause(0.5, 2.0);
  gain();
  EXPECT_NEAR(referee_.no_progress_distance_m(), 1.5, 1e-12);
  EXPECT_NEAR(referee_.no_progress_turn_rad(), 2.5, 1e-12);
  pause(2.25, 0.25);
  gain();
  pause(1.0, 3.0);
  EXPECT_NEAR(referee_.no_progress_distance_m(), 2.25, 1e-12);
  EXPECT_NEAR(referee_.no_progress_turn_rad(), 3.0, 1e-12);
}

// The tick that ends a run counts, so that a run driven without patience tells what it would have
// been with some.
TEST_F(RefereeTest, TheTickOfNoPathIsKept) {
  distance_m_ = params_.no_path_distance_m + 0.01;
  EXPECT_EQ(OutcomeOf(Tick()), TrialOutcome::kNoPath);
  EXPECT_GT(referee_.no_progress_distance_m(), params_.no_path_distance_m);
}

// Wheels that spin bring the rover nearer as it believes, and not truly: the operator who lets them
// spin still waits no longer than for a rover that stands.
TEST_F(RefereeTest, SpinningWheelsAreNoProgress) {
  params_.spinning_wheels = SpinningWheels::kDriveOn;
  params_.no_path_time_s = 60.0;
  Restart();
  EXPECT_EQ(OutcomeOf(Run(300.0, [&] { estimate_.x_m += 0.02 * kTick_s; })), TrialOutcome::kNoPath);
  EXPECT_NEAR(ledger_.time_s(), params_.no_path_time_s, 2.0 * kTick_s);
}

// Nor does true motion alone count: the operator sees what the rover believes.
TEST_F(RefereeTest, MotionThatIsNotBelievedIsNoProgress) {
  params_.no_path_time_s = 60.0;
  Restart();
  double x_m = 0.0;
  const auto verdict = Run(300.0, [&] {
    x_m += 0.02 * kTick_s;
    MoveTo(x_m, 0.0);
  });
  EXPECT_EQ(OutcomeOf(verdict), TrialOutcome::kNoPath);
  EXPECT_NEAR(ledger_.time_s(), params_.no_path_time_s, 2.0 * kTick_s);
}

TEST_F(RefereeTest, ARoverThatNoticesThatItIsStuckFindsNoPath) {
  const Verdict verdict = referee_.OnNavigatorStop(NavigatorStatus::kStuck, state_, 0.0);
  EXPECT_EQ(verdict.outcome(), TrialOutcome::kNoPath);
  EXPECT_EQ(verdict.cause, EndCause::kNoticedStuck);
}

TEST_F(RefereeTest, ArrivalIsTrueOnlyNearTheTrueGoal) {
  MoveTo(7.6 - 0.6, 0.0);
  EXPECT_EQ(referee_.OnNavigatorStop(NavigatorStatus::kArrived, state_, 0.0).outcome(),
            TrialOutcome::kGoalReached);
  MoveTo(7.6 - 0.7, 0.0);
  EXPECT_EQ(referee_.OnNavigatorStop(NavigatorStatus::kArrived, state_, 0.0).outcome(),
            TrialOutcome::kFalseGoal);
  EXPECT_EQ(referee_.OnNavigatorStop(NavigatorStatus::kGaveUp, state_, 0.0).outcome(),
            TrialOutcome::kNoPath);
}

// However near it is, a rover that has not found the rock has not reached its goal.
TEST_F(RefereeTest, ArrivalWithoutTheGoalRockIsFalse) {
  course_.goal_rock.enabled = true;
  Restart();
  MoveTo(7.6, 0.0);
  const Verdict verdict = referee_.OnNavigatorStop(NavigatorStatus::kArrived, state_, 0.0);
  EXPECT_EQ(verdict.cause, EndCause::kRockNotFound);
  EXPECT_EQ(verdict.outcome(), TrialOutcome::kFalseGoal);
  EXPECT_EQ(referee_.OnNavigatorStop(NavigatorStatus::kGaveUp, state_, 0.0).cause,
            EndCause::kGaveUp);
}

// A target that moves on is where it is by then.
TEST_F(RefereeTest, ArrivalIsAtTheGoalOfThatTime) {
  course_.target_speed_m_s = 0.1;
  course_.target_heading_rad = math::DegToRad(90.0);
  Restart();
  MoveTo(7.6, 0.0);
  const auto outcome = [&](double time_s) {
    return referee_.OnNavigatorStop(NavigatorStatus::kArrived, state_, time_s).outcome();
  };
  EXPECT_EQ(outcome(0.0), TrialOutcome::kGoalReached);
  EXPECT_EQ(outcome(20.0), TrialOutcome::kFalseGoal);
  MoveTo(7.6, 2.0);
  EXPECT_EQ(outcome(20.0), TrialOutcome::kGoalReached);
  EXPECT_EQ(outcome(0.0), TrialOutcome::kFalseGoal);
}

// Seconds of steady driving and believing at 0.1 m/s along x until the referee's patience ends.
// After `change_s` something happens to the goal.
class RefereeGoalTest : public RefereeTest {
 protected:
  void SetUp() override {
    params_.no_path_time_s = 30.0;
    params_.no_path_distance_m = 1e6;
    Restart({2.0, 0.0}, std::nullopt);
  }

  template <typename Change>
  double SecondsUntilNoPath(double change_s, Change change) {
    bool changed = false;
    const auto verdict = Run(300.0, [&] {
      const double x_m = state_.X_WR.translation().x() + 0.1 * kTick_s;
      MoveTo(x_m, 0.0);
      estimate_.x_m = x_m;
      distance_m_ = x_m;
      if (changed || ledger_.time_s() < change_s) return;
      changed = true;
      change();
    });
    EXPECT_TRUE(verdict && verdict->outcome() == TrialOutcome::kNoPath);
    return ledger_.time_s();
  }

  void TellNext(const messages::Goal& goal) {
    referee_.OnNextGoal(goal,
                        {Activity::kDriving, 1, 0.0, state_, estimate_, distance_m_, turned_rad_},
                        ledger_.time_s());
  }
  // Within which progress is seen.
  double Step_s() const { return params_.no_path_progress_m / 0.1 + 0.1; }
};

// The goal at 2 m is passed at 20 s: 30 s later nobody waits any longer.
TEST_F(RefereeGoalTest, PatienceEndsBeyondAGoalThatStays) {
  EXPECT_NEAR(SecondsUntilNoPath(40.0, [] {}), 50.0, Step_s());
}

// A next goal behind: no progress is made towards it, and patience begins where it was told.
TEST_F(RefereeGoalTest, PatienceBeginsAnewWithTheNextGoal) {
  EXPECT_NEAR(SecondsUntilNoPath(40.0, [&] { TellNext({0.0, 0.0}); }), 70.0, 0.1);
}

// A next goal ahead, at 10 m after 40 s: what brings the rover nearer to it is progress, though the
// first goal had been nearer than it ever gets to this one by 100 s.
TEST_F(RefereeGoalTest, ProgressIsTowardsTheNextGoal) {
  EXPECT_NEAR(SecondsUntilNoPath(40.0, [&] { TellNext({10.0, 0.0}); }), 130.0, Step_s());
  EXPECT_LE(referee_.no_progress_distance_m(), 3.0 + params_.no_path_progress_m + 0.1);
}

// Driven and turned before count no more, either.
TEST_F(RefereeGoalTest, WayAndTurnsBeginAnewWithTheNextGoal) {
  params_.no_path_time_s = 0.0;
  params_.no_path_distance_m = 4.0;
  params_.no_path_turn_rad = 1.0;
  Restart({0.0, 9.0}, std::nullopt);
  turned_rad_ = 0.9;
  const auto next = [&] {
    TellNext({0.0, 5.0});
    turned_rad_ += 0.9;
  };
  EXPECT_NEAR(SecondsUntilNoPath(30.0, next), 70.0, 0.2);
}

// After 10 s the goal is 1 m away and is seen to lie 2 m farther on, at 4 m: nearer than 1 m the
// rover is from 30 s on, and passes it at 40 s.
TEST_F(RefereeGoalTest, AGoalThatMovedKeepsTheProgressMade) {
  const auto move = [&] { referee_.OnGoalMoved({4.0, 0.0}); };
  EXPECT_NEAR(SecondsUntilNoPath(10.0, move), 70.0, Step_s()) << "30 s of patience";
}

TEST_F(RefereeGoalTest, AGoalThatMovedGivesNoNewPatience) {
  params_.no_path_time_s = 15.0;
  Restart({2.0, 0.0}, std::nullopt);
  const auto move = [&] { referee_.OnGoalMoved({4.0, 0.0}); };
  EXPECT_NEAR(SecondsUntilNoPath(10.0, move), 25.0, Step_s());
}

TEST_F(RefereeTest, EmptyBatteriesAndTimeLimit) {
  ledger_.Spend(Activity::kDriving, 1e6);
  EXPECT_EQ(OutcomeOf(Tick()), TrialOutcome::kEnergyDepleted);

  energy_.battery_wh = 1e5;
  ledger_ = Ledger(kPower, energy_.battery_wh);
  ledger_.Spend(Activity::kScanning, params_.time_limit_s);
  EXPECT_EQ(OutcomeOf(Tick()), TrialOutcome::kTimeLimit);
}

// What each rule would end at a limit of any size, it leaves alone where the limit is 0.
class NoLimitTest : public RefereeTest {};

TEST_F(NoLimitTest, TimeWithoutProgress) {
  params_.no_path_time_s = params_.time_limit_s = energy_.battery_wh = 0.0;
  Restart();
  for (int scan = 0; scan < 100; ++scan) {
    ledger_.Spend(Activity::kScanning, 1e5);
    ASSERT_FALSE(Tick(Activity::kScanning));
  }
  params_.no_path_time_s = 3600.0;
  Restart();
  ledger_.Spend(Activity::kScanning, 1e5);
  EXPECT_EQ(Tick(Activity::kScanning)->cause, EndCause::kPatienceTime);
}

TEST_F(NoLimitTest, TimeOfTheRun) {
  params_.no_path_time_s = params_.time_limit_s = energy_.battery_wh = 0.0;
  Restart();
  ledger_.Spend(Activity::kScanning, 1e7);
  EXPECT_FALSE(Tick(Activity::kScanning));
  params_.time_limit_s = 14400.0;
  Restart();
  ledger_.Spend(Activity::kScanning, 1e7);
  EXPECT_EQ(Tick(Activity::kScanning)->outcome(), TrialOutcome::kTimeLimit);
}

TEST_F(NoLimitTest, Batteries) {
  params_.no_path_time_s = params_.time_limit_s = energy_.battery_wh = 0.0;
  Restart();
  EXPECT_FALSE(Tick());  // not even at the start
  ledger_.Spend(Activity::kDriving, 1e9);
  EXPECT_FALSE(Tick());
  energy_.battery_wh = 1e5;
  Restart();
  ledger_.Spend(Activity::kDriving, 1e9);
  EXPECT_EQ(Tick()->outcome(), TrialOutcome::kEnergyDepleted);
}

TEST_F(NoLimitTest, Distance) {
  params_.no_path_distance_m = 0.0;
  Restart();
  distance_m_ = 1e6;
  EXPECT_FALSE(Tick(Activity::kScanning));
  EXPECT_EQ(referee_.no_progress_distance_m(), 1e6);
  params_.no_path_distance_m = 1e5;
  Restart();
  EXPECT_EQ(Tick(Activity::kScanning)->cause, EndCause::kPatienceDistance);
}

TEST_F(NoLimitTest, Turns) {
  params_.no_path_turn_rad = 0.0;
  Restart();
  turned_rad_ = 1e6;
  EXPECT_FALSE(Tick(Activity::kScanning));
  EXPECT_EQ(referee_.no_progress_turn_rad(), 1e6);
  params_.no_path_turn_rad = 1e5;
  Restart();
  EXPECT_EQ(Tick(Activity::kScanning)->cause, EndCause::kPatienceTurning);
}

}  // namespace
}  // namespace rockyard::trial
