// What commands that read stores say of them first.
#pragma once

#include <span>
#include <string>

namespace rockyard::app {

// To standard error, a line for each store in those folders that has no checksums.
void NoteStores(std::span<const std::string> paths);

}  // namespace rockyard::app
