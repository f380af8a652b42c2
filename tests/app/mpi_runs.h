// Campaigns on several ranks with the real mpirun, all on this machine.
#pragma once

#include "app/watched_run.h"

namespace rockyard::app {

class MpiRuns : public WatchedRunTest {
 protected:
  MpiRuns() : WatchedRunTest(1) {
    // Tests run as root in containers, with more ranks than cores.
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 1);
    setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 1);
    // What MPI keeps until a process ends is no leak of ours, and its libraries are gone by then.
    setenv("LSAN_OPTIONS", "detect_leaks=0", 1);
  }

  pid_t StartOn(int ranks, const Words& words) const {
    return StartProgram(With({MPIRUN, "-n", std::to_string(ranks), ROCKYARD_COMMAND}, words));
  }
  CommandResult RunOn(int ranks, const Words& words) const { return Wait(StartOn(ranks, words)); }

  // What is stored stays when the rank of that number is killed, and others go on: on so many
  // ranks, or without mpirun (0).
  void ExpectKillLosesNothing(std::size_t rank, int ranks_of_resume) const {
    const pid_t process = StartOn(3, Drives("a", 400));
    ASSERT_TRUE(WaitForTrials("a", 30));
    const std::vector<pid_t> ranks = ChildrenOf(process);
    ASSERT_EQ(ranks.size(), 3U);
    kill(ranks[rank], SIGKILL);
    EXPECT_NE(Wait(process).exit_code, 0);
    const std::size_t stored = Stored("a");
    EXPECT_GE(stored, 30U);
    EXPECT_LT(stored, 400U);
    const Words resume = Drives("a", 400, {"--resume"});
    const CommandResult resumed =
        ranks_of_resume > 0 ? RunOn(ranks_of_resume, resume) : Run(resume);
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_EQ(Hash("a"), PlainHash(400));
  }
};

}  // namespace rockyard::app
