#include "batch/scenario_difference.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "core/hash.h"
#include "core/json_text.h"
#include "scenario/former_keys.h"
#include "scenario/load.h"

namespace rockyard::batch {
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

class Walk {
 public:
  void Compare(const std::string& path, const JsonValue* stored, const JsonValue* wanted) {
    const bool objects = stored != nullptr && wanted != nullptr &&
                         stored->Is(JsonValue::Type::kObject) &&
                         wanted->Is(JsonValue::Type::kObject);
    if (objects) {
      CompareMembers(path, *stored, *wanted);
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
  JsonValue before = core::ParseJson(first, "stored scenario");
  JsonValue now = core::ParseJson(second, "scenario");
  scenario::RenameFormerKeys(before);
  scenario::RenameFormerKeys(now);
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
