// Numbers that rows compute with are those that the program has: a computed row repeats the
// arithmetic of a publication, and its inputs tie it to the scenarios.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "report/comparison_reference.h"
#include "report/parameter_table.h"
#include "scenario/load.h"
#include "terrain/rock_params.h"

namespace rockyard::scenario {
namespace {

double Parameter(const std::string& file, const std::string& path) {
  const Scenario scenario = LoadScenario(ROCKYARD_SOURCE_DIR "/scenarios/" + file + ".json");
  for (const core::ParameterInfo& parameter : ListParameters(scenario)) {
    if (parameter.path == path) return parameter.value.number();
  }
  ADD_FAILURE() << file << " has no parameter " << path;
  return std::nan("");
}

double Input(const std::string& id, std::size_t index) {
  static const statistics::PublishedReference reference =
      report::LoadReference(ROCKYARD_SOURCE_DIR "/results/reference/matthies1995_mission.json");
  const auto found = std::find_if(reference.values.begin(), reference.values.end(),
                                  [&](const auto& value) { return value.id == id; });
  if (found == reference.values.end()) {
    ADD_FAILURE() << "no row " << id;
    return std::nan("");
  }
  return found->inputs.at(index);
}

struct Tie {
  const char* row;
  std::size_t input;
  const char* scenario;
  const char* parameter;
  double factor = 1.0;  // of the parameter, to the input
};

constexpr Tie kTies[] = {
    {"moore.n_23", 0, "pathfinder/vl2", "terrain.rocks.k_per_m2"},
    {"moore.n_15", 0, "pathfinder/vl2", "terrain.rocks.k_per_m2"},
    {"moore.cover_vl2", 0, "pathfinder/vl2", "terrain.rocks.k_per_m2"},
    {"moore.cover_vl2", 1, "pathfinder/vl2", "terrain.rocks.min_diameter_m"},
    {"moore.cover_nominal", 0, "pathfinder/nominal", "terrain.rocks.k_per_m2"},
    {"moore.cover_nominal", 1, "pathfinder/nominal", "terrain.rocks.min_diameter_m"},
    {"obstacles.density_0.28", 0, "pathfinder/obstacles_0.28", "terrain.rocks.count"},
    {"obstacles.density_0.57", 0, "pathfinder/obstacles_0.57", "terrain.rocks.count"},
    {"obstacles.density_0.85", 0, "pathfinder/obstacles_0.85", "terrain.rocks.count"},
    {"obstacles.density_0.65", 0, "pathfinder/obstacles_0.65", "terrain.rocks.count"},
    {"obstacles.density_2.0", 0, "pathfinder/obstacles_2.0", "terrain.rocks.count"},
    {"obstacles.density_0.28", 1, "pathfinder/obstacles_0.28", "terrain.rocks.count_area_length_m",
     2.2},
    {"obstacles.density_0.57", 1, "pathfinder/obstacles_0.57", "terrain.rocks.count_area_length_m",
     2.2},
    {"obstacles.density_0.85", 1, "pathfinder/obstacles_0.85", "terrain.rocks.count_area_length_m",
     2.2},
    {"obstacles.density_0.65", 1, "pathfinder/obstacles_0.65", "terrain.rocks.count_area_length_m",
     2.2},
    {"obstacles.density_2.0", 1, "pathfinder/obstacles_2.0", "terrain.rocks.count_area_length_m",
     2.2},
    {"drift.mfex_heading", 0, "pathfinder/nominal", "sensors.gyro.heading_variance_deg2_per_m"},
    {"drift.mfex_heading", 1, "pathfinder/nominal", "rover.drive.speed_m_s", 100.0},
    {"drift.fig6a.along_10m", 2, "pathfinder/nominal",
     "sensors.encoders.distance_variance_m2_per_m"},
    {"drift.fig6a.across_10m", 3, "pathfinder/nominal", "sensors.gyro.heading_variance_deg2_per_m"},
    {"designation.downrange_20m", 2, "pathfinder/nominal", "course.designation.baseline_m"},
    {"ops.continuous", 0, "mars/mfex_nominal", "rover.drive.speed_m_s"},
    {"ops.continuous", 1, "mars/traverse_single_scan", "referee.time_limit_s"},
    {"ops.hour", 1, "mars/traverse_one_hour", "referee.time_limit_s"},
};

TEST(PublishedInputs, AreTheParametersOfTheProgram) {
  for (const Tie& tie : kTies) {
    const double parameter = tie.factor * Parameter(tie.scenario, tie.parameter);
    EXPECT_NEAR(Input(tie.row, tie.input), parameter, 1e-12 * parameter)
        << tie.row << ", input " << tie.input << ", " << tie.scenario << ": " << tie.parameter;
  }
}

TEST(PublishedInputs, OfTheSameKindAreTheSame) {
  for (const char* row : {"moore.n_23", "moore.n_15", "moore.cover_vl2", "moore.cover_nominal"}) {
    EXPECT_EQ(Input(row, 2), terrain::kMooreExponent) << row;
  }
  EXPECT_EQ(Parameter("pathfinder/nominal", "terrain.rocks.count_area_width_m"), 2.2);
  EXPECT_NEAR(1.0 / Input("drift.mfex_heading", 2),
              100.0 * Parameter("mars/mfex_nominal", "rover.drive.speed_m_s"), 1e-9);
  EXPECT_NEAR(Input("designation.downrange_20m", 0),
              Parameter("pathfinder/nominal", "course.designation.disparity_sd_px") *
                  Parameter("pathfinder/nominal", "course.designation.pixel_rad"),
              1e-12);
  for (const char* way : {"along", "across"}) {
    for (const char* end : {"6a.%s_10m", "6a.%s_20m", "6b.%s_5m", "6b.%s_10m"}) {
      std::string id = std::string("drift.fig") + end;
      id.replace(id.find("%s"), 2, way);
      EXPECT_EQ(Input(id, 0), 0.067) << id << ": the step that section 5 states";
      EXPECT_EQ(Input(id, 2), Input("drift.fig6a.along_10m", 2)) << id;
      EXPECT_EQ(Input(id, 3), id.find("6a") != std::string::npos ? 0.70 : 16.0) << id;
    }
  }
}

// ASSUMPTIONS.md of the Pathfinder scenarios lists every assumed parameter as the program knows it.

const std::string kFolder = std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/pathfinder/";
constexpr const char* kAdvice =
    "to renew the table, put the output of `rockyard parameters scenarios/pathfinder/nominal.json "
    "--origin assumed` between its markers, and add a line to the changes";

std::vector<std::string> Lines(std::istream& stream) {
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

// The lines between the markers; empty if there is not one pair of them.
std::vector<std::string> CommittedTable() {
  std::ifstream file(kFolder + "ASSUMPTIONS.md");
  std::vector<std::string> table;
  bool inside = false;
  int markers = 0;
  for (const std::string& line : Lines(file)) {
    const bool begin = line == "<!-- begin assumed parameters -->";
    const bool end = line == "<!-- end assumed parameters -->";
    markers += begin || end ? 1 : 0;
    if (inside && !end) table.push_back(line);
    inside = begin || (inside && !end);
  }
  return markers == 2 && !inside ? table : std::vector<std::string>{};
}

std::vector<std::string> PrintedTable() {
  const Scenario nominal = LoadScenario(kFolder + "nominal.json");
  std::istringstream text(report::ParametersMarkdown(
      report::SelectParameters(ListParameters(nominal), core::Origin::kAssumed)));
  return Lines(text);
}

// The lines of `a` that `b` lacks.
std::string Missing(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  std::string text;
  for (const std::string& line : a) {
    if (std::find(b.begin(), b.end(), line) == b.end()) text += "\n  " + line;
  }
  return text;
}

TEST(AssumptionsTest, TableEqualsTheProgram) {
  const std::vector<std::string> committed = CommittedTable();
  const std::vector<std::string> printed = PrintedTable();
  ASSERT_FALSE(committed.empty()) << "no table between the markers of ASSUMPTIONS.md";
  EXPECT_EQ(Missing(printed, committed), "") << "lines that the document lacks; " << kAdvice;
  EXPECT_EQ(Missing(committed, printed), "") << "lines that do not hold any more; " << kAdvice;
  EXPECT_TRUE(committed == printed) << "other order or lines twice; " << kAdvice;
}

TEST(AssumptionsTest, TableHoldsEveryAssumedParameterOfTheScenario) {
  std::size_t assumed = 0;
  for (const core::ParameterInfo& parameter :
       ListParameters(LoadScenario(kFolder + "nominal.json"))) {
    if (parameter.origin == core::Origin::kAssumed) ++assumed;
  }
  EXPECT_EQ(PrintedTable().size(), assumed + 2);  // header and rule
}

}  // namespace
}  // namespace rockyard::scenario
