// Files that a campaign derives from its store, beside it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rockyard::campaign {

// Renames every file in the folder that has the name of one that a campaign writes beside its
// store, or of the page and the replays that `rockyard report` writes there, whoever wrote it:
// summary.json to summary.old-1.json, or -2, ... Nothing is deleted or overwritten. Returns the new
// names. Requires a claim of the folder. Throws core::UserError where one cannot be renamed.
std::vector<std::string> SetDerivedFilesAside(const std::filesystem::path& folder);

// Whether a campaign writes a file of that name into its folder, or has its store there.
bool IsRunFile(const std::filesystem::path& name);

}  // namespace rockyard::campaign
