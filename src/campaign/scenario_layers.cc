#include "campaign/scenario_layers.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/json_file.h"
#include "scenario/former_keys.h"

namespace rockyard::campaign {
namespace {

using core::JsonValue;

// 0 on top; the number of layers for a default.
std::size_t LayerOf(const Layers& layers, std::string_view path) {
  const auto states = [&](const JsonValue& layer) { return Said(layer, path) != nullptr; };
  return static_cast<std::size_t>(std::find_if(layers.begin(), layers.end(), states) -
                                  layers.begin());
}

// The names of the files that a value extends, which it then no longer does.
std::vector<std::string> TakeExtends(JsonValue& value) {
  const JsonValue* extends = value.Find("extends");
  if (extends == nullptr) return {};
  std::vector<std::string> files;
  if (extends->Is(JsonValue::Type::kText)) {
    files = {extends->text()};
  } else {
    files = core::TextsIn(*extends).value_or(std::vector<std::string>());
  }
  value.Erase("extends");
  return files;
}

// A value at a path of the scenario, "rover", that extends these files.
struct Extension {
  std::string path;
  std::vector<std::string> files;
};

void TakeInnerExtensions(JsonValue& value, const std::string& path,
                         std::vector<Extension>& extensions) {
  if (!value.Is(JsonValue::Type::kObject)) return;
  for (core::JsonMember& member : value.members()) {
    if (!member.value.Is(JsonValue::Type::kObject)) continue;
    const std::string inner = path.empty() ? member.key : fmt::format("{}.{}", path, member.key);
    extensions.push_back({inner, TakeExtends(member.value)});
    TakeInnerExtensions(member.value, inner, extensions);
  }
}

// What the file says of the value at `path` (all of the scenario where that is empty), and below it
// what it extends. Cycles and missing files were found when the scenario was read.
void AddLayers(const std::filesystem::path& file, const std::string& path, Layers& layers) {
  JsonValue value = core::LoadJsonFileAlone(file);
  const std::vector<std::string> bases = TakeExtends(value);
  std::vector<Extension> extensions;
  TakeInnerExtensions(value, path, extensions);
  extensions.push_back({path, bases});
  JsonValue layer = JsonValue::Object();
  if (path.empty()) {
    layer = std::move(value);
  } else {
    core::SetPath(layer, path, std::move(value));
  }
  layers.push_back(std::move(layer));
  for (const Extension& extension : extensions) {
    std::for_each(extension.files.rbegin(), extension.files.rend(), [&](const std::string& base) {
      AddLayers(file.parent_path() / base, extension.path, layers);
    });
  }
}

}  // namespace

Layers LayersOf(const std::filesystem::path& file, std::span<const std::string> overrides) {
  Layers layers;
  AddLayers(file, "", layers);
  for (const std::string& assignment : overrides) scenario::Override(layers.front(), assignment);
  return layers;
}

const JsonValue* Said(const JsonValue& layer, std::string_view path) {
  const JsonValue* at = &layer;
  while (at != nullptr && !path.empty()) {
    const std::size_t dot = std::min(path.find('.'), path.size());
    at = at->Find(path.substr(0, dot));
    path.remove_prefix(std::min(dot + 1, path.size()));
  }
  return at == nullptr || at->Is(JsonValue::Type::kNull) ? nullptr : at;
}

bool LiesBelow(const Layers& layers, std::string_view path, std::string_view other) {
  return LayerOf(layers, path) > LayerOf(layers, other);
}

}  // namespace rockyard::campaign
