// Pieces of sweep files that are read alike wherever they stand. Only the reader of axes and of
// whole sweep files uses them. They change no cell: names and settings pass as they stand, or are
// refused.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/archive.h"
#include "core/error.h"
#include "core/json_value.h"
#include "scenario/sweep_spec.h"

namespace rockyard::scenario {

// Collects problems instead of throwing them, so that all are reported at once.
class PartReader {
 public:
  // Files are relative to `folder`. Both arguments must outlive the reader.
  PartReader(const std::filesystem::path& folder, std::vector<core::Problem>& problems)
      : folder_(folder), problems_(problems) {}

  void Add(std::string path, std::string reason, std::string suggestion);

  // Returns the fixed keys of an object; free keys are only checked for being known.
  template <typename Params>
  Params Fixed(const core::JsonValue& part, const std::string& path,
               std::span<const std::string_view> free_keys) {
    Params params;
    core::JsonValue fixed = part;
    for (const std::string_view key : free_keys) {
      if (fixed.Find(key) != nullptr) fixed.Set(key, core::JsonValue(""));
    }
    try {
      core::ReadParams(fixed, params);
    } catch (const core::UserError& error) {
      AddBelow(path, error);
    }
    return params;
  }

  // Returns the elements of a list member; none where it is absent or no list.
  std::vector<core::JsonValue*> Elements(core::JsonValue& object, std::string_view key,
                                         const std::string& path);

  // Returns an object of dotted paths and values; empty where it is absent.
  core::JsonValue Settings(const core::JsonValue* set, const std::string& path);

  // Returns the member "scenario"; nullptr where there is none. A file's name there is replaced by
  // what the file holds.
  std::shared_ptr<const core::JsonValue> Base(core::JsonValue& object, const std::string& path);

  // Returns what a scenario file holds; an empty object where it cannot be read.
  core::JsonValue ScenarioFile(const std::string& name, const std::string& path);

  // Returns the level of {name, set, scenario}.
  LevelSpec Level(core::JsonValue& value, const std::string& path);

  // Checks a name, which stands in tables, file names and seeds.
  void CheckName(const std::string& name, const std::string& path);

 private:
  void AddBelow(const std::string& path, const core::UserError& error);

  const std::filesystem::path& folder_;
  std::vector<core::Problem>& problems_;
};

}  // namespace rockyard::scenario
