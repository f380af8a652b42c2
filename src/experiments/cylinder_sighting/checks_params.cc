#include "experiments/cylinder_sighting/checks_params.h"

#include <algorithm>
#include <cmath>

namespace rockyard::experiments {

// The cylinder's far edge lies half a baseline, a radius and d tan(bearing) off a camera's axis.
void RequireSightable(const CylinderSightingParams& study, core::FieldVisitor& v) {
  const rendering::CylinderPictureParams& picture = study.picture;
  const double half_view = std::tan(0.5 * picture.cameras.field_of_view_rad);
  const auto holds = [&](double distance_m) {
    const double nearest_m = (1.0 - study.distance_spread) * distance_m;
    const double depth_m = nearest_m * std::cos(study.largest_bearing_rad) -
                           picture.cameras.front_m - picture.target.diameter_m;
    const double aside_m = nearest_m * std::sin(study.largest_bearing_rad) +
                           0.5 * (picture.cameras.baseline_m + picture.target.diameter_m);
    return depth_m > 0.0 && aside_m <= depth_m * half_view;
  };
  v.Require("cylinder_sighting.distances_m",
            std::all_of(study.distances_m.begin(), study.distances_m.end(), holds),
            "names a distance at which the cylinder may leave an image",
            "use longer distances or a smaller largest_bearing_deg");
}

}  // namespace rockyard::experiments
