#include "campaign/campaign_process.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>

#include "batch/batch_session.h"
#include "batch/distributed.h"
#include "batch/leaving_out.h"
#include "batch/watchdog.h"
#include "campaign/heeded_work.h"
#include "campaign/rank_service.h"
#include "campaign/shell_word.h"

namespace rockyard::campaign {
namespace {

using batch::CellWork;
using batch::Flight;
using batch::Mission;
using Task = Mission::Task;

std::string CellPart(const batch::ResultStore& store, int cell) {
  const std::string& name = store.identity().cells[static_cast<std::size_t>(cell)].name;
  return name.empty() ? std::string() : fmt::format(" --cell {}", ShellWord(name));
}

std::uint64_t SeedOf(const batch::ResultStore& store, int cell) {
  return store.identity().cells[static_cast<std::size_t>(cell)].seed;
}

// Without a supervisor that would try again.
void TellOverdue(const batch::ResultStore& store, const std::vector<batch::TrialId>& overdue,
                 Journal& journal) {
  std::vector<core::Problem> problems;
  problems.reserve(overdue.size());
  for (const batch::TrialId& id : overdue) {
    problems.push_back({fmt::format("trial {}{}", id.trial, CellPart(store, id.cell)),
                        "used more CPU time than --trial-cpu-limit, and is pending",
                        ReplayLine(store, id)});
  }
  journal.Fail(problems);
}

// Without a supervisor that would try again, or on a rank, whose end ends all.
[[noreturn]] void EndShort(const batch::ResultStore& store, const batch::TrialId& id,
                           const std::exception& error, Journal& journal) {
  journal.Fail({{fmt::format("trial {}{}", id.trial, CellPart(store, id.cell)),
                 fmt::format("is pending: the machine failed ({})", error.what()),
                 "--resume when it has more memory, files or disk"}});
  _exit(static_cast<int>(Outcome::kFailed));
}

std::chrono::milliseconds Milliseconds(double time_s) {
  return std::chrono::milliseconds(std::llround(1e3 * time_s));
}

// In this process, which may be rank 0.
Outcome RunHere(const ContainmentOptions& options, batch::Communicator* communicator,
                const Contact& contact, const CampaignPart& body) {
  batch::FlightLog log;
  const Mission mission;
  CampaignProcess process(options, mission, log, communicator, contact);
  return Guarded(contact.journal, [&] { return body(process); });
}

Outcome RunSupervised(const ContainmentOptions& options, const Contact& contact,
                      const CampaignPart& body, batch::SupervisorOptions supervisor) {
  batch::FlightLog log;
  const auto work = [&](const Mission& mission) {
    CampaignProcess process(options, mission, log, nullptr, contact);
    return static_cast<int>(Guarded(contact.journal, [&] { return body(process); }));
  };
  supervisor.failed_exit = static_cast<int>(Outcome::kFailed);
  supervisor.interrupted_exit = static_cast<int>(Outcome::kInterrupted);
  return static_cast<Outcome>(batch::Supervise(
      log, work, supervisor, [&](const std::string& text) { contact.journal.Warn(text); }));
}

// `run` is called with each part that is to be run, and with what its supervisor is told.
Outcome RunParts(
    const CampaignPart& body, const CampaignPart& afterwards,
    const std::function<Outcome(const CampaignPart&, const batch::SupervisorOptions&)>& run) {
  const Outcome code = run(body, {});
  const bool all_trials = code == Outcome::kDone || code == Outcome::kTooManyFaults;
  if (!all_trials || !afterwards) return code;
  const Outcome after = run(afterwards, {.faults_are_stored = false, .fruit = "writing a trace"});
  return after == Outcome::kDone ? code : after;
}

Outcome RunOnRanks(ContainmentOptions& options, const batch::Launch& launch, const Contact& contact,
                   const CampaignPart& body, const CampaignPart& afterwards) {
  if (options.threads == 0) {
    options.threads = std::max(batch::ThreadCount({}) / launch.local_ranks, 1);
  }
  const std::unique_ptr<batch::Communicator> communicator = batch::StartMpi();
  if (communicator->rank() != 0) {
    return ServeRankZero(*communicator, options, contact);
  }
  const Outcome code = RunParts(body, afterwards, [&](const CampaignPart& part, const auto&) {
    return RunHere(options, communicator.get(), contact, part);
  });
  EndRanks(*communicator, code, Milliseconds(options.rank_silence_s), contact.journal);
  return code;
}

}  // namespace

bool IsFirstRank() {
  const std::optional<batch::Launch> launch = batch::FindLaunch();
  return !launch || launch->rank == 0;
}

std::string ReplayLine(const batch::ResultStore& store, batch::TrialId id) {
  return fmt::format("rockyard replay {}{} --trial {}",
                     ShellPath(store.path().parent_path().string()), CellPart(store, id.cell),
                     id.trial);
}

CampaignProcess::CampaignProcess(const ContainmentOptions& options, const Mission& mission,
                                 batch::FlightLog& log, batch::Communicator* communicator,
                                 const Contact& contact)
    : options_(options),
      mission_(mission),
      log_(log),
      communicator_(communicator),
      contact_(contact) {}

batch::BatchResult CampaignProcess::RunTrials(std::span<const CellWork> work,
                                              batch::ResultStore& store,
                                              batch::BatchOptions options,
                                              const batch::ProgressReport& report) {
  options.threads = options_.threads;
  const bool supervised = options_.supervisor && communicator_ == nullptr;
  const HeededWork logged(work, log_, contact_.stop,
                          [&](const batch::TrialId& id, const std::exception& error) {
                            if (supervised) _exit(batch::kShortExit);
                            EndShort(store, id, error, contact_.journal);
                          });
  const batch::Watchdog watchdog(log_, {.cpu_limit_s = options_.trial_cpu_limit_s},
                                 [&](const std::vector<Flight>& overdue) {
                                   if (supervised) _exit(batch::kOverdueExit);
                                   if (communicator_ != nullptr)
                                     return overdue_.Tell(batch::TrialsOf(overdue));
                                   TellOverdue(store, batch::TrialsOf(overdue), contact_.journal);
                                   _exit(static_cast<int>(Outcome::kFailed));
                                 });
  const std::shared_ptr<void> watch =
      contact_.stop.Watch(log_.stop(), alone() ? SecondWish::kEnds : SecondWish::kIsTheSame);
  const auto note = [&](const batch::Progress& progress) {
    log_.SetStored(progress.stored);
    AskToStop(contact_.stop, log_);
    if (report) report(progress);
  };
  AskToStop(contact_.stop, log_);
  batch::BatchSession session(store, options, log_.stop(), note);
  const int threads = batch::ThreadCount(options);
  if (communicator_ != nullptr) {
    RunOnRanks(logged.work(), store, session, threads);
  } else {
    std::vector<batch::TrialId> left_out;
    for (const batch::LeftOut& left : mission_.left_out) left_out.push_back(left.id);
    batch::LeavingOutSource source(session.source(), std::move(left_out));
    batch::RunTrials(logged.work(), source, threads);
  }
  batch::BatchResult result = session.Close();
  NoteOverdue(store, overdue_elsewhere_);
  // The overdue trial has ended after all, and the stop was not the user's wish.
  if (watchdog.bit() && supervised) _exit(batch::kOverdueExit);
  late_trial_ = watchdog.bit();
  return result;
}

void CampaignProcess::RunOnRanks(std::span<const CellWork> work, batch::ResultStore& store,
                                 batch::BatchSession& session, int threads) {
  StartRanks(*communicator_, store.identity());
  const batch::RankWatch watch{
      .silence = Milliseconds(options_.rank_silence_s),
      .silent =
          [&](int rank, std::size_t trials) {
            contact_.journal.Warn(
                fmt::format("rank {} has said nothing for {} s (--rank-silence) and is given up; "
                            "others run its {} trials",
                            rank, options_.rank_silence_s, trials));
          },
      .overdue =
          [&](const std::vector<batch::TrialId>& trials) {
            overdue_elsewhere_.insert(overdue_elsewhere_.end(), trials.begin(), trials.end());
          }};
  batch::RunTrialsOnRanks(*communicator_, work, session.source(), threads, watch, overdue_,
                          [&](const std::vector<batch::TrialId>& trials) {
                            session.Close();
                            NoteOverdue(store, trials);
                            NoteOverdue(store, overdue_elsewhere_);
                            TellOverdue(store, trials, contact_.journal);
                            communicator_->Abort(static_cast<int>(Outcome::kFailed));
                          });
}

void CampaignProcess::NoteOverdue(batch::ResultStore& store,
                                  const std::vector<batch::TrialId>& trials) {
  for (const batch::TrialId& id : trials) {
    store.AddInfrastructureFault({id, batch::kOverdueKind, batch::kOverdueReason});
  }
}

Outcome CampaignProcess::Afterwards(
    const std::function<Outcome(const Mission& mission, batch::FlightLog& log)>& work) {
  SetOpened();
  const std::shared_ptr<void> watch =
      contact_.stop.Watch(log_.stop(), alone() ? SecondWish::kEnds : SecondWish::kIsTheSame);
  return work(mission_, log_);
}

Outcome CampaignProcess::DoTask(std::span<const CellWork> work, batch::ResultStore& store) {
  const batch::TrialId id = mission_.trial;
  if (mission_.task == Task::kStoreMachineFault) {
    store.AddInfrastructureFault({id, mission_.kind, mission_.reason});
    return Outcome::kDone;
  }
  batch::CellRecord record{id.cell, {}};
  if (mission_.task == Task::kStoreFault) {
    const std::string reason = fmt::format("{}; see `{}`", mission_.reason, ReplayLine(store, id));
    record.record = truth::MakeFault(SeedOf(store, id.cell), id.trial, reason);
  } else {
    const HeededWork logged(work, log_, contact_.stop,
                            [](const auto&, const auto&) { _exit(batch::kShortExit); });
    // No other trial is to be stored meanwhile.
    const batch::WatchdogOptions limits{.cpu_limit_s = options_.trial_cpu_limit_s,
                                        .grace = std::chrono::milliseconds(0)};
    const batch::Watchdog watchdog(log_, limits, [](const auto&) { _exit(batch::kOverdueExit); });
    record = batch::RunTrial(logged.work(), id);
  }
  store.Append(std::span(&record, 1));
  return Outcome::kDone;
}

bool CampaignProcess::TellLeftOut(const batch::ResultStore& store) const {
  std::vector<core::Problem> problems;
  std::vector<batch::LeftOut> left_out = mission_.left_out;
  for (const batch::TrialId& id : overdue_elsewhere_) left_out.push_back({id});
  problems.reserve(left_out.size());
  for (const auto& [id, why] : left_out) {
    const std::string trial = fmt::format("trial {}{}", id.trial, CellPart(store, id.cell));
    if (why == batch::LeftOut::Why::kIsKilled) {
      problems.push_back(
          {trial,
           "is pending: each time it was tried its process was killed, or short of memory, files "
           "or disk",
           fmt::format("--resume with more of them, or `{}`", ReplayLine(store, id))});
      continue;
    }
    problems.push_back(
        {trial,
         fmt::format("is pending: each time it was tried it used more than {} s of CPU time",
                     options_.trial_cpu_limit_s),
         fmt::format("`{}`, or --resume with a larger --trial-cpu-limit", ReplayLine(store, id))});
  }
  contact_.journal.Fail(problems);
  return !problems.empty();
}

Outcome RunContained(ContainmentOptions options, const Contact& contact, const CampaignPart& body,
                     const CampaignPart& afterwards) {
  if (const std::optional<batch::Launch> launch = batch::FindLaunch()) {
    return RunOnRanks(options, *launch, contact, body, afterwards);
  }
  return RunParts(body, afterwards,
                  [&](const CampaignPart& part, const batch::SupervisorOptions& supervisor) {
                    return options.supervisor ? RunSupervised(options, contact, part, supervisor)
                                              : RunHere(options, nullptr, contact, part);
                  });
}

}  // namespace rockyard::campaign
