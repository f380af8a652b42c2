// The trials that one rank holds of a campaign whose store another rank has.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <vector>

#include "batch/work_source.h"

namespace rockyard::batch {

// Between the threads that compute, which take and finish, and the one thread that talks to rank
// 0, which adds what it is sent and collects what is finished. How much is asked for depends on the
// measured time of a trial: enough for kBlock_s of work, so that nobody waits for messages and a
// slow rank holds little back; nothing in advance where one trial takes longer. No record depends
// on it.
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
  // How many more trials to ask for; 0 while there are enough.
  std::int64_t Wanted() const;
  // Records that were finished since the last call.
  std::vector<CellRecord> Collect();
  // Trials that nobody took.
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
