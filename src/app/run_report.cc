#include "app/run_report.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "app/console.h"
#include "app/next_command.h"
#include "batch/executor.h"
#include "campaign/run_source.h"
#include "report/accounting.h"
#include "report/atomic_file.h"
#include "report/measurement_text.h"
#include "report/run_csv.h"
#include "report/run_files.h"
#include "report/summary_json.h"
#include "report/summary_text.h"
#include "scenario/load.h"
#include "truth/measurement_record.h"

namespace rockyard::app {
namespace {

void Show(const ReportOptions& options, const std::string& text, const std::string& json,
          const std::filesystem::path& folder, Finished what) {
  switch (options.output) {
    case Output::kText:
      Print(text);
      Print(fmt::format("  results in {}\n", folder.string()));
      if (options.next) Print(NextLine(folder, what, options.resume));
      break;
    case Output::kJson:
      Print(json);
      break;
    case Output::kQuiet:
      break;
  }
}

void ReportShard(const campaign::StoredRun& run, const report::RunDescription& description,
                 const ReportOptions& options) {
  const std::string json = report::ShardJson(description);
  report::WriteFileAtomically(run.folder / "scenario.resolved.json",
                              report::ResolvedScenarioJson(description));
  report::WriteFileAtomically(run.folder / "trials.csv",
                              report::TrialsCsv(run.schema, run.records));
  report::WriteFileAtomically(run.folder / "summary.json", json);
  Show(options, report::ShardText(description), json, run.folder, Finished::kShard);
}

void ReportMeasurement(const campaign::StoredRun& run, const report::RunDescription& description,
                       const ReportOptions& options) {
  const statistics::MeasurementSummary summary = report::WriteMeasurementFiles(
      run.folder, description, run.schema, run.records, run.prefix(), options.method);
  Show(options, report::MeasurementText(description, summary, StyleFor(stdout)),
       report::MeasurementJson(description, summary, options.method), run.folder,
       Finished::kMeasurement);
}

void ReportDrives(const campaign::StoredRun& run, const report::RunDescription& description,
                  const ReportOptions& options) {
  const statistics::DriveSummary summary = report::WriteRunFiles(
      run.folder, description, run.schema, run.records, run.prefix(), options.method);
  Show(options, report::SummaryText(description, summary, StyleFor(stdout)),
       report::SummaryJson(description, summary, options.method), run.folder, Finished::kDrives);
}

}  // namespace

void ReportRun(const std::filesystem::path& folder, const ReportOptions& options) {
  const campaign::StoredRun run = campaign::ReadRun(folder);
  report::RunDescription description =
      campaign::Describe(run, batch::ThreadCount({.threads = options.threads}));
  // With the trials that are planned now; the run may have been extended.
  description.resolved = scenario::ResolvedJson(
      campaign::LoadScenarioFrom(folder, std::vector{fmt::format("trials={}", run.planned)}));
  if (!run.shard.whole()) {
    ReportShard(run, description, options);
  } else if (truth::IsMeasurement(run.schema)) {
    ReportMeasurement(run, description, options);
  } else {
    ReportDrives(run, description, options);
  }
}

}  // namespace rockyard::app
