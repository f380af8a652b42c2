// Folders of runs: commands that ask for a run refuse a folder of runs by it, and name the runs in
// it; completion offers them.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace rockyard::app {

// Returns the folders in `folder` that hold a run or sweep, the latest first.
std::vector<std::filesystem::path> RunFolders(const std::filesystem::path& folder);

// Throws core::UserError where a path is a folder that holds no run itself but folders of runs. The
// error names the ten latest, each with its scenario, trials and date.
void RequireRuns(std::span<const std::string> paths);

}  // namespace rockyard::app
