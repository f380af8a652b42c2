#include "scenario/suite.h"

namespace rockyard::scenario {

using core::Origin;

void SensorParams::Visit(core::FieldVisitor& v) {
  v.Choice("localization", localization,
           {.doc = "where the pose that the rover believes comes from",
            .origin = Origin::kPublished,
            .source = "Matthies 1995 sec. 7: dead reckoning"});
#if __has_include("sensing/light_stripe_params.h")
  v.Group("light_stripe", light_stripe, "light stripe hazard sensor");
#endif
#if __has_include("sensing/gyro_params.h")
  v.Group("gyro", gyro, "turn rate sensor");
#endif
#if __has_include("sensing/encoder_params.h")
  v.Group("encoders", encoders, "wheel encoders");
#endif
#if __has_include("sensing/tracker_params.h")
  v.Group("tracker", tracker, "overhead tracker that reports the true pose in experiments");
#endif
}

void PerceptionParams::Visit([[maybe_unused]] core::FieldVisitor& v) {
#if __has_include("perception/hazard_params.h")
  v.Group("hazard", hazard, "hazard criteria and the two-scan rule");
#endif
#if __has_include("perception/dead_reckoning_params.h")
  v.Group("dead_reckoning", dead_reckoning, "pose from wheel encoders and gyro");
#endif
}

void NavigationParams::Visit(core::FieldVisitor& v) {
  v.Choice("navigator", navigator, {.doc = "what decides the motions", .origin = Origin::kSetting});
  v.Group("pathfinder", pathfinder, "behaviour controller");
  v.Group("wheel_driver", wheel_driver, "from motions to wheel and steering set points");
}

}  // namespace rockyard::scenario
