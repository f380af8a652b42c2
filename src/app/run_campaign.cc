#include "app/run_campaign.h"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/campaign_process.h"
#include "app/campaign_traces.h"
#include "app/console.h"
#include "app/next_command.h"
#include "app/progress_line.h"
#include "batch/run_folder.h"
#include "core/error.h"
#include "experiments/experiment.h"

namespace rockyard::app {
namespace {

// The experiments of a plan, one per cell.
class PlannedWork {
 public:
  explicit PlannedWork(const campaign::CampaignPlan& plan) {
    for (const campaign::CampaignCell& cell : plan.cells) {
      experiments_.push_back(experiments::MakeExperiment(cell.scenario));
      work_.push_back({experiments_.back().get(), static_cast<std::uint64_t>(cell.scenario.seed)});
    }
  }

  std::span<const batch::CellWork> work() const { return work_; }
  const truth::RecordSchema& schema() const { return experiments_.front()->schema(); }

 private:
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

std::string Label(const campaign::CampaignCell& cell) {
  return cell.name.empty() ? "scenario" : fmt::format("cell {}", cell.name);
}

void CheckColumns(const campaign::CampaignPlan& plan, const PlannedWork& work) {
  for (std::size_t i = 1; i < plan.cells.size(); ++i) {
    if (SameColumns(work.work()[i].experiment->schema(), work.schema())) continue;
    throw core::UserError(Label(plan.cells[i]),
                          fmt::format("measures other things than {}", Label(plan.cells[0])),
                          "make a campaign of one experiment and study");
  }
}

batch::BatchResult RunTrials(std::span<const batch::CellWork> work, campaign::OpenedRun& run,
                             const CampaignOptions& options, CampaignProcess& process) {
  batch::BatchOptions batch;
  batch.max_fault_fraction = options.max_fault_fraction;
  batch.rule = run.store.rule();
  if (options.output() == Output::kQuiet) return process.RunTrials(work, run.store, batch);
  ProgressLine line(stderr);
  batch::BatchResult result = process.RunTrials(
      work, run.store, batch, [&](const batch::Progress& progress) { line.Show(progress); });
  line.Finish(result.progress);
  return result;
}

// One broken cell among many is named, however few its trials are of all.
void TellFaults(const campaign::OpenedRun& run, const batch::BatchResult& result, double most) {
  std::string cells;
  for (const int cell : result.faulty_cells) {
    const std::string& name = run.store.identity().cells[static_cast<std::size_t>(cell)].name;
    if (!name.empty()) cells += fmt::format("{}{}", cells.empty() ? "; in cells " : ", ", name);
  }
  PrintProblems(
      {{run.folder.string(),
        fmt::format("{} of {} trials ended in a simulator fault, more than {} %{}",
                    result.progress.faults, result.progress.finished, 100.0 * most,
                    cells.empty() ? "" : fmt::format(" of all, or of a cell{}", cells)),
        cells.empty()
            ? "trials.csv names seed and trial of each: look there for the reason"
            : "`detail` in the table trials of results.sqlite names the reason of each"}});
}

ExitCode Judge(const campaign::OpenedRun& run, const batch::BatchResult& result,
               const CampaignOptions& options) {
  const batch::Progress& progress = result.progress;
  if (result.end == batch::BatchEnd::kStopped) {
    PrintNote(fmt::format(
        "interrupted: {} of {} trials are stored; go on with the same command and --resume",
        progress.finished, progress.planned));
    return ExitCode::kInterrupted;
  }
  if (!result.too_many_faults) return ExitCode::kDone;
  TellFaults(run, result, options.max_fault_fraction);
  return ExitCode::kTooManyFaults;
}

Finished WhatOf(const CampaignOptions& options, const campaign::CampaignPlan& plan) {
  if (!options.shard().whole()) return Finished::kShard;
  return plan.design.empty() ? Finished::kDrives : Finished::kSweep;
}

// Traces of the trials that the rules keep, once all are stored; then the next command.
ExitCode TraceTrials(const campaign::CampaignPlan& plan, const CampaignOptions& options,
                     CampaignProcess& process) {
  const std::filesystem::path folder = RequestOf(options, plan).folder;
  const TraceRequest request{.retention = options.traces.retention(),
                             .format = options.traces.form(),
                             .threads = batch::ThreadCount({.threads = process.threads()}),
                             .quiet = options.output() == Output::kQuiet};
  try {
    const batch::FolderClaim claim(folder);
    return process.Afterwards([&](const batch::Mission& mission, batch::FlightLog& log) {
      const ExitCode code = WriteTraces(folder, request, mission, log);
      const bool last = mission.task != batch::Mission::Task::kRunAlone;
      if (last && options.output() == Output::kText) {
        const bool stopped = code == ExitCode::kInterrupted;
        Print(NextLine(folder, WhatOf(options, plan), stopped ? options.resume_command : ""));
      }
      return code;
    });
  } catch (const core::UserError& error) {
    PrintProblems(error.problems());
    return ExitCode::kFailed;
  }
}

// What fails from here on is no bad input: trials have been run, and are stored.
ExitCode RunAndReport(std::span<const batch::CellWork> work, campaign::OpenedRun& run,
                      const CampaignOptions& options, CampaignProcess& process,
                      const CampaignReporter& reporter) {
  try {
    if (!process.whole()) return process.DoTask(work, run.store);
    const batch::BatchResult result = RunTrials(work, run, options, process);
    if (!process.reported()) reporter(run, result);
    process.SetReported();
    if (process.TellLeftOut(run.store)) return ExitCode::kFailed;
    const ExitCode code = Judge(run, result, options);
    // In the moment of the last trial: nothing is pending but traces.
    if (code == ExitCode::kInterrupted || !process.interrupted() || options.traces.rules.empty()) {
      return code;
    }
    PrintNote("interrupted: no trace is written; the same command with --resume writes them");
    return ExitCode::kInterrupted;
  } catch (const core::UserError& error) {
    PrintProblems(error.problems());
    return ExitCode::kFailed;
  }
}

ExitCode RunInProcess(const CampaignOptions& options, const CampaignPlanner& planner,
                      const CampaignReporter& reporter, CampaignProcess& process) {
  const campaign::CampaignPlan plan = planner();
  CheckPlan(options, plan);
  const PlannedWork work(plan);
  CheckColumns(plan, work);
  campaign::OpenRequest request = RequestOf(options, plan);
  if (!process.begins()) request.existing = campaign::ExistingRun::kResume;
  campaign::OpenedRun run = campaign::OpenRun(request, plan, work.schema());
  if (options.output() != Output::kQuiet && process.begins()) {
    for (const std::string& note : run.notes) PrintNote(note);
  }
  return RunAndReport(work.work(), run, options, process, reporter);
}

// What a stopping rule asks of the cells.
void CheckRule(const CampaignOptions& options, const campaign::CampaignPlan& plan,
               std::vector<core::Problem>& problems) {
  if (!options.stopping_rule()) return;
  if (!options.shard().whole()) {
    problems.push_back({"--until-half-width",
                        "looks at trials 0, 1, 2, ... of a cell, of which a shard has only some",
                        "leave out --shard, or say how many trials to run with --trials"});
  }
  for (const campaign::CampaignCell& cell : plan.cells) {
    if (cell.scenario.experiment != scenario::ExperimentKind::kDrive) {
      problems.push_back({"--until-half-width",
                          fmt::format("needs drives, and {} measures", Label(cell)),
                          "say how many trials to run with --trials"});
    } else if (cell.scenario.course.trials_per_layout > 1) {
      problems.push_back(
          {"--until-half-width",
           fmt::format("needs independent trials, and in {} {} trials share a layout of rocks",
                       Label(cell), cell.scenario.course.trials_per_layout),
           "set course.trials_per_layout=1, or say how many trials to run with --trials"});
    }
  }
}

// What traces ask of the cells.
void CheckTraces(const CampaignOptions& options, const campaign::CampaignPlan& plan,
                 std::vector<core::Problem>& problems) {
  try {
    if (!options.traces.retention().any()) return;
  } catch (const core::UserError& error) {
    problems.insert(problems.end(), error.problems().begin(), error.problems().end());
    return;
  }
  if (options.traces.retention().worst > 0 && !options.shard().whole()) {
    problems.push_back({"--traces",
                        "worst:N is asked of all trials, of which a shard has only some",
                        "leave it out, merge the shards, and ask for it there with --resume"});
  }
  for (const campaign::CampaignCell& cell : plan.cells) {
    if (cell.scenario.experiment == scenario::ExperimentKind::kDrive) continue;
    problems.push_back(
        {"--traces", fmt::format("needs drives, and {} measures", Label(cell)), "leave it out"});
  }
}

}  // namespace

void CheckPlan(const CampaignOptions& options, const campaign::CampaignPlan& plan) {
  std::vector<core::Problem> problems;
  CheckRule(options, plan, problems);
  CheckTraces(options, plan, problems);
  if (!problems.empty()) throw core::UserError(std::move(problems));
}

campaign::OpenRequest RequestOf(const CampaignOptions& options,
                                const campaign::CampaignPlan& plan) {
  return {.folder = options.out.empty() ? plan.folder : std::filesystem::path(options.out),
          .existing = options.existing(),
          .build = options.any_build ? batch::BuildPolicy::kAny : batch::BuildPolicy::kSame,
          .trials_given = options.trials.has_value(),
          .rule = options.stopping_rule(),
          .shard = options.shard()};
}

ExitCode RunCampaign(const CampaignOptions& options, const CampaignPlanner& planner,
                     const CampaignReporter& reporter) {
  const ContainmentOptions containment{.supervisor = !options.no_supervisor,
                                       .trial_cpu_limit_s = options.trial_cpu_limit_s,
                                       .threads = options.threads};
  const CampaignPart campaign = [&](CampaignProcess& process) {
    return RunInProcess(options, planner, reporter, process);
  };
  if (options.traces.rules.empty()) return RunContained(containment, campaign);
  return RunContained(containment, campaign, [&](CampaignProcess& process) {
    return TraceTrials(planner(), options, process);
  });
}

}  // namespace rockyard::app
