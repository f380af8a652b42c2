#include "campaign/published_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <system_error>

#include "campaign/make_baseline.h"
#include "campaign/run_views.h"
#include "core/error.h"
#include "report/comparison_reference.h"
#include "report/page_data.h"
#include "scenario/load.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

using Settings = std::vector<std::string>;

constexpr std::size_t kMaxShown = 12;

// Nothing where the file cannot be read.
std::optional<Settings> DifferencesFrom(const fs::path& file, const StoredRun& run,
                                        Journal& journal) {
  try {
    const std::string published = scenario::ResolvedJson(LoadScenarioFrom(file));
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

constexpr const char* kReferenceFolder = "results/reference";

std::vector<fs::path> StoredReferences() {
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(kReferenceFolder, error)) {
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

PublishedTables::PublishedTables(const std::string& file, Journal& journal) : journal_(journal) {
  if (!file.empty()) {
    Load(file);
    return;
  }
  for (const fs::path& each : StoredReferences()) {
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
        "no published values stand beside the runs: {} below the working folder holds no "
        "reference; name one with --against FILE",
        kReferenceFolder);
  }
  return fmt::format(
      "no published values stand beside the runs: no reference in {} names their scenarios",
      kReferenceFolder);
}

}  // namespace rockyard::campaign
