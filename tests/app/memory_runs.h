// Trials that find no memory: none of them is stored as a fault of the rover, the command fails as
// one that the machine failed, and what is gone on with comes to the records of an undisturbed run.
#pragma once

#include <algorithm>
#include <random>

#include "app/watched_run.h"

namespace rockyard::app {

class MemoryRuns : public WatchedRunTest {
 protected:
  MemoryRuns() : WatchedRunTest(1) {}

  // Trials of a shipped scenario.
  static Words Trials(const std::string& scenario, int trials, const Words& settings) {
    Words words = {ROCKYARD_COMMAND,
                   "run",
                   Source("scenarios/") + scenario + ".json",
                   "--trials",
                   std::to_string(trials),
                   "--threads",
                   "1",
                   "--quiet"};
    for (const std::string& setting : settings) words = With(words, {"--set", setting});
    return words;
  }

  void ExpectNoFaultIn(const std::string& out) const {
    if (Stored(out) == 0) return;
    const auto records = batch::ResultStore::Read(work() / out).Load();
    EXPECT_TRUE(std::none_of(records.begin(), records.end(), truth::IsFault));
  }

  // One allocation out of all that the command makes fails, at so many random points.
  void ExpectStarvationIsNoResult(const Words& words, int points, std::mt19937& random) {
    SCOPED_TRACE(testing::PrintToString(words));
    const std::string total = work().parent_path() / "allocations";
    setenv("ROCKYARD_STARVED_OF", total.c_str(), 1);
    ASSERT_EQ(RunStarved(0, With(words, {"--out", "plain"})).exit_code, 0);
    unsetenv("ROCKYARD_STARVED_OF");
    const long allocations = std::stol(ReadFile(total));
    ASSERT_GT(allocations, 10'000) << "the command is not under the shim";
    for (int point = 0; point < points && !HasFailure(); ++point) {
      const long at = std::uniform_int_distribution<long>(1, allocations)(random);
      SCOPED_TRACE("no memory for allocation " + std::to_string(at));
      const CommandResult result = RunStarved(at, With(words, {"--out", "a"}));
      EXPECT_THAT(result.exit_code, testing::AnyOf(0, 5)) << result.err;
      failed_ += result.exit_code == 5 ? 1 : 0;
      ExpectNoFaultIn("a");
      const CommandResult again = Wait(StartProgram(With(words, {"--out", "a", "--resume"})));
      ASSERT_EQ(again.exit_code, 0) << result.err << again.err;
      EXPECT_EQ(Hash("a"), Hash("plain"));
      fs::remove_all(work() / "a");
    }
    fs::remove_all(work() / "plain");
  }

  void ExpectOfExperiments(int points) {
    std::mt19937 random(20261128);
    const std::string brief = "referee.time_limit_s=2";
    for (const Words& words :
         {Trials("pathfinder/nominal", 2, {brief}), Trials("gestalt/abundance", 2, {brief}),
          Trials("continuous/csod", 2, {brief}),
          Trials("mission/sun", 2, {brief, "mission.sols=1"}),
          Trials("hazard_detection/detection_image", 2, {}), Trials("cylinder/views", 1, {}),
          Trials("localization/straight_sand", 2, {}),
          Trials("visual_odometry/steps_hazcam", 1, {"sensors.stereo.images.pyramid_level=0"})}) {
      ExpectStarvationIsNoResult(words, points, random);
    }
    EXPECT_GT(failed_, 0) << "what is starved is not noticed";
  }

 private:
  // `allocation`: the number of the one that fails; 0: none.
  CommandResult RunStarved(long allocation, const Words& words) const {
    setenv("ROCKYARD_STARVED_AT", std::to_string(allocation).c_str(), 1);
    setenv("LD_PRELOAD", ALLOCATION_SHIM, 1);
    const pid_t process = StartProgram(words);
    unsetenv("LD_PRELOAD");
    unsetenv("ROCKYARD_STARVED_AT");
    return Wait(process);
  }

  int failed_ = 0;  // commands that said so
};

}  // namespace rockyard::app
