#include "app/run_source.h"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "batch/run_folder.h"
#include "batch/trial_hash.h"
#include "core/json_file.h"
#include "core/json_text.h"
#include "scenario/load.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;

core::JsonValue LoadDocument(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) {
    return core::ParseJson(batch::ResultStore::Read(path).identity().resolved, path.string());
  }
  core::JsonValue document = core::LoadJsonFile(path);
  const core::JsonValue* inner = document.Find("scenario");
  const bool resolved = inner != nullptr && document.Find("provenance") != nullptr;
  return resolved ? core::JsonValue(*inner) : document;
}

// Absent where the scenario is of another version of the program.
std::string Localization(const std::string& resolved) {
  const core::JsonValue document = core::ParseJson(resolved, "resolved scenario");
  const core::JsonValue* sensors = document.Find("sensors");
  const core::JsonValue* found = sensors == nullptr ? nullptr : sensors->Find("localization");
  const bool text = found != nullptr && found->Is(core::JsonValue::Type::kText);
  return text ? found->text() : std::string();
}

}  // namespace

scenario::Scenario LoadScenarioFrom(const fs::path& path, std::span<const std::string> overrides) {
  core::JsonValue document = LoadDocument(path);
  for (const std::string& assignment : overrides) core::ApplyOverride(document, assignment);
  return scenario::ReadScenario(document);
}

StoredRun ReadRun(const fs::path& folder) {
  const batch::ResultStore store = batch::ResultStore::Read(folder);
  return {folder, store.identity(), store.planned(), store.Builds(), store.Load()};
}

std::string BuildName() {
  const core::Provenance p = core::CurrentProvenance();
  return fmt::format("{} {}, {}, {}, {}", p.version, p.commit, p.compiler, p.flags, p.cpu_level);
}

report::RunDescription Describe(const StoredRun& run, int threads) {
  return {.scenario = run.identity.scenario,
          .fingerprint = run.identity.fingerprint,
          .resolved = run.identity.resolved,
          .localization = Localization(run.identity.resolved),
          .seed = run.identity.seed,
          .planned = run.planned,
          .stored = static_cast<std::int64_t>(run.records.size()),
          .trial_hash = batch::TrialHash(run.prefix()),
          .provenance = core::CurrentProvenance(),
          .builds = run.builds,
          .threads = threads};
}

}  // namespace rockyard::app
