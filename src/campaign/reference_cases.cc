#include "campaign/reference_cases.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "batch/run_folder.h"
#include "batch/trial_hash.h"
#include "campaign/output_folder.h"
#include "campaign/run_source.h"
#include "core/error.h"
#include "core/json_file.h"
#include "core/json_text.h"
#include "report/atomic_file.h"
#include "report/comparison_reference.h"
#include "report/page_data.h"
#include "scenario/load.h"
#include "truth/measurement_record.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

// Joins the builds that wrote trials of the runs: there must be one if an exact comparison is to be
// possible.
std::string Joined(const std::set<std::string>& builds) {
  return fmt::format("{}", fmt::join(builds, "; "));
}

// Returns what would make the run a bad baseline.
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

core::Result<report::Baseline> WriteBaseline(const BaselineRequest& request,
                                             const std::filesystem::path& file) {
  return core::Attempt([&] {
    if (request.reason.find_first_not_of(" \t\n") == std::string::npos) {
      throw core::UserError("--reason", "is empty", "say why the numbers may be what they are");
    }
    CheckOutputFile("--out", file.string());
    report::Baseline baseline = GatherBaseline(request);
    report::WriteFileAtomically(file, report::BaselineJson(baseline));
    return baseline;
  });
}

namespace {

using batch::ScenarioDifference;

// Returns whether a setting, or a group of settings that is new as a whole, is at its default.
bool AtDefault(const std::string& path, const std::vector<ScenarioDifference>& from_defaults) {
  return std::none_of(from_defaults.begin(), from_defaults.end(), [&](const auto& each) {
    return each.path == path || each.path.starts_with(path + ".");
  });
}

// Returns whether a setting moves rocks, start or goal, so that trials of equal seed and index are
// no pairs. Must name the same groups as FieldsOf (run_source.cc).
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

namespace {

using Settings = std::vector<std::string>;

constexpr std::size_t kMaxShown = 12;

// Returns the settings in which the run differs from the scenario file; nothing where the file
// cannot be read.
std::optional<Settings> DifferencesFrom(const fs::path& file, const StoredRun& run,
                                        Journal& journal) {
  try {
    const std::string published =
        scenario::ResolvedJson(scenario::ReadScenarioSealed(core::LoadJsonFile(file)));
    // The run may be of an older program, which had fewer settings.
    const BaselineScenario compared = CompareWithBaseline(run.identity.resolved, published);
    Settings settings;
    for (const batch::ScenarioDifference& each : compared.differences) {
      if (settings.size() == kMaxShown) {
        settings.push_back(fmt::format("and {} more", compared.differences.size() - kMaxShown));
        break;
      }
      settings.push_back(
          fmt::format("{} is {}, {} in {}", each.path, each.first, each.second, file.string()));
    }
    return settings;
  } catch (const core::UserError& error) {
    const core::Problem& problem = error.problems().front();
    journal.Warn(fmt::format("whether {} is the published case is not known: {} {}", run.Label(),
                             problem.path, problem.reason));
    return std::nullopt;
  }
}

Settings OtherSettings(const statistics::PublishedReference& reference, const fs::path& folder,
                       const StoredRun& run, Journal& journal) {
  const auto found =
      std::find_if(reference.scenarios.begin(), reference.scenarios.end(),
                   [&](const auto& scenario) { return scenario.name == run.identity.scenario; });
  if (found != reference.scenarios.end()) {
    const fs::path file = (folder / found->file).lexically_normal();
    if (std::optional<Settings> settings = DifferencesFrom(file, run, journal)) return *settings;
  }
  return run.settings.value_or(Settings());
}

std::vector<fs::path> StoredReferences(const std::string& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

bool Names(const statistics::PublishedReference& reference, const std::string& scenario) {
  return std::any_of(
      reference.values.begin(), reference.values.end(),
      [&](const statistics::PublishedValue& value) { return value.scenario == scenario; });
}

}  // namespace

std::vector<statistics::ScenarioRun> PublishedViews(const statistics::PublishedReference& reference,
                                                    const fs::path& folder,
                                                    std::span<const StoredRun* const> runs,
                                                    Journal& journal) {
  std::vector<statistics::ScenarioRun> views;
  views.reserve(runs.size());
  for (const StoredRun* run : runs) {
    views.push_back(ScenarioView(*run));
    views.back().other_settings = OtherSettings(reference, folder, *run, journal);
  }
  return views;
}

void PublishedTables::Load(const fs::path& file) {
  references_.push_back({file.parent_path(), report::LoadReference(file)});
}

PublishedTables::PublishedTables(const std::string& file, std::string folder, Journal& journal)
    : folder_(std::move(folder)), journal_(journal) {
  if (!file.empty()) {
    Load(file);
    return;
  }
  for (const fs::path& each : StoredReferences(folder_)) {
    try {
      Load(each);
    } catch (const core::UserError& error) {
      journal.Warn(fmt::format("{} is left out: {} {}", each.string(),
                               error.problems().front().path, error.problems().front().reason));
    }
  }
}

std::string PublishedTables::Table(const StoredRun& run) const {
  for (const auto& [folder, reference] : references_) {
    if (!Names(reference, run.identity.scenario)) continue;
    const std::array runs{&run};
    return report::PublishedJson(
        reference,
        statistics::Compare(reference, PublishedViews(reference, folder, runs, journal_)),
        run.identity.scenario);
  }
  return "null";
}

std::string PublishedTables::WhyNone() const {
  if (references_.empty()) {
    return fmt::format(
        "no published values stand beside the runs: {} holds no reference; name one with --against "
        "FILE",
        folder_);
  }
  return fmt::format(
      "no published values stand beside the runs: no reference in {} names their scenarios",
      folder_);
}

}  // namespace rockyard::campaign
