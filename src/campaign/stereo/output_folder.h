// A folder that a command fills with files.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace rockyard::campaign {

// A file that was written.
struct OutputFile {
  std::string what;
  std::filesystem::path path;
};

class OutputFolder {
 public:
  // Makes the folder. Throws core::UserError where it cannot be made.
  explicit OutputFolder(std::filesystem::path path);

  // Writes a file as report::WriteFileAtomically does, and keeps what is where.
  void Write(std::string_view what, std::string_view name, std::string_view bytes);

  const std::vector<OutputFile>& files() const { return files_; }

 private:
  std::filesystem::path path_;
  std::vector<OutputFile> files_;
};

}  // namespace rockyard::campaign
