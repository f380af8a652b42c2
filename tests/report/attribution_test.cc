// Attributions of made-up sweeps: which trials count, and what text, CSV and JSON say.
#include "report/attribution.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/json_text.h"
#include "core/says.h"
#include "report/sample_sweep.h"
#include "report/sweep_files.h"
#include "report/sweep_summary.h"

namespace rockyard::report {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;
using truth::TrialOutcome;

constexpr std::size_t kTrialsEach = 100;
constexpr std::size_t kTrue = static_cast<std::size_t>(SuccessKind::kTrue);
constexpr std::size_t kDeclared = static_cast<std::size_t>(SuccessKind::kDeclared);

// Two ablations, whose cells are "off,off", "off,on", "on,off", "on,on" in this order.
std::string TwoAblations(const std::string& first = "sight", const std::string& more = "") {
  return R"({"name": "test", "common_random_numbers": true, "axes": [)" + more + R"({"name": )" +
         json(first).dump() + R"(, "ablation": "perfect_sensing"},
            {"name": "slip", "ablation": "no_slip"}]})";
}

std::vector<truth::Record> TrialsThat(const std::function<TrialOutcome(std::size_t)>& outcome) {
  std::vector<truth::Record> trials;
  for (std::size_t t = 0; t < kTrialsEach; ++t) {
    trials.push_back({.trial = t, .outcome = outcome(t), .detail = "", .values = {}});
  }
  return trials;
}

// Trials 0..19 fail for want of sight, 20..29 for slip, 30..34 for either alone. Trials 90..99
// always end at a wrong place, which the rover takes for the goal.
std::vector<truth::Record> Cell(bool sight, bool slip) {
  return TrialsThat([=](std::size_t t) {
    if (t >= 90) return TrialOutcome::kFalseGoal;
    const bool fails = (t < 20 && !sight) || (t >= 20 && t < 30 && !slip) ||
                       (t >= 30 && t < 35 && !(sight && slip));
    return fails ? TrialOutcome::kJammed : TrialOutcome::kGoalReached;
  });
}

std::vector<std::vector<truth::Record>> FourCells() {
  return {Cell(false, false), Cell(false, true), Cell(true, false), Cell(true, true)};
}

std::vector<SweepAttribution> Attributed(const scenario::Sweep& sweep,
                                         const std::vector<std::vector<truth::Record>>& cells) {
  std::vector<CellOutcomes> outcomes;
  outcomes.reserve(cells.size());
  for (const auto& cell : cells) outcomes.emplace_back(cell);
  return AttributeSweep(sweep, outcomes);
}

TEST(AttributionReportTest, FailuresAreThoseOfEachKindOfSuccess) {
  const auto attributions = Attributed(scenario::ParseSweep(TwoAblations()), FourCells());
  ASSERT_THAT(attributions, SizeIs(1));
  EXPECT_EQ(attributions[0].at, "");
  EXPECT_EQ(attributions[0].left_out, 0);
  const statistics::Attribution& declared = attributions[0].by_success[kDeclared];
  EXPECT_THAT(declared.functions, ElementsAre("sight", "slip"));
  EXPECT_EQ(declared.failures[0].count, 35);
  EXPECT_EQ(declared.failures[1].count, 15) << "bit 0 is the first axis, not the fastest";
  EXPECT_EQ(declared.failures[2].count, 25);
  EXPECT_EQ(declared.failures[3].count, 0);
  // What either alone would not remove is shared evenly.
  EXPECT_NEAR(declared.shares[0].share.value, 0.225, 1e-12);
  EXPECT_NEAR(declared.shares[1].share.value, 0.125, 1e-12);
  EXPECT_NEAR(declared.shares[0].first.value, 0.20, 1e-12);
  EXPECT_NEAR(declared.shares[0].last.value, 0.25, 1e-12);
  EXPECT_NEAR(declared.sum_of_firsts, 0.30, 1e-12);
  EXPECT_NEAR(declared.removed.value, 0.35, 1e-12);
  const statistics::Attribution& truly = attributions[0].by_success[kTrue];
  EXPECT_EQ(truly.failures[0].count, 45);
  EXPECT_EQ(truly.remainder.count, 10);
}

// A fault in one cell takes the trial out of all, and cells are looked at as far as all have got.
TEST(AttributionReportTest, TrialsStayPairs) {
  std::vector<std::vector<truth::Record>> cells = FourCells();
  cells[2][5] = truth::MakeFault(1, 5, "made up");
  cells[3][5] = truth::MakeFault(1, 5, "made up");
  cells[0][25] = truth::MakeFault(1, 25, "made up");
  cells[1].resize(90);
  const auto attributions = Attributed(scenario::ParseSweep(TwoAblations()), cells);
  EXPECT_EQ(attributions[0].left_out, 2);
  const statistics::Attribution& truly = attributions[0].by_success[kTrue];
  EXPECT_EQ(truly.trials, 88u);
  EXPECT_EQ(truly.failures[0].count, 33);
  EXPECT_EQ(truly.remainder.count, 0);
  EXPECT_THAT(AttributionText(attributions),
              HasSubstr("88 paired trials\n  2 with a fault in some cell left out\n"));
}

TEST(AttributionReportTest, EachSettingOfOtherAxesHasItsOwn) {
  const auto sweep = scenario::ParseSweep(
      TwoAblations("sight", R"({"path": "course.goal_x_m", "values": [5, 6]},)"));
  std::vector<std::vector<truth::Record>> cells = FourCells();
  const auto perfect = [] {
    return TrialsThat([](std::size_t) { return TrialOutcome::kGoalReached; });
  };
  for (int i = 0; i < 4; ++i) cells.push_back(perfect());
  const auto attributions = Attributed(sweep, cells);
  ASSERT_THAT(attributions, SizeIs(2));
  EXPECT_EQ(attributions[0].at, "goal_x_m=5");
  EXPECT_EQ(attributions[0].by_success[kTrue].failures[0].count, 45);
  EXPECT_EQ(attributions[1].at, "goal_x_m=6");
  EXPECT_EQ(attributions[1].by_success[kTrue].failures[0].count, 0);
}

// Nothing is better than shares of trials that are no pairs, or of a factorial with holes.
TEST(AttributionReportTest, OtherSweepsHaveNone) {
  const auto none = [](const std::string& document) {
    const scenario::Sweep sweep = scenario::ParseSweep(document);
    const std::vector<std::vector<truth::Record>> cells(sweep.cells.size(), Cell(false, false));
    return Attributed(sweep, cells);
  };
  EXPECT_THAT(none(TwoAblations()), Not(IsEmpty()));
  std::string independent = TwoAblations();
  independent.replace(independent.find("true"), 4, "false");
  EXPECT_THAT(none(independent), IsEmpty());
  EXPECT_THAT(none(R"({"common_random_numbers": true,
                       "axes": [{"path": "course.goal_x_m", "values": [5, 6]}]})"),
              IsEmpty());
  EXPECT_THAT(none(R"({"common_random_numbers": true, "design": {"kind": "sobol", "points": 4},
                       "axes": [{"ablation": "no_slip"},
                                {"path": "course.goal_x_m", "from": 5, "to": 6}]})"),
              IsEmpty());
  EXPECT_EQ(AttributionText({}), "");
}

TEST(AttributionReportTest, TheTextHasSharesAndFitsTheTerminal) {
  const std::string long_name = R"(a very long name of "one" <function> that nobody cuts)";
  const auto sweep = scenario::ParseSweep(TwoAblations(
      long_name, R"({"name": "place", "levels": [{"name": "the far side of the garden, at night"},
        {"name": "near", "set": {"course.goal_x_m": 5}}]},)"));
  std::vector<std::vector<truth::Record>> cells = FourCells();
  for (const auto& cell : FourCells()) cells.push_back(cell);
  cells[0][0] = truth::MakeFault(1, 0, "made up");
  const std::string text = AttributionText(Attributed(sweep, cells));
  for (const std::string& line : Lines(text)) EXPECT_LE(line.size(), 100u) << line;
  EXPECT_THAT(text, core::Says("true success", "declared success", "place=near"));
  // Shares of declared success at "near", and what they sum to.
  EXPECT_THAT(text, core::Says("  22.5 (", "  12.5 (", "30.0: these need not sum"));
  EXPECT_THAT(text, Not(HasSubstr("nan")));
}

TEST(AttributionReportTest, WithoutTrialsThereIsNoTable) {
  const auto sweep = scenario::ParseSweep(TwoAblations());
  const auto attributions = Attributed(sweep, std::vector<std::vector<truth::Record>>(4));
  EXPECT_THAT(AttributionText(attributions), HasSubstr("0 paired trials"));
  EXPECT_THAT(AttributionText(attributions), Not(HasSubstr("nan")));
  EXPECT_THAT(AttributionCsv(attributions), Not(HasSubstr("nan")));
  EXPECT_FALSE(json::parse(core::SpreadJson(AttributionJson(attributions))).empty());
}

TEST(AttributionReportTest, TheCsvHasARowForEverything) {
  const std::string csv =
      AttributionCsv(Attributed(scenario::ParseSweep(TwoAblations()), FourCells()));
  const std::vector<std::string> lines = Lines(csv);
  // Two kinds of success with four combinations, three numbers for each function, removed,
  // remainder and three effects.
  ASSERT_THAT(lines, SizeIs(1 + 2 * (4 + 3 * 2 + 2 + 3)));
  EXPECT_EQ(lines[0], "at,success,kind,functions,value,low,high");
  for (const std::string& line : lines) {
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), 6) << line;
  }
  EXPECT_THAT(csv,
              core::Says(",declared success,failure_rate,as flown,0.35,",
                         ",declared success,failure_rate,sight + slip,0,0,",
                         ",declared success,last,sight,0.25,", ",true success,remainder,all,0.1,",
                         ",true success,effect,sight x slip,"));
}

// Whatever functions are called, files stay what they are.
TEST(AttributionReportTest, NamesAreTextInEveryFile) {
  const std::string odd = "\"quoted\", <b>&amp; \xc3\xa4=1";
  const auto sweep = scenario::ParseSweep(TwoAblations(odd));
  const auto attributions = Attributed(sweep, FourCells());
  EXPECT_THAT(AttributionCsv(attributions),
              HasSubstr(",share,\"\"\"quoted\"\", <b>&amp; \xc3\xa4=1\",0.2"));
  const json list = json::parse(core::SpreadJson(AttributionJson(attributions)));
  ASSERT_THAT(list, SizeIs(2));
  EXPECT_EQ(list[0]["success"], "declared success");
  EXPECT_EQ(list[0]["trials"], kTrialsEach);
  EXPECT_EQ(list[0]["left_out"], 0);
  EXPECT_NEAR(double(list[0]["sum_of_alone"]), 0.3, 1e-12);
  const auto share = std::find_if(list[0]["rows"].begin(), list[0]["rows"].end(),
                                  [](const json& row) { return row["kind"] == "share"; });
  ASSERT_NE(share, list[0]["rows"].end());
  EXPECT_EQ((*share)["functions"], odd);
  EXPECT_NEAR(double((*share)["value"]), 0.225, 1e-12);
  EXPECT_LT(double((*share)["interval"][0]), 0.225);
  EXPECT_GT(double((*share)["interval"][1]), 0.225);
}

TEST(AttributionReportTest, TheSummaryOfASweepHoldsIt) {
  const scenario::Sweep sweep = scenario::ParseSweep(TwoAblations());
  const std::vector<std::vector<truth::Record>> cells = FourCells();
  const SweepSummary summary = SummarizeSweep(
      sweep,
      [&](std::size_t cell) {
        return SweepCellTrials{.schema = {},
                               .prefix = cells[cell],
                               .planned = kTrialsEach,
                               .stored = kTrialsEach,
                               .trial_hash = std::to_string(cell)};
      },
      statistics::IntervalMethod::kWilson);
  const json written = json::parse(SweepJson(sweep, summary, {.trial_hash = "feed"}));
  EXPECT_EQ(written["attribution"],
            json::parse(core::SpreadJson(AttributionJson(summary.attributions))));
  EXPECT_THAT(written["attribution"], SizeIs(2));
  EXPECT_THAT(SweepText(sweep, summary, {}, TextStyle::kPlain),
              HasSubstr(AttributionText(summary.attributions)));
}

}  // namespace
}  // namespace rockyard::report
