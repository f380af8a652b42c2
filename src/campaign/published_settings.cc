#include "campaign/published_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "campaign/baseline_scenario.h"
#include "campaign/run_views.h"
#include "core/error.h"
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

}  // namespace rockyard::campaign
