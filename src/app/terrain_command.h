// rockyard terrain SCENARIO [--seed S] [--trial I] [--set PATH=VALUE]... --out FILE
#pragma once

namespace CLI {
class App;
}

namespace rockyard::app {

// Adds the subcommand that writes the terrain of one trial to a file, in the format that the file's
// extension names: json, csv, obj or svg. Parsing runs it; it throws core::UserError for a bad
// scenario, an unknown extension or a file that cannot be written, and then leaves no file behind.
void AddTerrainCommand(CLI::App& app);

}  // namespace rockyard::app
