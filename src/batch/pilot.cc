#include "batch/pilot.h"

#include <ctime>
#include <vector>

#include "batch/executor.h"
#include "batch/trial_hash.h"
#include "statistics/sample_statistics.h"

namespace rockyard::batch {
namespace {

double ThreadCpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

PilotCost RunPilots(const experiments::Experiment& experiment, std::uint64_t seed, int trials) {
  const CellWork work{&experiment, seed};
  statistics::Moments cost;
  std::vector<truth::Record> records;
  for (int trial = 0; trial < trials; ++trial) {
    const double begin_s = ThreadCpu_s();
    records.push_back(RunTrial(std::span(&work, 1), {0, trial}).record);
    cost.Add(ThreadCpu_s() - begin_s);
  }
  PilotCost pilot;
  pilot.trials = trials;
  pilot.hash = TrialHash(records);
  if (trials == 0) return pilot;
  pilot.mean_s = cost.mean();
  pilot.slowest_s = cost.max();
  if (trials > 1) pilot.variance_s2 = cost.variance();
  return pilot;
}

}  // namespace rockyard::batch
