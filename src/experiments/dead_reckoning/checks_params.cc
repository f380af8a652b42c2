#include "experiments/dead_reckoning/checks_params.h"

namespace rockyard::experiments {

void RequireDeadReckoning(const trial::DriveParams& drive, core::FieldVisitor& v) {
  v.Require(
      "localization.estimator", drive.localization.estimators.chosen().name() == "dead_reckoning",
      "is not dead_reckoning, which the experiment dead_reckoning measures", "use dead_reckoning");
}

}  // namespace rockyard::experiments
