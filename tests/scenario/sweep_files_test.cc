// The sweep files of the project.

#include <set>

#include "core/error.h"
#include "core/refusals.h"
#include "scenario/load.h"
#include "scenario/sweep.h"
#include "scenario/sweep_spec.h"

namespace rockyard::scenario {
namespace {

using core::Problem;
using testing::HasSubstr;

const std::filesystem::path kSweeps = ROCKYARD_SOURCE_DIR "/scenarios/sweeps";

TEST(SweepFilesTest, EveryFileIsASweepWithADescription) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kSweeps)) {
    if (entry.path().extension() != ".json") continue;
    SCOPED_TRACE(entry.path().filename().string());
    const Sweep sweep = LoadSweep(entry.path());
    EXPECT_EQ(sweep.name, entry.path().stem().string());
    EXPECT_FALSE(sweep.description.empty());
    ++files;
  }
  EXPECT_GE(files, 4);
}

TEST(SweepFilesTest, SuitesOfTheBenchmarkShowWhatTheirTrackReads) {
  const std::filesystem::path suites = ROCKYARD_SOURCE_DIR "/scenarios/bench";
  for (const std::string track : {"points", "map", "images"}) {
    SCOPED_TRACE(track);
    const Sweep suite = LoadSweep(suites / (track + ".json"));
    EXPECT_EQ(suite.name, track);
    EXPECT_TRUE(suite.common_random_numbers);
    for (const SweepCell& cell : suite.cells) {
      const trial::DriveParams& drive = cell.scenario.drive;
      EXPECT_EQ(drive.course.site_map.kind != trial::SiteMapKind::kNone, track == "map");
      const sensing::StereoParams* cameras = drive.sensors.terrain_sensors.chosen().cameras(drive);
      ASSERT_NE(cameras, nullptr);
      EXPECT_EQ(cameras->fidelity == sensing::StereoFidelity::kImage, track == "images");
    }
  }
}

TEST(SweepFilesTest, AbundanceVariesAbundanceAlone) {
  const Sweep sweep = LoadSweep(kSweeps / "abundance.json");
  std::set<std::uint64_t> rest;
  for (const SweepCell& cell : sweep.cells) {
    Scenario scenario = cell.scenario;
    scenario.drive.terrain.rocks.k_per_m2 = 0.00415;
    scenario.seed = 1;
    rest.insert(Fingerprint(scenario));
  }
  EXPECT_EQ(rest.size(), 1u);
  EXPECT_EQ(sweep.fit_axis, 0u);
}

// InSight's range, Viking Lander 1 and 2, Mars Pathfinder: scenarios/sites/README.md.
TEST(SweepFilesTest, SitesVaryTheCoverAlone) {
  const Sweep sweep = LoadSweep(kSweeps / "sites.json");
  std::vector<double> covers;
  std::set<std::uint64_t> rest;
  for (const SweepCell& cell : sweep.cells) {
    Scenario scenario = cell.scenario;
    EXPECT_EQ(scenario.drive.terrain.rocks.kind, terrain::RockFieldKind::kGolombek);
    covers.push_back(scenario.drive.terrain.rocks.cover);
    scenario.drive.terrain.rocks.cover = 0.069;
    rest.insert(Fingerprint(scenario));
  }
  EXPECT_EQ(covers, (std::vector{0.01, 0.04, 0.069, 0.176, 0.19}));
  EXPECT_EQ(rest.size(), 1u);
}

// Sand, half of nominal terrain, nominal, twice it, Viking Lander 2: Matthies 1995, section 7.
TEST(SweepFilesTest, DeadReckoningIsSweptOverAbundanceDistanceAndItsErrors) {
  const Sweep abundance = LoadSweep(kSweeps / "dead_reckoning_abundance.json");
  ASSERT_EQ(abundance.cells.size(), 5u);
  EXPECT_EQ(abundance.cells[0].scenario.drive.terrain.rocks.k_per_m2, 0.0);
  EXPECT_EQ(abundance.cells[2].scenario.drive.terrain.rocks.k_per_m2, 0.00415);
  EXPECT_EQ(abundance.cells[4].scenario.drive.terrain.rocks.k_per_m2, 0.013);

  const Sweep distance = LoadSweep(kSweeps / "dead_reckoning_distance.json");
  ASSERT_EQ(distance.cells.size(), 7u);
  for (const SweepCell& cell : distance.cells) {
    EXPECT_EQ(cell.scenario.drive.terrain.arena.kind, terrain::ArenaKind::kOpen);
  }
  EXPECT_EQ(distance.cells[4].scenario.drive.course.goal_x_m, 10.0);

  const Sweep shares = LoadSweep(kSweeps / "dead_reckoning_shares.json");
  ASSERT_EQ(shares.cells.size(), 8u);
  const sensing::GyroParams& as_flown = shares.cells.front().scenario.drive.sensors.gyro;
  EXPECT_EQ(as_flown.heading_variance_deg2_per_m, 0.70);
  EXPECT_EQ(as_flown.scale, 0.94);
  EXPECT_TRUE(as_flown.scrape.enabled);
  const sensing::GyroParams& perfect = shares.cells.back().scenario.drive.sensors.gyro;
  EXPECT_EQ(perfect.heading_variance_deg2_per_m, 0.0);
  EXPECT_EQ(perfect.scale, 1.0);
  EXPECT_FALSE(perfect.scrape.enabled);
}

TEST(SweepFilesTest, NavigatorsMeetTheSameRocks) {
  const Sweep sweep = LoadSweep(kSweeps / "navigators.json");
  const std::vector<std::string> navigators{"pathfinder", "gestalt", "enav"};
  ASSERT_EQ(sweep.cells.size(), 4 * navigators.size());
  for (std::size_t i = 0; i < sweep.cells.size(); ++i) {
    const Scenario& first = sweep.cells[i % 4].scenario;
    const Scenario& cell = sweep.cells[i].scenario;
    EXPECT_EQ(cell.seed, first.seed);
    EXPECT_EQ(cell.drive.navigation.navigators.chosen().name(), navigators[i / 4]);
    EXPECT_EQ(cell.drive.terrain.rocks.k_per_m2, first.drive.terrain.rocks.k_per_m2);
    EXPECT_EQ(cell.drive.course.goal_x_m, first.drive.course.goal_x_m);
    EXPECT_EQ(cell.drive.perception.dead_reckoning.distance_scale,
              first.drive.perception.dead_reckoning.distance_scale);
  }
}

// Everything that can be wrong with a sweep file: path, reason and suggestion.

std::vector<Problem> ProblemsOf(std::string_view json, const SweepChanges& changes = {}) {
  return core::ProblemsIn([&] { ParseSweep(json, changes); });
}

using BadSweep = core::BadInput;

class BadSweepTest : public testing::TestWithParam<BadSweep> {};

TEST_P(BadSweepTest, NamesPathReasonAndSuggestion) {
  EXPECT_THAT(ProblemsOf(GetParam().json), IsProblemOf(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(
    Files, BadSweepTest,
    testing::Values(
        BadSweep{"no_object", "[]", "(root)", "a list", "write an object"},
        BadSweep{"truncated", R"({"axes": [)", "sweep", "line 1", "strict JSON"},
        BadSweep{"unknown_key", R"({"axis": [], "axes": [{"path": "seed", "values": [1]}]})",
                 "axis", "not a known key", "did you mean \"axes\"?"},
        BadSweep{"no_axes", R"({"axes": null})", "axes", "is null", "write [...]"},
        BadSweep{"design", R"({"design": {"kind": "gird"},
                 "axes": [{"path": "course.goal_x_m", "values": [5]}]})",
                 "design.kind", "not a known name", "did you mean \"grid\"?"},
        BadSweep{"trials", R"({"trials": 0, "axes": [{"path": "course.goal_x_m", "values": [5]}]})",
                 "trials", "below the smallest", "from 1"},
        BadSweep{"bad_name", R"({"name": "a\u0007", "axes": [{"path": "course.goal_x_m",
                 "values": [5]}]})",
                 "name", "control character", "letters"},
        BadSweep{"set", R"({"set": 3, "axes": [{"path": "course.goal_x_m", "values": [5]}]})",
                 "set", "is 3, not an object", "write {"},
        BadSweep{"scenario", R"({"scenario": 3, "axes": [{"path": "course.goal_x_m",
                 "values": [5]}]})",
                 "scenario", "is 3, not a scenario", "name a scenario file"},
        BadSweep{"missing_file", R"({"scenario": "none.json", "axes": [{"path": "course.goal_x_m",
                 "values": [5]}]})",
                 "scenario", "does not exist", "check the name"},
        BadSweep{"sweep_in_sweep", R"({"scenario": {"axes": []}, "axes": [{"path":
                 "course.goal_x_m", "values": [5]}]})",
                 "scenario", "is a sweep", "name a scenario file"},
        BadSweep{"list_without_cells", R"({"design": {"kind": "list"}})", "cells", "is missing",
                 "write [{"},
        BadSweep{"cells_in_a_grid", R"({"axes": [{"path": "course.goal_x_m", "values": [5]}],
                 "cells": [{"name": "a"}]})",
                 "cells", "has no meaning in design other than list", "remove it"},
        BadSweep{"axes_in_a_list", R"({"axes": [{"path": "course.goal_x_m", "values": [5]}],
                 "cells": [{"name": "a"}], "design": {"kind": "list"}})",
                 "axes", "has no meaning in design list", "remove it"},
        BadSweep{"fit_axis", R"({"fit": {"axis": "goal_x"}, "axes": [{"path": "course.goal_x_m",
                 "values": [5]}]})",
                 "fit.axis", "is no axis of numbers", "did you mean \"goal_x_m\"?"},
        BadSweep{"too_many", R"({"axes": [
                 {"path": "course.goal_x_m", "from": 5, "to": 6, "steps": 200},
                 {"path": "course.goal_radius_m", "from": 0.5, "to": 1, "steps": 200}]})",
                 "axes", "make 40000 cells, more than 10000", "sobol"}));

TEST(SweepCells, AsManyAsAreAllowed) {
  SweepSpec spec;
  spec.axes.resize(2);
  for (AxisSpec& axis : spec.axes) axis.levels.resize(100);
  EXPECT_EQ(DesignCells(spec).size(), kMaxSweepCells);
}

INSTANTIATE_TEST_SUITE_P(
    Axes, BadSweepTest,
    testing::Values(
        BadSweep{"path", R"({"axes": [{"path": "terain.rocks.k_per_m2", "values": [0.1]}]})",
                 "axes[0].path", "is no parameter", "did you mean \"terrain.rocks.k_per_m2\"?"},
        BadSweep{"group", R"({"axes": [{"path": "terrain.rocks", "values": [1]}]})", "axes[0].path",
                 "a group of parameters", "name one of them"},
        BadSweep{"no_path", R"({"axes": [{"name": "k", "values": [1]}]})", "axes[0].path",
                 "is missing", "name a parameter"},
        BadSweep{"path_beside_levels", R"({"axes": [{"name": "a", "path": "seed",
                 "levels": [{"name": "x"}]}]})",
                 "axes[0].path", "no meaning beside named levels", "remove it"},
        BadSweep{"several", R"({"axes": [{"path": "course.goal_x_m", "values": [1],
                 "levels": []}]})",
                 "axes[0]", "has several of", "keep one"},
        BadSweep{"range_and_values", R"({"axes": [{"path": "course.goal_x_m", "values": [5],
                 "from": 1}]})",
                 "axes[0]", "range beside its levels", "remove from"},
        BadSweep{"no_values", R"({"axes": [{"path": "course.goal_x_m", "values": []}]})",
                 "axes[0].values", "not a list with elements", "write [...]"},
        BadSweep{"twice", R"({"axes": [{"path": "course.goal_x_m", "values": [5, 5.0]}]})",
                 "axes[0]", "has the level \"5\" twice", "keep one"},
        BadSweep{"backwards", R"({"axes": [{"path": "course.goal_x_m", "from": 5, "to": 5,
                 "steps": 2}]})",
                 "axes[0].to", "not above from", "smaller value first"},
        BadSweep{"no_logarithm", R"({"axes": [{"path": "course.goal_x_m", "from": 0, "to": 5,
                 "steps": 2, "scale": "log"}]})",
                 "axes[0].from", "no logarithm", "positive"},
        BadSweep{"no_range", R"({"axes": [{"path": "course.goal_x_m"}]})", "axes[0]",
                 "no study range", "\"from\" and \"to\""},
        BadSweep{"grid_range", R"({"axes": [{"path": "course.goal_radius_m"}]})", "axes[0]",
                 "a range without steps", "add \"steps\""},
        BadSweep{"steps", R"({"axes": [{"path": "course.goal_x_m", "from": 4, "to": 5,
                 "steps": 1}]})",
                 "axes[0].steps", "below the smallest", "from 2"},
        BadSweep{"unnamed_level", R"({"axes": [{"name": "a", "levels": [{"set": {}}]}]})",
                 "axes[0].levels[0].name", "is missing", "give it a name"},
        BadSweep{"level_key", R"({"axes": [{"name": "a", "levels": [{"name": "x", "sett": {}}]}]})",
                 "axes[0].levels[0].sett", "not a known key", "did you mean \"set\"?"},
        BadSweep{"no_file", R"({"axes": [{"scenarios": [3]}]})", "axes[0].scenarios[0]",
                 "not the name of a file", "write a path"},
        BadSweep{"same_axis", R"({"axes": [{"path": "course.goal_x_m", "values": [5]},
                 {"name": "goal_x_m", "levels": [{"name": "x"}]}]})",
                 "axes[1].name", "as another axis is called", "name of its own"}));

INSTANTIATE_TEST_SUITE_P(
    Cells, BadSweepTest,
    testing::Values(
        BadSweep{"impossible", R"({"axes": [{"path": "terrain.rocks.k_per_m2",
                 "values": [0.001, -1]}]})",
                 "cell k_per_m2=-1: terrain.rocks.k_per_m2", "below the smallest", "use a value"},
        BadSweep{"unknown_setting", R"({"axes": [{"name": "a", "levels": [{"name": "x",
                 "set": {"course.gaol_x_m": 5}}]}]})",
                 "cell a=x: course.gaol_x_m", "not a known key", "goal_x_m"},
        BadSweep{"overlaid", R"({"set": {"course.goal_x_m": 4}, "axes": [
                 {"path": "course.goal_x_m", "values": [5]}]})",
                 "cell goal_x_m=5: course.goal_x_m",
                 "was set to 4, but is 5.0 in the resolved scenario", "keep one of them"},
        BadSweep{"axis_over_axis", R"({"axes": [{"path": "course.goal_x_m", "values": [5]},
                 {"name": "a", "levels": [{"name": "x", "set": {"course": {"goal_x_m": 6}}}]}]})",
                 "cell goal_x_m=5,a=x: course.goal_x_m", "was set to 5, but is 6", "keep one"},
        BadSweep{"no_effect", R"({"axes": [{"name": "a", "levels": [{"name": "x"},
                 {"name": "y", "set": {"course.goal_x_m": 7.6}}]}]})",
                 "cell a=y: (scenario)", "is the same as that of cell a=x", "has no effect"},
        BadSweep{"measurement", R"({"set": {"experiment": "hazard_detection"}, "axes": [
                 {"path": "course.goal_radius_m", "values": [0.6]}]})",
                 "cell goal_radius_m=0.6: experiment", "is hazard_detection", "rockyard run"},
        BadSweep{"seed", R"({"axes": [{"path": "seed", "values": [2]}]})", "cell seed=2: seed",
                 "cells get it from the sweep", "\"seed\" beside"}));

TEST(SweepErrorsTest, EverythingWrongIsSaidAtOnce) {
  const std::vector<Problem> problems = ProblemsOf(
      R"({"seed": -1, "fit": {"scale": "cubic"}, "axes": [
          {"path": "nothing", "values": [1]}, {"path": "course.goal_x_m"}, 5]})");
  ASSERT_EQ(problems.size(), 5u);
  EXPECT_EQ(problems[0].path, "seed");
  EXPECT_EQ(problems[1].path, "fit.scale");
  EXPECT_EQ(problems[2].path, "axes[0].path");
  EXPECT_EQ(problems[3].path, "axes[1]");
  EXPECT_EQ(problems[4].path, "axes[2]");
}

TEST(SweepErrorsTest, WhatManyCellsShareIsSaidOnce) {
  EXPECT_THAT(ProblemsOf(R"({"axes": [{"path": "course.goal_x_m", "values": [5, 6, 7]},
                   {"path": "terrain.rocks.k_per_m2", "values": [-1, 0.01]}]})"),
              core::OneProblem("cell goal_x_m=5,k_per_m2=-1: terrain.rocks.k_per_m2",
                               "(and so in 2 more cells)"));
}

TEST(SweepErrorsTest, AnOverrideOfAnAxisIsRefused) {
  EXPECT_THAT(
      ProblemsOf(R"({"axes": [{"path": "course.goal_x_m", "values": [5]}]})",
                 {.overrides = {"course.goal_x_m=4"}, .trials = {}, .seed = {}}),
      core::OneProblem("cell goal_x_m=5: course.goal_x_m", "was set to 4, but is 5", "--set"));
}

TEST(SweepErrorsTest, AScenarioIsNoSweep) {
  const std::string file = ROCKYARD_SOURCE_DIR "/scenarios/pathfinder/nominal.json";
  EXPECT_THAT(core::ProblemsIn([&] { LoadSweep(file); }),
              core::OneProblem(file, "is no sweep", "rockyard run"));
}

TEST(SweepErrorsTest, AtMostAHundredProblemsAreListed) {
  std::string values;
  for (int i = 1; i <= 150; ++i) values += (i > 1 ? ", -" : "-") + std::to_string(i);
  const std::vector<Problem> problems =
      ProblemsOf(R"({"axes": [{"path": "terrain.rocks.k_per_m2", "values": [)" + values + "]}]}");
  ASSERT_EQ(problems.size(), 101u);
  EXPECT_THAT(problems.back().reason, HasSubstr("50 more"));
}

}  // namespace
}  // namespace rockyard::scenario
