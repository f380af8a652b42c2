#include "batch/batch_session.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <ctime>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "batch/executor.h"
#include "batch/sqlite_database.h"
#include "batch/supervisor.h"
#include "batch/trial_hash.h"
#include "core/check.h"

namespace rockyard::batch {
namespace {

using Clock = std::chrono::steady_clock;

// Throws the first error of the writer, and adds what it means for the finished trials.
[[noreturn]] void ReportLoss(const StoreError& error, std::size_t unwritten) {
  std::vector<core::Problem> problems = error.problems();
  problems.front().reason += fmt::format(
      "; {} finished trials could not be stored, those stored before are safe", unwritten);
  throw StoreError(error.problem(), std::move(problems));
}

void CloseWriter(RecordWriter& writer) {
  try {
    writer.Close();
  } catch (const StoreError& error) {
    ReportLoss(error, writer.unwritten());
  }
}

Progress ProgressOf(const WorkPlan& plan) {
  Progress progress;
  progress.cells = plan.cells();
  for (int cell = 0; cell < plan.cells(); ++cell) {
    const FinishedCounts finished = plan.finished(cell);
    progress.finished += finished.trials;
    progress.faults += finished.faults;
    progress.planned += plan.planned(cell);
    if (finished.trials == plan.planned(cell)) ++progress.cells_ended;
    progress.widest_half_width =
        std::max(progress.widest_half_width, plan.state(cell).half_width());
  }
  if (plan.cells() == 1) progress.prefix = plan.counter(0).prefix();
  return progress;
}

}  // namespace

BatchSession::BatchSession(ResultStore& store, const BatchOptions& options,
                           const std::atomic<bool>& stop, ProgressReport report)
    : store_(store),
      options_(options),
      report_(std::move(report)),
      start_(Clock::now()),
      plan_(StoredPlan(store, options.rule, options.order)),
      finished_before_(ProgressOf(plan_).finished),
      source_(plan_, writer_, stop),
      writer_(store, options.interval, [this] { Tell(); }) {
  writer_.Start();
}

BatchResult BatchSession::Close() {
  CloseWriter(writer_);
  Tell();
  BatchResult result;
  result.progress = Now();
  const Progress& progress = result.progress;
  const auto too_many = [&](std::int64_t faults, std::int64_t finished) {
    return static_cast<double>(faults) >
           options_.max_fault_fraction * static_cast<double>(finished);
  };
  for (int cell = 0; cell < plan_.cells(); ++cell) {
    const FinishedCounts finished = plan_.finished(cell);
    if (too_many(finished.faults, finished.trials)) result.faulty_cells.push_back(cell);
    result.cells.push_back(plan_.state(cell));
  }
  result.too_many_faults =
      !result.faulty_cells.empty() || too_many(progress.faults, progress.finished);
  // A session that was asked to stop in the moment of its last trial has finished, too.
  const bool done = source_.exhausted() || (progress.finished == progress.planned &&
                                            plan_.Next().step == WorkPlan::Step::kDone);
  result.end = done ? BatchEnd::kFinished : BatchEnd::kStopped;
  if (done) {
    ENSURE(progress.finished == progress.planned);
    StoreEnds();
  }
  return result;
}

void BatchSession::StoreEnds() {
  // From now on the number of planned trials in the store is that which the rule asked for; until
  // now it was the most that the rule allows.
  if (!options_.rule) return;
  for (int cell = 0; cell < plan_.cells(); ++cell) {
    if (plan_.planned(cell) != store_.planned(cell)) store_.SetPlanned(cell, plan_.planned(cell));
  }
}

Progress BatchSession::Now() const {
  Progress progress = source_.Read(ProgressOf);
  progress.finished_before = std::min(finished_before_, progress.finished);
  progress.stored = writer_.stored();
  progress.target_half_width = options_.rule ? options_.rule->half_width : 0.0;
  progress.elapsed_s = std::chrono::duration<double>(Clock::now() - start_).count();
  return progress;
}

void BatchSession::Tell() const {
  if (report_) report_(Now());
}

namespace {

double ThreadCpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

std::int64_t PeakMemory_B() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return std::int64_t{1024} * used.ru_maxrss;
}

double Pilots::Run(int trials) {
  const std::int64_t before_B = PeakMemory_B();
  const double begin_s = ThreadCpu_s();
  for (int i = 0; i < trials; ++i) {
    const double start_s = ThreadCpu_s();
    records_.push_back(RunTrial(std::span(&work_, 1), {0, std::ssize(records_)}).record);
    cost_s_.Add(ThreadCpu_s() - start_s);
  }
  memory_B_ += PeakMemory_B() - before_B;
  return ThreadCpu_s() - begin_s;
}

PilotCost Pilots::cost() const {
  PilotCost pilot;
  pilot.trials = std::ssize(records_);
  pilot.hash = TrialHash(records_);
  pilot.memory_B = memory_B_;
  if (records_.empty()) return pilot;
  pilot.mean_s = cost_s_.mean();
  pilot.slowest_s = cost_s_.max();
  if (pilot.trials > 1) pilot.variance_s2 = cost_s_.variance();
  return pilot;
}

}  // namespace rockyard::batch
