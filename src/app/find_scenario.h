// Scenarios and sweeps by name: `rockyard run nominal`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace rockyard::app {

enum class WantedFile {
  kScenario,
  kSweep,
  kEither,
  kRover,  // a scenario, or a file of a rover alone
};

// Where the scenarios that come with rockyard are: the folder that ROCKYARD_SCENARIOS names, else
// `scenarios` of the working directory, of the folder of sources that the program was built in, or
// where it was installed; nothing where there is none of these.
std::optional<std::filesystem::path> ScenarioFolder();

// What a user named: `word` itself where there is such a file or folder, else the scenario or sweep
// of that name (its file without ".json", perhaps with folders before it). Throws core::UserError
// where there is none, with what may have been meant, or several, with their paths.
std::string FindScenario(const std::string& word, WantedFile wanted);

}  // namespace rockyard::app
