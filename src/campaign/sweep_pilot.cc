#include "campaign/sweep_pilot.h"

#include <algorithm>
#include <cmath>

#include "experiments/experiment.h"

namespace rockyard::campaign {
namespace {

constexpr std::size_t kMaxPilotCells = 100;

}  // namespace

std::vector<batch::PilotCost> RunPilots(const scenario::Sweep& sweep, int trials) {
  std::vector<batch::PilotCost> pilots(sweep.cells.size());
  if (trials == 0) return pilots;
  const std::size_t stride = (sweep.cells.size() + kMaxPilotCells - 1) / kMaxPilotCells;
  for (std::size_t i = 0; i < sweep.cells.size(); i += stride) {
    const auto experiment = experiments::MakeExperiment(sweep.cells[i].scenario.experiment,
                                                        sweep.cells[i].scenario.drive);
    pilots[i] = batch::RunPilots(*experiment, sweep.seed, trials);
  }
  return pilots;
}

CampaignCost ExpectedCost(const PlannedTrials& planned,
                          const std::vector<batch::PilotCost>& pilots) {
  CampaignCost cost;
  double measured_trials = 0.0;
  double variance = 0.0;
  bool scatter = false;
  for (std::size_t i = 0; i < pilots.size(); ++i) {
    const auto trials = static_cast<double>(planned.cells[i]);
    const batch::PilotCost& pilot = pilots[i];
    if (pilot.trials == 0) continue;
    measured_trials += trials;
    cost.pilots += pilot.trials;
    cost.total_s += trials * pilot.mean_s;
    cost.slowest_s = std::max(cost.slowest_s, pilot.slowest_s);
    variance += pilot.variance_s2 * trials * (1.0 + trials / static_cast<double>(pilot.trials));
    scatter = scatter || pilot.trials > 1;
  }
  if (measured_trials == 0.0) return cost;
  const double share = static_cast<double>(planned.total) / measured_trials;
  cost.total_s *= share;
  if (scatter) cost.standard_error_s = share * std::sqrt(variance);
  return cost;
}

}  // namespace rockyard::campaign
