#include "core/error.h"

#include <utility>

namespace rockyard::core {
namespace {

std::string Describe(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) {
    if (!text.empty()) text += '\n';
    text += problem.path + ": " + problem.reason;
    if (!problem.suggestion.empty()) text += " (" + problem.suggestion + ")";
  }
  return text;
}

}  // namespace

UserError::UserError(std::vector<Problem> problems)
    : std::runtime_error(Describe(problems)), problems_(std::move(problems)) {}

UserError::UserError(std::string path, std::string reason, std::string suggestion)
    : UserError({{std::move(path), std::move(reason), std::move(suggestion)}}) {}

}  // namespace rockyard::core
