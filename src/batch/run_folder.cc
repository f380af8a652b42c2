#include "batch/run_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

#include "batch/sqlite_database.h"
#include "core/files.h"

namespace rockyard::batch {
namespace {

namespace fs = std::filesystem;

// What SQLite keeps beside a store until its last commits are in it. The first two belong to the
// store by name; the third is an index of the first, made anew when needed. result_store.cc and
// sqlite_open.cc write the same suffixes.
constexpr std::array kLogs = {"-wal", "-journal"};
constexpr const char* kLogIndex = "-shm";

bool IsThere(const fs::path& path) {
  std::error_code error;
  return fs::exists(fs::symlink_status(path, error));
}

// Throws where the folder exists and still refuses files: permissions, read-only media, full disks.
void CheckWritable(const fs::path& folder) {
  core::RemoveLeftovers(StorePath(folder));
  try {
    const core::TemporaryFile probe(StorePath(folder));
  } catch (const std::system_error& error) {
    FailSystem(folder, "cannot be written", error.code().value());
  }
}

fs::path WithSuffix(const fs::path& path, const char* suffix) {
  return fs::path(path.string() + suffix);
}

}  // namespace

fs::path StorePath(const fs::path& folder) { return folder / kStoreFile; }

bool HoldsStore(const fs::path& folder) {
  std::error_code error;
  return fs::exists(StorePath(folder), error);
}

bool HoldsNoRunYet(const fs::path& folder) {
  std::error_code error;
  if (HoldsStore(folder)) return false;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    const fs::path name = entry.path().filename();
    const bool log = std::any_of(kLogs.begin(), kLogs.end(), [&](const char* suffix) {
      return name == WithSuffix(kStoreFile, suffix);
    });
    const bool left =
        log || name == WithSuffix(kStoreFile, kLogIndex) || core::IsTemporaryOf(kStoreFile, name);
    if (!left) return false;
  }
  return !error;
}

bool HoldsLog(const fs::path& folder) {
  return std::any_of(kLogs.begin(), kLogs.end(), [&](const char* suffix) {
    return IsThere(WithSuffix(StorePath(folder), suffix));
  });
}

std::vector<fs::path> MakeFolders(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error)) {
    throw StoreError(StoreProblem::kUnwritable, folder.string(), "is a file, not a folder",
                     "choose another folder with --out");
  }
  std::vector<fs::path> missing;
  for (fs::path path = folder; !path.empty() && !fs::exists(path, error);
       path = path.parent_path()) {
    if (path.has_filename()) missing.push_back(path);
  }
  std::reverse(missing.begin(), missing.end());
  std::vector<fs::path> made;
  for (const fs::path& path : missing) {
    if (fs::create_directory(path, error)) made.insert(made.begin(), path);
    if (!error) continue;
    const EmptyFolders failed(std::move(made));
    FailSystem(folder, "cannot be made", error.value());
  }
  return made;
}

EmptyFolders::~EmptyFolders() {
  for (const fs::path& folder : folders_) rmdir(folder.c_str());
}

FolderClaim::FolderClaim(const fs::path& folder) : made_(MakeFolders(folder)) {
  try {
    descriptor_ = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor_ < 0) FailSystem(folder, "cannot be opened", errno);
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      throw StoreError(StoreProblem::kInUse, folder.string(), "is in use by another run",
                       "wait for it to end, or choose another folder with --out");
    }
    CheckWritable(folder);
  } catch (...) {
    const EmptyFolders failed(std::move(made_));
    if (descriptor_ >= 0) close(descriptor_);
    throw;
  }
}

FolderClaim::~FolderClaim() { close(descriptor_); }

fs::path SetStoreAside(const fs::path& folder) {
  const fs::path store = StorePath(folder);
  fs::path aside;
  const auto taken = [&] {
    return IsThere(aside) || std::any_of(kLogs.begin(), kLogs.end(), [&](const char* suffix) {
             return IsThere(WithSuffix(aside, suffix));
           });
  };
  for (int number = 1; aside.empty() || taken(); ++number) {
    aside = folder / fmt::format("results.old-{}.sqlite", number);
  }
  // The store is renamed first. Where this is cut off then, a log without a store is left, which
  // gets a number of its own. The other way round a store without its log would be left, and look
  // whole.
  for (const char* suffix : {"", kLogs[0], kLogs[1]}) {
    const fs::path from = WithSuffix(store, suffix);
    std::error_code error;
    if (!IsThere(from)) continue;
    fs::rename(from, WithSuffix(aside, suffix), error);
    if (error) FailSystem(from, "cannot be set aside", error.value());
  }
  std::error_code ignored;
  fs::remove(WithSuffix(store, kLogIndex), ignored);
  return aside;
}

std::vector<fs::path> FindRuns(const fs::path& path) {
  if (HoldsStore(path)) return {path};
  std::vector<fs::path> runs;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(path, error)) {
    if (HoldsStore(entry.path())) runs.push_back(entry.path());
  }
  if (error == std::errc::permission_denied) FailSystem(path, "cannot be read", error.value());
  std::sort(runs.begin(), runs.end());
  if (runs.empty()) {
    throw StoreError(StoreProblem::kMissing, path.string(),
                     fmt::format("holds no {}, and no folder in it does", kStoreFile),
                     "name the folder of a run, as `rockyard run` prints it");
  }
  return runs;
}

}  // namespace rockyard::batch
