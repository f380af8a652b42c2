#include "campaign/campaign_process.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "batch/batch_session.h"
#include "batch/communicator.h"
#include "batch/distributed.h"
#include "batch/flight_log.h"
#include "batch/supervisor.h"
#include "campaign/output_folder.h"
#include "campaign/run_source.h"
#include "core/error.h"
#include "core/hash.h"
#include "core/json_text.h"
#include "experiments/make_experiment.h"
#include "scenario/load.h"
#include "truth/end_cause.h"

namespace rockyard::campaign {
namespace {

// Tags of messages and what each message holds. Must differ from those of batch/distributed.cc,
// which are below 10.
constexpr int kCampaign = 10;  // build, then of each cell: fingerprint, resolved scenario, seed
constexpr int kEnd = 11;       // outcome
constexpr int kEnds = 12;      // to rank 0, in answer

constexpr std::chrono::milliseconds kPause{2};

void SendToAll(batch::Communicator& communicator, int tag, const std::string& bytes) {
  for (int rank = 1; rank < communicator.size(); ++rank) {
    if (!communicator.given_up().contains(rank)) communicator.Send(rank, tag, bytes);
  }
}

// Returns the ranks that have not said within `silence` that they end.
std::set<int> RanksThatStay(batch::Communicator& communicator, std::chrono::milliseconds silence) {
  std::set<int> ranks;
  for (int rank = 1; rank < communicator.size(); ++rank) {
    if (!communicator.given_up().contains(rank)) ranks.insert(rank);
  }
  const auto start = std::chrono::steady_clock::now();
  while (!ranks.empty()) {
    const std::optional<batch::Message> message = communicator.Poll();
    if (message && message->tag == kEnds) ranks.erase(message->rank);
    if (message) continue;
    if (silence.count() > 0 && std::chrono::steady_clock::now() - start > silence) break;
    std::this_thread::sleep_for(kPause);
  }
  return ranks;
}

batch::Message WaitForMessage(batch::Communicator& communicator) {
  for (;;) {
    if (std::optional<batch::Message> message = communicator.Poll()) return std::move(*message);
    std::this_thread::sleep_for(kPause);
  }
}

// The cells of a campaign, made from what rank 0 says of them.
class ReceivedWork {
 public:
  ReceivedWork(const std::string& bytes, batch::FlightLog& log) {
    batch::PacketReader packet(bytes);
    CheckBuild(packet.Text());
    for (std::int64_t left = packet.Integer(); left > 0; --left) {
      const std::string fingerprint = packet.Text();
      const std::string resolved = packet.Text();
      AddCell(fingerprint, resolved, static_cast<std::uint64_t>(packet.Integer()), log);
    }
  }

  std::span<const batch::CellWork> work() const { return work_; }

 private:
  static void CheckBuild(const std::string& build) {
    if (build == BuildName()) return;
    throw core::UserError(
        "build", fmt::format("is \"{}\" on this rank and \"{}\" on rank 0", BuildName(), build),
        "start the same program on machines of the same CPU level");
  }

  void AddCell(const std::string& fingerprint, const std::string& resolved, std::uint64_t seed,
               batch::FlightLog& log) {
    const scenario::Scenario scenario =
        scenario::ReadScenario(core::ParseJson(resolved, "scenario from rank 0"));
    if (core::Hex(scenario::Fingerprint(scenario)) != fingerprint) {
      throw core::UserError("scenario", "is another one on this rank than on rank 0", "");
    }
    const auto cell = static_cast<int>(work_.size());
    plain_.push_back(experiments::MakeExperiment(scenario.experiment, scenario.drive));
    logged_.push_back(std::make_unique<batch::LoggedExperiment>(*plain_.back(), cell, log));
    work_.push_back({logged_.back().get(), seed});
  }

  std::vector<std::unique_ptr<experiments::Experiment>> plain_;
  std::vector<std::unique_ptr<batch::LoggedExperiment>> logged_;
  std::vector<batch::CellWork> work_;
};

// Ends the job: MPI ends the other ranks as soon as one ends without saying so.
[[noreturn]] void EndJob(Journal& journal, const std::vector<core::Problem>& problems) {
  journal.Fail(problems);
  _exit(static_cast<int>(Outcome::kFailed));
}

void Serve(batch::Communicator& communicator, const std::string& campaign,
           const ContainmentOptions& options, const Contact& contact) {
  batch::FlightLog log;
  const ReceivedWork received(campaign, log);
  batch::OverdueTrials overdue;
  const batch::Watchdog watchdog(
      log, {.cpu_limit_s = options.trial_cpu_limit_s},
      [&](const std::vector<batch::Flight>& flights) { overdue.Tell(batch::TrialsOf(flights)); });
  const std::shared_ptr<void> watch = contact.stop.Watch(log.stop(), SecondWish::kIsTheSame);
  batch::ServeBatch(communicator, received.work(), options.threads, log.stop(), overdue);
}

// Sends every other rank the resolved scenario of each cell, so that no other file has to be there;
// the ranks serve then. Rank 0 calls it before batch::RunTrialsOnRanks.
void StartRanks(batch::Communicator& communicator, const batch::CampaignIdentity& campaign) {
  batch::PacketWriter packet;
  packet.Text(campaign.build).Integer(static_cast<std::int64_t>(campaign.cells.size()));
  for (const batch::CellIdentity& cell : campaign.cells) {
    packet.Text(cell.fingerprint).Text(cell.resolved);
    packet.Integer(static_cast<std::int64_t>(cell.seed));
  }
  SendToAll(communicator, kCampaign, packet.bytes());
}

// Ends the other ranks with the same outcome. Rank 0 calls it at the end, whatever happened. Where
// a rank was given up, or does not say within `silence` (0: waits for ever) that it ends, this does
// not return and ends the whole job with that outcome as its code: an ordinary end would wait for
// the rank in vain.
void EndRanks(batch::Communicator& communicator, Outcome outcome, std::chrono::milliseconds silence,
              Journal& journal) {
  SendToAll(communicator, kEnd,
            batch::PacketWriter().Integer(static_cast<std::int64_t>(outcome)).bytes());
  for (const int rank : RanksThatStay(communicator, silence)) {
    journal.Warn(fmt::format("rank {} does not end and is given up", rank));
    communicator.GiveUp(rank);
  }
  if (!communicator.given_up().empty()) communicator.Abort(static_cast<int>(outcome));
}

// Serves until rank 0 ends, and returns the outcome of rank 0. Every other rank calls it. A rank
// that is another build of the program, or reads another scenario from the same text, ends the job
// with a message.
Outcome ServeRankZero(batch::Communicator& communicator, const ContainmentOptions& options,
                      const Contact& contact) {
  try {
    for (;;) {
      const batch::Message message = WaitForMessage(communicator);
      if (message.tag == kEnd) {
        communicator.Send(0, kEnds, {});
        return static_cast<Outcome>(batch::PacketReader(message.bytes).Integer());
      }
      Serve(communicator, message.bytes, options, contact);
    }
  } catch (const core::UserError& error) {
    EndJob(contact.journal, error.problems());
  } catch (const std::exception& error) {
    EndJob(contact.journal, {{"rockyard", error.what(), ""}});
  }
}

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

// Tells of overdue trials where no supervisor tries them again.
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

// Ends the process where the machine failed in a trial. It is for processes without a supervisor
// that would try again, and for ranks, whose end ends all.
[[noreturn]] void EndShort(const batch::ResultStore& store, const batch::TrialId& id,
                           const std::exception& error, Journal& journal) {
  journal.Fail({{fmt::format("trial {}{}", id.trial, CellPart(store, id.cell)),
                 fmt::format("is pending: the machine failed ({})", error.what()),
                 "--resume when it has more memory, files or disk"}});
  _exit(static_cast<int>(Outcome::kFailed));
}

// Returns the record of a drive whose navigator ended the process that ran it.
truth::Record NavigatorFaultOf(const CellWork& cell, batch::TrialId id, truth::EndCause cause,
                               const std::string& what) {
  return truth::MakeNavigatorCrash(static_cast<std::uint64_t>(id.trial),
                                   fmt::format("{}: {}", truth::Info(cause).sentence, what),
                                   cell.experiment->schema().size());
}

std::chrono::milliseconds Milliseconds(double time_s) {
  return std::chrono::milliseconds(std::llround(1e3 * time_s));
}

// Runs the body in this process, which may be rank 0.
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

// Calls `run` with each part that is to be run, and with what its supervisor is told.
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
  // Must come after the end of the session: until then its writer has the store.
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
  const CellWork& cell = work[static_cast<std::size_t>(id.cell)];
  if (mission_.task == Task::kStoreHang && !cell.foreign) return Outcome::kDone;
  batch::CellRecord record{id.cell, {}};
  if (mission_.task == Task::kStoreHang) {
    record.record = NavigatorFaultOf(
        cell, id, truth::EndCause::kNavigatorCpuTime,
        fmt::format("more than {} s of a trial, twice", options_.trial_cpu_limit_s));
  } else if (mission_.task == Task::kStoreFault && cell.foreign) {
    record.record = NavigatorFaultOf(cell, id, truth::EndCause::kNavigatorCrashed,
                                     mission_.reason + ", again when the trial ran alone");
  } else if (mission_.task == Task::kStoreFault) {
    const std::string reason =
        fmt::format("the simulator crashed {}, again when the trial ran alone; see `{}`",
                    mission_.reason, ReplayLine(store, id));
    record.record = truth::MakeFault(SeedOf(store, id.cell), id.trial, reason);
  } else {
    const HeededWork logged(work, log_, contact_.stop,
                            [](const auto&, const auto&) { _exit(batch::kShortExit); });
    // No grace: no other trial is to be stored meanwhile.
    const batch::WatchdogOptions limits{.cpu_limit_s = options_.trial_cpu_limit_s,
                                        .grace = std::chrono::milliseconds(0)};
    const batch::Watchdog watchdog(log_, limits, [](const auto&) { _exit(batch::kOverdueExit); });
    record = batch::RunTrial(logged.work(), id);
  }
  store.Append(std::span(&record, 1));
  log_.SetStored(1);
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
