#include "app/output_file.h"

#include <filesystem>
#include <system_error>

#include "core/error.h"

namespace rockyard::app {

namespace fs = std::filesystem;

void CheckOutputFile(std::string_view option, const std::string& file) {
  if (file.empty()) return;
  std::error_code error;
  if (!fs::is_directory(fs::absolute(file, error).parent_path(), error)) {
    throw core::UserError(std::string(option), "is in a folder that does not exist: " + file,
                          "make the folder first");
  }
  if (fs::is_directory(file, error)) {
    throw core::UserError(std::string(option), "is a folder: " + file, "name a file");
  }
}

}  // namespace rockyard::app
