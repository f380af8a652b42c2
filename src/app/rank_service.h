// What the ranks that mpirun started say to each other before and after the trials.
#pragma once

#include "app/exit_code.h"
#include "batch/campaign.h"
#include "batch/communicator.h"

namespace rockyard::app {

// On rank 0, before batch::RunDistributedBatch: every other rank gets the resolved scenario of each
// cell, so that no other file has to be there, and serves.
void StartRanks(batch::Communicator& communicator, const batch::CampaignIdentity& campaign);

// On rank 0, at the end, whatever happened: the others end with the same code.
void EndRanks(batch::Communicator& communicator, ExitCode code);

// On every other rank: serves until rank 0 ends, and returns its exit code. A rank that is another
// build of the program, or reads another scenario from the same text, ends the job with a message.
ExitCode ServeRankZero(batch::Communicator& communicator, int threads, double trial_cpu_limit_s);

}  // namespace rockyard::app
