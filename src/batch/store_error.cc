#include "batch/store_error.h"

#include <utility>

namespace rockyard::batch {

StoreError::StoreError(StoreProblem problem, std::vector<core::Problem> problems)
    : core::UserError(std::move(problems)), problem_(problem) {}

StoreError::StoreError(StoreProblem problem, std::string path, std::string reason,
                       std::string suggestion)
    : core::UserError(std::move(path), std::move(reason), std::move(suggestion)),
      problem_(problem) {}

void FailDamaged(const std::filesystem::path& path, const std::string& reason) {
  throw StoreError(
      StoreProblem::kDamaged, path.string(), reason,
      "run again with --force: the file is set aside, not deleted, and the trials are run anew");
}

}  // namespace rockyard::batch
