// The scenario files of a folder.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/json_value.h"

namespace rockyard::app {

enum class ListedKind {
  kScenario,
  kSweep,
  kPart,    // what scenarios extend: a rover, a sensor
  kInvalid  // none of these
};

struct ListedFile {
  std::string path;   // relative to the folder, with forward slashes
  std::string group;  // its folder; "." for the folder itself
  ListedKind kind = ListedKind::kInvalid;
  std::string name;         // as the file says; empty for parts and invalid files
  std::string description;  // as the file says, or why it is not valid
  std::size_t cells = 0;    // of a sweep

  // Of one line, however long.
  std::string About() const;
  // The path without its group.
  std::string name_in_group() const;
};

// Whether none of the members is a scenario's: the file of a group, such as a rover.
bool IsGroup(const core::JsonValue& document);

// Of a file; kInvalid where it cannot be read. A scenario or sweep of that kind may have mistakes
// of its own.
ListedKind KindOf(const std::filesystem::path& path);

// Parts only where everything is asked for.
bool IsShown(const ListedFile& file, bool all);

// Every .json file of the folder and those below, group by group, by path in each; groups in order
// of their names. Throws core::UserError where the folder cannot be read or holds none.
std::vector<ListedFile> ListScenarios(const std::filesystem::path& folder);

// {"file", "kind": scenario, sweep, part or invalid, "name", "description", and "cells" of a
// sweep}.
core::JsonValue Json(const ListedFile& file);

}  // namespace rockyard::app
