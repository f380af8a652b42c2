#include "campaign/make_baseline.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "batch/run_folder.h"
#include "batch/trial_hash.h"
#include "campaign/run_source.h"
#include "core/error.h"
#include "core/json_text.h"
#include "scenario/load.h"
#include "truth/measurement_record.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

// Every build that wrote trials of the runs: one, if an exact comparison is to be possible.
std::string Joined(const std::set<std::string>& builds) {
  return fmt::format("{}", fmt::join(builds, "; "));
}

// What would make a bad baseline.
std::vector<core::Problem> BaselineProblems(const StoredRun& run) {
  if (truth::IsMeasurement(run.schema)) {
    return {{run.Label(), "drives nothing, so that no metric is defined", "name runs of drives"}};
  }
  if (run.prefix().empty()) return {{run.Label(), "holds no finished trials", "run some first"}};
  if (static_cast<std::int64_t>(run.prefix().size()) < run.planned) {
    return {{run.Label(),
             fmt::format("is unfinished: {} of {} trials", run.prefix().size(), run.planned),
             "finish it: the same `rockyard run` or `rockyard sweep` with --resume"}};
  }
  return SharedLayoutProblems(run.Label(), run.identity.resolved);
}

report::BaselineCell CellOf(const StoredRun& run) {
  report::BaselineCell cell{.name = CellName(run),
                            .scenario = run.identity.scenario,
                            .fingerprint = run.identity.fingerprint,
                            .resolved = run.identity.resolved,
                            .seed = run.identity.seed,
                            .trial_hash = batch::TrialHash(run.prefix()),
                            .outcomes = {},
                            .metrics = {}};
  report::FillBaselineCell(run.schema, run.prefix(), cell);
  return cell;
}

report::Baseline GatherBaseline(const BaselineRequest& request) {
  report::Baseline baseline;
  baseline.name = request.name;
  baseline.reason = request.reason;
  std::set<std::string> builds;
  std::vector<core::Problem> problems;
  for (const std::string& path : request.runs) {
    for (const fs::path& folder : batch::FindRuns(path)) {
      for (const StoredRun& run : ReadCampaign(folder)) {
        RequireWhole(run);
        for (core::Problem& problem : BaselineProblems(run)) problems.push_back(std::move(problem));
        builds.insert(run.builds.begin(), run.builds.end());
        baseline.cells.push_back(CellOf(run));
      }
    }
  }
  for (std::size_t i = 0; i < baseline.cells.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (baseline.cells[i].name != baseline.cells[j].name) continue;
      problems.push_back(
          {baseline.cells[i].name, "is the name of two cells", "name runs of different scenarios"});
    }
  }
  if (!problems.empty()) throw core::UserError(std::move(problems));
  baseline.build = Joined(builds);
  return baseline;
}

}  // namespace

core::Result<report::Baseline> MakeBaseline(const BaselineRequest& request) {
  return core::Attempt([&] { return GatherBaseline(request); });
}

namespace {

using batch::ScenarioDifference;

// A setting, or a group of them that is new as a whole.
bool AtDefault(const std::string& path, const std::vector<ScenarioDifference>& from_defaults) {
  return std::none_of(from_defaults.begin(), from_defaults.end(), [&](const auto& each) {
    return each.path == path || each.path.starts_with(path + ".");
  });
}

bool DecidesFields(const std::string& path) {
  return path.starts_with("terrain.") || path.starts_with("course.");
}

}  // namespace

BaselineScenario CompareWithBaseline(const std::string& baseline, const std::string& run) {
  const std::vector<ScenarioDifference> from_defaults =
      batch::FindScenarioDifferences(scenario::DefaultsJson(), run);
  BaselineScenario compared;
  for (ScenarioDifference& each : batch::FindScenarioDifferences(baseline, run)) {
    if (each.path == "seed") continue;
    if (each.first == "absent" && AtDefault(each.path, from_defaults)) {
      compared.younger.push_back(std::move(each.path));
      continue;
    }
    if (DecidesFields(each.path)) compared.same_fields = false;
    compared.differences.push_back(std::move(each));
  }
  return compared;
}

std::vector<core::Problem> SharedLayoutProblems(const std::string& label,
                                                const std::string& resolved) {
  const core::JsonValue document = core::ParseJson(resolved, "resolved scenario");
  const core::JsonValue* course = document.Find("course");
  const core::JsonValue* group = course == nullptr ? nullptr : course->Find("trials_per_layout");
  if (group == nullptr || !group->IsNumber() || group->number() <= 1.0) return {};
  return {
      {label,
       fmt::format("has {:g} trials on each field of rocks: they are not independent, so that "
                   "no false-alarm rate holds",
                   group->number()),
       "run it anew, by `rockyard run` or `rockyard sweep` with --set course.trials_per_layout=1"}};
}

}  // namespace rockyard::campaign
