// Scenarios and sweeps by name, and folders of runs where a run is meant.
#include <sys/ioctl.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <sstream>

#include "app/command.h"
#include "report/line_text.h"

namespace rockyard::app {
namespace {

class CliNames : public CommandTest {
 protected:
  void SetUp() override { unsetenv("ROCKYARD_SCENARIOS"); }
  void TearDown() override { unsetenv("ROCKYARD_SCENARIOS"); }

  // A valid scenario of that name.
  void Place(const std::string& path) const {
    const fs::path file = work() / path;
    fs::create_directories(file.parent_path());
    WriteFile(file, "{\"name\": \"" + file.stem().string() + "\"}");
  }
};

TEST_F(CliNames, StandForFilesWhereAFileIsTaken) {
  Place("scenarios/a/one.json");
  WriteFile(work() / "scenarios/grid.json",
            R"({"name": "grid", "scenario": "a/one.json", "trials": 1, "seed": 1,
                "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001, 0.002]}]})");
  EXPECT_THAT(
      Run({"validate", "one", "a/one", "one.json", "scenarios/a/one", "grid"}).out,
      Says("scenarios/a/one.json: valid", "scenarios/grid.json: valid, a sweep of 2 cells"));
  EXPECT_THAT(Run({"rover", "one"}).out, HasSubstr("rover of one"));
  RunTo(0, {"terrain", "one", "--out", "field.svg"});
  RunTo(0, {"parameters", "one"});
  RunTo(0, {"sweep", "grid", "--dry-run", "--pilots", "0"});
  RunTo(0, {"trace", "one", "--trial", "0", "--set", "referee.time_limit_s=1"});
  RunTo(0, {"run", "one", "--trials", "1", "--set", "referee.time_limit_s=1"});
}

TEST_F(CliNames, OfTwoFilesNameBoth) {
  Place("scenarios/a/same.json");
  Place("scenarios/b/same.json");
  Place("scenarios/b/a/same.json");
  EXPECT_THAT(RunTo(2, {"validate", "same"}).err,
              Says("error: same: is the name of 3 files", "say which: a/same, b/a/same, b/same"));
  EXPECT_THAT(Run({"validate", "a/same"}).out, HasSubstr("scenarios/a/same.json: valid"))
      << "the path from the folder itself goes first";
}

// As of an installed package, away from the project.
TEST_F(CliNames, ReferencesLieBesideTheScenarios) {
  setenv("ROCKYARD_SCENARIOS", Source("scenarios").c_str(), 1);
  RunTo(0,
        {"run", "nominal", "--trials", "2", "--set", "rover.fidelity=quasi_static", "--out", "a"});
  const CommandResult check =
      Run({"check", "a", "--against", "results/reference/matthies1995.json"});
  EXPECT_THAT(check.out, HasSubstr("published")) << check.err;
  EXPECT_EQ(RunTo(0, {"report", "a", "--replays", "0", "--tracks", "0"}).err, "");
  setenv("ROCKYARD_SCENARIOS", "/nowhere", 1);
  EXPECT_THAT(RunTo(0, {"report", "a", "--replays", "0", "--tracks", "0"}).err,
              HasSubstr("results/reference holds no reference"));
  RunTo(2, {"check", "a", "--against", "results/reference/matthies1995.json"});
}

TEST_F(CliNames, AFileOfThatNameWins) {
  Place("scenarios/a/one.json");
  Place("one");
  EXPECT_THAT(Run({"validate", "one"}).out, HasSubstr("one: valid"));
  EXPECT_THAT(Run({"validate", "one"}).out, Not(HasSubstr("scenarios")));
}

// A run under the name of a scenario does not change in silence what the name means.
TEST_F(CliNames, TheFolderOfARunIsToldOf) {
  Place("scenarios/a/one.json");
  const Words words{"run", "one", "--trials", "1", "--threads", "1"};
  const CommandResult first =
      RunTo(0, With(words, {"--set", "referee.time_limit_s=1", "--out", "one"}));
  EXPECT_THAT(first.out + first.err, Not(HasSubstr("the folder of a run")));
  const CommandResult second = RunTo(0, With(words, {"--out", "two"}));
  EXPECT_THAT(second.out + second.err,
              HasSubstr("one is the folder of a run, whose settings are taken"));
}

TEST_F(CliNames, KindsThatAreNotWantedDoNotCount) {
  Place("scenarios/a/both.json");
  WriteFile(work() / "scenarios/both.json",
            R"({"name": "both", "scenario": "a/both.json", "trials": 1, "seed": 1,
                "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001]}]})");
  EXPECT_THAT(Run({"rover", "a/both"}).out, HasSubstr("rover of both"));
  RunTo(0, {"terrain", "a/both", "--out", "field.svg"});
  RunTo(0, {"sweep", "both", "--dry-run", "--pilots", "0"});
  RunTo(2, {"sweep", "a/both", "--dry-run", "--pilots", "0"});
}

TEST_F(CliNames, MistypedOnesGetASuggestion) {
  Place("scenarios/a/first_try.json");
  for (const char* word : {"frist_try", "first_tri", "a/first_trx.json"}) {
    EXPECT_THAT(RunTo(2, {"run", word}).err, HasSubstr("did you mean \"first_try\"?")) << word;
  }
  EXPECT_THAT(Run({"run", "scenarios/a/frist_try.json"}).err,
              HasSubstr("did you mean \"scenarios/a/first_try.json\"?"));
  EXPECT_THAT(Run({"run", "something_else_altogether"}).err, Not(HasSubstr("did you mean")));
  EXPECT_FALSE(fs::exists(work() / "results"));
}

TEST_F(CliNames, FoldersAreTakenInOrder) {
  EXPECT_THAT(Run({"validate", "nominal"}).out,
              HasSubstr("/scenarios/pathfinder/nominal.json: valid"))
      << "those of the source tree, from any folder";
  EXPECT_THAT(Run({"list"}).out, HasSubstr("/scenarios/pathfinder\n"));
  Place("scenarios/one.json");
  EXPECT_THAT(Run({"validate", "one"}).out, HasSubstr("scenarios/one.json: valid"));
  RunTo(2, {"validate", "nominal"});
  Place("mine/two.json");
  setenv("ROCKYARD_SCENARIOS", "mine", 1);
  EXPECT_THAT(Run({"list"}).out, HasSubstr("two.json"));
  EXPECT_THAT(Run({"validate", "two"}).out, HasSubstr("mine/two.json: valid"));
  RunTo(2, {"validate", "one"});
}

TEST_F(CliNames, InstalledProgramsFindTheShareFolder) {
  fs::create_directories(work() / "bin");
  fs::create_directories(work() / "elsewhere");
  fs::copy_file(ROCKYARD_COMMAND, work() / "bin/rockyard");
  Place("share/rockyard/scenarios/one.json");
  const CommandResult result =
      Wait(StartProgram({(work() / "bin/rockyard").string(), "validate", "one"}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("/share/rockyard/scenarios/one.json: valid"));
}

TEST_F(CliNames, AFolderOfRunsListsThem) {
  RunTo(0, QuickRun("runs/a", 2));
  RunTo(0, With(QuickRun("runs/b", 3), {"--set", "name=other"}));
  fs::last_write_time(work() / "runs/a/results.sqlite",
                      fs::file_time_type::clock::now() - std::chrono::hours(1000));
  for (const Words& words : {Words{"report", "runs"},
                             {"trace", "runs", "--trial", "0"},
                             {"replay", "runs", "--trial", "0"},
                             {"compare", "runs/a", "runs"},
                             {"run", "runs"}}) {
    const CommandResult result = Run(words);
    EXPECT_EQ(result.exit_code, 2) << words[0];
    EXPECT_THAT(result.err, testing::ContainsRegex("runs/b .other, 3 trials, 20..-..-...; runs/a "
                                                   ".nominal, 2 trials, 20..-..-...\n"))
        << words[0];
  }
  for (int i = 0; i < 10; ++i) fs::copy(work() / "runs/a", work() / ("runs/c" + std::to_string(i)));
  EXPECT_THAT(Run({"report", "runs"}).err, HasSubstr("; and 2 more\n"));
}

// Names and folders that a terminal would obey, or that mean something else where they are pasted.

// Clears the screen, sets its title, turns the line around, begins another line that looks true.
constexpr const char* kHostile = "a\x1b[2J\x1b]0;t\x07\u202eb\u009b31m\r\nerror: false";

std::string InJson(const std::string& text) { return json(text).dump(); }

// Whether a terminal would show it as it is.
bool IsPlain(const std::string& text) { return report::PrintableLines(text) == text; }

class HostileNames : public CommandTest {
 protected:
  HostileNames() {
    WriteFile(work() / file_, R"({"extends": )" + InJson(Scenario("nominal")) + R"(, "name": )" +
                                  InJson(kHostile) + R"(, "referee": {"time_limit_s": 1}})");
    WriteFile(
        work() / "sweep.json",
        R"({"name": "two\u202e\u009b", "scenario": )" + InJson(file_) +
            R"(, "trials": 2, "seed": 1, "axes": [{"name": "on", "levels": [)"
            R"({"name": "off\u202e", "set": {}}, {"name": "one", "set": {"referee.time_limit_s": 2}}]}]})");
  }

  std::string folder(const std::string& name) const { return kHostile + name; }

  std::string file_ = std::string(kHostile) + ".json";
};

TEST_F(HostileNames, ReachNoTerminal) {
  const std::vector<Words> commands = {
      {"validate", file_},
      {"validate", file_, "--set", std::string(kHostile) + "=1"},
      {"validate", std::string(kHostile) + "none.json"},
      {"rover", file_},
      {"list", "."},
      {"list", ".", "--json"},
      {"parameters", file_},
      {"run", file_, "--trials", "2", "--dry-run"},
      {"run", file_, "--trials", "2", "--out", folder("run"), "--traces", "all"},
      {"run", file_, "--trials", "2", "--out", folder("run")},
      {"run", file_, "--trials", "2", "--out", folder("json"), "--json"},
      {"run", file_, "--trials", "2", "--out", folder("shard"), "--shard", "1/2"},
      {"merge", folder("shard"), "--out", folder("whole")},
      {"sweep", "sweep.json", "--out", folder("plan"), "--dry-run", "--pilots", "1"},
      {"sweep", "sweep.json", "--out", folder("sweep")},
      {"compare", folder("run"), folder("json")},
      {"compare", folder("run"), folder("json"), "--json"},
      {"baseline", folder("run"), "--reason", "a", "--out", folder("baseline.json")},
      {"check", folder("run"), "--against", folder("baseline.json")},
      {"check", folder("run"), "--against", folder("baseline.json"), "--json"},
      {"trace", folder("run"), "--trial", "0", "--csv", folder("trace.csv")},
      {"replay", folder("run"), "--trial", "0", "--list"},
      {"replay", folder("run"), "--trial", "0", "--out", folder("page.html")},
      {"replay", folder("run"), "--cell", kHostile, "--trial", "0"},
      {kHostile},
      {"run", kHostile, std::string("--") + kHostile}};
  for (const Words& words : commands) {
    const CommandResult told = Run(words);
    EXPECT_TRUE(IsPlain(told.out)) << words.at(0) << ": " << report::PrintableLines(told.out);
    EXPECT_TRUE(IsPlain(told.err)) << words.at(0) << ": " << report::PrintableLines(told.err);
    EXPECT_EQ((told.out + told.err).find("\nerror: false"), std::string::npos) << words.at(0);
  }
  EXPECT_TRUE(fs::exists(work() / folder("sweep") / "cells.csv"));
}

TEST_F(HostileNames, OfJsonAreTheSameAfterwards) {
  const CommandResult told = Run({"run", file_, "--trials", "1", "--out", "run", "--json"});
  EXPECT_EQ(json::parse(told.out).at("scenario"), kHostile);
}

// The command of the last line, pasted into a shell.
TEST_F(HostileNames, AreFoundAgainByThePrintedCommand) {
  for (const std::string out : {"-x", "it's \u202e\\", "a b", "--help"}) {
    const CommandResult told =
        RunTo(0, {"run", Scenario("nominal"), "--set", "referee.time_limit_s=1", "--trials", "1",
                  "--out=" + out});
    const std::string mark = "  next: rockyard ";
    const std::size_t at = told.out.rfind(mark);
    ASSERT_NE(at, std::string::npos) << told.out;
    std::string command = told.out.substr(at + mark.size());
    command.erase(command.find('\n'));
    const CommandResult next =
        Wait(StartProgram({"/bin/bash", "-c", std::string(ROCKYARD_COMMAND) + " " + command}));
    EXPECT_EQ(next.exit_code, 0) << command << "\n" << next.err;
  }
}

// rockyard list

class CliList : public CommandTest {
 protected:
  // What a terminal of 60 columns is told; little, since nobody reads it meanwhile.
  std::string OnTerminal(const Words& words) const {
    setenv("NO_COLOR", "1", 1);
    const int screen = posix_openpt(O_RDWR | O_NOCTTY);
    grantpt(screen);
    unlockpt(screen);
    const int line = open(ptsname(screen), O_RDWR | O_NOCTTY);
    const winsize size{.ws_row = 24, .ws_col = 60, .ws_xpixel = 0, .ws_ypixel = 0};
    ioctl(line, TIOCSWINSZ, &size);
    EXPECT_EQ(RunInto(line, words).exit_code, 0);
    std::string text(4096, '\0');
    const ssize_t count = read(screen, text.data(), text.size());
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    close(line);
    close(screen);
    unsetenv("NO_COLOR");
    EXPECT_NO_THROW(json(text).dump()) << "no code point was cut";
    return text;
  }

  static std::string Scenarios() { return Source("scenarios"); }
};

TEST_F(CliList, PartsAreLeftOutUnlessAskedFor) {
  const CommandResult some = RunTo(0, {"list", Scenarios()});
  EXPECT_THAT(some.out, HasSubstr("/pathfinder\n"));
  EXPECT_THAT(some.out, testing::ContainsRegex("  nominal.json +Rocky 3.2 over"));
  EXPECT_THAT(some.out, Not(HasSubstr("mfex.json ")));
  EXPECT_THAT(some.out, HasSubstr("are left out: --all"));
  const CommandResult all = Run({"list", Scenarios(), "--all"});
  EXPECT_THAT(all.out, testing::ContainsRegex("  mfex.json +part of a scenario"));
  EXPECT_THAT(all.out, Not(HasSubstr("left out")));
  EXPECT_THAT(all.out, Not(HasSubstr("not valid")));
}

TEST_F(CliList, GroupsAndFilesAreInOrder) {
  fs::create_directories(work() / "s" / "b");
  fs::create_directories(work() / "s" / "a");
  const std::string nominal = Run({"defaults"}).out;
  for (const char* name : {"b/1", "a/2", "a/1", "z"}) {
    WriteFile(work() / "s" / (std::string(name) + ".json"), nominal);
  }
  const std::string text = Run({"list", "s"}).out;
  Words firsts;
  std::istringstream lines(text);
  for (std::string line, first; std::getline(lines, line);) {
    std::istringstream(line) >> first;
    firsts.push_back(first);
  }
  EXPECT_THAT(firsts,
              testing::ElementsAre("s/", "z.json", "s/a", "1.json", "2.json", "s/b", "1.json"));
}

// Names come from files of others: they may hold anything.
TEST_F(CliList, OddTextStaysInItsLine) {
  fs::create_directories(work() / "s");
  json scenario = json::parse(Run({"defaults"}).out);
  scenario["name"] = "odd";
  std::string wide;
  for (int i = 0; i < 200; ++i) wide += "\u00e9";
  scenario["description"] = "\x1b[31mred\nsecond line " + wide;
  WriteFile(work() / "s" / "odd.json", scenario.dump());
  WriteFile(work() / "s" / "broken.json", "{");
  const CommandResult result = RunTo(0, {"list", "s"});
  EXPECT_THAT(result.out, HasSubstr(wide + "\n")) << "whole where it is piped";
  EXPECT_THAT(result.out, Not(HasSubstr("\x1b")));
  EXPECT_THAT(result.out, Says("?[31mred second line", "not valid"));
  bool cut = false;
  std::istringstream lines(OnTerminal({"list", "s"}));
  for (std::string line; std::getline(lines, line);) {
    line.erase(line.find_last_not_of('\r') + 1);
    const auto columns =
        std::count_if(line.begin(), line.end(), [](char c) { return (c & 0xc0) != 0x80; });
    EXPECT_LE(columns, 60) << line;
    cut = cut || columns == 60;
  }
  EXPECT_TRUE(cut);
}

TEST_F(CliList, Json) {
  const json list = json::parse(Run({"list", Scenarios(), "--json", "--all"}).out);
  EXPECT_EQ(list["schema_version"], 1);
  std::map<std::string, json> files;
  for (const json& file : list["files"]) files[file["file"]] = file;
  EXPECT_EQ(files.at("pathfinder/nominal.json")["kind"], "scenario");
  EXPECT_EQ(files.at("pathfinder/nominal.json")["name"], "nominal");
  EXPECT_EQ(files.at("sweeps/abundance.json")["kind"], "sweep");
  EXPECT_GT(files.at("sweeps/abundance.json")["cells"], 1);
  EXPECT_EQ(files.at("rovers/mfex.json")["kind"], "part");
  const json ablations = json::parse(Run({"list", "--ablations", "--json"}).out);
  EXPECT_FALSE(ablations["ablations"].empty());
  EXPECT_FALSE(ablations["ablations"][0]["settings"].empty());
}

}  // namespace
}  // namespace rockyard::app
