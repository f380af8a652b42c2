#include "campaign/stereo/output_folder.h"

#include <system_error>
#include <utility>

#include "core/error.h"
#include "report/atomic_file.h"

namespace rockyard::campaign {

OutputFolder::OutputFolder(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code error;
  std::filesystem::create_directories(path_, error);
  if (error) {
    throw core::UserError(path_.string(), "cannot be made: " + error.message(),
                          "choose another --out");
  }
}

void OutputFolder::Write(std::string_view what, std::string_view name, std::string_view bytes) {
  report::WriteFileAtomically(path_ / name, bytes);
  files_.push_back({std::string(what), path_ / name});
}

}  // namespace rockyard::campaign
