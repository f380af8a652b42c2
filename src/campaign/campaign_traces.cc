#include "campaign/campaign_traces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "batch/parallel_tasks.h"
#include "batch/trial_hash.h"
#include "campaign/campaign_process.h"
#include "campaign/replay_page.h"
#include "campaign/run_source.h"
#include "core/check.h"
#include "core/error.h"
#include "replay/trace_mcap.h"
#include "replay/trace_npz.h"
#include "report/atomic_file.h"
#include "report/trace_view.h"
#include "report/trial_outcomes.h"
#include "scenario/sweep.h"

namespace rockyard::campaign {
namespace {

namespace fs = std::filesystem;
using batch::Mission;

constexpr std::size_t kMaxProblems = 8;  // that are told

fs::path CellFolder(const fs::path& folder, const StoredRun& run) {
  fs::path traces = folder / "traces";
  if (run.identity.name.empty()) return traces;
  return traces / scenario::CellFileName(static_cast<std::size_t>(run.cell), run.identity.name);
}

// Notes a trial in the log as long as it lives.
class InFlight {
 public:
  InFlight(batch::FlightLog& log, batch::TrialId id) : log_(log), slot_(log.Begin(id)) {}
  ~InFlight() { log_.End(slot_); }
  InFlight(const InFlight&) = delete;
  InFlight& operator=(const InFlight&) = delete;

 private:
  batch::FlightLog& log_;
  int slot_;
};

class TraceWriter {
 public:
  TraceWriter(fs::path folder, const TraceRequest& request, const Mission& mission,
              batch::FlightLog& log, Journal& journal)
      : folder_(std::move(folder)),
        request_(request),
        mission_(mission),
        log_(log),
        journal_(journal) {}

  // Notes which traces of a cell are to be written. Must be called for every cell before the first
  // WriteCell: progress is told as a share of all.
  void PlanCell(const StoredRun& run) {
    std::vector<std::uint64_t>& wanted = wanted_.emplace_back();
    for (const std::uint64_t trial :
         KeptTrials(request_.retention, run.schema, run.records, run.identity.seed)) {
      if (!IsAsked({run.cell, static_cast<std::int64_t>(trial)})) continue;
      ++total_;
      std::error_code ignored;
      if (fs::exists(PathOf(run, trial), ignored)) {
        ++there_;
      } else {
        wanted.push_back(trial);
      }
    }
  }

  bool HasWork(int cell) const { return !wanted_[static_cast<std::size_t>(cell)].empty(); }

  void WriteCell(const StoredRun& run) {
    if (!MakeFolder(CellFolder(folder_, run))) return;
    const scenario::Scenario scenario =
        LoadScenarioFrom(folder_, {}, std::to_string(run.cell), request_.defaults);
    const std::vector<std::uint64_t>& wanted = wanted_[static_cast<std::size_t>(run.cell)];
    std::vector<const truth::Record*> records;
    for (const truth::Record& record : run.records) {
      if (std::binary_search(wanted.begin(), wanted.end(), record.trial)) {
        records.push_back(&record);
      }
    }
    batch::RunTasks(records.size(), request_.threads, log_.stop(),
                    [&](std::size_t i) { WriteTrial(scenario, run, *records[i]); });
  }

  Outcome Finish(const batch::ResultStore& store) {
    if (mission_.task == Mission::Task::kRunAlone) return Outcome::kDone;
    if (total_ > there_) Tell(Moment::kEnd);
    for (const batch::LeftOut& left : mission_.left_out) {
      problems_.push_back({fmt::format("trial {}", left.id.trial),
                           "has no trace: each time it was driven again its process died",
                           fmt::format("`{}`", ReplayLine(store, left.id))});
    }
    if (!problems_.empty()) return TellProblems();
    if (log_.stop()) {
      journal_.Warn(
          fmt::format("interrupted: {} of {} traces are written; the same command with "
                      "--resume writes the others",
                      there_ + written_, total_));
      return Outcome::kInterrupted;
    }
    journal_.Remark(Summary());
    return Outcome::kDone;
  }

 private:
  fs::path PathOf(const StoredRun& run, std::uint64_t trial) const {
    return CellFolder(folder_, run) / TraceFileName(trial, request_.format);
  }

  bool IsAsked(batch::TrialId id) const {
    if (mission_.task == Mission::Task::kRunAlone) return id == mission_.trial;
    return std::none_of(mission_.left_out.begin(), mission_.left_out.end(),
                        [&](const batch::LeftOut& left) { return left.id == id; });
  }

  bool MakeFolder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
      problems_.push_back({folder.string(), fmt::format("cannot be made: {}", error.message()),
                           "make room for a folder of that name"});
      return false;
    }
    return true;
  }

  void Tell(Moment moment) const {
    if (request_.progress) request_.progress({there_ + written_, total_}, moment);
  }

  // Says what was written. After a crash nobody knows which of the traces that are there were
  // written by this command.
  std::string Summary() const {
    const std::string traces = (folder_ / "traces").string();
    if (mission_.task == Mission::Task::kGoOn) {
      return fmt::format("{} traces are in {}", there_ + written_, traces);
    }
    return fmt::format("{} traces written{}, in {}", written_,
                       there_ > 0 ? fmt::format(", {} were there", there_) : "", traces);
  }

  Outcome TellProblems() {
    const std::size_t more = problems_.size() - std::min(problems_.size(), kMaxProblems);
    problems_.resize(problems_.size() - more);
    journal_.Fail(problems_);
    if (more > 0) journal_.Warn(fmt::format("and {} more", more));
    return Outcome::kFailed;
  }

  // Writes the trace of a trial. Where that fails it keeps the problems, and the other trials go
  // on.
  void WriteTrial(const scenario::Scenario& scenario, const StoredRun& run,
                  const truth::Record& stored) {
    const fs::path path = PathOf(run, stored.trial);
    std::vector<core::Problem> problems;
    try {
      const InFlight flight(log_, {run.cell, static_cast<std::int64_t>(stored.trial)});
      const DriveRecording recording = request_.drive(scenario, run.identity.seed, stored.trial);
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
    } catch (const std::exception& error) {
      problems.push_back({path.string(), fmt::format("is not written: {}", error.what()), ""});
    }
    const std::lock_guard lock(mutex_);
    if (problems.empty()) log_.SetStored(static_cast<std::int64_t>(++written_));
    problems_.insert(problems_.end(), problems.begin(), problems.end());
    Tell(Moment::kUnderWay);
  }

  const fs::path folder_;
  const TraceRequest& request_;
  const Mission& mission_;
  batch::FlightLog& log_;
  Journal& journal_;
  std::mutex mutex_;
  std::vector<std::vector<std::uint64_t>> wanted_;  // of each cell, ascending
  std::size_t total_ = 0;
  std::size_t there_ = 0;
  std::size_t written_ = 0;
  std::vector<core::Problem> problems_;
};

}  // namespace

std::string TraceBytes(const scenario::Scenario& scenario, const std::string& cell,
                       const DriveRecording& recording, TraceFormat format) {
  const truth::TracedTrial& traced = recording.traced;
  if (format == TraceFormat::kCsv) return report::TraceCsv(traced.trace);
  if (format == TraceFormat::kMcap) return replay::TraceMcap(DataOf(scenario, cell, recording));
  const std::vector<replay::ReplayPose> poses = PosesOf(scenario, traced.trace);
  return replay::TraceNpz({.traced = traced,
                           .poses = poses,
                           .scans = recording.scans,
                           .steps = recording.steps,
                           .overlays = recording.overlays,
                           .overlay_every = recording.overlay_every,
                           .cell = cell,
                           .record_hash = batch::TrialHash(std::span(&traced.record, 1)),
                           .provenance = core::CurrentProvenance()});
}

std::string TraceFileName(std::uint64_t trial, TraceFormat format) {
  return fmt::format("trial-{:06}.{}", trial,
                     kTraceFormatNames.at(static_cast<std::size_t>(format)));
}

Outcome WriteTraces(const fs::path& folder, const TraceRequest& request, const Mission& mission,
                    batch::FlightLog& log, Journal& journal) {
  TraceWriter writer(folder, request, mission, log, journal);
  const batch::ResultStore store = batch::ResultStore::Read(folder);
  const CellReader reader(folder, store);
  for (int cell = 0; cell < store.cells(); ++cell) writer.PlanCell(reader.Load(cell));
  for (int cell = 0; cell < store.cells() && !log.stop(); ++cell) {
    if (writer.HasWork(cell)) writer.WriteCell(reader.Load(cell));
  }
  return writer.Finish(store);
}

namespace {

// Returns false where the text is no rule.
bool AddRule(std::string_view rule, TraceRetention& retention) {
  constexpr std::string_view kWorst = "worst:";
  constexpr std::string_view kShare = "share:";
  if (rule == "all") {
    retention.all = true;
  } else if (rule == "failures") {
    retention.failures = true;
  } else if (rule.starts_with(kWorst)) {
    const auto count = NumberIn<std::size_t>(rule.substr(kWorst.size()));
    if (!count || *count == 0) return false;
    retention.worst = std::max(retention.worst, *count);
  } else if (rule.starts_with(kShare)) {
    const auto share = NumberIn<double>(rule.substr(kShare.size()));
    // Must be written so that a share that is not a number is refused.
    if (!share || !(*share > 0.0 && *share <= 1.0)) return false;
    retention.share = std::max(retention.share, *share);
  } else {
    return false;
  }
  return true;
}

std::uint64_t Mix(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31U);
}

}  // namespace

TraceRetention TraceOptions::retention() const {
  TraceRetention retention;
  std::vector<core::Problem> problems;
  for (const std::string& rule : rules) {
    if (AddRule(rule, retention)) continue;
    problems.push_back({"--traces", fmt::format("\"{}\" is no rule", rule),
                        "use all, failures, worst:N with N from 1, or share:P with 0 < P <= 1, "
                        "e.g. worst:20 or share:0.01"});
  }
  if (!problems.empty()) throw core::UserError(std::move(problems));
  return retention;
}

TraceFormat TraceOptions::form() const {
  const auto found = std::find(kTraceFormatNames.begin(), kTraceFormatNames.end(), format);
  EXPECT(found != kTraceFormatNames.end());
  return static_cast<TraceFormat>(found - kTraceFormatNames.begin());
}

bool IsInShare(std::uint64_t seed, std::uint64_t trial, double share) {
  constexpr double kTwoToMinus53 = 0x1p-53;
  return static_cast<double>(Mix(Mix(seed) ^ trial) >> 11U) * kTwoToMinus53 < share;
}

std::vector<std::uint64_t> KeptTrials(const TraceRetention& retention,
                                      const truth::RecordSchema& schema,
                                      std::span<const truth::Record> records, std::uint64_t seed) {
  std::set<std::uint64_t> kept;
  for (const truth::Record& record : records) {
    if (truth::IsFault(record) || truth::IsNavigatorCrash(record)) continue;
    if (retention.all || IsInShare(seed, record.trial, retention.share)) kept.insert(record.trial);
  }
  if (retention.failures) {
    for (const std::uint64_t trial : report::FailedTrials(records)) kept.insert(trial);
  }
  for (const std::uint64_t trial : report::WorstTrials(schema, records, retention.worst)) {
    kept.insert(trial);
  }
  return {kept.begin(), kept.end()};
}

std::string RetentionText(const TraceRetention& retention) {
  if (retention.all) return "every trial";
  std::string text;
  const auto add = [&](const std::string& what) {
    text += fmt::format("{}{}", text.empty() ? "" : ", ", what);
  };
  if (retention.failures) add("every failure");
  if (retention.worst > 0) add(fmt::format("the {} worst failures", retention.worst));
  if (retention.share > 0.0) add(fmt::format("{:.4g} % of all trials", 100.0 * retention.share));
  return text;
}

}  // namespace rockyard::campaign
