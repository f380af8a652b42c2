#include "app/run_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>
#include <utility>

#include "batch/run_folder.h"
#include "batch/trial_hash.h"
#include "core/json_file.h"
#include "core/json_text.h"
#include "scenario/ablations.h"
#include "scenario/load.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;

// "0 (k=0.004), 1 (k=0.013), ...": what --cell takes.
std::string CellList(const std::vector<batch::CellIdentity>& cells) {
  constexpr std::size_t kShown = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(cells.size(), kShown); ++i) {
    text += fmt::format("{}{} ({})", i == 0 ? "" : ", ", i, cells[i].name);
  }
  if (cells.size() > kShown) text += fmt::format(", ... {}", cells.size() - 1);
  return text;
}

int FindCell(const fs::path& folder, const std::vector<batch::CellIdentity>& cells,
             const std::string& wanted) {
  if (wanted.empty() && cells.size() == 1) return 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool named = !wanted.empty() && cells[i].name == wanted;
    if (named || std::to_string(i) == wanted) return static_cast<int>(i);
  }
  if (wanted.empty()) {
    throw core::UserError(folder.string(),
                          fmt::format("holds a campaign of {} cells", cells.size()),
                          "choose one of them with --cell: " + CellList(cells));
  }
  throw core::UserError("--cell", fmt::format("\"{}\" is no cell of {}", wanted, folder.string()),
                        "use one of " + CellList(cells));
}

StoredRun LoadCell(const fs::path& folder, const batch::ResultStore& store, int cell) {
  return {.folder = folder,
          .cell = cell,
          .identity = store.identity().cells.at(static_cast<std::size_t>(cell)),
          .schema = store.identity().schema,
          .shard = store.identity().shard,
          .planned = store.planned(cell),
          .builds = store.Builds(),
          .records = store.Load(cell)};
}

core::JsonValue LoadDocument(const fs::path& path, const std::string& cell) {
  std::error_code error;
  if (fs::is_directory(path, error)) {
    const batch::ResultStore store = batch::ResultStore::Read(path);
    const std::vector<batch::CellIdentity>& cells = store.identity().cells;
    const int index = FindCell(path, cells, cell);
    return core::ParseJson(cells[static_cast<std::size_t>(index)].resolved, path.string());
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

// None where the scenario is of another version of the program.
std::vector<std::string> AblationsIn(const std::string& resolved) {
  try {
    return scenario::AblationsInForce(scenario::ParseScenario(resolved));
  } catch (const core::UserError&) {
    return {};
  }
}

}  // namespace

scenario::Scenario LoadScenarioFrom(const fs::path& path, std::span<const std::string> overrides,
                                    const std::string& cell) {
  core::JsonValue document = LoadDocument(path, cell);
  for (const std::string& assignment : overrides) core::ApplyOverride(document, assignment);
  return scenario::ReadScenario(document);
}

std::string StoredRun::Label() const {
  return identity.name.empty() ? folder.string()
                               : fmt::format("{}, cell {}", folder.string(), identity.name);
}

StoredRun ReadRun(const fs::path& folder, const std::string& cell) {
  const batch::ResultStore store = batch::ResultStore::Read(folder);
  return LoadCell(folder, store, FindCell(folder, store.identity().cells, cell));
}

std::vector<StoredRun> ReadCampaign(const fs::path& folder) {
  const batch::ResultStore store = batch::ResultStore::Read(folder);
  std::vector<StoredRun> runs;
  for (int cell = 0; cell < store.cells(); ++cell) runs.push_back(LoadCell(folder, store, cell));
  return runs;
}

std::string CellName(const StoredRun& run) {
  return run.identity.name.empty() ? run.identity.scenario : run.identity.name;
}

void RequireWhole(const StoredRun& run) {
  if (run.shard.whole()) return;
  throw core::UserError(
      run.folder.string(),
      fmt::format("holds shard {}/{} of a campaign", run.shard.index, run.shard.count),
      "put all shards together first: rockyard merge SHARD... --out DIR");
}

std::string BuildName() {
  const core::Provenance p = core::CurrentProvenance();
  return fmt::format("{} {}, {}, {}, {}", p.version, p.commit, p.compiler, p.flags, p.cpu_level);
}

report::RunDescription Describe(const StoredRun& run, int threads) {
  return {.scenario = run.identity.scenario,
          .fingerprint = run.identity.fingerprint,
          .resolved = run.identity.resolved,
          .ablations = AblationsIn(run.identity.resolved),
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
