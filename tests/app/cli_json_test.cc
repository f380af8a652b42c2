// What programs get: one JSON object on standard output.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>

#include "app/command.h"

namespace rockyard::app {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class CliJson : public CommandTest {
 protected:
  // Nothing but the object, and the same exit code as without.
  json Told(const std::vector<std::string>& words, int exit_code) const {
    const CommandResult result = Run(With(words, {"--json"}));
    EXPECT_EQ(result.exit_code, exit_code) << result.err;
    const json object = json::parse(result.out, nullptr, false);
    EXPECT_TRUE(object.is_object()) << result.out;
    return object;
  }

  static std::string Source(const std::string& path) {
    return std::string(ROCKYARD_SOURCE_DIR) + "/" + path;
  }
};

TEST_F(CliJson, ComparisonOfDrives) {
  ASSERT_EQ(Run(QuickRun("a", 4)).exit_code, 0);
  ASSERT_EQ(Run(With(QuickRun("b", 4), {"--set", "course.goal_radius_m=0.7"})).exit_code, 0);
  const json told = Told({"compare", "a", "b"}, 0);
  EXPECT_EQ(told["schema_version"], 1);
  EXPECT_EQ(told["kind"], "drive_comparison");
  const json& comparison = told["comparison"];
  EXPECT_EQ(comparison["paired"], true);
  EXPECT_EQ(comparison["pairs"], 4);
  EXPECT_EQ(comparison["settings"][0]["path"], "course.goal_radius_m");
  EXPECT_EQ(comparison["successes"].size(), 2u);
  EXPECT_FALSE(comparison["columns"].empty());
}

TEST_F(CliJson, ComparisonOfMeasurements) {
  for (const char* out : {"a", "b"}) {
    ASSERT_EQ(Run({"run", Source("scenarios/hazard_detection/detection.json"), "--trials", "2",
                   "--out", out, "--set", "hazard_detection.scenes_per_run=5"})
                  .exit_code,
              0);
  }
  const json told = Told({"compare", "a", "b"}, 0);
  EXPECT_EQ(told["kind"], "cell_comparison");
  EXPECT_EQ(told["exit_code"], 0);
  EXPECT_FALSE(told["cells"].empty());
  EXPECT_EQ(told["cells"][0]["rates"][0]["differs"], false);
}

TEST_F(CliJson, CheckAgainstPublishedValues) {
  ASSERT_EQ(Run(QuickRun("a", 3)).exit_code, 0);
  const std::vector<std::string> words = {
      "check",        "a",  "--against", Source("results/reference/matthies1995.json"),
      "--replicates", "200"};
  const int code = Run(words).exit_code;
  const json told = Told(words, code);
  EXPECT_EQ(told["kind"], "published_check");
  EXPECT_EQ(told["exit_code"], code);
  bool found = false;
  for (const json& value : told["values"]) {
    if (value["id"] != "nominal.distance.min") continue;
    found = true;
    EXPECT_EQ(value["published"], 7.0);
    EXPECT_EQ(value["simulated_runs"], 3);
    EXPECT_TRUE(value["verdict"].is_string());
  }
  EXPECT_TRUE(found);
}

TEST_F(CliJson, CheckAgainstABaseline) {
  ASSERT_EQ(Run(QuickRun("a", 5)).exit_code, 0);
  ASSERT_EQ(Run({"baseline", "a", "--out", "base.json", "--reason", "test"}).exit_code, 0);
  const json told = Told({"check", "a", "--against", "base.json"}, 0);
  EXPECT_EQ(told["kind"], "baseline_check");
  EXPECT_EQ(told["exit_code"], 0);
  EXPECT_EQ(told["cells"][0]["identical"], true);
  for (const json& metric : told["metrics"]) EXPECT_EQ(metric["verdict"], "equivalent");
  EXPECT_FALSE(told["metrics"].empty());
}

TEST_F(CliJson, EveryCommandOfPeopleHasAFormForPrograms) {
  for (const char* command : {"run", "sweep", "merge", "check", "compare", "list"}) {
    EXPECT_THAT(Run({command, "--help"}).out, HasSubstr("--json")) << command;
  }
}

}  // namespace
}  // namespace rockyard::app
