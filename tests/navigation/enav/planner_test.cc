// The tree of ENav, its cost map, and the choice among paths.
#include "navigation/enav/planner.h"

#include <map>
#include <set>

#include "navigation/enav/stance.h"

namespace rockyard::navigation {
namespace {

using math::DegToRad;
using messages::Goal;

// 14 turns, 11 arcs, 11 arcs: 1,694 paths of 1,848 arcs with 22,176 poses (Abcouwer 2020).
TEST(PathTree, HasThePublishedCounts) {
  const PathTree tree{EnavTreeParams()};
  EXPECT_EQ(tree.turns_rad().size(), 14u);
  EXPECT_EQ(tree.turns_rad()[7], 0.0);
  EXPECT_EQ(std::set(tree.turns_rad().begin(), tree.turns_rad().end()).size(), 14u);
  EXPECT_EQ(tree.ends().size(), 1694u);
  EXPECT_EQ(tree.arcs().size(), 1848u);
  std::size_t poses = 0;
  for (const TreeArc& arc : tree.arcs()) poses += arc.poses.size();
  EXPECT_EQ(poses, 22176u);
}

// The end of each path by small steps along turn and arcs.
TEST(PathTree, LeadsAlongItsArcs) {
  EnavTreeParams params;
  params.num_turns = 3;
  params.num_first_arcs = 3;
  params.num_second_arcs = 2;
  params.check_spacing_m = 0.7;  // does not divide 3 m
  const PathTree tree(params);
  ASSERT_EQ(tree.ends().size(), 18u);
  for (const int end : tree.ends()) {
    const TreeArc& last = tree.arcs()[static_cast<std::size_t>(end)];
    const TreeArc& first = tree.arcs()[static_cast<std::size_t>(last.before)];
    ASSERT_EQ(last.poses.size(), 5u);
    double x = 0.0, y = 0.0, heading = tree.turns_rad()[static_cast<std::size_t>(last.turn)];
    for (const double curvature : {first.curvature_per_m, last.curvature_per_m}) {
      for (int i = 0; i < 30000; ++i) {
        x += 1e-4 * std::cos(heading + 0.5e-4 * curvature);
        y += 1e-4 * std::sin(heading + 0.5e-4 * curvature);
        heading += 1e-4 * curvature;
      }
    }
    EXPECT_NEAR(last.poses.back().x_m, x, 1e-6);
    EXPECT_NEAR(last.poses.back().y_m, y, 1e-6);
    EXPECT_NEAR(math::WrapAngle(last.poses.back().heading_rad - heading), 0.0, 1e-6);
  }
}

TEST(PathTree, ScalesByWheelbase) {
  EnavParams params;
  EXPECT_EQ(ScaledTo(params, 1.13).tree.arc_m, 3.0);
  params.tree.lengths = TreeLengths::kByWheelbase;
  const EnavParams half = ScaledTo(params, 1.13);
  EXPECT_DOUBLE_EQ(half.tree.arc_m, 1.5);
  EXPECT_DOUBLE_EQ(half.tree.check_spacing_m, 0.125);
  EXPECT_DOUBLE_EQ(half.tree.max_curvature_per_m, 1.0);
  EXPECT_DOUBLE_EQ(half.drive.execute_arc_m, 0.5);
}

EnavMapParams SmallMap() {
  EnavMapParams params;
  params.cost_side_m = 20.0;
  return params;
}

// Points 10 cm apart in a square about the origin.
void Cover(CostMap& map, double half_m, const Ground& ground) {
  const int n = static_cast<int>(10 * half_m);
  for (int i = -n; i <= n; ++i) {
    for (int j = -n; j <= n; ++j) map.Add({0.1 * i, 0.1 * j, ground(0.1 * i, 0.1 * j)});
  }
}

TEST(CostMap, CostsWhatThePlanesSay) {
  EnavMapParams params = SmallMap();
  CostMap map(params, 0.05, 0.6);
  // 10 deg to the left of x = 0, to its right +-6 cm in turns.
  Cover(map, 6.0, [](double x, double y) {
    const bool odd = (std::lround(10 * x) + std::lround(10 * y)) % 2 != 0;
    return x < 0.0 ? std::tan(DegToRad(10.0)) * x : odd ? 0.06 : -0.06;
  });
  map.Update(0.0, 0.0);
  EXPECT_NEAR(map.Cost_s_per_m(-3.2, 0.2), 20.0 * (1.0 + 10.0 / 25.0), 1e-6);
  EXPECT_NEAR(map.Cost_s_per_m(3.2, 0.2), 20.0 * (1.0 + 10.0 * 0.01), 0.02);
  EXPECT_DOUBLE_EQ(map.Cost_s_per_m(8.0, 8.0), 40.0);   // unseen
  EXPECT_DOUBLE_EQ(map.Cost_s_per_m(50.0, 8.0), 40.0);  // beyond the window
  EXPECT_EQ(map.FlatCost_s_per_m(), 20.0);
}

// Along axes and diagonals ways over flat ground are as long as they are; across unseen ground they
// cost twice as much; a wall has to be gone round.
TEST(CostMap, KnowsTheWayToTheGoal) {
  CostMap map(SmallMap(), 0.05, 0.6);
  Cover(map, 8.0, [](double, double) { return 0.0; });
  map.Update(5.25, 0.25);
  EXPECT_NEAR(map.ToGo_s(-3.75, 0.25), 9.0 * 20.0, 1e-9);
  EXPECT_NEAR(map.ToGo_s(2.25, 3.25), 3.0 * std::sqrt(2.0) * 20.0, 1e-9);
  EXPECT_NEAR(map.ToGo_s(-3.5, 0.25), 8.75 * 20.0, 1e-9);  // between middles
  // Beyond the window, straight on over unseen ground.
  map.Update(40.0, 0.0);
  EXPECT_NEAR(map.ToGo_s(30.0, 0.0), 10.0 * 40.0, 1e-9);
  EXPECT_NEAR(map.ToGo_s(7.75, 0.25), 0.5 * 20.0 + 32.0 * 40.0, 25.0);

  CostMap walled(SmallMap(), 0.05, 0.6);
  Cover(walled, 8.0, [](double x, double y) { return x > 1.0 && x < 1.4 && y < 4.0 ? 2.0 : 0.0; });
  walled.Update(5.25, 0.25);
  EXPECT_FALSE(std::isfinite(walled.Cost_s_per_m(1.2, 0.2)));
  EXPECT_FALSE(std::isfinite(walled.ToGo_s(1.2, 0.2)));
  const double straight_s = 9.0 * 20.0;
  // Round the wall's end at y = 4: two legs of 4.5 m along and 4 m across at least.
  EXPECT_GT(walled.ToGo_s(-3.75, 0.25), 20.0 * 2.0 * std::hypot(4.5, 4.0));
  EXPECT_LT(walled.ToGo_s(-3.75, 0.25), 1.6 * straight_s);
}

// A planner that has seen the ground around it.
struct Planning {
  EnavParams params;
  Ground ground = [](double, double) { return 0.0; };
  Goal goal{30.0, 0.0};

  EnavPlanner Seen() const {
    EnavPlanner planner(params, PerseveranceLike(), 0.042);
    messages::PointCloud cloud;
    for (int i = -90; i <= 90; ++i) {
      for (int j = -90; j <= 90; ++j) {
        cloud.points_R.push_back({0.1 * i + 0.05, 0.1 * j + 0.05, ground(0.1 * i, 0.1 * j)});
      }
    }
    planner.See(cloud, math::Transform::Identity());
    return planner;
  }
};

TEST(EnavPlanner, ChecksTheBestPathAloneWhereItPasses) {
  EnavPlanner planner = Planning{}.Seen();
  const EnavPlan plan = planner.Plan({}, {30.0, 0.0});
  EXPECT_TRUE(plan.found);
  EXPECT_EQ(plan.turn_rad, 0.0);
  EXPECT_EQ(plan.curvature_per_m, 0.0);
  EXPECT_EQ(plan.checks, 24);  // 6 m at 25 cm
  EXPECT_NEAR(plan.way.back().x_m, 6.0, 1e-12);
}

TEST(EnavPlanner, EndsAPathAtTheGoal) {
  EnavPlanner planner = Planning{}.Seen();
  const EnavPlan plan = planner.Plan({}, {2.0, 0.0});
  EXPECT_EQ(plan.checks, 8);
  EXPECT_NEAR(plan.way.back().x_m, 2.0, 1e-12);
  EXPECT_NEAR(plan.length_m, 2.0, 1e-12);
  const EnavPlan aside = planner.Plan({}, {0.0, 2.0});
  EXPECT_GT(aside.turn_rad, 0.5);
  EXPECT_LT(std::hypot(aside.way.back().x_m, aside.way.back().y_m - 2.0), 0.25);
}

// Held against all paths checked one after the other, each pose once: rocks in a ring beyond which
// some paths only lead.
TEST(EnavPlanner, FindsTheFirstPathThatPassesAndChecksNoPoseTwice) {
  Planning planning;
  planning.params.drive.over_budget = OverBudget::kGoOn;
  for (const double gap_rad : {0.35, 0.6, 1.0}) {
    planning.ground = [=](double x, double y) {
      const double r = std::hypot(x, y);
      return r > 5.2 && r < 5.6 && std::abs(std::atan2(y, -x)) > gap_rad ? 1.0 : 0.0;
    };
    planning.params.map.extreme_tilt_rad = DegToRad(80.0);  // costs are finite everywhere
    planning.params.map.eigen_ratio = 1.0;
    EnavPlanner planner = planning.Seen();
    const EnavPlan plan = planner.Plan({}, planning.goal);
    // Of all paths: which pass, and what they cost by the map.
    const Ace ace(planning.params.ace, PerseveranceLike());
    const auto& arcs = planner.tree().arcs();
    const double reach_m = std::hypot(1.185, 1.0625);
    std::map<double, int> by_cost;
    std::vector<double> driven_s(arcs.size());
    std::vector<std::size_t> passing(arcs.size());
    for (std::size_t a = 0; a < arcs.size(); ++a) {
      driven_s[a] =
          arcs[a].before >= 0
              ? driven_s[static_cast<std::size_t>(arcs[a].before)]
              : std::abs(planner.tree().turns_rad()[static_cast<std::size_t>(arcs[a].turn)]) *
                    reach_m / 0.042;
      for (const math::Pose2& pose : arcs[a].poses) {
        const bool own = std::max(std::abs(pose.x_m), std::abs(pose.y_m)) < 0.25;
        driven_s[a] += 0.25 * (own ? planner.costs().FlatCost_s_per_m()
                                   : planner.costs().Cost_s_per_m(pose.x_m, pose.y_m));
      }
      while (passing[a] < 12 && ace.Check(planner.heights(), arcs[a].poses[passing[a]]).safe()) {
        ++passing[a];
      }
    }
    for (const int end : planner.tree().ends()) {
      const math::Pose2& last = arcs[static_cast<std::size_t>(end)].poses.back();
      by_cost.emplace(
          driven_s[static_cast<std::size_t>(end)] + planner.costs().ToGo_s(last.x_m, last.y_m),
          end);
    }
    std::set<std::pair<std::size_t, std::size_t>> checked;
    std::optional<int> first;
    for (const auto& [cost, end] : by_cost) {
      bool passes = true;
      const auto e = static_cast<std::size_t>(end);
      for (const std::size_t a : {static_cast<std::size_t>(arcs[e].before), e}) {
        for (std::size_t i = 0; passes && i < 12; ++i) {
          checked.insert({a, i});
          passes = i < passing[a];
        }
      }
      if (!passes) continue;
      first = end;
      break;
    }
    EXPECT_EQ(plan.found, first.has_value());
    EXPECT_GT(plan.checks, 100);
    EXPECT_NEAR(static_cast<double>(plan.checks), static_cast<double>(checked.size()), 24.0);
    if (!first || !plan.found) continue;
    const math::Pose2& end = arcs[static_cast<std::size_t>(*first)].poses.back();
    EXPECT_NEAR(plan.way.back().x_m, end.x_m, 1e-12);
    EXPECT_NEAR(plan.way.back().y_m, end.y_m, 1e-12);
  }
}

TEST(EnavPlanner, SharesWhatItKnowsOfArcsAndKeepsToItsBudget) {
  Planning planning;
  planning.ground = [](double x, double y) {
    return (std::lround(10 * x) + std::lround(10 * y)) % 2 != 0 ? 0.4 : 0.0;
  };
  planning.params.map.extreme_tilt_rad = DegToRad(80.0);
  planning.params.map.eigen_ratio = 1.0;
  EnavPlanner planner = planning.Seen();
  // No pose passes: each of 14 x 11 first arcs fails once, and no path asks for it again.
  EnavPlan plan = planner.Plan({}, planning.goal);
  EXPECT_FALSE(plan.found);
  EXPECT_EQ(plan.checks, 154);
  EXPECT_FALSE(plan.over_budget);
  planning.params.drive.max_checks = 100;
  plan = planning.Seen().Plan({}, planning.goal);
  EXPECT_EQ(plan.checks, 100);
  EXPECT_TRUE(plan.over_budget);
  planning.params.drive.over_budget = OverBudget::kGoOn;
  EXPECT_EQ(planning.Seen().Plan({}, planning.goal).checks, 154);
  planning.params.tree.turn_check_rad = DegToRad(30.0);
  EXPECT_EQ(planning.Seen().Plan({}, planning.goal).checks, 13 + 11);  // turns fail before arcs
}

TEST(EnavPlanner, LeadsNoOutlineNearWhereAHazardWasFelt) {
  EnavPlanner planner = Planning{}.Seen();
  planner.Avoid({3.0, 0.0});
  const EnavPlan plan = planner.Plan({}, {30.0, 0.0});
  ASSERT_TRUE(plan.found);
  for (const math::Pose2& pose : plan.way) {
    const math::Pose2 at = math::SeenFrom(pose, {3.0, 0.0, 0.0});
    EXPECT_TRUE(std::abs(at.x_m) >= 1.393 + 0.1 || std::abs(at.y_m) >= 1.35 + 0.1);
  }
  planner.ForgetFelt();
  EXPECT_EQ(planner.Plan({}, {30.0, 0.0}).curvature_per_m, 0.0);
}

}  // namespace
}  // namespace rockyard::navigation
