// Folders that `rockyard new` writes: what is in them, that it builds and drives, and what is
// refused.
#include <sys/resource.h>

#include <algorithm>
#include <sstream>

#include "app/command.h"
#include "app/new_files.h"
#include "core/error.h"

namespace rockyard::app {
namespace {

class CliNew : public CommandTest {
 protected:
  static Words Navigator(const std::string& name, const Words& more = {}) {
    return With({"new", "navigator", name}, more);
  }

  Words FilesIn(const std::string& folder) const {
    Words names;
    for (const fs::directory_entry& entry : fs::directory_iterator(work() / folder)) {
      names.push_back(entry.path().filename());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  json ScenarioIn(const std::string& folder, const std::string& name) const {
    return json::parse(ReadFile(work() / folder / (name + ".json")));
  }

  // The scenario of the folder drives a trial, whose record has the column.
  void ExpectDrives(const std::string& folder, const std::string& name, const std::string& column) {
    RunTo(0, {"run", folder + "/" + name + ".json", "--trials", "1", "--threads", "1", "--set",
              "referee.time_limit_s=1", "--out", "run"});
    const std::string table = ReadFile(work() / "run/trials.csv");
    EXPECT_THAT(table.substr(0, table.find('\n')), HasSubstr(column));
    EXPECT_THAT(table, Not(testing::ContainsRegex("navigator_fault|simulator_fault")));
  }

  void ExpectRefused(const Words& words, const std::string& reason, const std::string& advice) {
    SCOPED_TRACE(testing::PrintToString(words));
    const CommandResult result = RunTo(2, words);
    EXPECT_THAT(result.err, Says("error: ", reason, "  try: ", advice));
    EXPECT_EQ(result.out, "");
    EXPECT_TRUE(NothingWritten());
  }
};

TEST_F(CliNew, PluginHasItsNameEverywhere) {
  RunTo(0, Navigator("wall_follower_2"));
  EXPECT_EQ(FilesIn("wall_follower_2"),
            (Words{"CMakeLists.txt", "README.md", "wall_follower_2.cc", "wall_follower_2.json"}));
  for (const std::string& file : FilesIn("wall_follower_2")) {
    const std::string text = ReadFile(work() / "wall_follower_2" / file);
    EXPECT_THAT(text, HasSubstr("wall_follower_2"));
    EXPECT_THAT(text, Not(testing::ContainsRegex("my_navigator|MyNavigator"))) << file;
  }
  EXPECT_THAT(ReadFile(work() / "wall_follower_2/wall_follower_2.cc"),
              Says("class WallFollower2 final", "ROCKYARD_NAVIGATORS(DescribeWallFollower2)"));
  const json scenario = ScenarioIn("wall_follower_2", "wall_follower_2");
  EXPECT_EQ(scenario["plugins"], json::parse(R"([{"library": "build/libwall_follower_2.so"}])"));
  EXPECT_EQ(scenario["navigation"]["navigator"], "wall_follower_2");
}

TEST_F(CliNew, ProcessHasTheClientBesideIt) {
  RunTo(0, Navigator("mine", {"--python", "--out", "deep/er/folder/"}));
  EXPECT_EQ(FilesIn("deep/er/folder"),
            (Words{"README.md", "mine.json", "mine.py", "rockyard_navigator.py"}));
  EXPECT_EQ(ReadFile(work() / "deep/er/folder/rockyard_navigator.py"),
            ReadFile(Source("examples/navigators/rockyard_navigator.py")));
  EXPECT_THAT(ReadFile(work() / "deep/er/folder/mine.py"), HasSubstr("class Mine(Navigator):"));
  EXPECT_EQ(ScenarioIn("deep/er/folder", "mine")["plugins"],
            json::parse(R"([{"process": "python3 mine.py"}])"));
}

// As the folder's own CMakeLists.txt has it, which tests/cmake_consumer builds; without
// optimization, which takes half of the time.
TEST_F(CliNew, PluginBuildsAndDrives) {
  RunTo(0, Navigator("mine", {"--c++"}));
  fs::create_directory(work() / "mine/build");
  WaitTo(0, StartProgram({ROCKYARD_CXX, "-std=c++20", "-O0", "-Wall", "-Wextra", "-Wconversion",
                          "-Wshadow", "-Werror", "-Wno-sign-conversion", "-shared", "-fPIC",
                          "-ffp-contract=off", "-isystem", Source("src"), "-isystem", EIGEN_FOLDER,
                          "mine/mine.cc", "-o", "mine/build/libmine.so"}));
  ExpectDrives("mine", "mine", "mine.avoided");
}

TEST_F(CliNew, ProcessDrives) {
  RunTo(0, Navigator("mine", {"--python"}));
  ExpectDrives("mine", "mine", "mine.avoided");
}

// Where it lies in the working folder by its path from the new one, so that both move together.
TEST_F(CliNew, ScenarioExtendsNominalWhereverItLies) {
  RunTo(0, Navigator("near"));
  EXPECT_EQ(ScenarioIn("near", "near")["extends"], Scenario("nominal"));
  fs::create_directories(work() / "scenarios/pathfinder");
  WriteFile(work() / "scenarios/pathfinder/nominal.json", R"({"name": "own"})");
  RunTo(0, Navigator("near", {"--out", "deep/near"}));
  EXPECT_EQ(ScenarioIn("deep/near", "near")["extends"], "../../scenarios/pathfinder/nominal.json");
  fs::remove(work() / "scenarios/pathfinder/nominal.json");
  EXPECT_THAT(RunTo(2, Navigator("far")).err,
              Says("pathfinder/nominal.json: is not in scenarios", "try: set ROCKYARD_SCENARIOS"));
  EXPECT_FALSE(fs::exists(work() / "far"));
}

TEST_F(CliNew, SaysWhatToTypeNextAsTheReadmeDoes) {
  const CommandResult result = RunTo(0, Navigator("mine", {"--out", "it's mine"}));
  EXPECT_THAT(result.out, HasSubstr("  next: cd 'it'\\''s mine'\n"));
  const std::string readme = ReadFile(work() / "it's mine/README.md");
  std::istringstream lines(result.out.substr(result.out.find("next: ")));
  std::string line;
  std::getline(lines, line);
  int commands = 0;
  for (; std::getline(lines, line); ++commands) {
    EXPECT_THAT(readme, HasSubstr("\n" + line.substr(line.find_first_not_of(' ')) + "\n"));
  }
  EXPECT_EQ(commands, 8);  // the three of the benchmark, too
}

TEST_F(CliNew, NamesThatNoNavigatorCanHave) {
  const std::vector<std::array<std::string, 3>> refused = {
      {"My-Nav", "\"My-Nav\" is no name of a navigator", "such as my_nav\n"},
      {"2fast", "is no name of a navigator", "such as fast\n"},
      {"_x", "is no name of a navigator", "such as x\n"},
      {"work/mine/", "is no name of a navigator", "such as mine\n"},
      {"WallFollower2", "is no name of a navigator", "such as wall_follower2\n"},
      {"\u00e9\x1b[2J", "\"\u00e9?[2J\" is no name", "such as j\n"},
      {"---", "is no name of a navigator", "such as mine\n"},
      {std::string(41, 'a'), "is too long", "such as aaaaa"},
      {"Gestalt", "is no name of a navigator", "such as my_gestalt\n"},
      {"pathfinder", "is a navigator of rockyard", "use another name, such as my_pathfinder\n"},
      {"gestalt", "is a navigator of rockyard", "such as my_gestalt\n"},
      {"route", "is a navigator of rockyard", "such as my_route\n"},
      {"navigator", "is a setting of the group navigation", "such as my_navigator\n"},
      {"wheel_driver", "is a setting of the group navigation", "such as my_wheel_driver\n"},
      {"extends", "is a key of every group", "such as my_extends\n"}};
  for (const auto& [name, reason, advice] : refused) {
    for (const char* form : {"--c++", "--python"}) {
      ExpectRefused({"new", "navigator", form, "--", name}, reason, advice);
    }
  }
  ExpectRefused(Navigator("all"), "CMake", "such as my_all");
  ExpectRefused(Navigator("random", {"--python"}), "Python", "such as my_random");
  ExpectRefused(Navigator("rockyard_navigator", {"--python"}), "client", "such as my_");
  ExpectRefused(Navigator("mine", {"--python", "--c++"}), "--c++", "rockyard new navigator --help");
  ExpectRefused({"new", "navigator"}, "NAME", "rockyard new navigator --help");
  ExpectRefused({"new"}, "subcommand", "rockyard new --help");
}

TEST_F(CliNew, NamesThatLookBadAndAreNot) {
  for (const std::string& name : Words{"a", "x_", "a__b", "nav2", std::string(40, 'a')}) {
    RunTo(0, Navigator(name));
  }
  RunTo(0, Navigator("random"));
  RunTo(0, Navigator("all", {"--python"}));
}

TEST_F(CliNew, ModulesOfPythonAreAllKnown) {
  const CommandResult modules =
      Wait(StartProgram({ROCKYARD_PYTHON, "-c",
                         "import sys\nprint(*getattr(sys, 'stdlib_module_names', ['json']))"}));
  std::istringstream names(modules.out);
  int count = 0;
  for (std::string name; names >> name; ++count) {
    EXPECT_THROW(CheckNavigatorName(name, NavigatorForm::kProcess), core::UserError) << name;
  }
  EXPECT_GT(count, 0);
  EXPECT_NO_THROW(CheckNavigatorName("my_random", NavigatorForm::kProcess)) << "the test can fail";
}

TEST_F(CliNew, NothingIsWrittenOver) {
  fs::create_directory(work() / "empty");
  fs::create_symlink("nowhere", work() / "link");
  WriteFile(work() / "file", "mine");
  RunTo(0, Navigator("mine"));
  const std::string before = ReadFile(work() / "mine/mine.cc");
  for (const Words& words :
       {Navigator("mine"), Navigator("mine", {"--python"}), Navigator("a", {"--out", "empty"}),
        Navigator("a", {"--out", "empty/"}), Navigator("a", {"--out", "link"}),
        Navigator("a", {"--out", "file"}), Navigator("a", {"--out", "."}), Navigator("file")}) {
    EXPECT_THAT(RunTo(2, words).err, Says("exists", "try: name a new folder with --out"))
        << testing::PrintToString(words);
  }
  EXPECT_EQ(ReadFile(work() / "mine/mine.cc"), before);
  EXPECT_EQ(FilesIn("mine").size(), 4U);
  EXPECT_TRUE(fs::is_empty(work() / "empty"));
  EXPECT_TRUE(fs::is_symlink(work() / "link"));
  EXPECT_EQ(ReadFile(work() / "file"), "mine");
}

TEST_F(CliNew, FoldersThatCannotBeMade) {
  for (const std::string out : {"/proc/mine", "/proc/mine/mine", "/dev/null/mine"}) {
    ExpectRefused(Navigator("mine", {"--out", out}), "/", "");
  }
  ExpectRefused(Navigator("mine", {"--out", std::string(250, 'n')}), "too long a name", "shorter");
  WriteFile(work() / "file", "mine");
  RunTo(2, Navigator("mine", {"--out", "file/mine"}));
  EXPECT_EQ(ReadFile(work() / "file"), "mine");
}

// A limit on the size of files stands in for a full disk: of some files, and of all of them.
TEST_F(CliNew, FullDiskLeavesNothing) {
  rlimit former{};
  getrlimit(RLIMIT_FSIZE, &former);
  for (const rlim_t bytes : {600, 3000}) {
    const rlimit small{bytes, former.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    const pid_t process = Start(Navigator("mine", {"--out", "deep/er/mine"}));
    setrlimit(RLIMIT_FSIZE, &former);
    EXPECT_THAT(WaitTo(5, process).err, Says("cannot be written", "try: check the free space"));
    EXPECT_TRUE(NothingWritten());
  }
}

}  // namespace
}  // namespace rockyard::app
