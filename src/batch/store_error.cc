#include "batch/store_error.h"

#include <utility>

namespace rockyard::batch {

StoreError::StoreError(StoreProblem problem, std::vector<core::Problem> problems)
    : core::UserError(std::move(problems)), problem_(problem) {}

StoreError::StoreError(StoreProblem problem, std::string path, std::string reason,
                       std::string suggestion)
    : core::UserError(std::move(path), std::move(reason), std::move(suggestion)),
      problem_(problem) {}

}  // namespace rockyard::batch
