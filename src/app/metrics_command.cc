// rockyard metrics
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "app/commands.h"
#include "app/console.h"
#include "report/parameter_table.h"

namespace rockyard::app {

void AddMetricsCommand(CLI::App& app) {
  auto markdown = std::make_shared<bool>(false);
  CLI::App* command =
      app.add_subcommand("metrics", "Lists what is computed of drives, each with its definition");
  command->add_flag("--markdown", *markdown, "as the table of src/statistics/README.md");
  command->callback([markdown] {
    Print(*markdown ? report::MetricTableMarkdown() : Wrapped(report::MetricTableText()));
  });
}

}  // namespace rockyard::app
