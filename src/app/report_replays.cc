#include "app/report_replays.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <system_error>

#include "app/console.h"
#include "app/replay_page.h"
#include "app/trial_source.h"
#include "core/error.h"
#include "report/worst_trials.h"
#include "statistics/drive_summary.h"
#include "truth/measurement_record.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;

// What a file name can hold anywhere.
std::string FileName(const WorstTrial& worst) {
  std::string name = worst.label.substr(0, 60);
  for (char& c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x80 || (std::isalnum(byte) == 0 && c != '-' && c != '.' && c != '_')) c = '_';
  }
  // The number of the run keeps names apart that differ in other characters only.
  return fmt::format("{}-{}-trial{}.html", worst.run + 1, name, worst.trial);
}

// As a link in a page has to be written (RFC 3986).
std::string PercentEncoded(const std::string& text) {
  std::string link;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain =
        byte < 0x80 && (std::isalnum(byte) != 0 || c == '-' || c == '.' || c == '_' || c == '~');
    link += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return link;
}

void ShowProgress(std::size_t number, std::size_t all, const WorstTrial& worst) {
  const std::string text =
      fmt::format("  replay {} of {}: trial {} of {}", number, all, worst.trial, worst.label);
  if (!IsTerminal(stderr)) return PrintNote(text);
  const std::size_t width = static_cast<std::size_t>(TerminalWidth(stderr)) - 1;
  const std::string line =
      fmt::format("\r\x1b[K{}{}", text.substr(0, width), number == all ? "\n" : "");
  std::fwrite(line.data(), 1, line.size(), stderr);
}

// True where the page may be linked.
bool WriteOne(const WorstTrial& worst, const fs::path& path, ExitCode& exit_code) {
  try {
    const TrialSource source = FindTrial({.source = worst.folder.string(),
                                          .cell = worst.cell,
                                          .trial = static_cast<std::uint32_t>(worst.trial),
                                          .seed = {},
                                          .overrides = {}});
    if (WriteReplayPage(source, worst.trial, path)) return true;
    PrintProblems({{fmt::format("{}, trial {}", worst.label, worst.trial),
                    "driven again, its record is not the stored one",
                    "use the program that made the run: " + source.builds.front()}});
    exit_code = ExitCode::kDiffers;
  } catch (const core::UserError& error) {
    PrintProblems(error.problems());
    if (exit_code == ExitCode::kDone) exit_code = ExitCode::kFailed;
  }
  return false;
}

}  // namespace

std::vector<WorstTrial> FindWorst(const StoredRun& run, std::size_t most) {
  std::vector<WorstTrial> worst;
  if (truth::IsMeasurement(run.schema)) return worst;
  const auto column = statistics::ColumnIndex(run.schema, "true_goal_distance_m");
  for (const std::uint64_t trial : report::WorstTrials(run.schema, run.records, most)) {
    const auto at = std::lower_bound(
        run.records.begin(), run.records.end(), trial,
        [](const truth::Record& record, std::uint64_t wanted) { return record.trial < wanted; });
    const double distance_m =
        column ? at->values[*column] : std::numeric_limits<double>::quiet_NaN();
    worst.push_back({.folder = run.folder,
                     .cell = run.identity.name.empty() ? std::string() : std::to_string(run.cell),
                     .run = 0,
                     .label = {},
                     .trial = trial,
                     .goal_distance_m = std::isfinite(distance_m)
                                            ? distance_m
                                            : std::numeric_limits<double>::infinity()});
  }
  return worst;
}

std::vector<WorstTrial> Worst(std::vector<WorstTrial> trials, std::size_t most) {
  std::stable_sort(trials.begin(), trials.end(), [](const WorstTrial& a, const WorstTrial& b) {
    return a.goal_distance_m > b.goal_distance_m;
  });
  if (trials.size() > most) trials.resize(most);
  return trials;
}

ReportReplays WriteReplays(const fs::path& page, std::span<const WorstTrial> trials,
                           std::size_t runs) {
  ReportReplays replays;
  replays.links.resize(runs);
  if (trials.empty()) return replays;
  const std::string name = page.stem().string() + "_replays";
  replays.folder = page.parent_path() / name;
  std::error_code error;
  fs::create_directories(replays.folder, error);
  if (error) {
    throw core::UserError(replays.folder.string(), "cannot be made: " + error.message(),
                          "choose another place with --out, or --replays 0");
  }
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const WorstTrial& worst = trials[i];
    const std::string file = FileName(worst);
    ShowProgress(i + 1, trials.size(), worst);
    if (!WriteOne(worst, replays.folder / file, replays.exit_code)) continue;
    ++replays.written;
    replays.links[worst.run].push_back(
        {worst.trial, PercentEncoded(name) + "/" + PercentEncoded(file)});
  }
  return replays;
}

}  // namespace rockyard::app
