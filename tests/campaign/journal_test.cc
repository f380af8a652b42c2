// Which end of a piece of work an exception out of it is.
#include "campaign/journal.h"

#include <cerrno>
#include <filesystem>
#include <functional>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>

#include "batch/store_error.h"
#include "core/error.h"

namespace rockyard::campaign {
namespace {

using batch::StoreError;
using batch::StoreProblem;

struct Failure {
  Outcome outcome;
  std::string reason;
};

Failure FailureOf(const std::function<void()>& action) {
  const WorkResult result = Recorded({}, [&](Journal& journal) {
    return Guarded(journal, [&] {
      action();
      return Outcome::kDone;
    });
  });
  return {result.outcome, result.problems.empty() ? "" : result.problems.front().reason};
}

void ExpectFailure(const std::function<void()>& action, Outcome outcome,
                   const std::string& reason) {
  const Failure failure = FailureOf(action);
  EXPECT_EQ(failure.outcome, outcome) << reason;
  EXPECT_EQ(failure.reason, reason);
}

TEST(Guarded, WorkThatEndsIsDone) {
  ExpectFailure([] {}, Outcome::kDone, "");
}

TEST(Guarded, AMistakeOfTheUserIsBadInput) {
  ExpectFailure([] { throw core::UserError("a", "is wrong", "b"); }, Outcome::kBadInput,
                "is wrong");
  ExpectFailure([] { throw StoreError(StoreProblem::kMissing, "a", "is missing", "b"); },
                Outcome::kBadInput, "is missing");
}

TEST(Guarded, ANameThatCannotBeUsedIsBadInput) {
  const auto code = [](int reason) { return std::error_code(reason, std::generic_category()); };
  const auto fail = [&](int reason) {
    return [=] { throw std::filesystem::filesystem_error("status", "a", code(reason)); };
  };
  ExpectFailure(fail(ENAMETOOLONG), Outcome::kBadInput, "File name too long");
  ExpectFailure(fail(EACCES), Outcome::kBadInput, "Permission denied");
  ExpectFailure(fail(ENOSPC), Outcome::kFailed, "No space left on device");
}

TEST(Guarded, AFailureOfTheMachineIsNoMistakeOfTheUser) {
  ExpectFailure([] { throw core::MachineError("a", "has no room", "b"); }, Outcome::kFailed,
                "has no room");
  ExpectFailure([] { throw StoreError(StoreProblem::kFull, "a", "is full", "b"); },
                Outcome::kFailed, "is full");
  ExpectFailure([] { throw StoreError(StoreProblem::kOpenFiles, "a", "has many", "b"); },
                Outcome::kFailed, "has many");
  ExpectFailure([] { throw std::bad_alloc(); }, Outcome::kFailed, "is exhausted");
  ExpectFailure([] { throw std::runtime_error("what happened"); }, Outcome::kFailed,
                "what happened");
  ExpectFailure([] { throw 3; }, Outcome::kFailed, "failed for an unknown reason");
}

}  // namespace
}  // namespace rockyard::campaign
