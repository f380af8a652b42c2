// Folders of runs, where one run is asked for; what commands that read stores say of them first.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace rockyard::app {

// The folders in `folder` that hold a run or sweep, the latest first.
std::vector<std::filesystem::path> RunFolders(const std::filesystem::path& folder);

// Throws core::UserError where a path is a folder that holds no run itself but folders of runs:
// with the ten latest of them, each with its scenario, trials and date.
void RequireRuns(std::span<const std::string> paths);

// To standard error, a line for each store in those folders that has no checksums.
void NoteStores(std::span<const std::string> paths);

}  // namespace rockyard::app
