// JSON files that build on each other, and overrides from the command line. Scenarios, sweeps and
// the parameter files of tools are read so. What lies over what decides the values of a scenario;
// fingerprints are of these values, never of the files that they came from.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/json_value.h"

namespace rockyard::core {

// Returns the value in a file. An object with a text "extends" is laid over the object of the file
// of that name, relative to the folder of the file that names it: objects merge, everything else
// replaces. A list of texts names several files, each laid over the one before. An object's own
// members are resolved before it is merged, so that {"rover": {"extends": "mfex.json"}} also works
// in a file that extends another. Throws UserError: file missing, unreadable, no regular file or
// too large, JSON errors, a file or base that is no object, cycles, more than 16 files in a chain
// or 64 in all. Problems of "extends" are named by their path in the document, such as
// "rover.extends".
JsonValue LoadJsonFile(const std::filesystem::path& path);

// Returns the file and those that it extends, in the order in which LoadJsonFile reads them: paths
// without links, each as often as it is read. Throws as LoadJsonFile does, but for a file that
// holds no object.
std::vector<std::filesystem::path> FilesOf(const std::filesystem::path& path);

// Returns the value in a file as it stands there, "extends" and all. Throws UserError for what is
// missing, unreadable or no JSON.
JsonValue LoadJsonFileAlone(const std::filesystem::path& path);

// Returns a value that came from no file with its "extends" resolved, relative to `folder`.
JsonValue ResolveExtends(JsonValue value, const std::filesystem::path& folder);

// Sets the member at a dotted path, e.g. "terrain.rocks.k", making the objects on the way. The
// reader of the document finds whether the path means anything. Throws UserError where the path has
// empty parts or leads through what is no object, which is never replaced.
void SetPath(JsonValue& document, std::string_view path, JsonValue value);

// Applies "PATH=VALUE". VALUE is read as JSON; what is no JSON is taken as a text, unless it starts
// like a list, an object or a quoted text. Throws UserError.
void ApplyOverride(JsonValue& document, std::string_view assignment);

}  // namespace rockyard::core
