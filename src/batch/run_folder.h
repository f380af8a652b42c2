// The folder of one run: who may work in it, and what lies in it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rockyard::batch {

inline constexpr const char* kStoreFile = "results.sqlite";

std::filesystem::path StorePath(const std::filesystem::path& folder);
bool HoldsStore(const std::filesystem::path& folder);

// Makes the folder where it does not exist and claims it, as long as this lives, against every
// other run, in this process or another on the same machine. The claim ends with the process,
// however it ends, and leaves nothing behind. Throws StoreError: kUnwritable where the folder
// cannot be made or a file cannot be made in it, kInUse where another run has it.
//
// Limit: file systems without flock() (some network mounts) give no claim; two runs of one scenario
// would then do the same work twice, and the store keeps the first copy of each record.
class FolderClaim {
 public:
  explicit FolderClaim(const std::filesystem::path& folder);
  ~FolderClaim();
  FolderClaim(const FolderClaim&) = delete;
  FolderClaim& operator=(const FolderClaim&) = delete;

 private:
  int descriptor_ = -1;
};

// Renames the store and the log that belongs to it to results.old-1.sqlite (or -2, ...); returns
// the new path. Nothing is deleted. Requires a claim of the folder.
std::filesystem::path SetStoreAside(const std::filesystem::path& folder);

// Folders that hold a store: `path` itself, or else its direct subfolders in alphabetical order.
// Throws StoreError kMissing where there is none.
std::vector<std::filesystem::path> FindRuns(const std::filesystem::path& path);

}  // namespace rockyard::batch
