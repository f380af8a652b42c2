// What is wrong with an input, by a call that refuses it.
#pragma once

#include <gmock/gmock.h>

#include <ostream>
#include <string_view>

#include "core/error.h"

namespace rockyard::core {

inline void PrintTo(const Problem& problem, std::ostream* out) {
  *out << problem.path << ": " << problem.reason << " (" << problem.suggestion << ")";
}

// The problems of the UserError that `call` throws; none where it throws none.
template <typename Call>
std::vector<Problem> ProblemsIn(const Call& call) {
  try {
    call();
  } catch (const UserError& error) {
    return error.problems();
  }
  return {};
}

// The same in one text, as the command prints it; empty where it throws none.
template <typename Call>
std::string RefusalOf(const Call& call) {
  const std::vector<Problem> problems = ProblemsIn(call);
  return problems.empty() ? "" : UserError(problems).what();
}

// Matches problems of which there is one, with this path, and these words in reason and suggestion.
inline auto OneProblem(std::string_view path, std::string_view reason = "",
                       std::string_view suggestion = "") {
  using testing::AllOf;
  using testing::Field;
  const auto says = [](std::string_view words) {
    return AllOf(testing::Not(testing::IsEmpty()), testing::HasSubstr(std::string(words)));
  };
  return testing::ElementsAre(AllOf(Field("path", &Problem::path, std::string(path)),
                                    Field("reason", &Problem::reason, says(reason)),
                                    Field("suggestion", &Problem::suggestion, says(suggestion))));
}

// A text with one thing wrong, and what is said of it.
struct BadInput {
  std::string_view label;
  std::string_view json;
  std::string_view path;
  std::string_view reason;
  std::string_view suggestion;
};

inline std::ostream& operator<<(std::ostream& out, const BadInput& bad) { return out << bad.label; }

inline auto IsProblemOf(const BadInput& bad) {
  return OneProblem(bad.path, bad.reason, bad.suggestion);
}

}  // namespace rockyard::core
