// What goes wrong while traces are written: one document on standard output, whole files alone, the
// trial named that is to blame, and the others there all the same.
#include <gmock/gmock.h>

#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "app/console.h"
#include "app/run_display.h"
#include "app/watched_run.h"
#include "campaign/campaign_process.h"
#include "campaign/campaign_traces.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class CliTraceFaults : public WatchedRunTest {
 protected:
  CliTraceFaults() : WatchedRunTest(1) {}

  // Trials of some tenths of a second each, so that there is time to meddle between two of them.
  std::vector<std::string> SlowRun(const std::vector<std::string>& more) const {
    return With({"run", Scenario("nominal"), "--out", "run", "--trials", "6", "--traces", "all",
                 "--threads", "1"},
                more);
  }

  std::size_t Files() const {
    std::size_t count = 0;
    std::error_code none;
    for (const auto& entry : fs::recursive_directory_iterator(work() / "run/traces", none)) {
      count += entry.is_regular_file() ? 1 : 0;
    }
    return count;
  }

  bool WaitForTraces(std::size_t count) const {
    return WaitUntil([&] { return Files() >= count; });
  }

  // The exit code of writing all traces of `run` with drives that do `hook` first.
  ExitCode Trace(const std::function<void(std::uint64_t trial)>& hook, int threads) {
    campaign::TraceRequest request{.retention = {.all = true}, .threads = threads};
    request.drive = [&](const scenario::Scenario& scenario, std::uint64_t seed,
                        std::uint64_t trial) {
      hook(trial);
      return campaign::RecordDrive(scenario, seed, trial);
    };
    testing::internal::CaptureStderr();
    const campaign::Observer console = MessagesToConsole(Output::kText);
    const campaign::WorkResult result =
        campaign::Recorded(console, [&](campaign::Journal& journal) {
          return campaign::RunContained(
              {.threads = threads}, {journal, campaign::Stop()},
              [](campaign::CampaignProcess&) { return ExitCode::kDone; },
              [&](campaign::CampaignProcess& process) {
                return process.Afterwards(
                    [&](const batch::Mission& mission, batch::FlightLog& log) {
                      return campaign::WriteTraces(work() / "run", request, mission, log, journal);
                    });
              });
        });
    said_ = testing::internal::GetCapturedStderr();
    return result.outcome;
  }

  std::string said_;
};

TEST_F(CliTraceFaults, AKilledWorkerLeavesOneDocument) {
  const pid_t process = Start(SlowRun({"--json"}));
  ASSERT_TRUE(WaitForTraces(2));
  const std::vector<pid_t> workers = ChildrenOf(process);
  ASSERT_EQ(workers.size(), 1U);
  kill(workers.front(), SIGKILL);
  const CommandResult result = WaitTo(0, process);
  EXPECT_EQ(nlohmann::json::parse(result.out)["trials"]["completed"], 6);
  EXPECT_THAT(result.err, HasSubstr("6 traces are in run/traces"));
  EXPECT_EQ(Files(), 6U);
}

TEST_F(CliTraceFaults, CtrlCLeavesWholeFilesAndGoesOn) {
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{}, {"--no-supervisor", "--force"}}) {
    const pid_t process = Start(SlowRun(more));
    fs::remove_all(work() / "run/traces");
    ASSERT_TRUE(WaitForTraces(2));
    kill(process, SIGINT);
    EXPECT_THAT(WaitTo(130, process).err, Says("interrupted: ", " of 6 traces", "--resume"));
    EXPECT_LT(Files(), 6U);
    RunTo(0, SlowRun({"--resume"}));
    EXPECT_EQ(Files(), 6U);
  }
}

// Of all cells, not of those that it has come to.
TEST_F(CliTraceFaults, InterruptedInTheFirstCellItCountsAll) {
  WriteFile(work() / "sweep.json",
            "{\"name\": \"s\", \"scenario\": \"" + Scenario("nominal") +
                "\", \"trials\": 6, \"axes\": [{\"path\": \"course.goal_radius_m\", "
                "\"values\": [1, 2]}]}");
  const pid_t process =
      Start({"sweep", "sweep.json", "--out", "run", "--traces", "all", "--threads", "1"});
  ASSERT_TRUE(WaitForTraces(2));
  kill(process, SIGTERM);
  EXPECT_THAT(WaitTo(130, process).err, HasSubstr(" of 12 traces are written"));
}

TEST_F(CliTraceFaults, ADriveThatCrashesIsNamedAndTheOthersGoOn) {
  ASSERT_EQ(Run(With(QuickRun("run", 7), {"--quiet"})).exit_code, 0);
  const auto crash = [](std::uint64_t trial) {
    if (trial != 3) return;
    std::signal(SIGSEGV, SIG_DFL);
    raise(SIGSEGV);
  };
  for (const int threads : {1, 3}) {
    fs::remove_all(work() / "run/traces");
    EXPECT_EQ(Trace(crash, threads), ExitCode::kFailed);
    EXPECT_THAT(said_, AllOf(HasSubstr("SIGSEGV"), HasSubstr("trial 3: has no trace"),
                             HasSubstr("rockyard replay "), HasSubstr("--trial 3"),
                             Not(HasSubstr("trial 4"))));
    EXPECT_EQ(Files(), 6U);
  }
}

TEST_F(CliTraceFaults, ADriveThatThrowsIsNamedAndTheOthersGoOn) {
  ASSERT_EQ(Run(With(QuickRun("run", 5), {"--quiet"})).exit_code, 0);
  const auto fail = [](std::uint64_t trial) {
    if (trial == 1) throw std::bad_alloc();
    if (trial == 2) throw std::runtime_error("has no terrain");
  };
  EXPECT_EQ(Trace(fail, 1), ExitCode::kFailed);
  EXPECT_THAT(said_, Says("trial-000001.npz: is not written: std::bad_alloc",
                          "trial-000002.npz: is not written: has no terrain"));
  EXPECT_EQ(Files(), 3U);
}

TEST_F(CliTraceFaults, TheWorstOfAShardAreRefused) {
  EXPECT_THAT(RunTo(2, With(QuickRun("run", 4), {"--shard", "1/2", "--traces", "worst:1"})).err,
              HasSubstr("--traces: worst:N is asked of all trials"));
  EXPECT_TRUE(NothingWritten());
}

TEST_F(CliTraceFaults, MergeSaysThatTracesStayAndTheWholeMakesThem) {
  for (const std::string shard : {"1/2", "2/2"}) {
    ASSERT_EQ(Run(With(QuickRun("shard" + shard.substr(0, 1), 4),
                       {"--shard", shard, "--traces", "all", "--quiet"}))
                  .exit_code,
              0);
  }
  const CommandResult merged = RunTo(0, {"merge", "shard1", "shard2", "--out", "run"});
  EXPECT_THAT(merged.err, HasSubstr("traces of shards are not merged"));
  EXPECT_FALSE(fs::exists(work() / "run/traces"));
  RunTo(0, With(QuickRun("run", 4), {"--resume", "--traces", "worst:1", "--quiet"}));
  EXPECT_EQ(Files(), 1U);
}

}  // namespace
}  // namespace rockyard::app
