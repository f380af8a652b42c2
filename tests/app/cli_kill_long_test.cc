// A kill before every call that changes the disk.
#include "app/kill_runs.h"

namespace rockyard::app {
namespace {

using CliKillLong = KillRuns;

TEST_F(CliKillLong, RunAnywhere) { ExpectOfRuns(1); }

TEST_F(CliKillLong, SupervisedRunAnywhere) { ExpectOfSupervisedRuns(1); }

TEST_F(CliKillLong, ResumeAnywhere) { ExpectOfResumedRuns(1); }

TEST_F(CliKillLong, SweepAnywhere) { ExpectOfSweeps(1); }

TEST_F(CliKillLong, SequenceAnywhere) { ExpectOfSequences(1); }

TEST_F(CliKillLong, NoRoomOrRightsAnywhere) { ExpectOfLacks(1); }

TEST_F(CliKillLong, MergeAnywhere) { ExpectOfMerges(1); }

}  // namespace
}  // namespace rockyard::app
