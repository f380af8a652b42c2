// The fast votes on splines against plain ones, over random maps, starts, goals and parameters.
//
// Both read the map at the same places but for rounding, some 1e-13 m: that they fall into the same
// cell is a matter of chance so good that no seed here meets the exception. The fast ones are then
// the plain ones but for the last digits, and where votes are whole numbers the same.
#include <gtest/gtest.h>

#include "core/random.h"
#include "grids.h"
#include "math/angles.h"
#include "reference.h"

namespace rockyard::navigation {
namespace {

constexpr double kFullSpeed_m_s = 0.07;

struct Scene {
  GoodnessGrid grid;
  messages::PoseEstimate start;
  double curvature_per_m = 0.0;
  messages::Goal goal;
};

// Ground of any goodness with a few obstacles and holes in what is known.
Scene RandomScene(core::RandomStream& random, double largest_goal_m) {
  const auto uniform = [&random](double low, double high) {
    return low + (high - low) * random.Uniform();
  };
  Scene scene;
  scene.grid = GridOf(
      [&](double, double) {
        const double kind = random.Uniform();
        if (kind < 0.02) return kObstacle;
        if (kind < 0.1) return kUnknownCell;
        return CellValue{static_cast<std::uint8_t>(uniform(11.0, 255.0)),
                         static_cast<std::uint8_t>(uniform(0.0, 255.0)), true};
      },
      40, 0.17);
  scene.start = At(uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-4.0, 4.0));
  scene.curvature_per_m = uniform(-1.2, 1.2);
  const double bearing = uniform(-3.1, 3.1);
  const double distance = uniform(0.05, largest_goal_m);
  scene.goal = {scene.start.x_m + distance * std::cos(bearing),
                scene.start.y_m + distance * std::sin(bearing)};
  return scene;
}

// Returns how many splines had a hazard vote above 0.
int ExpectSameVotes(const GestaltParams& params, const Scene& scene) {
  const SplineVoter voter(params, kFullSpeed_m_s);
  const SplineVotes fast = voter.Vote(scene.grid, scene.start, scene.curvature_per_m, scene.goal);
  const SplineVotes plain =
      ReferenceVotes(params, scene.grid, scene.start, scene.curvature_per_m, scene.goal);
  EXPECT_EQ(fast.size(), plain.size());
  const double error = params.votes.whole_numbers ? 0.0 : 1e-9;
  int allowed = 0;
  for (std::size_t i = 0; i < std::min(fast.size(), plain.size()); ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(fast[i].spline, plain[i].spline);
    EXPECT_NEAR(fast[i].hazard, plain[i].hazard, error);
    EXPECT_NEAR(fast[i].hazard_certainty, plain[i].hazard_certainty, error);
    EXPECT_NEAR(fast[i].waypoint, plain[i].waypoint, error);
    EXPECT_NEAR(math::WrapAngle(fast[i].waypoint_error_rad - plain[i].waypoint_error_rad), 0.0,
                1e-9);
    EXPECT_NEAR(fast[i].merged, plain[i].merged, error);
    EXPECT_EQ(fast[i].feasible, RateIsFeasible(params, kFullSpeed_m_s, plain[i].spline));
    allowed += fast[i].hazard > 0.0 ? 1 : 0;
  }
  return allowed;
}

GestaltParams FewKnots() {
  GestaltParams params;
  params.map.grid.xstep_m = params.map.grid.ystep_m = 0.17;
  params.splines.num_first_knots = 5;
  params.splines.num_second_knots = 4;
  return params;
}

TEST(GestaltSplines, VoteAsThePlainOnes) {
  core::RandomStream random({33, 0}, core::Purpose::kTest, 0);
  GestaltParams params;
  params.map.grid.xstep_m = params.map.grid.ystep_m = 0.17;
  int allowed = 0;
  for (const bool whole_numbers : {true, false}) {
    params.votes.whole_numbers = whole_numbers;
    for (int i = 0; i < 5; ++i) allowed += ExpectSameVotes(params, RandomScene(random, 9.0));
  }
  EXPECT_GT(allowed, 500);
  EXPECT_LT(allowed, 2000) << "of 2250: some are blocked";
}

// Goals nearer than the end of the splines: on this side of the first knot and beyond.
TEST(GestaltSplines, VoteAsThePlainOnesUpToTheGoal) {
  core::RandomStream random({34, 0}, core::Purpose::kTest, 0);
  GestaltParams params = FewKnots();
  params.votes.whole_numbers = false;
  for (int i = 0; i < 40; ++i) ExpectSameVotes(params, RandomScene(random, 3.2));
}

TEST(GestaltSplines, VoteAsThePlainOnesWithCurvatureInTime) {
  core::RandomStream random({35, 0}, core::Purpose::kTest, 0);
  GestaltParams params = FewKnots();
  params.votes.whole_numbers = false;
  params.splines.law = SplineLaw::kTime;
  params.speed.min_speed_share = 0.3;
  for (int i = 0; i < 40; ++i) ExpectSameVotes(params, RandomScene(random, 5.0));
}

// Other lengths, waypoints, samplings, limits of the turn and of the rate.
TEST(GestaltSplines, VoteAsThePlainOnesWhateverTheParameters) {
  core::RandomStream random({36, 0}, core::Purpose::kTest, 0);
  const auto uniform = [&random](double low, double high) {
    return low + (high - low) * random.Uniform();
  };
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    GestaltParams params = FewKnots();
    params.votes.whole_numbers = i % 2 == 0;
    params.splines.num_first_knots = 1 + i % 4;
    params.splines.length_m = uniform(0.4, 5.0);
    params.splines.waypoint_m = uniform(0.05, params.splines.length_m);
    params.splines.max_curvature_per_m = uniform(0.2, 3.0);
    params.splines.max_curvature_rate_per_m_s = uniform(0.02, 0.2);
    params.splines.law = i % 3 == 0 ? SplineLaw::kTime : SplineLaw::kDistance;
    params.speed.min_speed_share = uniform(0.2, 1.0);
    params.plan.plan_min_dist_m = i % 5 == 0 ? 0.0 : uniform(0.0, 2.0);
    params.plan.plan_max_dist_m = params.plan.plan_min_dist_m + uniform(0.05, 3.0);
    params.plan.max_path_turn_rad = uniform(0.2, 4.0);
    params.plan.samples_per_cell = 1 + i % 3;
    params.plan.unknown_cells = i % 4 == 0 ? UnknownCells::kByCertainty : UnknownCells::kFullWeight;
    ExpectSameVotes(params, RandomScene(random, 6.0));
  }
}

}  // namespace
}  // namespace rockyard::navigation
