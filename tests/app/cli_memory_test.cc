// Campaigns under a limit of memory. Not with sanitizers, which need all addresses for themselves.
#include <gmock/gmock.h>

#include <algorithm>

#include "app/watched_run.h"

namespace rockyard::app {
namespace {

using testing::HasSubstr;

class CliMemory : public WatchedRunTest {
 protected:
  CliMemory() : WatchedRunTest(1) {}

  // Images of 0.1 MB and what is made of them.
  static std::vector<std::string> Look(const std::vector<std::string>& more) {
    return With({ROCKYARD_COMMAND, "run",
                 std::string(ROCKYARD_SOURCE_DIR) + "/scenarios/visual_odometry/steps_hazcam.json",
                 "--trials", "1", "--threads", "1", "--quiet"},
                more);
  }

  CommandResult RunWithin(int limit_MiB, const std::vector<std::string>& words) const {
    std::string line = "ulimit -v " + std::to_string(1024 * limit_MiB) + "; exec";
    for (const std::string& word : words) line += " '" + word + "'";
    return Wait(StartProgram({"/bin/sh", "-c", line}));
  }
};

// From too little to begin to enough, by a supervisor and without: what a trial lacked is no result
// of it, and the campaign goes on to the hash of one that lacked nothing.
TEST_F(CliMemory, WhatATrialLacksIsNoFault) {
  ASSERT_EQ(Wait(StartProgram(Look({"--out", "plain"}))).exit_code, 0);
  for (const std::string how : {"--max-faults=1", "--no-supervisor"}) {
    int pending = 0;
    CommandResult result;
    for (const int limit_MiB : {60, 80, 110, 1000}) {
      result = RunWithin(limit_MiB, Look({"--out", "a", "--resume", how}));
      ASSERT_THAT(result.exit_code, testing::AnyOf(0, 5, 127)) << limit_MiB << result.err;
      if (result.err.find("is pending") != std::string::npos) ++pending;
      if (Stored("a") == 0) continue;
      const auto records = batch::ResultStore::Read(work() / "a").Load();
      EXPECT_TRUE(std::none_of(records.begin(), records.end(), truth::IsFault)) << limit_MiB;
    }
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_GT(pending, 0) << "some limit is met in a trial";
    EXPECT_EQ(Hash("a"), Hash("plain"));
    std::filesystem::remove_all(work() / "a");
  }
}

}  // namespace
}  // namespace rockyard::app
