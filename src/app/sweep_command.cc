// rockyard sweep
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "app/campaign_options.h"
#include "app/commands.h"
#include "app/console.h"
#include "app/run_campaign.h"
#include "app/run_source.h"
#include "app/sweep_plan.h"
#include "batch/trial_hash.h"
#include "core/error.h"
#include "report/sweep_files.h"
#include "scenario/sweep.h"

namespace rockyard::app {
namespace {

struct SweepOptions {
  CampaignOptions campaign;
  std::string file;
  std::string interval = "wilson";
  int pilots = 3;
};

scenario::Sweep SweepOf(const SweepOptions& options) {
  return scenario::LoadSweep(options.file, {.overrides = options.campaign.overrides,
                                            .trials = options.campaign.trials,
                                            .seed = options.campaign.seed});
}

CampaignPlan PlanOf(const scenario::Sweep& sweep) {
  CampaignPlan plan{.name = sweep.name,
                    .design = sweep.document,
                    .folder = DefaultFolder(sweep.name, static_cast<std::int64_t>(sweep.seed)),
                    .cells = {}};
  for (const scenario::SweepCell& cell : sweep.cells) {
    plan.cells.push_back({.name = cell.name, .scenario = cell.scenario});
  }
  return plan;
}

// Loads one cell after the other, and keeps their hashes for that of the campaign.
class StoredCells {
 public:
  explicit StoredCells(const batch::ResultStore& store) : store_(store) {}

  report::SweepCellTrials Load(std::size_t index) {
    const int cell = static_cast<int>(index);
    std::vector<truth::Record> records = store_.Load(cell);
    const auto stored = static_cast<std::int64_t>(records.size());
    records.resize(batch::ContiguousPrefix(records).size());
    std::string hash = batch::TrialHash(records);
    hashes_.push_back({store_.identity().cells[index].name, hash});
    return {.schema = store_.identity().schema,
            .prefix = std::move(records),
            .planned = store_.planned(cell),
            .stored = stored,
            .trial_hash = std::move(hash)};
  }

  std::string CampaignHash() const { return batch::CampaignHash(hashes_); }

 private:
  const batch::ResultStore& store_;
  std::vector<batch::CellHash> hashes_;
};

// A shard holds no contiguous prefix of any cell, so that no rate can be told from it.
bool TellShard(const OpenedRun& run) {
  const batch::Shard shard = run.store.identity().shard;
  if (shard.whole()) return false;
  PrintNote(fmt::format("part {} of {} is in {}; `rockyard merge` puts the parts together",
                        shard.index, shard.count, run.folder.string()));
  return true;
}

void Report(const OpenedRun& run, const scenario::Sweep& sweep, const SweepOptions& options) {
  if (TellShard(run)) return;
  const auto method = options.interval == "wilson" ? statistics::IntervalMethod::kWilson
                                                   : statistics::IntervalMethod::kClopperPearson;
  StoredCells cells(run.store);
  const report::SweepSummary summary = report::SummarizeSweep(
      sweep, [&](std::size_t index) { return cells.Load(index); }, method);
  const report::SweepDescription description{
      .trial_hash = cells.CampaignHash(),
      .provenance = core::CurrentProvenance(),
      .builds = run.store.Builds(),
      .threads = batch::ThreadCount({.threads = options.campaign.threads})};
  report::WriteSweepFiles(run.folder, sweep, summary, description);
  switch (options.campaign.output()) {
    case Output::kText:
      Print(report::SweepText(sweep, summary, description, StyleFor(stdout)));
      Print(fmt::format("  results in {}\n", run.folder.string()));
      break;
    case Output::kJson:
      Print(report::SweepJson(sweep, summary, description));
      break;
    case Output::kQuiet:
      break;
  }
}

ExitCode Sweep(const SweepOptions& options) {
  const scenario::Sweep sweep = SweepOf(options);
  if (options.campaign.dry_run) {
    WriteSweepPlan(sweep, {.folder = options.campaign.out,
                           .pilots = options.pilots,
                           .output = options.campaign.output()});
    return ExitCode::kDone;
  }
  return RunCampaign(
      options.campaign, [&] { return PlanOf(sweep); },
      [&](const OpenedRun& run, const batch::BatchResult&) { Report(run, sweep, options); });
}

}  // namespace

void AddSweepCommand(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<SweepOptions>();
  CLI::App* command = app.add_subcommand(
      "sweep", "Runs scenarios that differ along axes, such as rock abundance, as one campaign");
  command->add_option("FILE", options->file, "sweep file (see scenarios/sweeps)")->required();
  AddCampaignOptions(*command, options->campaign);
  command->add_option("--interval", options->interval, "of rates: wilson or clopper-pearson")
      ->check(CLI::IsMember({"wilson", "clopper-pearson"}))
      ->capture_default_str();
  command
      ->add_option("--pilots", options->pilots,
                   "trials of each cell from which --dry-run measures the cost; 0: none")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command->callback([options, &exit_code] { exit_code = Sweep(*options); });
}

}  // namespace rockyard::app
