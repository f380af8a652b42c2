// Commands whose --out is a folder of files: the options, and what is told of the files.
#pragma once

#include <span>
#include <string>

#include "campaign/output_folder.h"

namespace CLI {
class App;
}

namespace rockyard::app {

// Adds --force, and --resume where work can be gone on with. `existing` must outlive the command.
void AddExistingFiles(CLI::App& command, campaign::ExistingFiles& existing, bool resumes = false);

// A line a file: "  points in FOLDER/points.ply".
std::string FilesText(std::span<const campaign::OutputFile> files);

}  // namespace rockyard::app
