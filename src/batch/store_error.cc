#include "batch/store_error.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/error.h"

namespace rockyard::batch {
namespace {

const char* Remedy(StoreProblem problem) {
  switch (problem) {
    case StoreProblem::kFull:
      return "free some space on the disk (or lift the quota), or use another folder";
    case StoreProblem::kOpenFiles:
      return core::kMoreOpenFiles;
    default:
      return "check the name and the permissions of the folder, or use another one";
  }
}

}  // namespace

StoreError::StoreError(StoreProblem problem, std::vector<core::Problem> problems)
    : core::UserError(std::move(problems)), problem_(problem) {}

StoreError::StoreError(StoreProblem problem, std::string path, std::string reason,
                       std::string suggestion)
    : core::UserError(std::move(path), std::move(reason), std::move(suggestion)),
      problem_(problem) {}

bool IsOfTheMachine(StoreProblem problem) {
  return problem == StoreProblem::kFull || problem == StoreProblem::kOpenFiles ||
         problem == StoreProblem::kMemory;
}

StoreProblem ProblemOf(int reason) {
  switch (reason) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return StoreProblem::kFull;
    case EMFILE:
    case ENFILE:
      return StoreProblem::kOpenFiles;
    default:
      return StoreProblem::kUnwritable;
  }
}

void FailSystem(const std::filesystem::path& path, std::string_view what, int reason) {
  const StoreProblem problem = ProblemOf(reason);
  throw StoreError(problem, path.string(), fmt::format("{}: {}", what, std::strerror(reason)),
                   Remedy(problem));
}

void FailDamaged(const std::filesystem::path& path, const std::string& reason) {
  throw StoreError(
      StoreProblem::kDamaged, path.string(), reason,
      "run it anew, by `rockyard run` or `rockyard sweep` with --force: the file is set aside, "
      "not deleted");
}

}  // namespace rockyard::batch
