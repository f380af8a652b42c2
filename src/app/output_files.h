// Files that commands write. The commands whose --out is a folder of files (stereo, vo, render,
// calibrate, cylinder) share its options and the text that lists the files; other commands write
// single files beside what they print.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "campaign/output_folder.h"

namespace CLI {
class App;
}

namespace rockyard::app {

// Adds --force, and where `resumes` --resume, for work that can be gone on with. `existing` must
// outlive the command.
void AddExistingFiles(CLI::App& command, campaign::ExistingFiles& existing, bool resumes = false);

// Returns a line for each file: " points in FOLDER/points.ply".
std::string FilesText(std::span<const campaign::OutputFile> files);

// Writes the file as report::WriteFileAtomically does, and notes it on standard error, so that
// standard output has only what was asked for: "  table in FILE".
void WriteNamedFile(std::string_view what, const std::string& file, std::string_view bytes);

}  // namespace rockyard::app
