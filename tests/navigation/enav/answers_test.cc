// Answers of ENav that can be written down: bounds where they are met, rules where they decide.
#include "navigation/enav/ace.h"
#include "navigation/enav/planner.h"
#include "navigation/enav/stance.h"

namespace rockyard::navigation {
namespace {

using math::DegToRad;

AceParams Unlimited() {
  AceParams params;
  params.max_tilt_rad = 0.0;
  params.max_wheel_drop_radii = 0.0;
  params.min_clearance_share = 0.0;
  return params;
}

// Even between the wheels; beside, `side` times a height, with noise of the same size.
Ground Rails(double left_m, double right_m, double noise_m) {
  return [=](double x, double y) {
    if (std::abs(y) < 0.8) return 0.0;
    const bool odd = (std::lround(10 * x - 0.5) + std::lround(10 * y - 0.5)) % 2 != 0;
    return (y > 0.0 ? left_m : right_m) + (odd ? noise_m : -noise_m);
  };
}

// The belly's corner that hangs lowest, over cells up to 0.95 m ahead and 0.75 m aside: at the
// steepest of either bound, and raised by what no angle within them takes from the level.
TEST(AceAnswers, ClearanceOfATiltedBelly) {
  messages::RoverBelief rover = PerseveranceLike();
  rover.suspension.belly_length_m = 1.84;
  for (const auto& [left_m, right_m, noise_m] :
       {std::tuple{0.1, -0.1, 0.0}, {0.0, 0.0, 0.05}, {0.2, -0.2, 0.02}}) {
    const AceVerdict verdict =
        Ace(Unlimited(), rover).Check(Map(Rails(left_m, right_m, noise_m)), {});
    const auto& [roll, pitch] = std::pair{verdict.state.roll_rad, verdict.state.pitch_rad};
    const auto most = [](const Interval& angle_rad) {
      return std::tan(std::max(std::abs(angle_rad.low), std::abs(angle_rad.high)));
    };
    const double least = roll.low * roll.high <= 0.0
                             ? 0.0
                             : std::tan(std::min(std::abs(roll.low), std::abs(roll.high)));
    EXPECT_NEAR(verdict.clearance_m,
                -verdict.state.origin_z_m.high - 0.95 * most(pitch) - 0.75 * most(roll) +
                    0.6 * std::sqrt(1.0 + least * least),
                1e-9);
    EXPECT_EQ(least == 0.0, left_m == 0.0);
  }
}

TEST(AceAnswers, SeenGroundUnderTheBelly) {
  AceParams params;
  params.min_seen_share = 1.0;
  HeightMap map = Map([](double, double) { return 0.0; });
  EXPECT_TRUE(Ace(params, PerseveranceLike()).Check(map, {}).safe());
  map.ForEach([&](const LatticeCell& at, HeightCell& cell) {
    if (math::Hypot(map.MiddleX_m(at), map.MiddleY_m(at)) < 0.5) cell = {};
  });
  EXPECT_EQ(Ace(params, PerseveranceLike()).Check(map, {}).failure, AceFailure::kUnseen);
}

// Chances of independent states, each by its own limit and all together.
TEST(AceAnswers, RisksOfSeveralStates) {
  const messages::RoverBelief rover = PerseveranceLike();
  AceParams params = Unlimited();
  params.risk = 1e-3;
  const HeightMap map = Map([](double, double y) { return 0.2 * y; });
  const auto state = Ace(params, rover).Check(map, {}).state;
  const auto risk = [&](double roll_rad, double pitch_rad, double tilt_rad = 0.0) {
    params.max_roll_rad = roll_rad;
    params.max_pitch_rad = pitch_rad;
    params.max_tilt_rad = tilt_rad;
    return Ace(params, rover).Check(map, {}).risk;
  };
  const double steepest_rad =
      std::max(std::abs(state.roll_rad.low), std::abs(state.roll_rad.high)) -
      0.45 * state.roll_rad.Width();
  const double by_roll = risk(steepest_rad, 0.0);
  const double by_pitch = risk(0.0, 0.3 * state.pitch_rad.high);
  EXPECT_GT(by_roll, 0.1);
  EXPECT_GT(by_pitch, 0.1);
  EXPECT_NEAR(risk(steepest_rad, 0.3 * state.pitch_rad.high),
              by_roll + by_pitch - by_roll * by_pitch, 1e-12);
  EXPECT_EQ(risk(0.0, 0.0, steepest_rad), by_roll);
  params.max_tilt_rad = 0.0;
  params.stop_share = 0.5 * state.rocker_rad.high / rover.max_rocker_rad;
  params.both_rockers = false;
  const double by_left = risk(0.0, 0.0);
  params.both_rockers = true;
  EXPECT_GT(by_left, 0.0);
  EXPECT_GT(risk(0.0, 0.0), by_left);
}

// A rock under the belly is a risk, wherever it comes in the belly's cells, and a larger one under
// the side that hangs low.
TEST(AceAnswers, RiskOfTheBelly) {
  AceParams params = Unlimited();
  params.risk = 1e-3;
  params.min_clearance_share = 0.5;
  const auto risk = [&](double y_m) {
    const Ground rails = Rails(0.15, -0.15, 0.04);
    const HeightMap map = Map([&](double x, double y) {
      return std::hypot(x - 0.05, y - y_m) < 0.04 ? 0.25 : rails(x, y);
    });
    return Ace(params, PerseveranceLike()).Check(map, {}).risk;
  };
  EXPECT_LT(risk(3.0), 1e-3);
  EXPECT_GT(risk(-0.55), 0.1);
  EXPECT_LT(risk(0.55), 0.5 * risk(-0.55));
}

TEST(AceAnswers, NoStanceWherePivotsDropFartherThanTheyAreApart) {
  messages::RoverBelief rover = PerseveranceLike();
  rover.suspension.pivot_y_m = 0.05;
  const messages::PerWheel<double> level{};
  EXPECT_TRUE(AceLinkage(rover).Stand(level).has_value());
  EXPECT_FALSE(AceLinkage(rover).Stand({-0.15, -0.15, -0.15, 0.0, 0.0, 0.0}).has_value());
}

TEST(CostMapAnswers, GroundOfFewPointsAndOfNoPlane) {
  EnavMapParams params;
  params.cost_side_m = 20.0;
  params.fit_cells = 0;
  CostMap map(params, 0.05, 0.6);
  map.Add({-3.3, 0.2, 0.0});
  const auto fill = [&](double x_m, double y_m, double height_m) {
    for (int i = 0; i < 5; ++i) {
      for (int j = 0; j < 5; ++j) {
        map.Add({x_m + 0.1 * i, y_m + 0.1 * j, (i + j) % 2 == 0 ? height_m : 0.0});
      }
    }
  };
  fill(3.02, 0.02, 0.5);   // its points lie as far up as aside
  fill(-9.98, 0.02, 0.5);  // and at the window's edge
  map.Update(-40.0, 0.25);
  EXPECT_EQ(map.Cost_s_per_m(-3.3, 0.2), 40.0);
  EXPECT_FALSE(std::isfinite(map.Cost_s_per_m(3.2, 0.2)));
  EXPECT_FALSE(std::isfinite(map.ToGo_s(-9.75, 0.25)));
  // To a goal on such ground there is a way, as over unseen ground.
  map.Update(3.2, 0.2);
  EXPECT_NEAR(map.ToGo_s(-1.75, 0.25), 5.0 * 40.0, 1e-9);
}

messages::PointCloud Square(double half_m, const Ground& ground) {
  messages::PointCloud cloud;
  const int n = static_cast<int>(10 * half_m);
  for (int i = -n; i < n; ++i) {
    for (int j = -n; j < n; ++j) {
      const double x = 0.1 * i + 0.05, y = 0.1 * j + 0.05;
      cloud.points_R.push_back({x, y, ground(x, y)});
    }
  }
  return cloud;
}

// The plane on which a tilted rover stands, where nothing was seen.
TEST(PlannerAnswers, StandsOnItsPlane) {
  EnavPlanner planner(EnavParams(), PerseveranceLike(), 0.042);
  planner.See(Square(0.1, [](double, double) { return 3.0; }), math::Transform::Identity());
  planner.StandOn(math::MakePose({0.0, 0.0, 0.0}, 0.0, DegToRad(-10.0), 0.0));
  const HeightMap& map = planner.heights();
  EXPECT_NEAR(map.At({8, 3}).Height_m(), 0.85 * std::tan(DegToRad(10.0)), 1e-9);
  EXPECT_EQ(map.At({0, 0}).Height_m(), 3.0);
}

EnavParams StraightOnly() {
  EnavParams params;
  params.tree.num_turns = params.tree.num_first_arcs = 1;
  params.tree.num_second_arcs = 0;
  return params;
}

// A path ends abeam of a goal within the tolerance, and a single arc is straight.
TEST(PlannerAnswers, EndsAbeamOfTheGoalWithinItsTolerance) {
  EnavParams params = StraightOnly();
  for (const double tolerance_m : {0.25, 1.0}) {
    params.drive.goal_tolerance_m = tolerance_m;
    EnavPlanner planner(params, PerseveranceLike(), 0.042);
    planner.See(Square(6.0, [](double, double) { return 0.0; }), math::Transform::Identity());
    const EnavPlan plan = planner.Plan({}, {2.0, 0.8});
    ASSERT_TRUE(plan.found);
    EXPECT_EQ(plan.curvature_per_m, 0.0);
    EXPECT_NEAR(plan.length_m, tolerance_m < 0.8 ? 3.0 : 2.0, 1e-12);
  }
  params.tree.arc_m = 2.1;  // seven times 0.3, but for rounding
  params.tree.check_spacing_m = 0.3;
  EXPECT_EQ(PathTree(params.tree).arcs()[0].poses.size(), 7u);
}

// Ground in its own cell stops no rover, however rough; what was felt is forgotten with the map.
TEST(PlannerAnswers, LeavesItsOwnCellAndForgets) {
  EnavParams params = StraightOnly();
  params.tree.check_spacing_m = 0.1;
  params.map.fit_cells = 0;
  params.map.eigen_ratio = 1e4;
  EnavPlanner planner(params, PerseveranceLike(), 0.042);
  const auto cloud = Square(6.0, [](double x, double y) {
    const bool own = x > 0.0 && x < 0.5 && y > 0.0 && y < 0.5;
    return own && (std::lround(10 * x - 0.5) + std::lround(10 * y - 0.5)) % 2 != 0 ? 0.02 : 0.0;
  });
  planner.See(cloud, math::Transform::Identity());
  const math::Pose2 from{0.25, 0.25, 0.0};
  EXPECT_TRUE(planner.Plan(from, {30.0, 0.25}).found);
  EXPECT_FALSE(planner.Plan({-1.0, 0.25, 0.0}, {30.0, 0.25}).found);
  planner.Avoid({3.0, 0.25});
  EXPECT_FALSE(planner.Plan(from, {30.0, 0.25}).found);
  planner.Forget();
  planner.See(cloud, math::Transform::Identity());
  EXPECT_TRUE(planner.Plan(from, {30.0, 0.25}).found);
}

// The last heading of a turn is checked, and the first one is not: the rover stands there.
TEST(PlannerAnswers, ChecksTurnsWhereTheyLead) {
  EnavParams params;
  params.tree.num_turns = 4;
  params.tree.turn_check_rad = DegToRad(90.0);
  EnavPlanner planner(params, PerseveranceLike(), 0.042);
  planner.See(Square(9.0, [](double, double) { return 0.0; }), math::Transform::Identity());
  planner.Avoid({1.47, 0.0});  // by its length before it, not beside it
  const EnavPlan plan = planner.Plan({}, {0.0, 30.0});
  ASSERT_TRUE(plan.found);
  EXPECT_NEAR(plan.turn_rad, DegToRad(90.0), 1e-12);
}

}  // namespace
}  // namespace rockyard::navigation
