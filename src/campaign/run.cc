#include "campaign/run.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include "batch/merge_shards.h"
#include "batch/result_store.h"
#include "campaign/folder_report.h"
#include "campaign/output_folder.h"
#include "campaign/run_source.h"
#include "campaign/scenario_doubts.h"
#include "core/error.h"
#include "core/result.h"
#include "scenario/ablations.h"
#include "scenario/sweep.h"

namespace rockyard::campaign {
namespace {

void AddSettings(const RunRequest& request, std::vector<std::string>& settings) {
  for (const std::string& setting : request.campaign.overrides) settings.push_back(setting);
  for (const std::string& name : request.ablations) settings.push_back("--ablate " + name);
}

// Returns the overrides of the request, with those that its other options stand for.
std::vector<std::string> OverridesOf(const RunRequest& request) {
  std::vector<std::string> overrides = request.campaign.overrides;
  if (request.campaign.trials) {
    overrides.push_back(fmt::format("trials={}", *request.campaign.trials));
  }
  if (request.campaign.seed) overrides.push_back(fmt::format("seed={}", *request.campaign.seed));
  return overrides;
}

CampaignPlan PlanOf(const RunRequest& request) {
  const scenario::Scenario scenario =
      scenario::WithAblations(
          LoadScenarioFrom(request.source, OverridesOf(request), "", request.campaign.defaults),
          request.ablations)
          .scenario;
  std::string folder = scenario.name;
  for (const std::string& ablation : request.ablations) folder += fmt::format("-{}", ablation);
  std::optional<std::vector<std::string>> settings = SettingsOf(request.source);
  if (settings) AddSettings(request, *settings);
  return {.name = scenario.name,
          .design = "",
          .folder = DefaultFolder(folder, scenario.seed),
          .cells = {{.name = "", .scenario = scenario}},
          .settings = std::move(settings),
          .program = request.campaign.program};
}

// Remarks on ablations that change nothing: they may be a mistake, as nothing of that kind is in
// the scenario.
void RemarkIdleAblations(const RunRequest& request, Journal& journal) {
  if (request.ablations.empty() || !IsFirstRank()) return;
  const scenario::Scenario base =
      LoadScenarioFrom(request.source, request.campaign.overrides, "", request.campaign.defaults);
  for (const std::string& name : scenario::WithAblations(base, request.ablations).idle) {
    journal.Remark(fmt::format("--ablate {} changes nothing in this scenario", name));
  }
}

// Remarks that the source is a folder: its name may be that of a scenario, which was meant.
void RemarkFolder(const RunRequest& request, Journal& journal) {
  std::error_code error;
  if (!IsFirstRank() || !std::filesystem::is_directory(request.source, error)) return;
  journal.Remark(fmt::format("{} is the folder of a run, whose settings are taken",
                             ShellPath(request.source.string())));
}

// Warns of doubts: what the scenario has without saying so may not be meant.
void WarnOfDoubts(const RunRequest& request, Journal& journal) {
  if (!IsFirstRank()) return;
  for (const core::Problem& doubt :
       DoubtsOf(request.source, OverridesOf(request), request.campaign.defaults)) {
    journal.Warn("doubtful: " + campaign::TextOf(doubt));
  }
}

}  // namespace

WorkResult Run(const RunRequest& request, const RunObserver& observer, const Stop& stop) {
  const CampaignRequest& campaign = request.campaign;
  const ReportSettings settings{.method = campaign.method, .threads = campaign.containment.threads};
  return Recorded(observer, [&](Journal& journal) {
    RemarkFolder(request, journal);
    WarnOfDoubts(request, journal);
    RemarkIdleAblations(request, journal);
    return RunCampaign(
        campaign, [&] { return PlanOf(request); },
        [&](const OpenedRun& run) { return ReportRun(run.folder, settings); }, observer,
        {journal, stop});
  });
}

core::Result<DryRun> Rehearse(const RunRequest& request, const Observer& observer) {
  return core::Attempt([&] {
    Journal journal(observer);
    RemarkFolder(request, journal);
    WarnOfDoubts(request, journal);
    RemarkIdleAblations(request, journal);
    return Rehearse(request.campaign, PlanOf(request));
  });
}

namespace {

// Reads the sweep. Problems name its file, as a cluster job may have many.
scenario::Sweep RequestedSweep(const SweepRequest& request) {
  const std::string file = request.file.string();
  try {
    return scenario::LoadSweep(file, {.overrides = request.campaign.overrides,
                                      .trials = request.campaign.trials,
                                      .seed = request.campaign.seed,
                                      .defaults = request.campaign.defaults});
  } catch (const core::UserError& error) {
    std::vector<core::Problem> problems = error.problems();
    for (core::Problem& problem : problems) {
      if (problem.path.starts_with(file)) continue;
      problem.path = fmt::format("{}: {}", file, problem.path);
    }
    throw core::UserError(std::move(problems));
  }
}

CampaignPlan PlanOfCells(const SweepRequest& request, const scenario::Sweep& sweep) {
  CampaignPlan plan{.name = sweep.name,
                    .design = sweep.document,
                    .folder = DefaultFolder(sweep.name, static_cast<std::int64_t>(sweep.seed)),
                    .cells = {},
                    .settings = request.campaign.overrides,
                    .program = request.campaign.program};
  for (const scenario::SweepCell& cell : sweep.cells) {
    plan.cells.push_back({.name = cell.name, .scenario = cell.scenario});
  }
  return plan;
}

void WarnOfDoubts(const scenario::Sweep& sweep, Journal& journal) {
  for (const core::Problem& doubt : DoubtsOf(sweep))
    journal.Warn("doubtful: " + campaign::TextOf(doubt));
}

}  // namespace

WorkResult RunSweep(const SweepRequest& request, const RunObserver& observer, const Stop& stop) {
  const CampaignRequest& campaign = request.campaign;
  const ReportSettings settings{.method = campaign.method, .threads = campaign.containment.threads};
  // The sweep is read where trials are planned: on rank 0 alone, so that a mistake is told once.
  scenario::Sweep sweep;
  return Recorded(observer, [&](Journal& journal) {
    return RunCampaign(
        campaign,
        [&] {
          sweep = RequestedSweep(request);
          WarnOfDoubts(sweep, journal);
          return PlanOfCells(request, sweep);
        },
        [&](const OpenedRun& run) { return ReportSweep(run.store, sweep, settings); }, observer,
        {journal, stop});
  });
}

core::Result<SweepRehearsal> RehearseSweep(const SweepRequest& request, std::optional<int> pilots,
                                           const Observer& observer) {
  return core::Attempt([&] {
    Journal journal(observer);
    SweepRehearsal told{.sweep = RequestedSweep(request), .trials = {}, .plan = {}};
    WarnOfDoubts(told.sweep, journal);
    const CampaignPlan plan = PlanOfCells(request, told.sweep);
    CheckPlan(request.campaign, plan);
    told.trials = TrialsOf(OpeningOf(request.campaign, plan), plan);
    told.plan = WriteSweepPlan(
        told.sweep, {.folder = request.campaign.folder, .trials = told.trials, .pilots = pilots});
    return told;
  });
}

namespace {

FolderReport ReportMerged(const std::filesystem::path& folder) {
  const batch::ResultStore store = batch::ResultStore::Read(folder);
  const std::string& design = store.identity().design;
  if (design.empty()) return ReportRun(folder, {});
  return ReportSweep(store, StoredSweep(store), {});
}

// Remarks that traces are not merged: a trace belongs to a trial, but which trials have one was
// decided in each shard alone.
void RemarkTraces(const MergeRequest& request, Journal& journal) {
  std::error_code ignored;
  for (const std::filesystem::path& shard : request.shards) {
    if (!std::filesystem::is_directory(shard / "traces", ignored)) continue;
    journal.Remark(
        fmt::format("traces of shards are not merged: the same run or sweep with --out {}, "
                    "--resume and --traces, and without --shard, writes those of the whole",
                    request.folder.string()));
    return;
  }
}

// Returns the report with the name that the folder has once all its files are there.
FolderReport InFolder(FolderReport report, const std::filesystem::path& folder) {
  std::visit([&](auto& told) { told.folder = folder; }, report);
  return report;
}

}  // namespace

WorkResult Merge(const MergeRequest& request, const MergeObserver& observer) {
  return Recorded(observer, [&](Journal& journal) {
    core::Result<FolderReport> report = std::vector<core::Problem>{{"merge", "has not run", ""}};
    const batch::Merged merged = batch::MergeShards(
        request.shards, request.folder, {.build = request.build, .partial = request.partial},
        [&](const std::filesystem::path& made) {
          report = core::Attempt([&] { return ReportMerged(made); });
        });
    if (merged == batch::Merged::kBefore) {
      journal.Remark(fmt::format("{} holds these shards already", request.folder.string()));
      report = core::Attempt([&] { return ReportMerged(request.folder); });
    }
    journal.SetFolder(request.folder);
    RemarkTraces(request, journal);
    if (report.ok()) {
      if (observer.reported) observer.reported(InFolder(*report, request.folder));
      return Outcome::kDone;
    }
    journal.Warn("the shards are together in " + request.folder.string() +
                 ", but not all that follows");
    journal.Fail(report.problems());
    return Outcome::kFailed;
  });
}

}  // namespace rockyard::campaign
