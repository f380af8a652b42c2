// Commands whose --out is a folder of files: the options, and what is told of the files;
// files that a command writes on the side.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "campaign/output_folder.h"

namespace CLI {
class App;
}

namespace rockyard::app {

// Adds --force, and --resume where work can be gone on with. `existing` must outlive the command.
void AddExistingFiles(CLI::App& command, campaign::ExistingFiles& existing, bool resumes = false);

// A line a file: "  points in FOLDER/points.ply".
std::string FilesText(std::span<const campaign::OutputFile> files);

// Writes the file as report::WriteFileAtomically does, and says on standard error what is where, so
// that standard output keeps what was asked for: "  table in FILE".
void WriteNamedFile(std::string_view what, const std::string& file, std::string_view bytes);

}  // namespace rockyard::app
