#include "app/run_folders.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <system_error>
#include <utility>

#include "app/console.h"
#include "batch/result_store.h"
#include "batch/run_folder.h"
#include "batch/sqlite_database.h"
#include "campaign/output_folder.h"
#include "campaign/run_source.h"
#include "core/error.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kShownRuns = 10;

fs::file_time_type WrittenAt(const fs::path& folder) {
  std::error_code error;
  return fs::last_write_time(batch::StorePath(folder), error);
}

bool HoldsRun(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(batch::StorePath(folder), error);
}

// Returns "first (nominal, 300 trials, 2026-03-01)".
std::string About(const fs::path& folder) {
  const auto written = std::chrono::file_clock::to_sys(WrittenAt(folder));
  const std::string date =
      fmt::format("{:%Y-%m-%d}",
                  fmt::localtime(std::chrono::system_clock::to_time_t(
                      std::chrono::time_point_cast<std::chrono::system_clock::duration>(written))));
  const std::string name = campaign::ShellPath(folder.string());
  try {
    const batch::ResultStore store = batch::ResultStore::Read(folder);
    std::int64_t trials = 0;
    for (int cell = 0; cell < store.cells(); ++cell) trials += store.planned(cell);
    return fmt::format("{} ({}, {} trial{}, {})", name, store.identity().name, trials,
                       trials == 1 ? "" : "s", date);
  } catch (const batch::StoreError&) {
    return fmt::format("{} (cannot be read, {})", name, date);
  }
}

}  // namespace

std::vector<fs::path> RunFolders(const fs::path& folder) {
  std::error_code error;
  std::vector<std::pair<fs::file_time_type, fs::path>> runs;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    if (HoldsRun(at->path())) runs.emplace_back(WrittenAt(at->path()), at->path());
  }
  std::sort(runs.rbegin(), runs.rend());
  std::vector<fs::path> folders;
  folders.reserve(runs.size());
  for (auto& [time, path] : runs) folders.push_back(std::move(path));
  return folders;
}

void RequireRuns(std::span<const std::string> paths) {
  for (const std::string& path : paths) {
    std::error_code error;
    if (!fs::is_directory(path, error) || HoldsRun(path)) continue;
    const std::vector<fs::path> runs = RunFolders(path);
    if (runs.empty()) continue;
    std::string list;
    for (std::size_t i = 0; i < std::min(runs.size(), kShownRuns); ++i) {
      list += (i == 0 ? "" : "; ") + About(runs[i]);
    }
    if (runs.size() > kShownRuns) list += fmt::format("; and {} more", runs.size() - kShownRuns);
    throw core::UserError(path,
                          fmt::format("holds no run itself, but {} folder{} of runs", runs.size(),
                                      runs.size() == 1 ? "" : "s"),
                          "name one of them: " + list);
  }
}

}  // namespace rockyard::app
