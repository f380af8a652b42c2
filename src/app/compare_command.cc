// rockyard compare
#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "app/commands.h"
#include "app/console.h"
#include "app/run_source.h"
#include "core/error.h"
#include "report/paired_comparison.h"

namespace rockyard::app {
namespace {

struct CompareOptions {
  std::string first;
  std::string second;
};

report::ComparedRun View(const StoredRun& run) {
  if (run.prefix().empty()) {
    throw core::UserError(run.folder.string(), "holds no finished trials to compare",
                          "run some first");
  }
  return {run.identity.scenario, run.identity.seed, run.identity.schema, run.prefix()};
}

void Compare(const CompareOptions& options) {
  const StoredRun first = ReadRun(options.first);
  const StoredRun second = ReadRun(options.second);
  const report::ComparedRun a = View(first);
  const report::ComparedRun b = View(second);
  Print(report::RunComparisonText(a, b, report::CompareRuns(a, b)));
}

}  // namespace

void AddCompareCommand(CLI::App& app) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* command = app.add_subcommand(
      "compare", "Compares two runs, trial by trial where their seeds are the same");
  command->add_option("RUN_A", options->first, "folder of a run")->required();
  command->add_option("RUN_B", options->second, "folder of a run")->required();
  command->callback([options] { Compare(*options); });
}

}  // namespace rockyard::app
