// ASSUMPTIONS.md of the Pathfinder scenarios lists every assumed parameter as the program knows it.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "report/parameter_table.h"
#include "scenario/load.h"

namespace rockyard::scenario {
namespace {

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
