#include "scenario/former_keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/error.h"
#include "core/json_file.h"
#include "core/json_text.h"

namespace rockyard::scenario {
namespace {

using core::JsonValue;

struct FormerKey {
  std::string_view group;  // of the top level
  std::string_view key;
  std::string_view path;  // today

  std::string former() const { return fmt::format("{}.{}", group, key); }
};

constexpr std::array<FormerKey, 1> kFormerKeys{
    {{.group = "sensors", .key = "localization", .path = "localization.estimator"}}};

void Rename(JsonValue& document, const FormerKey& former) {
  JsonValue* group = document.Find(former.group);
  JsonValue* value = group == nullptr ? nullptr : group->Find(former.key);
  if (value == nullptr) return;
  const std::size_t dot = former.path.find('.');
  const JsonValue* home = document.Find(former.path.substr(0, dot));
  // The reader of the document complains about such a group.
  if (home != nullptr && !home->Is(JsonValue::Type::kObject)) return;
  const JsonValue* today = home == nullptr ? nullptr : home->Find(former.path.substr(dot + 1));
  if (today != nullptr && core::DumpJson(*today) != core::DumpJson(*value)) {
    throw core::UserError(
        former.former(),
        fmt::format("is the former name of {}, which has another value", former.path),
        fmt::format("leave {} out", former.former()));
  }
  JsonValue moved = std::move(*value);
  group->Erase(former.key);
  core::SetPath(document, former.path, std::move(moved));
}

}  // namespace

std::string_view CurrentPath(std::string_view path) {
  const auto found = std::ranges::find(kFormerKeys, path, &FormerKey::former);
  return found == kFormerKeys.end() ? path : found->path;
}

void RenameFormerKeys(JsonValue& document) {
  for (const FormerKey& former : kFormerKeys) Rename(document, former);
}

void Override(JsonValue& document, std::string_view assignment) {
  RenameFormerKeys(document);
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos) return core::ApplyOverride(document, assignment);
  core::ApplyOverride(document, fmt::format("{}{}", CurrentPath(assignment.substr(0, equals)),
                                            assignment.substr(equals)));
}

}  // namespace rockyard::scenario
