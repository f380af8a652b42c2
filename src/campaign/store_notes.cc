#include "campaign/store_notes.h"

#include "batch/result_store.h"
#include "batch/run_folder.h"
#include "batch/store_error.h"

namespace rockyard::campaign {
namespace {

std::vector<std::filesystem::path> RunsIn(const std::string& path) {
  try {
    return batch::FindRuns(path);
  } catch (const batch::StoreError&) {
    return {};
  }
}

}  // namespace

std::string NoChecksumsNote(const std::filesystem::path& folder) {
  return batch::StorePath(folder).string() +
         ": an older program made it, without checksums: damage may pass unseen";
}

std::vector<std::string> StoreNotes(std::span<const std::string> paths) {
  std::vector<std::string> notes;
  for (const std::string& path : paths) {
    for (const std::filesystem::path& folder : RunsIn(path)) {
      if (!batch::HasChecksums(folder)) notes.push_back(NoChecksumsNote(folder));
    }
  }
  return notes;
}

}  // namespace rockyard::campaign
