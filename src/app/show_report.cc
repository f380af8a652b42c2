#include "app/show_report.h"

#include <fmt/format.h>

#include <filesystem>
#include <variant>

#include "app/console.h"
#include "app/next_command.h"
#include "report/accounting.h"
#include "report/line_text.h"
#include "report/measurement_text.h"
#include "report/summary_json.h"
#include "report/summary_text.h"
#include "report/sweep_files.h"

namespace rockyard::app {
namespace {

using campaign::RunReport;
using campaign::SweepReport;
using campaign::SweepShardReport;

// A report as text and as JSON, made where it is asked for: each costs some.
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

}  // namespace rockyard::app
