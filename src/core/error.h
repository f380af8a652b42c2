/// @file
/// User errors: everything wrong with an input, reported at once; and failures of the machine. What
/// reads or checks an input throws UserError; the command line tells its problems, `api` passes it
/// on.
#pragma once

#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace rockyard::core {

/// One thing wrong with an input.
struct Problem {
  std::string path;        ///< JSON path or file, e.g. "terrain.rocks.min_diameter_m"
  std::string reason;      ///< what is wrong, e.g. "is -1, below the smallest allowed value 0.02"
  std::string suggestion;  ///< what would be right, e.g. "use a value from 0.02 to 2"
};

/// Thrown when an input cannot be used. The command line turns it into exit code 2.
class UserError : public std::runtime_error {
 public:
  /// Requires at least one problem. what() is all of them as text, one a line.
  explicit UserError(std::vector<Problem> problems);
  /// One problem alone.
  UserError(std::string path, std::string reason, std::string suggestion);

  /// Returns everything that is wrong, in the order in which it was found.
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

/// Thrown when the machine failed, not the input: the same command may succeed later. The command
/// line turns it into exit code 5.
class MachineError : public UserError {
 public:
  using UserError::UserError;
};

/// Returns whether `error` says that memory, files, processes or disk are short or broken: a
/// MachineError, std::bad_alloc, or a std::system_error with such a code. A size that is no size
/// (std::bad_array_new_length, std::length_error) is a defect of the program. Stores depend on it:
/// a trial that fails so is left undone, any other failure is recorded as a simulator fault.
bool IsMachineFailure(const std::exception& error);

/// Throws for a file or folder that cannot be made, written or renamed: MachineError where the
/// machine failed, else UserError (no permission). `what` says what failed: "cannot be made".
[[noreturn]] void FailOnDisk(
    const std::filesystem::path& path, std::string_view what, const std::error_code& error,
    std::string_view suggestion = "check the free space and the permissions of its folder");

/// The suggestion of a MachineError where the process or the machine may open no more files.
inline constexpr const char* kMoreOpenFiles =
    "end other programs or allow more open files (ulimit -n), then run it again";

}  // namespace rockyard::core
