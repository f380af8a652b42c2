// What can go wrong with a run folder and its store.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace rockyard::batch {

enum class StoreProblem {
  kMissing,     // no store where one is needed
  kExists,      // a store where none may be
  kUnwritable,  // the folder or a file in it cannot be made or written
  kFull,        // no space left, or a limit on file sizes or quotas
  kOpenFiles,   // the process or the machine may open no more files
  kMemory,      // the process could get no more memory
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

// Whether the machine failed, not the request: the same command may succeed later.
bool IsOfTheMachine(StoreProblem problem);

// What an errno means for a file or folder that is to be made, opened or written.
StoreProblem ProblemOf(int reason);

// Throws what an errno means, with what to do. `what`: "cannot be made".
[[noreturn]] void FailSystem(const std::filesystem::path& path, std::string_view what, int reason);

// Throws kDamaged, with what to do.
[[noreturn]] void FailDamaged(const std::filesystem::path& path, const std::string& reason);

}  // namespace rockyard::batch
