// What can go wrong with a run folder and its store.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/error.h"

namespace rockyard::batch {

enum class StoreProblem {
  kMissing,     // no store where one is needed
  kExists,      // a store where none may be
  kUnwritable,  // the folder or a file in it cannot be made or written
  kFull,        // no space left, or a limit on file sizes or quotas
  kInUse,       // another process runs in this folder
  kDamaged,     // no database, cut off, or with contents that no version of this program wrote
  kMismatch,    // made by another scenario, seed or build
};

// Every message names the file or folder, what is wrong, and what to do.
class StoreError : public core::UserError {
 public:
  StoreError(StoreProblem problem, std::vector<core::Problem> problems);
  StoreError(StoreProblem problem, std::string path, std::string reason, std::string suggestion);

  StoreProblem problem() const { return problem_; }

 private:
  StoreProblem problem_;
};

// Throws kDamaged, with what to do.
[[noreturn]] void FailDamaged(const std::filesystem::path& path, const std::string& reason);

}  // namespace rockyard::batch
