#include "campaign/run_views.h"

#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "batch/trial_hash.h"
#include "core/error.h"
#include "core/json_text.h"

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

}  // namespace rockyard::campaign
