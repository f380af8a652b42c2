#include "campaign/run_report.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "batch/executor.h"
#include "campaign/run_source.h"
#include "report/accounting.h"
#include "report/atomic_file.h"
#include "report/run_files.h"
#include "report/summary_json.h"
#include "scenario/load.h"
#include "truth/measurement_record.h"

namespace rockyard::campaign {
namespace {

void WriteShardFiles(const StoredRun& run, const report::RunDescription& description) {
  report::WriteFileAtomically(run.folder / "scenario.resolved.json",
                              report::ResolvedScenarioJson(description));
  report::WriteTrialsCsv(run.folder, run.schema, run.records);
  report::WriteFileAtomically(run.folder / "summary.json", report::ShardJson(description));
}

}  // namespace

RunReport ReportRun(const std::filesystem::path& folder, const ReportSettings& settings) {
  const StoredRun run = ReadRun(folder);
  RunReport told{.folder = run.folder,
                 .description = Describe(run, batch::ThreadCount({.threads = settings.threads})),
                 .summary = {},
                 .method = run.rule ? statistics::IntervalMethod::kStopped : settings.method};
  // With the trials that are planned now; the run may have been extended.
  told.description.resolved = scenario::ResolvedJson(
      LoadScenarioFrom(folder, std::vector{fmt::format("trials={}", run.planned)}));
  if (!run.shard.whole()) {
    WriteShardFiles(run, told.description);
  } else if (truth::IsMeasurement(run.schema)) {
    told.summary = report::WriteMeasurementFiles(run.folder, told.description, run.schema,
                                                 run.records, run.prefix(), told.method);
  } else {
    told.summary = report::WriteRunFiles(run.folder, told.description, run.schema, run.records,
                                         run.prefix(), told.method);
  }
  return told;
}

}  // namespace rockyard::campaign
