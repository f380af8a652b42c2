#include "campaign/run_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "batch/run_folder.h"
#include "batch/sqlite_database.h"
#include "batch/supervisor.h"
#include "batch/trial_hash.h"
#include "core/check.h"
#include "core/error.h"
#include "core/fields.h"
#include "core/json_file.h"
#include "core/json_text.h"
#include "experiments/make_experiment.h"
#include "scenario/ablations.h"
#include "scenario/load.h"
#include "scenario/sweep.h"
#include "statistics/clustered_rate.h"
#include "truth/measurement_record.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

// Returns "dead reckoning" for "dead_reckoning".
std::string Words(std::string_view name) {
  std::string words(name);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

template <typename Enum>
std::string Words(Enum value) {
  return Words(core::EnumNames<Enum>::kNames[static_cast<std::size_t>(value)]);
}

// Returns two lines: rover, gravity, soil and fidelity; by what the rover looks, drives and
// localizes. An experiment that does not drive has none.
std::vector<std::string> SetupInWords(const scenario::Scenario& scenario) {
  if (scenario.experiment.chosen().name() != "drive") return {};
  const trial::DriveParams& drive = scenario.drive;
  const rover::RoverParams& rover = drive.rover;
  return {fmt::format("rover {:g} m long, {:g} kg, wheels of {:g} cm; {:g} m/s2, {}; {} physics",
                      rover.geometry.length_m, rover.mass.total_kg,
                      200.0 * rover.geometry.wheel_radius_m, rover.physics.gravity_m_s2,
                      Words(drive.terrain.ground.soil.preset), Words(rover.fidelity)),
          fmt::format("looks by {}, drives by {}, localizes by {}",
                      Words(drive.sensors.terrain_sensors.chosen().name()),
                      Words(drive.navigation.navigators.chosen().name()),
                      Words(drive.localization.estimators.chosen().name()))};
}

// Returns what --cell takes: "0 (k=0.004), 1 (k=0.013), ...".
std::string CellList(const std::vector<batch::CellIdentity>& cells) {
  constexpr std::size_t kShown = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(cells.size(), kShown); ++i) {
    text += fmt::format("{}{} ({})", i == 0 ? "" : ", ", i, cells[i].name);
  }
  if (cells.size() > kShown) text += fmt::format(", ... {}", cells.size() - 1);
  return text;
}

// Returns whether the document has the form of scenario.resolved.json.
bool IsResolved(const core::JsonValue& document) {
  return document.Find("scenario") != nullptr && document.Find("provenance") != nullptr;
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
  if (scenario::IsSweep(document)) {
    throw core::UserError(path.string(), "is a sweep, not a scenario",
                          "`rockyard sweep FILE --dry-run` writes the scenario of each cell, and "
                          "without it runs them");
  }
  return IsResolved(document) ? core::JsonValue(*document.Find("scenario")) : document;
}

// Returns the name of the estimator; "" where the scenario is of another version of the program.
std::string Localization(const std::string& resolved) {
  const core::JsonValue document = core::ParseJson(resolved, "resolved scenario");
  const core::JsonValue* group = document.Find("localization");
  const core::JsonValue* found = group == nullptr ? nullptr : group->Find("estimator");
  const bool text = found != nullptr && found->Is(core::JsonValue::Type::kText);
  return text ? found->text() : std::string();
}

// Reads the scenario; returns nothing where it is of another version of the program.
std::optional<scenario::Scenario> TryRead(const std::string& resolved) {
  try {
    return scenario::ReadScenarioSealed(core::ParseJson(resolved, "resolved scenario"));
  } catch (const core::UserError&) {
    return std::nullopt;
  }
}

}  // namespace

scenario::Scenario LoadScenarioFrom(const fs::path& path, std::span<const std::string> overrides,
                                    const std::string& cell, const scenario::Scenario& defaults) {
  core::JsonValue document = LoadDocument(path, cell);
  // A run's own document has absolute paths.
  scenario::AnchorPlugins(document, path.parent_path());
  for (const std::string& assignment : overrides) core::ApplyOverride(document, assignment);
  return scenario::ReadScenario(document, defaults);
}

truth::RecordSchema ColumnsOf(const scenario::Scenario& scenario) {
  return experiments::MakeExperiment(scenario.experiment, scenario.drive)->schema();
}

std::optional<std::vector<std::string>> SettingsOf(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) return batch::ResultStore::Read(path).identity().settings;
  const core::JsonValue document = core::LoadJsonFile(path);
  if (!IsResolved(document)) return std::vector<std::string>();
  const core::JsonValue* list = document.Find("settings");
  return list == nullptr ? std::nullopt : core::TextsIn(*list);
}

bool PluginDecides(const std::string& resolved) {
  const auto sealed = TryRead(resolved);
  return sealed && sealed->drive.foreign();
}

scenario::Scenario ScenarioToDrive(const std::string& resolved, const std::string& source) {
  std::optional<scenario::Scenario> sealed = TryRead(resolved);
  if (sealed && !sealed->drive.foreign()) return *std::move(sealed);
  return scenario::ReadScenario(core::ParseJson(resolved, source));
}

scenario::Sweep StoredSweep(const batch::ResultStore& store) {
  const batch::CampaignIdentity& identity = store.identity();
  // The parameters that axes vary are those of a cell, also of what is no part of the program.
  const scenario::Scenario defaults =
      TryRead(identity.cells.front().resolved).value_or(scenario::Scenario{});
  scenario::Scenario known;
  known.drive.navigation.navigators = defaults.drive.navigation.navigators;
  known.drive.localization.estimators = defaults.drive.localization.estimators;
  known.drive.perception.readers = defaults.drive.perception.readers;
  return scenario::ParseSweep(identity.design, {.defaults = std::move(known), .sealed = true});
}

CellReader::CellReader(fs::path folder, const batch::ResultStore& store)
    : folder_(std::move(folder)),
      store_(store),
      ends_(batch::StoredEnds(store)),
      faults_(static_cast<std::size_t>(store.cells()), 0) {
  for (const batch::InfrastructureFault& fault : store.InfrastructureFaults()) {
    ++faults_.at(static_cast<std::size_t>(fault.id.cell));
  }
}

StoredRun CellReader::Load(int cell, StoredValues values) const {
  const auto index = static_cast<std::size_t>(cell);
  const bool all = values == StoredValues::kAll;
  if (!all) store_.Check(cell);
  return {.folder = folder_,
          .cell = cell,
          .identity = store_.identity().cells.at(index),
          .schema = store_.identity().schema,
          .shard = store_.identity().shard,
          .settings = store_.identity().settings,
          .planned = store_.planned(cell),
          .builds = store_.Builds(),
          .records = all ? store_.Load(cell) : store_.Load(cell, truth::RecordSchema()),
          .infrastructure_faults = faults_[index],
          .rule = store_.rule(),
          .state = ends_[index]};
}

report::Accounting AccountingOf(const StoredRun& run) {
  report::Accounting accounting;
  accounting.planned = run.shard.Share(run.planned);
  accounting.faulted = std::count_if(run.records.begin(), run.records.end(), truth::IsFault);
  const auto stored = static_cast<std::int64_t>(run.records.size());
  accounting.completed = stored - accounting.faulted;
  accounting.pending = accounting.planned - stored;
  accounting.infrastructure_faults = run.infrastructure_faults;
  ENSURE(accounting.pending >= 0);
  return accounting;
}

std::optional<report::StoppingReport> StoppingOf(const StoredRun& run) {
  if (!run.rule) return std::nullopt;
  // Must be in the order of batch::CellEnd, and stay: summary.json has these names.
  constexpr std::array kEndNames = {"open", "max_trials", "precise", "budget"};
  const bool adaptive = run.rule->allocation == batch::Allocation::kAdaptive;
  return report::StoppingReport{.half_width = run.rule->half_width,
                                .max_trials = run.rule->max_trials,
                                .block = run.rule->block,
                                .confidence = run.rule->confidence,
                                .allocation = adaptive ? "adaptive" : "uniform",
                                .budget = run.rule->budget,
                                .end = kEndNames[static_cast<std::size_t>(run.state.end)],
                                .trials = run.state.counts.trials,
                                .drives = run.state.counts.drives(),
                                .successes = run.state.counts.declared_successes,
                                .low = run.state.interval.low,
                                .high = run.state.interval.high};
}

std::string StoredRun::Label() const {
  return identity.name.empty() ? folder.string()
                               : fmt::format("{}, cell {}", folder.string(), identity.name);
}

int FindCell(const fs::path& folder, const std::vector<batch::CellIdentity>& cells,
             const std::string& wanted) {
  if (wanted.empty() && cells.size() == 1) return 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const bool named = !wanted.empty() && cells[i].name == wanted;
    if (named || std::to_string(i) == wanted) return static_cast<int>(i);
  }
  if (wanted.empty()) {
    throw core::UserError(
        folder.string(), fmt::format("holds a campaign of {} cells", cells.size()),
        "`rockyard trace`, `rockyard replay`, `rockyard check`, `rockyard compare` and "
        "`rockyard report` take one by --cell: " +
            CellList(cells));
  }
  throw core::UserError("--cell", fmt::format("\"{}\" is no cell of {}", wanted, folder.string()),
                        "use one of " + CellList(cells));
}

StoredRun ReadRun(const fs::path& folder, const std::string& cell, StoredValues values) {
  const batch::ResultStore store = batch::ResultStore::Read(folder);
  return CellReader(folder, store).Load(FindCell(folder, store.identity().cells, cell), values);
}

std::vector<StoredRun> ReadCampaign(const fs::path& folder) {
  const batch::ResultStore store = batch::ResultStore::Read(folder);
  const CellReader loader(folder, store);
  std::vector<StoredRun> runs;
  runs.reserve(static_cast<std::size_t>(store.cells()));
  for (int cell = 0; cell < store.cells(); ++cell) runs.push_back(loader.Load(cell));
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

std::string BuildName(const std::string& program) {
  const core::Provenance p = core::CurrentProvenance();
  return fmt::format("{}{} {}, {}, {}", program.empty() ? "" : program + " with ", p.version,
                     p.commit, p.compiler, p.flags);
}

report::RunDescription Describe(const StoredRun& run, int threads) {
  const std::optional<scenario::Scenario> scenario = TryRead(run.identity.resolved);
  return {
      .scenario = run.identity.scenario,
      .fingerprint = run.identity.fingerprint,
      .resolved = run.identity.resolved,
      .settings = run.settings,
      .setup = scenario ? SetupInWords(*scenario) : std::vector<std::string>(),
      .ablations = scenario ? scenario::AblationsInForce(*scenario) : std::vector<std::string>(),
      .localization = Localization(run.identity.resolved),
      .seed = run.identity.seed,
      .planned = run.planned,
      .stored = static_cast<std::int64_t>(run.records.size()),
      .trial_hash = batch::TrialHash(run.prefix()),
      .provenance = core::CurrentProvenance(),
      .builds = run.builds,
      .threads = threads,
      .accounting = AccountingOf(run),
      .stopping = StoppingOf(run),
      .shard_index = run.shard.index,
      .shard_count = run.shard.count};
}

namespace {

// Returns the settings that decide which rocks a trial meets, and where it starts and ends: trials
// of runs that share them, and the seed, are pairs. Must name the same groups as DecidesFields
// (reference_cases.cc).
std::string FieldsOf(const StoredRun& run) {
  const core::JsonValue document = core::ParseJson(run.identity.resolved, "resolved scenario");
  std::string text;
  for (const char* group : {"terrain", "course"}) {
    const core::JsonValue* value = document.Find(group);
    if (value != nullptr) text += core::DumpJson(*value);
  }
  return text;
}

// Returns the goal tolerance of the scenario as it was run; NaN where that program had no such
// parameter.
double GoalTolerance_m(const std::string& resolved) {
  const core::JsonValue document = core::ParseJson(resolved, "resolved scenario");
  const core::JsonValue* at = &document;
  for (const char* key : {"navigation", "pathfinder", "goal_tolerance_m"}) {
    at = at->Find(key);
    if (at == nullptr) return std::numeric_limits<double>::quiet_NaN();
  }
  return at->IsNumber() ? at->number() : std::numeric_limits<double>::quiet_NaN();
}

// A run that is read column by column.
class Side {
 public:
  explicit Side(const StoredRun& run)
      : run_(run), store_(batch::ResultStore::Read(run.folder)), view_(ComparedView(run)) {
    const truth::ValueInfo* const layout = truth::FindColumn(run.schema, "layout");
    if (layout == nullptr) return;
    Read({*layout});
    view_.groups = statistics::DependentGroups(view_.schema, view_.records);
  }

  std::size_t trials() const { return run_.records.size(); }

  // Returns the run with those of the columns that it has. Valid until the next call.
  const report::ComparedRun& Read(const truth::RecordSchema& columns) {
    view_.schema.clear();
    for (const truth::ValueInfo& column : columns) {
      const truth::ValueInfo* own = truth::FindColumn(run_.schema, column.name);
      if (own != nullptr) view_.schema.push_back(*own);
    }
    view_.records = {};
    records_.clear();
    records_ = store_.Load(run_.cell, view_.schema);
    // A run under way may hold more trials by now.
    records_.resize(std::min(records_.size(), trials()));
    view_.records = batch::ContiguousPrefix(records_);
    return view_;
  }

 private:
  const StoredRun& run_;
  batch::ResultStore store_;
  report::ComparedRun view_;
  std::vector<truth::Record> records_;
};

// Adds what a comparison of other columns of the same trials says.
void AddColumns(report::RunComparison more, report::RunComparison& all) {
  all.shared_layouts = all.shared_layouts || more.shared_layouts;
  const auto append = [](auto& from, auto& to) { to.insert(to.end(), from.begin(), from.end()); };
  append(more.columns, all.columns);
  append(more.arrived_columns, all.arrived_columns);
  append(more.only_first, all.only_first);
  append(more.only_second, all.only_second);
}

// Returns the columns of the first run, and what only navigators of the second one count.
truth::RecordSchema ColumnsOfBoth(const StoredRun& first, const StoredRun& second) {
  truth::RecordSchema columns = first.schema;
  for (const truth::ValueInfo& column : second.schema) {
    const bool known = truth::FindColumn(first.schema, column.name) != nullptr;
    if (truth::IsOwnColumn(column.name) && !known) columns.push_back(column);
  }
  return columns;
}

}  // namespace

report::ComparedRun ComparedView(const StoredRun& run) {
  if (run.prefix().empty()) {
    throw core::UserError(run.Label(), "holds no finished trials to compare", "run some first");
  }
  return {run.identity.scenario, run.identity.seed, run.schema, run.prefix(), FieldsOf(run)};
}

statistics::ScenarioRun ScenarioView(const StoredRun& run) {
  return {run.identity.scenario, run.schema, run.prefix(), GoalTolerance_m(run.identity.resolved)};
}

report::SweepCellTrials SweepCellView(StoredRun run) {
  const report::Accounting accounting = AccountingOf(run);
  const auto stored = static_cast<std::int64_t>(run.records.size());
  run.records.resize(run.prefix().size());
  std::string hash = batch::TrialHash(run.records);
  return {.schema = run.schema,
          .prefix = std::move(run.records),
          .planned = run.planned,
          .stored = stored,
          .trial_hash = std::move(hash),
          .accounting = accounting,
          .stopping = StoppingOf(run)};
}

report::RunComparison CompareDrives(const StoredRun& first, const StoredRun& second,
                                    std::size_t values_at_once) {
  Side a(first);
  Side b(second);
  const std::size_t trials = std::max<std::size_t>(1, a.trials() + b.trials());
  const std::size_t width = std::max<std::size_t>(1, values_at_once / trials);
  const truth::RecordSchema both = ColumnsOfBoth(first, second);
  const auto compare = [&](std::size_t from) {
    const auto begin = both.begin() + static_cast<std::ptrdiff_t>(from);
    const std::size_t count = std::min(width, both.size() - from);
    const truth::RecordSchema columns(begin, begin + static_cast<std::ptrdiff_t>(count));
    const report::ComparedRun& one = a.Read(columns);
    return report::CompareRuns(one, b.Read(columns));
  };
  report::RunComparison all = compare(0);
  for (std::size_t from = width; from < both.size(); from += width) {
    AddColumns(compare(from), all);
  }
  return all;
}

}  // namespace rockyard::campaign
