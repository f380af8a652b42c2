#include "campaign/check.h"

#include <fmt/format.h>

#include <map>
#include <utility>

#include "batch/run_folder.h"
#include "campaign/journal.h"
#include "campaign/published_settings.h"
#include "campaign/run_source.h"
#include "core/error.h"
#include "core/json_file.h"
#include "report/baseline.h"
#include "report/comparison_reference.h"
#include "report/result_json.h"

namespace rockyard::campaign {
namespace {

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

}  // namespace

core::Result<CheckResult> Check(const CheckRequest& request, const Observer& observer) {
  return core::Attempt([&]() -> CheckResult {
    Journal journal(observer);
    const core::JsonValue document = core::LoadJsonFile(request.reference);
    if (!report::IsBaseline(document)) return CheckAgainstPublished(document, request, journal);
    return CheckAgainstBaseline(document, {.runs = request.runs,
                                           .cell = request.cell,
                                           .scenario_change = request.scenario_change,
                                           .record_change = request.record_change,
                                           .options = request.regression});
  });
}

std::string CheckJson(const PublishedCheck& check) {
  return report::PublishedCheckJson(check.reference, check.result, static_cast<int>(check.outcome));
}

std::string CheckJson(const BaselineCheck& check) {
  return report::BaselineCheckJson(check.report, static_cast<int>(check.outcome));
}

}  // namespace rockyard::campaign
