// The light fan of one emitter: in which directions it sends how much.
#pragma once

#include <vector>

#include "math/pose.h"
#include "messages/calibration.h"
#include "rendering/image_scene.h"
#include "sensing/beam_profile.h"
#include "sensing/light_stripe_params.h"

namespace rockyard::sensing {

// Returns the optical power of one emitter over the angle of its light plane that it lights, W/rad.
double FanPower(const LightStripeParams& params);

// An emitter sends its power P evenly over the angle F of its fan and, across the light plane, in
// the beam's cross section f: the irradiance of a surface at range r, incidence i and the angle a
// out of the plane is E = P / (F r^2) f(a) cos(i). A full fan has F = fan_rad; a beam of three
// scanlines lights three scanlines around each measured point, F = 3 row pitches, where an
// emitter of its own and of the same power serves each point (Matthies 1995, section 6). Where
// scanlines are planes (every lens but kEquidistant) and emitters sit on the cameras' lateral axis,
// as in the default layout, the point of a raised surface lies on the same scanline; elsewhere a
// thin beam leaves its scanline, and parameters refuse the pair with kEquidistant.
class LaserFan {
 public:
  LaserFan(const LightStripeParams& params, const messages::StripeCalibration& calibration,
           const messages::StripeLaser& laser);

  const math::Vector3& p_RoE_R() const { return p_RoE_R_; }
  const math::Vector3& normal_R() const { return normal_R_; }
  double power_w_rad() const { return power_w_rad_; }  // P / F

  // Returns whether a direction from the emitter, taken in the light plane, is lit.
  bool Lights(const math::Vector3& away_R) const;

 private:
  math::Vector3 p_RoE_R_;
  math::Vector3 normal_R_;
  std::vector<math::Vector3> axes_R_;  // middles of what it lights
  double half_fan_cosine_ = 1.0;
  double power_w_rad_ = 0.0;
};

// A fan as one scan of the terrain meets it.
class LitFan {
 public:
  // The fan must not outlive any of its arguments. `reach_rad` is that of the beam's cross section.
  LitFan(const LaserFan& fan, const rendering::ImageScene& scene, double reach_rad);

  // Returns the angle, rad, of a point out of the light plane, seen from the emitter; positive on
  // the side of the plane's normal.
  double OutOfPlane(const math::Vector3& p_W) const;

  // Returns whether both points lie on the same side of the plane and too far from it for any
  // light.
  bool PassesBy(const math::Vector3& a_W, const math::Vector3& b_W) const {
    const double a_m = normal_W_.dot(a_W) - offset_m_;
    const double b_m = normal_W_.dot(b_W) - offset_m_;
    return (a_m > width_m_ && b_m > width_m_) || (a_m < -width_m_ && b_m < -width_m_);
  }

  // Returns E / f(a) of a point, W/m2 times rad; 0 where it is out of the fan, turned away, or
  // hidden from the emitter.
  double Irradiance(const rendering::SurfacePoint& point) const;

 private:
  const LaserFan* fan_;
  const rendering::ImageScene* scene_;
  math::Vector3 p_WoE_W_;
  math::Vector3 normal_W_;
  double offset_m_;         // normal . p of the light plane
  double width_m_;          // of the lit sheet on each side, where it is widest
  std::vector<int> rocks_;  // those that reach into the sheet
};

}  // namespace rockyard::sensing
