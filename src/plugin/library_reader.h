// Readers of images of a shared library. A failure throws navigation::NavigatorFault: the drive
// ends as one whose navigator failed, and the reason names the reader.
#pragma once

#include <cstddef>
#include <memory>

#include "plugin/foreign_reader.h"
#include "plugin/library_calls.h"

namespace rockyard::plugin {

// Returns the source of the readers at a place of the library's list.
std::shared_ptr<const ReaderSource> MakeLibraryReaders(
    std::shared_ptr<const LoadedLibrary> library, std::size_t place,
    std::unique_ptr<const Description> description);

}  // namespace rockyard::plugin
