// What the report page is given of a run.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "report/page_data.h"
#include "report/run_files.h"
#include "report/summary_json.h"
#include "sample_run.h"
#include "statistics/drive_summary.h"
#include "truth/measured_schema.h"

namespace rockyard::report {
namespace {

using nlohmann::json;
using testing::ElementsAre;

constexpr auto kWilson = statistics::IntervalMethod::kWilson;

// Markup, quotes, a control character, and bytes that are no UTF-8.
const std::string kHostile = "</script><img src=x onerror=alert(1)>\"'\x01\xff\xc3(";

PageRun SamplePageRun(const std::vector<truth::Record>& records) {
  return {.label = "sample",
          .folder = "runs/sample",
          .cell = "",
          .sweep = {},
          .description = SampleDescription(),
          .schema = SampleSchema(),
          .records = records,
          .prefix = records,
          .parameters = {},
          .replay_command = "rockyard replay runs/sample --trial {trial}"};
}

json Parsed(const PageRun& run) { return json::parse(PageRunMembers(run, kWilson).Text()); }

TEST(PageRun, ItsSummaryIsSummaryJson) {
  const std::vector<truth::Record> records = SampleRecords();
  const json run = Parsed(SamplePageRun(records));
  const std::string expected =
      SummaryJson(SampleDescription(), statistics::Summarize(SampleSchema(), records, 8, kWilson));
  EXPECT_EQ(run["summary"], json::parse(expected));
  EXPECT_EQ(run["kind"], "drive");
  EXPECT_TRUE(run["sweep"].is_null());
  EXPECT_TRUE(run["published"].is_null());
  EXPECT_EQ(run["replay_command"], "rockyard replay runs/sample --trial {trial}");
}

TEST(PageRun, TellsHowManyOfItsTrialsAreInTheRates) {
  std::vector<truth::Record> records = SampleRecords();
  EXPECT_EQ(Parsed(SamplePageRun(records))["prefix_trials"], 6);
  records.erase(records.begin() + 2);
  PageRun run = SamplePageRun(records);
  run.prefix = run.records.first(2);
  const json page = Parsed(run);
  EXPECT_EQ(page["prefix_trials"], 2);
  EXPECT_EQ(page["trials"]["trial"].size(), 5u);
  EXPECT_EQ(page["cdf_steps"], 2);
  EXPECT_EQ(page["summary"]["trials"]["completed"], 2);
}

TEST(PageRun, TellsOfSharedLayouts) {
  std::vector<truth::Record> records = SampleRecords();
  PageRun run = SamplePageRun(records);
  EXPECT_EQ(Parsed(run)["shared_layouts"], false);  // not told apart
  run.schema.back().name = "layout";
  const auto shared = [&](const std::vector<double>& layouts) {
    for (std::size_t i = 0; i < records.size(); ++i) {
      if (!records[i].values.empty()) records[i].values.back() = layouts[i];
    }
    return Parsed(run)["shared_layouts"];
  };
  EXPECT_EQ(shared({0, 1, 2, 3, 4, 5}), false);
  EXPECT_EQ(shared({0, 1, 2, 2, 3, 3}), true);
  EXPECT_EQ(shared({0, 1, 2, 2, 2, 5}), true);  // a fault lies between the two
}

TEST(PageRun, AMeasurementHasCellsAndNoDistances) {
  const std::vector<std::string_view> names{"height_m", "scenes", "detected_single"};
  const std::vector<truth::Record> records{
      {0, truth::TrialOutcome::kMeasured, "", {0.0, 0.1, 20.0, 15.0}},
      {1, truth::TrialOutcome::kMeasured, "", {1.0, 0.2, 20.0, 20.0}}};
  PageRun page = SamplePageRun(records);
  page.schema = truth::MeasuredSchema(names);
  const json run = Parsed(page);
  EXPECT_EQ(run["kind"], "measurement");
  EXPECT_TRUE(run["cdf"].is_null());
  EXPECT_EQ(run["summary"]["cells"].size(), 2u);
  EXPECT_FALSE(run["summary"].contains("declared_success"));
}

TEST(PageRun, WithoutTrialsRatesAreUnknown) {
  const std::vector<truth::Record> none;
  const json run = Parsed(SamplePageRun(none));
  EXPECT_TRUE(run["summary"]["true_success"]["rate"].is_null());
  EXPECT_TRUE(run["cdf"].is_null());
  EXPECT_TRUE(run["trials"]["trial"].empty());
  EXPECT_EQ(run["trials"]["columns"].size(), SampleSchema().size());
}

TEST(PageRun, TextsAreTextsWhateverTheyHold) {
  std::vector<truth::Record> records = SampleRecords();
  records[0].detail = kHostile;
  PageRun page = SamplePageRun(records);
  page.label = page.folder = page.cell = page.replay_command = kHostile;
  page.description.scenario = kHostile;
  page.schema[0].name = kHostile;
  const json run = Parsed(page);
  const std::string replaced =
      "</script><img src=x onerror=alert(1)>\"'\x01\xef\xbf\xbd\xef\xbf\xbd(";
  EXPECT_EQ(run["label"], replaced);
  EXPECT_EQ(run["summary"]["scenario"], replaced);
  EXPECT_EQ(run["trials"]["detail_texts"][0], replaced);
  EXPECT_EQ(run["trials"]["columns"][0]["name"], replaced);
}

std::vector<truth::Record> Plain(std::size_t trials) {
  std::vector<truth::Record> records(trials);
  for (std::size_t i = 0; i < trials; ++i) {
    records[i].trial = 3 * i;  // numbers are no places
    records[i].outcome = truth::TrialOutcome::kGoalReached;
    records[i].values = {static_cast<double>(i)};
  }
  return records;
}

// Every k-th for the least k that keeps to the limit, and those that have a name.
TEST(PageTrials, AreThinnedByPlaceAlone) {
  EXPECT_EQ(PageTrials(Plain(kMaxPageTrials), {}).size(), kMaxPageTrials);
  const std::vector<truth::Record> records = Plain(2 * kMaxPageTrials + 1);
  const std::vector<std::uint64_t> named{3, 9};
  const std::vector<std::size_t> places = PageTrials(records, named);
  EXPECT_EQ(places.size(), (2 * kMaxPageTrials + 1 + 2) / 3 + 1) << "place 3 is there already";
  EXPECT_THAT(std::vector<std::size_t>(places.begin(), places.begin() + 4),
              ElementsAre(0, 1, 3, 6));
  EXPECT_TRUE(PageTrials({}, named).empty());
}

TEST(PageTrials, TheRunTellsHowManyThereAre) {
  const std::vector<truth::Record> records = Plain(2 * kMaxPageTrials);
  PageRun run = SamplePageRun(records);
  run.schema = {{"x", "1", ""}};
  run.prefix = std::span(records).first(7);
  const json page = Parsed(run);
  EXPECT_EQ(page["stored_trials"], 2 * kMaxPageTrials);
  EXPECT_EQ(page["trials"]["trial"].size(), kMaxPageTrials);
  EXPECT_EQ(page["prefix_trials"], 7);
  EXPECT_EQ(page["trials"]["columns"][0]["values"][1], 2.0);
  EXPECT_EQ(page["summary"]["trials"]["completed"], 7) << "numbers are of all trials";
}

TEST(PageTrials, AreColumnsOfNumbersWithNullForWhatIsUndefined) {
  std::vector<truth::Record> records = SampleRecords();
  records[1].values[0] = std::numeric_limits<double>::infinity();
  const json trials = json::parse(PageTrialsJson(SampleSchema(), records, PageTrials(records, {})));
  EXPECT_THAT(trials["trial"], ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(trials["outcome_names"], ElementsAre("goal_reached", "false_goal", "no_path",
                                                   "simulator_fault", "time_limit"));
  EXPECT_THAT(trials["outcome"], ElementsAre(0, 1, 2, 3, 4, 0));
  EXPECT_THAT(trials["detail"], ElementsAre(0, 1, 2, 3, 4, 0));
  EXPECT_EQ(trials["detail_texts"][1], "believed, \"only\"");
  const json& distance = trials["columns"][0];
  EXPECT_EQ(distance["name"], "true_distance_m");
  EXPECT_EQ(distance["unit"], "m");
  EXPECT_THAT(distance["values"], ElementsAre(8.0, nullptr, 4.0, nullptr, 6.0, 8.0));
  EXPECT_TRUE(trials["columns"][3]["values"][2].is_null());  // NaN in the sample
}

TEST(PageTrials, NumbersHaveSixSignificantDigits) {
  const double tiny = std::numeric_limits<double>::denorm_min();
  const std::vector<double> values{123456.789, -1.0 / 3.0, 1e300, tiny, -0.0, 65536.0};
  std::vector<truth::Record> records;
  for (const double value : values) {
    records.push_back({records.size(), truth::TrialOutcome::kNoPath, "", {value}});
  }
  const json trials =
      json::parse(PageTrialsJson({{"x", "1", ""}}, records, PageTrials(records, {})));
  const json& read = trials["columns"][0]["values"];
  EXPECT_EQ(read[0], 123457);
  EXPECT_EQ(read[1], -0.333333);
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_NEAR(read[i].get<double>(), values[i], 5e-6 * std::abs(values[i])) << i;
  }
}

// distance_cdf.csv, by line.
std::vector<std::vector<double>> CsvRows(const std::string& csv) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    rows.emplace_back();
    for (std::string field; std::getline(fields, field, ',');) {
      rows.back().push_back(std::stod(field));
    }
  }
  return rows;
}

std::vector<truth::Record> Distances(int count) {
  std::vector<truth::Record> records;
  for (int i = 0; i < count; ++i) {
    const auto outcome =
        i % 3 == 0 ? truth::TrialOutcome::kTimeLimit : truth::TrialOutcome::kGoalReached;
    records.push_back({static_cast<std::uint64_t>(i), outcome, "", {5.0 + 0.001 * i}});
  }
  return records;
}

constexpr const char* kCdfColumns[] = {"distance_m", "ecdf",      "ecdf_low", "ecdf_high", "goal",
                                       "goal_low",   "goal_high", "failure",  "at_risk",   "limit"};

void ExpectRow(const json& cdf, std::size_t at, const std::vector<double>& row) {
  ASSERT_EQ(row.size(), std::size(kCdfColumns));
  for (std::size_t i = 0; i < row.size(); ++i) {
    EXPECT_NEAR(cdf[kCdfColumns[i]][at].get<double>(), row[i], 5e-6 * std::abs(row[i]))
        << kCdfColumns[i] << " at " << at;
  }
}

TEST(PageCdf, HoldsEveryStepOfAShortRun) {
  const std::vector<truth::Record> records = Distances(7);
  const truth::RecordSchema schema{{"true_distance_m", "m", ""}};
  const auto rows = CsvRows(WrittenBy(DistanceCdfCsv, schema, records));
  const json cdf = json::parse(PageCdfJson(DistanceSteps(schema, records)));
  ASSERT_EQ(rows.size(), 7u);
  ASSERT_EQ(cdf["ecdf"].size(), 7u);
  for (std::size_t i = 0; i < rows.size(); ++i) ExpectRow(cdf, i, rows[i]);
}

// How far the function of the kept steps lies below that of all rows, at worst.
double LargestGap(const json& cdf, const std::vector<std::vector<double>>& rows) {
  double gap = 0.0;
  std::size_t kept = 0;
  for (const std::vector<double>& row : rows) {
    while (kept + 1 < cdf["ecdf"].size() &&
           cdf["distance_m"][kept + 1].get<double>() <= row[0] + 1e-9) {
      ++kept;
    }
    gap = std::max(gap, row[1] - cdf["ecdf"][kept].get<double>());
  }
  return gap;
}

TEST(PageCdf, ThinningKeepsBothEndsAndStaysClose) {
  const truth::RecordSchema schema{{"true_distance_m", "m", ""}};
  // In the last one a third of the trials share one distance, beside many that do not.
  for (const auto& [count, ties] : {std::pair{1000, 0}, {1001, 0}, {4321, 0}, {2500, 1250}}) {
    std::vector<truth::Record> records = Distances(count);
    for (int i = 0; i < ties; ++i) {
      records.push_back(records[1]);
      records.back().trial = records.size() - 1;
    }
    const auto rows = CsvRows(WrittenBy(DistanceCdfCsv, schema, records));
    const json cdf = json::parse(PageCdfJson(DistanceSteps(schema, records)));
    const std::size_t kept = cdf["distance_m"].size();
    EXPECT_EQ(rows.size(), static_cast<std::size_t>(count));
    EXPECT_LE(kept, kMaxPageSteps);
    EXPECT_GE(kept, 500u);
    ExpectRow(cdf, 0, rows.front());
    ExpectRow(cdf, kept - 1, rows.back());
    EXPECT_LE(LargestGap(cdf, rows), 1.0 / 998.0 + 1e-5) << count;
  }
}

TEST(PageCdf, IsNullWithoutDistances) {
  EXPECT_EQ(PageCdfJson(DistanceSteps({{"rocks", "1", ""}}, SampleRecords())), "null");
}

TEST(PageReplays, AreLinksByTrial) {
  const std::vector<PageLink> links{{12, "a_replays/12.html"}, {7, kHostile}};
  const json replays = json::parse(PageReplaysJson(links));
  EXPECT_EQ(replays["12"], "a_replays/12.html");
  EXPECT_TRUE(replays["7"].is_string());
  EXPECT_EQ(PageReplaysJson({}), "{}");
}

core::ParameterInfo Parameter(const char* path, double value) {
  core::ParameterInfo parameter;
  parameter.path = path;
  parameter.value = core::JsonValue(value);
  return parameter;
}

TEST(PageParameters, OfALaterCellAreThoseThatDiffer) {
  const std::vector first{Parameter("a", 1.0), Parameter("b", 2.0)};
  const std::vector second{Parameter("a", 1.0), Parameter("b", 3.0)};
  const auto others = OtherParameters(second, first);
  ASSERT_EQ(others.size(), 1u);
  EXPECT_EQ(others[0].path, "b");
  EXPECT_TRUE(OtherParameters(first, first).empty());
  // Of another experiment: all of them.
  EXPECT_EQ(OtherParameters(second, std::vector{Parameter("a", 1.0)}).size(), 2u);
  EXPECT_EQ(OtherParameters(second, std::vector{Parameter("a", 1.0), Parameter("c", 3.0)}).size(),
            2u);
}

TEST(PageParameters, AreTextsWithTheirOrigin) {
  core::ParameterInfo parameter;
  parameter.path = "terrain.rocks.k_per_m2";
  parameter.kind = core::FieldKind::kReal;
  parameter.value = core::JsonValue(0.00415);
  parameter.unit = "1/m2";
  parameter.origin = core::Origin::kPublished;
  parameter.source = "Moore 1989";
  parameter.doc = kHostile;
  parameter.study_low = 0.002;
  parameter.study_high = 0.008;
  const json rows = json::parse(PageParametersJson(std::vector{parameter}));
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0]["path"], "terrain.rocks.k_per_m2");
  EXPECT_EQ(rows[0]["value"], "0.00415");
  EXPECT_EQ(rows[0]["origin"], "published");
  EXPECT_EQ(rows[0]["range"], "0.002 to 0.008");
}

// Paths on the report page: how they are simplified, and what the page is given.

PathPiece Wave() {
  PathPiece piece;
  for (int i = 0; i <= 1000; ++i) piece.push_back({0.01 * i, 0.2 * std::sin(0.01 * i), 0.0});
  return piece;
}

double Nearest_m(const math::Pose2& point, const PathPiece& line) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < line.size(); ++i) {
    constexpr int kSteps = 400;
    for (int k = 0; k <= kSteps; ++k) {
      const double share = static_cast<double>(k) / kSteps;
      const math::Pose2 on{line[i - 1].x_m + share * (line[i].x_m - line[i - 1].x_m),
                           line[i - 1].y_m + share * (line[i].y_m - line[i - 1].y_m), 0.0};
      nearest_m = std::min(nearest_m, Apart_m(point, on));
    }
  }
  return nearest_m;
}

TEST(Simplified, NoPointIsFurtherOffThanTheTolerance) {
  const PathPiece wave = Wave();
  const PathPiece kept = Simplified({wave}, 0.01).front();
  EXPECT_LT(kept.size(), 40u);
  EXPECT_EQ(kept.front().x_m, wave.front().x_m);
  EXPECT_EQ(kept.back().x_m, wave.back().x_m);
  double furthest_m = 0.0;
  for (const math::Pose2& point : wave) {
    furthest_m = std::max(furthest_m, Nearest_m(point, kept));
  }
  EXPECT_LE(furthest_m, 0.0105);
  EXPECT_GT(furthest_m, 0.004);  // no more points than are needed
}

TEST(Simplified, ALineKeepsItsEndsAndAWayThereAndBackItsTurn) {
  const TracePath line{{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {2.0, 0.0, 0.0}}};
  EXPECT_EQ(Simplified(line, 0.01).front().size(), 2u);
  const TracePath back{{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.5, 0.0, 0.0}}};
  EXPECT_EQ(Simplified(back, 0.01).front().size(), 3u);
  const TracePath closed{{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0}}};
  EXPECT_EQ(Simplified(closed, 0.01).front().size(), 3u);
  EXPECT_EQ(Simplified({{}, {{1.0, 2.0, 0.0}}}, 0.01).size(), 2u);
}

TEST(Thinned, AsManyPointsAsAllowedAreNotThinnedFurther) {
  const TracePath path{Wave()};
  const std::size_t finest = Thinned(path, 100000).front().size();
  EXPECT_EQ(Thinned(path, finest).front().size(), finest);
  EXPECT_LT(Thinned(path, finest - 1).front().size(), finest);
}

TEST(PageTracks, AreWholeCentimetresWithoutRepeats) {
  const PageTrack track{
      7,
      {{{0.0, 0.0, 0.0}, {0.001, 0.0, 0.0}, {1.234, -0.5, 0.0}}, {{2.0, 1.0, 0.0}}},
      {{1.0, 2.0, 0.125}}};
  EXPECT_EQ(json::parse(PageTracksJson(std::vector{track})), json::parse(R"([
    {"trial": 7, "pieces_cm": [[0, 0, 123, -50], [200, 100]], "rocks_cm": [100, 200, 13]}])"));
}

TEST(PageTracks, TheCourseIsWhereDrivesLead) {
  const PageCourse course{.rover = "R \"2\"",
                          .start = {0.5, 1.0, 2.0},
                          .goal = {7.6, -0.25},
                          .goal_radius_m = 0.65,
                          .waypoints = {{3.0, 4.0}},
                          .mirror_lines_m = {-1.1, 1.1},
                          .contours = {{-0.5, {{1.0, 2.0}, {1.254, -2.0}}}},
                          .contour_interval_m = 0.5};
  EXPECT_EQ(json::parse(PageCourseJson(course)), json::parse(R"({"rover": "R \"2\"",
    "start": [0.5, 1], "goal": [7.6, -0.25], "goal_radius_m": 0.65, "waypoints": [[3, 4]],
    "mirror_lines_m": [-1.1, 1.1], "contours": [{"height_m": -0.5, "line_cm": [100, 200, 125, -200]}],
    "contour_interval_m": 0.5})"));
}

TEST(PageEndings, CountOutcomesWithTheirDetailsMostFirst) {
  EXPECT_EQ(json::parse(PageEndingsJson(SampleRecords())), json::parse(R"([
    {"outcome": "goal_reached", "detail": "arrived", "count": 2, "limit": false},
    {"outcome": "false_goal", "detail": "believed, \"only\"", "count": 1, "limit": false},
    {"outcome": "no_path", "detail": "nowhere to go", "count": 1, "limit": false},
    {"outcome": "time_limit", "detail": "too long", "count": 1, "limit": true},
    {"outcome": "simulator_fault", "detail": "blew up", "count": 1, "limit": false}])"));
}

}  // namespace
}  // namespace rockyard::report
