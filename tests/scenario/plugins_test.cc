// Scenarios and sweeps whose navigators are plugins: how they are read, written, known by and
// swept. The plugin is `echo` of tests/plugin.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "core/json_file.h"
#include "core/json_text.h"
#include "core/refusals.h"
#include "core/says.h"
#include "core/test_folder.h"
#include "navigation/navigator.h"
#include "scenario/load.h"
#include "scenario/sweep.h"
#include "scenario/sweep_cell.h"

namespace rockyard::scenario {
namespace {

namespace fs = std::filesystem;
using core::JsonValue;
using core::OneProblem;
using core::ParseJson;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Overrides = std::vector<std::string>;

class PluginScenarios : public testing::Test {
 protected:
  PluginScenarios() { WriteFolder("here"); }

  fs::path At(const std::string& name) const { return folder_.path() / name; }
  void Write(const std::string& name, const std::string& text) const {
    std::ofstream(At(name)) << text;
  }

  // A folder with the plugin and a scenario that drives with it. `more` stands behind the end of
  // the library, where no loader reads.
  void WriteFolder(const std::string& name, const std::string& more = "") const {
    fs::create_directories(At(name) / "libs");
    fs::copy_file(fs::path(PLUGIN_FOLDER) / "echo.so", At(name) / "libs/echo.so");
    std::ofstream(At(name) / "libs/echo.so", std::ios::app | std::ios::binary) << more;
    Write(name + "/mine.json",
          R"({"name": "mine", "plugins": ["libs/echo.so"],
              "navigation": {"navigator": "echo", "echo": {"goal_tolerance_m": 0.3},
                             "every_type": {"real": 0.5, "boolean": false, "angle_deg": 0.1}}})");
  }

  Scenario Load(const std::string& name = "here", const Overrides& overrides = {}) const {
    return LoadScenario(At(name) / "mine.json", overrides);
  }
  std::vector<core::Problem> ProblemsOf(const Overrides& overrides) const {
    return core::ProblemsIn([&] { Load("here", overrides); });
  }
  JsonValue Document(const Scenario& scenario) const { return WriteScenario(scenario); }

 private:
  core::TestFolder folder_;
};

const navigation::NavigatorSet& NavigatorsOf(const Scenario& scenario) {
  return scenario.drive.navigation.navigators;
}

// The text of a value in a scenario's document.
std::string ValueAt(const Scenario& scenario, const std::string& path) {
  const JsonValue document = WriteScenario(scenario);
  const JsonValue* value = FindPath(document, path);
  return value == nullptr ? "" : core::CompactJson(*value);
}

TEST_F(PluginScenarios, HaveItsNavigatorsAndParameters) {
  const Scenario scenario = Load();
  ASSERT_EQ(scenario.plugins.size(), 1U);
  EXPECT_EQ(scenario.plugins[0].text, At("here/libs/echo.so").string());
  EXPECT_EQ(NavigatorsOf(scenario).chosen().name(), "echo");
  EXPECT_TRUE(NavigatorsOf(scenario).chosen().foreign());
  EXPECT_EQ(NavigatorsOf(scenario).chosen().traits().goal.tolerance_m, 0.3);
  EXPECT_EQ(ValueAt(scenario, "navigation.echo.goal_tolerance_m"), "0.3");
  EXPECT_EQ(ValueAt(scenario, "navigation.echo.look"), "2");
  EXPECT_EQ(ValueAt(scenario, "navigation.every_type.angle_deg"), "0.1");
  // An override goes over the file.
  EXPECT_EQ(ValueAt(Load("here", {"navigation.echo.goal_tolerance_m=0.4"}),
                    "navigation.echo.goal_tolerance_m"),
            "0.4");
  EXPECT_EQ(NavigatorsOf(Load("here", {"navigation.navigator=gestalt"})).chosen().name(),
            "gestalt");
}

TEST_F(PluginScenarios, AreCheckedByWhatThePluginDeclares) {
  EXPECT_THAT(ProblemsOf({}), IsEmpty());
  EXPECT_THAT(ProblemsOf({"navigation.echo.goal_tolerance_m=7"}),
              OneProblem("navigation.echo.goal_tolerance_m", "above the largest", "from 0 to 5"));
  EXPECT_THAT(ProblemsOf({"navigation.echo.goal_tolerance=1"}),
              OneProblem("navigation.echo.goal_tolerance", "not a known key", "goal_tolerance_m"));
  EXPECT_THAT(ProblemsOf({"navigation.echo.status=1.5"}),
              OneProblem("navigation.echo.status", "integer"));
  EXPECT_THAT(ProblemsOf({"navigation.navigator=ecko"}),
              OneProblem("navigation.navigator", "", "echo"));
  // Conditions across parameters are the plugin's own.
  EXPECT_THAT(ProblemsOf({"navigation.every_type.real=2.3"}),
              OneProblem("navigation.every_type.real", "is too large", "use less than 2.25"));
  EXPECT_THAT(ProblemsOf({"navigation.every_type.inner.low=3"}),
              OneProblem("navigation.every_type.inner.low", "is above high", "use less"));
  // Traits are known to conditions across modules.
  EXPECT_THAT(ProblemsOf({"navigation.echo.goal_tolerance_m=2"}),
              OneProblem("course.goal_radius_m", "navigation.echo.goal_tolerance_m"));
}

TEST_F(PluginScenarios, NeedTheirPlugin) {
  EXPECT_THAT(core::ProblemsIn([] { ParseScenario(R"({"navigation": {"navigator": "echo"}})"); }),
              OneProblem("navigation.navigator"));
  fs::remove(At("here/libs/echo.so"));
  EXPECT_THAT(ProblemsOf({}), OneProblem("plugins[0].library", "libs/echo.so"));
}

// From any folder: paths in it are absolute.
TEST_F(PluginScenarios, AreReadBackBitForBit) {
  const Scenario scenario = Load(
      "here", {"navigation.echo.goal_tolerance_m=0.1", "navigation.every_type.real=-0.7",
               "navigation.every_type.angle_deg=12.3", "navigation.every_type.text=\"a \\\" b\"",
               "navigation.every_type.reals=[0.1,3]", "navigation.every_type.choice=third",
               "navigation.every_type.integers=[9007199254740993]"});
  const std::string text = ResolvedJson(scenario);
  const Scenario again = ParseScenario(text, {}, "/");
  EXPECT_EQ(ResolvedJson(again), text);
  EXPECT_EQ(Fingerprint(again), Fingerprint(scenario));
  EXPECT_EQ(ResolvedFingerprint(ParseJson(text, "test")), Fingerprint(scenario));
  EXPECT_EQ(ValueAt(again, "navigation.every_type.integers"), "[9007199254740993]");
  EXPECT_EQ(ValueAt(again, "navigation.every_type.text"), R"("a \" b")");
}

TEST_F(PluginScenarios, AreKnownByTheHashOfThePluginWhereverItLies) {
  WriteFolder("there");
  WriteFolder("changed", "x");
  const Scenario here = Load("here");
  const Scenario there = Load("there");
  EXPECT_EQ(here.plugins[0].hash, there.plugins[0].hash);
  EXPECT_NE(ResolvedJson(here), ResolvedJson(there));
  EXPECT_EQ(Fingerprint(here), Fingerprint(there));
  EXPECT_NE(Fingerprint(here), Fingerprint(Load("changed")));
  // The controls: a parameter is known, a name is not.
  EXPECT_NE(Fingerprint(here), Fingerprint(Load("here", {"navigation.echo.goal_tolerance_m=0.2"})));
  EXPECT_EQ(Fingerprint(here), Fingerprint(Load("here", {"name=yours"})));
  // A scenario without plugins says nothing of them, as before there were any.
  EXPECT_EQ(WriteScenario({}).Find("plugins"), nullptr);
}

TEST_F(PluginScenarios, ThatWereResolvedWithAnotherPluginAreRefused) {
  const Scenario before = Load();
  const std::string text = ResolvedJson(before);
  std::ofstream(At("here/libs/echo.so"), std::ios::app) << "x";
  const std::string now = Load().plugins[0].hash;
  EXPECT_THAT(core::RefusalOf([&] { ParseScenario(text); }),
              core::Says("plugins[0]", "another one than before", now, before.plugins[0].hash));
}

// Both files of a pair may list some; the list of the one that extends is that which counts, and
// paths are relative to it.
TEST_F(PluginScenarios, MayBeExtended) {
  Write("here/longer.json", R"({"extends": "mine.json", "course": {"goal_x_m": 9}})");
  const Scenario longer = LoadScenario(At("here/longer.json"));
  EXPECT_EQ(longer.drive.course.goal_x_m, 9.0);
  EXPECT_EQ(longer.plugins.size(), 1U);
  EXPECT_EQ(NavigatorsOf(longer).chosen().name(), "echo");
}

// What a program that reads results knows of a scenario whose plugin is gone.
TEST_F(PluginScenarios, AreReadSealedWithoutTheirPlugin) {
  const Scenario open = Load();
  const JsonValue document = Document(open);
  fs::remove(At("here/libs/echo.so"));
  EXPECT_THROW(ReadScenario(document), core::UserError);
  const Scenario sealed = ReadScenarioSealed(document);
  EXPECT_THAT(sealed.plugins, IsEmpty());
  EXPECT_EQ(NavigatorsOf(sealed).chosen().name(), "echo");
  // All but the list of plugins is as it was written.
  JsonValue without = document;
  without.Erase("plugins");
  EXPECT_EQ(core::DumpJson(Document(sealed)), core::DumpJson(without));
  EXPECT_ANY_THROW(NavigatorsOf(sealed).chosen().Make({}));
  // The control: wrong values of the rest are found.
  JsonValue wrong = document;
  core::SetPath(wrong, "course.goal_radius_m", JsonValue(-1.0));
  EXPECT_THROW(ReadScenarioSealed(wrong), core::UserError);
}

TEST_F(PluginScenarios, OfOwnNavigatorsAreReadSealedAsTheyAre) {
  const Scenario scenario = ParseScenario(R"({"navigation": {"navigator": "gestalt"}})");
  EXPECT_EQ(ResolvedJson(ReadScenarioSealed(Document(scenario))), ResolvedJson(scenario));
}

TEST_F(PluginScenarios, SchemaAndParametersHaveThoseOfThePlugin) {
  const Scenario scenario = Load();
  const JsonValue schema = ParseJson(SchemaJson(scenario), "schema");
  const JsonValue* tolerance =
      FindPath(schema, "properties.navigation.properties.echo.properties.goal_tolerance_m");
  ASSERT_NE(tolerance, nullptr);
  EXPECT_EQ(tolerance->Find("maximum")->number(), 5.0);
  EXPECT_NE(FindPath(schema, "properties.plugins"), nullptr);
  bool listed = false;
  for (const core::ParameterInfo& each : ListParameters(scenario)) {
    listed |= each.path == "navigation.every_type.inner.high";
  }
  EXPECT_TRUE(listed);
}

class PluginSweeps : public PluginScenarios {
 protected:
  Sweep Parse(const std::string& axes, const std::string& more = "") const {
    return ParseSweep(
        R"({"name": "sweep", "scenario": "mine.json", )" + more + R"("axes": [)" + axes + "]}", {},
        At("here"));
  }
};

TEST_F(PluginSweeps, VaryAParameterOfAPlugin) {
  const Sweep sweep =
      Parse(R"({"path": "navigation.echo.goal_tolerance_m", "values": [0.1, 0.2]})");
  ASSERT_EQ(sweep.cells.size(), 2U);
  EXPECT_EQ(sweep.axes[0].unit, "m");
  EXPECT_EQ(sweep.cells[0].name, "goal_tolerance_m=0.1");
  for (std::size_t i = 0; i < 2; ++i) {
    const Scenario& cell = sweep.cells[i].scenario;
    EXPECT_EQ(NavigatorsOf(cell).chosen().traits().goal.tolerance_m, i == 0 ? 0.1 : 0.2);
    ASSERT_EQ(cell.plugins.size(), 1U);
    // It is opened once for all cells.
    EXPECT_EQ(cell.plugins[0].navigators[0], sweep.cells[0].scenario.plugins[0].navigators[0]);
  }
  EXPECT_NE(Fingerprint(sweep.cells[0].scenario), Fingerprint(sweep.cells[1].scenario));
}

TEST_F(PluginSweeps, CompareAPluginWithOwnNavigators) {
  const Sweep sweep =
      Parse(R"({"path": "navigation.navigator", "values": ["pathfinder", "echo", "every_type"]})");
  ASSERT_EQ(sweep.cells.size(), 3U);
  std::vector<std::string> names;
  for (const SweepCell& cell : sweep.cells) {
    names.emplace_back(NavigatorsOf(cell.scenario).chosen().name());
    EXPECT_EQ(cell.scenario.plugins.size(), 1U);
  }
  EXPECT_THAT(names, ElementsAre("pathfinder", "echo", "every_type"));
}

// As --plugin does: it chooses where the file does not, and --set chooses above all.
TEST_F(PluginSweeps, WhatAListChoosesGivesWayToTheFile) {
  const std::string list = "plugins=" + core::CompactJson(core::JsonValue(core::JsonValue::List{
                                            core::JsonValue(At("here/libs/echo.so").string())}));
  const auto chosen = [&](const std::string& axes, std::vector<std::string> overrides) {
    std::vector<std::string> names;
    for (const SweepCell& cell :
         ParseSweep(R"({"name": "sweep", "axes": [)" + axes + "]}", {.overrides = overrides})
             .cells) {
      names.emplace_back(NavigatorsOf(cell.scenario).chosen().name());
    }
    return names;
  };
  const std::string navigators =
      R"({"path": "navigation.navigator", "values": ["pathfinder", "echo"]})";
  const std::string choice = "navigation.navigator=echo";
  EXPECT_THAT(chosen(navigators, {choice, list}), ElementsAre("pathfinder", "echo"));
  EXPECT_THAT(chosen(R"({"path": "navigation.echo.goal_tolerance_m", "values": [0.1, 0.2]})",
                     {choice, list}),
              ElementsAre("echo", "echo"));
  EXPECT_THAT(core::RefusalOf([&] {
                chosen(navigators, {choice, list, choice});
              }),
              HasSubstr("was set to \"echo\""));
}

// An axis without values takes the range that the plugin says is worth a study.
TEST_F(PluginSweeps, TakeTheStudyRangeOfAPlugin) {
  const Sweep sweep = Parse(R"({"path": "navigation.every_type.real", "steps": 3})");
  ASSERT_EQ(sweep.cells.size(), 3U);
  EXPECT_EQ(sweep.cells[0].levels[0].number, 1.0);
  EXPECT_EQ(sweep.cells[2].levels[0].number, 2.0);
}

TEST_F(PluginSweeps, TellWhatIsWrongWithAValue) {
  EXPECT_THAT(core::RefusalOf([&] {
                Parse(R"({"path": "navigation.echo.goal_tolerance_m", "values": [0.1, 9]})");
              }),
              core::Says("goal_tolerance_m=9", "navigation.echo.goal_tolerance_m", "above"));
  EXPECT_THAT(core::RefusalOf(
                  [&] { Parse(R"({"path": "navigation.echo.goal_tolerance", "values": [1]})"); }),
              core::Says("axes[0].path", "no parameter", "navigation.echo.goal_tolerance_m"));
}

// Levels that name scenario files, each with a plugin of its own folder.
TEST_F(PluginSweeps, LevelsMayBeScenariosWithPlugins) {
  WriteFolder("there", "x");
  Write("files.json", R"({"name": "files", "axes": [{"name": "file", "levels": [
      {"name": "here", "scenario": "here/mine.json"},
      {"name": "there", "scenario": "there/mine.json"}]}]})");
  const Sweep sweep = LoadSweep(At("files.json"));
  ASSERT_EQ(sweep.cells.size(), 2U);
  EXPECT_EQ(sweep.cells[0].scenario.plugins[0].text, At("here/libs/echo.so").string());
  EXPECT_EQ(sweep.cells[1].scenario.plugins[0].text, At("there/libs/echo.so").string());
  EXPECT_NE(sweep.cells[0].scenario.plugins[0].hash, sweep.cells[1].scenario.plugins[0].hash);
}

// The document of a stored sweep is read again by whoever shows it.
TEST_F(PluginSweeps, AreReadSealedWithoutTheirPlugin) {
  const Sweep open = Parse(R"({"path": "navigation.echo.goal_tolerance_m", "values": [0.1, 0.2]})");
  fs::remove(At("here/libs/echo.so"));
  EXPECT_THROW(ParseSweep(open.document, {}, "/"), core::UserError);
  SweepChanges changes;
  changes.sealed = true;
  const Sweep sealed = ParseSweep(open.document, changes, "/");
  ASSERT_EQ(sealed.cells.size(), 2U);
  EXPECT_EQ(sealed.axes[0].name, open.axes[0].name);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(sealed.cells[i].name, open.cells[i].name);
    EXPECT_EQ(sealed.cells[i].scenario.seed, open.cells[i].scenario.seed);
    EXPECT_EQ(ValueAt(sealed.cells[i].scenario, "navigation.echo.goal_tolerance_m"),
              ValueAt(open.cells[i].scenario, "navigation.echo.goal_tolerance_m"));
  }
}

}  // namespace
}  // namespace rockyard::scenario
