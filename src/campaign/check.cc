#include "campaign/check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <string_view>
#include <utility>

#include "batch/campaign_differences.h"
#include "batch/run_folder.h"
#include "batch/trial_hash.h"
#include "campaign/journal.h"
#include "campaign/reference_cases.h"
#include "campaign/run_source.h"
#include "core/error.h"
#include "core/json_file.h"
#include "report/baseline.h"
#include "report/comparison_reference.h"
#include "report/result_json.h"
#include "statistics/drive_summary.h"
#include "truth/record.h"

namespace rockyard::campaign {
namespace {

using batch::ScenarioDifference;
using report::BaselineCell;
using report::CheckedCell;

std::vector<StoredRun> ReadWholeRuns(const std::vector<std::string>& paths,
                                     const std::string& cell) {
  std::vector<StoredRun> runs;
  std::map<std::string, std::string> folders;  // by scenario
  std::vector<core::Problem> problems;
  for (const std::string& path : paths) {
    for (const auto& folder : batch::FindRuns(path)) {
      runs.push_back(ReadRun(folder, cell));
      RequireWhole(runs.back());
      const std::string& scenario = runs.back().identity.scenario;
      const auto [at, is_new] = folders.emplace(scenario, folder.string());
      if (!is_new) {
        problems.push_back({folder.string(),
                            fmt::format("is a run of {}, and so is {}", scenario, at->second),
                            "name one run of each scenario"});
      }
    }
  }
  if (!problems.empty()) throw core::UserError(std::move(problems));
  return runs;
}

void WarnUnfinished(const StoredRun& run, Journal& journal) {
  const auto usable = static_cast<std::int64_t>(run.prefix().size());
  if (usable < run.planned) {
    journal.Warn(fmt::format("{}: unfinished, {} of {} trials are used", run.folder.string(),
                             usable, run.planned));
  }
}

PublishedCheck CheckAgainstPublished(const core::JsonValue& document, const CheckRequest& request,
                                     Journal& journal) {
  PublishedCheck check;
  check.reference = report::ParseReference(document);
  const std::vector<StoredRun> stored = ReadWholeRuns(request.runs, request.cell);
  std::vector<const StoredRun*> runs;
  for (const StoredRun& run : stored) {
    WarnUnfinished(run, journal);
    runs.push_back(&run);
  }
  const std::filesystem::path folder = request.reference.parent_path();
  check.result = statistics::Compare(
      check.reference, PublishedViews(check.reference, folder, runs, journal), request.comparison);
  check.outcome = static_cast<Outcome>(statistics::ExitCode(check.result));
  return check;
}

bool IsSame(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

// Reads the cell of that name or number of each campaign; all cells where `cell` is empty. `paths`:
// folders of runs, or of such folders. Throws core::UserError: no run, no such cell, a shard.
std::vector<StoredRun> ReadCells(const std::vector<std::string>& paths, const std::string& cell) {
  std::vector<StoredRun> cells;
  for (const std::string& path : paths) {
    for (const auto& folder : batch::FindRuns(path)) {
      std::vector<StoredRun> found;
      if (cell.empty()) {
        found = ReadCampaign(folder);
      } else {
        found.push_back(ReadRun(folder, cell));
      }
      for (StoredRun& each : found) {
        RequireWhole(each);
        cells.push_back(std::move(each));
      }
    }
  }
  return cells;
}

// Keeps only the cells of the baseline whose names the runs have; all cells where no name fits.
void KeepCellsOf(const std::vector<StoredRun>& runs, report::Baseline& baseline) {
  std::vector<report::BaselineCell> kept;
  for (const report::BaselineCell& cell : baseline.cells) {
    const bool named = std::any_of(
        runs.begin(), runs.end(), [&](const StoredRun& run) { return CellName(run) == cell.name; });
    if (named) kept.push_back(cell);
  }
  if (!kept.empty()) baseline.cells = std::move(kept);
}

// Compares trial by trial the outcomes and the values of metrics, rounded as the baseline keeps
// them. `values` are those of the run, by metric of the baseline, and empty where the run lacks the
// metric, which counts as changed. Values that are NaN on both sides are the same. Leaves
// `only_hash` as it is.
report::RecordChanges CompareRecords(const BaselineCell& cell,
                                     std::span<const truth::Record> records,
                                     const std::vector<std::vector<double>>& values) {
  report::RecordChanges changes;
  changes.columns = {{"outcome"}};
  for (const statistics::BaselineMetric& metric : cell.metrics) {
    changes.columns.push_back({metric.name});
  }
  const std::size_t pairs = std::min(records.size(), cell.outcomes.size());
  changes.pairs = static_cast<std::int64_t>(pairs);
  for (std::size_t trial = 0; trial < pairs; ++trial) {
    bool same = true;
    const auto compare = [&](std::size_t column, bool is_same) {
      if (is_same) return;
      same = false;
      ++changes.columns[column].trials;
    };
    compare(0, records[trial].outcome == cell.outcomes[trial]);
    for (std::size_t i = 0; i < cell.metrics.size(); ++i) {
      compare(i + 1,
              !values[i].empty() && IsSame(cell.metrics[i].values.at(trial), values[i].at(trial)));
    }
    changes.trials += same ? 0 : 1;
  }
  std::erase_if(changes.columns, [](const auto& column) { return column.trials == 0; });
  std::stable_sort(changes.columns.begin(), changes.columns.end(),
                   [](const auto& a, const auto& b) { return a.trials > b.trials; });
  return changes;
}

constexpr std::size_t kShownDifferences = 12;

class BaselineComparison {
 public:
  BaselineComparison(report::Baseline baseline, const CheckRequest& request)
      : baseline_(std::move(baseline)),
        request_(request),
        runs_(ReadCells(request.runs, request.cell)) {
    if (!request.cell.empty()) KeepCellsOf(runs_, baseline_);
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
    report_.result = statistics::CheckRegression(cells, request_.regression);
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
    const std::span<const truth::Record> records = UsedRecords(cell, run);
    CheckedCell checked{.name = cell.name,
                        .baseline_seed = cell.seed,
                        .run_seed = run.identity.seed,
                        .baseline_trials = static_cast<std::int64_t>(cell.outcomes.size()),
                        .run_trials = static_cast<std::int64_t>(records.size())};
    checked.same_fields = CompareScenarios(cell, run);
    checked.paired = checked.same_fields && cell.seed == run.identity.seed;
    Compare(cell, run, records, checked);
    if (!run.builds.empty()) report_.run_build = run.builds.back();
    statistics::RegressionCell compared{.name = cell.name,
                                        .paired = checked.paired,
                                        .identical = checked.identical,
                                        .baseline = cell.metrics,
                                        .run = {},
                                        .schema = run.schema};
    for (const statistics::BaselineMetric& metric : cell.metrics) {
      compared.run.push_back(ValuesOf(metric.name, run.schema, records));
      if (compared.run.back().empty()) {
        report_.notes.push_back(
            fmt::format("{}: the run has no column for {}", cell.name, metric.name));
      }
    }
    NoteNewMetrics(cell, run.schema, records);
    if (checked.paired) {
      checked.records = CompareRecords(cell, records, compared.run);
      checked.records.only_hash = checked.records.trials == 0 && !checked.identical &&
                                  checked.baseline_trials == checked.run_trials;
    }
    report_.cells.push_back(std::move(checked));
    return compared;
  }

  // Names what the run's navigators count and the baseline does not know: nothing checks it.
  void NoteNewMetrics(const BaselineCell& cell, const truth::RecordSchema& schema,
                      std::span<const truth::Record> records) {
    std::vector<std::string> names;
    for (std::size_t column = 0; column < schema.size(); ++column) {
      const std::string& name = schema[column].name;
      const bool known = std::ranges::any_of(
          cell.metrics, [&](const auto& metric) { return metric.name == name; });
      if (!truth::IsOwnColumn(name) || known) continue;
      if (!statistics::ColumnValues(records, column).empty()) names.push_back(name);
    }
    if (names.empty()) return;
    report_.notes.push_back(fmt::format("{}: not in the baseline and not checked: {}", cell.name,
                                        fmt::join(names, ", ")));
  }

  // Returns the records of the run that are compared: at most as many as the baseline has.
  std::span<const truth::Record> UsedRecords(const BaselineCell& cell, const StoredRun& run) {
    const std::span<const truth::Record> records = run.prefix();
    if (records.empty()) {
      problems_.push_back({run.Label(), "holds no finished trials", "run some first"});
    } else if (static_cast<std::int64_t>(records.size()) < run.planned) {
      report_.notes.push_back(fmt::format("{}: unfinished, {} of {} trials are used", run.Label(),
                                          records.size(), run.planned));
    }
    for (const std::string& resolved : {cell.resolved, run.identity.resolved}) {
      std::vector<core::Problem> shared = SharedLayoutProblems(run.Label(), resolved);
      if (shared.empty()) continue;
      problems_.push_back(std::move(shared.front()));
      break;
    }
    const std::size_t used = std::min(records.size(), cell.outcomes.size());
    const std::size_t most = std::max(records.size(), cell.outcomes.size());
    if (used < most) {
      report_.notes.push_back(
          fmt::format("{}: of the {} the first {} of {} trials are used, as "
                      "many as the other has",
                      cell.name, used < records.size() ? "run" : "baseline", used, most));
    }
    return records.first(used);
  }

  // Judges the exact tier: the same build, seeds and settings give the same records. A build from
  // changed files goes by the name of the last commit, so that its name proves nothing.
  void Compare(const BaselineCell& cell, const StoredRun& run,
               std::span<const truth::Record> records, CheckedCell& checked) const {
    if (!checked.paired || checked.baseline_trials != checked.run_trials) return;
    checked.identical = batch::TrialHash(records) == cell.trial_hash;
    const bool same_build = run.builds.size() == 1 && run.builds.front() == baseline_.build &&
                            baseline_.build.find("-dirty") == std::string::npos;
    checked.not_deterministic =
        !checked.identical && same_build && cell.fingerprint == run.identity.fingerprint;
  }

  static std::vector<double> ValuesOf(const std::string& name, const truth::RecordSchema& schema,
                                      std::span<const truth::Record> records) {
    auto values = statistics::MetricValues(*statistics::FindMetric(name), schema, records)
                      .value_or(std::vector<double>());
    for (double& value : values) value = statistics::RoundForBaseline(value);
    return values;
  }

  // Tells how the scenarios differ. Returns whether the settings that decide rocks, start and goal
  // are the same.
  bool CompareScenarios(const BaselineCell& cell, const StoredRun& run) {
    if (cell.fingerprint == run.identity.fingerprint) return true;
    const BaselineScenario compared = CompareWithBaseline(cell.resolved, run.identity.resolved);
    if (!compared.younger.empty()) report_.notes.push_back(YoungerNote(cell, compared.younger));
    const std::vector<ScenarioDifference>& differences = compared.differences;
    for (std::size_t i = 0; i < std::min(differences.size(), kShownDifferences); ++i) {
      Tell(cell, differences[i]);
    }
    if (differences.size() > kShownDifferences) {
      report_.notes.push_back(
          fmt::format("{}: {} settings differ in all", cell.name, differences.size()));
    }
    return compared.same_fields;
  }

  static std::string YoungerNote(const BaselineCell& cell,
                                 const std::vector<std::string>& younger) {
    constexpr std::size_t kNamed = 3;
    const auto named = std::span(younger).first(std::min(kNamed, younger.size()));
    return fmt::format(
        "{}: {} younger than the baseline and at {}: {}{}", cell.name,
        younger.size() == 1 ? "a setting is" : fmt::format("{} settings are", younger.size()),
        younger.size() == 1 ? "its default" : "their defaults", fmt::join(named, ", "),
        younger.size() > kNamed ? ", ..." : "");
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
  const CheckRequest& request_;
  std::vector<StoredRun> runs_;
  report::RegressionReport report_;
  std::vector<core::Problem> problems_;
};

// `unknown`: whether the baseline has metrics that this program does not know.
Outcome OutcomeOf(const report::RegressionReport& report, RecordChange record_change,
                  bool unknown) {
  // Other records of the same build are a defect, whatever their distributions say.
  if (report::BrokenDeterminism(report)) return Outcome::kDiffers;
  const auto outcome = static_cast<Outcome>(statistics::ExitCode(report.result));
  const report::RecordFinding records = report::FindingOfRecords(report);
  const bool refuses = record_change == RecordChange::kRefuse;
  if (refuses && records == report::RecordFinding::kChanged) return Outcome::kDiffers;
  if (outcome != Outcome::kDone) return outcome;
  const bool apart = refuses && records == report::RecordFinding::kNotComparable;
  return unknown || apart ? Outcome::kInconclusive : outcome;
}

BaselineCheck CheckAgainstBaseline(const core::JsonValue& baseline, const CheckRequest& request) {
  std::vector<std::string> unknown;
  BaselineComparison comparison(report::ParseBaseline(baseline, &unknown), request);
  BaselineCheck check{comparison.Run()};
  if (!unknown.empty()) {
    check.report.notes.push_back(fmt::format(
        "metrics of the baseline that are unknown to this program: {}", fmt::join(unknown, ", ")));
  }
  check.outcome = OutcomeOf(check.report, request.record_change, !unknown.empty());
  return check;
}

}  // namespace

core::Result<CheckResult> Check(const CheckRequest& request, const Observer& observer) {
  return core::Attempt([&]() -> CheckResult {
    Journal journal(observer);
    const core::JsonValue document = core::LoadJsonFile(request.reference);
    if (!report::IsBaseline(document)) return CheckAgainstPublished(document, request, journal);
    return CheckAgainstBaseline(document, request);
  });
}

std::string CheckJson(const PublishedCheck& check) {
  return report::PublishedCheckJson(check.reference, check.result, static_cast<int>(check.outcome));
}

std::string CheckJson(const BaselineCheck& check) {
  return report::BaselineCheckJson(check.report, static_cast<int>(check.outcome));
}

}  // namespace rockyard::campaign
