// The command `rockyard report`: a page for a browser about runs and sweeps.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>

#include "app/command_text.h"
#include "app/commands.h"
#include "app/console.h"
#include "app/run_display.h"
#include "app/run_folders.h"
#include "campaign/output_folder.h"
#include "campaign/report.h"
#include "campaign/scenario_names.h"
#include "report/line_text.h"

namespace rockyard::app {
namespace {

constexpr double kLargePage_bytes = 5e6;

std::string Size(std::size_t bytes) {
  return bytes < 1000000 ? fmt::format("{:.0f} kB", 1e-3 * static_cast<double>(bytes))
                         : fmt::format("{:.1f} MB", 1e-6 * static_cast<double>(bytes));
}

void ShowReplayProgress(const campaign::ReplayProgress& progress, campaign::Moment moment) {
  if (moment == campaign::Moment::kEnd) {
    if (IsTerminal(stderr)) std::fputc('\n', stderr);
    return;
  }
  const std::string text =
      report::Printable(fmt::format("  replay {} of {}: trial {} of {}", progress.ended,
                                    progress.total, progress.trial, progress.label));
  if (!IsTerminal(stderr)) return PrintNote(text);
  const auto width = static_cast<std::size_t>(std::max(TerminalWidth(stderr) - 1, 20));
  const std::string line = "\r\x1b[K" + report::Cut(text, width);
  std::fwrite(line.data(), 1, line.size(), stderr);
}

// Shows one line that is rewritten, and whose end stays; elsewhere than on a terminal the end
// alone.
void ShowTrackProgress(const campaign::TrackProgress& progress, campaign::Moment moment) {
  const bool ends = moment == campaign::Moment::kEnd;
  const std::string text = report::Printable(
      fmt::format("  track {} of {} of {}", progress.ended, progress.total, progress.label));
  if (!IsTerminal(stderr)) {
    if (ends) PrintNote(text);
    return;
  }
  const auto width = static_cast<std::size_t>(std::max(TerminalWidth(stderr) - 1, 20));
  const std::string line = "\r\x1b[K" + report::Cut(text, width) + (ends ? "\n" : "");
  std::fwrite(line.data(), 1, line.size(), stderr);
}

void PrintPage(const campaign::ReportResult& result) {
  const std::string file = result.page.string();
  const campaign::ReportReplays& replays = result.replays;
  Print(fmt::format("  {} ({}): {} run{}, {} trials\n", report::Printable(file),
                    Size(result.page_bytes), result.runs, result.runs == 1 ? "" : "s",
                    result.trials));
  if (replays.written > 0) {
    Print(fmt::format("  {} replay{} in {}\n", replays.written, replays.written == 1 ? "" : "s",
                      report::Printable(replays.folder.string())));
  }
  if (static_cast<double>(result.page_bytes) > kLargePage_bytes) {
    PrintNote(fmt::format(
        "the page has {}, and may open slowly: name fewer runs, or one cell with --cell",
        Size(result.page_bytes)));
  }
  Print(fmt::format("  next: open it in a browser, for example `xdg-open {}`\n",
                    campaign::ShellPath(file)));
}

ExitCode WritePage(const campaign::ReportRequest& request) {
  RequireRuns(request.runs);
  campaign::ReportObserver observer;
  static_cast<campaign::Observer&>(observer) = MessagesToConsole(Output::kText);
  observer.replays = ShowReplayProgress;
  observer.tracks = ShowTrackProgress;
  const campaign::ReportResult result = campaign::WriteReport(request, observer, StopBySignal());
  if (result.data_bytes > 0) {
    Print(fmt::format("  {} ({})\n", report::Printable(request.data), Size(result.data_bytes)));
  }
  if (result.page_bytes > 0) PrintPage(result);
  return result.outcome;
}

}  // namespace

void AddReportCommand(CLI::App& app, ExitCode& exit_code) {
  auto options = std::make_shared<campaign::ReportRequest>();
  CLI::App* command = app.add_subcommand(
      "report", "Writes a page for a browser: what runs and sweeps say, and replays of failures");
  command
      ->add_option("RUN", options->runs,
                   "folders of runs or sweeps; runs are compared with the first")
      ->required();
  command->add_option("--out", options->page,
                      "page to write (default: report.html in the folder that is named first)");
  command
      ->add_option("--replays", options->replays,
                   "replays that are written with it: of the worst failed trials of each run, or "
                   "of each sweep; of a run also one of each outcome; 0: none")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command
      ->add_option("--tracks", options->tracks,
                   "trials of each run that are driven again for a map of their true paths (a "
                   "fourth of them where the rover is multibody), for 20 s at most; 0: none")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  command->add_flag("--plugins", options->plugins,
                    "drive trials again, for replays and tracks, also where a plugin or process "
                    "decides: that runs its code");
  command->add_option("--against", options->against,
                      "reference with published values (default: those in results/reference that "
                      "name the scenarios)");
  command->add_option("--cell", options->cell,
                      "one cell of a campaign alone: its name, or number from 0");
  command->add_option("--title", options->title, "title of the page (default: the scenarios)");
  command->add_option("--data", options->data, "write the numbers of the page to this file (JSON)");
  command->callback([options, command, &exit_code] {
    options->references = campaign::ProjectPath(options->references);
    if (!options->against.empty()) options->against = campaign::ProjectPath(options->against);
    options->command = CommandText(*command);
    exit_code = WritePage(*options);
  });
}

}  // namespace rockyard::app
