#include "trial/route_map_params.h"

namespace rockyard::trial {

using core::Origin;

void RouteMapParams::Visit(core::FieldVisitor& v) {
  v.Choice("source", source,
           {.doc = "the rocks that a route is planned among: all as they are (oracle), or those "
                   "that the lander's cameras show (course.lander_map)",
            .origin = Origin::kSetting});
  v.Choice("use", use,
           {.doc = "navigator: for navigation.navigator route alone; waypoints: its corners are "
                   "waypoints of a rover that looks for hazards itself",
            .origin = Origin::kSetting});
  v.Real("spacing_m", spacing_m,
         {.doc = "use waypoints: a corner nearer than this to the one before, or to the goal, is "
                 "no waypoint",
          .min = 0.1,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = "about a vehicle length; nearer ones are one bend",
          .study_low = 0.3,
          .study_high = 2.0});
  v.Real("passing_m", passing_m,
         {.doc = "use waypoints: believed distance at which a corner is passed; it is too where it "
                 "lies behind",
          .min = 0.0,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = "half a vehicle length: a corner is a bend of a way, no place to be at",
          .study_low = 0.1,
          .study_high = 0.6});
}

}  // namespace rockyard::trial
