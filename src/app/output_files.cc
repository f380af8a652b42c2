#include "app/output_files.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "app/console.h"
#include "report/atomic_file.h"
#include "report/line_text.h"

namespace rockyard::app {

void AddExistingFiles(CLI::App& command, campaign::ExistingFiles& existing, bool resumes) {
  using campaign::ExistingFiles;
  CLI::Option* force = command.add_flag_callback(
      "--force", [&existing] { existing = ExistingFiles::kSetAside; },
      "set whatever has the names it needs aside, in old-1 of the folder (nothing is deleted); "
      "what "
      "the same command has finished there is set aside in any case");
  if (!resumes) return;
  command
      .add_flag_callback(
          "--resume", [&existing] { existing = ExistingFiles::kResume; },
          "go on with what the same command, cut off, has left in the folder")
      ->excludes(force);
}

std::string FilesText(std::span<const campaign::OutputFile> files) {
  std::string text;
  for (const campaign::OutputFile& file : files) {
    text += fmt::format("  {} in {}\n", file.what, report::Printable(file.path.string()));
  }
  return text;
}

void WriteNamedFile(std::string_view what, const std::string& file, std::string_view bytes) {
  report::WriteFileAtomically(file, bytes);
  PrintNote(fmt::format("  {} in {}", what, file));
}

}  // namespace rockyard::app
