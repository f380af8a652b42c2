// rockyard schema
#include <CLI/CLI.hpp>

#include "app/commands.h"
#include "app/console.h"
#include "scenario/load.h"

namespace rockyard::app {

void AddSchemaCommand(CLI::App& app) {
  app.add_subcommand("schema", "Prints the JSON Schema of scenario files")->callback([] {
    PrintJson(scenario::SchemaJson());
  });
}

}  // namespace rockyard::app
