// The plugins of a scenario: how they are listed, what they are known by, and how their navigators
// come into a set.
#include "plugin/plugin_use.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

#include "asking.h"
#include "core/json_text.h"
#include "core/refusals.h"
#include "core/test_folder.h"

namespace rockyard::plugin {
namespace {

namespace fs = std::filesystem;
using core::CompactJson;
using core::JsonValue;
using core::ParseJson;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

// A process that says what it is, by a name and a version that it reads.
constexpr const char* kProgram = R"(
import json, os, struct, sys
requests, answers = open(3, "rb"), open(4, "wb")
version = open("version").read() if os.path.exists("version") else "1"
while len(size := requests.read(4)) == 4:
    requests.read(struct.unpack("<I", size)[0])
    data = json.dumps({"protocol": 1, "name": "mine", "version": version, "reads": "nothing",
                       "goal_tolerance": {"value_m": 0.5}}).encode()
    answers.write(struct.pack("<I", len(data)) + data)
    answers.flush()
)";

JsonValue Json(const std::string& text) { return ParseJson(text, "test"); }

class PluginUseTest : public testing::Test {
 protected:
  const fs::path& folder() const { return folder_.path(); }
  std::string At(const std::string& name) const { return folder() / name; }

  void Write(const std::string& name, const std::string& text) const {
    fs::create_directories((folder() / name).parent_path());
    std::ofstream(folder() / name) << text;
  }
  // A copy of a library of the tests, with these bytes behind its end, which loaders do not read.
  void CopyLibrary(const std::string& library, const std::string& name,
                   const std::string& more = "") const {
    fs::create_directories((folder() / name).parent_path());
    fs::copy_file(std::string(PLUGIN_FOLDER) + "/" + library + ".so", folder() / name);
    std::ofstream(folder() / name, std::ios::app | std::ios::binary) << more;
  }

  std::vector<PluginUse> Open(const std::string& list) const {
    return OpenPlugins(Json(list), folder());
  }
  PluginUse OpenOne(const std::string& entry) const { return Open("[" + entry + "]").at(0); }
  // The command in words of JSON.
  static std::string Process(const std::string& file, const std::string& more = "") {
    return R"({"process": ")" + std::string(TEST_PYTHON) + " -ESB " + file + "\"" + more + "}";
  }
  std::vector<core::Problem> ProblemsOf(const std::string& list) const {
    return core::ProblemsIn([&] { Open(list); });
  }

 private:
  core::TestFolder folder_;
};

TEST_F(PluginUseTest, ALibraryIsListedByItsFile) {
  CopyLibrary("echo", "libs/echo.so");
  for (const std::string& entry :
       {std::string(R"("libs/echo.so")"), std::string(R"({"library": "libs/echo.so"})"),
        std::string(R"({"library": "./libs/../libs/echo.so"})"),
        R"({"library": ")" + At("libs/echo.so") + "\"}"}) {
    SCOPED_TRACE(entry);
    const PluginUse use = OpenOne(entry);
    EXPECT_EQ(use.kind, PluginUse::Kind::kLibrary);
    EXPECT_EQ(use.text, At("libs/echo.so"));
    EXPECT_EQ(use.folder, "");
    EXPECT_EQ(use.Name(), "echo.so");
    EXPECT_FALSE(use.confined);
    EXPECT_THAT(use.hash, testing::MatchesRegex("[0-9a-f]{16}"));
    ASSERT_EQ(use.navigators.size(), 2U);
    EXPECT_EQ(use.navigators[0]->description().name, "echo");
  }
}

TEST_F(PluginUseTest, AProcessIsListedByItsCommandAndFolder) {
  Write("deep/mine.py", kProgram);
  const std::string deep = R"(, "folder": ")" + At("deep") + "\"";
  const PluginUse use = OpenOne(Process("mine.py", deep));
  EXPECT_EQ(use.kind, PluginUse::Kind::kProcess);
  EXPECT_EQ(use.text, std::string(TEST_PYTHON) + " -ESB mine.py");
  EXPECT_EQ(use.Name(), use.text);
  EXPECT_EQ(use.folder, At("deep"));
  ASSERT_EQ(use.navigators.size(), 1U);
  EXPECT_EQ(use.navigators[0]->description().name, "mine");
  EXPECT_EQ(OpenOne(Process("deep/mine.py")).folder, folder().string());
}

TEST_F(PluginUseTest, WhatIsWrongWithAListIsToldWithItsPlace) {
  using core::OneProblem;
  Write("text.so", "no library");
  EXPECT_THAT(ProblemsOf(R"({"library": "a.so"})"), OneProblem("plugins", "no list", "library"));
  EXPECT_THAT(ProblemsOf("[3]"), OneProblem("plugins[0]", "neither a text nor an object"));
  EXPECT_THAT(ProblemsOf("[{}]"), OneProblem("plugins[0]", "names no plugin"));
  EXPECT_THAT(ProblemsOf(R"([{"hash": "0"}])"), OneProblem("plugins[0]", "names no plugin"));
  EXPECT_THAT(ProblemsOf(R"([{"library": "a.so", "process": "a"}])"),
              OneProblem("plugins[0]", "a library and a process"));
  EXPECT_THAT(ProblemsOf(R"([{"libary": "a.so"}])"),
              OneProblem("plugins[0].libary", "not a known key", "library"));
  EXPECT_THAT(ProblemsOf(R"([{"library": 3}])"), OneProblem("plugins[0].library", "no text"));
  EXPECT_THAT(ProblemsOf(R"([{"process": ""}])"), OneProblem("plugins[0].process", "no text"));
  EXPECT_THAT(ProblemsOf(R"([{"library": "a.so", "hash": 3}])"),
              OneProblem("plugins[0].hash", "no text"));
  EXPECT_THAT(ProblemsOf(R"(["not_there.so"])"),
              OneProblem("plugins[0].library", At("not_there.so"), "--plugin"));
  EXPECT_THAT(ProblemsOf(R"(["."])"), OneProblem("plugins[0].library", "no file"));
  EXPECT_THAT(ProblemsOf(Process("mine.py", R"(, "folder": "/not/there")").insert(0, "[") + "]"),
              OneProblem("plugins[0].folder", "/not/there", "--navigator-process"));
  EXPECT_THAT(ProblemsOf(R"(["text.so"])"), testing::SizeIs(1));
  std::string many = "[\"a.so\"";
  for (int i = 0; i < 16; ++i) many += ", \"a.so\"";
  EXPECT_THAT(ProblemsOf(many + "]"), OneProblem("plugins", "17 entries", "16"));
  // The second is the wrong one.
  CopyLibrary("echo", "echo.so");
  EXPECT_THAT(ProblemsOf(R"(["echo.so", 3])"), OneProblem("plugins[1]", "neither"));
}

TEST_F(PluginUseTest, PathsOfAFileAreRelativeToItsFolder) {
  const auto anchored = [&](const char* list) {
    return CompactJson(Anchored(Json(list), "/some/where"));
  };
  EXPECT_EQ(anchored(R"(["a.so", "../b.so", "/c.so"])"),
            R"([{"library":"/some/where/a.so"},{"library":"/some/b.so"},{"library":"/c.so"}])");
  EXPECT_EQ(anchored(R"([{"library": "a.so", "hash": "1"}])"),
            R"([{"library":"/some/where/a.so","hash":"1"}])");
  EXPECT_EQ(
      anchored(R"([{"process": "python3 mine.py"}, {"process": "a", "folder": "/x"}])"),
      R"([{"process":"python3 mine.py","folder":"/some/where"},{"process":"a","folder":"/x"}])");
  // What is wrong is left for whoever opens it.
  EXPECT_EQ(anchored(R"([3, {"library": 4}, {}])"), R"([3,{"library":4},{}])");
  EXPECT_EQ(anchored(R"({"library": "a.so"})"), R"({"library":"a.so"})");
  EXPECT_EQ(CompactJson(Anchored(Json(R"(["a.so"])"), "")),
            R"([{"library":")" + (fs::current_path() / "a.so").string() + "\"}]");
}

TEST_F(PluginUseTest, TheHashOfALibraryIsThatOfItsBytes) {
  CopyLibrary("echo", "a/echo.so");
  CopyLibrary("echo", "b/another_name.so");
  CopyLibrary("echo", "c/echo.so", "x");
  const auto hash = [&](const char* file) { return OpenOne("\"" + std::string(file) + "\"").hash; };
  EXPECT_EQ(hash("a/echo.so"), hash("b/another_name.so"));
  EXPECT_NE(hash("a/echo.so"), hash("c/echo.so"));
}

TEST_F(PluginUseTest, TheHashOfAProcessIsThatOfItsCommandFilesAndVersion) {
  for (const char* place : {"a/", "b/", "other/", "version/", "data/"}) {
    Write(std::string(place) + "mine.py", kProgram);
    Write(std::string(place) + "my data.txt", "1");
  }
  Write("other/mine.py", std::string(kProgram) + "# another one\n");
  Write("version/version", "2");
  Write("data/my data.txt", "2");
  const auto hash = [&](const std::string& place, const std::string& file = "mine.py") {
    return OpenOne(Process(file, R"(, "folder": ")" + At(place) + "\"")).hash;
  };
  const std::string plain = hash("a");
  EXPECT_EQ(hash("b"), plain);
  EXPECT_NE(hash("other"), plain) << "another program";
  EXPECT_NE(hash("version"), plain) << "another version of the same program";
  EXPECT_EQ(hash("data"), plain) << "a file that the command does not name";
  const std::string with_data = "mine.py 'my data.txt'";
  EXPECT_NE(hash("a", with_data), plain) << "another command";
  EXPECT_EQ(hash("b", with_data), hash("a", with_data));
  EXPECT_NE(hash("data", with_data), hash("a", with_data)) << "a file with a blank in its name";
}

TEST_F(PluginUseTest, AnotherOneThanBeforeIsRefusedWithBothHashes) {
  CopyLibrary("echo", "echo.so");
  Write("mine.py", kProgram);
  const std::string before = OpenOne(R"("echo.so")").hash;
  const std::string library = R"([{"library": "echo.so", "hash": ")" + before + "\"}]";
  EXPECT_EQ(Open(library).at(0).hash, before);
  std::ofstream(folder() / "echo.so", std::ios::app) << "x";
  const std::string now = OpenOne(R"("echo.so")").hash;
  EXPECT_THAT(ProblemsOf(library), core::OneProblem("plugins[0]", now + " now, and had " + before));

  const std::string process = OpenOne(Process("mine.py")).hash;
  const std::string entry = Process("mine.py", R"(, "hash": ")" + process + "\"");
  EXPECT_EQ(OpenOne(entry).hash, process);
  Write("version", "2");
  EXPECT_THAT(ProblemsOf("[" + entry + "]"),
              core::OneProblem("plugins[0]",
                               OpenOne(Process("mine.py")).hash + " now, and had " + process));
}

// What a resolved scenario holds is found again from any folder.
TEST_F(PluginUseTest, IsReadAsItIsWritten) {
  CopyLibrary("echo", "echo.so");
  Write("mine.py", kProgram);
  const auto opened = Open(R"(["echo.so", )" + Process("mine.py") + "]");
  const JsonValue written = ToJson(opened);
  EXPECT_EQ(CompactJson(written), R"([{"library":")" + At("echo.so") + R"(","hash":")" +
                                      opened[0].hash + R"("},{"process":")" + opened[1].text +
                                      R"(","folder":")" + folder().string() + R"(","hash":")" +
                                      opened[1].hash + R"(","confined":)" +
                                      (opened[1].confined ? "true" : "false") + "}]");
  const auto again = OpenPlugins(written, "/");
  EXPECT_EQ(CompactJson(ToJson(again)), CompactJson(written));
  EXPECT_EQ(CompactJson(Anchored(written, "/elsewhere")), CompactJson(written));
}

TEST_F(PluginUseTest, IdentityIsWithoutPlaces) {
  EXPECT_EQ(CompactJson(IdentityOf(Json(
                R"([{"library": "/a.so", "hash": "1"},
                    {"process": "a", "folder": "/b", "hash": "2", "confined": true}])"))),
            R"([{"hash":"1"},{"hash":"2"}])");
  EXPECT_EQ(CompactJson(IdentityOf(Json("3"))), "3");
}

// A sweep reads one scenario for each of its cells.
TEST_F(PluginUseTest, WhatIsOpenIsNotAskedAgain) {
  CopyLibrary("echo", "echo.so");
  Write("mine.py", kProgram);
  const auto opened = Open(R"(["echo.so", )" + Process("mine.py") + "]");
  const auto again = OpenPlugins(ToJson(opened), "/", opened);
  ASSERT_EQ(again.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(again[i].navigators[0], opened[i].navigators[0]);
  // Only what is listed, in the order of the list.
  JsonValue list = ToJson(opened);
  list.list().erase(list.list().begin());
  const auto second = OpenPlugins(list, "/", opened);
  ASSERT_EQ(second.size(), 1U);
  EXPECT_EQ(second[0].navigators[0], opened[1].navigators[0]);
}

TEST_F(PluginUseTest, TheSameCommandInAnotherFolderIsAnotherProcess) {
  for (const char* place : {"a/", "b/"}) Write(std::string(place) + "mine.py", kProgram);
  Write("b/version", "2");
  const auto in = [&](const std::string& place) {
    return Process("mine.py", R"(, "folder": ")" + At(place) + "\"");
  };
  const auto opened = Open("[" + in("a") + "]");
  const auto other = OpenPlugins(Json("[" + in("b") + "]"), folder(), opened);
  EXPECT_EQ(other.at(0).navigators[0]->description().version, "2");
  EXPECT_NE(other.at(0).hash, opened[0].hash);
}

// Adds what plugins hold to a set of navigators; their estimators to none that is looked at.
void AddTo(const std::vector<PluginUse>& plugins, navigation::NavigatorSet& set) {
  localization::EstimatorSet estimators;
  perception::PointReaderSet readers;
  AddKinds(plugins, {set, estimators, readers});
}

// The same for stand-ins; `navigation` is the group of a scenario.
void AddStandInsTo(const JsonValue& navigation, navigation::NavigatorSet& set) {
  localization::EstimatorSet estimators;
  perception::PointReaderSet readers;
  AddStandIns(JsonValue::Object({{"navigation", navigation}}), {set, estimators, readers});
}

TEST_F(PluginUseTest, NavigatorsAreAddedOnce) {
  CopyLibrary("echo", "echo.so");
  const auto plugins = Open(R"(["echo.so"])");
  navigation::NavigatorSet set = navigation::StandardNavigators();
  const auto own = set.names().size();
  AddTo(plugins, set);
  ASSERT_EQ(set.names().size(), own + 2);
  EXPECT_EQ(set.names()[own], "echo");
  EXPECT_EQ(set.names()[own + 1], "every_type");
  EXPECT_EQ(set.chosen().name(), "pathfinder");
  EXPECT_TRUE(set.Named("echo").foreign());
  EXPECT_FALSE(set.Named("pathfinder").foreign());
  AddTo(plugins, set);
  navigation::NavigatorSet copy = set;
  AddTo(plugins, copy);
  EXPECT_EQ(set.names().size(), own + 2);
  EXPECT_EQ(copy.names().size(), own + 2);
}

TEST_F(PluginUseTest, TwoPluginsDoNotShareAName) {
  CopyLibrary("echo", "echo.so");
  CopyLibrary("echo", "another.so", "x");
  navigation::NavigatorSet set = navigation::StandardNavigators();
  EXPECT_THAT(core::ProblemsIn([&] { AddTo(Open(R"(["echo.so", "another.so"])"), set); }),
              core::OneProblem("navigation.echo", "is taken"));
}

// A copy of a kind has parameters of its own.
TEST_F(PluginUseTest, SetsHaveParametersOfTheirOwn) {
  CopyLibrary("echo", "echo.so");
  struct Group {
    navigation::NavigatorSet set;
    void Visit(core::FieldVisitor& v) { set.Visit(v); }
  };
  Group group;
  AddTo(Open(R"(["echo.so"])"), group.set);
  Group copy = group;
  core::ReadParams(Json(R"({"navigator": "every_type", "echo": {"goal_tolerance_m": 1.5}})"), copy);
  EXPECT_EQ(copy.set.Named("echo").traits().goal.tolerance_m, 1.5);
  EXPECT_EQ(group.set.Named("echo").traits().goal.tolerance_m, 0.25);
  EXPECT_EQ(copy.set.chosen().name(), "every_type");
  EXPECT_EQ(group.set.chosen().name(), "echo");
  EXPECT_EQ(copy.set.chosen().PathOf(copy.set.chosen().traits().goal.path),
            "navigation.every_type.real");
}

// The group "navigation" of a scenario.
struct Navigation {
  navigation::NavigatorSet set = navigation::StandardNavigators();
  void Visit(core::FieldVisitor& v) { set.Visit(v); }
};

// A stored scenario is read and written again by a program that has no plugin.
TEST_F(PluginUseTest, StandInsReadWhatWasWritten) {
  CopyLibrary("echo", "echo.so");
  Navigation before;
  AddTo(Open(R"(["echo.so"])"), before.set);
  core::ReadParams(Json(R"({"navigator": "echo", "echo": {"status": 3, "look": 1},
      "every_type": {"real": 0.1, "integer": -3, "reals": [1, 2.5], "integers": [4, 5],
                     "text": "höher", "choice": "third", "inner": {"low": -1e-300}}})"),
                   before);
  const JsonValue stored = core::WriteParams(before);
  Navigation sealed;
  AddStandInsTo(stored, sealed.set);
  EXPECT_THAT(std::vector(sealed.set.names().begin(), sealed.set.names().end()),
              testing::ElementsAreArray(before.set.names()));
  core::ReadParams(stored, sealed);
  EXPECT_EQ(sealed.set.chosen().name(), "echo");
  EXPECT_TRUE(sealed.set.chosen().foreign());
  EXPECT_EQ(core::DumpJson(core::WriteParams(sealed)), core::DumpJson(stored));
  EXPECT_THAT(core::RefusalOf([&] { sealed.set.chosen().Make({}); }), HasSubstr("not opened"));
}

TEST_F(PluginUseTest, AStandInIsMadeOfAChoiceAlone) {
  Navigation sealed;
  AddStandInsTo(Json(R"({"navigator": "bare", "limits": {"memory_mb": 100}})"), sealed.set);
  EXPECT_EQ(std::ranges::count(sealed.set.names(), "bare"), 1);
  EXPECT_EQ(std::ranges::count(sealed.set.names(), "limits"), 0) << "a key of the group";
  const std::size_t names = sealed.set.names().size();
  AddStandInsTo(Json(R"({"navigator": "bare", "pathfinder": {}})"), sealed.set);
  AddStandInsTo(Json("3"), sealed.set);
  EXPECT_EQ(sealed.set.names().size(), names);
}

// The groups "navigation", "localization" and "perception" of a scenario, as far as plugins add.
struct Sets {
  navigation::NavigatorSet navigators = navigation::StandardNavigators();
  localization::EstimatorSet estimators;
  perception::PointReaderSet readers;

  PluginSets sets() { return {navigators, estimators, readers}; }
  void Visit(core::FieldVisitor& v) {
    v.Group("navigation", navigators, "");
    v.Group("localization", estimators, "");
    v.Group("perception", readers, "");
  }
};

TEST_F(PluginUseTest, EstimatorsAreAddedBesideNavigators) {
  CopyLibrary("estimators", "estimators.so");
  const auto plugins = Open(R"(["estimators.so"])");
  ASSERT_EQ(plugins.at(0).navigators.size(), 1U);
  ASSERT_EQ(plugins.at(0).estimators.size(), 2U);
  Sets sets;
  AddKinds(plugins, sets.sets());
  EXPECT_EQ(sets.navigators.names().back(), "idle");
  EXPECT_EQ(sets.navigators.chosen().name(), "pathfinder");
  EXPECT_EQ(sets.estimators.names().size(), 2U);
  Sets copy = sets;
  AddKinds(plugins, copy.sets());
  EXPECT_EQ(copy.estimators.names().size(), 2U);
  core::ReadParams(Json(R"({"localization": {"estimator": "faulty", "told": {"use": 2}}})"), copy);
  EXPECT_EQ(copy.estimators.chosen().name(), "faulty");
  EXPECT_EQ(sets.estimators.chosen().name(), "told");
}

TEST_F(PluginUseTest, TwoEstimatorsDoNotShareAName) {
  CopyLibrary("estimators", "estimators.so");
  CopyLibrary("estimators", "another.so", "x");
  Sets sets;
  EXPECT_THAT(core::ProblemsIn([&] { AddKinds(Open(R"(["estimators.so"])"), sets.sets()); }),
              testing::IsEmpty());
  Sets others;
  others.estimators = sets.estimators;
  EXPECT_THAT(core::ProblemsIn([&] { AddKinds(Open(R"(["another.so"])"), others.sets()); }),
              core::OneProblem("localization.told", "is taken"));
}

// Columns of records are "<name>.<own value>", of navigators and estimators alike.
TEST_F(PluginUseTest, ANavigatorAndAnEstimatorDoNotShareAColumn) {
  CopyLibrary("estimators", "estimators.so");
  const auto problems = [&](const char* name, const char* value) {
    Sets sets;
    navigation::NavigatorDescription<core::NoParams> description;
    description.name = name;
    description.doc = "a namesake";
    description.own_values = {{value, "1", ""}};
    sets.navigators.Add(description);
    return core::ProblemsIn([&] { AddKinds(Open(R"(["estimators.so"])"), sets.sets()); });
  };
  EXPECT_THAT(problems("faulty", "first"),
              core::OneProblem("localization.faulty", "counts \"first\"", "another name"));
  EXPECT_THAT(problems("faulty", "second"), testing::IsEmpty());
  EXPECT_THAT(problems("another", "first"), testing::IsEmpty());
}

// A stored scenario is read and written again by a program that has no plugin.
TEST_F(PluginUseTest, EstimatorsHaveStandInsToo) {
  CopyLibrary("estimators", "estimators.so");
  Sets before;
  AddKinds(Open(R"(["estimators.so"])"), before.sets());
  core::ReadParams(Json(R"({"localization": {"estimator": "told", "told": {"low": 0.1, "use": 3},
                            "faulty": {"fault": "placing"}}})"),
                   before);
  const JsonValue stored = core::WriteParams(before);
  Sets sealed;
  AddStandIns(stored, sealed.sets());
  core::ReadParams(stored, sealed);
  EXPECT_EQ(sealed.estimators.chosen().name(), "told");
  EXPECT_TRUE(sealed.estimators.chosen().foreign());
  EXPECT_TRUE(sealed.estimators.chosen().takes_motions()) << "or its aids would be refused";
  EXPECT_EQ(core::DumpJson(core::WriteParams(sealed)), core::DumpJson(stored));
  EXPECT_THAT(core::RefusalOf([&] { sealed.estimators.chosen().Make({}); }),
              HasSubstr("not opened"));
}

TEST(PluginSchema, AllowsEveryFormOfAnEntryAndNoOtherKey) {
  const JsonValue schema = SchemaOfPlugins();
  const JsonValue* item = schema.Find("items");
  ASSERT_NE(item, nullptr);
  EXPECT_EQ(CompactJson(*item->Find("type")), R"(["string","object"])");
  EXPECT_FALSE(item->Find("additionalProperties")->boolean());
  std::vector<std::string> keys;
  for (const core::JsonMember& member : item->Find("properties")->members()) {
    keys.push_back(member.key);
  }
  EXPECT_THAT(keys,
              testing::UnorderedElementsAre("library", "process", "folder", "hash", "confined"));
}

}  // namespace
}  // namespace rockyard::plugin
