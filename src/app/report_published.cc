#include "app/report_published.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <system_error>

#include "app/console.h"
#include "app/published_settings.h"
#include "core/error.h"
#include "report/comparison_reference.h"
#include "report/page_data.h"
#include "statistics/published_comparison.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;

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

void PublishedTables::Load(const fs::path& file) {
  references_.push_back({file.parent_path(), report::LoadReference(file)});
}

PublishedTables::PublishedTables(const std::string& file) {
  if (!file.empty()) {
    Load(file);
    return;
  }
  for (const fs::path& each : StoredReferences()) {
    try {
      Load(each);
    } catch (const core::UserError& error) {
      PrintNote(fmt::format("{} is left out: {} {}", each.string(), error.problems().front().path,
                            error.problems().front().reason));
    }
  }
}

std::vector<std::string> PublishedTables::Tables(std::span<const StoredRun> runs) const {
  std::vector<std::string> tables(runs.size(), "null");
  for (const auto& [folder, reference] : references_) {
    // Families by how many earlier runs are of the same scenario.
    std::vector<std::vector<std::size_t>> families;
    std::map<std::string, std::size_t> earlier;
    for (std::size_t i = 0; i < runs.size(); ++i) {
      const std::string& scenario = runs[i].identity.scenario;
      if (tables[i] != "null" || !Names(reference, scenario)) continue;
      const std::size_t family = earlier[scenario]++;
      families.resize(std::max(families.size(), family + 1));
      families[family].push_back(i);
    }
    for (const std::vector<std::size_t>& family : families) {
      std::vector<const StoredRun*> members;
      members.reserve(family.size());
      for (const std::size_t i : family) members.push_back(&runs[i]);
      const statistics::ComparisonResult result =
          statistics::Compare(reference, PublishedViews(reference, folder, members));
      for (const std::size_t i : family) {
        tables[i] = report::PublishedJson(reference, result, runs[i].identity.scenario);
      }
    }
  }
  return tables;
}

}  // namespace rockyard::app
