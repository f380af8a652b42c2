// A command that is killed before any one of the calls that change the disk can be repeated: it
// goes on, to the same bytes, and leaves nothing behind.
#pragma once

#include <gmock/gmock.h>

#include <functional>
#include <map>

#include "app/watched_run.h"

namespace rockyard::app {

// Each kind is killed before every `step`th of its calls.
class KillRuns : public WatchedRunTest {
 protected:
  KillRuns() : WatchedRunTest(1) {
    setenv("ROCKYARD_KILL_MARK", Mark().c_str(), 1);
    // A sanitizer wants to be the first library.
    setenv("ASAN_OPTIONS", "verify_asan_link_order=0", 1);
    WriteFile(work() / "sweep.json", R"({
      "name": "kills", "trials": 1, "set": {"referee.time_limit_s": 1},
      "axes": [{"path": "terrain.rocks.k_per_m2", "values": [0.001, 0.004]}]})");
  }

  std::vector<std::string> Drive(const std::string& out, int trials,
                                 const std::vector<std::string>& more) const {
    return With(QuickRun(out, trials), With({"--threads", "1", "--quiet"}, more));
  }

  std::vector<std::string> Shard(int index) const {
    const std::string number = std::to_string(index);
    return Drive("s" + number, 4, {"--shard", number + "/2", "--no-supervisor"});
  }

  // Before that call; 0: never.
  CommandResult RunKilledAt(int call, const std::vector<std::string>& words) const {
    std::filesystem::remove(Mark());
    setenv("ROCKYARD_KILL_AT", std::to_string(call).c_str(), 1);
    setenv("LD_PRELOAD", KILL_SHIM, 1);
    const pid_t process = StartProgram(With({ROCKYARD_COMMAND}, words));
    unsetenv("LD_PRELOAD");
    return Wait(process);
  }

  // Whether the command came to the call. It may have been killed itself, or have replaced a worker
  // that was.
  bool WasKilled() const { return std::filesystem::exists(Mark()); }

  std::filesystem::path Mark() const { return work().parent_path() / "mark"; }

  // What the folder holds, by name: the bytes of what follows from the trials alone.
  std::map<std::string, std::string> Contents(const std::string& out) const {
    std::map<std::string, std::string> files;
    for (const std::filesystem::directory_entry& entry :
         std::filesystem::directory_iterator(work() / out)) {
      const std::string name = entry.path().filename();
      files[name] = name.ends_with(".csv") ? ReadFile(entry.path()) : "";
    }
    files["results.sqlite"] = HashOfCells(out);
    return files;
  }

  std::string HashOfCells(const std::string& out) const {
    const batch::ResultStore store = batch::ResultStore::Read(work() / out);
    std::string hashes;
    for (int cell = 0; cell < store.cells(); ++cell) {
      hashes += batch::TrialHash(store.Load(cell)) + " ";
    }
    return hashes;
  }

  // `prepare` makes what is there before. Killed at each call (or each `step`th), the command ends
  // well or is repeated as `again`, with the contents of "whole".
  void ExpectEveryKillIsOvercome(const std::vector<std::string>& words,
                                 const std::vector<std::string>& again, int step,
                                 const std::function<void()>& prepare = {}) {
    const auto whole = Contents("whole");
    int kills = 0;
    for (int call = 1; !HasFailure(); call += step) {
      SCOPED_TRACE("killed before call " + std::to_string(call));
      std::filesystem::remove_all(work() / "a");
      if (prepare) prepare();
      CommandResult result = RunKilledAt(call, words);
      if (!WasKilled()) break;
      ++kills;
      if (result.exit_code != 0) {
        ASSERT_EQ(result.exit_code, -SIGKILL) << result.err;
        result = RunKilledAt(0, again);
      }
      ASSERT_EQ(result.exit_code, 0) << result.err;
      EXPECT_EQ(Contents("a"), whole);
      EXPECT_THAT(NamesIn(work()), testing::Each(testing::Not(testing::HasSubstr(".tmp-"))));
    }
    EXPECT_GT(kills, 20 / step) << "the command is not under the shim";
  }

  void ExpectOfRuns(int step) {
    ASSERT_EQ(Run(Drive("whole", 2, {"--no-supervisor"})).exit_code, 0);
    ExpectEveryKillIsOvercome(Drive("a", 2, {"--no-supervisor"}), Drive("a", 2, {"--resume"}),
                              step);
  }

  // The worker is killed, and the command goes on by itself; in the plain case, where it may not go
  // on with a folder of somebody else, and in that of --force, where it may not set its own aside.
  void ExpectOfSupervisedRuns(int step) {
    ASSERT_EQ(Run(Drive("whole", 2, {})).exit_code, 0);
    const std::vector<std::string> again = Drive("a", 2, {"--resume"});
    ExpectEveryKillIsOvercome(Drive("a", 2, {}), again, step);
    ExpectEveryKillIsOvercome(Drive("a", 2, {"--force"}), again, 3 * step);
  }

  void ExpectOfResumedRuns(int step) {
    ASSERT_EQ(Run(Drive("whole", 3, {"--no-supervisor"})).exit_code, 0);
    ASSERT_EQ(Run(Drive("begun", 1, {"--no-supervisor"})).exit_code, 0);
    const std::vector<std::string> resume = Drive("a", 3, {"--no-supervisor", "--resume"});
    ExpectEveryKillIsOvercome(resume, resume, step,
                              [&] { std::filesystem::copy(work() / "begun", work() / "a"); });
  }

  void ExpectOfSweeps(int step) {
    const std::vector<std::string> sweep = {"sweep", "sweep.json", "--threads",
                                            "1",     "--quiet",    "--no-supervisor"};
    ASSERT_EQ(Run(With(sweep, {"--out", "whole"})).exit_code, 0);
    ExpectEveryKillIsOvercome(With(sweep, {"--out", "a"}), With(sweep, {"--out", "a", "--resume"}),
                              step);
  }

  void ExpectOfMerges(int step) {
    ASSERT_EQ(Run(Shard(1)).exit_code, 0);
    ASSERT_EQ(Run(Shard(2)).exit_code, 0);
    ASSERT_EQ(Run({"merge", "s1", "s2", "--out", "whole", "--quiet"}).exit_code, 0);
    const std::vector<std::string> merge = {"merge", "s1", "s2", "--out", "a", "--quiet"};
    ExpectEveryKillIsOvercome(merge, merge, step);
  }

 private:
  static std::vector<std::string> NamesIn(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const std::filesystem::directory_entry& entry :
         std::filesystem::directory_iterator(folder)) {
      names.push_back(entry.path().filename());
    }
    return names;
  }
};

}  // namespace rockyard::app
