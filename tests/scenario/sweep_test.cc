// Sweep files: cells, seeds, names, what of a document is kept, and axes that take causes of
// failure away.
#include "scenario/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/json_text.h"
#include "core/refusals.h"
#include "scenario/ablations.h"
#include "scenario/load.h"
#include "terrain/rock_params.h"

namespace rockyard::scenario {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> Names(const Sweep& sweep) {
  std::vector<std::string> names;
  for (const SweepCell& cell : sweep.cells) names.push_back(cell.name);
  return names;
}

constexpr std::string_view kGrid = R"({
  "name": "grid", "seed": 7, "trials": 20,
  "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001, 0.01]},
           {"name": "rover",
            "levels": [{"name": "slow", "set": {"rover.drive.speed_m_s": 0.05}},
                       {"name": "fast", "set": {"rover": {"drive": {"speed_m_s": 0.1}}}}]}]
})";

TEST(SweepTest, AGridHasItsLastAxisFastest) {
  const Sweep sweep = ParseSweep(kGrid);
  EXPECT_THAT(Names(sweep), ElementsAre("k_per_m2=0.001,rover=slow", "k_per_m2=0.001,rover=fast",
                                        "k_per_m2=0.01,rover=slow", "k_per_m2=0.01,rover=fast"));
  ASSERT_EQ(sweep.axes.size(), 2u);
  EXPECT_TRUE(sweep.axes[0].numeric);
  EXPECT_EQ(sweep.axes[0].unit, "1/m2");
  EXPECT_FALSE(sweep.axes[1].numeric);
  EXPECT_EQ(sweep.fit_axis, 0u);
  const SweepCell& last = sweep.cells[3];
  EXPECT_EQ(last.scenario.drive.terrain.rocks.k_per_m2, 0.01);
  EXPECT_EQ(last.scenario.drive.rover.drive.speed_m_s, 0.1);
  EXPECT_EQ(last.scenario.drive.rover.drive.stall_torque_Nm,
            Scenario{}.drive.rover.drive.stall_torque_Nm);
  EXPECT_EQ(last.scenario.trials, 20);
  EXPECT_EQ(last.scenario.name, "grid k_per_m2=0.01,rover=fast");
  EXPECT_EQ(last.levels[0].number, 0.01);
  EXPECT_EQ(last.levels[1].text, "fast");
}

// A setting means the same in a sweep, in its file and with rockyard run: an object takes the place
// of the whole group.
TEST(SweepTest, AnObjectReplacesAGroupAsItDoesInARun) {
  constexpr std::string_view kBase = R"({"course": {"goal_x_m": 5, "goal_radius_m": 0.7}})";
  const std::vector<std::string> overrides{R"(course={"goal_radius_m": 0.9})"};
  const Scenario run = ParseScenario(kBase, overrides);
  const std::string scenario = R"({"scenario": )" + std::string(kBase);
  const std::string axes = R"(, "axes": [{"path": "referee.time_limit_s", "values": [100, 200]}]})";
  const Sweep given =
      ParseSweep(scenario + axes, {.overrides = overrides, .trials = {}, .seed = {}});
  const Sweep written =
      ParseSweep(scenario + R"(, "set": {"course": {"goal_radius_m": 0.9}})" + axes);
  for (const Sweep* sweep : {&given, &written}) {
    EXPECT_EQ(sweep->cells[0].scenario.drive.course.goal_radius_m, 0.9);
    EXPECT_EQ(sweep->cells[0].scenario.drive.course.goal_x_m, run.drive.course.goal_x_m);
  }
  EXPECT_EQ(run.drive.course.goal_x_m, Scenario{}.drive.course.goal_x_m);
}

TEST(SweepTest, RangesAreSteppedLinearlyOrByRatios) {
  const Sweep linear =
      ParseSweep(R"({"axes": [{"path": "course.goal_x_m", "from": 2, "to": 8, "steps": 4}]})");
  EXPECT_THAT(Names(linear), ElementsAre("goal_x_m=2", "goal_x_m=4", "goal_x_m=6", "goal_x_m=8"));
  const Sweep log = ParseSweep(
      R"({"axes": [{"path": "terrain.rocks.k_per_m2", "from": 0.001, "to": 0.016, "steps": 5,
                    "scale": "log"}]})");
  EXPECT_THAT(Names(log), ElementsAre("k_per_m2=0.001", "k_per_m2=0.002", "k_per_m2=0.004",
                                      "k_per_m2=0.008", "k_per_m2=0.016"));
}

TEST(SweepTest, SettingsLieOverEachOtherInTheStatedOrder) {
  const Sweep sweep = ParseSweep(
      R"({"scenario": {"name": "base", "course": {"goal_x_m": 5}, "clock": {"control_rate_hz": 50}},
          "set": {"course.goal_y_m": 0.5},
          "axes": [{"name": "place", "levels": [
             {"name": "here"},
             {"name": "there", "scenario": {"course": {"goal_x_m": 6}}}]}]})",
      {.overrides = {"course.goal_radius_m=0.9"}, .trials = 3, .seed = 9});
  ASSERT_EQ(sweep.cells.size(), 2u);
  const Scenario& here = sweep.cells[0].scenario;
  const Scenario& there = sweep.cells[1].scenario;
  EXPECT_EQ(here.drive.course.goal_x_m, 5.0);
  EXPECT_EQ(here.drive.clock.control_rate_hz, 50.0);
  EXPECT_EQ(there.drive.course.goal_x_m, 6.0);
  EXPECT_EQ(there.drive.clock.control_rate_hz, Scenario{}.drive.clock.control_rate_hz)
      << "the scenario of a level takes the place of the base";
  for (const Scenario* each : {&here, &there}) {
    EXPECT_EQ(each->drive.course.goal_y_m, 0.5);
    EXPECT_EQ(each->drive.course.goal_radius_m, 0.9);
    EXPECT_EQ(each->trials, 3);
  }
  EXPECT_EQ(sweep.seed, 9u);
}

TEST(SweepTest, ListedCellsKeepTheirNames) {
  const Sweep sweep = ParseSweep(
      R"({"design": {"kind": "list"},
          "cells": [{"name": "plain"}, {"name": "steep", "set": {"terrain.ground.slope_deg": 10}}]})");
  EXPECT_THAT(Names(sweep), ElementsAre("plain", "steep"));
  EXPECT_FALSE(sweep.fit_axis.has_value());
}

TEST(SweepTest, SeedsFollowTheSettingsAndNotTheDesign) {
  const Sweep small = ParseSweep(
      R"({"seed": 7, "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001, 0.01]}]})");
  const Sweep grown = ParseSweep(
      R"({"seed": 7, "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.004, 0.01, 0.001]}]})");
  std::map<std::string, std::int64_t> seeds;
  std::set<std::int64_t> distinct;
  for (const SweepCell& cell : grown.cells) {
    seeds[cell.name] = cell.scenario.seed;
    distinct.insert(cell.scenario.seed);
    EXPECT_GE(cell.scenario.seed, 0);
    EXPECT_LT(cell.scenario.seed, std::int64_t{1} << 53) << "exact in every JSON reader";
  }
  EXPECT_EQ(distinct.size(), 3u);
  for (const SweepCell& cell : small.cells) EXPECT_EQ(cell.scenario.seed, seeds[cell.name]);
  const Sweep other = ParseSweep(
      R"({"seed": 8, "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001, 0.01]}]})");
  EXPECT_NE(other.cells[0].scenario.seed, small.cells[0].scenario.seed);
}

TEST(SweepTest, CommonRandomNumbersGiveEveryCellTheSeedOfTheCampaign) {
  const Sweep sweep = ParseSweep(
      R"({"seed": 7, "common_random_numbers": true,
          "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001, 0.01]}]})");
  for (const SweepCell& cell : sweep.cells) EXPECT_EQ(cell.scenario.seed, 7);
}

void ExpectSaysItself(const Sweep& sweep) {
  const Sweep again = ParseSweep(sweep.document, {}, "/nowhere");
  ASSERT_EQ(again.cells.size(), sweep.cells.size());
  for (std::size_t i = 0; i < sweep.cells.size(); ++i) {
    EXPECT_EQ(again.cells[i].name, sweep.cells[i].name);
    EXPECT_EQ(ResolvedJson(again.cells[i].scenario), ResolvedJson(sweep.cells[i].scenario));
  }
}

TEST(SweepTest, TheDocumentSaysByItselfWhatIsRun) {
  const std::filesystem::path folder = ROCKYARD_SOURCE_DIR "/scenarios/pathfinder";
  const Sweep sweep = ParseSweep(
      R"({"axes": [{"scenarios": ["nominal.json", "obstacles_0.85.json"]},
                   {"path": "course.goal_x_m", "values": [5, 6]}]})",
      {.overrides = {"course.goal_radius_m=0.9"}, .trials = 4, .seed = 5}, folder);
  EXPECT_EQ(sweep.axes[0].name, "scenario");
  EXPECT_EQ(sweep.cells[3].name, "scenario=obstacles_0.85,goal_x_m=6");
  ExpectSaysItself(sweep);
}

// Each point of a design that fills space is a cell.
TEST(SweepTest, PointsCoverTheStudyRangesOfParameters) {
  for (const char* kind : {"latin_hypercube", "sobol"}) {
    SCOPED_TRACE(kind);
    const Sweep sweep = ParseSweep(std::string(R"({"design": {"points": 16, "kind": ")") + kind +
                                   R"("}, "axes": [{"path": "course.goal_radius_m"},
          {"path": "terrain.rocks.count", "from": 1, "to": 16},
          {"path": "terrain.rocks.k_per_m2", "from": 0.001, "to": 0.01, "scale": "log"},
          {"path": "localization.estimator", "values": ["dead_reckoning", "oracle"]}]})");
    ASSERT_EQ(sweep.cells.size(), 16u);
    std::vector<double> logs;
    int oracles = 0;
    for (const SweepCell& cell : sweep.cells) {
      EXPECT_GE(cell.scenario.drive.course.goal_radius_m, 0.3);
      EXPECT_LE(cell.scenario.drive.course.goal_radius_m, 1.5);
      EXPECT_EQ(cell.levels[1].number,
                static_cast<double>(cell.scenario.drive.terrain.rocks.count));
      logs.push_back(std::log(cell.scenario.drive.terrain.rocks.k_per_m2 / 0.001) / std::log(10.0));
      oracles += cell.levels[3].text == "oracle" ? 1 : 0;
    }
    EXPECT_EQ(oracles, 8);
    std::sort(logs.begin(), logs.end());
    for (std::size_t i = 0; i < logs.size(); ++i) {
      EXPECT_NEAR(logs[i], (static_cast<double>(i) + 0.5) / 16.0, 0.5 / 16.0 + 1e-5);
    }
  }
}

TEST(SweepTest, MoreSobolPointsGoOnWithTheSameCells) {
  const auto sweep = [](int points) {
    return ParseSweep(R"({"design": {"kind": "sobol", "points": )" + std::to_string(points) +
                      R"(}, "axes": [{"path": "course.goal_radius_m"},
                                     {"path": "course.goal_x_m", "from": 5, "to": 7}]})");
  };
  const Sweep small = sweep(8);
  const Sweep large = sweep(16);
  for (std::size_t i = 0; i < small.cells.size(); ++i) {
    EXPECT_EQ(small.cells[i].name, large.cells[i].name);
    EXPECT_EQ(small.cells[i].scenario.seed, large.cells[i].scenario.seed);
  }
}

TEST(SweepTest, FileNamesAreSafeAndDistinct) {
  EXPECT_EQ(CellFileName(0, "k_per_m2=0.01,navigator=a"), "0001-k_per_m2_0.01_navigator_a");
  EXPECT_EQ(CellFileName(1, "../../etc/passwd"), "0002-.._.._etc_passwd");
  EXPECT_EQ(CellFileName(2, "<script>\"&'\n\xc3\xa4"), "0003-_script_______");
  EXPECT_NE(CellFileName(3, "a/b"), CellFileName(4, "a_b"));
  EXPECT_LE(CellFileName(5, std::string(5000, 'x')).size(), 110u);
}

TEST(SweepTest, SweepsAreToldFromScenarios) {
  EXPECT_TRUE(IsSweep(core::ParseJson(kGrid, "sweep")));
  EXPECT_TRUE(IsSweep(core::ParseJson(R"({"cells": []})", "sweep")));
  EXPECT_FALSE(IsSweep(core::ParseJson(DefaultsJson(), "scenario")));
  EXPECT_FALSE(IsSweep(core::ParseJson("[1]", "list")));
}

constexpr std::string_view kFactorial = R"({
  "name": "factorial", "seed": 3, "common_random_numbers": true,
  "set": {"course.designation.enabled": true},
  "axes": [{"name": "goal", "ablation": "perfect_designation"},
           {"ablation": "perfect_localization"}]
})";

std::string ProblemsOf(const std::string& axes, const std::string& more = "") {
  return core::RefusalOf([&] { ParseSweep("{" + more + R"("axes": [)" + axes + "]}"); });
}

TEST(SweepAblationTest, AnAxisIsOffAndOn) {
  const Sweep sweep = ParseSweep(kFactorial);
  ASSERT_EQ(sweep.cells.size(), 4u);
  EXPECT_EQ(sweep.axes[0].name, "goal");
  EXPECT_EQ(sweep.axes[0].ablation, "perfect_designation");
  EXPECT_EQ(sweep.axes[1].name, "perfect_localization") << "by default that of the ablation";
  EXPECT_FALSE(sweep.axes[1].numeric);
  EXPECT_EQ(sweep.cells[1].name, "goal=off,perfect_localization=on");
  EXPECT_THAT(AblationsInForce(sweep.cells[0].scenario), IsEmpty());
  EXPECT_THAT(AblationsInForce(sweep.cells[1].scenario), ElementsAre("perfect_localization"));
  EXPECT_THAT(AblationsInForce(sweep.cells[2].scenario), ElementsAre("perfect_designation"));
  EXPECT_THAT(AblationsInForce(sweep.cells[3].scenario),
              ElementsAre("perfect_designation", "perfect_localization"));
}

TEST(SweepAblationTest, CellsAreTheScenariosOfTheOption) {
  const Sweep sweep = ParseSweep(kFactorial);
  const std::vector<std::string> both{"perfect_localization", "perfect_designation"};
  EXPECT_EQ(Fingerprint(sweep.cells[3].scenario),
            Fingerprint(WithAblations(sweep.cells[0].scenario, both).scenario));
  for (const SweepCell& cell : sweep.cells) EXPECT_EQ(cell.scenario.seed, 3);
}

// Settings come first, whichever axis is named first.
TEST(SweepAblationTest, AblationsLieOverSettings) {
  const std::string ablation = R"({"name": "known", "ablation": "perfect_localization"})";
  const std::string levels = R"({"name": "by", "levels": [
      {"name": "wheels", "set": {"localization.estimator": "dead_reckoning"}},
      {"name": "far", "set": {"course.goal_x_m": 6}}]})";
  for (const std::string& axes :
       {fmt::format("{}, {}", ablation, levels), fmt::format("{}, {}", levels, ablation)}) {
    const Sweep sweep = ParseSweep(fmt::format(R"({{"axes": [{}]}})", axes));
    ASSERT_EQ(sweep.cells.size(), 4u);
    const bool ablation_first = sweep.axes[0].name == "known";
    const Scenario& off = sweep.cells[0].scenario;  // by wheels
    const Scenario& on = sweep.cells[ablation_first ? 2 : 1].scenario;
    EXPECT_EQ(off.drive.localization.estimators.chosen().name(), "dead_reckoning");
    EXPECT_EQ(on.drive.localization.estimators.chosen().name(), "oracle");
    EXPECT_EQ(sweep.cells[3].scenario.drive.localization.estimators.chosen().name(), "oracle");
    EXPECT_EQ(sweep.cells[3].scenario.drive.course.goal_x_m, 6.0);
  }
}

TEST(SweepAblationTest, TheDocumentSaysByItselfWhatIsRun) {
  ExpectSaysItself(ParseSweep(kFactorial));
}

TEST(SweepAblationTest, NamesWhatIsWrong) {
  EXPECT_THAT(ProblemsOf(R"({"ablation": "perfect_localisation"})"),
              HasSubstr("did you mean \"perfect_localization\"?"));
  EXPECT_THAT(ProblemsOf(R"({"ablation": 3})"), HasSubstr("axes[0].ablation"));
  EXPECT_THAT(ProblemsOf(R"({"ablation": "no_slip"}, {"name": "b", "ablation": "no_slip"})"),
              HasSubstr("twice"));
  EXPECT_THAT(ProblemsOf(R"({"ablation": "no_slip", "values": [1]})"),
              HasSubstr("several of values, levels, scenarios and ablation"));
  // In the cell that has both.
  EXPECT_THAT(ProblemsOf(R"({"ablation": "no_avoidance"}, {"ablation": "perfect_path_selection"})"),
              HasSubstr("undone by another one"));
  // Without designated goals there are no errors to take away: both cells would be the same.
  EXPECT_THAT(ProblemsOf(R"({"ablation": "perfect_designation"})"),
              HasSubstr("perfect_designation"));
}

}  // namespace
}  // namespace rockyard::scenario
