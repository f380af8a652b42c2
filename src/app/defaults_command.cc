// rockyard defaults
#include <CLI/CLI.hpp>

#include "app/commands.h"
#include "app/console.h"
#include "scenario/load.h"

namespace rockyard::app {

void AddDefaultsCommand(CLI::App& app) {
  app.add_subcommand("defaults", "Prints a scenario with every parameter at its default")
      ->callback([] { PrintJson(scenario::DefaultsJson()); });
}

}  // namespace rockyard::app
