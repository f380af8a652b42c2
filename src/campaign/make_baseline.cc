#include "campaign/make_baseline.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <set>
#include <utility>

#include "batch/run_folder.h"
#include "batch/trial_hash.h"
#include "campaign/baseline_scenario.h"
#include "campaign/run_source.h"
#include "core/error.h"
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

}  // namespace rockyard::campaign
