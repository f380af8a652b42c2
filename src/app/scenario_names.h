// Scenarios and sweeps by name.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rockyard::app {

// Where scenarios are looked for, the first that is there: the folder that the environment variable
// ROCKYARD_SCENARIOS names, which is taken whether or not it is there; `scenarios` in the working
// directory; `../share/rockyard/scenarios` beside the folder of the program; and, for a program in
// the build folder of its source tree, the `scenarios` of that tree. "scenarios" where none is
// there.
std::filesystem::path ScenarioFolder();

// What a command takes where it asks for a file.
enum class Wanted { kScenario, kSweep, kEither, kRover };

// The file that a word means. What exists is meant as it stands. Else the word is the end of the
// path of a file in ScenarioFolder(), without its ".json": "nominal", "gestalt/abundance". Only
// files of the wanted kind count; for kRover scenarios and rovers. A path from the folder itself,
// "pathfinder/nominal", goes before longer ones that end like it. Throws core::UserError where
// several files are meant, with all of them, and where none is, with the nearest name.
std::string ScenarioFile(const std::string& word, Wanted wanted = Wanted::kScenario);

// The shortest names by which ScenarioFile finds each file of the kind, in alphabetical order.
std::vector<std::string> ScenarioNames(Wanted wanted);
// Their paths from the folder: "gestalt/abundance".
std::vector<std::string> ScenarioPaths(Wanted wanted);

}  // namespace rockyard::app
