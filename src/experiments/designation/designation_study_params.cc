#include "experiments/designation/designation_study_params.h"

#include <algorithm>

#include "math/functions.h"

namespace rockyard::experiments {

using core::Published;
using core::Setting;

void DesignationStudyParams::Visit(core::FieldVisitor& v) {
  v.Integer("designations_per_run", designations_per_run,
            Setting("goals that are designated in one run, all at one range; run i belongs to cell "
                    "i modulo their number",
                    {1, 1000000}));
  v.Reals(
      "ranges_m", ranges_m,
      Setting("true ranges of the goals along the ground, from the lander's mast", {0.1, 10000.0}));
  v.Integer("image_side_px", image_side_px,
            Published("columns and rows of the lander's images",
                      "Matthies 1995 sec. 2.1.1: 256 by 256 pixels", {16, 16384}));
  v.Real("mast_height_m", mast_height_m,
         Published("height of the lander's cameras above the ground that the goals lie on",
                   "Matthies 1995 sec. 2.1.1: about 1.5 m above the ground", {0.0, 100.0}));
  v.Real("goal_height_m", goal_height_m,
         Setting("height of the designated point above that ground", {-100.0, 100.0}));
  v.Real("near_enough_m", near_enough_m,
         Published("goals that are told nearer than this to where they lie are counted",
                   "Matthies 1995 sec. 4: half of the vehicle's width of 48 cm", {0.001, 1000.0}));
  v.Require("ranges_m", !ranges_m.empty(), "is empty", "list at least one range, e.g. 10");
  v.Require("ranges_m", Cells() <= kMaxCells, "names more than 2000 cells", "shorten the list");
}

// Cameras that are turned towards the goal image it half its disparity f B / Z off their middle; of
// a side of N pixels, (N - 1) / 2 lie on either side of the middle. An operator's pick is taken as
// within 5 standard deviations.
void RequireDesignable(const DesignationStudyParams& study, const trial::DriveParams& drive,
                       core::FieldVisitor& v) {
  const trial::DesignationParams& errors = drive.course.designation;
  const double half_px = 0.5 * (static_cast<double>(study.image_side_px) - 1.0);
  const auto holds = [&](double range_m) {
    const double slant_m = math::Hypot(range_m, study.mast_height_m - study.goal_height_m);
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
