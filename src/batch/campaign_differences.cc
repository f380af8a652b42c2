#include "batch/campaign_differences.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "core/hash.h"
#include "core/json_text.h"
#include "scenario/load.h"

namespace rockyard::batch {
namespace {

using core::Problem;

// How many differing cells, and how many paths of each, are told: the first few tell what happened.
constexpr std::size_t kCellsShown = 3;
constexpr std::size_t kPathsShown = 12;

// The names of the columns alone decide: meanings are sentences for people, and stores keep no
// roles.
std::string ColumnList(const truth::RecordSchema& schema) {
  std::string text;
  for (const truth::ValueInfo& value : schema) text += (text.empty() ? "" : ", ") + value.name;
  return text;
}

std::vector<Problem> CellDifferences(const CellIdentity& stored, const CellIdentity& wanted,
                                     const DifferenceWords& words) {
  std::vector<Problem> problems;
  if (stored.fingerprint != wanted.fingerprint) {
    problems = ScenarioDifferences(stored.resolved, wanted.resolved, kPathsShown, words);
    // No value differs, but the order of the keys: the checksums of stored rows are computed from
    // the fingerprint, and the fingerprint from the text.
    if (problems.empty()) {
      problems.push_back(
          {"scenario",
           fmt::format("has its keys in another order {} than {}", words.first, words.second),
           "go on with the version of the program that began it"});
    }
  }
  const auto has_seed = [](const Problem& problem) { return problem.path == "seed"; };
  if (stored.seed != wanted.seed && std::none_of(problems.begin(), problems.end(), has_seed)) {
    problems.push_back(
        {"seed",
         fmt::format("is {} {} and {} {}", stored.seed, words.first, wanted.seed, words.second),
         ""});
  }
  if (stored.name != wanted.name) {
    problems.push_back({"name of the cell",
                        fmt::format("is \"{}\" {} and \"{}\" {}", stored.name, words.first,
                                    wanted.name, words.second),
                        ""});
  }
  for (Problem& problem : problems) {
    if (!wanted.name.empty()) problem.path = fmt::format("cell {}: {}", wanted.name, problem.path);
  }
  return problems;
}

void AddCells(const CampaignIdentity& stored, const CampaignIdentity& wanted,
              const DifferenceWords& words, std::vector<Problem>& problems) {
  if (stored.cells.size() != wanted.cells.size()) {
    problems.push_back({"cells",
                        fmt::format("are {} {} and {} {}", stored.cells.size(), words.first,
                                    wanted.cells.size(), words.second),
                        ""});
    return;
  }
  std::size_t differing = 0;
  for (std::size_t i = 0; i < stored.cells.size(); ++i) {
    const std::vector<Problem> found = CellDifferences(stored.cells[i], wanted.cells[i], words);
    if (found.empty() || ++differing > kCellsShown) continue;
    problems.insert(problems.end(), found.begin(), found.end());
  }
  if (differing > kCellsShown) {
    problems.push_back({"cells", fmt::format("{} more differ", differing - kCellsShown), ""});
  }
}

}  // namespace

std::vector<Problem> CampaignDifferences(const CampaignIdentity& stored,
                                         const CampaignIdentity& wanted,
                                         const std::vector<std::string>& builds, BuildPolicy policy,
                                         const DifferenceWords& words) {
  std::vector<Problem> problems;
  AddCells(stored, wanted, words, problems);
  if (ColumnList(stored.schema) != ColumnList(wanted.schema)) {
    problems.push_back({"columns", "of the records differ: the program has changed", ""});
  }
  for (const std::string& build : builds) {
    if (policy == BuildPolicy::kAny || build == wanted.build) continue;
    problems.push_back(
        {"build",
         fmt::format("is \"{}\" {} and \"{}\" {}", build, words.first, wanted.build, words.second),
         "add --any-build to mix them all the same: records may differ in their "
         "last bits or more"});
  }
  return problems;
}

namespace {

using core::JsonValue;

std::string Show(const JsonValue* value) {
  if (value == nullptr) return "absent";
  if (value->Is(JsonValue::Type::kList)) {
    std::string text = core::DumpJson(*value);
    text.erase(text.find_last_not_of('\n') + 1);
    return text.size() > 60 ? text.substr(0, 60) + "..." : text;
  }
  return core::Abbreviate(*value);
}

// Returns the hashes of a scenario's plugins, which alone decide records, wherever the files lie.
JsonValue PluginHashes(const JsonValue* list) {
  JsonValue::List hashes;
  if (list != nullptr && list->Is(JsonValue::Type::kList)) {
    for (const JsonValue& entry : list->list()) {
      const JsonValue* hash = entry.Find("hash");
      hashes.push_back(hash == nullptr ? JsonValue("none") : *hash);
    }
  }
  return JsonValue(std::move(hashes));
}

class Walk {
 public:
  void Compare(const std::string& path, const JsonValue* stored, const JsonValue* wanted) {
    const bool objects = stored != nullptr && wanted != nullptr &&
                         stored->Is(JsonValue::Type::kObject) &&
                         wanted->Is(JsonValue::Type::kObject);
    if (objects) {
      CompareMembers(path, *stored, *wanted);
    } else if (path == "plugins") {
      const JsonValue before = PluginHashes(stored);
      const JsonValue now = PluginHashes(wanted);
      if (core::DumpJson(before) != core::DumpJson(now)) {
        found_.push_back({path, Show(&before), Show(&now)});
      }
    } else if (stored == nullptr || wanted == nullptr ||
               core::DumpJson(*stored) != core::DumpJson(*wanted)) {
      found_.push_back({path, Show(stored), Show(wanted)});
    }
  }

  std::vector<ScenarioDifference> Take() { return std::move(found_); }

 private:
  void CompareMembers(const std::string& path, const JsonValue& stored, const JsonValue& wanted) {
    for (const core::JsonMember& member : stored.members()) {
      if (!Skip(path, member.key)) {
        Compare(Join(path, member.key), &member.value, wanted.Find(member.key));
      }
    }
    for (const core::JsonMember& member : wanted.members()) {
      if (!Skip(path, member.key) && stored.Find(member.key) == nullptr) {
        Compare(Join(path, member.key), nullptr, &member.value);
      }
    }
  }

  static bool Skip(const std::string& path, std::string_view key) {
    if (!path.empty()) return false;
    for (const std::string_view name : scenario::kNoInfluence) {
      if (key == name) return true;
    }
    return false;
  }

  static std::string Join(const std::string& path, const std::string& key) {
    return path.empty() ? key : path + "." + key;
  }

  std::vector<ScenarioDifference> found_;
};

}  // namespace

std::vector<ScenarioDifference> FindScenarioDifferences(std::string_view first,
                                                        std::string_view second) {
  const JsonValue before = core::ParseJson(first, "stored scenario");
  const JsonValue now = core::ParseJson(second, "scenario");
  Walk walk;
  walk.Compare("", &before, &now);
  return walk.Take();
}

std::string ResolvedFingerprint(JsonValue resolved) {
  return core::Hex(scenario::ResolvedFingerprint(std::move(resolved)));
}

std::vector<core::Problem> ScenarioDifferences(std::string_view stored, std::string_view wanted,
                                               std::size_t limit, const DifferenceWords& words) {
  std::vector<core::Problem> problems;
  try {
    const std::vector<ScenarioDifference> found = FindScenarioDifferences(stored, wanted);
    for (const ScenarioDifference& each : found) {
      if (problems.size() == limit) {
        const std::string rest = fmt::format("differs in {} more places", found.size() - limit);
        problems.push_back({"scenario", rest, ""});
        break;
      }
      const std::string reason =
          fmt::format("is {} {} and {} {}", each.first, words.first, each.second, words.second);
      problems.push_back({each.path, reason, ""});
    }
  } catch (const core::UserError& error) {
    return error.problems();
  }
  return problems;
}

}  // namespace rockyard::batch
