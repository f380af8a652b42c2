#include "app/sweep_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/console.h"
#include "app/open_run.h"
#include "app/sweep_pilot.h"
#include "core/error.h"
#include "core/hash.h"
#include "core/json_text.h"
#include "report/atomic_file.h"
#include "report/csv.h"
#include "scenario/load.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;
using core::JsonValue;
using scenario::Sweep;

constexpr const char* kPlanFile = "plan.json";
constexpr std::array<int, 4> kThreadCounts{1, 2, 4, 16};

fs::path FolderOf(const Sweep& sweep, const SweepPlanOptions& options) {
  if (!options.folder.empty()) return options.folder;
  fs::path folder = DefaultFolder(sweep.name, static_cast<std::int64_t>(sweep.seed));
  folder += "-plan";
  return folder;
}

// A plan replaces a plan, and nothing else.
void MakeFolder(const fs::path& folder) {
  std::error_code error;
  const bool free = !fs::exists(folder, error) ||
                    (fs::is_directory(folder, error) &&
                     (fs::is_empty(folder, error) || fs::exists(folder / kPlanFile, error)));
  if (!free) {
    throw core::UserError(folder.string(), "is not empty and holds no plan",
                          "choose another folder with --out");
  }
  fs::create_directories(folder / "cells", error);
  if (error) {
    throw core::UserError(folder.string(), "cannot be made: " + error.message(),
                          "check the path and its permissions");
  }
}

std::int64_t TotalTrials(const Sweep& sweep) {
  std::int64_t total = 0;
  for (const scenario::SweepCell& cell : sweep.cells) total += cell.scenario.trials;
  return total;
}

JsonValue CellPlan(const Sweep& sweep, std::size_t index, const batch::PilotCost& cost) {
  const scenario::SweepCell& cell = sweep.cells[index];
  JsonValue levels = JsonValue::Object();
  for (std::size_t i = 0; i < sweep.axes.size(); ++i) {
    const scenario::SweepLevel& level = cell.levels[i];
    levels.Set(sweep.axes[i].name, level.number ? JsonValue(*level.number) : JsonValue(level.text));
  }
  JsonValue plan = JsonValue::Object();
  plan.Set("name", JsonValue(cell.name));
  plan.Set("file",
           JsonValue(fmt::format("cells/{}.json", scenario::CellFileName(index, cell.name))));
  plan.Set("levels", std::move(levels));
  plan.Set("seed", JsonValue(cell.scenario.seed));
  plan.Set("trials", JsonValue(cell.scenario.trials));
  plan.Set("fingerprint", JsonValue(core::Hex(scenario::Fingerprint(cell.scenario))));
  if (cost.trials == 0) return plan;
  plan.Set("pilots", JsonValue(cost.trials));
  plan.Set("cpu_s_per_trial", JsonValue(cost.mean_s));
  plan.Set("slowest_pilot_s", JsonValue(cost.slowest_s));
  return plan;
}

JsonValue CostOf(const CampaignCost& cost) {
  JsonValue json = JsonValue::Object();
  json.Set("pilots", JsonValue(cost.pilots));
  json.Set("cpu_s", JsonValue(cost.total_s));
  json.Set("cpu_s_standard_error", JsonValue(cost.standard_error_s));
  return json;
}

std::string PlanJson(const Sweep& sweep, const std::vector<batch::PilotCost>& pilots,
                     const CampaignCost& cost) {
  JsonValue::List cells;
  for (std::size_t i = 0; i < sweep.cells.size(); ++i) {
    cells.push_back(CellPlan(sweep, i, pilots[i]));
  }
  JsonValue plan = JsonValue::Object();
  plan.Set("schema_version", JsonValue(std::int64_t{1}));
  plan.Set("name", JsonValue(sweep.name));
  plan.Set("seed", JsonValue(static_cast<std::int64_t>(sweep.seed)));
  plan.Set("common_random_numbers", JsonValue(sweep.common_random_numbers));
  plan.Set("trials", JsonValue(TotalTrials(sweep)));
  if (cost.pilots > 0) plan.Set("cost", CostOf(cost));
  plan.Set("cells", JsonValue(std::move(cells)));
  return core::DumpJson(plan);
}

std::string PlanCsv(const Sweep& sweep, const std::vector<batch::PilotCost>& pilots) {
  std::vector<std::string> fields{"cell", "name"};
  for (const scenario::SweepAxis& axis : sweep.axes) fields.push_back(report::CsvField(axis.name));
  for (const char* name : {"seed", "trials", "fingerprint", "pilots", "cpu_s_per_trial",
                           "slowest_pilot_s", "expected_cpu_s"}) {
    fields.emplace_back(name);
  }
  std::string csv = report::CsvLine(fields);
  for (std::size_t i = 0; i < sweep.cells.size(); ++i) {
    const scenario::SweepCell& cell = sweep.cells[i];
    const batch::PilotCost& pilot = pilots[i];
    fields = {std::to_string(i), report::CsvField(cell.name)};
    for (const scenario::SweepLevel& level : cell.levels) {
      fields.push_back(report::CsvField(level.text));
    }
    fields.push_back(std::to_string(cell.scenario.seed));
    fields.push_back(std::to_string(cell.scenario.trials));
    fields.push_back(core::Hex(scenario::Fingerprint(cell.scenario)));
    fields.push_back(std::to_string(pilot.trials));
    const double expected_s = pilot.mean_s * static_cast<double>(cell.scenario.trials);
    for (const double number : {pilot.mean_s, pilot.slowest_s, expected_s}) {
      fields.push_back(pilot.trials == 0 ? std::string() : report::CsvNumber(number));
    }
    csv += report::CsvLine(fields);
  }
  return csv;
}

std::string Duration(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.3g} s", seconds);
  if (seconds < 7200.0) return fmt::format("{:.3g} min", seconds / 60.0);
  return fmt::format("{:.3g} h", seconds / 3600.0);
}

std::string CostText(const CampaignCost& cost) {
  if (cost.pilots == 0) return "  no pilots, no cost\n";
  std::string text =
      fmt::format("  expected cost, from {} pilot trials: {} of CPU time (standard error {})\n    ",
                  cost.pilots, Duration(cost.total_s), Duration(cost.standard_error_s));
  for (const int threads : kThreadCounts) {
    text += fmt::format("{} with {} thread{}{}", Duration(cost.total_s / threads), threads,
                        threads == 1 ? "" : "s", threads == kThreadCounts.back() ? "\n" : ", ");
  }
  return text + fmt::format("    (as many cores as threads; the slowest pilot took {})\n",
                            Duration(cost.slowest_s));
}

// Cells whose pilots are equal differ by a setting that changed no trial.
std::vector<std::string> EqualPilots(const Sweep& sweep,
                                     const std::vector<batch::PilotCost>& pilots) {
  std::vector<std::string> notes;
  std::map<std::string, std::size_t> known;
  for (std::size_t i = 0; i < pilots.size(); ++i) {
    if (pilots[i].trials == 0) continue;
    const auto [at, fresh] = known.try_emplace(pilots[i].hash, i);
    if (fresh) continue;
    notes.push_back(fmt::format(
        "the {} pilots of cell {} are equal to those of cell {}: what they differ in may have no "
        "effect",
        pilots[i].trials, sweep.cells[i].name, sweep.cells[at->second].name));
  }
  return notes;
}

}  // namespace

void WriteSweepPlan(const Sweep& sweep, const SweepPlanOptions& options) {
  const fs::path folder = FolderOf(sweep, options);
  MakeFolder(folder);
  for (std::size_t i = 0; i < sweep.cells.size(); ++i) {
    const scenario::SweepCell& cell = sweep.cells[i];
    report::WriteFileAtomically(folder / "cells" / (scenario::CellFileName(i, cell.name) + ".json"),
                                scenario::ResolvedJson(cell.scenario));
  }
  const std::vector<batch::PilotCost> pilots = RunPilots(sweep, options.pilots);
  const CampaignCost cost = ExpectedCost(sweep, pilots);
  const std::string json = PlanJson(sweep, pilots, cost);
  report::WriteFileAtomically(folder / "plan.csv", PlanCsv(sweep, pilots));
  report::WriteFileAtomically(folder / kPlanFile, json);
  for (const std::string& note : EqualPilots(sweep, pilots)) PrintNote(note);
  if (options.output == Output::kJson) Print(json);
  if (options.output != Output::kText) return;
  Print(fmt::format("{}: {} cells, {} trials, seed {}\n", sweep.name, sweep.cells.size(),
                    TotalTrials(sweep), sweep.seed));
  Print(CostText(cost));
  Print(fmt::format("  plan, and every cell's scenario, in {}\n", folder.string()));
}

}  // namespace rockyard::app
