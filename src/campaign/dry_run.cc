#include "campaign/dry_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
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
// Pilots go on until the standard error of the cost is this share of it, by so many of them that it
// can be told, within this CPU time.
constexpr double kSure = 0.1;
constexpr std::int64_t kToTellScatter = 12;
constexpr double kPilotTime_s = 20.0;

// Returns how many trials of the run in the folder are stored that would go on; 0 where none would.
std::int64_t StoredTrials(const OpenRequest& request) {
  const bool goes_on = request.existing == ExistingRun::kResume ||
                       request.existing == ExistingRun::kResumeOrSetAside;
  if (!goes_on || !batch::ResultStore::HasBegun(request.folder)) return 0;
  return static_cast<std::int64_t>(batch::ResultStore::Read(request.folder).Finished().size());
}

// What a campaign keeps of each trial: its values, twice while they are reported.
std::int64_t Records_B(std::int64_t trials, std::size_t columns) {
  return 2 * trials * static_cast<std::int64_t>(columns * sizeof(double));
}

// Runs pilots of cells for what all planned trials cost.
std::vector<batch::PilotCost> CostsOf(std::vector<batch::Pilots>& cells,
                                      const std::vector<double>& planned,
                                      std::optional<int> trials) {
  std::vector<batch::PilotCost> costs;
  double spent_s = 0.0;
  for (batch::Pilots& cell : cells) {
    spent_s += cell.Run(trials.value_or(kPilots));
    costs.push_back(cell.cost());
  }
  while (!trials && spent_s < kPilotTime_s) {
    double total_s = 0.0;
    double variance_s2 = 0.0;
    std::int64_t run = 0;
    std::size_t widest = 0;
    double most_s2 = 0.0;
    for (std::size_t i = 0; i < costs.size(); ++i) {
      const double open_s2 = costs[i].VarianceOf(planned[i]);
      total_s += planned[i] * costs[i].mean_s;
      variance_s2 += open_s2;
      run += costs[i].trials;
      // A cell whose trials were all run is known.
      if (static_cast<double>(costs[i].trials) >= planned[i] || open_s2 <= most_s2) continue;
      most_s2 = open_s2;
      widest = i;
    }
    if (most_s2 == 0.0) break;
    if (run >= kToTellScatter && variance_s2 <= kSure * kSure * total_s * total_s) break;
    spent_s += cells[widest].Run(1);
    costs[widest] = cells[widest].cost();
  }
  return costs;
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
              .memory_B = 0,
              .traces = request.traces.retention()};
  told.pending = std::max<std::int64_t>(told.planned.total - told.stored, 0);
  std::vector<batch::Pilots> pilots;
  pilots.emplace_back(*experiment, static_cast<std::uint64_t>(scenario.seed));
  told.pilot = CostsOf(pilots, {static_cast<double>(told.pending)}, {}).front();
  told.memory_B = batch::PeakMemory_B() + (told.threads - 1) * told.pilot.memory_B +
                  Records_B(told.planned.total, experiment->schema().size());
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
  json.Set("memory_B", JsonValue(cost.memory_B));
  json.Set("memory_B_per_further_thread", JsonValue(cost.thread_B));
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
    variance += pilot.VarianceOf(trials);
    cost.thread_B = std::max(cost.thread_B, pilot.memory_B);
    scatter = scatter || pilot.trials > 1;
  }
  if (measured_trials == 0.0) return cost;
  const double share = static_cast<double>(planned.total) / measured_trials;
  cost.total_s *= share;
  if (scatter) cost.standard_error_s = share * std::sqrt(variance);
  return cost;
}

}  // namespace

std::vector<batch::PilotCost> RunPilots(const scenario::Sweep& sweep,
                                        const std::vector<std::int64_t>& planned,
                                        std::optional<int> trials) {
  std::vector<batch::PilotCost> costs(sweep.cells.size());
  if (trials == 0) return costs;
  const std::size_t stride = (sweep.cells.size() + kMaxPilotCells - 1) / kMaxPilotCells;
  std::vector<std::unique_ptr<const experiments::Experiment>> experiments;
  std::vector<batch::Pilots> pilots;
  std::vector<double> counts;
  for (std::size_t i = 0; i < sweep.cells.size(); i += stride) {
    const scenario::Scenario& scenario = sweep.cells[i].scenario;
    experiments.push_back(experiments::MakeExperiment(scenario.experiment, scenario.drive));
    pilots.emplace_back(*experiments.back(), sweep.seed);
    counts.push_back(static_cast<double>(planned[i]));
  }
  const std::vector<batch::PilotCost> found = CostsOf(pilots, counts, trials);
  for (std::size_t i = 0; i < found.size(); ++i) costs[i * stride] = found[i];
  return costs;
}

SweepPlan WriteSweepPlan(const Sweep& sweep, const SweepPlanOptions& options) {
  const fs::path folder = FolderOf(sweep, options);
  CheckPlanFolder(folder);
  const std::vector<batch::PilotCost> pilots =
      RunPilots(sweep, options.trials.cells, options.pilots);
  CampaignCost cost = ExpectedCost(options.trials, pilots);
  const scenario::Scenario& first = sweep.cells.front().scenario;
  const auto experiment = experiments::MakeExperiment(first.experiment, first.drive);
  cost.memory_B =
      batch::PeakMemory_B() + Records_B(options.trials.total, experiment->schema().size());
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
