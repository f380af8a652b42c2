#include "experiments/visual_motion/visual_motion_study_params.h"

#include "trial/drive_checks_params.h"

namespace rockyard::experiments {

using core::Assumed;
using core::Setting;

std::vector<CellFactor> VisualMotionStudyParams::Factors() const {
  std::vector<CellFactor> factors{{"step_m", steps_m}, {"turn_deg", turns_deg}};
  const auto add = [&](std::string_view column, const std::vector<double>& values) {
    if (!values.empty()) factors.push_back({column, values});
  };
  add("soil_graininess", soil_graininess);
  add("sun_elevation_deg", sun_elevations_deg);
  add("baseline_m", baselines_m);
  return factors;
}

void VisualMotionStudyParams::Visit(core::FieldVisitor& v) {
  v.Integer("steps_per_run", steps_per_run,
            Setting("motions of one cell in one run, each at a place of its own; run i belongs to "
                    "cell i modulo their number",
                    {1, 100000}));
  v.Reals("steps_m", steps_m, Setting("lengths of the way of a motion", {0.0, 100.0}));
  v.Reals(
      "turns_deg", turns_deg,
      Setting("turns of a motion, to either side; the way is an arc of that turn", {0.0, 180.0}));
  v.Reals("soil_graininess", soil_graininess,
          Setting("values of sensors.look.soil_graininess", {0.0, 1.0}));
  v.Reals("sun_elevations_deg", sun_elevations_deg,
          Setting("values of sensors.sun.elevation_deg", {0.0, 90.0}));
  v.Reals("baselines_m", baselines_m,
          Setting("values of sensors.stereo.baseline_m", {0.001, 10.0}));
  v.Real("hazard_height_m", hazard_height_m,
         Setting("no rock of this height or more lies under the rover at the beginning",
                 {0.0, 100.0}));
  v.Angle(
      "tilt_sd_deg", tilt_sd_rad,
      Assumed("standard deviation of the rover's roll and pitch at either moment, on level ground",
              "among rocks that wheels climb", {0.0, 20.0}, {0.0, 6.0}));
  v.Real("prediction_error", prediction_error,
         Assumed("standard deviation of the predicted way and turn, as shares of the true ones",
                 "slip of some per cent, a gyro of 6 % (Matthies 1995 sec. 8)", {0.0, 1.0},
                 {0.0, 0.3}));
  v.Require("steps_m", !steps_m.empty() && !turns_deg.empty(), "or turns_deg is empty",
            "give both at least one value, 0 for no way or no turn");
  v.Require("steps_m", Cells() <= kMaxCells, "and the other lists span more than 2000 cells",
            "shorten the lists");
}

void RequireVisualMotion(const VisualMotionStudyParams& /*study*/, const trial::DriveParams& drive,
                         core::FieldVisitor& v) {
  v.Require("terrain.ground.slope_deg", drive.terrain.ground.IsLevel(),
            "or roughness_rms_m is not 0, or there are ditches or pits, where the experiment puts "
            "the rover on level ground",
            "leave the ground flat");
  trial::RequireTwoEyes(drive, v);
}

}  // namespace rockyard::experiments
