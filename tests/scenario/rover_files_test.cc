// The rovers in scenarios/rovers: complete, valid, and with the origins that their README states.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "core/error.h"
#include "core/json_file.h"
#include "core/json_text.h"
#include "scenario/load.h"

namespace rockyard::scenario {
namespace {

namespace fs = std::filesystem;
using core::JsonValue;

const fs::path kFolder = fs::path(ROCKYARD_SOURCE_DIR) / "scenarios" / "rovers";
const std::set<std::string> kRovers = {"athena_2012", "athena_sdm", "mfex", "perseverance_like",
                                       "rocky_3_2"};

// "geometry.length_m" and its value as JSON text, without "extends".
using Values = std::map<std::string, std::string>;

Values ValuesOf(const JsonValue& rover) {
  Values values;
  for (const core::JsonMember& group : rover.members()) {
    if (group.key == "extends") continue;
    for (const core::JsonMember& member : group.value.members()) {
      values[group.key + "." + member.key] = core::Abbreviate(member.value);
    }
  }
  return values;
}

// What describes the rover: not how its motion is computed, and not the place where it drives.
Values Describing(const JsonValue& rover) {
  Values values;
  for (const auto& [path, value] : ValuesOf(rover)) {
    const std::string group = path.substr(0, path.find('.'));
    if (std::set<std::string>{"geometry", "mass", "drive", "contact"}.contains(group)) {
      values[path] = value;
    }
  }
  return values;
}

Values ValuesOfScenario(const Scenario& scenario) {
  JsonValue rover = *WriteScenario(scenario).Find("rover");
  rover.Erase("fidelity");
  return Describing(rover);
}

std::set<std::string> Paths(const Values& values) {
  std::set<std::string> paths;
  for (const auto& [path, value] : values) paths.insert(path);
  return paths;
}

std::string File(const std::string& name) { return (kFolder / (name + ".json")).string(); }

Scenario WithRover(const std::string& name) {
  return ParseScenario(R"({"rover": {"extends": ")" + name + R"(.json"}})", {}, kFolder);
}

JsonValue OwnText(const std::string& name) {
  std::ifstream file(File(name));
  std::stringstream text;
  text << file.rdbuf();
  return core::ParseJson(text.str(), name);
}

TEST(RoverFilesTest, TheFolderHoldsTheRoversThatAreTested) {
  std::set<std::string> found;
  for (const auto& entry : fs::directory_iterator(kFolder)) {
    if (entry.path().extension() == ".json") found.insert(entry.path().stem().string());
  }
  EXPECT_EQ(found, kRovers);
}

// A rover file replaces every value of the rover that a base scenario describes.
TEST(RoverFilesTest, EveryFileGivesEveryValueOfARoverAndNothingElse) {
  const std::set<std::string> all = Paths(ValuesOfScenario({}));
  ASSERT_GT(all.size(), 30u);
  for (const std::string& name : kRovers) {
    EXPECT_EQ(Paths(ValuesOf(core::LoadJsonFile(File(name)))), all) << name;
  }
}

TEST(RoverFilesTest, Rocky32IsTheDefault) {
  EXPECT_EQ(ResolvedJson(WithRover("rocky_3_2")), DefaultsJson());
}

TEST(RoverFilesTest, PublishedValues) {
  const rover::RoverParams mfex = WithRover("mfex").drive.rover;
  EXPECT_EQ(mfex.mass.total_kg, 11.5);  // Matthies 1995 sec. 2.1.2
  EXPECT_EQ(mfex.drive.speed_m_s, 0.0067);
  EXPECT_EQ(mfex.geometry.wheel_radius_m, 0.065);
  const rover::RoverParams sdm = WithRover("athena_sdm").drive.rover;
  EXPECT_EQ(sdm.geometry.length_m, 1.04);  // Goldberg 2002 table 1
  EXPECT_EQ(sdm.geometry.width_m, 0.84);
  EXPECT_EQ(sdm.geometry.wheel_radius_m, 0.1);
  EXPECT_GE(sdm.geometry.belly_clearance_m, 0.2);
  EXPECT_EQ(sdm.drive.speed_m_s, 0.05);  // sec. 5
  const rover::RoverParams athena = WithRover("athena_2012").drive.rover;
  EXPECT_EQ(athena.drive.speed_m_s, 0.07);  // Howard 2012 sec. 3
  EXPECT_EQ(athena.geometry.steered_wheels, rover::SteeredWheels::kAll);
}

// A cell of the README as ValuesOf writes values.
std::string Canonical(const std::string& cell) {
  try {
    return core::Abbreviate(core::ParseJson(cell, "cell"));
  } catch (const core::UserError&) {
    return core::Abbreviate(JsonValue(cell));
  }
}

TEST(RoverFilesTest, MarsScenarioDrivesTheFlightRoverInMarsGravity) {
  const Scenario mars =
      LoadScenario(fs::path(ROCKYARD_SOURCE_DIR) / "scenarios" / "mars" / "mfex_nominal.json");
  EXPECT_EQ(ValuesOfScenario(mars), ValuesOfScenario(WithRover("mfex")));
  EXPECT_EQ(mars.drive.rover.physics.gravity_m_s2, 3.72);
  EXPECT_EQ(mars.drive.terrain.rocks.k_per_m2, 0.00415);  // nominal, Matthies 1995 sec. 7
  EXPECT_EQ(mars.drive.clock.scan_time_s, 20.0);          // sec. 6
  EXPECT_EQ(mars.drive.navigation.wheel_driver.steer_rate_rad_s,
            mars.drive.rover.drive.steer_rate_rad_s);
  EXPECT_NE(mars.description.find("prediction"), std::string::npos);
}

struct Row {
  std::string path, value, origin, range, source;
};

std::string Trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" `");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" `") - first + 1);
}

// The rows between the markers of one rover.
std::vector<Row> TableOf(const std::string& name) {
  std::ifstream file(kFolder / "README.md");
  std::vector<Row> rows;
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line == "<!-- begin " + name + " -->") inside = true;
    if (line == "<!-- end " + name + " -->") return rows;
    if (!inside || !line.starts_with("| `")) continue;
    std::vector<std::string> cells;
    std::istringstream stream(line.substr(1));
    for (std::string cell; std::getline(stream, cell, '|');) cells.push_back(Trimmed(cell));
    if (cells.size() != 5) {
      ADD_FAILURE() << "not five cells: " << line;
      continue;
    }
    rows.push_back({cells[0], cells[1], cells[2], cells[3], cells[4]});
  }
  ADD_FAILURE() << "no end of the table of " << name;
  return rows;
}

// Whether "1 to 4" or "rear, front" holds the value.
bool Holds(const std::string& range, const std::string& value) {
  const std::size_t to = range.find(" to ");
  if (to == std::string::npos) {
    return (", " + range + ",").find(", " + value + ",") != std::string::npos;
  }
  const double at = std::strtod(value.c_str(), nullptr);
  return std::strtod(range.c_str(), nullptr) <= at &&
         at <= std::strtod(range.c_str() + to + 4, nullptr);
}

TEST(RoverFilesTest, ReadmeTablesEqualTheFiles) {
  for (const std::string& name : kRovers) {
    Values table;
    for (const Row& row : TableOf(name)) {
      const bool new_row = table.emplace(row.path, Canonical(row.value)).second;
      EXPECT_TRUE(new_row) << name << ": twice " << row.path;
    }
    EXPECT_EQ(table, ValuesOf(OwnText(name))) << name;
  }
}

TEST(RoverFilesTest, ReadmeGivesEveryValueASourceAndWhatIsNotPublishedARange) {
  for (const std::string& name : kRovers) {
    for (const Row& row : TableOf(name)) {
      const std::string where = name + ": " + row.path;
      EXPECT_FALSE(row.source.empty()) << where;
      if (row.origin == "published") {
        EXPECT_EQ(row.range, "") << where;
      } else {
        EXPECT_TRUE(row.origin == "assumed" || row.origin == "calibrated") << where;
        EXPECT_TRUE(Holds(row.range, row.value)) << where << ": " << row.range;
      }
    }
  }
}

// Could any value pass as held, the test above would show nothing.
TEST(RoverFilesTest, RangesExclude) {
  EXPECT_TRUE(Holds("1 to 4", "2.3"));
  EXPECT_FALSE(Holds("1 to 4", "4.1"));
  EXPECT_FALSE(Holds("", "4.1"));
  EXPECT_TRUE(Holds("rear, front", "front"));
  EXPECT_FALSE(Holds("rear, front", "all"));
}

// What the README says of Rocky 3.2 is what the program says.
TEST(RoverFilesTest, SourcesOfRocky32AreThoseOfTheProgram) {
  std::map<std::string, core::ParameterInfo> known;
  for (const core::ParameterInfo& parameter : ListParameters()) {
    known.emplace(parameter.path, parameter);
  }
  for (const Row& row : TableOf("rocky_3_2")) {
    const core::ParameterInfo& parameter = known.at("rover." + row.path);
    EXPECT_EQ(row.origin, core::Name(parameter.origin)) << row.path;
    EXPECT_EQ(row.source, parameter.source) << row.path;
  }
}

}  // namespace
}  // namespace rockyard::scenario
