// rockyard bench: an entry from its manifest to a table, and exit codes.

#include <cmath>

#include "app/command.h"

namespace rockyard::app {
namespace {

class CliBench : public CommandTest {
 protected:
  CliBench() {
    WriteFile(work() / "suite.json", R"({
      "name": "small", "trials": 2, "seed": 4, "common_random_numbers": true,
      "set": {"course.goal_x_m": 2},
      "design": {"kind": "list"},
      "cells": [{"name": "a/few", "scenario": ")" +
                                         Source("scenarios/bench/points_athena_sdm.json") +
                                         R"("}]})");
    for (const char* name : {"first", "second"}) {
      WriteFile(work() / (std::string(name) + ".json"),
                std::string(R"({"navigator": "gestalt", "name": ")") + name + "\"}");
    }
  }

  CommandResult Drive(const std::string& name, const Words& more = {}) const {
    return RunTo(0, With({"bench", "run", name + ".json", "--suite", "suite.json", "--threads", "1",
                          "--out", name},
                         more));
  }
};

TEST_F(CliBench, FromEntriesToATable) {
  EXPECT_THAT(Drive("first").out, AllOf(Says("head: ", "next: rockyard bench verify first"),
                                        Not(HasSubstr("next: rockyard report"))));
  EXPECT_EQ(Drive("second", {"--quiet"}).out, "");
  RunTo(2, {"bench", "run", "first.json", "--suite", "suite.json", "--out", "first"});
  EXPECT_THAT(RunTo(0, {"bench", "report", "first", "second", "--out", "table"}).out,
              Says("small: 2 layouts", "| first |", "| second |",
                   "standings in table/standings.csv", "page in table/index.html"));
  EXPECT_THAT(ReadFile(work() / "table/index.html"),
              HasSubstr("<title>Benchmark small: 2 entries"));
  EXPECT_THAT(ReadFile(work() / "table/ends.csv"), HasSubstr("first,goal_reached_within_5_m,"));
  const json rows = json::parse(RunTo(0, {"bench", "report", "first", "second", "--json"}).out);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0]["score"], rows[1]["score"]);
  EXPECT_EQ(rows[1]["difference"], 0);
  EXPECT_EQ(rows[0]["regret_drives"], 2);
  EXPECT_LT(std::abs(rows[0]["regret"].get<double>()), 0.05) << "two metres straight ahead";
}

TEST_F(CliBench, VerifyTellsByItsExitCode) {
  Drive("first");
  const Words verify{"bench", "verify", "first", "--suite", "suite.json", "--threads", "1"};
  EXPECT_THAT(RunTo(0, verify).out, Says("first: 2 drives, 2 driven again", "nothing is wrong"));
  for (const auto& file : fs::recursive_directory_iterator(work() / "first/actions")) {
    if (file.is_regular_file()) WriteFile(file.path(), ReadFile(file.path()) + "x");
  }
  EXPECT_THAT(RunTo(1, verify).out,
              AllOf(HasSubstr("trial 0 of a/few"), Not(HasSubstr("nothing is wrong"))));
  const json said = json::parse(RunTo(1, With(verify, {"--json", "--seed", "3"})).out);
  EXPECT_EQ(said["findings"].size(), 3U) << said;
  EXPECT_EQ(said["seed"], "3");
  RunTo(2, {"bench", "verify", "table"});
}

}  // namespace
}  // namespace rockyard::app
