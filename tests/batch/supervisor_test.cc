// A worker that crashes, is killed or hangs, and what the supervisor makes of it. The workers are
// forked from this process and note what they do in shared memory.
#include "batch/supervisor.h"

#include <gmock/gmock.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <functional>
#include <thread>

#include "batch/flight_log.h"
#include "core/wait_until.h"

namespace rockyard::batch {
namespace {

using Task = Mission::Task;
using testing::HasSubstr;

constexpr int kTrials = 12;

// What processes leave behind: a store of the poor.
struct Board {
  std::atomic<int> runs[kTrials];  // of each trial, begun
  std::atomic<bool> stored[kTrials];
  std::atomic<int> faults[kTrials];  // stored as simulator faults
  std::atomic<int> machine_faults[kTrials];
  std::atomic<LeftOut::Why> why[kTrials];  // left out
  std::atomic<int> workers;                // begun
};

class SupervisorTest : public testing::Test {
 protected:
  using Hook = std::function<void(int trial)>;  // in the trial

  SupervisorTest()
      : board_(new (mmap(nullptr, sizeof(Board), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS,
                         -1, 0)) Board{}) {}
  ~SupervisorTest() override { munmap(board_, sizeof(Board)); }

  // Runs trials on two threads, as a campaign does.
  int Supervised(const Hook& hook) {
    const Worker worker = [&](const Mission& mission) {
      const int code = Work(mission, hook);
      return HasFailure() ? 99 : code;  // what fails in the worker is not seen here otherwise
    };
    return Supervise(log_, worker, {}, [&](const std::string& text) { notes_ += text + "\n"; });
  }

  int Work(const Mission& mission, const Hook& hook) {
    const Watchdog watchdog(log_, {.cpu_limit_s = 0.2, .look_every = kTick, .grace = kTick},
                            [](const std::vector<Flight>&) { _exit(kOverdueExit); });
    const auto trial = static_cast<int>(mission.trial.trial);
    switch (mission.task) {
      case Task::kStoreFault:
        EXPECT_THAT(mission.reason, testing::AnyOf(HasSubstr("SIG"), HasSubstr("exit code 0")));
        board_->stored[trial] = true;
        ++board_->faults[trial];
        return 0;
      case Task::kStoreHang:
        if (!foreign_) return 0;
        board_->stored[trial] = true;
        ++board_->faults[trial];
        log_.SetStored(1);
        return 0;
      case Task::kStoreMachineFault:
        ++board_->machine_faults[trial];
        return 0;
      case Task::kRunAlone:
        RunTrial(trial, hook);
        return 0;
      case Task::kBegin:
      case Task::kGoOn:
        return RunAll(mission, hook);
    }
    return 1;
  }

  int RunAll(const Mission& mission, const Hook& hook) {
    ++board_->workers;
    EXPECT_EQ(mission.task == Task::kGoOn, log_.opened());
    log_.SetOpened();
    std::atomic<int> next = 0;
    const auto loop = [&] {
      for (int trial = next++; trial < kTrials; trial = next++) {
        const bool left_out =
            std::any_of(mission.left_out.begin(), mission.left_out.end(), [&](const LeftOut& left) {
              return left.id == TrialId{0, trial};
            });
        for (const LeftOut& left : mission.left_out) board_->why[left.id.trial] = left.why;
        if (!log_.stop() && !board_->stored[trial] && !left_out) RunTrial(trial, hook);
      }
    };
    std::thread other(loop);
    loop();
    other.join();
    return mission.left_out.empty() ? 0 : 5;
  }

  void RunTrial(int trial, const Hook& hook) {
    const int slot = log_.Begin({0, trial});
    ++board_->runs[trial];
    hook(trial);
    board_->stored[trial] = true;
    log_.SetStored(Stored());
    log_.End(slot);
  }

  int Stored() const {
    return static_cast<int>(std::count(board_->stored, board_->stored + kTrials, true));
  }
  static int Sum(const std::atomic<int> (&counts)[kTrials]) {
    int sum = 0;
    for (const std::atomic<int>& count : counts) sum += count;
    return sum;
  }

  static constexpr std::chrono::milliseconds kTick{20};
  FlightLog log_;
  Board* board_;
  bool foreign_ = false;  // whether a plugin decides
  std::string notes_;
};

[[noreturn]] void Spin() {
  volatile std::uint64_t count = 0;
  for (;;) count = count + 1;
}

void Crash(int signal = SIGSEGV) {
  std::signal(signal, SIG_DFL);
  raise(signal);
}

TEST_F(SupervisorTest, WithoutCrashOneWorkerDoesAll) {
  EXPECT_EQ(Supervised([](int) {}), 0);
  EXPECT_EQ(Stored(), kTrials);
  EXPECT_EQ(board_->workers, 1);
  EXPECT_EQ(Sum(board_->runs), kTrials);
  EXPECT_EQ(Sum(board_->faults) + Sum(board_->machine_faults), 0);
  EXPECT_EQ(notes_, "");
}

TEST_F(SupervisorTest, ExitCodePassesThrough) {
  const Worker worker = [](const Mission&) { return 3; };
  EXPECT_EQ(Supervise(log_, worker, {}, [](const std::string&) {}), 3);
}

// Every signal by which a simulator dies by itself.
class CrashingTrial : public SupervisorTest, public testing::WithParamInterface<int> {};

TEST_P(CrashingTrial, BecomesAFaultAndTheOthersGoOn) {
  EXPECT_EQ(Supervised([](int trial) {
              if (trial == 5) Crash(GetParam());
            }),
            0);
  EXPECT_EQ(Stored(), kTrials);
  EXPECT_EQ(board_->faults[5], 1);
  EXPECT_EQ(Sum(board_->faults), 1);
  EXPECT_EQ(board_->runs[5], 2) << "once with others, once alone";
  EXPECT_EQ(board_->workers, 2);
  EXPECT_THAT(notes_, HasSubstr(SignalText(GetParam())));
}

INSTANTIATE_TEST_SUITE_P(Signals, CrashingTrial, testing::Values(SIGSEGV, SIGABRT, SIGFPE, SIGBUS));

TEST_F(SupervisorTest, EveryTrialMayCrash) {
  EXPECT_EQ(Supervised([](int) { Crash(); }), 0);
  EXPECT_EQ(Sum(board_->faults), kTrials);
}

// Work with no place for a fault: the trial comes back as left out, and nothing is to be stored.
TEST_F(SupervisorTest, WithoutAPlaceForFaultsCrashesAreLeftOut) {
  const auto crash = [](int trial) {
    if (trial == 5) Crash();
  };
  const Worker worker = [&](const Mission& mission) { return Work(mission, crash); };
  EXPECT_EQ(Supervise(log_, worker, {.faults_are_stored = false}, [](const std::string&) {}), 5);
  EXPECT_EQ(Stored(), kTrials - 1);
  EXPECT_EQ(Sum(board_->faults) + Sum(board_->machine_faults), 0);
  EXPECT_EQ(board_->runs[5], 2) << "once with others, once alone";
  EXPECT_EQ(board_->why[5], LeftOut::Why::kCrashes);
}

// What no trial is to blame for: it was killed from outside, or found the machine short.
class EndFromOutside : public SupervisorTest, public testing::WithParamInterface<bool> {
 protected:
  static void End() {
    if (GetParam()) _exit(kShortExit);
    raise(SIGKILL);
  }
};

INSTANTIATE_TEST_SUITE_P(Ends, EndFromOutside, testing::Bool(),
                         [](const auto& end) { return end.param ? "Short" : "Killed"; });

// A trial that does not fit into this machine may fit into another one.
TEST_P(EndFromOutside, EachTimeLeavesItPending) {
  EXPECT_EQ(Supervised([](int trial) {
              if (trial == 4) End();
            }),
            5);
  EXPECT_EQ(Stored(), kTrials - 1);
  EXPECT_FALSE(board_->stored[4]);
  EXPECT_EQ(Sum(board_->faults), 0);
  EXPECT_EQ(board_->runs[4], 4) << "once with others, three times alone";
  EXPECT_EQ(board_->machine_faults[4], 3);
  EXPECT_EQ(board_->why[4], LeftOut::Why::kIsKilled);
}

// One crash can be the machine's.
TEST_F(SupervisorTest, HungThenCrashedOnceIsNoFault) {
  EXPECT_EQ(Supervised([&](int trial) {
              if (trial == 7 && board_->runs[7] == 1) Spin();
              if (trial == 7 && board_->runs[7] == 2) Crash();
            }),
            0);
  EXPECT_EQ(Stored(), kTrials);
  EXPECT_EQ(Sum(board_->faults), 0);
  EXPECT_EQ(board_->machine_faults[7], 2);
}

TEST_F(SupervisorTest, HungThenCrashedTwiceIsAFault) {
  EXPECT_EQ(Supervised([&](int trial) {
              if (trial == 7 && board_->runs[7] == 1) Spin();
              if (trial == 7) Crash();
            }),
            0);
  EXPECT_EQ(board_->faults[7], 1);
  EXPECT_EQ(board_->runs[7], 3);
}

TEST_P(EndFromOutside, ThenCrashedOnceIsNoFault) {
  EXPECT_EQ(Supervised([&](int trial) {
              if (trial == 4 && board_->runs[4] == 1) End();
              if (trial == 4 && board_->runs[4] == 2) Crash();
            }),
            0);
  EXPECT_EQ(Sum(board_->faults), 0);
  EXPECT_TRUE(board_->stored[4]);
}

TEST_P(EndFromOutside, OnceLeavesNoSimulatorFault) {
  EXPECT_EQ(Supervised([&](int trial) {
              if (trial == 4 && board_->runs[4] == 1) End();
            }),
            0);
  EXPECT_EQ(Stored(), kTrials);
  EXPECT_EQ(Sum(board_->faults), 0);
  EXPECT_GE(board_->machine_faults[4], 1);
  EXPECT_THAT(notes_, HasSubstr(GetParam() ? "short of memory, files or disk" : "SIGKILL"));
}

// The out-of-memory killer or a person may meet the trial that runs alone, too.
TEST_P(EndFromOutside, TwiceIsNoFaultEither) {
  EXPECT_EQ(Supervised([&](int trial) {
              if (trial == 4 && board_->runs[4] <= 2) End();
            }),
            0);
  EXPECT_EQ(Sum(board_->faults), 0);
  EXPECT_TRUE(board_->stored[4]);
  EXPECT_EQ(board_->machine_faults[4], 2);
}

TEST_F(SupervisorTest, HangingTrialIsTriedAgainAndLeftOut) {
  EXPECT_EQ(Supervised([](int trial) {
              if (trial == 7) Spin();
            }),
            5);
  EXPECT_EQ(Stored(), kTrials - 1);
  EXPECT_FALSE(board_->stored[7]);
  EXPECT_EQ(Sum(board_->faults), 0);
  EXPECT_EQ(board_->runs[7], 3) << "once with others, twice alone";
  EXPECT_EQ(board_->machine_faults[7], 3);
}

TEST_F(SupervisorTest, TrialOfAPluginThatHangsTwiceIsAFault) {
  foreign_ = true;
  const int code = Supervised([](int trial) {
    if (trial == 3) Spin();
  });
  EXPECT_EQ(code, 0);
  EXPECT_EQ(board_->runs[3], 2) << "once with the others, once alone";
  EXPECT_EQ(board_->faults[3], 1);
  EXPECT_EQ(Sum(board_->faults), 1);
  EXPECT_EQ(Stored(), kTrials);
}

// As code of a plugin does that calls exit(): the campaign has not ended, whatever the exit code
// says.
TEST_F(SupervisorTest, EndingInTheMiddleOfTheWorkCountsAsACrash) {
  const int code = Supervised([](int trial) {
    if (trial == 3) _exit(0);
  });
  EXPECT_EQ(code, 0);
  EXPECT_EQ(board_->faults[3], 1);
  EXPECT_EQ(Sum(board_->faults), 1);
  EXPECT_EQ(Stored(), kTrials);
}

TEST_F(SupervisorTest, HangingOnceIsForgiven) {
  EXPECT_EQ(Supervised([&](int trial) {
              if (trial == 7 && board_->runs[7] == 1) Spin();
            }),
            0);
  EXPECT_EQ(Stored(), kTrials);
  EXPECT_EQ(board_->machine_faults[7], 1);
}

TEST_F(SupervisorTest, SleepIsNoHang) {
  EXPECT_EQ(Supervised([](int trial) {
              if (trial == 7) std::this_thread::sleep_for(std::chrono::milliseconds(600));
            }),
            0);
  EXPECT_EQ(board_->workers, 1);
}

TEST_F(SupervisorTest, WorkerThatDiesWithoutTrialsIsGivenUp) {
  int exit_code = 0;
  const Worker worker = [&](const Mission&) {
    ++board_->workers;
    raise(SIGABRT);
    return 0;
  };
  exit_code = Supervise(log_, worker, {.fruitless_restarts = 2},
                        [&](const std::string& text) { notes_ += text; });
  EXPECT_EQ(exit_code, 5);
  EXPECT_EQ(board_->workers, 3);
  EXPECT_THAT(notes_, HasSubstr("giving up"));
}

// Trials that end, but never reach the store, are no progress.
TEST_F(SupervisorTest, WorkerThatStoresNothingIsGivenUp) {
  const Worker worker = [&](const Mission&) {
    ++board_->workers;
    log_.End(log_.Begin({0, 3}));
    raise(SIGABRT);
    return 0;
  };
  EXPECT_EQ(Supervise(log_, worker, {.fruitless_restarts = 2}, [](const std::string&) {}), 5);
  EXPECT_EQ(board_->workers, 3);
}

TEST_F(SupervisorTest, WorkerThatStoresIsNotGivenUp) {
  const Worker worker = [&](const Mission&) {
    if (++board_->workers == 8) return 0;
    log_.SetStored(1);
    raise(SIGABRT);
    return 0;
  };
  EXPECT_EQ(Supervise(log_, worker, {.fruitless_restarts = 2}, [](const std::string&) {}), 0);
  EXPECT_EQ(board_->workers, 8);
}

// A trial whose fault cannot be stored would crash for ever.
TEST_F(SupervisorTest, CrashWhileStoringFaultsIsGivenUp) {
  const Worker worker = [&](const Mission& mission) {
    ++board_->workers;
    if (mission.task != Task::kStoreFault) log_.Begin({0, 3});
    raise(SIGSEGV);
    return 0;
  };
  const int exit_code =
      Supervise(log_, worker, {}, [&](const std::string& text) { notes_ += text; });
  EXPECT_EQ(exit_code, 5);
  EXPECT_EQ(board_->workers, 4) << "campaign, alone, fault, fault again";
  EXPECT_THAT(notes_, HasSubstr("stores faults"));
}

// What ends the process that stores a fault once may come from outside.
TEST_F(SupervisorTest, AFaultGetsASecondTryToBeStored) {
  const Worker worker = [&](const Mission& mission) {
    ++board_->workers;
    if (mission.task == Task::kGoOn) return 0;
    if (mission.task == Task::kStoreFault && ++board_->faults[3] == 2) return 0;
    log_.SetOpened();
    if (mission.task != Task::kStoreFault) log_.Begin({0, 3});
    raise(mission.task == Task::kStoreFault ? SIGKILL : SIGSEGV);
    return 0;
  };
  const int exit_code =
      Supervise(log_, worker, {}, [&](const std::string& text) { notes_ += text; });
  EXPECT_EQ(exit_code, 0);
  EXPECT_EQ(board_->faults[3], 2);
  EXPECT_EQ(board_->workers, 5) << "campaign, alone, fault, fault again, campaign";
}

// Polite signals reach the worker, which ends by itself and is not started again.
TEST_F(SupervisorTest, PoliteSignalReachesTheWorker) {
  const pid_t supervisor = getpid();
  const Worker worker = [&](const Mission&) {
    ++board_->workers;
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGTERM);
    sigprocmask(SIG_BLOCK, &set, nullptr);
    kill(supervisor, SIGINT);
    int signal = 0;
    sigwait(&set, &signal);
    return signal == SIGTERM ? 130 : 1;
  };
  EXPECT_EQ(Supervise(log_, worker, {}, [](const std::string&) {}), 130);
  EXPECT_EQ(board_->workers, 1);
}

// What a worker says of a hang is nothing for the user.
TEST_F(SupervisorTest, PoliteSignalDuringAHangIsAnInterruption) {
  const pid_t supervisor = getpid();
  const Worker worker = [&](const Mission&) {
    std::signal(SIGTERM, SIG_IGN);
    kill(supervisor, SIGINT);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    return kOverdueExit;
  };
  EXPECT_EQ(Supervise(log_, worker, {}, [](const std::string&) {}), 130);
}

// Between a look at the clock of a trial and the mark the trial may end, and another one begin.
TEST_F(SupervisorTest, TrialThatFollowsAnOverdueOneIsNotMarked) {
  int slot = log_.Begin({0, 1});
  const auto late = [&](clockid_t) {
    log_.End(slot);
    slot = log_.Begin({0, 2});
    return std::int64_t{1} << 60;
  };
  EXPECT_FALSE(log_.MarkOverdue(1.0, late));
  ASSERT_EQ(log_.Flights().size(), 1U);
  EXPECT_EQ(log_.Flights()[0].id, (TrialId{0, 2})) << "in the same slot";
  EXPECT_FALSE(log_.Flights()[0].overdue);
  EXPECT_TRUE(log_.MarkOverdue(1.0, [](clockid_t) { return std::int64_t{1} << 60; }));
  log_.End(slot);
  EXPECT_TRUE(log_.Flights().empty());
}

TEST_F(SupervisorTest, SecondSignalKills) {
  const pid_t supervisor = getpid();
  const Worker worker = [&](const Mission&) {
    std::signal(SIGTERM, SIG_IGN);
    for (;;) {  // signals that come close together are one wish
      kill(supervisor, SIGINT);
      std::this_thread::sleep_for(std::chrono::milliseconds(800));
    }
    return 0;
  };
  EXPECT_EQ(Supervise(log_, worker, {}, [](const std::string&) {}), 130);
}

// A worker without supervisor would hold the folder, unseen.
TEST_F(SupervisorTest, WorkerDiesWithItsSupervisor) {
  std::atomic<int>& process = board_->runs[0];
  const pid_t supervisor = fork();
  if (supervisor == 0) {
    const Worker worker = [&](const Mission&) {
      process = getpid();
      std::this_thread::sleep_for(std::chrono::hours(1));
      return 0;
    };
    _exit(Supervise(log_, worker, {}, [](const std::string&) {}));
  }
  ASSERT_TRUE(core::WaitUntil([&] { return process != 0; }));
  EXPECT_TRUE(core::Alive(process));
  kill(supervisor, SIGKILL);
  waitpid(supervisor, nullptr, 0);
  EXPECT_TRUE(core::WaitForEnd(process));
}

}  // namespace
}  // namespace rockyard::batch
