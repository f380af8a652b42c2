// Failures of the machine, beside those of an input.
#pragma once

#include <exception>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "core/error.h"

namespace rockyard::core {

// The machine failed, not the input: the same command may succeed later. Exit code 5.
class MachineError : public UserError {
 public:
  using UserError::UserError;
};

// Whether it says that memory, files, processes or disk are short or broken: a MachineError,
// std::bad_alloc, or a std::system_error with such a code. A size that is no size
// (std::bad_array_new_length, std::length_error) is a defect of the program.
bool IsMachineFailure(const std::exception& error);

// Throws what it means that a file or folder cannot be made, written or renamed: MachineError where
// the machine failed, else UserError (no permission). `what`: "cannot be made".
[[noreturn]] void FailOnDisk(
    const std::filesystem::path& path, std::string_view what, const std::error_code& error,
    std::string_view suggestion = "check the free space and the permissions of its folder");

// What to do where the process or the machine may open no more files.
inline constexpr const char* kMoreOpenFiles =
    "end other programs or allow more open files (ulimit -n), then run it again";

}  // namespace rockyard::core
