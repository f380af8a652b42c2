// What a scenario is laid over each other of.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/json_value.h"

namespace rockyard::campaign {

// The file, its overrides included, then the files that values in it extend, then those that it
// extends itself, the last of a list first; no "extends" in any of them.
using Layers = std::vector<core::JsonValue>;

// Of a scenario file. Throws core::UserError where it cannot be read.
Layers LayersOf(const std::filesystem::path& file, std::span<const std::string> overrides);

// What a layer says at a dotted path; nullptr where it says nothing, or null.
const core::JsonValue* Said(const core::JsonValue& layer, std::string_view path);

// Whether the value at `path` comes from further down than the one at `other`: whoever stated it
// did not know that one. Defaults lie at the bottom.
bool LiesBelow(const Layers& layers, std::string_view path, std::string_view other);

}  // namespace rockyard::campaign
