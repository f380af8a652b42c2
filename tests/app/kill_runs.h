// A command that is killed before any one of the calls that change the disk can be repeated: it
// goes on, to the same bytes, and leaves nothing behind. Where the disk is full from such a call
// on, or nothing may be made there any more, it says so by exit code 5 (or has all that it needs),
// and can be repeated as well. By exit code 2 it says so only where it has changed nothing.
#pragma once

#include <functional>
#include <iostream>
#include <map>

#include "app/watched_run.h"
#include "core/hash.h"

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

  // ctest tells it with --verbose.
  void TearDown() override {
    std::cout << cases_ << " cases of a kill, a full disk or no rights\n";
    WatchedRunTest::TearDown();
  }

  Words Drive(const std::string& out, int trials, const Words& more) const {
    return With(QuickRun(out, trials), With({"--threads", "1", "--quiet"}, more));
  }

  Words Shard(int index) const {
    const std::string number = std::to_string(index);
    return Drive("s" + number, 4, {"--shard", number + "/2", "--no-supervisor"});
  }

  // Pairs of small images.
  static Words Render(const std::string& out, const Words& more) {
    return With(
        {"render", Source("scenarios/gestalt/abundance.json"), "--out", out, "--set",
         "sensors.stereo.columns=128", "--set", "sensors.stereo.rows=96", "--set",
         "sensors.stereo.images.pyramid_level=0", "--set", "sensors.stereo.max_disparity_px=32"},
        more);
  }
  static Words Vo(const std::string& out) {
    return {"vo", "way", "--cameras", "way/cameras.json", "--out", out, "--quiet"};
  }

  // `what` happens at that call of the shim; 0: never.
  CommandResult RunShimmed(const char* what, int call, const Words& words) const {
    fs::remove(Mark());
    setenv(what, std::to_string(call).c_str(), 1);
    setenv("LD_PRELOAD", KILL_SHIM, 1);
    const pid_t process = StartProgram(With({ROCKYARD_COMMAND}, words));
    unsetenv("LD_PRELOAD");
    unsetenv(what);
    return Wait(process);
  }

  // Whether the command came to the call. It may have been killed itself, or have replaced a worker
  // that was.
  bool WasStruck() const { return fs::exists(Mark()); }

  fs::path Mark() const { return work().parent_path() / "mark"; }

  // What the folder holds, by name: the bytes of what follows from the trials alone.
  std::map<std::string, std::string> Contents(const std::string& out) const {
    if (fs::exists(work() / out / "made_by.json")) return Bytes(work() / out);
    std::map<std::string, std::string> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(work() / out)) {
      const std::string name = entry.path().filename();
      files[name] = name.ends_with(".csv") ? ReadFile(entry.path()) : "";
    }
    files["results.sqlite"] = HashOfCells(out);
    return files;
  }

  // Hashes of all files below the folder, but of those that hold how long something took.
  static std::map<std::string, std::string> Bytes(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      const std::string name = entry.path().lexically_relative(folder);
      const bool timed = name.ends_with("times.csv") || name.ends_with("vo.json") ||
                         name.ends_with("journal.jsonl");
      if (!entry.is_regular_file() || timed) continue;
      files[name] = core::Hex(core::Hasher().RawText(ReadFile(entry.path())).value());
    }
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

  static constexpr const char* kKill = "ROCKYARD_KILL_AT";
  static constexpr const char* kFull = "ROCKYARD_FULL_AT";
  static constexpr const char* kDenied = "ROCKYARD_DENIED_AT";

  // The bytes of all files, and the records of the store that is gone on with: SQLite marks in its
  // head how it was opened, and may leave an empty log.
  std::map<std::string, std::string> State() const {
    auto state = Bytes(work());
    if (state.contains("a/results.sqlite")) {
      std::erase_if(state,
                    [](const auto& file) { return file.first.starts_with("a/results.sqlite-"); });
      state["a/results.sqlite"] = HashOfCells("a");
    }
    return state;
  }

  void ExpectTold(const char* what, const CommandResult& result,
                  const std::map<std::string, std::string>& before) const {
    if (what == kKill) {
      EXPECT_EQ(result.exit_code, -SIGKILL) << result.err;
    } else if (what == kDenied && result.exit_code == 2) {
      EXPECT_EQ(State(), before) << result.err;
    } else {
      EXPECT_EQ(result.exit_code, 5) << result.err;
    }
  }

  // `prepare` makes what is there before. Killed at each call (or each `step`th), or on a disk that
  // is full from there on, the command ends well or is repeated as `again`, with the contents of
  // "whole".
  void ExpectEveryKillIsOvercome(const Words& words, const Words& again, int step,
                                 const std::function<void()>& prepare = {}) {
    ExpectOvercome(kKill, words, again, step, prepare);
    ExpectOvercome(kFull, words, again, step, prepare);
    ExpectOvercome(kDenied, words, again, step, prepare);
  }

  void ExpectOvercome(const char* what, const Words& words, const Words& again, int step,
                      const std::function<void()>& prepare) {
    const auto whole = Contents("whole");
    int kills = 0;
    for (int call = 1; !HasFailure(); call += step) {
      SCOPED_TRACE(std::string(what) + "=" + std::to_string(call));
      fs::remove_all(work() / "a");
      if (prepare) prepare();
      const auto before = State();
      CommandResult result = RunShimmed(what, call, words);
      if (!WasStruck()) break;
      ++kills;
      ++cases_;
      // What a repeated merge finds whole it leaves as it is.
      const bool is_left = result.exit_code == 0 || words.front() == "merge";
      if (result.exit_code != 0) {
        ExpectTold(what, result, before);
        result = RunShimmed(what, 0, again);
      }
      ASSERT_EQ(result.exit_code, 0) << result.err;
      auto contents = Contents("a");
      if (what != kKill && is_left) {
        // A store that is stopped at its very end is whole with its log beside it.
        std::erase_if(contents,
                      [](const auto& file) { return file.first.starts_with("results.sqlite-"); });
      }
      EXPECT_EQ(contents, whole);
      EXPECT_THAT(NamesIn(work()), testing::Each(Not(HasSubstr(".tmp-"))));
    }
    EXPECT_GT(kills, 20 / step) << "the command is not under the shim";
  }

  // `words` write what begins with "a" and nothing else; `again` is the command once there is room.
  // `at_once`: all is written or nothing.
  void ExpectLacksAreTold(const Words& words, const Words& again, int step, bool at_once = false) {
    SCOPED_TRACE(testing::PrintToString(words));
    const auto before = Bytes(work());
    RunTo(0, words);
    const auto whole = Bytes(work());
    ASSERT_GT(whole.size(), before.size());
    for (const auto& [what, sentence] :
         {std::pair{kFull, "No space left on device"}, {kDenied, "Permission denied"}}) {
      int calls = 0;
      for (int call = 1; !HasFailure(); call += step, ++calls) {
        SCOPED_TRACE(sentence + (" from call " + std::to_string(call)));
        RemoveOutput();
        const CommandResult result = RunShimmed(what, call, words);
        if (!WasStruck()) break;
        ++cases_;
        ExpectTold(what, result, before);
        EXPECT_THAT(result.err, HasSubstr(sentence));
        if (at_once) {
          EXPECT_EQ(Bytes(work()), before);
          EXPECT_FALSE(fs::exists(work() / "a"));
        }
        RunTo(0, again);
        EXPECT_EQ(Bytes(work()), whole);
      }
      RemoveOutput();
      EXPECT_GT(calls, 2 / step) << "the command is not under the shim";
    }
  }

  void ExpectOfLacks(int step) {
    RunTo(0, Render("way", {"--pairs", "3", "--step-m", "0.1"}));
    RunTo(0, Render("pair", {}));
    RunTo(0, Drive("run", 2, {}));
    const Words sequence = Render("a", {"--pairs", "3", "--step-m", "0.1"});
    ExpectLacksAreTold(sequence, With(sequence, {"--resume"}), step);
    ExpectLacksAreTold(Vo("a"), With(Vo("a"), {"--resume"}), step);
    const Words stereo = {"stereo",
                          "pair/left.png",
                          "pair/right.png",
                          "--cameras",
                          "pair/cameras.json",
                          "--param",
                          "correlator.disparities=32"};
    for (const Words& words : {With(stereo, {"--out", "a"}),
                               Render("a", {}),
                               {"terrain", Scenario("nominal"), "--out", "a.svg"},
                               {"rover", Scenario("nominal"), "--out", "a.urdf"},
                               {"trace", "run", "--trial", "0", "--csv", "a.csv"},
                               {"compare", "run", "run", "--csv", "a.csv"},
                               {"baseline", "run", "--reason", "full disks", "--out", "a.json"}}) {
      ExpectLacksAreTold(words, words, step, true);
    }
    const Words replay = {"replay", "run", "--trial", "0", "--out", "a.html"};
    ExpectLacksAreTold(replay, replay, step);
    const Words report = {"report", "run", "--out", "a.html"};
    ExpectLacksAreTold(report, report, step);
  }

  // Both are killed and gone on with.
  void ExpectOfSequences(int step) {
    const Words pairs = {"--pairs", "4", "--step-m", "0.1"};
    RunTo(0, Render("way", pairs));
    fs::copy(work() / "way", work() / "whole", fs::copy_options::recursive);
    ExpectEveryKillIsOvercome(Render("a", pairs), With(Render("a", pairs), {"--resume"}), step);
    fs::remove_all(work() / "whole");
    RunTo(0, Vo("whole"));
    ExpectEveryKillIsOvercome(Vo("a"), With(Vo("a"), {"--resume"}), step);
  }

  void ExpectOfRuns(int step) {
    RunTo(0, Drive("whole", 2, {"--no-supervisor"}));
    ExpectEveryKillIsOvercome(Drive("a", 2, {"--no-supervisor"}), Drive("a", 2, {"--resume"}),
                              step);
  }

  // The worker is killed, and the command goes on by itself; in the plain case, where it may not go
  // on with a folder of somebody else, and in that of --force, where it may not set its own aside.
  void ExpectOfSupervisedRuns(int step) {
    RunTo(0, Drive("whole", 2, {}));
    const Words again = Drive("a", 2, {"--resume"});
    ExpectEveryKillIsOvercome(Drive("a", 2, {}), again, step);
    ExpectEveryKillIsOvercome(Drive("a", 2, {"--force"}), again, 3 * step);
  }

  void ExpectOfResumedRuns(int step) {
    RunTo(0, Drive("whole", 3, {"--no-supervisor"}));
    RunTo(0, Drive("begun", 1, {"--no-supervisor"}));
    const Words resume = Drive("a", 3, {"--no-supervisor", "--resume"});
    ExpectEveryKillIsOvercome(resume, resume, step,
                              [&] { fs::copy(work() / "begun", work() / "a"); });
  }

  void ExpectOfSweeps(int step) {
    const Words sweep = {"sweep", "sweep.json", "--threads", "1", "--quiet", "--no-supervisor"};
    RunTo(0, With(sweep, {"--out", "whole"}));
    ExpectEveryKillIsOvercome(With(sweep, {"--out", "a"}), With(sweep, {"--out", "a", "--resume"}),
                              step);
  }

  void ExpectOfMerges(int step) {
    RunTo(0, Shard(1));
    RunTo(0, Shard(2));
    RunTo(0, {"merge", "s1", "s2", "--out", "whole", "--quiet"});
    const Words merge = {"merge", "s1", "s2", "--out", "a", "--quiet"};
    ExpectEveryKillIsOvercome(merge, merge, step);
  }

 private:
  int cases_ = 0;

  void RemoveOutput() const {
    for (const std::string& name : NamesIn(work())) {
      if (name.starts_with("a")) fs::remove_all(work() / name);
    }
  }

  static Words NamesIn(const fs::path& folder) {
    Words names;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
      names.push_back(entry.path().filename());
    }
    return names;
  }
};

}  // namespace rockyard::app
