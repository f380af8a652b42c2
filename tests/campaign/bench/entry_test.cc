// Manifests: what an entry may say, and what it is known by.
#include "campaign/bench/entry.h"

#include "bench_runs.h"
#include "core/error.h"

namespace rockyard::campaign {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class EntryTest : public BenchRuns {
 protected:
  BenchEntry Entry(const std::string& manifest) const {
    Write(Path("mine/entry.json"), manifest);
    return ReadEntry(Path("mine"));
  }

  void ExpectRefused(const std::string& manifest, const std::string& path,
                     const std::string& reason) const {
    try {
      Entry(manifest);
      ADD_FAILURE() << "not refused: " << manifest;
    } catch (const core::UserError& error) {
      EXPECT_EQ(error.problems().front().path, Path("mine/entry.json").string() + ": " + path);
      EXPECT_THAT(error.problems().front().reason, HasSubstr(reason));
    }
  }
};

TEST_F(EntryTest, SettingsAreThoseOfTheNavigator) {
  const BenchEntry entry = Entry(R"({
    "name": "mine", "navigator": "gestalt", "track": "points",
    "set": {"navigation.gestalt.drive.step_m": 0.3, "navigation.on_slip.reaction": "replan"}})");
  EXPECT_THAT(entry.settings,
              ElementsAre("navigation.navigator=gestalt", "navigation.gestalt.drive.step_m=0.3",
                          "navigation.on_slip.reaction=\"replan\""));
  for (const char* path : {"rover.drive.speed_m_s", "navigation.pathfinder.threading_m",
                           "navigation.gestaltx", "seed", "navigation.wheel_driver.x"}) {
    ExpectRefused(
        std::string(R"({"name": "mine", "navigator": "gestalt", "set": {")") + path + R"(": 1}})",
        std::string("set.") + path, "is not the entry's to set");
  }
}

TEST_F(EntryTest, WhatCannotBeMeantIsRefused) {
  ExpectRefused(R"({"navigator": "gestalt"})", "name", "is missing");
  ExpectRefused(R"({"name": "a|b", "navigator": "gestalt"})", "name", "is no name");
  ExpectRefused(R"({"name": "mine"})", "navigator", "is missing");
  ExpectRefused(R"({"name": "mine", "navigator": "a", "plugin": "a.so", "process": "b"})", "plugin",
                "beside a process");
  ExpectRefused(R"({"name": "mine", "navigator": "a", "plugin": "../a.so"})", "plugin",
                "is outside");
  ExpectRefused(R"({"name": "mine", "navigator": "a", "seed": 3})", "seed", "not a known key");
}

TEST_F(EntryTest, ThePluginLiesInTheFolder) {
  const BenchEntry entry =
      Entry(R"({"name": "mine", "navigator": "a", "process": "python3 a.py"})");
  EXPECT_THAT(entry.settings.front(),
              testing::AllOf(HasSubstr("plugins=[{\"process\":\"python3 a.py\""),
                             HasSubstr(Path("mine").string())));
}

TEST_F(EntryTest, EveryFileOfAnEntryWithCodeCounts) {
  const std::string manifest = R"({"name": "mine", "navigator": "a", "process": "python3 a.py"})";
  Write(Path("mine/a.py"), "first");
  const std::string first = Entry(manifest).digest;
  EXPECT_EQ(Entry(manifest).digest, first);
  Write(Path("mine/.hidden"), "no file of the entry");
  Write(Path("mine/__pycache__/a.pyc"), "nor this");
  EXPECT_EQ(Entry(manifest).digest, first);
  Write(Path("mine/lib/b.py"), "one more");
  const std::string second = Entry(manifest).digest;
  EXPECT_NE(second, first);
  fs::rename(Path("mine/lib/b.py"), Path("mine/lib/c.py"));
  EXPECT_NE(Entry(manifest).digest, second) << "names count";
}

TEST_F(EntryTest, NavigatorsOfTheProgramAreKnownByTheirManifest) {
  const std::string manifest = R"({"name": "mine", "navigator": "gestalt"})";
  const std::string digest = Entry(manifest).digest;
  Write(Path("mine/other.json"), "a neighbour");
  EXPECT_EQ(Entry(manifest).digest, digest);
  EXPECT_NE(Entry(R"({"name": "mine", "navigator": "gestalt"} )").digest, digest);
}

}  // namespace
}  // namespace rockyard::campaign
