// Runs of the real command that a test watches, and meddles with, while they go on.
#pragma once

#include <iterator>
#include <utility>

#include "app/command.h"
#include "batch/result_store.h"
#include "batch/store_error.h"
#include "batch/trial_hash.h"

namespace rockyard::app {

class WatchedRunTest : public CommandTest {
 protected:
  // `threads` of a run that does not say otherwise.
  explicit WatchedRunTest(int threads) : threads_(threads) {}

  // Trials of some milliseconds: what a rover weighs does not matter here.
  std::vector<std::string> Drives(const std::string& out, int trials,
                                  const std::vector<std::string>& more = {},
                                  int threads = 0) const {
    return With({"run", Scenario("nominal"), "--out", out, "--set", "referee.time_limit_s=300",
                 "--set", "rover.fidelity=quasi_static", "--threads",
                 std::to_string(threads > 0 ? threads : threads_), "--quiet", "--trials",
                 std::to_string(trials)},
                more);
  }

  std::size_t Stored(const std::string& out) const {
    try {
      return batch::ResultStore::Read(work() / out).Finished().size();
    } catch (const batch::StoreError&) {
      return 0;  // not there yet
    }
  }

  bool WaitForTrials(const std::string& out, std::size_t count) const {
    return WaitUntil([&] { return Stored(out) >= count; });
  }

  std::string Hash(const std::string& out) const {
    return batch::TrialHash(batch::ResultStore::Read(work() / out).Load());
  }

  // Processes that this one has started.
  static std::vector<pid_t> ChildrenOf(pid_t process) {
    const std::string id = std::to_string(process);
    std::ifstream file("/proc/" + id + "/task/" + id + "/children");
    return {std::istream_iterator<pid_t>(file), {}};
  }

 private:
  int threads_;
};

}  // namespace rockyard::app
