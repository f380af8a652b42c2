#include "localization/dead_reckoning_estimator.h"
#include "trial/oracle_estimator.h"
#include "trial/standard_estimators_params.h"

namespace rockyard::trial {

localization::EstimatorSet StandardEstimators() {
  localization::EstimatorSet set;
  set.Add(localization::DescribeDeadReckoning());
  set.Add(DescribeOracle());
  return set;
}

}  // namespace rockyard::trial
