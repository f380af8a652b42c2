// The experiment "arc_planning" (make_experiment.cc): whether a planner over arcs finds a path
// among rocks where ACE or p-ACE says what may be stood at, as Ghosh, Otsu and Ono 2018, section
// IV-B, counted it; nothing is driven. A scene is a map with rocks of its own.
#pragma once

#include <vector>

#include "core/random.h"
#include "experiments/arc_planning/arc_planning_params.h"
#include "experiments/cell_experiment.h"
#include "messages/calibration.h"
#include "trial/drive_params.h"
#include "truth/record.h"

namespace rockyard::experiments {

struct ArcPlanningSums {
  double maps = 0.0;
  double open_maps = 0.0;
  double found = 0.0;
  double path_m = 0.0;
  double nodes = 0.0;
  double checks = 0.0;
  double poses = 0.0;
  double refused = 0.0;
  double unlikely = 0.0;
  double likely = 0.0;
};

template <typename Visitor>
void ForEachColumn(const ArcPlanningSums& s, const Visitor& visit) {
  using enum truth::ColumnRole;
  visit(truth::ValueInfo{"maps", "1", "maps, each with rocks of its own", kTrials}, s.maps);
  visit({"open_maps", "1",
         "of these, at whose start and goal the rover may stand, headed along the "
         "course",
         kCount, "maps"},
        s.open_maps);
  visit({"found", "1", "with a path from start to goal", kMainCount, "open_maps"}, s.found);
  visit({"path_m", "m", "length of the path", kSum, "found"}, s.path_m);
  visit({"nodes", "1", "nodes that the search expanded", kSum, "open_maps"}, s.nodes);
  visit({"checks", "1", "poses that it had checked", kSum, "open_maps"}, s.checks);
  visit({"poses", "1", "places of the maps at which a rover that heads along x is judged", kBase},
        s.poses);
  visit({"refused", "1", "that ACE refuses, whatever the cell's risk", kCount, "poses"}, s.refused);
  visit({"unlikely", "1", "that p-ACE gives a risk of at most 0.01", kCount, "refused"},
        s.unlikely);
  visit({"likely", "1", "that p-ACE gives a risk above 0.9", kCount, "refused"}, s.likely);
}

// Returns every column but the number of the cell.
const truth::RecordSchema& ArcPlanningColumns();

class ArcPlanningExperiment final : public CellExperiment {
 public:
  // Randomness: terrain under the key of each map, places to judge from (key, kExperiment). Cost of
  // a map: 10 to 100 ms.
  ArcPlanningExperiment(const ArcPlanningParams& params, const trial::DriveParams& drive);

 private:
  std::vector<double> Measure(std::size_t cell, core::TrialKey key) const override;

  ArcPlanningParams params_;
  trial::DriveParams drive_;
  messages::RoverBelief rover_;
};

}  // namespace rockyard::experiments
