// The reaction to hazards that the rover feels: stop, back off, turn away, scan, go on.

#include <algorithm>

#include "navigation/fake_rover.h"

namespace rockyard::navigation {
namespace {

using messages::HazardSide;
using messages::VehicleHazard;
using messages::VehicleHazardKind;

// First tick from `first` on that drives backwards, turns in place or scans.
std::size_t Find(const std::vector<Tick>& log, std::size_t first, bool (*holds)(const Tick&)) {
  const auto found =
      std::find_if(log.begin() + static_cast<std::ptrdiff_t>(first), log.end(), holds);
  return static_cast<std::size_t>(found - log.begin());
}

bool Backs(const Tick& tick) { return tick.backs(); }
bool Turns(const Tick& tick) { return tick.turns(); }
bool Scans(const Tick& tick) { return tick.decision.looks(); }

VehicleHazard Touch(HazardSide side) { return {VehicleHazardKind::kContact, side}; }

// One touch on the way, by a rover that sees clear ground.
struct Reaction {
  std::vector<Tick> log;
  std::size_t backs, turns, scans;
};

Reaction TouchOnce(HazardSide side, DriveSetup setup = {}) {
  setup.felt = FeltOnceBeyond(1.0, Touch(side));
  Drive drive(setup);
  drive.Run();
  Reaction reaction{drive.log(), 0, 0, 0};
  reaction.backs = Find(reaction.log, 0, Backs);
  reaction.turns = Find(reaction.log, reaction.backs, Turns);
  reaction.scans = Find(reaction.log, reaction.turns, Scans);
  return reaction;
}

TEST(VehicleReactionTest, BacksOffTurnsAwayAndScans) {
  const PathfinderParams params;
  const FakeRoverConfig config;
  const Reaction reaction = TouchOnce(HazardSide::kLeft);
  const auto& log = reaction.log;
  ASSERT_LT(reaction.scans, log.size());
  EXPECT_LT(reaction.backs, reaction.turns);
  // The tick at which it is felt already drives backwards.
  EXPECT_NEAR(log[reaction.backs].X_WR.x_m, 1.0, 0.15 * 0.05);
  const MeasuredMotion backing = MotionBetween(log, reaction.backs, reaction.turns);
  EXPECT_GE(backing.driven_m, params.vehicle_reaction.back_off_m - 1e-12);
  EXPECT_LE(backing.driven_m, params.vehicle_reaction.back_off_m + config.tick_distance_m());
  const MeasuredMotion turn = MotionBetween(log, reaction.turns, reaction.scans);
  EXPECT_GE(turn.turned_rad, params.vehicle_reaction.turn_rad - 1e-12);
  EXPECT_LE(turn.turned_rad, params.vehicle_reaction.turn_rad + config.tick_turn_rad());
  EXPECT_EQ(turn.driven_m, 0.0);
  // Clear ground seen: straight on before it steers to the goal again.
  const Tick& after = log[reaction.scans + 1];
  EXPECT_TRUE(after.has_report);
  EXPECT_TRUE(after.drives());
  EXPECT_EQ(after.decision.motion.curvature_per_m, 0.0);
  EXPECT_EQ(after.decision.motion.direction, +1);
  EXPECT_EQ(log.back().decision.status, NavigatorStatus::kArrived);
}

TEST(VehicleReactionTest, TurnsAwayFromTheSide) {
  const auto direction = [](HazardSide side) {
    const Reaction reaction = TouchOnce(side);
    return reaction.log[reaction.turns].decision.motion.direction;
  };
  EXPECT_EQ(direction(HazardSide::kLeft), -1);
  EXPECT_EQ(direction(HazardSide::kRight), +1);
  EXPECT_EQ(direction(HazardSide::kAhead), -1);  // as a hazard that is seen in the centre
}

TEST(VehicleReactionTest, BlindRoverGoesStraightOnAfterTheTurn) {
  DriveSetup setup{.sensor = HazardSensor::kOff};
  const Reaction reaction = TouchOnce(HazardSide::kLeft, setup);
  const auto& log = reaction.log;
  EXPECT_EQ(reaction.scans, log.size());
  std::size_t i = reaction.turns;
  while (log[i].turns()) ++i;
  const std::size_t straight = i;
  while (log[i].drives() && log[i].decision.motion.curvature_per_m == 0.0) ++i;
  EXPECT_NEAR(MotionBetween(log, straight, i).driven_m, setup.params.vehicle_reaction.straight_m,
              setup.rover.tick_distance_m());
  EXPECT_EQ(log.back().decision.status, NavigatorStatus::kArrived);
}

// What was felt has been avoided as what was seen: the rover does not turn in place back to its
// goal before it has driven point_turn_after_m from there.
TEST(VehicleReactionTest, AReactionHoldsTurnsTowardsTheGoalBack) {
  DriveSetup setup;
  setup.params.vehicle_reaction.turn_rad = math::DegToRad(170.0);  // faces away from the goal
  setup.params.vehicle_reaction.straight_m = 0.0;
  const Reaction reaction = TouchOnce(HazardSide::kLeft, setup);
  const auto& log = reaction.log;
  ASSERT_LT(reaction.scans, log.size());
  EXPECT_TRUE(log[reaction.scans + 1].drives());
  const std::size_t turns_back = Find(log, reaction.scans, Turns);
  const std::size_t arrives = log.size() - 1;
  EXPECT_GE(MotionBetween(log, reaction.scans, std::min(turns_back, arrives)).driven_m,
            setup.params.point_turn_after_m - 1e-12);
  EXPECT_EQ(log.back().decision.status, NavigatorStatus::kArrived);
}

TEST(VehicleReactionTest, TouchBehindEndsTheBackOffAndNothingElse) {
  DriveSetup setup;
  bool touched = false;
  setup.felt = [&](const FakeRover& rover) -> std::optional<VehicleHazard> {
    const double x_m = rover.X_WR().x_m;
    if (touched) {
      if (x_m > 0.95) return std::nullopt;
      return Touch(HazardSide::kBehind);
    }
    touched = x_m >= 1.0;
    if (!touched) return std::nullopt;
    return Touch(HazardSide::kRight);
  };
  Drive drive(setup);
  ASSERT_TRUE(drive.StepUntil(Turns));
  EXPECT_NEAR(drive.rover().X_WR().x_m, 0.95, 2.0 * 0.15 * 0.05);  // instead of 0.81
  // The touch lasts while the rover turns.
  ASSERT_TRUE(drive.StepUntil(Scans));
  const auto& log = drive.log();
  const std::size_t turns = Find(log, 0, Turns);
  const MeasuredMotion turn = MotionBetween(log, turns, Find(log, turns, Scans));
  EXPECT_GE(turn.turned_rad, setup.params.vehicle_reaction.turn_rad - 1e-12);
  EXPECT_LE(turn.turned_rad, setup.params.vehicle_reaction.turn_rad + setup.rover.tick_turn_rad());
  EXPECT_EQ(turn.driven_m, 0.0);
  // Felt behind all the way, it changes nothing.
  DriveSetup behind{.felt = FeltBeyond(0.5, Touch(HazardSide::kBehind))};
  Drive calm(behind);
  EXPECT_EQ(calm.Run(), NavigatorStatus::kArrived);
  EXPECT_EQ(Find(calm.log(), 0, Backs), calm.log().size());
}

// The slope that the rover backs away from does not hide the rock behind it.
TEST(VehicleReactionTest, TouchBehindEndsTheBackOffFromATiltThatLasts) {
  DriveSetup setup;
  setup.felt = [started = false](const FakeRover& rover) mutable -> std::optional<VehicleHazard> {
    started = started || rover.X_WR().x_m >= 1.0;
    if (!started) return std::nullopt;
    return VehicleHazard{VehicleHazardKind::kTilt, HazardSide::kAhead};
  };
  setup.touches_behind = [](const FakeRover& rover) { return rover.X_WR().x_m <= 0.95; };
  setup.start.x_m = 0.96;
  Drive drive(setup);
  ASSERT_TRUE(drive.StepUntil(Turns));
  EXPECT_NEAR(drive.rover().X_WR().x_m, 0.95, 2.0 * 0.15 * 0.05);
}

// One tick of slip, as every image of it gives: back by back_off_m, then to the right by turn_rad.
TEST(VehicleReactionTest, BacksOffAndTurnsAwayWhereItSlips) {
  DriveSetup setup{.params = {.vehicle_reaction = {.back_off_m = 0.25}},
                   .felt = FeltOnceBeyond(1.0, {VehicleHazardKind::kSlip, HazardSide::kAhead})};
  Drive drive(setup);
  ASSERT_TRUE(drive.StepUntil(Backs));
  const double slipped_m = drive.log().back().estimate.distance_m;
  ASSERT_TRUE(drive.StepUntil(Turns));
  const double tick_m = setup.rover.tick_distance_m();
  EXPECT_NEAR(drive.log().back().estimate.distance_m - slipped_m, 0.25, 2.0 * tick_m);
  EXPECT_LT(drive.log().back().decision.motion.direction, 0);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
}

int BackOffs(const std::vector<Tick>& log) { return Stretches(log, Backs); }

// A lasting hazard does not keep the rover from ending its reaction; then it starts another one.
TEST(VehicleReactionTest, GivesUpAfterReactionsWithoutProgress) {
  DriveSetup setup{.params = {.vehicle_reaction = {.max_repeats = 3}},
                   .felt = FeltBeyond(-100.0, Touch(HazardSide::kLeft))};
  Drive drive(setup);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kGaveUp);
  EXPECT_EQ(BackOffs(drive.log()), 3);
}

TEST(VehicleReactionTest, GoesOnWhereItIsTold) {
  DriveSetup setup{.params = {.vehicle_reaction = {.max_repeats = 2,
                                                   .on_exhausted = ReactionsExhausted::kGoOn,
                                                   .ignore_m = 1.0}}};
  setup.felt = FeltBetween(0.9, 1.1, kTouchAhead);  // a ridge across the whole way
  Drive drive(setup);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
  EXPECT_GE(BackOffs(drive.log()), 2);
  setup.params.vehicle_reaction.on_exhausted = ReactionsExhausted::kGiveUp;
  Drive stopped(setup);
  EXPECT_EQ(stopped.Run(), NavigatorStatus::kGaveUp);
}

TEST(VehicleReactionTest, ProgressForgetsEarlierReactions) {
  DriveSetup setup{.params = {.vehicle_reaction = {.max_repeats = 1}}};
  int touches = 0;
  // Once every metre.
  setup.felt = [&](const FakeRover& rover) -> std::optional<VehicleHazard> {
    if (rover.X_WR().x_m < 1.0 + touches) return std::nullopt;
    ++touches;
    return Touch(HazardSide::kRight);
  };
  Drive drive(setup);
  EXPECT_EQ(drive.Run(), NavigatorStatus::kArrived);
  EXPECT_GE(touches, 5);
  EXPECT_EQ(BackOffs(drive.log()), touches);
}

TEST(VehicleReactionTest, NewTouchDuringTheTurnStartsAgain) {
  DriveSetup setup;
  int tick = 0;
  bool started = false;
  setup.felt = [&](const FakeRover& rover) -> std::optional<VehicleHazard> {
    started = started || rover.X_WR().x_m >= 1.0;
    if (!started) return std::nullopt;
    ++tick;
    // The first touch lasts for a tick, the second comes in the midst of the turn (0.2 m at 7.9 mm
    // a tick are 26 ticks; 45 deg at 1.35 deg a tick are 34).
    if (tick == 1) return Touch(HazardSide::kLeft);
    if (tick == 40) return Touch(HazardSide::kRight);
    return std::nullopt;
  };
  Drive drive(setup);
  drive.Run();
  const auto& log = drive.log();
  const std::size_t first = Find(log, Find(log, 0, Backs), Turns);
  const std::size_t again = Find(log, first, Backs);
  ASSERT_LT(again, log.size());
  EXPECT_LT(MotionBetween(log, first, again).turned_rad, setup.params.vehicle_reaction.turn_rad);
  EXPECT_EQ(log[Find(log, again, Turns)].decision.motion.direction, +1);
}

// What the rover feels at each tick of a reaction that starts at x = 1 m; nothing before.
FeltSource Since(std::function<std::optional<VehicleHazard>(int tick)> felt) {
  return [felt = std::move(felt), tick = 0,
          started = false](const FakeRover& rover) mutable -> std::optional<VehicleHazard> {
    started = started || rover.X_WR().x_m >= 1.0;
    if (!started) return std::nullopt;
    return felt(tick++);
  };
}

// Measured angle of the first turn and back-offs until the first scan after it.
struct FirstReaction {
  double turned_rad = 0.0;
  int back_offs = 0;
};

FirstReaction ReactTo(const FeltSource& felt) {
  DriveSetup setup{.felt = felt};
  Drive drive(setup);
  EXPECT_TRUE(drive.StepUntil(Turns));
  EXPECT_TRUE(drive.StepUntil(Scans));
  const std::size_t turns = Find(drive.log(), 0, Turns);
  return {MotionBetween(drive.log(), turns, drive.log().size() - 1).turned_rad,
          BackOffs(drive.log())};
}

// Felt at two ticks of three from the beginning to the midst of the turn.
TEST(VehicleReactionTest, AHazardThatFlickersStartsOneReaction) {
  for (const auto kind : {VehicleHazardKind::kTilt, VehicleHazardKind::kArticulation,
                          VehicleHazardKind::kMotorCurrent}) {
    const FirstReaction reaction = ReactTo(Since([=](int tick) -> std::optional<VehicleHazard> {
      if (tick > 45 || tick % 3 == 2) return std::nullopt;
      return VehicleHazard{kind, HazardSide::kLeft};
    }));
    EXPECT_EQ(reaction.back_offs, 1);
    EXPECT_NEAR(reaction.turned_rad, PathfinderParams{}.vehicle_reaction.turn_rad,
                FakeRoverConfig{}.tick_turn_rad());
  }
}

TEST(VehicleReactionTest, AnotherKindDuringTheTurnStartsAgain) {
  const auto reaction = [](VehicleHazardKind first, VehicleHazardKind second) {
    return ReactTo(Since([=](int tick) -> std::optional<VehicleHazard> {
             if (tick < 2) return VehicleHazard{first, HazardSide::kLeft};
             if (tick == 40) return VehicleHazard{second, HazardSide::kLeft};
             return std::nullopt;
           }))
        .back_offs;
  };
  EXPECT_EQ(reaction(VehicleHazardKind::kContact, VehicleHazardKind::kTilt), 2);
  EXPECT_EQ(reaction(VehicleHazardKind::kTilt, VehicleHazardKind::kMotorCurrent), 2);
  EXPECT_EQ(reaction(VehicleHazardKind::kTilt, VehicleHazardKind::kTilt), 1);
}

// A tilt that lasts does not hide a rock that the turn leads onto.
TEST(VehicleReactionTest, ATouchDuringALastingTiltStartsAgain) {
  const FirstReaction reaction = ReactTo(Since([](int tick) -> std::optional<VehicleHazard> {
    if (tick == 40) return Touch(HazardSide::kRight);
    if (tick < 60) return VehicleHazard{VehicleHazardKind::kTilt, HazardSide::kLeft};
    return std::nullopt;
  }));
  EXPECT_EQ(reaction.back_offs, 2);
}

TEST(VehicleReactionTest, PoseUpdateKeepsWhatWasTurned) {
  DriveSetup setup{.felt = FeltBetween(1.0, 1.005, Touch(HazardSide::kLeft))};
  Drive drive(setup);
  ASSERT_TRUE(drive.StepUntil(Turns));
  for (int i = 0; i < 10; ++i) drive.Step();
  const messages::PoseEstimate before = drive.rover().estimate();
  drive.UpdatePose({before.x_m, before.y_m, before.heading_rad + 1.0});
  ASSERT_TRUE(drive.StepUntil(Scans));
  EXPECT_NEAR(drive.rover().estimate().heading_rad, 1.0 - setup.params.vehicle_reaction.turn_rad,
              2.0 * setup.rover.tick_turn_rad());
}

}  // namespace
}  // namespace rockyard::navigation
