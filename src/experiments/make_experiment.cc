#include "experiments/make_experiment.h"

#include <algorithm>
#include <cstddef>

#include "truth/measurement_record.h"

namespace rockyard::experiments {

// A store's column is known by its name alone: a column that is renamed has no role in stored runs
// any more. Where experiments know equally many names, the first of the list counts.
truth::RecordSchema WithRoles(truth::RecordSchema stored) {
  const ExperimentSet experiments = StandardExperiments();
  const truth::RecordSchema* best = nullptr;
  std::ptrdiff_t most = 0;
  for (const auto& kind : experiments.kinds()) {
    const truth::RecordSchema& columns = kind->columns();
    const auto known = std::ranges::count_if(stored, [&](const truth::ValueInfo& column) {
      return truth::FindColumn(columns, column.name) != nullptr;
    });
    if (known > most) best = &columns;
    most = std::max(most, known);
  }
  if (best == nullptr) return stored;
  for (truth::ValueInfo& column : stored) {
    const truth::ValueInfo* known = truth::FindColumn(*best, column.name);
    if (known == nullptr) continue;
    column.role = known->role;
    column.of = known->of;
  }
  return stored;
}

}  // namespace rockyard::experiments
