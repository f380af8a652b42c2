// rockyard trace

#include <algorithm>

#include "app/command.h"
#include "batch/forged_store.h"

namespace rockyard::app {
namespace {

class CliTrace : public CommandTest {
 protected:
  // A minute of simulated time: some scans and some driving.
  void MakeRun() const {
    RunTo(0, With(QuickRun("run", 3), {"--set", "referee.time_limit_s=60", "--quiet"}));
  }
};

TEST_F(CliTrace, AStoredTrialComesOutTheSame) {
  MakeRun();
  const CommandResult result =
      RunTo(0, {"trace", "run", "--trial", "2", "--csv", "trace.csv", "--svg", "trace.svg"});
  EXPECT_THAT(result.out,
              Says("seed 1, trial 2: time_limit", "same as the stored record, bit for bit"));
  EXPECT_LE(std::count(result.out.begin(), result.out.end(), '\n'), 63);
  EXPECT_THAT(ReadFile(work() / "trace.csv"), StartsWith("row,time_s,kind,true_x_m"));
  const std::string svg = ReadFile(work() / "trace.svg");
  EXPECT_THAT(svg, StartsWith("<svg"));
  for (const char* part :
       {"<polygon", "true path", "dead-reckoned path", "<title>goal</title>", "1 m", "</svg>\n"}) {
    EXPECT_THAT(svg, HasSubstr(part));
  }
}

TEST_F(CliTrace, ADamagedScenarioIsRefused) {
  MakeRun();
  // The store says 60 s; the scenario within it now says 20 s.
  const std::string store = (work() / "run" / "results.sqlite").string();
  std::string bytes = ReadFile(store);
  const std::string before = "\"time_limit_s\": 60";
  const auto at = bytes.find(before);
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, before.size(), "\"time_limit_s\": 20");
  WriteFile(store, bytes);
  EXPECT_THAT(RunTo(2, {"trace", "run", "--trial", "0"}).err, HasSubstr("table cells, row 0"));
}

TEST_F(CliTrace, AnotherRecordThanTheStoredOneIsFound) {
  MakeRun();
  batch::Forge(work() / "run" / "results.sqlite",
               "UPDATE trials SET sim_time_s = sim_time_s + 1.0");
  const CommandResult result = RunTo(1, {"trace", "run", "--trial", "0"});
  EXPECT_THAT(result.err, Says("sim_time_s: stored", "this trial is not the stored one"));
}

TEST_F(CliTrace, OfAScenarioWithOverrides) {
  const Words words = {"trace", Scenario("nominal"),       "--trial", "4",
                       "--set", "referee.time_limit_s=60", "--seed",  "9"};
  EXPECT_THAT(RunTo(0, words).out, HasSubstr("seed 9, trial 4: time_limit"));
  RunTo(0, With(words, {"--all"}));
  EXPECT_TRUE(NothingWritten());
}

TEST_F(CliTrace, BadInputSaysWhatWouldBeRight) {
  MakeRun();
  EXPECT_THAT(RunTo(2, {"trace", "run", "--trial", "3"}).err,
              HasSubstr("trial 3 is not stored in run"));
  EXPECT_THAT(RunTo(2, {"trace", "run", "--trial", "0", "--seed", "2"}).err,
              HasSubstr("scenario.resolved.json"));
  RunTo(2, {"trace", "run", "--trial", "-1"});
  RunTo(2, {"trace", "run"});
  const CommandResult folder = RunTo(2, {"trace", "run", "--trial", "0", "--svg", "no/such.svg"});
  EXPECT_THAT(folder.err, HasSubstr("folder that does not exist"));
  RunTo(2, {"trace", "run", "--trial", "0", "--csv", "a", "--svg", "a"});
  EXPECT_FALSE(fs::exists(work() / "a"));
}

}  // namespace
}  // namespace rockyard::app
