#include "sensing/visual_motion_params.h"

#include "math/functions.h"

namespace rockyard::sensing {
namespace {

using core::Calibrated;
using core::Published;
using core::Setting;

constexpr const char* kFit =
    "fitted to rendered steps (fit_visual_motion.py; results/visual_odometry.md)";

double Squared(double value) { return value * value; }

}  // namespace

double MotionErrorParams::Variance(double way_m, double angle_rad) const {
  return Squared(still) + Squared(per_m * way_m) + Squared(per_rad * angle_rad);
}

double VisualFailureParams::Probability(double way_m, double angle_rad) const {
  return 1.0 / (1.0 + math::Exp(-(intercept + per_m * way_m + per_rad * angle_rad)));
}

void VisualScheduleParams::Visit(core::FieldVisitor& v) {
  v.Real(
      "every_m", every_m,
      Published("way by the rover's odometer from one pair of images to the next; 0: not by way",
                "Howard 2012 sec. 1: with visual odometry each motion of MER is limited to 75 cm",
                {0.0, 1e4}));
  v.Angle(
      "every_deg", every_rad,
      Published("turn by the rover's estimate from one pair of images to the next; 0: not by turn",
                "Howard 2012 sec. 1: or to a turn in place of no more than 18 degrees",
                {0.0, 360.0}));
  v.Real("every_s", every_s,
         Setting("simulated time from one pair of images to the next while the rover moves; 0: not "
                 "by time. 0.2: the 5 Hz of Howard 2012",
                 {0.0, 1e6}));
}

void PlaceErrorParams::Visit(core::FieldVisitor& v) {
  v.Real("still_m", still,
         Calibrated("standard deviation where the rover has not moved", kFit, {0.0, 10.0}));
  v.Real(
      "per_m", per_m,
      Calibrated("what a metre of way adds to it, root of the summed squares", kFit, {0.0, 10.0}));
  v.Real("per_turn_m", per_rad,
         Calibrated("what a radian of turning adds to it, likewise; m", kFit, {0.0, 10.0}));
}

void TurnErrorParams::Visit(core::FieldVisitor& v) {
  v.Angle("still_deg", still,
          Calibrated("standard deviation where the rover has not moved", kFit, {0.0, 180.0}));
  v.Angle(
      "metre_deg", per_m,
      Calibrated("what a metre of way adds to it, root of the summed squares", kFit, {0.0, 180.0}));
  v.Real("per_turn", per_rad,
         Calibrated("what a radian of turning adds to it, likewise", kFit, {0.0, 3.0}));
}

void VisualFailureParams::Visit(core::FieldVisitor& v) {
  const auto field = [&](std::string_view name, double& value, std::string_view doc) {
    v.Real(name, value, Calibrated(doc, kFit, {-1000.0, 1000.0}));
  };
  field("intercept", intercept,
        "log odds that no motion is found where the rover has not moved; -1000: one always is");
  field("per_m", per_m, "what a metre of way adds to them");
  field("per_turn", per_rad, "what a radian of turning adds to them");
}

void VisualErrorModelParams::Visit(core::FieldVisitor& v) {
  v.Real(
      "keyframe_m", keyframe_m,
      Setting("way from a keyframe from which on another one takes its place, as "
              "perception.visual_odometry.keyframe.max_way_m; one without a motion does so as well",
              {0.0, 1e3}));
  v.Angle("keyframe_deg", keyframe_rad, Setting("turn from a keyframe, likewise", {0.0, 180.0}));
  v.Group("failure", failure, "chance that no motion is found");
  v.Group("along", along, "error of the way, forward");
  v.Group("across", across, "error of the way, to the left");
  v.Group("up", up, "error of the way, upward");
  v.Group("tilt", tilt, "error of the turns about the rover's x and y axes, each");
  v.Group("heading", heading, "error of the turn about its z axis");
}

void VisualMotionParams::Visit(core::FieldVisitor& v) {
  v.Boolean("enabled", enabled,
            Setting("the cameras ahead (sensors.stereo) measure how the rover moves; the estimator "
                    "is to take it (localization.estimator visual_odometry or error_state)"));
  v.Choice("fidelity", fidelity,
           Setting("error_model: the true motion, late and with fitted errors; image: rendered "
                   "images, whose features are matched on board (perception.visual_odometry)"));
  v.Group("schedule", schedule, "when images are taken");
  v.Integer("pyramid_level", pyramid_level,
            Setting("images that the cameras take (sensors.stereo.images) are reduced by 2^level",
                    {0, 4}));
  v.Group("error_model", error_model, "what comes out where no images are matched");
  v.Require(
      "schedule",
      !enabled || schedule.every_m > 0.0 || schedule.every_rad > 0.0 || schedule.every_s > 0.0,
      "has neither way nor turn nor time, so that no images are ever taken",
      "set every_m, every_deg or every_s");
}

}  // namespace rockyard::sensing
