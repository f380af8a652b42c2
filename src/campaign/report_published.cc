#include "campaign/report_published.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <system_error>

#include "campaign/published_settings.h"
#include "core/error.h"
#include "report/comparison_reference.h"
#include "report/page_data.h"
#include "statistics/published_comparison.h"

namespace rockyard::campaign {
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
