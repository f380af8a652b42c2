#include "campaign/output_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <system_error>

#include "batch/run_folder.h"
#include "campaign/open_run.h"
#include "core/error.h"
#include "core/temporary_file.h"

namespace rockyard::campaign {

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
  // A device or a pipe would be replaced by the file rather than written to.
  if (fs::exists(file, error) && !fs::is_regular_file(file, error)) {
    throw core::UserError(std::string(option), "is there and is no regular file: " + file,
                          "name a file");
  }
  if (IsRunFile(fs::path(file).filename()) &&
      batch::HoldsStore(fs::absolute(file, error).parent_path())) {
    throw core::UserError(std::string(option), "is a file of the run itself: " + file,
                          "choose another name");
  }
  if (!core::HasRoomForTemporary(file)) {
    throw core::UserError(std::string(option), "has too long a name: " + file, "shorten it");
  }
  // Files are made beside their place and renamed, so that the folder is what counts.
  if (access(fs::absolute(file, error).parent_path().c_str(), W_OK) != 0) {
    throw core::UserError(std::string(option), "is in a folder that cannot be written to: " + file,
                          "check its permissions, or name a file elsewhere");
  }
}

void CheckExtension(std::string_view option, const std::string& file, std::string_view extension) {
  if (file.empty() || fs::path(file).extension() == extension) return;
  throw core::UserError(std::string(option), fmt::format("does not end in {}: {}", extension, file),
                        fmt::format("name a file such as report{}", extension));
}

void CheckDistinct(std::span<const NamedFile> files) {
  const auto normal = [](const NamedFile& file) { return fs::path(file.file).lexically_normal(); };
  for (std::size_t i = 0; i < files.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (files[i].file.empty() || normal(files[i]) != normal(files[j])) continue;
      throw core::UserError(files[i].option,
                            "is the same file as " + files[j].option + ": " + files[i].file,
                            "name another file");
    }
  }
}

}  // namespace rockyard::campaign
