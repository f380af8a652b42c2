#include "navigation/gestalt/manoeuvre.h"

#include <algorithm>

#include "math/angles.h"
#include "navigation/gestalt/curvature_law.h"

namespace rockyard::navigation {

using messages::MotionCommand;
using messages::MotionKind;
using messages::PoseEstimate;

bool Touches(const NavigatorInput& input, int direction) {
  if (direction < 0) return input.touches_behind;
  return input.vehicle_hazard != nullptr &&
         input.vehicle_hazard->kind == messages::VehicleHazardKind::kContact;
}

Manoeuvre::Manoeuvre(const GestaltParams& params)
    : speed_(params.speed),
      law_(params.splines.law, params.speed),
      time_out_s_(params.drive.step_time_out_s),
      felt_again_m_(params.drive.felt_again_m) {}

void Manoeuvre::Begin(const MotionCommand& motion, double leg, const NavigatorInput& input) {
  motion_ = motion;
  motion_.speed_share = SpeedShare(speed_, motion.curvature_per_m);
  spline_.reset();
  leg_ = leg;
  measured_ = 0.0;
  began_m_ = input.estimate.distance_m;
  began_s_ = input.time_s;
  heading_rad_ = input.estimate.heading_rad;
  steered_per_m_ = turns() ? 0.0 : motion.curvature_per_m;
  feels_old_ = Feels(input);
}

void Manoeuvre::Begin(const messages::Spline& spline, std::int64_t move, double leg_m,
                      const NavigatorInput& input) {
  MotionCommand start{MotionKind::kArc, spline.start_per_m, +1};
  start.move = move;
  Begin(start, leg_m, input);
  spline_ = spline;
}

void Manoeuvre::Follow(const NavigatorInput& input) {
  if (turns()) {
    measured_ += motion_.direction * math::WrapAngle(input.estimate.heading_rad - heading_rad_);
    heading_rad_ = input.estimate.heading_rad;
  } else {
    measured_ = input.estimate.distance_m - began_m_;
  }
  if (!Feels(input)) feels_old_ = false;
}

void Manoeuvre::OnPoseUpdate(const PoseEstimate& before, const PoseEstimate& after) {
  heading_rad_ += after.heading_rad - before.heading_rad;
}

bool Manoeuvre::TimedOut(const NavigatorInput& input) const {
  return input.time_s - began_s_ >= time_out_s_;
}

bool Manoeuvre::FeelsAnew(const NavigatorInput& input) const {
  return Feels(input) && (!feels_old_ || (!turns() && measured_ >= felt_again_m_));
}

PlanOrigin Manoeuvre::Ahead(const PoseEstimate& from, double way_m) const {
  const double from_m = from.distance_m - began_m_;
  const double to_m = std::clamp(from_m + way_m, from_m, std::max(from_m, leg_));
  const math::Pose2 start = Planar(from);
  const math::Pose2 place = spline_
                                ? AlongSpline(start, *spline_, from_m, to_m, law_)
                                : AlongClothoid(start, motion_.curvature_per_m, 0.0, to_m - from_m);
  return {
      {place.x_m, place.y_m, math::WrapAngle(place.heading_rad), from.distance_m + to_m - from_m},
      CommandAt(to_m).curvature_per_m};
}

// A touch behind is felt only where the rear leads.
bool Manoeuvre::Feels(const NavigatorInput& input) const {
  const bool backward = !turns() && motion_.direction < 0;
  return input.vehicle_hazard != nullptr || (backward && Touches(input, -1));
}

MotionCommand Manoeuvre::CommandAt(double driven_m) const {
  MotionCommand motion = motion_;
  if (!spline_) return motion;
  motion.curvature_per_m = CurvatureAt(*spline_, driven_m, law_);
  motion.curvature_rate_per_m2 = CurvatureRateAt(*spline_, driven_m, law_);
  motion.speed_share = SpeedShare(speed_, motion.curvature_per_m);
  return motion;
}

}  // namespace rockyard::navigation
