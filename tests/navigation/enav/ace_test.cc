// ACE and p-ACE: kinematics against circles that meet, the bounds of the reference geometry, what
// each check refuses, and that no stance leaves its bounds where wheels stay in their boxes.
#include "navigation/enav/ace.h"

#include "navigation/enav/stance.h"

namespace rockyard::navigation {
namespace {

using math::DegToRad;
using math::RadToDeg;
using messages::PerWheel;

// The reference has z at the wheel centres.
messages::RoverBelief OnWheelCentres() {
  messages::RoverBelief rover = PerseveranceLike();
  rover.suspension.rocker_pivot_z_m -= rover.drive.wheel_radius_m;
  rover.suspension.bogie_pivot_z_m -= rover.drive.wheel_radius_m;
  rover.drive.wheel_radius_m = 0.0;
  return rover;
}

PerWheel<Interval> AllWithin(double half_m) {
  PerWheel<Interval> ground;
  ground.fill({-half_m, half_m});
  return ground;
}

void ExpectDegrees(const Interval& angle_rad, double low_deg, double high_deg) {
  EXPECT_NEAR(RadToDeg(angle_rad.low), low_deg, 0.05);
  EXPECT_NEAR(RadToDeg(angle_rad.high), high_deg, 0.05);
}

// Bounds on flat ground whose heights are uncertain alike under all wheels, by the reference's own
// script (of the same equations, in another language).
TEST(AceLinkage, HasTheBoundsOfTheReference) {
  struct Row {
    double half_m, roll, pitch_low, pitch_high, rocker, bogie_low, bogie_high, z_low, z_high;
  };
  const AceLinkage linkage(OnWheelCentres());
  for (const Row& row : {Row{0.05, 3.70, -3.53, 3.48, 3.51, -8.82, 8.87, -0.071, 0.068},
                         Row{0.10, 7.41, -7.14, 6.92, 7.03, -17.65, 17.86, -0.148, 0.137},
                         Row{0.15, 11.16, -10.83, 10.34, 10.58, -26.55, 27.03, -0.230, 0.205},
                         Row{0.20, 14.96, -14.63, 13.75, 14.19, -35.59, 36.48, -0.318, 0.272}}) {
    SCOPED_TRACE(row.half_m);
    const auto state = linkage.Bound(AllWithin(row.half_m));
    ASSERT_TRUE(state);
    ExpectDegrees(state->roll_rad, -row.roll, row.roll);
    ExpectDegrees(state->pitch_rad, row.pitch_low, row.pitch_high);
    ExpectDegrees(state->rocker_rad, -row.rocker, row.rocker);
    for (const Interval& bogie : state->bogie_rad) {
      ExpectDegrees(bogie, row.bogie_low, row.bogie_high);
    }
    EXPECT_NEAR(state->origin_z_m.low, row.z_low, 0.001);
    EXPECT_NEAR(state->origin_z_m.high, row.z_high, 0.001);
  }
}

TEST(AceLinkage, BendsByOneWheelAsTheReference) {
  struct Row {
    std::size_t wheel;
    double bogie_deg, rocker_deg;
  };
  const AceLinkage linkage(OnWheelCentres());
  for (const Row& row : {Row{0, 6.2, 3.1}, Row{1, 13.1, 1.9}, Row{2, 12.1, 1.4}}) {
    PerWheel<Interval> ground = AllWithin(0.0);
    ground[row.wheel] = {-0.175, 0.175};
    const auto state = linkage.Bound(ground);
    ASSERT_TRUE(state);
    const Interval& bogie = state->bogie_rad[0];
    EXPECT_NEAR(RadToDeg(std::max(-bogie.low, bogie.high)), row.bogie_deg, 0.1);
    EXPECT_NEAR(RadToDeg(std::max(-state->rocker_rad.low, state->rocker_rad.high)), row.rocker_deg,
                0.1);
  }
}

// Also with the wheel radius in, and the other way round: pitch and bogies are those of the frame
// L.
TEST(AceLinkage, StandsWhereCirclesMeet) {
  for (const auto& rover : {PerseveranceLike(), OnWheelCentres(), Reversed(PerseveranceLike())}) {
    const AceLinkage linkage(rover);
    Draws draws({20261130, 1}, 0);
    for (int i = 0; i < 500; ++i) {
      PerWheel<double> up_m, down_m;
      for (std::size_t wheel = 0; wheel < up_m.size(); ++wheel) {
        up_m[wheel] = draws.Between(-0.25, 0.25) + (i % 2);
        down_m[wheel] = -up_m[wheel];
      }
      const Stance expected = StandByCircles(rover, up_m);
      const auto state = linkage.Stand(down_m);
      ASSERT_TRUE(state);
      EXPECT_NEAR(state->roll_rad, expected.roll_rad, 1e-12);
      EXPECT_NEAR(state->pitch_rad, expected.pitch_rad, 1e-12);
      EXPECT_NEAR(state->rocker_rad, expected.rocker_rad, 1e-12);
      EXPECT_NEAR(state->bogie_rad[0], expected.bogie_rad[0], 1e-12);
      EXPECT_NEAR(state->bogie_rad[1], expected.bogie_rad[1], 1e-12);
      EXPECT_NEAR(state->origin_z_m, expected.origin_z_m, 1e-12);
    }
  }
}

// A wheel that hangs by the length of a link, or a joint that would pass over its wheel.
TEST(AceLinkage, RefusesHeightsBeyondItsLinks) {
  const AceLinkage linkage(PerseveranceLike());
  PerWheel<double> ground{};
  for (const double z_m : {1.2, -0.95}) {
    ground[1] = z_m;
    EXPECT_FALSE(linkage.Stand(ground)) << z_m;
  }
  ground[1] = 0.4;
  EXPECT_TRUE(linkage.Stand(ground));
}

// Boxes of 2 by 3: a wheel is put off by 0.35 m along the rover at most, by a third of its width
// across.
AceParams LargeBoxes() {
  AceParams params;
  params.wheel_box_diameters = 2.0;
  params.wheel_box_widths = 3.0;
  params.max_wheel_drop_radii = 0.0;
  return params;
}

TEST(Ace, BoundsEveryStanceOnRandomGround) {
  for (const auto& rover : {PerseveranceLike(), Reversed(PerseveranceLike())}) {
    const BoundsHeld held = HoldBounds(LargeBoxes(), rover, 1, 10, 200);
    EXPECT_GT(held.poses, 1900);
    EXPECT_EQ(held.left_box, 0);
    EXPECT_EQ(held.violations, 0);
  }
}

// Negative control: boxes of a footprint that forget where attitude and suspension put the wheels.
TEST(Ace, IsViolatedByBoxesThatAreTooSmall) {
  AceParams params;
  params.wheel_box_diameters = 0.2;
  params.wheel_box_widths = 0.2;
  params.max_wheel_drop_radii = 0.0;
  const BoundsHeld held = HoldBounds(params, PerseveranceLike(), 1, 10, 100);
  EXPECT_GT(held.violations, 10);
}

double LevelGround(double, double) { return 0.7; }

TEST(Ace, SeesTheNominalClearanceOnLevelGround) {
  const Ace ace(AceParams(), PerseveranceLike());
  const AceVerdict verdict = ace.Check(Map(LevelGround), {0.3, -0.2, 1.0});
  EXPECT_TRUE(verdict.safe());
  EXPECT_NEAR(verdict.clearance_m, 0.6, 1e-12);
  EXPECT_NEAR(verdict.state.origin_z_m.high, -0.7, 1e-12);
}

// Each limit by ground that breaks it alone, just below and just above.
TEST(Ace, RefusesWhatBreaksALimit) {
  const messages::RoverBelief rover = PerseveranceLike();
  const auto check = [&](const Ground& ground, AceParams params = {}) {
    return Ace(params, rover).Check(Map(ground), {});
  };
  const auto rock = [](double x_m, double y_m, double height_m) -> Ground {
    return [=](double x, double y) { return std::hypot(x - x_m, y - y_m) < 0.12 ? height_m : 0.0; };
  };
  // Under the belly, of which half of 0.6 m has to be left.
  EXPECT_TRUE(check(rock(0.2, 0.3, 0.28)).safe());
  EXPECT_EQ(check(rock(0.2, 0.3, 0.32)).failure, AceFailure::kClearance);
  // In the box of a wheel; 1.33 radii are 0.35 m.
  EXPECT_TRUE(check(rock(1.2, 1.05, 0.33)).safe());
  EXPECT_EQ(check(rock(1.2, 1.05, 0.37)).failure, AceFailure::kWheelDrop);
  // Beside the box.
  EXPECT_TRUE(check(rock(1.85, 1.05, 0.9)).safe());
  // Boxes of half a metre on a slope add 2 to 3 deg to its own.
  AceParams no_drop;
  no_drop.max_wheel_drop_radii = 0.0;
  no_drop.min_clearance_share = 0.0;
  const auto slope = [](double degrees) -> Ground {
    return [=](double x, double y) { return std::tan(DegToRad(degrees)) * (0.8 * x + 0.6 * y); };
  };
  EXPECT_TRUE(check(slope(9.0), no_drop).safe());
  EXPECT_EQ(check(slope(16.5), no_drop).failure, AceFailure::kTilt);
  AceParams roll = no_drop;
  roll.max_tilt_rad = 0.0;
  EXPECT_TRUE(check(slope(16.5), roll).safe());
  roll.max_roll_rad = DegToRad(8.0);
  EXPECT_EQ(check(slope(16.5), roll).failure, AceFailure::kTilt);
  // A bogie bends by 12 deg where its rear wheel stands 0.35 m higher; its stop is at 50.
  AceParams joints;
  joints.stop_share = 0.1;
  EXPECT_EQ(check(rock(-1.1, 1.05, 0.33), joints).failure, AceFailure::kJoints);
  EXPECT_EQ(check(LevelGround, joints).failure, AceFailure::kNone);
}

TEST(Ace, AsksForSeenGround) {
  HeightMap map = Map(LevelGround);
  map.ForEach([&](const LatticeCell& at, HeightCell& cell) {
    if (map.MiddleX_m(at) > 1.0) cell = {};
  });
  AceParams params;
  params.min_seen_share = 0.1;  // 0.1 to 0.2 of 0.6 m of the front wheels' boxes are seen
  EXPECT_TRUE(Ace(params, PerseveranceLike()).Check(map, {}).safe());
  params.min_seen_share = 0.5;
  EXPECT_EQ(Ace(params, PerseveranceLike()).Check(map, {}).failure, AceFailure::kUnseen);
  EXPECT_EQ(Ace(params, PerseveranceLike()).Check(map, {20.0, 0.0, 0.0}).failure,
            AceFailure::kUnseen);
}

// p-ACE: no risk where ACE passes, all of it where no state within the bounds is allowed, and in
// between that of truncated normals, here by summing up.
TEST(PAce, CountsTheChanceOutsideOfTheLimits) {
  const messages::RoverBelief rover = PerseveranceLike();
  AceParams params;
  params.risk = 1e-3;
  params.max_tilt_rad = 0.0;
  params.max_wheel_drop_radii = 0.0;
  params.min_clearance_share = 0.0;
  EXPECT_EQ(Ace(params, rover).Check(Map(LevelGround), {}).risk, 0.0);
  // A slope along the rover, pitch alone.
  const HeightMap map = Map([](double x, double) { return 0.2 * x; });
  const AceVerdict bounds = Ace(params, rover).Check(map, {});
  const Interval& pitch = bounds.state.pitch_rad;
  ASSERT_LT(pitch.low, 0.19);
  ASSERT_GT(pitch.high, 0.21);
  double previous = 1.0;
  for (const double share : {0.3, 0.6, 0.9}) {
    params.max_pitch_rad = pitch.low + share * pitch.Width();
    const AceVerdict verdict = Ace(params, rover).Check(map, {});
    double above = 0.0, all = 0.0;
    for (int i = 0; i < 100000; ++i) {
      const double w = (i + 0.5) / 100000;
      const double weight = std::exp(-0.5 * std::pow((w - 0.521) / 0.133, 2));
      all += weight;
      if (w > share) above += weight;
    }
    EXPECT_NEAR(verdict.risk, above / all, 1e-4);
    EXPECT_EQ(verdict.safe(), verdict.risk < params.risk);
    EXPECT_LT(verdict.risk, previous);
    previous = verdict.risk;
  }
  params.max_pitch_rad = 0.5 * pitch.low;
  EXPECT_EQ(Ace(params, rover).Check(map, {}).risk, 1.0);
}

// The order of figure 9: what ACE passes passes at every risk, and a larger risk passes more.
TEST(PAce, PassesMoreAtALargerRisk) {
  Draws draws({20261130, 2}, 0);
  const HeightMap map = RandomGround(draws, 0.1, 12.0, 0.3, 0.3);
  int passed_before = 0;
  for (const double risk : {0.0, 1e-8, 1e-4, 1e-1}) {
    AceParams params;
    params.risk = risk;
    const Ace ace(params, PerseveranceLike());
    int passed = 0;
    for (int i = 0; i < 400; ++i) {
      Draws place({20261130, 3}, static_cast<std::uint32_t>(i));
      passed +=
          ace.Check(map, {place.Between(-3, 3), place.Between(-3, 3), place.Between(-3, 3)}).safe();
    }
    EXPECT_GE(passed, passed_before) << risk;
    if (risk == 1e-1) {
      EXPECT_GT(passed, passed_before);
    }
    passed_before = passed;
  }
  EXPECT_GT(passed_before, 0);
}

}  // namespace
}  // namespace rockyard::navigation
