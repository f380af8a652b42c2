#include "trial/goal_rock_params.h"

namespace rockyard::trial {

using core::Origin;

std::vector<messages::Goal> LocalSearchParams::Places(const messages::Goal& told) const {
  std::vector<messages::Goal> places;
  for (std::int64_t square = 1; square <= squares; ++square) {
    const double off_m = spacing_m * static_cast<double>(square);
    places.push_back({told.x_m + off_m, told.y_m + off_m});
    places.push_back({told.x_m - off_m, told.y_m + off_m});
    places.push_back({told.x_m - off_m, told.y_m - off_m});
    places.push_back({told.x_m + off_m, told.y_m - off_m});
  }
  return places;
}

void LocalSearchParams::Visit(core::FieldVisitor& v) {
  v.Integer("squares", squares,
            {.doc = "squares around the told place whose corners a rover drives to that has not "
                    "found the rock there; 0: it ends its drive there",
             .min = 0,
             .max = 100,
             .origin = Origin::kSetting});
  v.Real("spacing_m", spacing_m,
         {.doc = "half the side of the first square, and what each later one adds to it",
          .min = 0.1,
          .max = 100.0,
          .origin = Origin::kAssumed,
          .source = "about the width that the light stripe's array sweeps on either side (2 x 0.26 "
                    "m); Matthies 1995 sec. 5 names a local search and describes none",
          .study_low = 0.3,
          .study_high = 1.0});
}

void GoalRockParams::Visit(core::FieldVisitor& v) {
  v.Boolean("enabled", enabled,
            {.doc = "a rock stands at the true goal, and the drive has reached its goal once the "
                    "rover has found it: once a hazard is believed while the rock is within the "
                    "array's reach, or the rover's body touches it",
             .origin = Origin::kSetting});
  v.Real("diameter_m", diameter_m,
         {.doc = "diameter of that rock, which is round and has the field's profile",
          .min = 0.02,
          .max = 10.0,
          .origin = Origin::kAssumed,
          .source = "'a rock of any reasonable size' (Matthies 1995 sec. 5)",
          .study_low = 0.15,
          .study_high = 0.6});
  v.Real("height_m", height_m,
         {.doc = "its height above the ground",
          .min = 0.01,
          .max = 10.0,
          .origin = Origin::kAssumed,
          .source = "'a rock of any reasonable size' (Matthies 1995 sec. 5), high enough for a "
                    "hazard",
          .study_low = 0.1,
          .study_high = 0.4});
  v.Real("recognition_m", recognition_m,
         {.doc = "distance from the rover's front to the rock's outline within which the rover "
                 "recognizes it and drives to where it sees it, measured as course.tracking says "
                 "(0: never); Matthies 1995 sec. 8: 'about a vehicle length', 0.6 m",
          .min = 0.0,
          .max = 20.0,
          .origin = Origin::kSetting});
  v.Group("search", search, "what the rover does where it was told and finds no rock");
}

}  // namespace rockyard::trial
