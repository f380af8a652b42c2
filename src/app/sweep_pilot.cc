#include "app/sweep_pilot.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>

#include "batch/trial_hash.h"
#include "experiments/experiment.h"
#include "statistics/moments.h"

namespace rockyard::app {
namespace {

constexpr std::size_t kMostPilotCells = 100;

double CpuSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

PilotCost RunCell(const scenario::Scenario& scenario, std::uint64_t seed, int trials) {
  const auto experiment = experiments::MakeExperiment(scenario);
  statistics::Moments cost;
  std::vector<truth::Record> records;
  for (int trial = 0; trial < trials; ++trial) {
    const double begin = CpuSeconds();
    records.push_back(experiment->Run(seed, static_cast<std::uint64_t>(trial)));
    cost.Add(CpuSeconds() - begin);
  }
  return {.trials = trials,
          .mean_s = cost.mean(),
          .variance_s2 = trials < 2 ? 0.0 : cost.variance(),
          .slowest_s = cost.max(),
          .hash = batch::TrialHash(records)};
}

}  // namespace

std::vector<PilotCost> RunPilots(const scenario::Sweep& sweep, int trials) {
  std::vector<PilotCost> pilots(sweep.cells.size());
  if (trials == 0) return pilots;
  const std::size_t stride = (sweep.cells.size() + kMostPilotCells - 1) / kMostPilotCells;
  for (std::size_t i = 0; i < sweep.cells.size(); i += stride) {
    pilots[i] = RunCell(sweep.cells[i].scenario, sweep.seed, trials);
  }
  return pilots;
}

CampaignCost ExpectedCost(const scenario::Sweep& sweep, const std::vector<PilotCost>& pilots) {
  CampaignCost cost;
  double measured_trials = 0.0;
  double all_trials = 0.0;
  double variance = 0.0;
  for (std::size_t i = 0; i < pilots.size(); ++i) {
    const auto planned = static_cast<double>(sweep.cells[i].scenario.trials);
    const PilotCost& pilot = pilots[i];
    all_trials += planned;
    if (pilot.trials == 0) continue;
    measured_trials += planned;
    cost.pilots += pilot.trials;
    cost.total_s += planned * pilot.mean_s;
    cost.slowest_s = std::max(cost.slowest_s, pilot.slowest_s);
    variance += pilot.variance_s2 * planned * (1.0 + planned / static_cast<double>(pilot.trials));
  }
  if (measured_trials == 0.0) return cost;
  const double share = all_trials / measured_trials;
  cost.total_s *= share;
  cost.standard_error_s = share * std::sqrt(variance);
  return cost;
}

}  // namespace rockyard::app
