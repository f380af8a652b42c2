#include "app/show_report.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <variant>

#include "app/command_text.h"
#include "app/console.h"
#include "report/line_text.h"
#include "report/run_description.h"
#include "report/summary_json.h"
#include "report/summary_text.h"
#include "report/sweep_files.h"

namespace rockyard::app {
namespace {

using campaign::RunReport;
using campaign::SweepReport;
using campaign::SweepShardReport;

// Make the text or the JSON of a report only where it is asked for, as either takes time.
struct TextOf {
  std::string operator()(const RunReport& run) const {
    const report::RunDescription& description = run.description;
    if (const auto* drives = std::get_if<statistics::DriveSummary>(&run.summary)) {
      return report::SummaryText(description, *drives, StyleFor(stdout));
    }
    if (const auto* cells = std::get_if<statistics::MeasurementSummary>(&run.summary)) {
      return report::MeasurementText(description, *cells, StyleFor(stdout));
    }
    return report::ShardText(description);
  }
  std::string operator()(const SweepReport& told) const {
    return report::SweepText(told.sweep, told.summary, told.description, StyleFor(stdout));
  }
  std::string operator()(const SweepShardReport& told) const {
    return fmt::format("{}: shard {} of {}\n{}", report::Cut(report::Printable(told.name), 40),
                       told.shard.index, told.shard.count, report::AccountingText(told.total));
  }
};

struct JsonOf {
  std::string operator()(const RunReport& run) const {
    const report::RunDescription& description = run.description;
    if (const auto* drives = std::get_if<statistics::DriveSummary>(&run.summary)) {
      return report::SummaryJson(description, *drives);
    }
    if (const auto* cells = std::get_if<statistics::MeasurementSummary>(&run.summary)) {
      return report::MeasurementJson(description, *cells);
    }
    return report::ShardJson(description);
  }
  std::string operator()(const SweepReport& told) const {
    return report::SweepJson(told.sweep, told.summary, told.description);
  }
  std::string operator()(const SweepShardReport& told) const { return told.json; }
};

struct FinishedOf {
  Finished operator()(const RunReport& run) const {
    const bool share = std::holds_alternative<std::monostate>(run.summary);
    return share ? Finished::kShard : Finished::kWhole;
  }
  Finished operator()(const SweepReport&) const { return Finished::kWhole; }
  Finished operator()(const SweepShardReport&) const { return Finished::kShard; }
};

// Numbers of threads for which the preview of a sweep tells the cost.
constexpr std::array<int, 4> kThreadCounts{1, 2, 4, 16};

std::string MemoryText(std::int64_t memory_B) {
  return fmt::format("{:.3g} MB", 1e-6 * static_cast<double>(memory_B));
}

std::string CostText(const campaign::DryRun& told, std::string_view at_most) {
  const batch::PilotCost& pilot = told.pilot;
  const double count = static_cast<double>(told.pending);
  const double total_s = count * pilot.mean_s;
  return fmt::format(
      "  cost {}{:.3g} CPU seconds, give or take {:.2g}: {:.3g} s a trial in {} pilot trials; "
      "about {:.3g} s and {} on {} threads\n",
      at_most, total_s, std::sqrt(pilot.VarianceOf(count)), pilot.mean_s, pilot.trials,
      total_s / told.threads, MemoryText(told.memory_B), told.threads);
}

// Returns the line about traces; empty where none are asked for. It names rules, as which trials
// fail is not known before the run.
std::string TracesText(const campaign::DryRun& told) {
  if (!told.traces.any()) return "";
  return fmt::format("  traces of {} (of at most {} trials), which are driven twice\n",
                     campaign::RetentionText(told.traces), told.planned.total);
}

std::string CostDuration(double seconds) {
  if (seconds < 120.0) return fmt::format("{:.3g} s", seconds);
  if (seconds < 7200.0) return fmt::format("{:.3g} min", seconds / 60.0);
  return fmt::format("{:.3g} h", seconds / 3600.0);
}

std::string CostText(const campaign::CampaignCost& cost, const campaign::PlannedTrials& trials) {
  if (cost.pilots == 0) return "  no pilots, no cost\n";
  const std::string error = cost.standard_error_s
                                ? "standard error " + CostDuration(*cost.standard_error_s)
                                : "standard error unknown";
  std::string text =
      fmt::format("  expected cost, from {} pilot trials: {}{} of CPU time ({})\n    ", cost.pilots,
                  trials.at_most ? "at most " : "", CostDuration(cost.total_s), error);
  for (const int threads : kThreadCounts) {
    text += fmt::format("{} with {} thread{}{}", CostDuration(cost.total_s / threads), threads,
                        threads == 1 ? "" : "s", threads == kThreadCounts.back() ? "\n" : ", ");
  }
  return text + fmt::format(
                    "    (as many cores as threads; the slowest pilot took {}; {}, and {} for each "
                    "further thread)\n",
                    CostDuration(cost.slowest_s), MemoryText(cost.memory_B),
                    MemoryText(cost.thread_B));
}

}  // namespace

void ShowReport(const campaign::FolderReport& report, const ShowOptions& options) {
  if (options.output == Output::kJson) PrintJson(std::visit(JsonOf(), report));
  if (options.output != Output::kText) return;
  const std::filesystem::path folder =
      std::visit([](const auto& told) { return told.folder; }, report);
  Print(std::visit(TextOf(), report));
  Print(fmt::format("  results in {}\n", report::Printable(folder.string())));
  if (options.next) Print(NextLine(folder, std::visit(FinishedOf(), report), options.resume));
}

std::string RehearsalText(const campaign::DryRun& told) {
  const std::string_view at_most = told.planned.at_most ? "at most " : "";
  return Wrapped(fmt::format("{}, seed {}: {} planned, {} stored, {}{} to run\n",
                             report::Printable(told.name), told.seed, told.planned.text(),
                             told.stored, at_most, told.pending)) +
         Wrapped(CostText(told, at_most)) + Wrapped(TracesText(told)) +
         fmt::format("  into {}; nothing was written\n", report::Printable(told.folder.string()));
}

std::string RehearsalText(const campaign::SweepRehearsal& told) {
  return Wrapped(fmt::format("{}: {} cells, {}, seed {}\n", report::Printable(told.sweep.name),
                             told.sweep.cells.size(), told.trials.text(), told.sweep.seed)) +
         Wrapped(CostText(told.plan.cost, told.trials)) +
         fmt::format("  plan, and every cell's scenario, in {}\n",
                     report::Printable(told.plan.folder.string()));
}

}  // namespace rockyard::app
