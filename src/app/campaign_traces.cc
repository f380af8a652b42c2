#include "app/campaign_traces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

#include "app/console.h"
#include "app/progress_line.h"
#include "app/run_source.h"
#include "batch/parallel_tasks.h"
#include "batch/trial_hash.h"
#include "core/error.h"
#include "report/atomic_file.h"
#include "report/trace_csv.h"
#include "report/trace_npz.h"
#include "scenario/sweep.h"

namespace rockyard::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostProblems = 8;  // that are told

fs::path CellFolder(const fs::path& folder, const StoredRun& run) {
  fs::path traces = folder / "traces";
  if (run.identity.name.empty()) return traces;
  return traces / scenario::CellFileName(static_cast<std::size_t>(run.cell), run.identity.name);
}

// Temporary files of a process that was killed while it wrote; nobody else writes here.
void RemoveLeftovers(const fs::path& folder) {
  std::error_code ignored;
  std::vector<fs::path> leftovers;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    if (entry.path().extension().string().starts_with(".tmp-")) leftovers.push_back(entry.path());
  }
  for (const fs::path& path : leftovers) fs::remove(path, ignored);
}

class TraceWriter {
 public:
  TraceWriter(fs::path folder, const TraceRequest& request, const std::atomic<bool>& stop)
      : folder_(std::move(folder)), request_(request), stop_(stop), line_(stderr) {}

  void WriteCell(const StoredRun& run) {
    const scenario::Scenario scenario = LoadScenarioFrom(folder_, {}, std::to_string(run.cell));
    const fs::path folder = CellFolder(folder_, run);
    fs::create_directories(folder);
    RemoveLeftovers(folder);
    std::vector<const truth::Record*> wanted;
    const auto kept = KeptTrials(request_.retention, run.schema, run.records, run.identity.seed);
    auto next = kept.begin();
    for (const truth::Record& record : run.records) {
      if (next == kept.end() || record.trial != *next) continue;
      ++next;
      std::error_code ignored;
      if (fs::exists(folder / TraceFileName(record.trial, request_.format), ignored)) {
        ++there_;
      } else {
        wanted.push_back(&record);
      }
    }
    planned_ += wanted.size();
    batch::RunTasks(wanted.size(), request_.threads, stop_,
                    [&](std::size_t i) { WriteTrial(scenario, run, *wanted[i], folder); });
  }

  ExitCode Finish() {
    if (!request_.quiet && planned_ > 0) line_.FinishText(Progress());
    if (!problems_.empty()) {
      const std::size_t more = problems_.size() - std::min(problems_.size(), kMostProblems);
      problems_.resize(problems_.size() - more);
      PrintProblems(problems_);
      if (more > 0) PrintNote(fmt::format("and {} more", more));
      return ExitCode::kFailed;
    }
    if (stop_) {
      PrintNote(
          fmt::format("interrupted: {} of {} traces are written; the same command with "
                      "--resume writes the others",
                      written_, planned_));
      return ExitCode::kInterrupted;
    }
    if (!request_.quiet) {
      PrintNote(fmt::format("{} traces written{}, in {}", written_,
                            there_ > 0 ? fmt::format(", {} were there", there_) : "",
                            (folder_ / "traces").string()));
    }
    return ExitCode::kDone;
  }

 private:
  std::string Progress() const {
    return fmt::format("  traces: {}/{} written", written_, planned_);
  }

  // Says what is wrong with a trial, and lets the others go on.
  void WriteTrial(const scenario::Scenario& scenario, const StoredRun& run,
                  const truth::Record& stored, const fs::path& folder) {
    const fs::path path = folder / TraceFileName(stored.trial, request_.format);
    std::vector<core::Problem> problems;
    try {
      const DriveRecording recording = RecordDrive(scenario, run.identity.seed, stored.trial);
      const auto differences =
          report::RecordDifferences(run.schema, stored, recording.traced.record);
      if (differences.empty()) {
        report::WriteFileAtomically(
            path, TraceBytes(scenario, run.identity.name, recording, request_.format));
      } else {
        problems.push_back({path.string(),
                            fmt::format("is not written: the drive does not repeat the record of "
                                        "trial {} ({})",
                                        stored.trial, differences.front()),
                            "use the program that made the run"});
      }
    } catch (const core::UserError& error) {
      problems = error.problems();
    }
    const std::lock_guard lock(mutex_);
    if (problems.empty()) ++written_;
    problems_.insert(problems_.end(), problems.begin(), problems.end());
    if (!request_.quiet) line_.ShowText(Progress());
  }

  const fs::path folder_;
  const TraceRequest& request_;
  const std::atomic<bool>& stop_;
  std::mutex mutex_;
  ProgressLine line_;
  std::size_t planned_ = 0;
  std::size_t written_ = 0;
  std::size_t there_ = 0;
  std::vector<core::Problem> problems_;
};

}  // namespace

std::string TraceBytes(const scenario::Scenario& scenario, const std::string& cell,
                       const DriveRecording& recording, TraceFormat format) {
  const report::TracedTrial& traced = recording.traced;
  if (format == TraceFormat::kCsv) return report::TraceCsv(traced.trace);
  const std::vector<report::ReplayPose> poses = PosesOf(scenario, traced.trace);
  return report::TraceNpz({.traced = traced,
                           .poses = poses,
                           .scans = recording.scans,
                           .steps = recording.steps,
                           .cell = cell,
                           .record_hash = batch::TrialHash(std::span(&traced.record, 1)),
                           .provenance = core::CurrentProvenance()});
}

std::string TraceFileName(std::uint64_t trial, TraceFormat format) {
  return fmt::format("trial-{:06}.{}", trial, format == TraceFormat::kCsv ? "csv" : "npz");
}

ExitCode WriteTraces(const fs::path& folder, const TraceRequest& request,
                     const std::atomic<bool>& stop) {
  TraceWriter writer(folder, request, stop);
  const batch::ResultStore store = batch::ResultStore::Read(folder);
  const CellReader reader(folder, store);
  for (int cell = 0; cell < store.cells() && !stop; ++cell) writer.WriteCell(reader.Load(cell));
  return writer.Finish();
}

}  // namespace rockyard::app
