// Scenarios, sweeps and rovers by name. Commands and the Python package that take such a file take
// its name too; completion offers the names. Must stay: which file a word means, as scripts hold
// such words; no record depends on how a file was found.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rockyard::campaign {

// Returns the folder where scenarios are looked for: the one that the environment variable
// ROCKYARD_SCENARIOS names, whether or not it is there; else the first that is there of `scenarios`
// in the working directory, that of the installation and that of the source tree to which the
// program belongs, or else the Python module that this code is in; else "scenarios".
std::filesystem::path ScenarioFolder();

// Returns the file or folder that a path of the project means, "results/reference": itself where it
// is there, else that beside ScenarioFolder(), where an installed package has it; itself where
// neither is there.
std::string ProjectPath(const std::string& path);

// What a command takes where it asks for a file.
enum class Wanted { kScenario, kSweep, kEither, kRover };

// Returns the file that a word means. What exists is meant as it stands. Else the word is the end
// of the path of a file in ScenarioFolder(), with or without its ".json": "nominal",
// "gestalt/abundance". Only files of the wanted kind count; for kRover scenarios and parts. A word
// that is a whole path from that folder, "pathfinder/nominal", means this file alone, though longer
// paths end like it. Throws core::UserError where several files are meant, with all of them, and
// where none is, with the nearest name.
std::string ScenarioFile(const std::string& word, Wanted wanted = Wanted::kScenario);

// Returns the shortest name by which ScenarioFile finds each file of the kind, in alphabetical
// order.
std::vector<std::string> ScenarioNames(Wanted wanted);
// Returns the path of each file of the kind from ScenarioFolder(), without ".json":
// "gestalt/abundance".
std::vector<std::string> ScenarioPaths(Wanted wanted);

}  // namespace rockyard::campaign
