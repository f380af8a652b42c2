#include "localization/estimator_set_params.h"

namespace rockyard::localization {

EstimatorSet::EstimatorSet()
    : KindSet({.group = "localization",
               .key = "estimator",
               .one = "an estimator",
               .others = {},
               .choice = {.doc = "where the pose that the rover believes comes from; the groups of "
                                 "other estimators do nothing",
                          .origin = core::Origin::kPublished,
                          .source = "Matthies 1995 sec. 7: dead reckoning"}}) {}

}  // namespace rockyard::localization
