// What there is to know of stores before their results are believed.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace rockyard::campaign {

// The sentence for people about a store without checksums (batch::HasChecksums).
std::string NoChecksumsNote(const std::filesystem::path& folder);

// One sentence for each such store in these folders of runs, or folders of such folders. Other
// paths, and stores that cannot be read, are for whoever reads them to judge.
std::vector<std::string> StoreNotes(std::span<const std::string> paths);

}  // namespace rockyard::campaign
