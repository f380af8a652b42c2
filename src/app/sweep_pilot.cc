#include "app/sweep_pilot.h"

#include <algorithm>
#include <cmath>

#include "experiments/experiment.h"

namespace rockyard::app {
namespace {

constexpr std::size_t kMostPilotCells = 100;

}  // namespace

std::vector<batch::PilotCost> RunPilots(const scenario::Sweep& sweep, int trials) {
  std::vector<batch::PilotCost> pilots(sweep.cells.size());
  if (trials == 0) return pilots;
  const std::size_t stride = (sweep.cells.size() + kMostPilotCells - 1) / kMostPilotCells;
  for (std::size_t i = 0; i < sweep.cells.size(); i += stride) {
    const auto experiment = experiments::MakeExperiment(sweep.cells[i].scenario);
    pilots[i] = batch::RunPilots(*experiment, sweep.seed, trials);
  }
  return pilots;
}

CampaignCost ExpectedCost(const scenario::Sweep& sweep,
                          const std::vector<batch::PilotCost>& pilots) {
  CampaignCost cost;
  double measured_trials = 0.0;
  double all_trials = 0.0;
  double variance = 0.0;
  for (std::size_t i = 0; i < pilots.size(); ++i) {
    const auto planned = static_cast<double>(sweep.cells[i].scenario.trials);
    const batch::PilotCost& pilot = pilots[i];
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
