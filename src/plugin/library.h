// Navigators, estimators and readers of a shared library (abi.h). What a library says of itself is
// asked in a child process; it is loaded into this one when the first drive begins. From then on
// its code is code of this process: a crash ends the process, and the supervisor of campaigns finds
// the trial.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/hash.h"
#include "plugin/foreign_estimator.h"
#include "plugin/foreign_navigator.h"
#include "plugin/foreign_reader.h"

namespace rockyard::plugin {

// Adds the bytes of a file. Throws core::UserError where it cannot be read.
void AddFile(const std::filesystem::path& file, core::Hasher& hasher);

// Returns what a library is known by: a hash of its bytes.
std::string HashOfLibrary(const std::filesystem::path& file);

// What a library holds.
struct OpenedLibrary {
  std::vector<std::shared_ptr<const NavigatorSource>> navigators;
  std::vector<std::shared_ptr<const EstimatorSource>> estimators;
  std::vector<std::shared_ptr<const ReaderSource>> readers;
};

// Returns what a library holds that has that hash. Throws core::UserError: no such
// file, no shared library, no plugin, of another version of the interface, a wrong description.
// Drives throw core::MachineError where the file is another one by then.
OpenedLibrary OpenLibrary(const std::filesystem::path& file, const std::string& hash);

}  // namespace rockyard::plugin
