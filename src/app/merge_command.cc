// The command `rockyard merge`: puts the shards of a campaign together.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/run_display.h"
#include "app/run_folders.h"
#include "app/show_report.h"
#include "campaign/run.h"

namespace rockyard::app {
namespace {

struct MergeCommandOptions {
  std::vector<std::string> shards;
  std::string out;
  bool any_build = false;
  bool partial = false;
  bool json = false;
  bool quiet = false;
};

ExitCode Merge(const MergeCommandOptions& options) {
  RequireRuns(options.shards);
  Output output = Output::kText;
  if (options.json) output = Output::kJson;
  if (options.quiet) output = Output::kQuiet;
  campaign::MergeObserver observer;
  static_cast<campaign::Observer&>(observer) = MessagesToConsole(output);
  observer.reported = [&](const campaign::FolderReport& report) {
    ShowReport(report, {.output = output, .resume = "", .next = true});
  };
  const batch::BuildPolicy build =
      options.any_build ? batch::BuildPolicy::kAny : batch::BuildPolicy::kSame;
  return campaign::Merge({.shards = {options.shards.begin(), options.shards.end()},
                          .folder = options.out,
                          .build = build,
                          .partial = options.partial},
                         observer)
      .outcome;
}

}  // namespace

void AddMergeCommand(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<MergeCommandOptions>();
  CLI::App* command =
      app.add_subcommand("merge", "Puts the shards of a campaign together (see run --shard)");
  command->add_option("SHARD", options->shards, "folders that were made with --shard I/N")
      ->required();
  command->add_option("--out", options->out, "new folder for the whole campaign")->required();
  command->add_flag("--any-build", options->any_build,
                    "mix shards of different builds of the program");
  command->add_flag("--partial", options->partial,
                    "although shards or trials are missing: they are pending then");
  CLI::Option* json =
      command->add_flag("--json", options->json, "print summary.json instead of the table");
  command->add_flag("--quiet", options->quiet, "print nothing but errors")->excludes(json);
  command->callback([options, &exit_code] { exit_code = Merge(*options); });
}

}  // namespace rockyard::app
