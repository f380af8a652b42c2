// One campaign on several ranks. campaign/campaign_process.h runs trials by it where mpirun started
// the program.
//
// Rank 0 has the store and the plan, hands out trials on demand, and computes, too. The other ranks
// ask for small blocks, compute with their threads, and send their records back, which rank 0
// stores as its own. On every rank the calling thread alone speaks to the others, as StartMpi asks,
// and computes nothing; it sleeps while there is nothing to do.
//
// A message is answered within a few milliseconds; a record reaches rank 0 within 0.1 s. Records do
// not depend on the number of ranks. A rank whose `stop` becomes true gives back the trials that it
// has not begun, and other ranks run them; the stop flag of rank 0 ends all. A rank that dies
// without a word takes the others with it (MPI): what rank 0 had received is in the store within a
// second.
//
// A rank says twice a second that it is there. A rank that is frozen, or cut off, says nothing:
// after the silence that the caller names, its trials are given to others, and whatever it may say
// later counts no more. A rank with a trial that hangs hands over everything else, and is given up,
// too: that trial stays pending.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "batch/communicator.h"
#include "batch/executor.h"

namespace rockyard::batch {

// Trials that have used up their CPU time on this rank: the watchdog of the rank tells them, and
// the thread that talks to the others asks for them.
class OverdueTrials {
 public:
  // Tells them. Call it once, when all other trials of this rank have ended.
  void Tell(std::vector<TrialId> trials);
  std::optional<std::vector<TrialId>> told() const;

 private:
  mutable std::mutex mutex_;
  std::optional<std::vector<TrialId>> trials_;
};

// How long rank 0 waits for the others, and whom it tells.
struct RankWatch {
  std::chrono::milliseconds silence{60000};                           // 0: waits for ever
  std::function<void(int rank, std::size_t trials)> silent{};         // its trials go to others
  std::function<void(const std::vector<TrialId>& trials)> overdue{};  // elsewhere: stay pending
};

// Runs the trials of `source` on this rank and on the others. Rank 0 calls it in place of
// RunTrials, while every other rank is in ServeBatch or on its way there. Returns when `source` has
// no more trials and all ranks have sent what they had or are given up (Communicator::given_up).
// Where a trial of this rank is overdue, `give_up` is called as soon as the other ranks have sent
// what they had, and should end the process: the thread of that trial cannot be stopped, and is
// waited for otherwise.
void RunTrialsOnRanks(Communicator& communicator, std::span<const CellWork> work,
                      LocalWorkSource& source, int threads, const RankWatch& watch,
                      const OverdueTrials& overdue,
                      const std::function<void(const std::vector<TrialId>&)>& give_up);

// Runs the trials that rank 0 sends. Every other rank calls it. Returns when rank 0 has no more
// trials or `stop` is true, and everything that was begun has been sent. A trial that is overdue is
// waited for: rank 0 ends the job before. RunTrialsOnRanks and ServeBatch throw what RunTrials
// throws.
void ServeBatch(Communicator& communicator, std::span<const CellWork> work, int threads,
                const std::atomic<bool>& stop, const OverdueTrials& overdue);

// The trials that one rank holds of a campaign whose store another rank has. It stands between the
// threads that compute, which take and finish, and the one thread that talks to rank 0, which adds
// what it is sent and collects what is finished. How much is asked for depends on the measured time
// of a trial: as many trials as all threads together finish in kBlock_s, so that nobody waits for
// messages and a slow rank holds little back. Where that is less than one trial, nothing is asked
// for in advance. No record depends on it.
class RemoteWorkSource final : public WorkSource {
 public:
  static constexpr double kBlock_s = 0.25;
  static constexpr std::int64_t kLargestBlock = 4096;

  // `stop`: true ends the handing out.
  RemoteWorkSource(int threads, const std::atomic<bool>& stop) : threads_(threads), stop_(stop) {}

  std::optional<TrialId> Take() override;
  void Finish(CellRecord record) override;
  void Close() override;

  void Add(const std::vector<TrialId>& trials);
  // Returns how many more trials to ask for; 0 while there are enough.
  std::int64_t Wanted() const;
  // Returns the records that were finished since the last call.
  std::vector<CellRecord> Collect();
  // Returns the trials that nobody took, and forgets them.
  std::vector<TrialId> Untaken();

 private:
  using Clock = std::chrono::steady_clock;
  struct Taken {
    TrialId id;
    Clock::time_point at;
  };

  const int threads_;
  const std::atomic<bool>& stop_;
  mutable std::mutex mutex_;
  std::condition_variable added_;
  std::deque<TrialId> waiting_;
  std::vector<Taken> taken_;
  std::vector<CellRecord> finished_;
  bool closed_ = false;
  int idle_ = 0;  // threads that wait for a trial
  std::int64_t count_ = 0;
  double busy_s_ = 0.0;  // of all finished trials together
};

}  // namespace rockyard::batch
