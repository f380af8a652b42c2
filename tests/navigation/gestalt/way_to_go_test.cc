// Costs to go against closed forms, brute force and Dijkstra's algorithm on the corners.
#include "navigation/gestalt/way_to_go.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

#include "core/random.h"
#include "grids.h"
#include "navigation/gestalt/way_votes.h"

namespace rockyard::navigation {
namespace {

// A square of cells around the origin, whose costs are those of `cost` at their centres.
CostField FieldOf(const std::function<double(double x_m, double y_m)>& cost, int cells = 50) {
  CostField field;
  field.x0_m = field.y0_m = -0.1 * cells;
  field.nx = field.ny = cells;
  for (int iy = 0; iy < cells; ++iy) {
    for (int ix = 0; ix < cells; ++ix) {
      field.cost_per_m.push_back(
          cost(field.x0_m + (ix + 0.5) * 0.2, field.y0_m + (iy + 0.5) * 0.2));
    }
  }
  return field;
}

double CostFrom(const CostField& field, double x_m, double y_m) {
  return field.At((x_m - field.x0_m) / field.cell_m, (y_m - field.y0_m) / field.cell_m);
}

// Dijkstra's algorithm along sides and diagonals, from the corner nearest to the origin.
std::vector<double> AlongEdges(const CostField& field) {
  const int n = field.nx;
  std::vector<double> cost(CellIndex(0, n + 1, n + 1), 1e9);
  using Entry = std::pair<double, std::pair<int, int>>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  open.push({0.0, {n / 2, n / 2}});
  const auto cell = [&](int ix, int iy) {
    const bool inside = ix >= 0 && ix < n && iy >= 0 && iy < n;
    return inside ? field.cost_per_m[CellIndex(ix, iy, n)] : 1e9;
  };
  while (!open.empty()) {
    const auto [so_far, at] = open.top();
    const auto [ix, iy] = at;
    open.pop();
    double& best = cost[CellIndex(ix, iy, n + 1)];
    if (so_far >= best) continue;
    best = so_far;
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        if (ix + dx < 0 || ix + dx > n || iy + dy < 0 || iy + dy > n) continue;
        double per_m = cell(dx < 0 ? ix - 1 : ix, dy < 0 ? iy - 1 : iy);
        if (dx == 0) per_m = std::min(cell(ix - 1, dy < 0 ? iy - 1 : iy), per_m);
        if (dy == 0) per_m = std::min(cell(dx < 0 ? ix - 1 : ix, iy - 1), per_m);
        open.push({so_far + per_m * field.cell_m * std::hypot(dx, dy), {ix + dx, iy + dy}});
      }
    }
  }
  return cost;
}

TEST(CrossingCostTest, IsTheLeastOverAllPlacesToCross) {
  for (const double gain : {-0.3, 0.0, 0.05, 0.1, 0.14, 0.2, 0.4}) {
    double least = 1e9;
    for (int i = 0; i <= 10000; ++i) {
      const double t = 1e-4 * i;
      least = std::min(least, 2.0 - t * gain + 0.2 * std::sqrt(1.0 + t * t));
    }
    EXPECT_NEAR(CrossingCost(2.0, 2.0 - gain, 0.2), least, 1e-8) << gain;
  }
}

// Never less than straight, never more than along sides and diagonals, which take up to 8 % more.
TEST(CostFieldTest, OnUniformGroundIsTheDistance) {
  CostField field = FieldOf([](double, double) { return 1.0; });
  field.Search({0.0, 0.0}, 1.0);
  const std::vector<double> edges = AlongEdges(field);
  for (int iy = 0; iy <= 50; ++iy) {
    for (int ix = 0; ix <= 50; ++ix) {
      const double straight_m = std::hypot(field.x0_m + 0.2 * ix, field.y0_m + 0.2 * iy);
      const std::size_t at = CellIndex(ix, iy, 51);
      ASSERT_GE(field.to_go[at], straight_m - 1e-9);
      ASSERT_LE(field.to_go[at], 1.04 * straight_m + 1e-9);
      ASSERT_LE(field.to_go[at], edges[at] + 1e-9);
    }
  }
}

TEST(CostFieldTest, OnAnyGroundIsNoMoreThanAlongEdges) {
  core::RandomStream random({5, 0}, core::Purpose::kTest);
  CostField field = FieldOf([&](double, double) { return 1.0 + 9.0 * random.Uniform(); });
  field.Search({0.0, 0.0}, 1.0);
  const std::vector<double> edges = AlongEdges(field);
  double gained = 0.0;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    ASSERT_LE(field.to_go[i], edges[i] + 1e-9);
    gained = std::max(gained, edges[i] - field.to_go[i]);
  }
  EXPECT_GT(gained, 0.1);
}

// A way from ground of cost 1 into ground of cost 3 bends as light does: the least over all places
// to cross x = 1.
TEST(CostFieldTest, BendsWhereTheGroundChanges) {
  CostField field = FieldOf([](double x, double) { return x < 1.0 ? 1.0 : 3.0; });
  field.Search({0.0, 0.0}, 1.0);
  double least = 1e9;
  for (double y = 0.0; y <= 4.0; y += 1e-3) {
    least = std::min(least, std::hypot(1.0, y) + 3.0 * std::hypot(2.0, 4.0 - y));
  }
  EXPECT_NEAR(CostFrom(field, 3.0, 4.0), least, 0.02 * least);
  EXPECT_GT(3.0 * 5.0, 1.2 * least);  // straight on is no way
}

TEST(CostFieldTest, LeadsRoundAWall) {
  CostField field = FieldOf(
      [](double x, double y) { return x > -1.0 && x < -0.6 && y > -5.0 && y < 2.0 ? 50.0 : 1.0; });
  field.Search({0.0, 0.0}, 1.0);
  const double round_m = std::hypot(0.6, 2.0) + 0.4 + std::hypot(2.0, 2.0);
  EXPECT_NEAR(CostFrom(field, -3.0, 0.0), round_m, 0.03 * round_m);
}

TEST(CostFieldTest, AGoalBeyondTheWindowLiesStraightOn) {
  CostField field = FieldOf([](double, double) { return 1.0; });
  field.Search({12.0, 5.0}, 2.0);
  // To the edge at x = 5 by a metre a metre, then two: crossed where that is least.
  double least = 1e9;
  for (double y = 0.0; y <= 5.0; y += 1e-3) {
    least = std::min(least, std::hypot(5.0, y) + 2.0 * std::hypot(7.0, 5.0 - y));
  }
  EXPECT_NEAR(CostFrom(field, 0.0, 0.0), least, 0.01 * least);
}

// What is remembered moves with the lattice, and a wall stays one that a later look takes for
// ground, unless the latest look counts.
TEST(WayToGoTest, RemembersWhatItHasSeen) {
  const auto wall = [](double x, double y) { return x > 1.0 && x < 1.4 && std::abs(y) < 4.0; };
  const GoodnessGrid seen =
      GridOf([&](double x, double y) { return wall(x, y) ? kObstacle : kGood; });
  GoodnessGrid ahead = UniformGrid(kUnknownCell);
  ahead.x0_m += 2.0;
  for (const SeenAgain again :
       {SeenAgain::kWorst, SeenAgain::kLatest, SeenAgain::kWorstWhileOpen}) {
    GestaltParams params;
    params.remedies.cost_to_go.enabled = true;
    params.remedies.cost_to_go.seen_again = again;
    WayToGo way(params);
    way.Plan(seen, {3.0, 0.0}, 0.0, 0.0);
    const double round_m = way.From_m(0.0, 0.0);
    EXPECT_NEAR(round_m, std::hypot(1.0, 4.0) + 0.4 + std::hypot(1.6, 4.0), 0.5);
    way.Plan(ahead, {3.0, 0.0}, 0.0, 0.0);
    EXPECT_NEAR(way.From_m(0.0, 0.0), round_m, 0.2);
    way.Plan(UniformGrid(kGood), {3.0, 0.0}, 0.0, 0.0);
    const bool forgets = again == SeenAgain::kLatest;
    EXPECT_NEAR(way.From_m(0.0, 0.0), forgets ? 3.0 : round_m, 0.2);
    way.Forget();
    way.Plan(UniformGrid(kGood), {3.0, 0.0}, 0.0, 0.0);
    EXPECT_NEAR(way.From_m(0.0, 0.0), 3.0, 0.1);
  }
}

// Walls all round that a later look takes for ground: by the worst the way leads through, at 50 a
// metre; where nothing else is open, at sqrt(50).
TEST(WayToGoTest, DoubtsWhatLeavesNoWay) {
  const GoodnessGrid pit = GridOf([](double x, double y) {
    const double from_middle_m = std::max(std::abs(x), std::abs(y));
    return from_middle_m > 1.0 && from_middle_m < 1.4 ? kObstacle : kGood;
  });
  for (const auto& [again, through] :
       {std::pair{SeenAgain::kWorst, 50.0}, {SeenAgain::kWorstWhileOpen, std::sqrt(50.0)}}) {
    GestaltParams params;
    params.remedies.cost_to_go.enabled = true;
    params.remedies.cost_to_go.seen_again = again;
    WayToGo way(params);
    way.Plan(pit, {3.0, 0.0}, 0.0, 0.0);
    EXPECT_NEAR(way.From_m(0.0, 0.0), 2.6 + 0.4 * 50.0, 0.2);
    way.Plan(UniformGrid(kGood), {3.0, 0.0}, 0.0, 0.0);
    EXPECT_NEAR(way.From_m(0.0, 0.0), 2.6 + 0.4 * through, 0.2);
  }
}

// Out of dear ground, or into it, is no way across it.
TEST(CostFieldTest, KnowsWhetherTheWayCrossesDearGround) {
  const auto crosses = [](double x_m, double y_m, const std::function<bool(double, double)>& dear) {
    CostField field = FieldOf([&](double x, double y) { return dear(x, y) ? 50.0 : 1.0; });
    field.Search({0.0, 0.0}, 1.0);
    return field.Crosses((x_m - field.x0_m) / 0.2, (y_m - field.y0_m) / 0.2, 50.0);
  };
  const auto wall = [](double x, double) { return x > -1.0 && x < -0.6; };
  EXPECT_TRUE(crosses(-3.0, 0.7, wall));
  EXPECT_FALSE(crosses(3.0, 0.7, wall));
  EXPECT_FALSE(crosses(-0.8, 0.7, wall));
  EXPECT_FALSE(crosses(-3.0, 0.0, [](double x, double y) { return std::hypot(x, y) < 0.5; }));
  EXPECT_FALSE(
      crosses(-3.0, 0.0, [](double x, double y) { return x > -1.0 && x < -0.6 && y < 2.0; }));
}

// A metre costs 1 at goodness 255, rough_cost just above what may not be driven, linearly between,
// and blocked_cost from there on.
TEST(WayToGoTest, CostsByGoodness) {
  GestaltParams params;
  params.remedies.cost_to_go.enabled = true;
  params.remedies.cost_to_go.rough_cost = 3.0;
  params.remedies.cost_to_go.blocked_cost = 7.0;
  for (const auto& [goodness, cost] : {std::pair{255, 1.0}, {102, 2.2}, {11, 2.914}, {10, 7.0}}) {
    WayToGo way(params);
    way.Plan(UniformGrid({static_cast<std::uint8_t>(goodness), 255, true}), {3.0, 0.0}, 0.0, 0.0);
    EXPECT_NEAR(way.From_m(0.0, 0.0), 3.0 * cost, 0.01 * cost) << goodness;
  }
}

const messages::MotionVote& Straight(const std::vector<messages::MotionVote>& arcs) {
  return arcs[arcs.size() / 2];
}

// Ahead, backward, and after a turn in place by 90 deg, with 1.5 m of each driven and a vote of 0
// where 4 m are lost.
TEST(WayVoterTest, VotesFallWithTheWayThatIsLost) {
  GestaltParams params;
  params.votes.whole_numbers = false;
  params.remedies.cost_to_go.enabled = true;
  params.remedies.cost_to_go.loss_m = 4.0;
  const GoodnessGrid grid = UniformGrid(kGood);
  const messages::Goal goal{4.0, 0.0};
  WayToGo way(params);
  way.Plan(grid, goal, 0.0, 0.0);
  MotionVotes votes = ArcVoter(params).Vote(grid, {}, goal);
  WayVoter(params).Vote({}, goal, way, votes);
  EXPECT_NEAR(Straight(votes.forward).waypoint, 255.0, 1.0);
  EXPECT_NEAR(Straight(votes.backward).waypoint, 255.0 * (1.0 - 3.0 / 4.0), 2.0);
  const double aside_m = 1.5 + std::hypot(4.0, 1.5);
  for (const messages::MotionVote& turn : votes.point_turns) {
    EXPECT_NEAR(turn.waypoint, 255.0 * (1.0 - (aside_m - 4.0) / 4.0), 5.0);
    EXPECT_NEAR(turn.merged, (255.0 * 255.0 + 192.0 * turn.waypoint) / (255.0 + 192.0), 1e-9);
  }
}

// What may not be driven is no best motion: those that may be have the best vote.
TEST(WayVoterTest, TheBestIsOneThatMayBeDriven) {
  GestaltParams params;
  params.remedies.cost_to_go.enabled = true;
  params.remedies.cost_to_go.blocked_cost = 1.0;  // the way leads through the rock
  const GoodnessGrid grid = GridWithDisc(1.2, 0.0, 0.5);
  const messages::Goal goal{4.0, 0.0};
  WayToGo way(params);
  way.Plan(grid, goal, 0.0, 0.0);
  MotionVotes votes = ArcVoter(params).Vote(grid, {}, goal);
  WayVoter(params).Vote({}, goal, way, votes);
  ASSERT_EQ(Straight(votes.forward).hazard, 0.0);
  double best = 0.0;
  for (const messages::MotionVote& arc : votes.forward) {
    if (arc.hazard > params.drive.min_drive_goodness) best = std::max(best, arc.waypoint);
  }
  EXPECT_EQ(best, 255.0);
}

// Splines by the same rule: straight on, and one that turns aside.
TEST(WayVoterTest, VotesOnSplines) {
  GestaltParams params;
  params.votes.whole_numbers = false;
  params.remedies.cost_to_go.enabled = true;
  const messages::Goal goal{9.0, 0.0};
  const GoodnessGrid grid = UniformGrid(kGood);
  WayToGo way(params);
  way.Plan(grid, goal, 0.0, 0.0);
  SplineVotes votes(2);
  votes[0] = {.spline = {.length_m = 3.0}, .hazard = 255.0, .feasible = true};
  votes[1] = {.spline = {1.0, 1.0, 1.0, 3.0}, .hazard = 255.0, .feasible = true};
  WayVoter(params).Vote({}, goal, way, votes);
  const double ends_m = std::hypot(9.0 - std::sin(3.0), 1.0 - std::cos(3.0));
  EXPECT_EQ(votes[0].waypoint, 255.0);
  EXPECT_NEAR(votes[1].waypoint, 255.0 * (1.0 - (ends_m - 6.0) / 3.0), 10.0);
}

}  // namespace
}  // namespace rockyard::navigation
