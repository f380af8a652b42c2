// The folder of one run: who may work in it, and what lies in it. Whoever opens a campaign claims
// its folder here, and commands that take folders of runs find them here. Folders that other
// commands fill (campaign/output_folder.h) are claimed alike. Must stay: the name kStoreFile, by
// which every command knows a run; no record depends on anything here.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace rockyard::batch {

inline constexpr const char* kStoreFile = "results.sqlite";

std::filesystem::path StorePath(const std::filesystem::path& folder);
bool HoldsStore(const std::filesystem::path& folder);

// Returns whether all that is in the folder, if anything, was left by a run that was killed before
// it had a store.
bool HoldsNoRunYet(const std::filesystem::path& folder);

// Returns whether there is a log by the name of the store's: that of the store, or of one that is
// gone.
bool HoldsLog(const std::filesystem::path& folder);

// Makes the folder and those that it is in, where they do not exist. Returns what had to be made,
// the innermost first. Throws StoreError, and then has made nothing.
std::vector<std::filesystem::path> MakeFolders(const std::filesystem::path& folder);

// Removes, when its life ends, those of the folders that are empty, in this order: what was made
// for work that failed.
class EmptyFolders {
 public:
  explicit EmptyFolders(std::vector<std::filesystem::path> folders)
      : folders_(std::move(folders)) {}
  ~EmptyFolders();
  EmptyFolders(const EmptyFolders&) = delete;
  EmptyFolders& operator=(const EmptyFolders&) = delete;

 private:
  std::vector<std::filesystem::path> folders_;
};

// A claim on a folder against every other run, in this process or another on the same machine, as
// long as the object lives. Makes the folder where it does not exist. The claim ends with the
// process, however it ends, and leaves nothing behind; what killed runs have left of stores that
// they had not finished making is removed. Throws StoreError: kUnwritable, kFull or kOpenFiles
// where the folder cannot be made or a file cannot be made in it, kInUse where another run has it.
//
// Limit: file systems without flock() (some network mounts) give no claim; two runs of one scenario
// would then do the same work twice, and the store keeps the first copy of each record.
class FolderClaim {
 public:
  explicit FolderClaim(const std::filesystem::path& folder);
  ~FolderClaim();
  FolderClaim(const FolderClaim&) = delete;
  FolderClaim& operator=(const FolderClaim&) = delete;

  // What the claim had to make, as MakeFolders returns it.
  const std::vector<std::filesystem::path>& made() const { return made_; }

 private:
  std::vector<std::filesystem::path> made_;
  int descriptor_ = -1;
};

// Renames the store and the logs that belong to it to results.old-1.sqlite (or -2, ...). Returns
// the new path of the store. Logs whose store is gone are renamed alike. Nothing is deleted.
// Requires a claim of the folder.
std::filesystem::path SetStoreAside(const std::filesystem::path& folder);

// Returns the folders that hold a store: `path` itself, or else its direct subfolders in
// alphabetical order. Throws StoreError kMissing where there is none.
std::vector<std::filesystem::path> FindRuns(const std::filesystem::path& path);

}  // namespace rockyard::batch
