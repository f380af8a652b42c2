#include "app/regression_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "app/console.h"
#include "app/run_source.h"
#include "batch/run_folder.h"
#include "batch/scenario_difference.h"
#include "batch/trial_hash.h"
#include "core/error.h"
#include "report/atomic_file.h"
#include "report/baseline.h"
#include "report/regression_report.h"

namespace rockyard::app {
namespace {

using batch::ScenarioDifference;
using report::BaselineCell;
using report::CheckedCell;

constexpr std::size_t kShownDifferences = 12;

std::vector<StoredRun> ReadCells(const std::vector<std::string>& paths) {
  std::vector<StoredRun> cells;
  for (const std::string& path : paths) {
    for (const auto& folder : batch::FindRuns(path)) {
      for (StoredRun& cell : ReadCampaign(folder)) {
        RequireWhole(cell);
        cells.push_back(std::move(cell));
      }
    }
  }
  return cells;
}

class Check {
 public:
  Check(report::Baseline baseline, const RegressionRequest& request)
      : baseline_(std::move(baseline)), request_(request), runs_(ReadCells(request.runs)) {
    report_.baseline = baseline_.name;
    report_.reason = baseline_.reason;
    report_.baseline_build = baseline_.build;
  }

  report::RegressionReport Run() {
    std::vector<statistics::RegressionCell> cells;
    for (const BaselineCell& cell : baseline_.cells) {
      const StoredRun* run = Find(cell);
      if (run != nullptr) cells.push_back(Compare(cell, *run));
    }
    if (!problems_.empty()) throw core::UserError(std::move(problems_));
    NoteSpare(cells.size());
    report_.result = statistics::CheckRegression(cells, request_.options);
    return std::move(report_);
  }

 private:
  const StoredRun* Find(const BaselineCell& cell) {
    if (baseline_.cells.size() == 1 && runs_.size() == 1) return &runs_.front();
    const StoredRun* found = nullptr;
    for (const StoredRun& run : runs_) {
      if (CellName(run) != cell.name) continue;
      if (found != nullptr) {
        problems_.push_back({run.Label(),
                             fmt::format("is cell {}, and so is {}", cell.name, found->Label()),
                             "name one run for each cell"});
      }
      found = &run;
    }
    if (found == nullptr) {
      problems_.push_back({cell.name, "is a cell of the baseline, but none of the runs is",
                           fmt::format("run it; the runs have {}", Names())});
    }
    return found;
  }

  std::string Names() const {
    std::string names;
    for (const StoredRun& run : runs_) names += (names.empty() ? "" : ", ") + CellName(run);
    return names;
  }

  statistics::RegressionCell Compare(const BaselineCell& cell, const StoredRun& run) {
    const std::span<const truth::Record> records = run.prefix();
    if (records.empty()) {
      problems_.push_back({run.Label(), "holds no finished trials", "run some first"});
    } else if (static_cast<std::int64_t>(records.size()) < run.planned) {
      report_.notes.push_back(fmt::format("{}: unfinished, {} of {} trials are used", run.Label(),
                                          records.size(), run.planned));
    }
    CheckedCell checked{.name = cell.name,
                        .baseline_seed = cell.seed,
                        .run_seed = run.identity.seed,
                        .baseline_trials = static_cast<std::int64_t>(cell.outcomes.size()),
                        .run_trials = static_cast<std::int64_t>(records.size())};
    checked.same_fields = CompareScenarios(cell, run);
    checked.paired = checked.same_fields && cell.seed == run.identity.seed;
    checked.identical = checked.paired && checked.baseline_trials == checked.run_trials &&
                        batch::TrialHash(records) == cell.trial_hash;
    if (!run.builds.empty()) report_.run_build = run.builds.back();
    statistics::RegressionCell compared{
        .name = cell.name, .paired = checked.paired, .baseline = cell.metrics, .run = {}};
    for (const statistics::BaselineMetric& metric : cell.metrics) {
      compared.run.push_back(ValuesOf(metric.name, run.schema, records));
    }
    report_.cells.push_back(std::move(checked));
    return compared;
  }

  static std::vector<double> ValuesOf(const std::string& name, const truth::RecordSchema& schema,
                                      std::span<const truth::Record> records) {
    const statistics::Metric* metric = statistics::FindMetric(name);
    auto values =
        statistics::MetricValues(*metric, schema, records).value_or(std::vector<double>());
    for (double& value : values) value = statistics::RoundForBaseline(value);
    return values;
  }

  // Whether the settings that decide rocks, start and goal are the same. A parameter that only the
  // run has is younger than the baseline: whether its default changes anything is what a check is
  // for.
  bool CompareScenarios(const BaselineCell& cell, const StoredRun& run) {
    if (cell.fingerprint == run.identity.fingerprint) return true;
    bool same_fields = true;
    std::vector<ScenarioDifference> differences =
        batch::FindScenarioDifferences(cell.resolved, run.identity.resolved);
    // Another seed is another sample of the same: compared unpaired.
    std::erase_if(differences, [](const ScenarioDifference& each) { return each.path == "seed"; });
    const auto younger = std::erase_if(
        differences, [](const ScenarioDifference& each) { return each.first == "absent"; });
    if (younger > 0) {
      report_.notes.push_back(
          fmt::format("{}: {} parameters are younger than the baseline", cell.name, younger));
    }
    for (std::size_t i = 0; i < differences.size(); ++i) {
      const ScenarioDifference& each = differences[i];
      if (each.path.starts_with("terrain.") || each.path.starts_with("course.")) {
        same_fields = false;
      }
      if (i < kShownDifferences) Tell(cell, each);
    }
    if (differences.size() > kShownDifferences) {
      report_.notes.push_back(
          fmt::format("{}: {} settings differ in all", cell.name, differences.size()));
    }
    return same_fields;
  }

  void Tell(const BaselineCell& cell, const ScenarioDifference& each) {
    const std::string reason =
        fmt::format("is {} in the baseline and {} in the run", each.first, each.second);
    if (request_.scenario_change == ScenarioChange::kAllow) {
      report_.notes.push_back(fmt::format("{}: {} {}", cell.name, each.path, reason));
    } else {
      problems_.push_back({fmt::format("{}: {}", cell.name, each.path), reason,
                           "run the baseline's scenario, or add --allow-scenario-change"});
    }
  }

  void NoteSpare(std::size_t used) {
    if (runs_.size() > used) {
      report_.notes.push_back(
          fmt::format("{} cells of the runs are not in the baseline", runs_.size() - used));
    }
  }

  report::Baseline baseline_;
  const RegressionRequest& request_;
  std::vector<StoredRun> runs_;
  report::RegressionReport report_;
  std::vector<core::Problem> problems_;
};

}  // namespace

ExitCode CheckAgainstBaseline(const core::JsonValue& baseline, const RegressionRequest& request) {
  std::vector<std::string> unknown;
  Check check(report::ParseBaseline(baseline, &unknown), request);
  report::RegressionReport report = check.Run();
  if (!unknown.empty()) {
    report.notes.push_back(
        fmt::format("{} metrics of the baseline are unknown to this program", unknown.size()));
  }
  if (!request.junit.empty()) {
    report::WriteFileAtomically(request.junit, report::RegressionJUnit(report));
  }
  if (!request.csv.empty()) report::WriteFileAtomically(request.csv, report::RegressionCsv(report));
  Print(report::RegressionText(report, request.all_rows ? report::ReportedRows::kAll
                                                        : report::ReportedRows::kNotEquivalent));
  return static_cast<ExitCode>(statistics::ExitCode(report.result));
}

}  // namespace rockyard::app
