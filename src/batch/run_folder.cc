#include "batch/run_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "batch/store_error.h"

namespace rockyard::batch {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOtherFolder = "check the permissions, or choose another folder with --out";

// False where it was there.
bool MakeFolder(const fs::path& folder) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error)) {
    throw StoreError(StoreProblem::kUnwritable, folder.string(), "is a file, not a folder",
                     "choose another folder with --out");
  }
  const bool made = fs::create_directories(folder, error);
  if (error) {
    throw StoreError(StoreProblem::kUnwritable, folder.string(),
                     "cannot be made: " + error.message(), kOtherFolder);
  }
  return made;
}

// A folder can exist and still refuse files: permissions, read-only media, full disks.
void CheckWritable(const fs::path& folder) {
  const fs::path probe = folder / fmt::format(".write-test-{}", getpid());
  const int descriptor = open(probe.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor < 0) {
    const int reason = errno;
    throw StoreError(
        reason == ENOSPC || reason == EDQUOT ? StoreProblem::kFull : StoreProblem::kUnwritable,
        folder.string(), fmt::format("cannot be written: {}", std::strerror(reason)), kOtherFolder);
  }
  close(descriptor);
  unlink(probe.c_str());
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

FolderClaim::FolderClaim(const fs::path& folder) {
  const bool made = MakeFolder(folder);
  descriptor_ = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor_ < 0) {
    throw StoreError(StoreProblem::kUnwritable, folder.string(),
                     fmt::format("cannot be opened: {}", std::strerror(errno)), kOtherFolder);
  }
  if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    close(descriptor_);
    throw StoreError(StoreProblem::kInUse, folder.string(), "is in use by another run",
                     "wait for it to end, or choose another folder with --out");
  }
  try {
    CheckWritable(folder);
  } catch (...) {
    std::error_code ignored;
    if (made) fs::remove(folder, ignored);
    close(descriptor_);
    throw;
  }
}

FolderClaim::~FolderClaim() { close(descriptor_); }

fs::path SetStoreAside(const fs::path& folder) {
  const fs::path store = StorePath(folder);
  fs::path aside;
  std::error_code error;
  for (int number = 1; aside.empty() || fs::exists(aside, error); ++number) {
    aside = folder / fmt::format("results.old-{}.sqlite", number);
  }
  // The log first: it belongs to the store by name, and holds trials that are not yet in it.
  for (const char* suffix : {"-wal", ""}) {
    const fs::path from = WithSuffix(store, suffix);
    if (!fs::exists(from, error)) continue;
    fs::rename(from, WithSuffix(aside, suffix), error);
    if (error) {
      throw StoreError(StoreProblem::kUnwritable, from.string(),
                       "cannot be set aside: " + error.message(), kOtherFolder);
    }
  }
  fs::remove(WithSuffix(store, "-shm"), error);  // an index of the log; made anew when needed
  return aside;
}

std::vector<fs::path> FindRuns(const fs::path& path) {
  if (HoldsStore(path)) return {path};
  std::vector<fs::path> runs;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(path, error)) {
    if (HoldsStore(entry.path())) runs.push_back(entry.path());
  }
  std::sort(runs.begin(), runs.end());
  if (runs.empty()) {
    throw StoreError(StoreProblem::kMissing, path.string(),
                     fmt::format("holds no {}, and no folder in it does", kStoreFile),
                     "name the folder of a run, as `rockyard run` prints it");
  }
  return runs;
}

}  // namespace rockyard::batch
