// Runs and sweeps to report, and what came of it.
#pragma once

#include "app/command.h"

namespace rockyard::app {

class CliReportTest : public CommandTest {
 protected:
  // Long enough that something happens, and fast.
  CommandResult Drive(const std::string& out, int trials, const Words& more = {}) const {
    return Run(With(
        QuickRun(out, trials),
        With({"--set", "rover.fidelity=quasi_static", "--set", "referee.time_limit_s=300"}, more)));
  }
  CommandResult Sweep(const std::string& out) const {
    WriteFile(work() / "two.json", R"({
      "name": "two", "trials": 4, "common_random_numbers": true,
      "set": {"rover.fidelity": "quasi_static", "referee.time_limit_s": 100},
      "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001, 0.004]}]})");
    return Run({"sweep", "two.json", "--out", out});
  }
  CommandResult Report(const Words& words, int replays = 0) const {
    return Run(
        With({"report", "--replays", std::to_string(replays), "--data", "data.json"}, words));
  }
  json Data() const { return json::parse(ReadFile(work() / "data.json")); }
  json Summary(const std::string& run) const {
    return json::parse(ReadFile(work() / run / "summary.json"));
  }
  void ExpectRefused(const CommandResult& result, const std::string& why) const {
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_THAT(result.err, HasSubstr(why));
    EXPECT_EQ(result.out, "");
    EXPECT_FALSE(fs::exists(work() / "data.json"));
  }
  static std::string Reference(const char* name) {
    return Source("results/reference/") + name + ".json";
  }
};

}  // namespace rockyard::app
