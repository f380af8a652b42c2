#include "app/find_scenario.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <system_error>
#include <vector>

#include "app/scenario_list.h"
#include "core/error.h"
#include "core/spelling.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".json";

std::string WithoutEnding(std::string_view path) {
  return std::string(path.ends_with(kEnding) ? path.substr(0, path.size() - kEnding.size()) : path);
}

bool IsFolder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

// "gestalt/abundance" is named by "abundance" and by itself.
bool IsNamedBy(const std::string& path, const std::string& word) {
  return path == word || path.ends_with("/" + word);
}

bool Suits(const ListedFile& file, WantedFile wanted) {
  const ListedKind kind = file.kind;
  switch (wanted) {
    case WantedFile::kScenario:
      return kind == ListedKind::kScenario;
    case WantedFile::kSweep:
      return kind == ListedKind::kSweep;
    case WantedFile::kEither:
      return kind == ListedKind::kScenario || kind == ListedKind::kSweep;
    case WantedFile::kRover:
      return kind == ListedKind::kScenario || file.group == "rovers";
  }
  return false;
}

std::string WhatOf(WantedFile wanted) {
  return wanted == WantedFile::kSweep ? "sweep" : "scenario";
}

[[noreturn]] void FailSeveral(const std::string& word, WantedFile wanted,
                              const std::vector<std::string>& paths) {
  std::string names;
  for (const std::string& path : paths) names += (names.empty() ? "" : ", ") + path;
  throw core::UserError(word, fmt::format("names more than one {}", WhatOf(wanted)),
                        "name one of: " + names);
}

// By what the last part of the word is near to, among files of the kind that is wanted.
[[noreturn]] void FailUnknown(const std::string& word, WantedFile wanted,
                              const std::vector<std::string>& names) {
  const std::string last = fs::path(WithoutEnding(word)).filename().string();
  std::vector<std::string> stems;
  stems.reserve(names.size());
  for (const std::string& name : names) stems.push_back(fs::path(name).filename().string());
  const std::vector<std::string_view> candidates(stems.begin(), stems.end());
  const std::string_view nearest = core::Nearest(last, candidates);
  const std::string list = "`rockyard list` shows what there is";
  throw core::UserError(
      word, fmt::format("is no file, and no {} of that name is known", WhatOf(wanted)),
      nearest.empty() ? list : fmt::format("did you mean \"{}\"? {}", nearest, list));
}

// The folder above that of the program: build/release/bin/rockyard, PREFIX/bin/rockyard.
std::vector<fs::path> FoldersByProgram() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) return {};
  const fs::path above = program.parent_path().parent_path();
  return {above / "share/rockyard/scenarios", above.parent_path().parent_path() / "scenarios"};
}

}  // namespace

std::optional<fs::path> ScenarioFolder() {
  if (const char* named = std::getenv("ROCKYARD_SCENARIOS")) return fs::path(named);
  if (IsFolder("scenarios")) return fs::path("scenarios");
  for (const fs::path& folder : FoldersByProgram()) {
    if (IsFolder(folder)) return folder;
  }
  return std::nullopt;
}

std::string FindScenario(const std::string& word, WantedFile wanted) {
  std::error_code error;
  if (fs::exists(word, error)) return word;
  const std::optional<fs::path> folder = ScenarioFolder();
  std::vector<std::string> names;
  std::vector<std::string> found;
  if (folder) {
    for (const ListedFile& file : ListScenarios(*folder)) {
      if (!Suits(file, wanted)) continue;
      names.push_back(WithoutEnding(file.path));
      if (IsNamedBy(names.back(), WithoutEnding(word))) {
        found.push_back((*folder / file.path).generic_string());
      }
    }
  }
  if (found.size() == 1) return found.front();
  if (found.empty()) FailUnknown(word, wanted, names);
  FailSeveral(word, wanted, found);
}

}  // namespace rockyard::app
