// Campaigns with trials that crash or hang, with the real store, supervisor and watchdog, and an
// experiment that does as it is told.
#include <gmock/gmock.h>

#include <csignal>
#include <iostream>
#include <set>

#include "batch/fake_experiment.h"
#include "batch/run_folder.h"
#include "batch/trial_hash.h"
#include "campaign/campaign_process.h"
#include "core/says.h"
#include "core/test_folder.h"

namespace rockyard::campaign {
namespace {

using batch::FakeExperiment;
using batch::ResultStore;
using testing::HasSubstr;

constexpr std::int64_t kTrials = 40;

class Containment : public testing::Test {
 protected:
  // The outcome of a campaign whose trials run `hook` first. Nothing of it runs in this process,
  // which stays fit to fork.
  Outcome Run(const FakeExperiment::Hook& hook, const ContainmentOptions& options) {
    const WorkResult result =
        RunParts(options, [&](CampaignProcess& process) { return Campaign(process, hook); }, {});
    said_.clear();
    for (const Note& note : result.notes) said_ += note.text + "\n";
    for (const core::Problem& problem : result.problems) {
      said_ += problem.path + ": " + problem.reason + "\n  " + problem.suggestion + "\n";
    }
    return result.outcome;
  }

  static WorkResult RunParts(const ContainmentOptions& options, const CampaignPart& body,
                             const CampaignPart& afterwards, const Observer& observer = {}) {
    return Recorded(observer, [&](Journal& journal) {
      return RunContained(options, {journal, Stop()}, body, afterwards);
    });
  }

  Outcome Campaign(CampaignProcess& process, const FakeExperiment::Hook& hook) {
    const batch::FolderClaim claim(folder_.path());
    ResultStore store = batch::HoldsStore(folder_.path())
                            ? ResultStore::Resume(folder_.path(), batch::FakeIdentity())
                            : ResultStore::Create(folder_.path(), batch::FakeIdentity(), kTrials);
    const FakeExperiment experiment(hook);
    const batch::CellWork work{&experiment, 1};
    if (!process.whole()) return process.DoTask({&work, 1}, store);
    const batch::BatchResult result =
        process.RunTrials({&work, 1}, store, {.interval = std::chrono::milliseconds(20)});
    if (process.TellLeftOut(store)) return Outcome::kFailed;
    return result.end == batch::BatchEnd::kFinished ? Outcome::kDone : Outcome::kInterrupted;
  }

  std::vector<truth::Record> Records() const { return ResultStore::Read(folder_.path()).Load(); }

  // Trials that have a record as an undisturbed campaign would have.
  std::set<std::uint64_t> Good() const {
    std::set<std::uint64_t> good;
    for (const truth::Record& record : Records()) {
      const truth::Record plain = batch::FakeRecord(1, record.trial);
      if (batch::TrialHash({&record, 1}) == batch::TrialHash({&plain, 1})) {
        good.insert(record.trial);
      }
    }
    return good;
  }

  std::set<std::int64_t> WithMachineFault(const std::string& kind) const {
    std::set<std::int64_t> trials;
    const ResultStore store = ResultStore::Read(folder_.path());
    for (const batch::InfrastructureFault& fault : store.InfrastructureFaults()) {
      if (fault.kind == kind) trials.insert(fault.id.trial);
    }
    return trials;
  }

  core::TestFolder folder_;
  std::string said_;
};

[[noreturn]] void Spin() {
  volatile std::uint64_t count = 0;
  for (;;) count = count + 1;
}

void CrashAt(std::uint64_t trial, std::uint64_t index, int signal) {
  if (index != trial) return;
  std::signal(signal, SIG_DFL);
  raise(signal);
}

class Threads : public Containment, public testing::WithParamInterface<int> {};

TEST_P(Threads, CrashingTrialsBecomeFaultsWithAReplayLine) {
  const auto hook = [](std::uint64_t index) {
    CrashAt(7, index, SIGSEGV);
    CrashAt(8, index, SIGABRT);
    CrashAt(39, index, SIGFPE);
  };
  EXPECT_EQ(Run(hook, {.threads = GetParam()}), Outcome::kDone);
  const std::vector<truth::Record> records = Records();
  ASSERT_EQ(records.size(), static_cast<std::size_t>(kTrials)) << "planned = completed + faulted";
  for (const auto& [trial, signal] :
       {std::pair(7, "SIGSEGV"), std::pair(8, "SIGABRT"), std::pair(39, "SIGFPE")}) {
    const truth::Record& record = records[static_cast<std::size_t>(trial)];
    EXPECT_TRUE(truth::IsFault(record));
    EXPECT_THAT(record.detail, core::Says(signal, "seed 1, trial " + std::to_string(trial),
                                          "rockyard replay " + folder_.path().string() +
                                              " --trial " + std::to_string(trial)));
    EXPECT_THAT(said_, HasSubstr(signal));
  }
  EXPECT_EQ(Good().size(), static_cast<std::size_t>(kTrials) - 3);
}

INSTANTIATE_TEST_SUITE_P(OneAndMore, Threads, testing::Values(1, 2, 5));

TEST_F(Containment, CrashesAreTheSameRecordsWhateverThreads) {
  const auto hook = [](std::uint64_t index) { CrashAt(11, index, SIGSEGV); };
  Run(hook, {.threads = 1});
  const std::string one = batch::TrialHash(Records());
  std::filesystem::remove_all(folder_.path());
  Run(hook, {.threads = 3});
  EXPECT_EQ(batch::TrialHash(Records()), one);
}

TEST_F(Containment, KilledFromOutsideChangesNoRecord) {
  const std::filesystem::path once = folder_.path() / "once";
  const auto hook = [&](std::uint64_t index) {
    if (index == 20 && std::filesystem::create_directory(once)) raise(SIGKILL);
  };
  EXPECT_EQ(Run(hook, {.threads = 2}), Outcome::kDone);
  EXPECT_EQ(Good().size(), static_cast<std::size_t>(kTrials));
  EXPECT_TRUE(WithMachineFault("killed").contains(20));
}

TEST_F(Containment, HangingTrialIsLeftPendingAndResumed) {
  const auto hang = [](std::uint64_t index) {
    if (index == 3) Spin();
  };
  const ContainmentOptions options{.trial_cpu_limit_s = 0.3, .threads = 2};
  EXPECT_EQ(Run(hang, options), Outcome::kFailed);
  EXPECT_EQ(Good().size(), static_cast<std::size_t>(kTrials) - 1);
  EXPECT_FALSE(Good().contains(3));
  EXPECT_EQ(WithMachineFault("cpu_time_limit"), std::set<std::int64_t>{3});
  EXPECT_THAT(said_, core::Says("trial 3: is pending",
                                "rockyard replay " + folder_.path().string() + " --trial 3"));
  EXPECT_EQ(Run({}, options), Outcome::kDone);
  EXPECT_EQ(Good().size(), static_cast<std::size_t>(kTrials));
}

TEST_F(Containment, WithoutLimitASlowTrialIsWaitedFor) {
  const auto slow = [](std::uint64_t index) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(900);
    while (index == 3 && std::chrono::steady_clock::now() < end) continue;
  };
  EXPECT_EQ(Run(slow, {.trial_cpu_limit_s = 0.0, .threads = 2}), Outcome::kDone);
  EXPECT_EQ(Good().size(), static_cast<std::size_t>(kTrials));
}

// Whoever goes on after a crash does not tell the result again, nor run trials again for what comes
// after them.
TEST_F(Containment, TheResultIsToldOnce) {
  const std::filesystem::path told = folder_.path() / "told";
  const std::filesystem::path once = folder_.path() / "once";
  const auto die_once = [&] {
    if (std::filesystem::create_directory(once)) raise(SIGKILL);
  };
  const auto body = [&](CampaignProcess& process) {
    const Outcome code = Campaign(process, {});
    if (process.reported()) return code;
    if (!std::filesystem::create_directory(told)) return Outcome::kDiffers;  // told before
    process.SetReported();
    die_once();
    return code;
  };
  const auto afterwards = [&](CampaignProcess& process) {
    return process.Afterwards([&](const batch::Mission& mission, batch::FlightLog&) {
      if (mission.task == batch::Mission::Task::kGoOn) return Outcome::kDone;
      raise(SIGKILL);
      return Outcome::kFailed;
    });
  };
  EXPECT_EQ(RunParts({.threads = 2}, body, afterwards).outcome, Outcome::kDone);
  EXPECT_TRUE(std::filesystem::exists(told));
  EXPECT_EQ(Good().size(), static_cast<std::size_t>(kTrials));
}

// What the supervisor is for: without it the same crash ends the process.
TEST_F(Containment, WithoutSupervisorACrashEndsTheProcess) {
  const auto run = [&](const FakeExperiment::Hook& hook) {
    const ContainmentOptions options{.supervisor = false, .trial_cpu_limit_s = 0.2, .threads = 1};
    const Observer console{.problems = [](const std::vector<core::Problem>& problems) {
      for (const core::Problem& problem : problems) {
        std::cerr << problem.path << ": " << problem.reason << "\n";
      }
    }};
    const CampaignPart body = [&](CampaignProcess& process) { return Campaign(process, hook); };
    return static_cast<int>(RunParts(options, body, {}, console).outcome);
  };
  const auto crash = [](std::uint64_t index) { CrashAt(30, index, SIGSEGV); };
  EXPECT_EXIT(run(crash), testing::KilledBySignal(SIGSEGV), "");
  const auto hang = [](std::uint64_t index) {
    if (index == 31) Spin();
  };
  EXPECT_EXIT(run(hang), testing::ExitedWithCode(5), "trial 31: used more CPU time");
}

}  // namespace
}  // namespace rockyard::campaign
