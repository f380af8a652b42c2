// An allocation that fails at each of many points, and a rank that has too little memory.
#include "app/memory_runs.h"
#ifdef MPIRUN
#include "app/mpi_runs.h"
#endif

namespace rockyard::app {
namespace {

using CliMemoryLong = MemoryRuns;

TEST_F(CliMemoryLong, OneAllocationThatFailsIsNoFault) { ExpectOfExperiments(200); }

#ifdef MPIRUN
using CliMpiMemoryLong = MpiRuns;

// From too little to begin to enough, on the second rank alone.
TEST_F(CliMpiMemoryLong, WhatARankLacksIsNoFault) {
  const Words look =
      With({"run", Source("scenarios/visual_odometry/steps_hazcam.json"), "--trials", "4",
            "--threads", "1", "--quiet"},
           {"--set", "sensors.stereo.images.pyramid_level=1", "--set", "referee.time_limit_s=20"});
  RunTo(0, With(look, {"--out", "plain"}));
  const Words words = With(look, {"--out", "a"});
  int failed = 0;
  for (const int limit_MiB : {50, 100, 140, 200, 2000}) {
    SCOPED_TRACE("within MiB " + std::to_string(limit_MiB));
    const std::string within = "ulimit -v " + std::to_string(1024 * limit_MiB) + "; exec \"$@\"";
    const CommandResult result = Wait(
        StartProgram(With(With(With({MPIRUN, "-n", "1", ROCKYARD_COMMAND}, words),
                               {":", "-n", "1", "sh", "-c", within, "within", ROCKYARD_COMMAND}),
                          words)));
    // MPI itself has its own codes where it cannot begin.
    if (result.exit_code != 0) ++failed;
    if (limit_MiB == 2000) {
      EXPECT_EQ(result.exit_code, 0) << result.err;
    }
    if (Stored("a") > 0) {
      for (const truth::Record& record : batch::ResultStore::Read(work() / "a").Load()) {
        EXPECT_FALSE(truth::IsFault(record)) << record.detail;
      }
    }
    const CommandResult resumed = Run(With(words, {"--resume"}));
    ASSERT_EQ(resumed.exit_code, 0) << result.err << resumed.err;
    EXPECT_EQ(Hash("a"), Hash("plain"));
    fs::remove_all(work() / "a");
  }
  EXPECT_GT(failed, 0) << "some limit is met";
}
#endif

}  // namespace
}  // namespace rockyard::app
