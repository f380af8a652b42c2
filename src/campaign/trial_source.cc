#include "campaign/trial_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "campaign/run_source.h"
#include "campaign/shell_word.h"
#include "core/error.h"
#include "core/json_text.h"
#include "report/trace_view.h"
#include "scenario/load.h"

namespace rockyard::campaign {
namespace {

// Without the trial, which comes last.
std::string RequestWords(const TrialRequest& request) {
  std::string words = ShellPath(request.source);
  if (!request.cell.empty()) words += fmt::format(" --cell {}", ShellWord(request.cell));
  if (request.seed) words += fmt::format(" --seed {}", *request.seed);
  for (const std::string& assignment : request.overrides) {
    words += fmt::format(" --set {}", ShellWord(assignment));
  }
  return words;
}

TrialSource FromRun(const TrialRequest& request) {
  if (request.seed || !request.overrides.empty()) {
    throw core::UserError(
        request.seed ? "--seed" : "--set", "makes another trial than the one in the run's store",
        "name the scenario file, or a scenario.resolved.json, instead of the folder");
  }
  const StoredRun run = ReadRun(request.source, request.cell);
  const auto found = std::find_if(run.records.begin(), run.records.end(), [&](const auto& record) {
    return record.trial == request.trial;
  });
  const auto trial = static_cast<std::int64_t>(request.trial);
  if (found == run.records.end() && trial < run.planned && run.shard.Has(trial)) {
    return StoredTrial(request, run.identity, run.builds, std::nullopt);  // pending
  }
  if (found == run.records.end()) {
    throw core::UserError(
        "--trial", fmt::format("trial {} is not stored in {}", request.trial, run.Label()),
        fmt::format("use one of the {} finished trials, or name the scenario file instead",
                    run.records.size()));
  }
  return StoredTrial(request, run.identity, run.builds, *found);
}

TrialSource FromScenario(const TrialRequest& request) {
  if (!request.cell.empty()) {
    throw core::UserError("--cell", "is for the folder of a campaign, and this is a scenario",
                          "leave it out");
  }
  std::vector<std::string> overrides = request.overrides;
  if (request.seed) overrides.push_back(fmt::format("seed={}", *request.seed));
  TrialSource source;
  source.scenario = LoadScenarioFrom(request.source, overrides);
  source.seed = static_cast<std::uint64_t>(source.scenario.seed);
  source.request = RequestWords(request);
  return source;
}

}  // namespace

TrialSource FindTrial(const TrialRequest& request) {
  std::error_code error;
  if (std::filesystem::is_directory(request.source, error)) return FromRun(request);
  return FromScenario(request);
}

TrialSource StoredTrial(const TrialRequest& request, const batch::CellIdentity& cell,
                        std::vector<std::string> builds, std::optional<truth::Record> stored) {
  TrialSource source;
  source.scenario = scenario::ReadScenario(core::ParseJson(cell.resolved, request.source));
  source.seed = cell.seed;
  source.cell = cell.name;
  source.request = RequestWords(request);
  source.stored = std::move(stored);
  source.builds = std::move(builds);
  return source;
}

std::string ReplayCommandLine(const TrialSource& source, std::uint64_t trial) {
  return fmt::format("rockyard replay {} --trial {}", source.request, trial);
}

std::vector<core::Problem> CompareWithStore(const TrialRequest& request, const TrialSource& source,
                                            const truth::RecordSchema& schema,
                                            const truth::Record& record) {
  const auto differences = report::RecordDifferences(schema, *source.stored, record);
  std::vector<core::Problem> problems;
  if (differences.empty()) return problems;
  problems.reserve(differences.size() + 1);
  for (const std::string& difference : differences) {
    problems.push_back({fmt::format("trial {}", request.trial), difference, ""});
  }
  const bool other_build =
      std::find(source.builds.begin(), source.builds.end(), BuildName()) == source.builds.end();
  problems.push_back({request.source, "this trial is not the stored one: the records differ",
                      other_build
                          ? "use the program that made the run: " + source.builds.front()
                          : "the same program made it: this is a defect, please report it"});
  return problems;
}

}  // namespace rockyard::campaign
