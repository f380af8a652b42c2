#include "core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <new>
#include <string>
#include <system_error>
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

namespace {

// Codes of a machine that is short or broken; IsMachineFailure adds EDQUOT. Campaigns depend on
// them: a trial that fails by one of them is left undone, to be run again; by any other code it is
// recorded as a simulator fault and stays one.
constexpr std::array kShort = {std::errc::not_enough_memory,
                               std::errc::too_many_files_open,
                               std::errc::too_many_files_open_in_system,
                               std::errc::no_space_on_device,
                               std::errc::file_too_large,
                               std::errc::io_error,
                               std::errc::resource_unavailable_try_again,
                               std::errc::read_only_file_system};

}  // namespace

bool IsMachineFailure(const std::exception& error) {
  if (dynamic_cast<const MachineError*>(&error) != nullptr) return true;
  if (const auto* system = dynamic_cast<const std::system_error*>(&error)) {
    return system->code() == std::error_code(EDQUOT, std::generic_category()) ||
           std::any_of(kShort.begin(), kShort.end(),
                       [&](std::errc code) { return system->code() == code; });
  }
  return dynamic_cast<const std::bad_alloc*>(&error) != nullptr &&
         dynamic_cast<const std::bad_array_new_length*>(&error) == nullptr;
}

void FailOnDisk(const std::filesystem::path& path, std::string_view what,
                const std::error_code& error, std::string_view suggestion) {
  const Problem problem{path.string(), fmt::format("{}: {}", what, error.message()),
                        std::string(suggestion)};
  if (IsMachineFailure(std::system_error(error))) throw MachineError({problem});
  throw UserError({problem});
}

}  // namespace rockyard::core
