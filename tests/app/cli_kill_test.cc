// Some kills of every kind; all of them in cli_kill_long_test.cc.
#include "app/kill_runs.h"

namespace rockyard::app {
namespace {

using CliKill = KillRuns;

constexpr int kStep = 24;

TEST_F(CliKill, RunAnywhere) { ExpectOfRuns(kStep); }

TEST_F(CliKill, SupervisedRunAnywhere) { ExpectOfSupervisedRuns(kStep); }

TEST_F(CliKill, ResumeAnywhere) { ExpectOfResumedRuns(kStep); }

TEST_F(CliKill, SweepAnywhere) { ExpectOfSweeps(kStep); }

TEST_F(CliKill, SequenceAnywhere) { ExpectOfSequences(20); }

TEST_F(CliKill, NoRoomOrRightsAnywhere) { ExpectOfLacks(24); }

TEST_F(CliKill, MergeAnywhere) { ExpectOfMerges(kStep); }

}  // namespace
}  // namespace rockyard::app
