#include "vision/cameras/rig_drift_params.h"

#include <string_view>

namespace rockyard::vision {

using core::Assumed;

void RigDriftParams::Visit(core::FieldVisitor& v) {
  const auto angle = [&](std::string_view name, double& sd_rad, std::string_view doc) {
    v.Angle(name, sd_rad, Assumed(doc, "no published value", {0.0, 2.0}, {0.0, 0.1}));
  };
  angle("roll_sd_deg", roll_sd_rad,
        "standard deviation of the right camera's turn about its axis since calibration");
  angle("pitch_sd_deg", pitch_sd_rad,
        "standard deviation of its turn up or down: rows of the pair come apart");
  angle("yaw_sd_deg", yaw_sd_rad,
        "standard deviation of its turn in or out: all disparities change alike");
  v.Real("baseline_sd_m", baseline_sd_m,
         Assumed("standard deviation of the change of the cameras' distance", "no published value",
                 {0.0, 0.02}, {0.0, 0.001}));
  v.Real("focal_sd_percent", focal_sd_percent,
         Assumed("standard deviation of the change of the right camera's focal length",
                 "no published value", {0.0, 5.0}, {0.0, 0.2}));
}

}  // namespace rockyard::vision
