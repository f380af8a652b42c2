// Scores, intervals and ranks of runs that were made up, by hand.
#include <cmath>
#include <map>

#include "batch/campaign_differences.h"
#include "bench_runs.h"
#include "campaign/bench/bench_standings.h"
#include "core/error.h"
#include "experiments/drive/drive_experiment.h"

namespace rockyard::campaign {
namespace {

using testing::HasSubstr;
using truth::TrialOutcome;

constexpr TrialOutcome kYes = TrialOutcome::kGoalReached;
constexpr TrialOutcome kFalse = TrialOutcome::kFalseGoal;
constexpr TrialOutcome kTip = TrialOutcome::kTipOver;
constexpr TrialOutcome kNo = TrialOutcome::kNoPath;

// Outcomes by layout, of each cell.
using Outcomes = std::map<std::string, std::vector<TrialOutcome>>;

class StandingsTest : public BenchRuns {
 protected:
  // Ways and times are 10 times `scale`; what is driven without progress grows with the layout.
  fs::path Made(const std::string& name, const Outcomes& outcomes, double scale = 1.0,
                std::int64_t seed = 4) const {
    const fs::path folder = Path(name);
    fs::create_directories(folder);
    batch::CampaignIdentity identity;
    identity.name = "made";
    identity.build = "b";
    identity.schema = experiments::DriveSchema({});
    for (const auto& [cell, ends] : outcomes) {
      identity.cells.push_back({cell, "", batch::ResolvedFingerprint(core::JsonValue::Object()),
                                "{}", static_cast<std::uint64_t>(seed)});
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
          if (column == "true_distance_m" || column == "active_time_s") values[c] = 10.0 * scale;
          if (column == "active_energy_wh") values[c] = 1.0;
          if (column == "no_progress_distance_m") values[c] = 4.0 * (1.0 + static_cast<double>(i));
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
  for (const std::size_t i : {1u, 2u}) {
    EXPECT_EQ(standings.entries[i].best_rank, 2);
    EXPECT_EQ(standings.entries[i].worst_rank, 3);
  }
}

TEST_F(StandingsTest, OnlyWhatMetTheSameLayoutsIsCompared) {
  const fs::path base = Made("base", {{"a/1", {kYes, kNo}}});
  EXPECT_THROW(MakeStandings({base, base}), core::UserError) << "one name twice";
  EXPECT_THROW(MakeStandings({base, Made("other", {{"a/1", {kYes, kNo}}}, 1.0, 5)}),
               core::UserError);
  EXPECT_THROW(MakeStandings({base, Made("fewer", {{"a/1", {kYes}}})}), core::UserError);
}

}  // namespace
}  // namespace rockyard::campaign
