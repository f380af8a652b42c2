#include "experiments/designation/checks_params.h"

#include <algorithm>
#include <cmath>

namespace rockyard::experiments {

// Turned towards the goal, the cameras image it half its disparity f B / Z off their middle; of a
// side of N pixels, (N - 1) / 2 lie on either side of the middle. An operator's pick is taken as
// within 5 standard deviations.
void RequireDesignable(const DesignationStudyParams& study, const trial::DriveParams& drive,
                       core::FieldVisitor& v) {
  const trial::DesignationParams& errors = drive.course.designation;
  const double half_px = 0.5 * (static_cast<double>(study.image_side_px) - 1.0);
  const auto holds = [&](double range_m) {
    const double slant_m = std::hypot(range_m, study.mast_height_m - study.goal_height_m);
    const double offset_px = 0.5 * errors.baseline_m / (errors.pixel_rad * slant_m);
    return offset_px + 5.0 * errors.pixel_sd_px <= half_px;
  };
  v.Require("designation.ranges_m",
            std::all_of(study.ranges_m.begin(), study.ranges_m.end(), holds),
            "names a range at which a goal, or an operator's pick of it, leaves an image",
            "use longer ranges, larger images (image_side_px) or smaller errors "
            "(course.designation.pixel_sd_px)");
}

}  // namespace rockyard::experiments
