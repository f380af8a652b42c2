// Errors as values: what campaign and vision return where an input can be wrong.
#pragma once

#include <exception>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/check.h"
#include "core/error.h"

namespace rockyard::core {

// A value, or everything that is wrong with its input, or with the machine.
template <typename Value>
class Result {
 public:
  // Implicit, so that a function returns either in plain words.
  Result(Value value)  // NOLINT(google-explicit-constructor): see above
      : value_(std::move(value)) {}
  Result(std::vector<Problem> problems)  // NOLINT(google-explicit-constructor): see above
      : problems_(std::move(problems)) {
    EXPECT(!problems_.empty());
  }
  // The problems of an error that OrThrow throws again as it was, whatever it derives from
  // UserError: the command line tells by its type who failed, the input or the machine.
  Result(const UserError& error, std::exception_ptr thrown)
      : problems_(error.problems()), thrown_(std::move(thrown)) {}

  bool ok() const { return value_.has_value(); }
  // Empty where there is a value.
  const std::vector<Problem>& problems() const { return problems_; }

  // Both require ok().
  const Value& operator*() const { return value_.value(); }
  const Value* operator->() const { return &value_.value(); }

  // Returns the value; where there is none, throws the error that Attempt caught, or UserError.
  Value OrThrow() && {
    if (thrown_) std::rethrow_exception(thrown_);
    if (!ok()) throw UserError(std::move(problems_));
    return *std::move(value_);
  }

 private:
  std::optional<Value> value_;
  std::vector<Problem> problems_;
  std::exception_ptr thrown_;
};

// Returns what `action` returns, or the problems of the UserError that it throws.
template <typename Action>
auto Attempt(Action&& action) -> Result<std::invoke_result_t<Action>> {
  try {
    return std::forward<Action>(action)();
  } catch (const UserError& error) {
    return {error, std::current_exception()};
  }
}

}  // namespace rockyard::core
