// The command `rockyard replay`: one trial again as a page, or its scans and steps
// (replay_views.h).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <tuple>

#include "app/commands.h"
#include "app/console.h"
#include "app/option_checks.h"
#include "app/progress_line.h"
#include "app/replay_views.h"
#include "app/run_display.h"
#include "app/run_folders.h"
#include "campaign/replay.h"
#include "report/line_text.h"

namespace rockyard::app {
namespace {

ExitCode WriteReplay(const ReplayOptions& options) {
  std::optional<campaign::TrialRequest> beside = options.Beside();
  if (beside) FindSource(*beside);
  const campaign::ReplayResult result = [&] {
    const BusyLine busy(fmt::format("driving trial {} again", options.request.trial));
    return campaign::Replay({.trial = options.request,
                             .beside = beside,
                             .page = options.out,
                             .plan = options.svg,
                             .data = options.data},
                            MessagesToConsole(Output::kText));
  }();
  if (result.title.empty()) return result.outcome;
  Print(fmt::format("  {}\n", report::Printable(fmt::format("{}: {}, {}", result.title,
                                                            truth::Name(result.record.outcome),
                                                            result.record.detail))));
  PrintRepetition(result.repeats_stored, options.request.source);
  for (const campaign::ReplayFile& file : result.files) {
    Print(fmt::format("  {} in {}\n", file.what, report::Printable(file.path.string())));
  }
  return result.outcome;
}

void AddOptions(CLI::App& command, ReplayOptions& options) {
  CLI::Option* scan =
      command
          .add_option("--scan", options.scan,
                      "number of a scan, from 0: writes its images and its array instead")
          ->check(CLI::NonNegativeNumber);
  CLI::Option* step =
      command
          .add_option("--step", options.step,
                      "number of a step, from 0: writes map, votes and choice of the navigator "
                      "instead, and what stereo cameras saw")
          ->check(CLI::NonNegativeNumber)
          ->excludes(scan);
  CLI::Option* list =
      command.add_flag("--list", options.list, "lists scans and steps, and writes nothing")
          ->excludes(scan)
          ->excludes(step);
  command
      .add_option("--out", options.out,
                  "page (default: <folder of the run>-trial<I>.html; of a scenario "
                  "results/runs/<name>-seed<seed>-trial<I>.html); of a scan or step a folder "
                  "(default: ...-scan<N>, or -step<N>)")
      ->excludes(list);
  command
      .add_option(
          "--with", options.with,
          "scenario or run whose trial is shown beside it, on one clock (default: the same, "
          "for --with-trial)")
      ->excludes(list)
      ->excludes(scan)
      ->excludes(step);
  command
      .add_option("--with-trial", options.with_trial,
                  "index of that trial (default: that of --trial)")
      ->excludes(list)
      ->excludes(scan)
      ->excludes(step);
  for (const auto& [name, file, what] :
       {std::tuple{"--svg", &options.svg, "file for the plan view (default: beside the page)"},
        std::tuple{"--data", &options.data, "file for what the page is given, as JSON"}}) {
    command.add_option(name, *file, what)->excludes(list)->excludes(scan)->excludes(step);
  }
}

}  // namespace

void AddReplayCommand(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<ReplayOptions>();
  CLI::App* command = app.add_subcommand(
      "replay",
      "Runs one trial again and writes a 3-D replay of it, a page for a browser, and a plan view; "
      "or lists\nor draws the scans of its light stripe and the steps of its map-based navigator");
  AddTrialOptions(*command, options->request);
  AddOptions(*command, *options);
  command->callback([options, &exit_code] {
    FindSource(options->request);
    exit_code = options->list || options->draws() ? ShowViews(*options) : WriteReplay(*options);
  });
}

}  // namespace rockyard::app
