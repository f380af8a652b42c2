// Runs of the real command that a test watches, and meddles with, while they go on.
#pragma once

#include <iterator>

#include "app/command.h"
#include "batch/result_store.h"
#include "batch/sqlite_database.h"
#include "batch/trial_hash.h"

namespace rockyard::app {

class WatchedRunTest : public CommandTest {
 protected:
  // `threads` of a run that does not say otherwise.
  explicit WatchedRunTest(int threads) : threads_(threads) {}

  // Trials of some milliseconds.
  Words Drives(const std::string& out, int trials, const Words& more = {}, int threads = 0) const {
    return With({"run", Scenario("nominal"), "--out", out, "--set", "referee.time_limit_s=300",
                 "--threads", std::to_string(threads > 0 ? threads : threads_), "--quiet",
                 "--trials", std::to_string(trials)},
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

  // Of the first trials of a run that nobody disturbs, which is made once for all tests that ask
  // for no more.
  std::string PlainHash(int trials) const {
    const auto count = static_cast<std::size_t>(trials);
    if (plain_.size() < count) {
      RunTo(0, Drives("plain", trials, {"--no-supervisor", "--force"}, 2));
      plain_ = batch::ResultStore::Read(work() / "plain").Load();
    }
    return batch::TrialHash(std::span(plain_).first(count));
  }

  // Processes that this one has started.
  static std::vector<pid_t> ChildrenOf(pid_t process) {
    const std::string id = std::to_string(process);
    std::ifstream file("/proc/" + id + "/task/" + id + "/children");
    return {std::istream_iterator<pid_t>(file), {}};
  }

  // The process that the supervisor has started; 0: none.
  static pid_t WorkerOf(pid_t supervisor) {
    const std::vector<pid_t> children = ChildrenOf(supervisor);
    return children.empty() ? 0 : children.front();
  }

  // A worker that dies by a signal from outside is replaced, and the records are the same.
  void ExpectReplaced(int signal, const std::string& name) const {
    const std::string expected = PlainHash(300);
    const pid_t process = Start(Drives("a", 300));
    ASSERT_TRUE(WaitForTrials("a", 20));
    const pid_t worker = WorkerOf(process);
    ASSERT_GT(worker, 0) << "the run is long enough to be hit";
    ASSERT_EQ(kill(worker, signal), 0);
    const CommandResult result = WaitTo(0, process);
    EXPECT_THAT(result.err, HasSubstr(name));
    EXPECT_EQ(Hash("a"), expected);
  }

 private:
  int threads_;
  static inline std::vector<truth::Record> plain_;
};

}  // namespace rockyard::app
