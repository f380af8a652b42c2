// The experiment arc_planning: its search against ways that are known, and its records.
#include "experiments/arc_planning/arc_planning.h"

#include <gmock/gmock.h>

#include "core/refusals.h"
#include "experiments/arc_planning/arc_search.h"
#include "experiments/scenario_experiment.h"
#include "scenario/shipped.h"

namespace rockyard::experiments {
namespace {

TEST(ArcSearch, GoesStraightWhereNothingIsInTheWay) {
  const ArcPlanningParams params;
  const double way_m = 5 * params.arc_m;
  const ArcSearch search =
      SearchArcs(params, {0.0, 0.0, 0.3}, {way_m * std::cos(0.3), way_m * std::sin(0.3)},
                 [](const math::Pose2&) { return true; });
  EXPECT_TRUE(search.found);
  EXPECT_DOUBLE_EQ(search.path_m, way_m);
  EXPECT_EQ(search.nodes, 5);
  EXPECT_EQ(search.checks, 5 * 5 * 9);
}

// A wall with one gap, 3 m to the left of the line: nothing shorter than two straight legs.
TEST(ArcSearch, FindsTheGapOfAWall) {
  ArcPlanningParams params;
  const auto outside = [](const math::Pose2& pose) {
    return std::abs(pose.x_m) > 5.0 || std::abs(pose.y_m) > 5.0;
  };
  const auto walled = [&](double gap_m) {
    return SearchArcs(params, {-4.0, 0.0, 0.0}, {4.0, 0.0}, [&](const math::Pose2& pose) {
      return !outside(pose) && !(std::abs(pose.x_m) < 0.2 && std::abs(pose.y_m - 3.0) > gap_m);
    });
  };
  const ArcSearch search = walled(0.8);
  EXPECT_TRUE(search.found);
  EXPECT_GE(search.path_m, 2.0 * std::hypot(4.0, 2.2) - params.goal_tolerance_m);
  EXPECT_LT(search.path_m, 14.0);
  const ArcSearch none = walled(0.0);
  EXPECT_FALSE(none.found);
  EXPECT_EQ(none.path_m, 0.0);
  EXPECT_LT(none.nodes, params.max_nodes);  // all that can be reached was
  params.max_nodes = 10;
  EXPECT_EQ(walled(0.8).nodes, 10);
  EXPECT_FALSE(walled(0.8).found);
}

const scenario::Scenario& Ghosh() {
  static const scenario::Scenario kGhosh = scenario::Shipped("arc_planning/ghosh_2018");
  return kGhosh;
}

std::size_t Place(const Experiment& experiment, std::string_view column) {
  const truth::RecordSchema& schema = experiment.schema();
  for (std::size_t i = 0; i < schema.size(); ++i) {
    if (schema[i].name == column) return i;
  }
  throw std::runtime_error("no such column");
}

// Runs cover the cells in turn; more rocks leave fewer places and, over 20 maps, fewer paths.
TEST(ArcPlanning, CountsOverCoversAndRisks) {
  ArcPlanningParams params;
  params.covers = {0.01, 0.1};
  params.risks = {0.0, 1e-3};
  params.maps_per_run = 10;
  params.poses_per_map = 40;
  const ArcPlanningExperiment experiment(params, Ghosh().drive);
  std::vector<truth::RecordValues> cells;
  for (std::uint64_t run = 0; run < 4; ++run) cells.push_back(experiment.Run(1, run).values);
  const auto value = [&](std::size_t cell, std::string_view column) {
    return cells[cell][Place(experiment, column)];
  };
  for (std::size_t cell = 0; cell < 4; ++cell) {
    EXPECT_EQ(value(cell, "cover"), cell < 2 ? 0.01 : 0.1);
    EXPECT_EQ(value(cell, "risk"), cell % 2 == 0 ? 0.0 : 1e-3);
    EXPECT_EQ(value(cell, "maps"), 10.0);
    EXPECT_EQ(value(cell, "poses"), 400.0);
    EXPECT_LE(value(cell, "found"), value(cell, "open_maps"));
    EXPECT_LE(value(cell, "unlikely") + value(cell, "likely"), value(cell, "refused"));
  }
  EXPECT_EQ(value(0, "found"), 10.0);
  EXPECT_LT(value(2, "found"), 10.0);
  EXPECT_GT(value(2, "refused"), 10.0 * value(0, "refused"));
  EXPECT_EQ(experiment.Run(1, 2).values, cells[2]);
}

TEST(ArcPlanning, RefusesWhatItCannotVary) {
  const auto complains = [](const std::string& change, const std::string& path) {
    return core::RefusalOf([&] {
             scenario::Shipped("arc_planning/ghosh_2018", {change});
           }).find(path) != std::string::npos;
  };
  EXPECT_TRUE(complains("terrain.rocks.cover_reference=0.1", "terrain.rocks.cover_reference"));
  EXPECT_TRUE(complains("arc_planning.map_side_m=9", "arc_planning.map_side_m"));
  EXPECT_TRUE(complains("arc_planning.covers=[]", "arc_planning.covers"));
}

}  // namespace
}  // namespace rockyard::experiments
