#include "campaign/bench/entry.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <system_error>

#include "core/archive.h"
#include "core/digest.h"
#include "core/error.h"
#include "core/files.h"
#include "core/json_text.h"
#include "plugin/plugin_use.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;
using core::Setting;

// Of all files of an entry; what is larger is no code of a navigator.
constexpr std::size_t kMaxEntryBytes = std::size_t{256} << 20;

// What an entry may set beside the parameters of its navigator: what a rover does that notices that
// it is stuck or slips.
constexpr std::array<std::string_view, 2> kReactions{"on_board_stuck", "on_slip"};

// Returns the digest of all files of the folder but hidden ones, by name and bytes.
std::string DigestOf(const fs::path& folder) {
  std::map<std::string, fs::path> files;
  for (auto it = fs::recursive_directory_iterator(folder); it != fs::end(it); ++it) {
    const std::string name = it->path().filename().string();
    const bool skipped = name.starts_with('.') || name == "__pycache__";
    if (skipped && it->is_directory()) it.disable_recursion_pending();
    if (skipped || !it->is_regular_file()) continue;
    files.emplace(it->path().lexically_relative(folder).generic_string(), it->path());
  }
  std::string all;
  std::size_t room = kMaxEntryBytes;
  for (const auto& [name, path] : files) {
    const std::string bytes = core::ReadWholeFile(path, room, "a file of an entry");
    room -= bytes.size();
    all += fmt::format("{}\n{}\n", core::Sha256(bytes), name);
  }
  return core::Sha256(all);
}

void CheckSetting(const EntryParams& manifest, const std::string& path,
                  std::vector<core::Problem>& problems) {
  const auto below = [&](std::string_view group) {
    return path.starts_with(fmt::format("navigation.{}.", group));
  };
  if (below(manifest.navigator) || std::ranges::any_of(kReactions, below)) return;
  problems.push_back({"set." + path, "is not the entry's to set",
                      fmt::format("set navigation.{}.*, navigation.on_board_stuck.* or "
                                  "navigation.on_slip.*: all else is the suite's",
                                  manifest.navigator)});
}

}  // namespace

void EntryParams::Visit(core::FieldVisitor& v) {
  v.Text("name", name, Setting("of the entry in tables"));
  v.Choice("track", track,
           Setting("what it reads: points (of looks, or reports of them), these and a map (of the "
                   "site), images"));
  v.Choice("computing", computing,
           Setting("whether its decisions take the time of the modelled computer (budgeted)"));
  v.Text("navigator", navigator, Setting("the navigator's name in a scenario"));
  v.Text("plugin", plugin, Setting("the file of its library in the folder; empty: no library"));
  v.Text("process", process, Setting("the command of its process; empty: none"));
  v.Text("about", about, Setting("a sentence for readers"));
  v.Text("authors", authors, Setting("who answers for it"));
  v.Require("name", !name.empty(), "is missing", "give the entry a name of a word or two");
  constexpr std::string_view kLetters =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.+";
  v.Require("name", name.find_first_not_of(kLetters) == std::string::npos && name.size() <= 40,
            "is no name for tables and folders",
            "use up to 40 letters, digits and the characters _ - . +");
  v.Require("navigator", !navigator.empty(), "is missing",
            "name the navigator as a scenario would in navigation.navigator");
  v.Require("plugin", plugin.empty() || process.empty(), "stands beside a process",
            "leave one of the two out");
}

std::vector<std::string> SettingsOf(const core::JsonValue& document, const EntryParams& manifest) {
  std::vector<core::Problem> problems;
  std::vector<std::string> settings{"navigation.navigator=" + manifest.navigator};
  if (manifest.computing == BenchComputing::kBudgeted) {
    settings.push_back(fmt::format("clock.compute.operations_per_s={}", kBudget_ops_s));
  }
  if (const core::JsonValue* set = document.Find("set")) {
    if (!set->Is(core::JsonValue::Type::kObject)) {
      throw core::UserError("set", "is no object", "give it as {\"PATH\": VALUE}");
    }
    for (const core::JsonMember& member : set->members()) {
      CheckSetting(manifest, member.key, problems);
      settings.push_back(member.key + "=" + core::CompactJson(member.value));
    }
  }
  if (!problems.empty()) throw core::UserError(std::move(problems));
  return settings;
}

namespace {

// Reads what a manifest of this text says.
void ReadManifest(const std::string& text, BenchEntry& entry) {
  const fs::path folder = entry.file.parent_path();
  std::error_code error;
  core::ReadParams(entry.document, entry.manifest, {"set"});
  const EntryParams& manifest = entry.manifest;
  std::vector<core::Problem> problems;
  core::JsonValue::List plugins;
  if (!manifest.plugin.empty()) {
    const fs::path library = (folder / manifest.plugin).lexically_normal();
    if (library.lexically_relative(folder).generic_string().starts_with("..")) {
      problems.push_back({"plugin", "is outside of the entry's folder", "put the library there"});
    } else if (!fs::is_regular_file(library, error)) {
      problems.push_back({"plugin", "names " + library.string() + ", which is no file",
                          "build the library, or give its place in the entry's folder"});
    }
    plugins.push_back(core::JsonValue::Object({{"library", core::JsonValue(manifest.plugin)}}));
  }
  if (!manifest.process.empty()) {
    plugins.push_back(core::JsonValue::Object({{"process", core::JsonValue(manifest.process)}}));
  }
  const bool own_code = !plugins.empty();
  if (own_code) {
    entry.settings.push_back(fmt::format(
        "{}={}", plugin::kPluginsKey,
        core::CompactJson(plugin::Anchored(core::JsonValue(std::move(plugins)), folder))));
  }
  for (std::string& setting : SettingsOf(entry.document, manifest)) {
    entry.settings.push_back(std::move(setting));
  }
  if (!problems.empty()) throw core::UserError(std::move(problems));
  entry.digest = core::Sha256(core::Sha256(text) + (own_code ? DigestOf(folder) : std::string()));
}

}  // namespace

BenchEntry ReadEntry(const fs::path& path) {
  std::error_code error;
  BenchEntry entry;
  entry.file =
      fs::absolute(fs::is_directory(path, error) ? path / "entry.json" : path).lexically_normal();
  const std::string file = entry.file.string();
  constexpr std::size_t kMaxManifest = 1 << 20;
  const std::string text = core::ReadTextFile(file, kMaxManifest, "the manifest of an entry");
  entry.document = core::ParseJson(text, file);
  try {
    ReadManifest(text, entry);
  } catch (const core::UserError& wrong) {
    std::vector<core::Problem> problems = wrong.problems();
    for (core::Problem& problem : problems) problem.path = file + ": " + problem.path;
    throw core::UserError(std::move(problems));
  }
  return entry;
}

}  // namespace rockyard::campaign
