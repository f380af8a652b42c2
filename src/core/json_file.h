// JSON files that build on each other, and overrides from the command line.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/json_value.h"

namespace rockyard::core {

// The value in a file. Wherever it holds an object with a text "extends", that other file (path
// relative to the folder of the one that names it) is loaded first and the object is merged over
// it; objects merge, everything else replaces. A list of texts names several files, each merged
// over the one before. An object's own members are resolved before it is
// merged, so that {"rover": {"extends": "mfex.json"}} also works in a file that extends another.
// Throws UserError: file missing, unreadable, no regular file or too large, JSON errors, a file or
// base that is no object, cycles, more than 16 files in a chain or 64 in all. Problems of "extends"
// are named by their path in the document, such as "rover.extends".
JsonValue LoadJsonFile(const std::filesystem::path& path);

// Returns the file and those that it extends, as LoadJsonFile reads them: without links and each as
// often as it is read. Throws as that does.
std::vector<std::filesystem::path> FilesOf(const std::filesystem::path& path);

// The value in a file as it stands there, "extends" and all. Throws UserError for what is missing,
// unreadable or no JSON.
JsonValue LoadJsonFileAlone(const std::filesystem::path& path);

// Resolves "extends" of a value that came from no file, relative to `folder`.
JsonValue ResolveExtends(JsonValue value, const std::filesystem::path& folder);

// Sets the member at a dotted path, e.g. "terrain.rocks.k", making the objects on the way. Whether
// the path means anything is found by the reader. Throws UserError where the path has empty parts
// or leads through what is no object, which is never replaced.
void SetPath(JsonValue& document, std::string_view path, JsonValue value);

// Applies "PATH=VALUE". VALUE is read as JSON; what is no JSON is taken as a text, unless it starts
// like a list, an object or a quoted text. Throws UserError.
void ApplyOverride(JsonValue& document, std::string_view assignment);

}  // namespace rockyard::core
