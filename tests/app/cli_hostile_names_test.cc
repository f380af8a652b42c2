// Names and folders that a terminal would obey, or that mean something else where they are pasted.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/command.h"
#include "report/line_text.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

// Clears the screen, sets its title, turns the line around, begins another line that looks true.
constexpr const char* kHostile = "a\x1b[2J\x1b]0;t\x07\u202eb\u009b31m\r\nerror: false";

std::string InJson(const std::string& text) { return nlohmann::json(text).dump(); }

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
  EXPECT_EQ(nlohmann::json::parse(told.out).at("scenario"), kHostile);
}

// The command of the last line, pasted into a shell.
TEST_F(HostileNames, AreFoundAgainByThePrintedCommand) {
  for (const std::string out : {"-x", "it's \u202e\\", "a b", "--help"}) {
    const CommandResult told = Run({"run", Scenario("nominal"), "--set", "referee.time_limit_s=1",
                                    "--trials", "1", "--out=" + out});
    ASSERT_EQ(told.exit_code, 0) << told.err;
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

}  // namespace
}  // namespace rockyard::app
