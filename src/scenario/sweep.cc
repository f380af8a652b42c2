#include "scenario/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "core/error.h"
#include "core/hash.h"
#include "core/json_file.h"
#include "core/json_text.h"
#include "plugin/plugin_use.h"
#include "scenario/load.h"
#include "scenario/sweep_cell.h"
#include "scenario/sweep_spec.h"

namespace rockyard::scenario {
namespace {

using core::JsonValue;
using core::Problem;

// Returns "k_per_m2=0.01,navigator=gestalt"; a listed cell has its own name. Must stay: seeds are
// made of it, and stored runs, baselines and traces know cells by it. Numbers in it have to keep
// their digits (LevelText, AxisSpec::At).
std::string NameOf(const SweepSpec& spec, const std::vector<LevelSpec>& levels) {
  if (spec.params.design.kind == DesignKind::kList) return levels.front().text;
  std::string name;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    name += fmt::format("{}{}={}", i == 0 ? "" : ",", spec.axes[i].axis.name, levels[i].text);
  }
  return name;
}

// The seed is below 2^53, so that it keeps its digits in every JSON reader.
std::int64_t SeedOf(const SweepSpec& spec, const std::string& cell_name) {
  if (spec.params.common_random_numbers) return spec.params.seed;
  const std::uint64_t hash =
      core::Hasher().Integer(static_cast<std::uint64_t>(spec.params.seed)).Text(cell_name).value();
  return static_cast<std::int64_t>(hash >> 11);
}

// Tells a problem that many cells have once.
class CellProblems {
 public:
  void Add(const std::string& cell, const Problem& problem) {
    const auto [at, fresh] = found_.try_emplace({problem.path, problem.reason}, problems_.size());
    if (!fresh) {
      ++cells_[at->second];
      return;
    }
    problems_.push_back(
        {fmt::format("cell {}: {}", cell, problem.path), problem.reason, problem.suggestion});
    cells_.push_back(1);
  }

  // Throws where there are any.
  void Finish() {
    if (problems_.empty()) return;
    for (std::size_t i = 0; i < problems_.size(); ++i) {
      if (cells_[i] == 1) continue;
      problems_[i].reason += fmt::format(" (and so in {} more cells)", cells_[i] - 1);
    }
    if (problems_.size() > kMaxShown) {
      const std::size_t more = problems_.size() - kMaxShown;
      problems_.resize(kMaxShown);
      problems_.push_back({"(more)", fmt::format("{} more problems", more), "correct these first"});
    }
    throw core::UserError(std::move(problems_));
  }

 private:
  static constexpr std::size_t kMaxShown = 100;
  std::map<std::pair<std::string, std::string>, std::size_t> found_;
  std::vector<Problem> problems_;
  std::vector<std::int64_t> cells_;
};

// Refuses cells that are the same scenario but for kNoInfluence of load.h and the seed: a setting
// without effect.
class Duplicates {
 public:
  void Check(const std::string& name, const JsonValue& resolved, CellProblems& problems) {
    JsonValue decisive = resolved;
    for (const char* key : {"name", "description", "accepted", "trials", "seed"})
      decisive.Erase(key);
    const std::uint64_t hash = core::Hasher().Text(core::DumpJson(decisive)).value();
    const auto [at, fresh] = cells_.try_emplace(hash, name);
    if (fresh) return;
    problems.Add(name, {"(scenario)", fmt::format("is the same as that of cell {}", at->second),
                        "a level has no effect: set another value, or leave the cell out"});
  }

 private:
  std::map<std::uint64_t, std::string> cells_;
};

SweepCell MakeCell(const SweepSpec& spec, const std::vector<LevelSpec>& levels,
                   Duplicates& duplicates, CellProblems& problems) {
  SweepCell cell;
  cell.name = NameOf(spec, levels);
  for (const LevelSpec& level : levels) cell.levels.push_back({level.text, level.number});
  try {
    ResolvedCell resolved = ResolveCell(spec, levels);
    cell.scenario = std::move(resolved.scenario);
    for (const Problem& problem : resolved.problems) problems.Add(cell.name, problem);
    duplicates.Check(cell.name, resolved.document, problems);
  } catch (const core::UserError& error) {
    for (const Problem& problem : error.problems()) problems.Add(cell.name, problem);
  }
  cell.scenario.name = fmt::format("{} {}", spec.params.name, cell.name);
  cell.scenario.trials = spec.params.trials;
  cell.scenario.seed = SeedOf(spec, cell.name);
  return cell;
}

std::optional<std::size_t> FitAxis(const SweepSpec& spec) {
  for (std::size_t i = 0; i < spec.axes.size(); ++i) {
    const SweepAxis& axis = spec.axes[i].axis;
    const bool wanted = spec.params.fit.axis.empty() || spec.params.fit.axis == axis.name;
    if (axis.numeric && wanted) return i;
  }
  return std::nullopt;
}

// Returns whether an axis, a cell or a setting in the document has that path.
bool States(const JsonValue& document, std::string_view path) {
  if (document.Is(JsonValue::Type::kText)) return document.text() == path;
  if (document.Is(JsonValue::Type::kList)) {
    return std::ranges::any_of(document.list(),
                               [&](const JsonValue& each) { return States(each, path); });
  }
  if (!document.Is(JsonValue::Type::kObject)) return false;
  return std::ranges::any_of(document.members(), [&](const core::JsonMember& member) {
    return member.key == path || States(member.value, path);
  });
}

// Writes the changes into the document, so that it says by itself what is run. An override goes
// last among the settings.
void ApplyChanges(JsonValue& document, const SweepChanges& changes) {
  const std::string plugins = std::string(plugin::kPluginsKey) + "=";
  const auto list = std::ranges::find_if(
      changes.overrides, [&](const std::string& each) { return each.starts_with(plugins); });
  bool chosen = list != changes.overrides.end();  // by a list of plugins that is yet to come
  if (changes.trials) document.Set("trials", JsonValue(*changes.trials));
  if (changes.seed) document.Set("seed", JsonValue(*changes.seed));
  for (const std::string& assignment : changes.overrides) {
    JsonValue parsed = JsonValue::Object();
    core::ApplyOverride(parsed, assignment);
    const std::string path = assignment.substr(0, assignment.find('='));
    chosen = chosen && path != plugin::kPluginsKey;
    if (chosen && States(document, path)) continue;
    JsonValue* set = document.Find("set");
    if (set == nullptr) set = &document.Set("set", JsonValue::Object());
    set->Erase(path);
    set->Set(path, *FindPath(parsed, path));
  }
}

Sweep Describe(const SweepSpec& spec) {
  Sweep sweep;
  sweep.name = spec.params.name;
  sweep.description = spec.params.description;
  sweep.document = core::DumpJson(spec.document);
  sweep.design = spec.params.design.kind;
  sweep.seed = static_cast<std::uint64_t>(spec.params.seed);
  sweep.common_random_numbers = spec.params.common_random_numbers;
  for (const AxisSpec& axis : spec.axes) sweep.axes.push_back(axis.axis);
  if (sweep.design == DesignKind::kList) sweep.axes.push_back({.name = "cell"});
  sweep.fit_axis = FitAxis(spec);
  sweep.fit_scale = spec.params.fit.scale;
  return sweep;
}

Sweep Resolve(JsonValue document, const SweepChanges& changes,
              const std::filesystem::path& folder) {
  if (core::JsonValue* base = document.Find("scenario"); base != nullptr) {
    AnchorPlugins(*base, folder);
  }
  ApplyChanges(document, changes);
  std::vector<Problem> problems;
  const SweepSpec spec = ReadSweepSpec(std::move(document), folder, changes, problems);
  if (problems.empty()) CheckDesign(spec, problems);
  if (!problems.empty()) throw core::UserError(std::move(problems));
  Sweep sweep = Describe(spec);
  Duplicates duplicates;
  CellProblems cell_problems;
  for (const std::vector<LevelSpec>& levels : DesignCells(spec)) {
    sweep.cells.push_back(MakeCell(spec, levels, duplicates, cell_problems));
  }
  cell_problems.Finish();
  return sweep;
}

}  // namespace

bool IsSweep(const JsonValue& document) {
  return document.Find("axes") != nullptr || document.Find("cells") != nullptr;
}

Sweep LoadSweep(const std::filesystem::path& path, const SweepChanges& changes) {
  JsonValue document = core::LoadJsonFile(path);
  if (!IsSweep(document)) {
    throw core::UserError(path.string(), "is no sweep: it has neither axes nor cells",
                          "use rockyard run for a scenario");
  }
  return Resolve(std::move(document), changes, path.parent_path());
}

Sweep ParseSweep(std::string_view text, const SweepChanges& changes,
                 const std::filesystem::path& folder) {
  return Resolve(core::ResolveExtends(core::ParseJson(text, "sweep"), folder), changes, folder);
}

std::string CellFileName(std::size_t index, std::string_view cell_name) {
  constexpr std::size_t kLongest = 100;
  std::string name = fmt::format("{:04}-{}", index + 1, cell_name.substr(0, kLongest));
  for (char& c : name) {
    const bool kept = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                      c == '-' || c == '.' || c == '_';
    if (!kept) c = '_';
  }
  return name;
}

}  // namespace rockyard::scenario
