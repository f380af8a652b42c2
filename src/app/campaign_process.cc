#include "app/campaign_process.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <deque>
#include <string>
#include <utility>

#include "app/console.h"
#include "app/guard.h"
#include "app/interrupt.h"
#include "app/rank_service.h"
#include "batch/batch_session.h"
#include "batch/distributed.h"
#include "batch/leaving_out.h"
#include "batch/logged_experiment.h"
#include "batch/watchdog.h"

namespace rockyard::app {
namespace {

using batch::CellWork;
using batch::Flight;
using batch::Mission;
using Task = Mission::Task;

// Experiments that note their trials in the log.
class LoggedWork {
 public:
  LoggedWork(std::span<const CellWork> work, batch::FlightLog& log) {
    for (const CellWork& cell : work) {
      const auto& logged =
          experiments_.emplace_back(*cell.experiment, static_cast<int>(work_.size()), log);
      work_.push_back({&logged, cell.seed});
    }
  }

  std::span<const CellWork> work() const { return work_; }

 private:
  std::deque<batch::LoggedExperiment> experiments_;
  std::vector<CellWork> work_;
};

std::string CellPart(const batch::ResultStore& store, int cell) {
  const std::string& name = store.identity().cells[static_cast<std::size_t>(cell)].name;
  return name.empty() ? std::string() : fmt::format(" --cell {}", name);
}

std::uint64_t SeedOf(const batch::ResultStore& store, int cell) {
  return store.identity().cells[static_cast<std::size_t>(cell)].seed;
}

// Without a supervisor that would try again.
[[noreturn]] void EndOverdue(const batch::ResultStore& store, const std::vector<Flight>& overdue) {
  std::vector<core::Problem> problems;
  problems.reserve(overdue.size());
  for (const Flight& flight : overdue) {
    problems.push_back({fmt::format("trial {}", flight.id.trial),
                        "used more CPU time than --trial-cpu-limit, and is pending",
                        ReplayLine(store, flight.id)});
  }
  PrintProblems(problems);
  _exit(static_cast<int>(ExitCode::kFailed));
}

// In this process, which may be rank 0.
ExitCode RunHere(const ContainmentOptions& options, batch::Communicator* communicator,
                 const CampaignPart& body) {
  batch::FlightLog log;
  const Mission mission;
  CampaignProcess process(options, mission, log, communicator);
  return Guarded([&] { return body(process); });
}

ExitCode RunSupervised(const ContainmentOptions& options, const CampaignPart& body,
                       batch::SupervisorOptions supervisor) {
  batch::FlightLog log;
  const auto work = [&](const Mission& mission) {
    CampaignProcess process(options, mission, log, nullptr);
    return static_cast<int>(Guarded([&] { return body(process); }));
  };
  supervisor.failed_exit = static_cast<int>(ExitCode::kFailed);
  supervisor.interrupted_exit = static_cast<int>(ExitCode::kInterrupted);
  return static_cast<ExitCode>(
      batch::Supervise(log, work, supervisor, [](const std::string& text) { PrintNote(text); }));
}

// `run` is called with each part that is to be run, and with what its supervisor is told.
ExitCode RunParts(
    const CampaignPart& body, const CampaignPart& afterwards,
    const std::function<ExitCode(const CampaignPart&, const batch::SupervisorOptions&)>& run) {
  const ExitCode code = run(body, {});
  const bool all_trials = code == ExitCode::kDone || code == ExitCode::kTooManyFaults;
  if (!all_trials || !afterwards) return code;
  const ExitCode after = run(afterwards, {.faults_are_stored = false, .fruit = "writing a trace"});
  return after == ExitCode::kDone ? code : after;
}

ExitCode RunOnRanks(ContainmentOptions& options, const batch::Launch& launch,
                    const CampaignPart& body, const CampaignPart& afterwards) {
  if (options.threads == 0) {
    options.threads = std::max(batch::ThreadCount({}) / launch.local_ranks, 1);
  }
  const std::unique_ptr<batch::Communicator> communicator = batch::StartMpi();
  if (communicator->rank() != 0) {
    return ServeRankZero(*communicator, options.threads, options.trial_cpu_limit_s);
  }
  const ExitCode code = RunParts(body, afterwards, [&](const CampaignPart& part, const auto&) {
    return RunHere(options, communicator.get(), part);
  });
  EndRanks(*communicator, code);
  return code;
}

}  // namespace

std::string ReplayLine(const batch::ResultStore& store, batch::TrialId id) {
  return fmt::format("rockyard replay {}{} --trial {}", store.path().parent_path().string(),
                     CellPart(store, id.cell), id.trial);
}

CampaignProcess::CampaignProcess(const ContainmentOptions& options, const Mission& mission,
                                 batch::FlightLog& log, batch::Communicator* communicator)
    : options_(options), mission_(mission), log_(log), communicator_(communicator) {}

batch::BatchResult CampaignProcess::RunTrials(std::span<const CellWork> work,
                                              batch::ResultStore& store,
                                              batch::BatchOptions options,
                                              const batch::ProgressReport& report) {
  options.threads = options_.threads;
  log_.SetOpened();
  const LoggedWork logged(work, log_);
  const bool supervised = options_.supervisor && communicator_ == nullptr;
  const batch::Watchdog watchdog(log_, {.cpu_limit_s = options_.trial_cpu_limit_s},
                                 [&](const std::vector<Flight>& overdue) {
                                   if (supervised) _exit(batch::kOverdueExit);
                                   EndOverdue(store, overdue);
                                 });
  const InterruptGuard interrupt(log_.stop(),
                                 alone() ? SecondSignal::kEnds : SecondSignal::kIsTheSame);
  const auto note = [&](const batch::Progress& progress) {
    log_.SetStored(progress.stored);
    if (report) report(progress);
  };
  batch::BatchSession session(store, options, log_.stop(), note);
  const int threads = batch::ThreadCount(options);
  if (communicator_ != nullptr) {
    StartRanks(*communicator_, store.identity());
    batch::RunTrialsOnRanks(*communicator_, logged.work(), session.source(), threads);
  } else {
    std::vector<batch::TrialId> left_out;
    for (const batch::LeftOut& left : mission_.left_out) left_out.push_back(left.id);
    batch::LeavingOutSource source(session.source(), std::move(left_out));
    batch::RunTrials(logged.work(), source, threads);
  }
  batch::BatchResult result = session.Close();
  // The overdue trial has ended after all, and the stop was not the user's wish.
  if (watchdog.bit() && supervised) _exit(batch::kOverdueExit);
  return result;
}

ExitCode CampaignProcess::Afterwards(
    const std::function<ExitCode(const Mission& mission, batch::FlightLog& log)>& work) {
  log_.SetOpened();
  const InterruptGuard interrupt(log_.stop(),
                                 alone() ? SecondSignal::kEnds : SecondSignal::kIsTheSame);
  return work(mission_, log_);
}

ExitCode CampaignProcess::DoTask(std::span<const CellWork> work, batch::ResultStore& store) {
  const batch::TrialId id = mission_.trial;
  if (mission_.task == Task::kStoreMachineFault) {
    store.AddInfrastructureFault({id, mission_.kind, mission_.reason});
    return ExitCode::kDone;
  }
  batch::CellRecord record{id.cell, {}};
  if (mission_.task == Task::kStoreFault) {
    const std::string reason = fmt::format("{}; see `{}`", mission_.reason, ReplayLine(store, id));
    record.record = truth::MakeFault(SeedOf(store, id.cell), id.trial, reason);
  } else {
    const LoggedWork logged(work, log_);
    // No other trial is to be stored meanwhile.
    const batch::WatchdogOptions limits{.cpu_limit_s = options_.trial_cpu_limit_s,
                                        .grace = std::chrono::milliseconds(0)};
    const batch::Watchdog watchdog(log_, limits, [](const auto&) { _exit(batch::kOverdueExit); });
    record = batch::RunTrial(logged.work(), id);
  }
  store.Append(std::span(&record, 1));
  return ExitCode::kDone;
}

bool CampaignProcess::TellLeftOut(const batch::ResultStore& store) const {
  std::vector<core::Problem> problems;
  problems.reserve(mission_.left_out.size());
  for (const auto& [id, why] : mission_.left_out) {
    const std::string trial = fmt::format("trial {}{}", id.trial, CellPart(store, id.cell));
    if (why == batch::LeftOut::Why::kIsKilled) {
      problems.push_back(
          {trial, "is pending: each time it was tried its process was killed",
           fmt::format("--resume with more memory, or `{}`", ReplayLine(store, id))});
      continue;
    }
    problems.push_back(
        {trial,
         fmt::format("is pending: each time it was tried it used more than {} s of CPU time",
                     options_.trial_cpu_limit_s),
         fmt::format("`{}`, or --resume with a larger --trial-cpu-limit", ReplayLine(store, id))});
  }
  PrintProblems(problems);
  return !problems.empty();
}

ExitCode RunContained(ContainmentOptions options, const CampaignPart& body,
                      const CampaignPart& afterwards) {
  if (const std::optional<batch::Launch> launch = batch::FindLaunch()) {
    return RunOnRanks(options, *launch, body, afterwards);
  }
  return RunParts(body, afterwards,
                  [&](const CampaignPart& part, const batch::SupervisorOptions& supervisor) {
                    return options.supervisor ? RunSupervised(options, part, supervisor)
                                              : RunHere(options, nullptr, part);
                  });
}

}  // namespace rockyard::app
