#include "localization/dead_reckoning.h"
#include "localization/error_state_filter.h"
#include "localization/visual_odometry_estimator.h"
#include "trial/drive_params.h"
#include "trial/oracle_estimator.h"

namespace rockyard::trial {

localization::EstimatorSet StandardEstimators() {
  localization::EstimatorSet set;
  set.Add(localization::DescribeDeadReckoning());
  set.Add(DescribeOracle());
  set.Add(localization::DescribeErrorStateFilter());
  set.Add(localization::DescribeVisualOdometry());
  return set;
}

}  // namespace rockyard::trial
