// Campaigns under a limit of memory. Not with sanitizers, which need all addresses for themselves.
#include "app/memory_runs.h"

namespace rockyard::app {
namespace {

class CliMemory : public MemoryRuns {
 protected:
  CommandResult RunWithin(int limit_MiB, const Words& words) const {
    std::string line = "ulimit -v " + std::to_string(1024 * limit_MiB) + "; exec";
    for (const std::string& word : words) line += " '" + word + "'";
    return Wait(StartProgram({"/bin/sh", "-c", line}));
  }
};

// From too little to begin to enough, by a supervisor and without: what a trial lacked is no result
// of it, and the campaign goes on to the hash of one that lacked nothing.
TEST_F(CliMemory, WhatATrialLacksIsNoFault) {
  // Images of some 50 kB and what is made of them.
  const Words look =
      Trials("visual_odometry/steps_hazcam", 1, {"sensors.stereo.images.pyramid_level=1"});
  ASSERT_EQ(Wait(StartProgram(With(look, {"--out", "plain"}))).exit_code, 0);
  for (const std::string how : {"--max-faults=1", "--no-supervisor"}) {
    int pending = 0;
    CommandResult result;
    for (const int limit_MiB : {30, 50, 70, 1000}) {
      SCOPED_TRACE(how + " within MiB " + std::to_string(limit_MiB));
      result = RunWithin(limit_MiB, With(look, {"--out", "a", "--resume", how}));
      ASSERT_THAT(result.exit_code, testing::AnyOf(0, 5, 127)) << result.err;
      if (result.err.find("is pending") != std::string::npos) ++pending;
      ExpectNoFaultIn("a");
    }
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_GT(pending, 0) << "some limit is met in a trial";
    EXPECT_EQ(Hash("a"), Hash("plain"));
    fs::remove_all(work() / "a");
  }
}

TEST_F(CliMemory, OneAllocationThatFailsIsNoFault) { ExpectOfExperiments(2); }

}  // namespace
}  // namespace rockyard::app
