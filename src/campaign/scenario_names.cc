#include "campaign/scenario_names.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iterator>
#include <string_view>
#include <system_error>

#include "campaign/scenario_list.h"
#include "core/error.h"
#include "core/text.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".json";

bool IsFolder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(path, error);
}

fs::path FolderOfProgram() {
  std::error_code error;
  return fs::read_symlink("/proc/self/exe", error).parent_path();
}

// Returns the folder of the shared library that holds this code; where it is no library, that of
// the program.
fs::path FolderOfModule() {
  Dl_info info{};
  const bool found = dladdr(&kEnding, &info) != 0 && info.dli_fname != nullptr;
  const fs::path file = found ? info.dli_fname : "";
  return file.extension() == ".so" ? fs::absolute(file).parent_path() : FolderOfProgram();
}

// Returns "pathfinder/nominal" of "<folder>/pathfinder/nominal.json".
std::string NameIn(const fs::path& folder, const fs::path& file) {
  std::string name = file.lexically_relative(folder).generic_string();
  name.resize(name.size() - kEnding.size());
  return name;
}

// Returns whether `end` is the last parts of the path, each whole: not "nal" of "nominal".
bool EndsIn(std::string_view path, std::string_view end) {
  if (!path.ends_with(end)) return false;
  return path.size() == end.size() || path[path.size() - end.size() - 1] == '/';
}

bool Fits(ListedKind kind, Wanted wanted) {
  switch (wanted) {
    case Wanted::kScenario:
      return kind == ListedKind::kScenario;
    case Wanted::kSweep:
      return kind == ListedKind::kSweep;
    case Wanted::kEither:
      return kind == ListedKind::kScenario || kind == ListedKind::kSweep;
    case Wanted::kRover:
      return kind == ListedKind::kScenario || kind == ListedKind::kPart;
  }
  return false;
}

// Returns the .json files in and below the folder, sorted by path; those found until then where it
// cannot be read.
std::vector<fs::path> FilesIn(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> files;
  for (fs::recursive_directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error)) {
    if (at->path().extension() == kEnding) files.push_back(at->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::string_view Stem(std::string_view word) {
  if (word.ends_with(kEnding)) word.remove_suffix(kEnding.size());
  return word;
}

// Returns the files whose paths end in the word, or the one whose whole path it is. A whole path
// may begin with the name of the folder: "scenarios/pathfinder/nominal".
std::vector<fs::path> Meant(std::string_view word, const fs::path& folder,
                            const std::vector<fs::path>& files) {
  std::vector<fs::path> meant;
  const std::string folder_name = folder.filename().generic_string();
  for (const fs::path& file : files) {
    const std::string name = NameIn(folder, file);
    if (word == name || word == fmt::format("{}/{}", folder_name, name)) return {file};
    if (EndsIn(name, word)) meant.push_back(file);
  }
  return meant;
}

std::vector<fs::path> OfKind(std::vector<fs::path> files, Wanted wanted) {
  std::erase_if(files, [&](const fs::path& file) { return !Fits(KindOf(file), wanted); });
  return files;
}

std::string ShortestName(const fs::path& file, const fs::path& folder,
                         const std::vector<fs::path>& files) {
  std::string whole = NameIn(folder, file);
  for (std::size_t slash = whole.rfind('/'); slash != std::string::npos && slash > 0;
       slash = whole.rfind('/', slash - 1)) {
    std::string name = whole.substr(slash + 1);
    if (Meant(name, folder, files).size() == 1) return name;
  }
  return whole;
}

std::string NearestOf(std::string_view word, const std::vector<std::string>& names) {
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  return std::string(core::Nearest(word, candidates));
}

// Returns the .json file in the folder of `path` whose name is nearest to that of `path`; empty
// where none is near.
std::string NearestFile(const fs::path& path) {
  std::error_code error;
  std::vector<std::string> names;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    if (at->path().extension() == kEnding) names.push_back(at->path().stem().string());
  }
  const std::string nearest = NearestOf(Stem(path.filename().string()), names);
  if (nearest.empty()) return "";
  return (path.parent_path() / (nearest + std::string(kEnding))).string();
}

// Returns the file or name to suggest: a file beside the one that is named, else a name like the
// word, else one like its last part.
std::string NearestScenario(const std::string& word, Wanted wanted) {
  std::string file = NearestFile(word);
  if (!file.empty()) return file;
  const std::vector<std::string> names = ScenarioNames(wanted);
  std::string name = NearestOf(Stem(word), names);
  return name.empty() ? NearestOf(fs::path(word).stem().string(), names) : name;
}

std::string_view NameOf(Wanted wanted) {
  switch (wanted) {
    case Wanted::kScenario:
      return "a scenario";
    case Wanted::kSweep:
      return "a sweep";
    case Wanted::kEither:
      return "a scenario or sweep";
    case Wanted::kRover:
      return "a scenario or rover";
  }
  return "";
}

[[noreturn]] void Unknown(const std::string& word, Wanted wanted) {
  const std::string nearest = NearestScenario(word, wanted);
  const std::string all =
      fmt::format("`rockyard list` shows those of {}", ScenarioFolder().string());
  throw core::UserError(
      word, fmt::format("is no file, and no name of {}", NameOf(wanted)),
      nearest.empty() ? all : fmt::format("did you mean \"{}\"? {}", nearest, all));
}

}  // namespace

fs::path ScenarioFolder() {
  const char* chosen = std::getenv("ROCKYARD_SCENARIOS");
  if (chosen != nullptr && *chosen != '\0') return chosen;
  const fs::path program = FolderOfProgram();
  const fs::path module = FolderOfModule();
  // A build folder is SOURCE/build/NAME, the program in its folder `bin`, and the module in its
  // folder `python/rockyard`. Installed modules lie in lib/python3/dist-packages/rockyard, or have
  // the scenarios beside them.
  for (const fs::path& folder :
       {fs::path("scenarios"), program / "../share/rockyard/scenarios",
        program / "../../../scenarios", module / "scenarios",
        module / "../../../../share/rockyard/scenarios", module / "../../../../scenarios"}) {
    if (IsFolder(folder)) return folder.lexically_normal();
  }
  return "scenarios";
}

std::string ProjectPath(const std::string& path) {
  std::error_code error;
  if (fs::exists(path, error)) return path;
  const fs::path other = ScenarioFolder().parent_path() / path;
  return fs::exists(other, error) ? other.string() : path;
}

std::string ScenarioFile(const std::string& word, Wanted wanted) {
  std::error_code error;
  if (fs::exists(word, error)) return word;
  const fs::path folder = ScenarioFolder();
  const std::vector<fs::path> files = FilesIn(folder);
  const std::vector<fs::path> meant = OfKind(Meant(Stem(word), folder, files), wanted);
  if (meant.empty()) Unknown(word, wanted);
  if (meant.size() == 1) return meant.front().string();
  std::vector<std::string> names;
  std::transform(meant.begin(), meant.end(), std::back_inserter(names),
                 [&](const fs::path& file) { return NameIn(folder, file); });
  throw core::UserError(word, fmt::format("is the name of {} files", meant.size()),
                        fmt::format("say which: {}", fmt::join(names, ", ")));
}

std::vector<std::string> ScenarioPaths(Wanted wanted) {
  const fs::path folder = ScenarioFolder();
  std::vector<std::string> paths;
  for (const fs::path& file : OfKind(FilesIn(folder), wanted)) {
    paths.push_back(NameIn(folder, file));
  }
  return paths;
}

std::vector<std::string> ScenarioNames(Wanted wanted) {
  const fs::path folder = ScenarioFolder();
  const std::vector<fs::path> files = OfKind(FilesIn(folder), wanted);
  std::vector<std::string> names;
  names.reserve(files.size());
  for (const fs::path& file : files) names.push_back(ShortestName(file, folder, files));
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace rockyard::campaign
