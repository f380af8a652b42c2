// What the ranks that mpirun started say to each other before and after the trials.
#pragma once

#include <chrono>

#include "batch/campaign.h"
#include "batch/communicator.h"
#include "campaign/campaign_process.h"
#include "campaign/journal.h"
#include "campaign/outcome.h"

namespace rockyard::campaign {

// On rank 0, before batch::RunDistributedBatch: every other rank gets the resolved scenario of each
// cell, so that no other file has to be there, and serves.
void StartRanks(batch::Communicator& communicator, const batch::CampaignIdentity& campaign);

// On rank 0, at the end, whatever happened: the others end with the same outcome. Does not return,
// and ends the whole job with that outcome as its code, where a rank was given up, or does not say
// within `silence` (0: waits for ever) that it ends: it would be waited for in vain.
void EndRanks(batch::Communicator& communicator, Outcome outcome, std::chrono::milliseconds silence,
              Journal& journal);

// On every other rank: serves until rank 0 ends, and returns its outcome. A rank that is another
// build of the program, or reads another scenario from the same text, ends the job with a message.
Outcome ServeRankZero(batch::Communicator& communicator, const ContainmentOptions& options,
                      const Contact& contact);

}  // namespace rockyard::campaign
