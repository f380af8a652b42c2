#include "campaign/dry_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <system_error>
#include <utility>

#include "batch/batch_session.h"
#include "batch/executor.h"
#include "batch/result_store.h"
#include "batch/run_folder.h"
#include "campaign/run_campaign.h"
#include "core/error.h"
#include "core/hash.h"
#include "core/json_text.h"
#include "experiments/make_experiment.h"
#include "report/atomic_file.h"
#include "report/result_table.h"
#include "scenario/load.h"

namespace rockyard::campaign {
namespace {

constexpr int kPilots = 3;

// Returns how many trials of the run in the folder are stored that would go on; 0 where none would.
std::int64_t StoredTrials(const OpenRequest& request) {
  const bool goes_on = request.existing == ExistingRun::kResume ||
                       request.existing == ExistingRun::kResumeOrSetAside;
  if (!goes_on || !batch::ResultStore::HasBegun(request.folder)) return 0;
  return static_cast<std::int64_t>(batch::ResultStore::Read(request.folder).Finished().size());
}

}  // namespace

DryRun Rehearse(const CampaignRequest& request, const CampaignPlan& plan) {
  CheckPlan(request, plan);
  const OpenRequest opening = OpeningOf(request, plan);
  const scenario::Scenario& scenario = plan.cells.front().scenario;
  const auto experiment = experiments::MakeExperiment(scenario.experiment, scenario.drive);
  CheckFolder(opening, IdentityOf(plan, experiment->schema(), opening.shard));
  DryRun told{.name = plan.name,
              .seed = scenario.seed,
              .folder = opening.folder,
              .planned = TrialsOf(opening, plan),
              .stored = StoredTrials(opening),
              .pending = 0,
              .pilot = {},
              .threads = batch::ThreadCount({.threads = request.containment.threads}),
              .traces = request.traces.retention()};
  told.pending = std::max<std::int64_t>(told.planned.total - told.stored, 0);
  told.pilot = batch::RunPilots(*experiment, static_cast<std::uint64_t>(scenario.seed), kPilots);
  return told;
}

namespace {

namespace fs = std::filesystem;
using core::JsonValue;
using scenario::Sweep;

constexpr const char* kPlanFile = "plan.json";
constexpr const char* kTableFile = "plan.csv";
constexpr const char* kCellFolder = "cells";
constexpr int kMinToCompare = 2;  // one pilot may be equal by chance

fs::path FolderOf(const Sweep& sweep, const SweepPlanOptions& options) {
  if (!options.folder.empty()) return options.folder;
  fs::path folder = DefaultFolder(sweep.name, static_cast<std::int64_t>(sweep.seed));
  folder += "-plan";
  return folder;
}

// Returns whether the path may be part of a plan. plan.json, the mark of a whole plan, is not asked
// for: a dry run may be interrupted before it is written.
bool IsPartOfPlan(const fs::path& path) {
  const std::string name = path.filename().string();
  return name == kCellFolder || name.starts_with(kPlanFile) || name.starts_with(kTableFile);
}

// Throws unless the folder is free: a plan replaces a plan, and nothing else.
void CheckPlanFolder(const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  bool free = fs::is_directory(folder, error);
  if (free) {
    const fs::directory_iterator entries(folder, error);
    free = std::all_of(begin(entries), end(entries),
                       [](const auto& entry) { return IsPartOfPlan(entry.path()); });
  }
  if (free && !error) return;
  throw core::UserError(folder.string(), "holds something else than a plan",
                        "choose another folder with --out");
}

void MakeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder / kCellFolder, error);
  if (error) core::FailOnDisk(folder, "cannot be made", error);
}

JsonValue CellPlan(const Sweep& sweep, std::size_t index, std::int64_t trials,
                   const batch::PilotCost& cost) {
  const scenario::SweepCell& cell = sweep.cells[index];
  JsonValue levels = JsonValue::Object();
  for (std::size_t i = 0; i < sweep.axes.size(); ++i) {
    const scenario::SweepLevel& level = cell.levels[i];
    levels.Set(sweep.axes[i].name, level.number ? JsonValue(*level.number) : JsonValue(level.text));
  }
  JsonValue plan = report::ObjectTree(
      "name", cell.name, "file",
      fmt::format("{}/{}.json", kCellFolder, scenario::CellFileName(index, cell.name)), "levels",
      std::move(levels), "seed", cell.scenario.seed, "trials", trials, "fingerprint",
      core::Hex(scenario::Fingerprint(cell.scenario)));
  if (cost.trials == 0) return plan;
  report::SetMembers(plan, "pilots", cost.trials, "cpu_s_per_trial", cost.mean_s, "slowest_pilot_s",
                     cost.slowest_s);
  return plan;
}

JsonValue CostOf(const CampaignCost& cost) {
  JsonValue json = report::ObjectTree("pilots", cost.pilots, "cpu_s", cost.total_s);
  if (cost.standard_error_s) {
    json.Set("cpu_s_standard_error", JsonValue(*cost.standard_error_s));
  }
  return json;
}

std::string PlanJson(const Sweep& sweep, const PlannedTrials& trials,
                     const std::vector<batch::PilotCost>& pilots, const CampaignCost& cost) {
  JsonValue::List cells;
  for (std::size_t i = 0; i < sweep.cells.size(); ++i) {
    cells.push_back(CellPlan(sweep, i, trials.cells[i], pilots[i]));
  }
  JsonValue plan = report::ObjectTree("schema_version", 1, "name", sweep.name, "seed", sweep.seed,
                                      "common_random_numbers", sweep.common_random_numbers,
                                      "trials", trials.total, "at_most", trials.at_most);
  if (cost.pilots > 0) plan.Set("cost", CostOf(cost));
  plan.Set("cells", JsonValue(std::move(cells)));
  return core::DumpJson(plan);
}

std::string PlanCsv(const Sweep& sweep, const PlannedTrials& trials,
                    const std::vector<batch::PilotCost>& pilots) {
  report::CsvRow head("cell", "name");
  for (const scenario::SweepAxis& axis : sweep.axes) head.Add(axis.name);
  head.Add("seed", "trials", "fingerprint", "pilots", "cpu_s_per_trial", "slowest_pilot_s",
           "expected_cpu_s");
  std::string csv = head.Line();
  for (std::size_t i = 0; i < sweep.cells.size(); ++i) {
    const scenario::SweepCell& cell = sweep.cells[i];
    const batch::PilotCost& pilot = pilots[i];
    report::CsvRow row(i, cell.name);
    for (const scenario::SweepLevel& level : cell.levels) row.Add(level.text);
    row.Add(cell.scenario.seed, trials.cells[i], core::Hex(scenario::Fingerprint(cell.scenario)),
            pilot.trials);
    if (pilot.trials == 0) {
      row.AddEmpty(3);
    } else {
      row.Add(pilot.mean_s, pilot.slowest_s, pilot.mean_s * static_cast<double>(trials.cells[i]));
    }
    csv += row.Line();
  }
  return csv;
}

// Returns notes about cells whose pilots are equal: they differ by a setting that changed no trial.
std::vector<std::string> EqualPilots(const Sweep& sweep,
                                     const std::vector<batch::PilotCost>& pilots) {
  std::vector<std::string> notes;
  std::map<std::string, std::size_t> known;
  for (std::size_t i = 0; i < pilots.size(); ++i) {
    if (pilots[i].trials < kMinToCompare) continue;
    const auto [at, fresh] = known.try_emplace(pilots[i].hash, i);
    if (fresh) continue;
    notes.push_back(fmt::format(
        "the {} pilots of cell {} are equal to those of cell {}: what they differ in may have no "
        "effect",
        pilots[i].trials, sweep.cells[i].name, sweep.cells[at->second].name));
  }
  return notes;
}

constexpr std::size_t kMaxPilotCells = 100;

// Returns what the planned trials cost, by the pilots; `planned.cells` and `pilots` are both by
// cell.
CampaignCost ExpectedCost(const PlannedTrials& planned,
                          const std::vector<batch::PilotCost>& pilots) {
  CampaignCost cost;
  double measured_trials = 0.0;
  double variance = 0.0;
  bool scatter = false;
  for (std::size_t i = 0; i < pilots.size(); ++i) {
    const auto trials = static_cast<double>(planned.cells[i]);
    const batch::PilotCost& pilot = pilots[i];
    if (pilot.trials == 0) continue;
    measured_trials += trials;
    cost.pilots += pilot.trials;
    cost.total_s += trials * pilot.mean_s;
    cost.slowest_s = std::max(cost.slowest_s, pilot.slowest_s);
    // N trials predicted by the mean of n pilots: their scatter is N s^2, the variance by that mean
    // N^2 s^2 / n.
    variance += pilot.variance_s2 * trials * (1.0 + trials / static_cast<double>(pilot.trials));
    scatter = scatter || pilot.trials > 1;
  }
  if (measured_trials == 0.0) return cost;
  const double share = static_cast<double>(planned.total) / measured_trials;
  cost.total_s *= share;
  if (scatter) cost.standard_error_s = share * std::sqrt(variance);
  return cost;
}

}  // namespace

std::vector<batch::PilotCost> RunPilots(const scenario::Sweep& sweep, int trials) {
  std::vector<batch::PilotCost> pilots(sweep.cells.size());
  if (trials == 0) return pilots;
  const std::size_t stride = (sweep.cells.size() + kMaxPilotCells - 1) / kMaxPilotCells;
  for (std::size_t i = 0; i < sweep.cells.size(); i += stride) {
    const auto experiment = experiments::MakeExperiment(sweep.cells[i].scenario.experiment,
                                                        sweep.cells[i].scenario.drive);
    pilots[i] = batch::RunPilots(*experiment, sweep.seed, trials);
  }
  return pilots;
}

SweepPlan WriteSweepPlan(const Sweep& sweep, const SweepPlanOptions& options) {
  const fs::path folder = FolderOf(sweep, options);
  CheckPlanFolder(folder);
  const std::vector<batch::PilotCost> pilots = RunPilots(sweep, options.pilots);
  CampaignCost cost = ExpectedCost(options.trials, pilots);
  std::string json = PlanJson(sweep, options.trials, pilots, cost);
  MakeFolder(folder);
  for (std::size_t i = 0; i < sweep.cells.size(); ++i) {
    const scenario::SweepCell& cell = sweep.cells[i];
    const std::string name = scenario::CellFileName(i, cell.name) + ".json";
    report::WriteFileAtomically(folder / kCellFolder / name, scenario::ResolvedJson(cell.scenario));
  }
  report::WriteFileAtomically(folder / kTableFile, PlanCsv(sweep, options.trials, pilots));
  report::WriteFileAtomically(folder / kPlanFile, json);
  return {folder, std::move(json), cost, EqualPilots(sweep, pilots)};
}

}  // namespace rockyard::campaign
