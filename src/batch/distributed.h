// One campaign on several ranks.
#pragma once

#include <atomic>
#include <span>

#include "batch/communicator.h"
#include "batch/executor.h"

namespace rockyard::batch {

// Rank 0 has the store and the plan, hands out trials on demand, and computes, too; the others ask
// for small blocks (remote_work.h), compute with their threads, and send their records back, which
// rank 0 stores as its own. On every rank the calling thread alone speaks to the others and
// computes nothing; it sleeps while there is nothing to do.
//
// A message is answered within a few milliseconds; a record reaches rank 0 within 0.1 s. Records do
// not depend on the number of ranks. A rank whose `stop` becomes true gives back what it has not
// begun, and the others do it; the stop flag of rank 0 ends all. A rank that dies without a word
// takes the others with it (MPI): what rank 0 had received is in the store within a second.

// On rank 0, while every other rank is in ServeBatch or on its way there: in place of RunTrials.
// Returns when `source` has no more trials and all ranks have sent what they had.
void RunTrialsOnRanks(Communicator& communicator, std::span<const CellWork> work,
                      LocalWorkSource& source, int threads);

// On every other rank: returns when rank 0 has no more trials or `stop` is true, and everything
// that was begun has been sent.
void ServeBatch(Communicator& communicator, std::span<const CellWork> work, int threads,
                const std::atomic<bool>& stop);

}  // namespace rockyard::batch
