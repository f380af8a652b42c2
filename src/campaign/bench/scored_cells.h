// What counts of the drives of a run of an entry, as its store has them.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "batch/result_store.h"
#include "campaign/bench/bench.h"
#include "campaign/bench/bench_regret.h"
#include "truth/record.h"

namespace rockyard::campaign {

// What counts of one drive.
struct ScoredDrive {
  bool arrived = false;
  bool declared = false;
  bool unsafe = false;
  bool scraped = false;
  truth::TrialOutcome outcome = truth::TrialOutcome::kSimulatorFault;
  double no_progress_m = 0.0;
  double way_m = 0.0;
  double to_goal_m = 0.0;  // that is left at the end
  double time_s = 0.0;
  double energy_wh = 0.0;
  double regret = std::numeric_limits<double>::quiet_NaN();  // of what truly arrives
};

struct ScoredCell {
  std::string name;
  double weight = 0.0;
  std::vector<ScoredDrive> drives;  // by layout
};

using ScoredCells = std::vector<ScoredCell>;

// Returns the group of a cell: what stands before '/' in its name.
std::string GroupOf(const std::string& cell);

// Returns the cells of a run, weighted so that groups weigh alike and so do the cells of a group;
// all weights add up to 1. Throws core::UserError where a drive is missing.
ScoredCells ReadScoredCells(const BenchRun& run, const batch::ResultStore& store);

// Sets the regrets of drives that truly arrive, where there is a way to hold them against.
void SetRegrets(ScoredCells& cells, const OptimisticWays& optimist);

}  // namespace rockyard::campaign
