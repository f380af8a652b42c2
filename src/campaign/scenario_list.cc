#include "campaign/scenario_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <system_error>
#include <tuple>

#include "core/error.h"
#include "core/json_file.h"
#include "scenario/load.h"
#include "scenario/sweep.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;
using core::JsonValue;

std::vector<fs::path> JsonFiles(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> files;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error)) {
    if (at->is_regular_file(error) && at->path().extension() == ".json") {
      files.push_back(at->path());
    }
  }
  if (error || files.empty()) {
    throw core::UserError(folder.string(),
                          error ? "cannot be read: " + error.message() : "holds no scenario files",
                          "name a folder with scenarios");
  }
  return files;
}

// Returns whether the file is one that scenarios extend: a group, such as a rover (IsGroup), or a
// part of a whole scenario, such as a sensor profile, which has no name.
bool IsPart(const JsonValue& document) {
  if (!document.Is(JsonValue::Type::kObject) || document.members().empty()) return false;
  return document.Find("name") == nullptr || IsGroup(document);
}

ListedKind DocumentKind(const JsonValue& document) {
  if (scenario::IsSweep(document)) return ListedKind::kSweep;
  return IsPart(document) ? ListedKind::kPart : ListedKind::kScenario;
}

void Read(const fs::path& path, ListedFile& file) {
  const JsonValue document = core::LoadJsonFile(path);
  const ListedKind kind = DocumentKind(document);
  if (kind == ListedKind::kSweep) {
    const scenario::Sweep sweep = scenario::LoadSweep(path, {.sealed = true});
    file.name = sweep.name;
    file.description = sweep.description;
    file.cells = sweep.cells.size();
  } else if (kind == ListedKind::kScenario) {
    const scenario::Scenario scenario = scenario::ReadScenarioSealed(document);
    file.name = scenario.name;
    file.description = scenario.description;
  }
  file.kind = kind;
}

ListedFile Listed(const fs::path& path, const fs::path& folder) {
  ListedFile file;
  const fs::path relative = path.lexically_relative(folder);
  file.path = relative.generic_string();
  file.group = relative.has_parent_path() ? relative.parent_path().generic_string() : ".";
  try {
    Read(path, file);
  } catch (const core::UserError& error) {
    const core::Problem& problem = error.problems().front();
    file.description = fmt::format("{}: {}", problem.path, problem.reason);
  }
  return file;
}

std::string_view KindName(ListedKind kind) {
  switch (kind) {
    case ListedKind::kScenario:
      return "scenario";
    case ListedKind::kSweep:
      return "sweep";
    case ListedKind::kPart:
      return "part";
    case ListedKind::kInvalid:
      return "invalid";
  }
  return "";
}

}  // namespace

std::string ListedFile::About() const {
  const std::string& text = description.empty() ? name : description;
  switch (kind) {
    case ListedKind::kScenario:
      return text;
    case ListedKind::kSweep:
      return fmt::format("sweep of {} cells: {}", cells, text);
    case ListedKind::kPart:
      return "part of a scenario, which can extend it";
    case ListedKind::kInvalid:
      return "not valid: " + text;
  }
  return {};
}

std::string ListedFile::name_in_group() const { return fs::path(path).filename().string(); }

bool IsGroup(const JsonValue& document) {
  const JsonValue scenario = scenario::WriteScenario({});
  return document.Is(JsonValue::Type::kObject) &&
         std::none_of(
             document.members().begin(), document.members().end(),
             [&](const core::JsonMember& member) { return scenario.Find(member.key) != nullptr; });
}

ListedKind KindOf(const fs::path& path) {
  try {
    return DocumentKind(core::LoadJsonFile(path));
  } catch (const core::UserError&) {
    return ListedKind::kInvalid;
  }
}

bool IsShown(const ListedFile& file, bool all) { return all || file.kind != ListedKind::kPart; }

std::vector<ListedFile> ListScenarios(const fs::path& folder) {
  std::vector<ListedFile> files;
  for (const fs::path& path : JsonFiles(folder)) files.push_back(Listed(path, folder));
  std::sort(files.begin(), files.end(), [](const ListedFile& a, const ListedFile& b) {
    return std::tie(a.group, a.path) < std::tie(b.group, b.path);
  });
  return files;
}

JsonValue Json(const ListedFile& file) {
  JsonValue json = JsonValue::Object();
  json.Set("file", JsonValue(file.path));
  json.Set("kind", JsonValue(std::string(KindName(file.kind))));
  json.Set("name", JsonValue(file.name));
  json.Set("description", JsonValue(file.description));
  if (file.kind == ListedKind::kSweep) {
    json.Set("cells", JsonValue(static_cast<std::int64_t>(file.cells)));
  }
  return json;
}

}  // namespace rockyard::campaign
