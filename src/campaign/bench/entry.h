// An entry of the benchmark: a manifest, and beside it all that its navigator needs. docs/bench.md
// has the rules.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/fields.h"
#include "core/json_value.h"

namespace rockyard::campaign {

// What entries read of the world, and what they may compute. A suite is of a track, by its name:
// entries of its track and of points drive on it. Classes of computing are never put into one
// table.
enum class BenchTrack { kPoints, kMap, kImages };
enum class BenchComputing { kUnlimited, kBudgeted };

// Operations a second of the modelled computer for entries whose computing is budgeted: some 22
// million instructions a second of MER's RAD6000 (clock.compute.operations_per_s).
inline constexpr double kBudget_ops_s = 2.2e7;

// The manifest without "set".
struct EntryParams {
  std::string name;
  BenchTrack track = BenchTrack::kPoints;
  BenchComputing computing = BenchComputing::kUnlimited;
  std::string navigator;  // its name in a scenario
  std::string plugin;     // file of a library; "" or of `process`: none
  std::string process;    // command of a navigator's process
  std::string about;      // a sentence
  std::string authors;

  void Visit(core::FieldVisitor& v);
};

struct BenchEntry {
  std::filesystem::path file;  // the manifest's
  EntryParams manifest;
  core::JsonValue document;           // the manifest whole
  std::vector<std::string> settings;  // "PATH=VALUE" of every cell
  // Of the manifest, and where it has a plugin or process of every file of its folder: names and
  // bytes. Hidden files and __pycache__ do not count.
  std::string digest;
};

// Returns what a manifest sets of every cell, "PATH=VALUE", but for its plugin. Throws
// core::UserError where it sets what is not the entry's.
std::vector<std::string> SettingsOf(const core::JsonValue& document, const EntryParams& manifest);

// Reads an entry: a manifest, or the entry.json of a folder. Throws core::UserError with what is
// wrong, named with the file: a setting of anything but the navigator, both a plugin and a process,
// files outside of the folder.
BenchEntry ReadEntry(const std::filesystem::path& path);

}  // namespace rockyard::campaign

namespace rockyard::core {

template <>
struct EnumNames<campaign::BenchTrack> {
  static constexpr std::array<std::string_view, 3> kNames{"points", "map", "images"};
};
template <>
struct EnumNames<campaign::BenchComputing> {
  static constexpr std::array<std::string_view, 2> kNames{"unlimited", "budgeted"};
};

}  // namespace rockyard::core
