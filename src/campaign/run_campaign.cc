#include "campaign/run_campaign.h"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "batch/run_folder.h"
#include "campaign/campaign_process.h"
#include "campaign/navigator_times.h"
#include "core/error.h"
#include "experiments/make_experiment.h"

namespace rockyard::campaign {
namespace {

// The experiments of a plan, one per cell.
class PlannedWork {
 public:
  explicit PlannedWork(const CampaignPlan& plan) {
    for (const CampaignCell& cell : plan.cells) {
      const bool foreign = cell.scenario.drive.foreign();
      trial::Watchers watchers;
      if (foreign) {
        watchers.navigator_use = [this, name = cell.name](core::TrialKey key,
                                                          const messages::NavigatorUse& use) {
          times_.Add(name, key.trial, use);
        };
      }
      experiments_.push_back(
          experiments::MakeExperiment(cell.scenario.experiment, cell.scenario.drive, watchers));
      work_.push_back(
          {experiments_.back().get(), static_cast<std::uint64_t>(cell.scenario.seed), foreign});
    }
  }
  PlannedWork(const PlannedWork&) = delete;
  PlannedWork& operator=(const PlannedWork&) = delete;

  std::span<const batch::CellWork> work() const { return work_; }
  const truth::RecordSchema& schema() const { return experiments_.front()->schema(); }
  NavigatorTimes& times() { return times_; }

 private:
  NavigatorTimes times_;  // of navigators that are plugins or processes
  std::vector<std::unique_ptr<experiments::Experiment>> experiments_;
  std::vector<batch::CellWork> work_;
};

bool SameColumns(const truth::RecordSchema& first, const truth::RecordSchema& second) {
  if (first.size() != second.size()) return false;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i].name != second[i].name) return false;
  }
  return true;
}

void CheckColumns(const CampaignPlan& plan, const PlannedWork& work) {
  for (std::size_t i = 1; i < plan.cells.size(); ++i) {
    if (SameColumns(work.work()[i].experiment->schema(), work.schema())) continue;
    throw core::UserError(plan.cells[i].Label(),
                          fmt::format("measures other things than {}", plan.cells[0].Label()),
                          "make a campaign of one experiment and study");
  }
}

// Returns the problem of too many faults. A broken cell among many is named, however few its trials
// are of all.
std::vector<core::Problem> FaultProblems(const OpenedRun& run, const batch::BatchResult& result,
                                         double most) {
  std::string cells;
  for (const int cell : result.faulty_cells) {
    const std::string& name = run.store.identity().cells[static_cast<std::size_t>(cell)].name;
    if (!name.empty()) cells += fmt::format("{}{}", cells.empty() ? "; in cells " : ", ", name);
  }
  return {{run.folder.string(),
           fmt::format("{} of {} trials ended in a simulator fault, more than {} %{}",
                       result.progress.faults, result.progress.finished, 100.0 * most,
                       cells.empty() ? "" : fmt::format(" of all, or of a cell{}", cells)),
           cells.empty()
               ? "trials.csv names each with its reason, in the column detail"
               : "`detail` in the table trials of results.sqlite names the reason of each"}};
}

// One campaign, in one of its processes.
class Campaign {
 public:
  Campaign(const CampaignRequest& request, const CampaignPlanner& planner,
           const CampaignReporter& reporter, const RunObserver& observer, const Contact& contact)
      : request_(request),
        planner_(planner),
        reporter_(reporter),
        observer_(observer),
        contact_(contact),
        journal_(contact.journal) {}

  Outcome Run(CampaignProcess& process) const {
    CampaignPlan plan = planner_();
    CheckPlan(request_, plan);
    for (std::size_t i = 0; request_.prepare && i < plan.cells.size(); ++i) {
      request_.prepare(i, plan.cells[i]);
    }
    PlannedWork work(plan);
    CheckColumns(plan, work);
    OpenRequest opening = OpeningOf(request_, plan);
    if (!process.begins()) opening.existing = ExistingRun::kOwn;
    opening.own = [&] { process.SetOpened(); };
    OpenedRun run = OpenRun(opening, plan, work.schema());
    journal_.SetFolder(run.folder);
    work.times().Begin(run.folder);
    if (process.begins()) {
      for (const std::string& note : run.notes) journal_.Remark(note);
      if (request_.opened) request_.opened(run.folder, run.store.Finished().empty());
    }
    const Outcome outcome = RunAndReport(work.work(), run, process);
    if (const auto problem = work.times().problem()) journal_.Warn(*problem);
    return outcome;
  }

  // Writes the traces of the trials that the rules keep, once all are stored.
  Outcome Trace(CampaignProcess& process) const {
    const std::filesystem::path folder = OpeningOf(request_, planner_()).folder;
    TraceRequest traces{.retention = request_.traces.retention(),
                        .format = request_.traces.form(),
                        .threads = batch::ThreadCount({.threads = process.threads()}),
                        .defaults = request_.defaults};
    try {
      const batch::FolderClaim claim(folder);
      return process.Afterwards([&](const batch::Mission& mission, batch::FlightLog& log) {
        traces.progress = [&](const TraceProgress& progress, Moment moment) {
          if (observer_.traces) observer_.traces(progress, moment);
          AskToStop(contact_.stop, log);
        };
        AskToStop(contact_.stop, log);
        const Outcome outcome = WriteTraces(folder, traces, mission, log, journal_);
        const bool last = mission.task != batch::Mission::Task::kRunAlone;
        if (last && observer_.traced) observer_.traced(folder, outcome);
        return outcome;
      });
    } catch (const core::UserError& error) {
      journal_.Fail(error.problems());
      return Outcome::kFailed;
    }
  }

 private:
  // Runs, reports and judges. What fails in here is no bad input: trials have been run, and are
  // stored.
  Outcome RunAndReport(std::span<const batch::CellWork> work, OpenedRun& run,
                       CampaignProcess& process) const {
    try {
      if (!process.whole()) return process.DoTask(work, run.store);
      const batch::BatchResult result = RunTrials(work, run, process);
      if (!process.reported()) {
        const FolderReport report = reporter_(run);
        if (observer_.reported) observer_.reported(report, result.end);
      }
      process.SetReported();
      if (process.TellLeftOut(run.store)) return Outcome::kFailed;
      const Outcome outcome = Judge(run, result, process.late_trial());
      // Where the wish came in the moment of the last trial, nothing is pending but traces.
      if (outcome == Outcome::kInterrupted || !process.interrupted() ||
          request_.traces.rules.empty()) {
        return outcome;
      }
      journal_.Warn("interrupted: no trace is written; the same command with --resume writes them");
      return Outcome::kInterrupted;
    } catch (const core::UserError& error) {
      journal_.Fail(error.problems());
      return Outcome::kFailed;
    }
  }

  batch::BatchResult RunTrials(std::span<const batch::CellWork> work, OpenedRun& run,
                               CampaignProcess& process) const {
    const auto tell = [&](const batch::Progress& progress, Moment moment) {
      if (observer_.trials) observer_.trials(progress, moment);
    };
    batch::BatchOptions batch;
    batch.max_fault_fraction = request_.max_fault_fraction;
    batch.rule = run.store.rule();
    batch::BatchResult result = process.RunTrials(
        work, run.store, batch,
        [&](const batch::Progress& progress) { tell(progress, Moment::kUnderWay); });
    tell(result.progress, Moment::kEnd);
    journal_.SetTrials({.planned = result.progress.planned,
                        .finished = result.progress.finished,
                        .faults = result.progress.faults});
    return result;
  }

  Outcome Judge(const OpenedRun& run, const batch::BatchResult& result, bool late_trial) const {
    const batch::Progress& progress = result.progress;
    if (result.end == batch::BatchEnd::kStopped && late_trial) {
      journal_.Fail({{"--trial-cpu-limit",
                      fmt::format("was used up by a trial, which ended after all; none was begun "
                                  "after it, and {} of {} are stored",
                                  progress.finished, progress.planned),
                      "go on with the same command and --resume, or with a higher limit"}});
      return Outcome::kFailed;
    }
    if (result.end == batch::BatchEnd::kStopped) {
      journal_.Warn(fmt::format(
          "interrupted: {} of {} trials are stored; go on with the same command and --resume",
          progress.finished, progress.planned));
      return Outcome::kInterrupted;
    }
    if (!result.too_many_faults) return Outcome::kDone;
    journal_.Fail(FaultProblems(run, result, request_.max_fault_fraction));
    return Outcome::kTooManyFaults;
  }

  const CampaignRequest& request_;
  const CampaignPlanner& planner_;
  const CampaignReporter& reporter_;
  const RunObserver& observer_;
  const Contact& contact_;
  Journal& journal_;
};

}  // namespace

OpenRequest OpeningOf(const CampaignRequest& request, const CampaignPlan& plan) {
  return {.folder = request.folder.empty() ? plan.folder : request.folder,
          .existing = request.existing,
          .build = request.build,
          .retry_faults = request.retry_faults,
          .trials_given = request.trials.has_value(),
          .rule = request.rule,
          .shard = request.ParseShard(),
          .own = {}};
}

Outcome RunCampaign(const CampaignRequest& request, const CampaignPlanner& planner,
                    const CampaignReporter& reporter, const RunObserver& observer,
                    const Contact& contact) {
  const Campaign campaign(request, planner, reporter, observer, contact);
  const CampaignPart run = [&](CampaignProcess& process) { return campaign.Run(process); };
  if (request.traces.rules.empty()) return RunContained(request.containment, contact, run);
  return RunContained(request.containment, contact, run,
                      [&](CampaignProcess& process) { return campaign.Trace(process); });
}

namespace {

constexpr int kMaxShards = 1'000'000;

// Adds the problems of a stopping rule with the cells.
void CheckRule(const CampaignRequest& request, const CampaignPlan& plan,
               std::vector<core::Problem>& problems) {
  if (!request.rule) return;
  if (!request.ParseShard().whole()) {
    problems.push_back({"--until-half-width",
                        "looks at trials 0, 1, 2, ... of a cell, of which a shard has only some",
                        "leave out --shard, or say how many trials to run with --trials"});
  }
  for (const CampaignCell& cell : plan.cells) {
    if (cell.scenario.experiment.chosen().name() != "drive") {
      problems.push_back({"--until-half-width",
                          fmt::format("needs drives, and {} measures", cell.Label()),
                          "say how many trials to run with --trials"});
    } else if (cell.scenario.drive.course.trials_per_layout > 1) {
      problems.push_back(
          {"--until-half-width",
           fmt::format("needs independent trials, and in {} {} trials share a layout of rocks",
                       cell.Label(), cell.scenario.drive.course.trials_per_layout),
           "set course.trials_per_layout=1, or say how many trials to run with --trials"});
    }
  }
}

// Adds the problems of traces with the cells.
void CheckTraces(const CampaignRequest& request, const CampaignPlan& plan,
                 std::vector<core::Problem>& problems) {
  try {
    if (!request.traces.retention().any()) return;
  } catch (const core::UserError& error) {
    problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    return;
  }
  if (request.traces.retention().worst > 0 && !request.ParseShard().whole()) {
    problems.push_back({"--traces",
                        "worst:N is asked of all trials, of which a shard has only some",
                        "leave it out, merge the shards, and ask for it there with --resume"});
  }
  for (const CampaignCell& cell : plan.cells) {
    if (cell.scenario.experiment.chosen().name() == "drive") continue;
    problems.push_back(
        {"--traces", fmt::format("needs drives, and {} measures", cell.Label()), "leave it out"});
  }
}

// Adds the problem of a shared library that nobody watches over.
void CheckPlugins(const CampaignRequest& request, const CampaignPlan& plan,
                  std::vector<core::Problem>& problems) {
  if (request.containment.supervisor) return;
  for (const CampaignCell& cell : plan.cells) {
    for (const plugin::PluginUse& use : cell.scenario.plugins) {
      if (use.kind != plugin::PluginUse::Kind::kLibrary) continue;
      problems.push_back(
          {"plugins",
           fmt::format("{} would run without a supervisor, which finds out whether a "
                       "crash was its own",
                       use.Name()),
           "leave out --no-supervisor, use `rockyard run`, or make it a process"});
      return;
    }
  }
}

}  // namespace

batch::Shard CampaignRequest::ParseShard() const {
  if (shard.empty()) return {};
  const std::size_t slash = shard.find('/');
  const std::string_view text = shard;
  const auto index = NumberIn<int>(text.substr(0, slash));
  const auto count =
      slash == std::string::npos ? std::nullopt : NumberIn<int>(text.substr(slash + 1));
  if (!index || !count || *index < 1 || *index > *count || *count > kMaxShards) {
    throw core::UserError("--shard", fmt::format("\"{}\" is no part of a campaign", shard),
                          "use I/N with 1 <= I <= N, e.g. 1/4");
  }
  return {*index, *count};
}

void CheckPlan(const CampaignRequest& request, const CampaignPlan& plan) {
  std::vector<core::Problem> problems;
  CheckRule(request, plan, problems);
  CheckTraces(request, plan, problems);
  CheckPlugins(request, plan, problems);
  if (!problems.empty()) throw core::UserError(std::move(problems));
}

}  // namespace rockyard::campaign
