#include "campaign/run_views.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "batch/trial_hash.h"
#include "core/error.h"
#include "core/json_text.h"
#include "statistics/clustered_rate.h"
#include "truth/measurement_record.h"

namespace rockyard::campaign {
namespace {

// The settings that decide which rocks a trial meets, and where it starts and ends.
std::string FieldsOf(const StoredRun& run) {
  const core::JsonValue document = core::ParseJson(run.identity.resolved, "resolved scenario");
  std::string text;
  for (const char* group : {"terrain", "course"}) {
    const core::JsonValue* value = document.Find(group);
    if (value != nullptr) text += core::DumpJson(*value);
  }
  return text;
}

// Of the scenario as it was run; NaN where that program had no such parameter.
double GoalTolerance_m(const std::string& resolved) {
  const core::JsonValue document = core::ParseJson(resolved, "resolved scenario");
  const core::JsonValue* at = &document;
  for (const char* key : {"navigation", "pathfinder", "goal_tolerance_m"}) {
    at = at->Find(key);
    if (at == nullptr) return std::numeric_limits<double>::quiet_NaN();
  }
  return at->IsNumber() ? at->number() : std::numeric_limits<double>::quiet_NaN();
}

// A run that is read column by column.
class Side {
 public:
  explicit Side(const StoredRun& run)
      : run_(run), store_(batch::ResultStore::Read(run.folder)), view_(ComparedView(run)) {
    const truth::ValueInfo* const layout = truth::FindColumn(run.schema, "layout");
    if (layout == nullptr) return;
    Read({*layout});
    view_.groups = statistics::DependentGroups(view_.schema, view_.records);
  }

  std::size_t trials() const { return run_.records.size(); }

  // With those of the columns that the run has. Valid until the next call.
  const report::ComparedRun& Read(const truth::RecordSchema& columns) {
    view_.schema.clear();
    for (const truth::ValueInfo& column : columns) {
      const truth::ValueInfo* own = truth::FindColumn(run_.schema, column.name);
      if (own != nullptr) view_.schema.push_back(*own);
    }
    view_.records = {};
    records_.clear();
    records_ = store_.Load(run_.cell, view_.schema);
    // A run under way may hold more trials by now.
    records_.resize(std::min(records_.size(), trials()));
    view_.records = batch::ContiguousPrefix(records_);
    return view_;
  }

 private:
  const StoredRun& run_;
  batch::ResultStore store_;
  report::ComparedRun view_;
  std::vector<truth::Record> records_;
};

// Adds what a comparison of other columns of the same trials says.
void AddColumns(report::RunComparison more, report::RunComparison& all) {
  all.shared_layouts = all.shared_layouts || more.shared_layouts;
  const auto append = [](auto& from, auto& to) { to.insert(to.end(), from.begin(), from.end()); };
  append(more.columns, all.columns);
  append(more.arrived_columns, all.arrived_columns);
}

}  // namespace

report::ComparedRun ComparedView(const StoredRun& run) {
  if (run.prefix().empty()) {
    throw core::UserError(run.Label(), "holds no finished trials to compare", "run some first");
  }
  return {run.identity.scenario, run.identity.seed, run.schema, run.prefix(), FieldsOf(run)};
}

statistics::ScenarioRun ScenarioView(const StoredRun& run) {
  return {run.identity.scenario, run.schema, run.prefix(), GoalTolerance_m(run.identity.resolved)};
}

report::SweepCellTrials SweepCellView(StoredRun run) {
  const report::Accounting accounting = AccountingOf(run);
  const auto stored = static_cast<std::int64_t>(run.records.size());
  run.records.resize(run.prefix().size());
  std::string hash = batch::TrialHash(run.records);
  return {.schema = run.schema,
          .prefix = std::move(run.records),
          .planned = run.planned,
          .stored = stored,
          .trial_hash = std::move(hash),
          .accounting = accounting,
          .stopping = StoppingOf(run)};
}

report::RunComparison CompareDrives(const StoredRun& first, const StoredRun& second,
                                    std::size_t values_at_once) {
  Side a(first);
  Side b(second);
  const std::size_t trials = std::max<std::size_t>(1, a.trials() + b.trials());
  const std::size_t width = std::max<std::size_t>(1, values_at_once / trials);
  const auto compare = [&](std::size_t from) {
    const auto begin = first.schema.begin() + static_cast<std::ptrdiff_t>(from);
    const std::size_t count = std::min(width, first.schema.size() - from);
    const truth::RecordSchema columns(begin, begin + static_cast<std::ptrdiff_t>(count));
    const report::ComparedRun& one = a.Read(columns);
    return report::CompareRuns(one, b.Read(columns));
  };
  report::RunComparison all = compare(0);
  for (std::size_t from = width; from < first.schema.size(); from += width) {
    AddColumns(compare(from), all);
  }
  return all;
}

}  // namespace rockyard::campaign
