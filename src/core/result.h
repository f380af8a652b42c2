// Errors as values: what campaign and vision return where an input can be wrong.
#pragma once

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
  Result(const MachineError& error)  // NOLINT(google-explicit-constructor): see above
      : Result(error.problems()) {
    machine_failed_ = true;
  }

  bool ok() const { return value_.has_value(); }
  // Empty where there is a value.
  const std::vector<Problem>& problems() const { return problems_; }

  // Both require ok().
  const Value& operator*() const { return value_.value(); }
  const Value* operator->() const { return &value_.value(); }

  // Returns the value. Where there is none, throws MachineError if the machine failed, which the
  // command line ends with exit code 5, else UserError.
  Value OrThrow() && {
    if (machine_failed_) throw MachineError(std::move(problems_));
    if (!ok()) throw UserError(std::move(problems_));
    return *std::move(value_);
  }

 private:
  std::optional<Value> value_;
  std::vector<Problem> problems_;
  bool machine_failed_ = false;
};

// Returns what `action` returns, or the problems of the UserError or MachineError that it throws.
template <typename Action>
auto Attempt(Action&& action) -> Result<std::invoke_result_t<Action>> {
  try {
    return std::forward<Action>(action)();
  } catch (const MachineError& error) {
    return error;
  } catch (const UserError& error) {
    return error.problems();
  }
}

}  // namespace rockyard::core
