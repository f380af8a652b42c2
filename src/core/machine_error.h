// Failures of the machine, beside those of an input.
#pragma once

#include "core/error.h"

namespace rockyard::core {

// The machine failed, not the input: the same command may succeed later. Exit code 5.
class MachineError : public UserError {
 public:
  using UserError::UserError;
};

// What to do where the process or the machine may open no more files.
inline constexpr const char* kMoreOpenFiles =
    "end other programs or allow more open files (ulimit -n), then run it again";

}  // namespace rockyard::core
