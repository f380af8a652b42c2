// rockyard merge
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "app/commands.h"
#include "app/console.h"
#include "app/run_report.h"
#include "app/sweep_report.h"
#include "batch/merge_shards.h"
#include "batch/result_store.h"
#include "core/error.h"
#include "scenario/sweep.h"

namespace rockyard::app {
namespace {

struct MergeCommandOptions {
  std::vector<std::filesystem::path> shards;
  std::string out;
  bool any_build = false;
  bool partial = false;
  bool json = false;
  bool quiet = false;
};

// What is merged stays, whatever becomes of the report.
ExitCode Report(const std::filesystem::path& folder, const ReportOptions& options) {
  try {
    const batch::ResultStore store = batch::ResultStore::Read(folder);
    const std::string& design = store.identity().design;
    if (design.empty()) {
      ReportRun(folder, options);
    } else {
      ReportSweep(store, scenario::ParseSweep(design), options);
    }
    return ExitCode::kDone;
  } catch (const core::UserError& error) {
    PrintNote("the shards are together in " + folder.string() + ", but not all that follows");
    PrintProblems(error.problems());
    return ExitCode::kFailed;
  }
}

// A trace belongs to a trial, but which trials have one was decided in each shard alone.
void TellTraces(const MergeCommandOptions& options) {
  std::error_code ignored;
  for (const std::filesystem::path& shard : options.shards) {
    if (!std::filesystem::is_directory(shard / "traces", ignored)) continue;
    PrintNote(
        fmt::format("traces of shards are not merged: the same run or sweep with --out {}, "
                    "--resume and --traces, and without --shard, writes those of the whole",
                    options.out));
    return;
  }
}

ExitCode Merge(const MergeCommandOptions& options) {
  const batch::BuildPolicy build =
      options.any_build ? batch::BuildPolicy::kAny : batch::BuildPolicy::kSame;
  batch::MergeShards(options.shards, options.out, {.build = build, .partial = options.partial});
  ReportOptions report;
  if (options.json) report.output = Output::kJson;
  if (options.quiet) report.output = Output::kQuiet;
  if (!options.quiet) TellTraces(options);
  return Report(options.out, report);
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
