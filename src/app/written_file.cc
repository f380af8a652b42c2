#include "app/written_file.h"

#include <fmt/format.h>

#include "app/console.h"
#include "report/atomic_file.h"

namespace rockyard::app {

void WriteNamedFile(std::string_view what, const std::string& file, std::string_view bytes) {
  report::WriteFileAtomically(file, bytes);
  PrintNote(fmt::format("  {} in {}", what, file));
}

}  // namespace rockyard::app
