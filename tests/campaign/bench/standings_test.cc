// Scores, intervals and ranks of runs that were made up, by hand.
#include <cmath>
#include <map>

#include "batch/campaign_differences.h"
#include "bench_runs.h"
#include "campaign/bench/bench_page.h"
#include "campaign/bench/bench_standings.h"
#include "core/error.h"
#include "experiments/drive/drive_experiment.h"

namespace rockyard::campaign {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using truth::TrialOutcome;

constexpr TrialOutcome kYes = TrialOutcome::kGoalReached;
constexpr TrialOutcome kFalse = TrialOutcome::kFalseGoal;
constexpr TrialOutcome kTip = TrialOutcome::kTipOver;
constexpr TrialOutcome kNo = TrialOutcome::kNoPath;

// What a cell is by the end of its name, with stereo cameras and so few rocks that there are none;
// the goal is 7.6 m away. Cells of other names have no stereo cameras.
const std::map<std::string, std::string> kCells{
    {"seen", R"("terrain": {"rocks": {"k_per_m2": 1e-9}})"},
    {"drawn", R"("terrain": {"rocks": {"kind": "none"}})"},
    {"pits", R"("terrain": {"ground": {"pits": {"x_m": [3], "y_m": [1], "diameter_m": [0.5],
                "depth_m": [0.1]}}, "rocks": {"k_per_m2": 1e-9}})"},
    {"waypoints", R"("course": {"waypoints": {"x_m": [3], "y_m": [0]}},
                     "terrain": {"rocks": {"k_per_m2": 1e-9}})"}};

std::string ScenarioOf(const std::string& cell) {
  const auto found = kCells.find(cell.substr(cell.find('/') + 1));
  if (found == kCells.end()) return "{}";
  return R"({"sensors": {"terrain_sensor": "stereo"}, "navigation": {"navigator": "gestalt"}, )" +
         found->second + "}";
}

// Outcomes by layout, of each cell.
using Outcomes = std::map<std::string, std::vector<TrialOutcome>>;

class StandingsTest : public BenchRuns {
 protected:
  // Ways and times are 10 m and 1 m more with each layout, times `scale`; so grows what is driven
  // without progress. Drives end 0.5 m from the goal.
  fs::path Made(const std::string& name, const Outcomes& outcomes, double scale = 1.0,
                std::int64_t seed = 4) const {
    const fs::path folder = Path(name);
    fs::create_directories(folder);
    batch::CampaignIdentity identity;
    identity.name = "made";
    identity.build = "b";
    identity.schema = experiments::DriveSchema({});
    for (const auto& [cell, ends] : outcomes) {
      const std::string resolved = core::DumpJson(core::ParseJson(ScenarioOf(cell), cell));
      identity.cells.push_back({cell, "",
                                batch::ResolvedFingerprint(core::ParseJson(resolved, cell)),
                                resolved, static_cast<std::uint64_t>(seed)});
    }
    const auto layouts = static_cast<std::int64_t>(outcomes.begin()->second.size());
    batch::ResultStore store = batch::ResultStore::Create(folder, identity, layouts);
    std::vector<batch::CellRecord> rows;
    int cell = 0;
    for (const auto& [of, ends] : outcomes) {
      for (std::size_t i = 0; i < ends.size(); ++i) {
        std::vector<double> values(identity.schema.size(), 0.0);
        for (std::size_t c = 0; c < values.size(); ++c) {
          const std::string& column = identity.schema[c].name;
          const double layout = static_cast<double>(i);
          if (column == "true_distance_m" || column == "active_time_s") {
            values[c] = (10.0 + layout) * scale;
          }
          if (column == "true_goal_distance_m") values[c] = 0.5;
          if (column == "rocks") values[c] = rocks_;
          if (column == "active_energy_wh") values[c] = 1.0;
          if (column == "no_progress_distance_m") values[c] = 4.0 * (1.0 + layout);
          if (column == "scrapes" && i == 0) values[c] = 2.0;
        }
        rows.push_back({cell, {i, ends[i], "", values}});
      }
      ++cell;
    }
    store.Append(rows);
    core::JsonValue document = core::JsonValue::Object();
    document.Set("bench_version", core::JsonValue(kBenchVersion));
    document.Set("entry", core::ParseJson(
                              R"({"name": ")" + name + R"(", "navigator": "pathfinder"})", name));
    for (const char* key : {"entry_digest", "suite", "suite_digest", "beacon", "start", "head"}) {
      document.Set(key, core::JsonValue("same"));
    }
    document.Set("seed", core::JsonValue(seed));
    document.Set("layouts", core::JsonValue(layouts));
    Write(folder / kBenchFile, core::DumpJson(document));
    return folder;
  }

  double rocks_ = 0.0;  // as records have them
};

TEST_F(StandingsTest, LayoutsAreTheUnitsAndGroupsWeighAlike) {
  // Group a: two cells of weight 1/4; b: one of 1/2. Scores of layouts: 1, 3/4, 0.
  const fs::path run =
      Made("base",
           {{"a/1", {kYes, kYes, kFalse}}, {"a/2", {kYes, kNo, kTip}}, {"b/1", {kYes, kYes, kNo}}});
  const Standings standings = MakeStandings({run});
  const Standing& base = standings.entries.at(0);
  const double mean = 1.75 / 3.0;
  EXPECT_NEAR(base.score.value, mean, 1e-12);
  EXPECT_EQ(base.score.interval.high, 1.0) << "three layouts say nothing; no share is larger";
  EXPECT_NEAR(base.declared, (3.0 / 3) / 4 + (1.0 / 3) / 4 + (2.0 / 3) / 2, 1e-12);
  EXPECT_NEAR(base.unsafe, (1.0 / 3) / 4, 1e-12);
  EXPECT_NEAR(base.scraped, 1.0 / 3, 1e-12);
  EXPECT_NEAR(base.ends.at(static_cast<std::size_t>(kNo)), (1.0 / 3) / 4 + (1.0 / 3) / 2, 1e-12);
  EXPECT_NEAR(base.arrived_within[0], 1.0 / 3, 1e-12) << "4 m without progress";
  EXPECT_NEAR(base.arrived_within[1], mean, 1e-12) << "8 m";
  ASSERT_EQ(base.groups.size(), 2u);
  EXPECT_NEAR(base.groups[0].arrived, 0.5, 1e-12);
  EXPECT_NEAR(base.groups[1].arrived, 2.0 / 3, 1e-12);
  EXPECT_EQ(base.cells.size(), 3u);
}

TEST_F(StandingsTest, PairsOfLayoutsDecide) {
  const std::vector<TrialOutcome> half{kYes, kNo, kYes, kNo, kYes, kNo, kYes, kNo, kYes, kNo};
  std::vector<TrialOutcome> most = half;
  for (const std::size_t i : {1u, 3u, 5u, 7u}) most[i] = kYes;
  std::vector<TrialOutcome> tips = half;
  for (const std::size_t i : {1u, 3u, 5u, 7u, 9u}) tips[i] = kTip;
  const fs::path base = Made("base", {{"a/1", half}});
  const Standings standings =
      MakeStandings({base, Made("same", {{"a/1", half}}), Made("better", {{"a/1", most}}, 2.0),
                     Made("tips", {{"a/1", tips}})});
  std::map<std::string, const Standing*> of;
  for (const Standing& entry : standings.entries) of[entry.run.name()] = &entry;
  EXPECT_EQ(standings.entries.front().run.name(), "better");
  // Student's 97.5 % of 9 degrees times sqrt(1/4 / 9).
  EXPECT_NEAR(of["base"]->score.interval.high, 0.5 + 2.262157 / 6.0, 1e-5);
  EXPECT_NEAR(of["better"]->difference.value, 0.4, 1e-12);
  EXPECT_EQ(of["better"]->verdict, Verdict::kBetter);
  EXPECT_TRUE(of["better"]->not_told_from.contains("base")) << "of six pairs it is one";
  EXPECT_NEAR(of["better"]->way_ratio, 2.0, 1e-12) << "of drives in which both arrive";
  EXPECT_NEAR(of["better"]->time_ratio, 2.0, 1e-12);
  EXPECT_NEAR(of["better"]->energy_ratio, 1.0, 1e-12);
  // 4 of 10 pairs differ: sd sqrt(0.4 0.6 10 / 9), told with 2.8016 standard errors.
  EXPECT_NEAR(of["better"]->told, 2.8016 * std::sqrt(0.24 / 9), 1e-3);
  EXPECT_EQ(of["tips"]->verdict, of["same"]->verdict) << "arrivals alone are scored";
  EXPECT_FALSE(of["tips"]->passes_gate);
  EXPECT_TRUE(of["same"]->passes_gate);
  EXPECT_THAT(standings.Markdown(), HasSubstr("| tips (not safe enough) |"));
}

TEST_F(StandingsTest, RanksAreThoseThatAllPairsAtOnceAllow) {
  std::vector<TrialOutcome> none(40, kNo);
  std::vector<TrialOutcome> few = none;
  few[0] = kYes;
  std::vector<TrialOutcome> most(40, kYes);
  most[0] = kNo;
  const Standings standings = MakeStandings(
      {Made("few", {{"a/1", few}}), Made("most", {{"a/1", most}}), Made("none", {{"a/1", none}})});
  ASSERT_EQ(standings.entries.size(), 3u);
  EXPECT_EQ(standings.entries[0].best_rank, 1);
  EXPECT_EQ(standings.entries[0].worst_rank, 1);
  EXPECT_TRUE(standings.entries[0].not_told_from.empty());
  for (const std::size_t i : {1u, 2u}) {
    EXPECT_EQ(standings.entries[i].best_rank, 2);
    EXPECT_EQ(standings.entries[i].worst_rank, 3);
  }
  // `few` and `most` arrive together in no layout.
  EXPECT_THAT(standings.Markdown(), Not(HasSubstr("nan")));
}

// By hand: ways of 10.5, 11.5 and 13.5 m to a goal at 7.6 m, in layouts with two, one and two of
// the drives; layout 2 has none.
TEST_F(StandingsTest, RegretIsThatOfDrivesThatArriveByLayouts) {
  const Outcomes outcomes{
      {"a/seen", {kYes, kYes, kNo, kYes}},   {"b/seen", {kYes, kFalse, kTip, kYes}},
      {"c/blind", {kYes, kYes, kYes, kYes}}, {"c/drawn", {kYes, kYes, kYes, kYes}},
      {"c/pits", {kYes, kYes, kYes, kYes}},  {"c/waypoints", {kYes, kYes, kYes, kYes}}};
  const Standings standings = MakeStandings({Made("base", outcomes)});
  EXPECT_EQ(standings.why_no_regret, "");
  const Standing& base = standings.entries.at(0);
  EXPECT_EQ(base.regret.drives, 5);
  EXPECT_NEAR(base.regret.mean.value, (2 * 10.5 + 11.5 + 2 * 13.5) / 5.0 / 7.6 - 1.0, 1e-9);
  EXPECT_NEAR(base.regret.mean.interval.low, -0.026464, 1e-5);
  EXPECT_NEAR(base.regret.mean.interval.high, 1.158042, 1e-5);
  EXPECT_NEAR(base.groups.at(0).regret.mean.value, (10.5 + 11.5 + 13.5) / 3.0 / 7.6 - 1.0, 1e-9);
  EXPECT_EQ(base.cells.at(1).regret.drives, 2);
  for (std::size_t c = 2; c < base.cells.size(); ++c) {
    EXPECT_TRUE(std::isnan(base.cells[c].regret.mean.value)) << base.cells[c].name;
  }
  EXPECT_THAT(standings.Cells().Csv(), HasSubstr("base,c/drawn,1,1,0,0,0,,,,0\n"));
  EXPECT_THAT(standings.Table().Csv(), HasSubstr(",5,same,same\n"));
}

TEST_F(StandingsTest, NoRegretAmongOtherRocksThanThoseOfTheRecords) {
  rocks_ = 1.0;
  const Standings standings = MakeStandings({Made("base", {{"a/seen", {kYes, kYes}}})});
  EXPECT_THAT(standings.why_no_regret, HasSubstr("no regret is told: "));
  EXPECT_EQ(standings.entries.at(0).regret.drives, 0);
}

TEST_F(StandingsTest, ThePageHasWhatPartsTwoEntries) {
  const Standings standings =
      MakeStandings({Made("base", {{"a/1 x", {kYes, kNo, kYes}}, {"b/1", {kNo, kNo, kYes}}}),
                     Made("new", {{"a/1 x", {kNo, kYes, kYes}}, {"b/1", {kNo, kNo, kYes}}})});
  const core::JsonValue page = core::ParseJson(BenchPageJson(standings, "made"), "page");
  for (const core::JsonValue& entry : page.Find("entries")->list()) {
    EXPECT_EQ(entry.Find("not_told_from")->list().size(), 1u);
    const auto& splits = entry.Find("splits")->list();
    ASSERT_EQ(splits.size(), entry.Find("name")->text() == "new" ? 1u : 0u);
    if (splits.empty()) continue;
    EXPECT_EQ(core::CompactJson(*splits[0].Find("entry")), "[1]");
    EXPECT_EQ(core::CompactJson(*splits[0].Find("baseline")), "[0]");
    EXPECT_THAT(splits[0].Find("command")->text(),
                AllOf(HasSubstr("/new --cell 'a/1 x' --trial {trial} --with "), EndsWith("/base")));
  }
}

TEST_F(StandingsTest, OnlyWhatMetTheSameLayoutsIsCompared) {
  const fs::path base = Made("base", {{"a/1", {kYes, kNo}}});
  EXPECT_THROW(MakeStandings({base, base}), core::UserError) << "one name twice";
  EXPECT_THROW(MakeStandings({base, Made("other", {{"a/1", {kYes, kNo}}}, 1.0, 5)}),
               core::UserError);
  try {
    MakeStandings({base, Made("fewer", {{"a/1", {kYes}}})});
    ADD_FAILURE() << "not refused";
  } catch (const core::UserError& error) {
    EXPECT_THAT(error.problems().front().reason,
                AllOf(HasSubstr("number of layouts"), EndsWith(": 1, and there 2")));
  }
}

}  // namespace
}  // namespace rockyard::campaign
