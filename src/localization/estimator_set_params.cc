#include "localization/estimator_set_params.h"

namespace rockyard::localization {

using core::Published;

EstimatorSet::EstimatorSet()
    : KindSet({.group = "localization",
               .key = "estimator",
               .one = "an estimator",
               .others = {},
               .choice = Published("where the pose that the rover believes comes from; the groups "
                                   "of other estimators do nothing",
                                   "Matthies 1995 sec. 7: dead reckoning")}) {}

}  // namespace rockyard::localization
