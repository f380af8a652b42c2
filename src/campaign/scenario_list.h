// The scenario files of a folder, and what kind a file is. `rockyard list` shows them; names of
// scenarios (scenario_names.h) and the command `rover` ask for the kind.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/json_value.h"

namespace rockyard::campaign {

// What a .json file is.
enum class ListedKind {
  kScenario,
  kSweep,
  kPart,    // a file that scenarios extend: a rover, a sensor
  kInvalid  // none of these
};

struct ListedFile {
  std::string path;   // relative to the folder, with forward slashes
  std::string group;  // its folder; "." for the folder itself
  ListedKind kind = ListedKind::kInvalid;
  std::string name;         // as the file says; empty for parts and invalid files
  std::string description;  // as the file says, or why it is not valid
  std::size_t cells = 0;    // of a sweep

  // Returns what the list tells of the file: one line, however long, for people.
  std::string About() const;
  // Returns the path without its group.
  std::string name_in_group() const;
};

// Returns whether the document is one group of a scenario, such as a rover: an object none of whose
// members is a scenario's.
bool IsGroup(const core::JsonValue& document);

// Returns the kind of a file by its members alone, and kInvalid where it cannot be read. What is a
// scenario or sweep by its members may still be invalid, and ListScenarios then lists it as
// kInvalid.
ListedKind KindOf(const std::filesystem::path& path);

// Returns whether `rockyard list` shows the file: all but parts, and with `all` (--all) parts too.
bool IsShown(const ListedFile& file, bool all);

// Returns every .json file in and below the folder, sorted by group and then by path. `rockyard
// list` needs the files of a group next to each other. Throws core::UserError where the folder
// cannot be read or holds none.
std::vector<ListedFile> ListScenarios(const std::filesystem::path& folder);

// Returns {"file", "kind": scenario, sweep, part or invalid, "name", "description", and "cells" of
// a sweep}. Must stay: keys and kinds, which src/report/README.md promises to programs.
core::JsonValue Json(const ListedFile& file);

}  // namespace rockyard::campaign
